//! Standard errors and correlations against the normal equations.

use drape_lm::{
    Covariance, Loss, MinimiserSettings, Parameter, Problem, ProfileSettings, ResidualFunction,
    Undetermined, minimise, profile,
};
use nalgebra::{DMatrix, DVector};

use crate::{line, scatter, starts};

#[test]
fn the_covariance_of_a_linear_fit_is_that_of_the_normal_equations() {
    let weights: Vec<f64> = (0..22).map(|i| f64::from(i % 4)).collect();
    let problem = line(&weights);
    let parameters = starts(&[1.0, 1.0]);
    let report = minimise(&problem, &parameters, &MinimiserSettings::default());
    let found = Covariance::new(&problem, &parameters, &report, Loss::Squares);

    let a = DMatrix::from_fn(22, 2, |i, j| if j == 0 { 1.0 } else { i as f64 });
    let w = DMatrix::from_diagonal(&DVector::from_vec(weights.clone()));
    let inverse = (a.transpose() * &w * &a).try_inverse().expect("regular");
    let mut residuals = vec![0.0; 22];
    problem.residuals(&report.parameters, &mut residuals);
    let squares: f64 = residuals.iter().zip(&weights).map(|(r, w)| w * r * r).sum();
    // Residuals without weight are no data.
    let degrees = weights.iter().filter(|w| **w > 0.0).count() - 2;
    let exact = inverse * (squares / degrees as f64);

    assert_eq!(found.degrees_of_freedom, degrees);
    for (i, j) in [(0, 0), (0, 1), (1, 1)] {
        let value = found.covariance(i, j).expect("determined");
        // Central differences are good to ten digits.
        assert!((value / exact[(i, j)] - 1.0).abs() < 1e-8, "{value} against {}", exact[(i, j)]);
    }
    let correlation = exact[(0, 1)] / (exact[(0, 0)] * exact[(1, 1)]).sqrt();
    assert!((found.correlation(0, 1).expect("determined") - correlation).abs() < 1e-8);
    // The value of the line at 10 is a function of both.
    let error = found.propagated_error(&[1.0, 10.0]).expect("determined");
    let exact = (exact[(0, 0)] + 20.0 * exact[(0, 1)] + 100.0 * exact[(1, 1)]).sqrt();
    assert!((error / exact - 1.0).abs() < 1e-8, "{error} against {exact}");
}

#[test]
fn a_product_of_two_parameters_determines_neither_and_says_with_which() {
    let product = ResidualFunction::new(20, |p, r| {
        for (i, r) in r.iter_mut().enumerate() {
            *r = p[0] + p[1] * p[3] * i as f64 - (1.0 + 6.0 * i as f64 + scatter(i));
        }
    });
    let mut parameters = starts(&[0.0, 2.0, 5.0, 2.0]);
    let settings = MinimiserSettings::default();
    let report = minimise(&product, &parameters, &settings);
    let covariance = Covariance::new(&product, &parameters, &report, Loss::Squares);
    assert!(covariance.standard_error(0).is_ok());
    let with = |others: &[usize]| Err(Undetermined::Unidentifiable(others.to_vec()));
    assert_eq!(covariance.standard_error(1), with(&[3]));
    assert_eq!(covariance.standard_error(2), with(&[]));
    assert_eq!(covariance.standard_error(3), with(&[1]));
    assert_eq!(covariance.degrees_of_freedom, 18);
    let intervals = profile(
        &product,
        &parameters,
        &report,
        &ProfileSettings { minimiser: settings, ..Default::default() },
    );
    assert!(intervals[0].is_ok() && intervals[1].is_err(), "{intervals:?}");
    // Fixing one of the two determines the other.
    parameters[3] = Parameter::new(2.0).fixed();
    let report = minimise(&product, &parameters, &settings);
    assert_eq!(report.parameters[3], 2.0);
    let covariance = Covariance::new(&product, &parameters, &report, Loss::Squares);
    assert_eq!(covariance.standard_error(3), Err(Undetermined::Fixed));
    assert!(covariance.standard_error(1).is_ok());
}

#[test]
fn as_many_parameters_as_residuals_leave_no_error_to_estimate() {
    let exact = ResidualFunction::new(2, |p, r| {
        r[0] = p[0] - 1.0;
        r[1] = p[0] + p[1] - 3.0;
    });
    let parameters = starts(&[0.0, 0.0]);
    let settings = MinimiserSettings::default();
    let report = minimise(&exact, &parameters, &settings);
    let covariance = Covariance::new(&exact, &parameters, &report, Loss::Squares);
    assert_eq!(covariance.standard_error(0), Err(Undetermined::NoDegreesOfFreedom));
    let intervals = profile(
        &exact,
        &parameters,
        &report,
        &ProfileSettings { minimiser: settings, ..Default::default() },
    );
    assert_eq!(intervals[1], Err(Undetermined::NoDegreesOfFreedom));
}
