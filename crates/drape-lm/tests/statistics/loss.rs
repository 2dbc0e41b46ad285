//! Losses with and without outliers.

use drape_lm::{
    Covariance, Loss, MinimiserSettings, ProfileSettings, ResidualFunction, minimise, profile,
};

use crate::{line, scatter, starts};

#[test]
fn robust_losses_hardly_see_outliers_that_spoil_least_squares() {
    let spoilt = ResidualFunction::new(22, |p, r| {
        for (i, r) in r.iter_mut().enumerate() {
            let outlier = if i % 7 == 3 { 40.0 } else { 0.0 };
            *r = p[0] + p[1] * i as f64 - (3.0 - 0.5 * i as f64 + 0.1 * scatter(i) + outlier);
        }
    });
    let parameters = starts(&[0.0, 0.0]);
    let fit = |loss: Loss| {
        let settings = MinimiserSettings { loss, ..MinimiserSettings::default() };
        let report = minimise(&spoilt, &parameters, &settings);
        assert!(report.stop.converged(), "{loss:?}: {report:?}");
        let covariance = Covariance::new(&spoilt, &parameters, &report, loss);
        let off = report.parameters[0] - 3.0;
        (off, covariance.standard_error(0).expect("determined"))
    };
    let (off, _) = fit(Loss::Squares);
    assert!(off.abs() > 3.0, "least squares are off by {off}");
    // The scatter is 0.06 and the intercept's error some 0.03; the three outliers have one
    // sign, which biases Huber's loss.
    for loss in [Loss::Huber { size: 0.1 }, Loss::Cauchy { size: 0.15 }] {
        let (off, error) = fit(loss);
        assert!(off.abs() < 0.1 && error < 0.1, "{loss:?}: {off} ± {error}");
    }
}

#[test]
fn without_outliers_a_robust_loss_gives_nearly_the_errors_of_least_squares() {
    let problem = line(&[]);
    let parameters = starts(&[0.0, 0.0]);
    let error = |loss: Loss| {
        let settings = MinimiserSettings { loss, ..MinimiserSettings::default() };
        let report = minimise(&problem, &parameters, &settings);
        let covariance = Covariance::new(&problem, &parameters, &report, loss);
        let interval = profile(
            &problem,
            &parameters,
            &report,
            &ProfileSettings { minimiser: settings, ..Default::default() },
        )[0]
        .clone()
        .expect("determined");
        let width = [&interval.lower, &interval.upper].map(|end| end.value().expect("closed"));
        (covariance.standard_error(0).expect("determined"), width[1] - width[0])
    };
    let (error_squares, width_squares) = error(Loss::Squares);
    // Twice the largest residual: nothing is an outlier, and the losses are nearly squares.
    for loss in [Loss::Huber { size: 2.5 }, Loss::Cauchy { size: 10.0 }] {
        let (robust, width) = error(loss);
        assert!((robust / error_squares - 1.0).abs() < 0.02, "{robust}");
        assert!((width / width_squares - 1.0).abs() < 0.02, "{width}");
    }
}
