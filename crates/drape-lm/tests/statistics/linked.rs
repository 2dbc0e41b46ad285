//! Linked parameters against the same problems without links.

use drape_lm::{Covariance, Linked, Loss, MinimiserSettings, Problem, ResidualFunction, minimise};
use nalgebra::DMatrix;

use crate::{line, starts};

#[test]
fn linked_parameters_follow_and_pass_their_errors_on() {
    // The line with its slope a function of its intercept, linked and substituted.
    let problem = line(&[]);
    let linked = Linked::new(&problem).linked(1, |p| -p[0] * p[0] / 20.0);
    let parameters = linked.parameters(&starts(&[2.0, 7.0]));
    assert_eq!(parameters[1].start, -0.2);
    let settings = MinimiserSettings::default();
    let report = minimise(&linked, &parameters, &settings);
    let written = ResidualFunction::new(22, |p: &[f64], r: &mut [f64]| {
        line(&[]).residuals(&[p[0], -p[0] * p[0] / 20.0], r);
    });
    let other = minimise(&written, &starts(&[2.0]), &settings);
    assert!((report.parameters[0] - other.parameters[0]).abs() < 1e-8);
    let all = linked.complete(&report.parameters);
    let covariance = Covariance::new(&linked, &parameters, &report, Loss::Squares);
    let one = Covariance::new(&written, &starts(&[2.0]), &other, Loss::Squares);
    assert_eq!(covariance.degrees_of_freedom, one.degrees_of_freedom);
    let slope =
        covariance.propagated_error(&linked.gradient(1, &report.parameters)).expect("determined");
    let exact = one.standard_error(0).expect("determined") * all[0].abs() / 10.0;
    assert!((slope / exact - 1.0).abs() < 1e-6, "{slope} against {exact}");
}

/// Straight line with analytic derivatives.
struct Line;

impl Problem for Line {
    fn residual_count(&self) -> usize {
        22
    }
    fn residuals(&self, p: &[f64], r: &mut [f64]) {
        line(&[]).residuals(p, r);
    }
    fn jacobian(&self, _: &[f64], out: &mut DMatrix<f64>) -> bool {
        for i in 0..22 {
            (out[(i, 0)], out[(i, 1)]) = (1.0, i as f64);
        }
        true
    }
}

#[test]
fn the_chain_rule_serves_analytic_derivatives_through_a_link() {
    let linked = Linked::new(&Line).scaled(1, 0, -0.2);
    let mut exact = DMatrix::zeros(22, 2);
    assert!(linked.jacobian(&[3.0, 99.0], &mut exact));
    for i in 0..22 {
        let slope = 1.0 - 0.2 * i as f64;
        assert!((exact[(i, 0)] - slope).abs() < 1e-9 && exact[(i, 1)] == 0.0);
    }
}

#[test]
fn a_link_of_a_parameter_that_does_not_exist_has_no_effect() {
    let linked = Linked::new(&Line).scaled(1, 0, -0.2);
    let beyond = Linked::new(&Line).scaled(1, 0, -0.2).scaled(2, 0, 5.0);
    let [mut exact, mut found] = [DMatrix::zeros(22, 2), DMatrix::zeros(22, 2)];
    assert!(linked.jacobian(&[3.0, 99.0], &mut exact));
    assert!(beyond.jacobian(&[3.0, 99.0], &mut found));
    assert_eq!(found, exact);
    assert_eq!(beyond.complete(&[3.0, 99.0]), linked.complete(&[3.0, 99.0]));
}
