//! Standard errors, intervals, links and losses against answers known by other means.

use drape_fit::lm::{
    Covariance, End, Linked, Loss, Parameter, Problem, Settings, Stop, Undetermined, minimise,
    profile, student_quantile,
};
use nalgebra::{DMatrix, DVector};

/// A problem from a function of the parameters.
struct Model<F> {
    count: usize,
    weights: Vec<f64>,
    residuals: F,
}

impl<F: Fn(&[f64], &mut [f64])> Problem for Model<F> {
    fn residual_count(&self) -> usize {
        self.count
    }
    fn residuals(&self, parameters: &[f64], out: &mut [f64]) {
        (self.residuals)(parameters, out);
    }
    fn weights(&self) -> &[f64] {
        &self.weights
    }
}

fn model<F: Fn(&[f64], &mut [f64])>(count: usize, residuals: F) -> Model<F> {
    Model {
        count,
        weights: Vec::new(),
        residuals,
    }
}

fn starts(values: &[f64]) -> Vec<Parameter> {
    values.iter().map(|&value| Parameter::new(value)).collect()
}

/// A scatter of zero mean that no line follows, in steps of one fifth.
fn scatter(i: usize) -> f64 {
    f64::from((i * 7 % 11) as u32) / 5.0 - 1.0
}

/// A line through scattered points, with weights.
fn line(weights: &[f64]) -> Model<impl Fn(&[f64], &mut [f64]) + use<>> {
    Model {
        count: 22,
        weights: weights.to_vec(),
        residuals: |p: &[f64], r: &mut [f64]| {
            for (i, r) in r.iter_mut().enumerate() {
                *r = p[0] + p[1] * i as f64 - (3.0 - 0.5 * i as f64 + scatter(i));
            }
        },
    }
}

#[test]
fn the_covariance_of_a_linear_fit_is_that_of_the_normal_equations() {
    let weights: Vec<f64> = (0..22).map(|i| f64::from(i % 4)).collect();
    let problem = line(&weights);
    let parameters = starts(&[1.0, 1.0]);
    let report = minimise(&problem, &parameters, &Settings::default());
    let found = Covariance::of(&problem, &parameters, &report, Loss::Squares);

    let a = DMatrix::from_fn(22, 2, |i, j| if j == 0 { 1.0 } else { i as f64 });
    let w = DMatrix::from_diagonal(&DVector::from_vec(weights.clone()));
    let inverse = (a.transpose() * &w * &a).try_inverse().expect("regular");
    let mut residuals = vec![0.0; 22];
    problem.residuals(&report.parameters, &mut residuals);
    let squares: f64 = residuals.iter().zip(&weights).map(|(r, w)| w * r * r).sum();
    // Residuals without weight are no data.
    let degrees = weights.iter().filter(|w| **w > 0.0).count() - 2;
    let exact = inverse * (squares / degrees as f64);

    assert_eq!(found.degrees, degrees);
    for (i, j) in [(0, 0), (0, 1), (1, 1)] {
        let value = found.covariance(i, j).expect("determined");
        // Central differences are good to ten digits.
        assert!(
            (value / exact[(i, j)] - 1.0).abs() < 1e-8,
            "{value} against {}",
            exact[(i, j)]
        );
    }
    let correlation = exact[(0, 1)] / (exact[(0, 0)] * exact[(1, 1)]).sqrt();
    assert!((found.correlation(0, 1).expect("determined") - correlation).abs() < 1e-8);
    // The value of the line at 10 is a function of both.
    let error = found.error_of(&[1.0, 10.0]).expect("determined");
    let exact = (exact[(0, 0)] + 20.0 * exact[(0, 1)] + 100.0 * exact[(1, 1)]).sqrt();
    assert!(
        (error / exact - 1.0).abs() < 1e-8,
        "{error} against {exact}"
    );
}

#[test]
fn the_profile_of_a_linear_fit_is_the_interval_of_its_standard_error() {
    let problem = line(&[]);
    let parameters = starts(&[1.0, 1.0]);
    let settings = Settings::default();
    let report = minimise(&problem, &parameters, &settings);
    let covariance = Covariance::of(&problem, &parameters, &report, Loss::Squares);
    for (j, interval) in profile(&problem, &parameters, &report, (0.95, &settings))
        .into_iter()
        .enumerate()
    {
        let interval = interval.expect("determined");
        let half = covariance.half_width(j, 0.95).expect("determined");
        let quantile = half / covariance.standard_error(j).expect("determined");
        assert!((quantile / student_quantile(0.95, 20) - 1.0).abs() < 1e-12);
        for (end, sign) in [(&interval.lower, -1.0), (&interval.upper, 1.0)] {
            let value = end.value().expect("closed");
            let part = (value - report.parameters[j]) / (sign * half);
            // The ends are found to a ten thousandth.
            assert!((part - 1.0).abs() < 2e-4, "{part}: {interval:?}");
        }
    }
}

/// A decay seen until it is hardly half over: its rate is determined, but not evenly to both sides.
fn decay() -> Model<impl Fn(&[f64], &mut [f64])> {
    model(14, |p, r| {
        for (i, r) in r.iter_mut().enumerate() {
            let t = i as f64 / 10.0;
            *r = p[0] * (-t / p[1]).exp() - (2.0 * (-t / 1.8).exp() + 0.15 * scatter(i));
        }
    })
}

#[test]
fn the_profile_of_a_curved_model_ends_where_the_conditional_sum_reaches_the_level() {
    let problem = decay();
    let parameters = [Parameter::new(1.0), Parameter::new(1.0).between(0.01, 1e3)];
    let settings = Settings::default();
    let report = minimise(&problem, &parameters, &settings);
    let interval = profile(&problem, &parameters, &report, (0.95, &settings))[1]
        .clone()
        .expect("determined");
    // With the time constant given the amplitude is a linear fit: the conditional sum is known exactly.
    let sum = |tau: f64| {
        let shape: Vec<f64> = (0..14)
            .map(|i| (-(f64::from(i) / 10.0) / tau).exp())
            .collect();
        let mut measured = vec![0.0; 14];
        problem.residuals(&[0.0, 1.0], &mut measured);
        let product: f64 = shape.iter().zip(&measured).map(|(a, b)| a * b).sum();
        let square: f64 = shape.iter().map(|a| a * a).sum();
        measured.iter().map(|b| b * b).sum::<f64>() - product * product / square
    };
    let best = sum(report.parameters[1]);
    let level = best * (1.0 + student_quantile(0.95, 12).powi(2) / 12.0);
    for end in [&interval.lower, &interval.upper] {
        let reached = sum(end.value().expect("closed")) - best;
        let part = reached / (level - best);
        // A ten thousandth of the deviation is two of its square.
        assert!((part - 1.0).abs() < 3e-4, "{part}: {interval:?}");
    }
    let below = report.parameters[1] - interval.lower.value().expect("closed");
    let above = interval.upper.value().expect("closed") - report.parameters[1];
    assert!(above > 1.2 * below, "{interval:?} around {report:?}");
}

#[test]
fn a_product_of_two_parameters_determines_neither_and_says_with_which() {
    let product = model(20, |p, r| {
        for (i, r) in r.iter_mut().enumerate() {
            *r = p[0] + p[1] * p[3] * i as f64 - (1.0 + 6.0 * i as f64 + scatter(i));
        }
    });
    let mut parameters = starts(&[0.0, 2.0, 5.0, 2.0]);
    let settings = Settings::default();
    let report = minimise(&product, &parameters, &settings);
    let covariance = Covariance::of(&product, &parameters, &report, Loss::Squares);
    assert!(covariance.standard_error(0).is_ok());
    let with = |others: &[usize]| Err(Undetermined::Unidentifiable(others.to_vec()));
    assert_eq!(covariance.standard_error(1), with(&[3]));
    assert_eq!(covariance.standard_error(2), with(&[]));
    assert_eq!(covariance.standard_error(3), with(&[1]));
    assert_eq!(covariance.degrees, 18);
    let intervals = profile(&product, &parameters, &report, (0.95, &settings));
    assert!(
        intervals[0].is_ok() && intervals[1].is_err(),
        "{intervals:?}"
    );
    // Fixing one of the two tells the other.
    parameters[3] = Parameter::new(2.0).fixed();
    let report = minimise(&product, &parameters, &settings);
    assert_eq!(report.parameters[3], 2.0);
    let covariance = Covariance::of(&product, &parameters, &report, Loss::Squares);
    assert_eq!(covariance.standard_error(3), Err(Undetermined::Fixed));
    assert!(covariance.standard_error(1).is_ok());
}

#[test]
fn a_parameter_at_its_bound_has_a_one_sided_interval_and_no_error() {
    let parameters = [Parameter::new(1.0), Parameter::new(0.0).between(-0.45, 1.0)];
    let problem = line(&[]);
    let settings = Settings::default();
    let report = minimise(&problem, &parameters, &settings);
    assert_eq!(report.parameters[1], -0.45);
    let covariance = Covariance::of(&problem, &parameters, &report, Loss::Squares);
    let reason = Undetermined::AtBound(-0.45);
    assert_eq!(covariance.standard_error(1), Err(reason));
    assert!(covariance.standard_error(0).is_ok());
    let interval = profile(&problem, &parameters, &report, (0.95, &settings))[1]
        .clone()
        .expect("an interval from the bound inwards");
    assert_eq!(interval.lower, End::AtBound(-0.45));
    let upper = interval.upper.value().expect("closed");
    assert!(upper > -0.45 && upper < -0.3, "{interval:?}");
}

#[test]
fn an_interval_without_an_end_says_so() {
    // All points but the first are on the plateau: any faster rise fits as well.
    let rise = model(12, |p, r| {
        for (i, r) in r.iter_mut().enumerate() {
            let t = i as f64;
            *r = p[0] * (1.0 - (-p[1] * t).exp()) - (5.0 * f64::from(i > 0) + 0.1 * scatter(i));
        }
    });
    let parameters = [
        Parameter::new(4.0),
        Parameter::new(3.0).between(0.0, f64::INFINITY),
    ];
    let settings = Settings::default();
    let report = minimise(&rise, &parameters, &settings);
    let intervals = profile(&rise, &parameters, &report, (0.95, &settings));
    if let Ok(interval) = &intervals[1] {
        assert!(
            matches!(interval.upper, End::Unbounded(_)),
            "{interval:?} around {report:?}"
        );
        assert!(interval.lower.value().is_some_and(|lower| lower > 1.0));
    } else {
        assert_eq!(
            intervals[1],
            Err(Undetermined::Unidentifiable(Vec::new())),
            "{report:?}"
        );
    }
    assert!(intervals[0].is_ok(), "{intervals:?}");
}

#[test]
fn a_false_minimum_is_found_out_by_its_profile() {
    // Valleys at all whole numbers, the lower the nearer to −3; the ridges between them are within the noise
    // of the other residuals.
    let valleys = model(22, |p, r| {
        r[0] = 0.8 * (std::f64::consts::PI * p[0]).sin();
        r[1] = 0.3 * (p[0] + 3.0);
        for (i, r) in r.iter_mut().enumerate().skip(2) {
            *r = scatter(i);
        }
    });
    let settings = Settings::default();
    let parameters = starts(&[0.1]);
    let report = minimise(&valleys, &parameters, &settings);
    assert!(report.parameters[0].abs() < 0.1, "{report:?}");
    let interval = profile(&valleys, &parameters, &report, (0.95, &settings))[0]
        .clone()
        .expect("determined");
    let End::LowerMinimum(there) = &interval.lower else {
        panic!("{interval:?} around {report:?}");
    };
    assert!(there[0] < -0.5, "{interval:?}");
}

#[test]
fn as_many_parameters_as_residuals_leave_no_error_to_estimate() {
    let exact = model(2, |p, r| {
        r[0] = p[0] - 1.0;
        r[1] = p[0] + p[1] - 3.0;
    });
    let parameters = starts(&[0.0, 0.0]);
    let settings = Settings::default();
    let report = minimise(&exact, &parameters, &settings);
    let covariance = Covariance::of(&exact, &parameters, &report, Loss::Squares);
    assert_eq!(covariance.standard_error(0), Err(Undetermined::NoFreedom));
    let intervals = profile(&exact, &parameters, &report, (0.95, &settings));
    assert_eq!(intervals[1], Err(Undetermined::NoFreedom));
}

#[test]
fn linked_parameters_follow_and_pass_their_errors_on() {
    // The line with its slope a function of its intercept, against the same written out.
    let problem = line(&[]);
    let linked = Linked::new(&problem).linked(1, |p| -p[0] * p[0] / 20.0);
    let parameters = linked.parameters(&starts(&[2.0, 7.0]));
    assert_eq!(parameters[1].start, -0.2);
    let settings = Settings::default();
    let report = minimise(&linked, &parameters, &settings);
    let written = model(22, |p: &[f64], r: &mut [f64]| {
        line(&[]).residuals(&[p[0], -p[0] * p[0] / 20.0], r);
    });
    let other = minimise(&written, &starts(&[2.0]), &settings);
    assert!((report.parameters[0] - other.parameters[0]).abs() < 1e-8);
    let all = linked.complete(&report.parameters);
    let covariance = Covariance::of(&linked, &parameters, &report, Loss::Squares);
    let one = Covariance::of(&written, &starts(&[2.0]), &other, Loss::Squares);
    assert_eq!(covariance.degrees, one.degrees);
    let slope = covariance
        .error_of(&linked.gradient(1, &report.parameters))
        .expect("determined");
    let exact = one.standard_error(0).expect("determined") * all[0].abs() / 10.0;
    assert!(
        (slope / exact - 1.0).abs() < 1e-6,
        "{slope} against {exact}"
    );
}

#[test]
fn the_chain_rule_serves_analytic_derivatives_through_a_link() {
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
    let linked = Linked::new(&Line).scaled(1, 0, -0.2);
    let mut exact = DMatrix::zeros(22, 2);
    assert!(linked.jacobian(&[3.0, 99.0], &mut exact));
    for i in 0..22 {
        let slope = 1.0 - 0.2 * i as f64;
        assert!((exact[(i, 0)] - slope).abs() < 1e-9 && exact[(i, 1)] == 0.0);
    }
}

#[test]
fn robust_losses_hardly_see_outliers_that_spoil_least_squares() {
    let spoilt = model(22, |p, r| {
        for (i, r) in r.iter_mut().enumerate() {
            let outlier = if i % 7 == 3 { 40.0 } else { 0.0 };
            *r = p[0] + p[1] * i as f64 - (3.0 - 0.5 * i as f64 + 0.1 * scatter(i) + outlier);
        }
    });
    let parameters = starts(&[0.0, 0.0]);
    let fit = |loss: Loss| {
        let settings = Settings {
            loss,
            ..Settings::default()
        };
        let report = minimise(&spoilt, &parameters, &settings);
        assert!(report.stop.converged(), "{loss:?}: {report:?}");
        let covariance = Covariance::of(&spoilt, &parameters, &report, loss);
        let off = report.parameters[0] - 3.0;
        (off, covariance.standard_error(0).expect("determined"))
    };
    let (off, _) = fit(Loss::Squares);
    assert!(off.abs() > 3.0, "least squares are off by {off}");
    // The scatter is 0.06 and the intercept's error some 0.03; three outliers pull Huber's all one way.
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
        let settings = Settings {
            loss,
            ..Settings::default()
        };
        let report = minimise(&problem, &parameters, &settings);
        let covariance = Covariance::of(&problem, &parameters, &report, loss);
        let interval = profile(&problem, &parameters, &report, (0.95, &settings))[0]
            .clone()
            .expect("determined");
        let width = [&interval.lower, &interval.upper].map(|end| end.value().expect("closed"));
        (
            covariance.standard_error(0).expect("determined"),
            width[1] - width[0],
        )
    };
    let (error_squares, width_squares) = error(Loss::Squares);
    // Twice the largest residual: nothing is an outlier, and the losses are nearly squares.
    for loss in [Loss::Huber { size: 2.5 }, Loss::Cauchy { size: 10.0 }] {
        let (robust, width) = error(loss);
        assert!((robust / error_squares - 1.0).abs() < 0.02, "{robust}");
        assert!((width / width_squares - 1.0).abs() < 0.02, "{width}");
    }
}

#[test]
fn nonsense_ends_with_a_reason_and_never_in_a_panic() {
    let settings = Settings::default();
    type Plain = Model<fn(&[f64], &mut [f64])>;
    let all = |problem: &Plain, parameters: &[Parameter]| {
        let report = minimise(problem, parameters, &settings);
        let covariance = Covariance::of(problem, parameters, &report, settings.loss);
        let intervals = profile(problem, parameters, &report, (0.95, &settings));
        for (j, interval) in intervals.iter().enumerate() {
            assert!(covariance.standard_error(j).is_err());
            assert!(interval.is_err(), "{interval:?}");
        }
        report.stop
    };
    let make = |count, residuals| Plain {
        count,
        weights: Vec::new(),
        residuals,
    };
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
    assert_eq!(all(&line, &starts(&[f64::NAN, 1.0])), Stop::NotFinite);
    let weighted = Model {
        weights: vec![-1.0, f64::NAN, 1.0, 1.0, 1.0],
        ..line
    };
    assert_eq!(all(&weighted, &ones), Stop::NotFinite);
}
