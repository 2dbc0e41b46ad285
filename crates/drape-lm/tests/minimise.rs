//! The minimiser against problems whose minima are known by other means.

use std::cell::Cell;
use std::ops::ControlFlow;

use drape_lm::{
    InvalidInput, MinimiserSettings, Parameter, Problem, ResidualFunction, Stop, minimise,
    minimise_watched,
};
use nalgebra::{DMatrix, DVector};

fn starts(values: &[f64]) -> Vec<Parameter> {
    values.iter().map(|&value| Parameter::new(value)).collect()
}

#[test]
fn rosenbrocks_valley_is_followed_to_its_end() {
    let valley = ResidualFunction::new(2, |p, r| {
        r[0] = 10.0 * (p[1] - p[0] * p[0]);
        r[1] = 1.0 - p[0];
    });
    let report = minimise(&valley, &starts(&[-1.2, 1.0]), &MinimiserSettings::default());
    assert!(report.stop.converged(), "{report:?}");
    for value in &report.parameters {
        assert!((value - 1.0).abs() < 1e-10, "{report:?}");
    }
}

#[test]
fn powells_singular_problem_is_solved_as_far_as_its_singularity_allows() {
    // The Jacobian loses rank at the minimum (0, 0, 0, 0): convergence there is linear, not
    // quadratic.
    let singular = ResidualFunction::new(4, |p, r| {
        r[0] = p[0] + 10.0 * p[1];
        r[1] = 5f64.sqrt() * (p[2] - p[3]);
        r[2] = (p[1] - 2.0 * p[2]).powi(2);
        r[3] = 10f64.sqrt() * (p[0] - p[3]).powi(2);
    });
    let report =
        minimise(&singular, &starts(&[3.0, -1.0, 0.0, 1.0]), &MinimiserSettings::default());
    assert!(report.rms < 1e-12, "{report:?}");
    assert!(report.parameters.iter().all(|value| value.abs() < 1e-5), "{report:?}");
}

#[test]
fn a_linear_fit_with_weights_solves_the_normal_equations() {
    let x: Vec<f64> = (0..20).map(|i| f64::from(i) / 10.0).collect();
    let y: Vec<f64> =
        x.iter().enumerate().map(|(i, x)| 3.0 - 2.0 * x + ((i * 7) % 5) as f64).collect();
    let weights: Vec<f64> = (0..20).map(|i| 1.0 + f64::from(i % 3)).collect();
    let line = ResidualFunction::new(20, |p, r| {
        for ((r, x), y) in r.iter_mut().zip(&x).zip(&y) {
            *r = p[0] + p[1] * x - y;
        }
    })
    .with_weights(weights.clone());
    let report = minimise(&line, &starts(&[0.0, 0.0]), &MinimiserSettings::default());
    let a = DMatrix::from_fn(20, 2, |i, j| if j == 0 { 1.0 } else { x[i] });
    let w = DMatrix::from_diagonal(&DVector::from_vec(weights));
    let normal = a.transpose() * &w * &a;
    let right = a.transpose() * &w * DVector::from_vec(y.clone());
    let exact = normal.lu().solve(&right).expect("two distinct abscissae");
    for (found, exact) in report.parameters.iter().zip(exact.iter()) {
        assert!((found - exact).abs() < 1e-9, "{found} against {exact}: {report:?}");
    }
}

#[test]
fn a_bound_holds_and_the_others_still_reach_their_conditional_minimum() {
    // Least squares of (p − 3, p + q − 5, q − 4): p = 7/3, q = 10/3; with p ≤ 2, q = (5 − 2 + 4)/2
    // = 3.5.
    let plane = ResidualFunction::new(3, |p, r| {
        r[0] = p[0] - 3.0;
        r[1] = p[0] + p[1] - 5.0;
        r[2] = p[1] - 4.0;
    });
    let free = minimise(&plane, &starts(&[0.0, 0.0]), &MinimiserSettings::default());
    assert!((free.parameters[0] - 7.0 / 3.0).abs() < 1e-9, "{free:?}");
    let bounded = [Parameter::new(0.0).between(-1.0, 2.0), Parameter::new(0.0)];
    let report = minimise(&plane, &bounded, &MinimiserSettings::default());
    assert_eq!(report.parameters[0], 2.0);
    assert!((report.parameters[1] - 3.5).abs() < 1e-9, "{report:?}");
    assert!(report.stop.converged(), "{report:?}");
}

#[test]
fn a_start_at_a_bound_leaves_it_when_the_minimum_is_inside() {
    let decay = ResidualFunction::new(30, |p, r| {
        for (i, r) in r.iter_mut().enumerate() {
            let t = i as f64 / 10.0;
            *r = p[0] * (-t / p[1]).exp() - 2.0 * (-t / 0.7).exp();
        }
    });
    let start = [Parameter::new(0.0).between(0.0, 10.0), Parameter::new(5.0).between(0.1, 5.0)];
    let report = minimise(&decay, &start, &MinimiserSettings::default());
    assert!((report.parameters[0] / 2.0 - 1.0).abs() < 1e-8, "{report:?}");
    assert!((report.parameters[1] / 0.7 - 1.0).abs() < 1e-8, "{report:?}");
}

#[test]
fn units_of_the_parameters_do_not_matter() {
    let solve = |unit: f64| {
        let power = ResidualFunction::new(20, move |p, r| {
            for (i, r) in r.iter_mut().enumerate() {
                let x = 1.0 + i as f64 / 5.0;
                *r = p[0] * x.powf(p[1] * unit) - 3.0 * x.powf(0.6);
            }
        });
        let report = minimise(&power, &starts(&[1.0, 1.0 / unit]), &MinimiserSettings::default());
        (report.parameters[0], report.parameters[1] * unit, report.iterations)
    };
    let (a, b, steps) = solve(1.0);
    let (c, d, other) = solve(1e9);
    assert!((a - 3.0).abs() < 1e-9 && (b - 0.6).abs() < 1e-9, "{a} {b}");
    assert!((a - c).abs() < 1e-9 && (b - d).abs() < 1e-9, "{a} {b} against {c} {d}");
    assert_eq!(steps, other);
}

#[test]
fn a_trial_without_a_value_is_refused_and_the_search_goes_on() {
    // The full first step from 0.1 would take the logarithm of a negative number.
    let log = ResidualFunction::new(1, |p, r| r[0] = p[0].ln());
    let report = minimise(&log, &starts(&[4.0]), &MinimiserSettings::default());
    assert!((report.parameters[0] - 1.0).abs() < 1e-9, "{report:?}");
    let report = minimise(&log, &starts(&[-1.0]), &MinimiserSettings::default());
    assert_eq!(report.stop, Stop::NotFinite);
}

#[test]
fn a_minimum_at_a_jump_is_no_convergence() {
    // The residual jumps at its minimum: no step, however short, achieves the predicted
    // reduction.
    let jump = ResidualFunction::new(1, |p, r| r[0] = if p[0] > 0.3 { 1.0 + p[0] } else { 5.0 });
    let report = minimise(&jump, &starts(&[2.0]), &MinimiserSettings::default());
    assert_eq!(report.stop, Stop::Stalled, "{report:?}");
    assert!(!report.stop.converged());
    // Within the difference step of the jump the slope is that of the jump, and leads away from it.
    assert!((report.parameters[0] - 0.3).abs() < 1e-5, "{report:?}");
}

#[test]
fn a_parameter_without_effect_stays_where_it_started() {
    let first = ResidualFunction::new(2, |p, r| {
        r[0] = p[0] - 1.0;
        r[1] = 2.0 * p[0] - 2.0;
    });
    let report = minimise(&first, &starts(&[0.0, 7.0]), &MinimiserSettings::default());
    assert!((report.parameters[0] - 1.0).abs() < 1e-12, "{report:?}");
    assert_eq!(report.parameters[1], 7.0);
}

#[test]
fn an_analytic_jacobian_and_differences_end_at_the_same_place() {
    struct Analytic;
    impl Problem for Analytic {
        fn residual_count(&self) -> usize {
            2
        }
        fn residuals(&self, p: &[f64], r: &mut [f64]) {
            r[0] = 10.0 * (p[1] - p[0] * p[0]);
            r[1] = 1.0 - p[0];
        }
        fn jacobian(&self, p: &[f64], out: &mut DMatrix<f64>) -> bool {
            out.copy_from_slice(&[-20.0 * p[0], -1.0, 10.0, 0.0]);
            true
        }
    }
    let report = minimise(&Analytic, &starts(&[-1.2, 1.0]), &MinimiserSettings::default());
    assert!(report.stop.converged(), "{report:?}");
    assert!(report.parameters.iter().all(|value| (value - 1.0).abs() < 1e-12), "{report:?}");
    // With an analytic Jacobian each iteration costs one evaluation, or two with the second-order
    // correction; the start and the polish steps cost one each.
    assert!(report.evaluations <= 2 * report.iterations + 3, "{report:?}");
}

#[test]
fn a_lower_bound_holds_as_an_upper_one_does() {
    // The plane of the upper bound with the sign of p changed.
    let plane = ResidualFunction::new(3, |p, r| {
        r[0] = p[0] + 3.0;
        r[1] = p[1] - p[0] - 5.0;
        r[2] = p[1] - 4.0;
    });
    let bounded = [Parameter::new(0.0).between(-2.0, 1.0), Parameter::new(0.0)];
    let report = minimise(&plane, &bounded, &MinimiserSettings::default());
    assert_eq!(report.parameters[0], -2.0);
    assert!((report.parameters[1] - 3.5).abs() < 1e-9, "{report:?}");
    assert!(report.stop.converged(), "{report:?}");
}

/// Distance of the parabola's points (t, t²) from (0, 3/4): least at t = ±1/2, where undamped steps
/// gain a factor of two each.
fn parabola() -> ResidualFunction<impl Fn(&[f64], &mut [f64])> {
    ResidualFunction::new(2, |p, r| {
        r[0] = p[0];
        r[1] = p[0] * p[0] - 0.75;
    })
}

#[test]
fn polish_steps_go_on_where_each_gains_a_factor_of_two_only() {
    let error = |polish: bool| {
        let settings =
            MinimiserSettings { reduction: 1e-6, polish, ..MinimiserSettings::default() };
        let report = minimise(&parabola(), &starts(&[1.0]), &settings);
        assert!(report.stop.converged(), "{report:?}");
        (report.parameters[0] - 0.5).abs()
    };
    let (rough, polished) = (error(false), error(true));
    // Twelve steps gain 2¹² = 4096.
    assert!(rough > 1e-6 && polished < rough / 1000.0, "{polished} after {rough}");
}

/// Checks the number of steps that a fit reports when it stops because its sum no longer falls.
fn check_steps(problem: &impl Problem, reduction: f64) {
    let fit = |iterations: usize| {
        let settings = MinimiserSettings {
            reduction,
            iterations,
            step: 0.0,
            gradient: 0.0,
            polish: false,
            ..MinimiserSettings::default()
        };
        minimise(problem, &starts(&[1.0]), &settings)
    };
    let report = fit(300);
    assert_eq!(report.stop, Stop::Reduction, "{report:?}");
    assert_eq!(fit(report.iterations), report);
    let short = fit(report.iterations - 1);
    assert_eq!(short.stop, Stop::Iterations, "{short:?} before {report:?}");
}

#[test]
fn the_number_of_steps_is_the_smallest_limit_with_which_the_fit_converges() {
    // The last step is accepted: it gains little.
    check_steps(&parabola(), 1e-6);
    // The last step is rejected: what it gains is below the rounding of the sum.
    let floor = ResidualFunction::new(2, |p, r| {
        r[0] = p[0].exp() - 2.0;
        r[1] = 1.0;
    });
    check_steps(&floor, 1e-14);
}

#[test]
fn a_step_uphill_of_forward_differences_is_tried_again_with_central_ones() {
    // The scale makes the forward step 0.15, and a slope over it has the wrong sign at the start;
    // the central formula has the slope of a quadratic exactly.
    let bowl = ResidualFunction::new(2, |p, r| {
        r[0] = 1.0 + 0.25 * p[0] * p[0];
        r[1] = p[0];
    });
    let start = [Parameter::new(-0.02).with_scale(1e9)];
    let report = minimise(&bowl, &start, &MinimiserSettings::default());
    assert!(report.stop.converged(), "{report:?}");
    assert!(report.parameters[0].abs() < 1e-9, "{report:?}");
}

#[test]
fn problems_of_several_kinds_are_minimised_through_one_pointer() {
    let line = ResidualFunction::new(2, |p, r| r.copy_from_slice(&[p[0] - 3.0, p[0] - 3.0]));
    let problems: [Box<dyn Problem>; 2] = [Box::new(line), Box::new(parabola())];
    let minima = problems.map(|problem| {
        minimise(&*problem, &starts(&[1.0]), &MinimiserSettings::default()).parameters[0]
    });
    assert!((minima[0] - 3.0).abs() < 1e-12 && (minima[1] - 0.5).abs() < 1e-6, "{minima:?}");
}

#[test]
fn a_watcher_sees_the_sum_fall_and_ends_the_minimisation() {
    let calls = Cell::new(0);
    let valley = ResidualFunction::new(2, |p, r| {
        calls.set(calls.get() + 1);
        r.copy_from_slice(&[10.0 * (p[1] - p[0] * p[0]), 1.0 - p[0]]);
    });
    let (start, settings) = (starts(&[-1.2, 1.0]), MinimiserSettings::default());
    let whole = minimise(&valley, &start, &settings);

    // A watcher that only looks changes nothing.
    let mut sums = Vec::new();
    calls.set(0);
    let watched = minimise_watched(&valley, &start, &settings, &mut |iteration| {
        assert_eq!(iteration.number, sums.len());
        assert!(iteration.evaluations <= calls.get());
        sums.push(iteration.sum);
        ControlFlow::Continue(())
    });
    assert_eq!(watched, whole);
    assert!(sums.windows(2).all(|pair| pair[1] <= pair[0]) && sums.len() > 5, "{sums:?}");

    // A watcher that stops gets the best point that it saw.
    let mut seen = Vec::new();
    let stopped = minimise_watched(&valley, &start, &settings, &mut |iteration| {
        seen = iteration.parameters.to_vec();
        if iteration.number == 4 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    assert_eq!((stopped.stop, stopped.iterations), (Stop::Interrupted, 4));
    assert_eq!((stopped.parameters, stopped.sum), (seen, sums[4]));
}

#[test]
fn input_that_is_no_number_is_refused_with_the_parameter_and_the_reason() {
    let good = Parameter::new(1.0);
    let (inf, nan) = (f64::INFINITY, f64::NAN);
    let cases = [
        (good.between(5.0, 2.0), InvalidInput::ReversedBounds),
        (good.between(nan, 2.0), InvalidInput::BoundNotANumber),
        (good.between(0.0, nan), InvalidInput::BoundNotANumber),
        (good.between(inf, inf), InvalidInput::BoundNotANumber),
        (good.between(-inf, -inf), InvalidInput::BoundNotANumber),
        (Parameter::new(nan), InvalidInput::StartNotFinite),
        (Parameter::new(nan).with_scale(1.0).between(0.0, 2.0), InvalidInput::StartNotFinite),
        (Parameter::new(inf), InvalidInput::StartNotFinite),
        (Parameter::new(-inf).between(-inf, 3.0), InvalidInput::StartNotFinite),
        (good.with_scale(0.0), InvalidInput::ScaleNotPositive),
        (good.with_scale(-1.0), InvalidInput::ScaleNotPositive),
        (good.with_scale(nan), InvalidInput::ScaleNotPositive),
        (good.with_scale(inf), InvalidInput::ScaleNotPositive),
    ];
    let never = ResidualFunction::new(2, |_, _| panic!("the input is refused before"));
    for (parameter, reason) in cases {
        let report = minimise(&never, &[good, parameter], &MinimiserSettings::default());
        assert_eq!(report.stop, Stop::Invalid { parameter: Some(1), reason }, "{parameter:?}");
        assert!(!report.stop.converged() && report.evaluations == 0 && report.sum.is_nan());
        assert_eq!(report.parameters.len(), 2);
    }

    let line = ResidualFunction::new(2, |p, r| r.copy_from_slice(&[p[0] - 1.0, p[0] + 1.0]));
    let weighted = |weights: &[f64]| {
        let line = line.clone().with_weights(weights.to_vec());
        minimise(&line, &[good], &MinimiserSettings::default()).stop
    };
    let refused = |reason| Stop::Invalid { parameter: None, reason };
    assert_eq!(weighted(&[1.0]), refused(InvalidInput::WeightCount));
    assert_eq!(weighted(&[1.0; 3]), refused(InvalidInput::WeightCount));
    assert_eq!(weighted(&[1.0, -1.0]), refused(InvalidInput::WeightNotFinite));
    assert_eq!(weighted(&[nan, 1.0]), refused(InvalidInput::WeightNotFinite));
    assert_eq!(weighted(&[inf, 1.0]), refused(InvalidInput::WeightNotFinite));
    assert!(weighted(&[0.0, 1.0]).converged());

    // An infinite start with finite bounds begins at a bound.
    let bounded = Parameter::new(inf).with_scale(1.0).between(-2.0, 0.5);
    assert!(minimise(&line, &[bounded], &MinimiserSettings::default()).stop.converged());
}

#[cfg(feature = "serde")]
#[test]
fn settings_and_reports_come_back_from_json() {
    let settings = MinimiserSettings {
        loss: drape_lm::Loss::Huber { size: 0.25 },
        iterations: 40,
        ..MinimiserSettings::default()
    };
    let text = serde_json::to_string(&settings).expect("it has a JSON form");
    assert!(text.contains(r#""loss":{"huber":{"size":0.25}}"#), "{text}");
    assert_eq!(serde_json::from_str::<MinimiserSettings>(&text).expect("it is right"), settings);
    // A setting that is missing has its default, and one that is unknown is refused.
    let some: MinimiserSettings =
        serde_json::from_str(r#"{"iterations":40}"#).expect("it is right");
    assert_eq!(some, MinimiserSettings { iterations: 40, ..MinimiserSettings::default() });
    assert!(serde_json::from_str::<MinimiserSettings>(r#"{"rounds":40}"#).is_err());

    let line = ResidualFunction::new(2, |p, r| r.copy_from_slice(&[p[0] - 1.0, p[0] + 1.25]));
    let report = minimise(&line, &[Parameter::new(3.0)], &settings);
    let text = serde_json::to_string(&report).expect("it has a JSON form");
    assert_eq!(serde_json::from_str::<drape_lm::Report>(&text).expect("it is right"), report);
}
