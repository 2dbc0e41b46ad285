//! Profile intervals against those known by other means.

use drape_lm::{
    Covariance, End, Interval, Loss, MinimiserSettings, Parameter, Problem, ProfileSettings,
    ResidualFunction, Undetermined, minimise, profile, student_quantile,
};
use nalgebra::DMatrix;

use crate::{line, scatter, starts};

#[test]
fn the_profile_of_a_linear_fit_is_the_interval_of_its_standard_error() {
    let problem = line(&[]);
    let parameters = starts(&[1.0, 1.0]);
    let settings = MinimiserSettings::default();
    let report = minimise(&problem, &parameters, &settings);
    let covariance = Covariance::new(&problem, &parameters, &report, Loss::Squares);
    for (j, interval) in profile(
        &problem,
        &parameters,
        &report,
        &ProfileSettings { minimiser: settings, ..Default::default() },
    )
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

/// Decay measured until it is hardly half over: its rate is determined, with an asymmetric
/// interval.
fn decay() -> ResidualFunction<impl Fn(&[f64], &mut [f64])> {
    ResidualFunction::new(14, |p, r| {
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
    let settings = MinimiserSettings::default();
    let report = minimise(&problem, &parameters, &settings);
    let interval = profile(
        &problem,
        &parameters,
        &report,
        &ProfileSettings { minimiser: settings, ..Default::default() },
    )[1]
    .clone()
    .expect("determined");
    // With the time constant given the amplitude is a linear fit: the conditional sum is known
    // exactly.
    let sum = |tau: f64| {
        let shape: Vec<f64> = (0..14).map(|i| (-(f64::from(i) / 10.0) / tau).exp()).collect();
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
fn a_parameter_at_its_bound_has_a_one_sided_interval_and_no_error() {
    let parameters = [Parameter::new(1.0), Parameter::new(0.0).between(-0.45, 1.0)];
    let problem = line(&[]);
    let settings = MinimiserSettings::default();
    let report = minimise(&problem, &parameters, &settings);
    assert_eq!(report.parameters[1], -0.45);
    let covariance = Covariance::new(&problem, &parameters, &report, Loss::Squares);
    let reason = Undetermined::AtBound(-0.45);
    assert_eq!(covariance.standard_error(1), Err(reason));
    assert!(covariance.standard_error(0).is_ok());
    let interval = profile(
        &problem,
        &parameters,
        &report,
        &ProfileSettings { minimiser: settings, ..Default::default() },
    )[1]
    .clone()
    .expect("an interval from the bound inwards");
    assert_eq!(interval.lower, End::AtBound(-0.45));
    let upper = interval.upper.value().expect("closed");
    assert!(upper > -0.45 && upper < -0.3, "{interval:?}");
}

#[test]
fn an_interval_without_an_end_says_so() {
    // All points but the first are on the plateau: any faster rise fits as well.
    let rise = ResidualFunction::new(12, |p, r| {
        for (i, r) in r.iter_mut().enumerate() {
            let t = i as f64;
            *r = p[0] * (1.0 - (-p[1] * t).exp()) - (5.0 * f64::from(i > 0) + 0.1 * scatter(i));
        }
    });
    let parameters = [Parameter::new(4.0), Parameter::new(3.0).between(0.0, f64::INFINITY)];
    let settings = MinimiserSettings::default();
    let report = minimise(&rise, &parameters, &settings);
    let intervals = profile(
        &rise,
        &parameters,
        &report,
        &ProfileSettings { minimiser: settings, ..Default::default() },
    );
    if let Ok(interval) = &intervals[1] {
        assert!(matches!(interval.upper, End::Unbounded(_)), "{interval:?} around {report:?}");
        assert!(interval.lower.value().is_some_and(|lower| lower > 1.0));
    } else {
        assert_eq!(intervals[1], Err(Undetermined::Unidentifiable(Vec::new())), "{report:?}");
    }
    assert!(intervals[0].is_ok(), "{intervals:?}");
}

#[test]
fn a_false_minimum_is_found_out_by_its_profile() {
    // Minima near all whole numbers, deeper towards −3; the maxima between them are within the
    // noise of the other residuals.
    let valleys = ResidualFunction::new(22, |p, r| {
        r[0] = 0.8 * (std::f64::consts::PI * p[0]).sin();
        r[1] = 0.3 * (p[0] + 3.0);
        for (i, r) in r.iter_mut().enumerate().skip(2) {
            *r = scatter(i);
        }
    });
    let settings = MinimiserSettings::default();
    let parameters = starts(&[0.1]);
    let report = minimise(&valleys, &parameters, &settings);
    assert!(report.parameters[0].abs() < 0.1, "{report:?}");
    let interval = profile(
        &valleys,
        &parameters,
        &report,
        &ProfileSettings { minimiser: settings, ..Default::default() },
    )[0]
    .clone()
    .expect("determined");
    let End::LowerMinimum(there) = &interval.lower else {
        panic!("{interval:?} around {report:?}");
    };
    assert!(there[0] < -0.5, "{interval:?}");
}

/// Returns the profile interval of a fit of one parameter.
fn interval(problem: &(impl Problem + Sync), parameter: Parameter) -> Interval {
    let parameters = [parameter];
    let report = minimise(problem, &parameters, &MinimiserSettings::default());
    let mut intervals = profile(problem, &parameters, &report, &ProfileSettings::default());
    intervals.remove(0).expect("determined")
}

#[test]
fn a_model_that_ends_beyond_its_interval_has_both_ends_in_any_unit() {
    // The residual ⅔((1 + p)^1.5 − 1) has no value below p = −1. The others make its error such
    // that the level is at ±½: the step of the linear model, ½, is too short below and too long
    // above.
    let quantile = student_quantile(0.95, 21);
    for unit in [1e-3, 1.0, 1e3] {
        let bent = ResidualFunction::new(22, move |p, r| {
            r.fill(0.5 / quantile);
            r[0] = ((1.0 + p[0] / unit).powf(1.5) - 1.0) / 1.5;
        });
        let found = interval(&bent, Parameter::new(0.2 * unit));
        for (end, exact) in [
            (&found.lower, 0.25_f64.powf(2.0 / 3.0) - 1.0),
            (&found.upper, 1.75_f64.powf(2.0 / 3.0) - 1.0),
        ] {
            let End::At(value) = end else { panic!("unit {unit}: {found:?}") };
            let part = value / unit / exact;
            assert!((part - 1.0).abs() < 2e-4, "unit {unit}: {value} for {exact}");
        }
    }
}

#[test]
fn a_parameter_at_its_bound_has_the_end_of_its_parabola_in_any_unit() {
    /// Mean in a unit that is not that of the data.
    struct Mean(f64);
    impl Problem for Mean {
        fn residual_count(&self) -> usize {
            22
        }
        fn residuals(&self, p: &[f64], out: &mut [f64]) {
            for (i, r) in out.iter_mut().enumerate() {
                *r = p[0] / self.0 - (scatter(i) - 0.2);
            }
        }
        fn jacobian(&self, _: &[f64], out: &mut DMatrix<f64>) -> bool {
            out.fill(1.0 / self.0);
            true
        }
    }
    // The mean of the data is −0.2, below the bound at zero: the sum is S₀ + 8.8p + 22p².
    let squares: f64 = (0..22).map(|i| (scatter(i) - 0.2).powi(2)).sum();
    let rise = student_quantile(0.95, 22).powi(2) * squares / 22.0;
    let exact = ((8.8_f64.powi(2) + 88.0 * rise).sqrt() - 8.8) / 44.0;
    for unit in [1.0, 1e8] {
        let found = interval(&Mean(unit), Parameter::new(0.0).between(0.0, f64::INFINITY));
        assert_eq!(found.lower, End::AtBound(0.0));
        let End::At(value) = found.upper else { panic!("unit {unit}: {found:?}") };
        assert!((value / unit / exact - 1.0).abs() < 2e-4, "unit {unit}: {value} for {exact}");
    }
}

#[test]
fn an_exact_fit_has_an_interval_as_narrow_as_its_rounding() {
    // Near a million numbers are 1.2e-10 apart: a shorter move of the parameter changes nothing.
    let exact = ResidualFunction::new(3, |p, r| r.fill((1e6 + p[0]) - 1_000_001.0));
    let found = interval(&exact, Parameter::new(2.0));
    for end in [&found.lower, &found.upper] {
        let End::At(value) = end else { panic!("{found:?}") };
        assert!((value - 1.0).abs() < 2e-10, "{found:?}");
    }
    assert!(found.contains(1.0), "{found:?}");
}

#[test]
fn an_interval_contains_what_its_known_ends_enclose() {
    let closed = Interval { lower: End::AtBound(-1.0), upper: End::At(2.0) };
    let inside = [-1.1, -1.0, 0.0, 2.0, 2.1].map(|value| closed.contains(value));
    assert_eq!(inside, [false, true, true, true, false]);
    // An end that was not found excludes nothing on its side.
    let open = Interval { lower: End::At(-1.0), upper: End::Unbounded(1e9) };
    assert_eq!([-1.1, 0.0, 1e12].map(|value| open.contains(value)), [false, true, true]);
}
