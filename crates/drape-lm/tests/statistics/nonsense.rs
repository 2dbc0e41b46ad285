//! Problems that cannot be fitted.

use drape_lm::{
    Covariance, InvalidInput, MinimiserSettings, Parameter, ProfileSettings, ResidualFunction,
    Stop, minimise, profile,
};

use crate::starts;

#[test]
fn nonsense_ends_with_a_reason_and_never_in_a_panic() {
    let settings = MinimiserSettings::default();
    type Plain = ResidualFunction<fn(&[f64], &mut [f64])>;
    let all = |problem: &Plain, parameters: &[Parameter]| {
        let report = minimise(problem, parameters, &settings);
        let covariance = Covariance::new(problem, parameters, &report, settings.loss);
        let intervals = profile(
            problem,
            parameters,
            &report,
            &ProfileSettings { minimiser: settings, ..Default::default() },
        );
        for (j, interval) in intervals.iter().enumerate() {
            assert!(covariance.standard_error(j).is_err());
            assert!(interval.is_err(), "{interval:?}");
        }
        report.stop
    };
    let make = Plain::new;
    let ones = starts(&[1.0, 1.0]);
    let never = make(3, |_, r| r.fill(f64::NAN));
    assert_eq!(all(&never, &ones), Stop::NotFinite);
    let huge = make(3, |p, r| r.fill(1e200 * p[0]));
    assert_eq!(all(&huge, &ones), Stop::NotFinite);
    let still = make(3, |_, r| r.fill(1.0));
    assert_eq!(all(&still, &ones), Stop::Gradient);
    let none = make(0, |_, _| {});
    assert_eq!(all(&none, &ones), Stop::Empty);
    let steep = make(3, |p, r| r.fill((p[0] - 1.0).abs().sqrt().ln() - p[1]));
    assert_eq!(all(&steep, &ones), Stop::NotFinite);
    let line = make(3, |p, r| {
        r.copy_from_slice(&[p[0] - 1.0, p[0] + p[1], p[1]]);
    });
    let reason = InvalidInput::StartNotFinite;
    let refused = Stop::Invalid { parameter: Some(0), reason };
    assert_eq!(all(&line, &starts(&[f64::NAN, 1.0])), refused);
    let reason = InvalidInput::WeightNotFinite;
    let weighted = line.with_weights(vec![-1.0, f64::NAN, 1.0]);
    assert_eq!(all(&weighted, &ones), Stop::Invalid { parameter: None, reason });
}
