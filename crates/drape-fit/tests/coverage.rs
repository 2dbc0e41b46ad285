//! Intervals at 95 % must contain the truth in 95 of 100 trials with simulated noise.
//!
//! The default run makes fewer trials and allows for the scatter that goes with them. The full run
//! is `cargo test --release -p drape-fit --test coverage -- --ignored --nocapture`.

#![allow(clippy::print_stdout)]

mod random;

use drape_fabric::{
    BendingBackbone, BendingLaw, BlimanSorine, Law, ShearBackbone, ShearLaw, drive,
};
use drape_lm::{
    Covariance, Loss, MinimiserSettings, Parameter, Problem, ProfileSettings, minimise, profile,
};
use random::Random;
use rayon::prelude::*;

const LEVEL: f64 = 0.95;
/// Standard deviations of the noise, over the range of the loads.
const NOISE: [f64; 3] = [0.005, 0.01, 0.02];

/// Loads of a model with the given parameters.
type Predict = Box<dyn Fn(&[f64]) -> Vec<f64> + Sync>;

/// Model with its true parameters and their names.
struct Case {
    name: &'static str,
    truth: Vec<(&'static str, f64)>,
    predict: Predict,
}

/// Start of the search over the truth.
const START: f64 = 1.3;

struct Trial<'a> {
    case: &'a Case,
    measured: Vec<f64>,
}

impl Problem for Trial<'_> {
    fn residual_count(&self) -> usize {
        self.measured.len()
    }
    fn residuals(&self, parameters: &[f64], out: &mut [f64]) {
        let predicted = (self.case.predict)(parameters);
        for ((r, p), m) in out.iter_mut().zip(predicted).zip(&self.measured) {
            *r = p - m;
        }
    }
}

/// Returns a history through reversals, with the given number of points in each branch.
fn history(reversals: &[f64], points: usize) -> Vec<f64> {
    let mut history = vec![reversals[0]];
    for ends in reversals.windows(2) {
        let at = |i: usize| ends[0] + (ends[1] - ends[0]) * i as f64 / points as f64;
        history.extend((1..=points).map(at));
    }
    history
}

fn along(law: &impl Law, history: &[f64]) -> Vec<f64> {
    drive(law, law.virgin(), history)
}

fn cases() -> [Case; 3] {
    let bend = history(&[0.0, 250.0, -250.0, 250.0], 45);
    let shear = history(&[0.0, 0.14, -0.14, 0.14], 45);
    [
        Case {
            name: "exponential decay to a level",
            truth: vec![("amplitude", 3.0), ("time", 0.8), ("level", 1.0)],
            predict: Box::new(|p| {
                let at = |i: u32| p[2] + p[0] * (-f64::from(i) / 20.0 / p[1]).exp();
                (0..60).map(at).collect()
            }),
        },
        Case {
            name: "bending loop",
            truth: vec![("rigidity", 6e-6), ("zero", 4e-5), ("plateau", 3e-4), ("length", 15.0)],
            predict: Box::new(move |p| {
                let law = BendingLaw {
                    backbone: BendingBackbone::Linear { rigidity: p[0] },
                    rest_curvature: 0.0,
                    friction: BlimanSorine::first_order(p[2], p[3]).expect("a friction"),
                };
                let mut load = along(&law, &bend);
                load.iter_mut().for_each(|load| *load += p[1]);
                load
            }),
        },
        Case {
            name: "shear loop with a growing plateau",
            truth: vec![("stiffness", 30.0), ("plateau", 0.9), ("growth", 8.0), ("length", 0.008)],
            predict: Box::new(move |p| {
                let law = ShearLaw {
                    backbone: ShearBackbone::Linear { stiffness: p[0] },
                    friction: BlimanSorine::first_order(p[1], p[3]).expect("a friction"),
                    growth: p[2],
                    locking: None,
                };
                along(&law, &shear)
            }),
        },
    ]
}

/// Number of intervals of one parameter that contain the truth, by method, or are missing.
#[derive(Clone, Copy, Default)]
struct Count {
    by_error: usize,
    by_profile: usize,
    missing: usize,
}

/// Fits one simulated measurement: for each parameter, whether either interval contains the truth.
fn trial(case: &Case, noise: f64, seed: u64) -> Vec<Count> {
    let truth: Vec<f64> = case.truth.iter().map(|(_, value)| *value).collect();
    let mut measured = (case.predict)(&truth);
    let low = measured.iter().copied().fold(f64::INFINITY, f64::min);
    let high = measured.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let mut random = Random(seed);
    for value in &mut measured {
        *value += noise * (high - low) * random.normal();
    }
    let problem = Trial { case, measured };
    let parameters: Vec<Parameter> = truth
        .iter()
        .map(|truth| Parameter::new(START * truth).between(1e-3 * truth, 1e3 * truth))
        .collect();
    let settings = MinimiserSettings::default();
    let report = minimise(&problem, &parameters, &settings);
    let covariance = Covariance::new(&problem, &parameters, &report, Loss::Squares);
    let intervals = profile(&problem, &parameters, &report, &ProfileSettings::default());
    let counts = truth.iter().zip(intervals).enumerate();
    counts
        .map(|(j, (truth, interval))| {
            let off = (report.parameters[j] - truth).abs();
            let half = covariance.half_width(j, LEVEL);
            let closed = interval.as_ref().is_ok_and(|interval| {
                interval.lower.value().is_some() && interval.upper.value().is_some()
            });
            Count {
                by_error: usize::from(half.is_ok_and(|half| off <= half)),
                by_profile: usize::from(interval.is_ok_and(|i| i.contains(*truth))),
                missing: usize::from(!closed),
            }
        })
        .collect()
}

/// Runs trials of every case with every noise, and asserts the fraction that contains the truth.
fn cover(trials: u64, allowed: std::ops::RangeInclusive<f64>) {
    // Every trial of every case has its own seed.
    let mut first_seed = 0;
    for case in &cases() {
        for noise in NOISE {
            first_seed += 1 << 32;
            let counts: Vec<Vec<Count>> = (first_seed..first_seed + trials)
                .into_par_iter()
                .map(|seed| trial(case, noise, seed))
                .collect();
            for (j, (name, _)) in case.truth.iter().enumerate() {
                let part = |of: fn(&Count) -> usize| {
                    let inside: usize = counts.iter().map(|trial| of(&trial[j])).sum();
                    inside as f64 / trials as f64
                };
                let by_error = part(|count| count.by_error);
                let by_profile = part(|count| count.by_profile);
                let missing = part(|count| count.missing);
                println!(
                    "{}, noise {:.1} %, {name}: {:.1} % by standard error, {:.1} % by profile, {:.1} % open",
                    case.name,
                    100.0 * noise,
                    100.0 * by_error,
                    100.0 * by_profile,
                    100.0 * missing
                );
                assert!(missing < 0.01, "{}, {name}: {missing} open", case.name);
                for part in [by_error, by_profile] {
                    assert!(
                        allowed.contains(&part),
                        "{}, noise {noise}, {name}: {by_error} by standard error, {by_profile} by profile",
                        case.name
                    );
                }
            }
        }
    }
}

#[test]
fn intervals_contain_the_truth_about_as_often_as_they_say() {
    // With 300 trials a part scatters by 1.26 %; of 66 parts one in sixty runs has one beyond 3.5
    // times that.
    cover(300, 0.906..=0.994);
}

#[test]
#[ignore = "a thousand trials of each case take half a minute"]
fn intervals_contain_the_truth_in_92_to_98_of_100_trials() {
    cover(1000, 0.92..=0.98);
}
