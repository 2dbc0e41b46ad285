//! The 95 % intervals that a fit reports contain the truth in 95 of 100 noisy curves, parameter by
//! parameter.
//!
//! Unlike `coverage`, which tests the minimiser, this tests the whole fit: initial guesses from the
//! curve, weights, and the widening for correlated residuals. The full run is
//! `cargo test --release -p drape-fit --test intervals -- --ignored --nocapture`.

#![allow(clippy::print_stdout)]

mod random;

use std::ops::RangeInclusive;

use drape_fabric::{
    BendingBackbone, BendingLaw, BlimanSorine, Buckling, Law, Primed, ShearBackbone, ShearLaw,
    TractionBackbone, TractionLaw, drive,
};
use drape_fit::{
    CurveFit, FitSettings, FrictionOrder, Intervals, LoopModel, Plateau, Toe, TractionModel,
    identify_bending, identify_shear, identify_tensile,
};
use drape_kes::{Curve, Direction, Test};
use random::Random;
use rayon::prelude::*;

/// Standard deviations of the noise, over the range of the loads.
const NOISE: [f64; 3] = [0.005, 0.01, 0.02];

/// Curve without noise, with the parameters that it was made with.
struct Case {
    name: &'static str,
    curve: Curve,
    truth: Vec<(&'static str, f64)>,
    settings: FitSettings,
}

impl Case {
    fn fit(&self, curve: &Curve, intervals: Intervals) -> CurveFit {
        let settings = FitSettings { intervals, ..self.settings };
        match curve.test {
            Test::Tensile => identify_tensile(curve, &settings).expect("identified").fit,
            Test::Shear => identify_shear(curve, &settings).expect("identified").fit,
            _ => identify_bending(curve, &settings).expect("identified").fit,
        }
    }
}

fn history(reversals: &[f64], points: usize) -> Vec<f64> {
    let mut history = vec![reversals[0]];
    for ends in reversals.windows(2) {
        let at = |i: usize| ends[0] + (ends[1] - ends[0]) * i as f64 / points as f64;
        history.extend((1..=points).map(at));
    }
    history
}

fn curve(test: Test, law: &impl Law, q: Vec<f64>) -> Curve {
    let sines: Vec<f64> = q.iter().map(|angle| angle.sin()).collect();
    let load = drive(law, law.virgin(), if test == Test::Shear { &sines } else { &q });
    Curve::new(test, Direction::Warp, q, load).expect("a curve of a law")
}

fn tensile(growth: f64) -> TractionLaw {
    TractionLaw {
        backbone: TractionBackbone::Primed(Primed {
            stiffness: 1.4e4,
            toe_ratio: 0.65,
            toe_strain: 0.018,
            toe_strain_after: growth * 0.018,
        }),
        friction: BlimanSorine::first_order(18.0, 0.003).expect("a friction").into(),
        buckling: Buckling::default(),
    }
}

fn cases() -> Vec<Case> {
    let tension = |toe| FitSettings {
        traction: Some(TractionModel::Primed),
        toe: Some(toe),
        ..FitSettings::default()
    };
    let loops = FitSettings {
        bending: Some(LoopModel::Linear(FrictionOrder::First)),
        shear: Some(LoopModel::Linear(FrictionOrder::First)),
        plateau: Some(Plateau::Growing),
        ..FitSettings::default()
    };
    let cycles = history(&[0.0, 0.035, 0.0, 0.05, 0.0], 50);
    let own = [("stiffness", 1.4e4), ("toe_ratio", 0.65), ("toe_strain", 0.018)];
    let friction = [("plateau", 18.0), ("length", 0.003)];
    let bending = BendingLaw {
        backbone: BendingBackbone::Linear { rigidity: 6e-6 },
        rest_curvature: 0.0,
        friction: BlimanSorine::first_order(3e-4, 15.0).expect("a friction"),
    };
    let shear = ShearLaw {
        backbone: ShearBackbone::Linear { stiffness: 30.0 },
        friction: BlimanSorine::first_order(0.9, 0.008).expect("a friction"),
        growth: 8.0,
        locking: None,
    };
    vec![
        Case {
            name: "tensile, one cycle",
            curve: curve(Test::Tensile, &tensile(1.0), history(&[0.0, 0.05, 0.0], 100)),
            truth: [&own[..], &friction].concat(),
            settings: tension(Toe::Still),
        },
        Case {
            name: "tensile, two cycles and a toe that moves",
            curve: curve(Test::Tensile, &tensile(1.3), cycles),
            truth: [&own[..], &[("toe_growth", 1.3)], &friction].concat(),
            settings: tension(Toe::Moving),
        },
        Case {
            name: "bending",
            curve: curve(Test::Bending, &bending, history(&[0.0, 250.0, -250.0, 250.0], 67)),
            truth: vec![("rigidity", 6e-6), ("zero", 0.0), ("plateau", 3e-4), ("length", 15.0)],
            settings: loops,
        },
        Case {
            name: "shear, growing plateau",
            curve: curve(Test::Shear, &shear, history(&[0.0, 0.14, -0.14, 0.14], 67)),
            truth: vec![
                ("stiffness", 30.0),
                ("zero", 0.0),
                ("growth", 8.0),
                ("plateau", 0.9),
                ("length", 0.008),
            ],
            settings: loops,
        },
    ]
}

/// Returns for each parameter whether its interval contains the truth, and whether it is missing.
fn trial(case: &Case, (noise, intervals): (f64, Intervals), seed: u64) -> Vec<[usize; 2]> {
    let span = case.curve.load_range().span();
    let mut random = Random(seed);
    let load = case.curve.load().iter().map(|f| f + noise * span * random.normal());
    let q = case.curve.deformation().to_vec();
    let curve = Curve::new(case.curve.test, Direction::Warp, q, load.collect()).expect("a curve");
    let fit = case.fit(&curve, intervals);
    let counts = case.truth.iter().zip(&fit.parameters).map(|((name, truth), estimate)| {
        assert_eq!(*name, estimate.name);
        match &estimate.interval {
            Ok([lower, upper]) => [usize::from(lower <= truth && truth <= upper), 0],
            Err(_) => [0, 1],
        }
    });
    counts.collect()
}

/// Largest fraction of the trials in which a parameter may have no interval.
///
/// At 2 % noise the profile of a moving toe has no end in 4 of 100 curves, because the toe is at a
/// bound: the reason is given in place of an interval.
const OPEN: f64 = 0.05;

fn cover(trials: u64, intervals: Intervals, allowed: RangeInclusive<f64>) {
    let mut outside = Vec::new();
    let mut first_seed = 1 << 62;
    for case in &cases() {
        for noise in NOISE {
            first_seed += 1 << 32;
            let counts: Vec<Vec<[usize; 2]>> = (first_seed..first_seed + trials)
                .into_par_iter()
                .map(|seed| trial(case, (noise, intervals), seed))
                .collect();
            print!("{}, noise {:.1} %:", case.name, 100.0 * noise);
            for (j, (name, _)) in case.truth.iter().enumerate() {
                let [inside, missing] = [0, 1].map(|k| {
                    counts.iter().map(|trial| trial[j][k]).sum::<usize>() as f64 / trials as f64
                });
                print!(" {name} {:.1} % ({:.1} % open)", 100.0 * inside, 100.0 * missing);
                // Of those that have an interval.
                if !allowed.contains(&(inside / (1.0 - missing))) || missing > OPEN {
                    outside
                        .push(format!("{}, {noise}, {name}: {inside}, {missing} open", case.name));
                }
            }
            println!();
        }
    }
    assert!(outside.is_empty(), "{outside:#?}");
}

#[test]
fn the_band_contains_the_true_law_at_each_point_in_95_of_100_trials() {
    const TRIALS: u64 = 100;
    for case in &cases() {
        let inside: Vec<f64> = (0..TRIALS)
            .into_par_iter()
            .map(|seed| {
                let span = case.curve.load_range().span();
                let mut random = Random(seed << 32);
                let noise = case.curve.load().iter().map(|_| 0.01 * span * random.normal());
                let load = case.curve.load().iter().zip(noise).map(|(f, noise)| f + noise);
                let q = case.curve.deformation().to_vec();
                let curve = Curve::new(case.curve.test, Direction::Warp, q, load.collect());
                let fit = case.fit(&curve.expect("a curve"), Intervals::Wald);
                let off = fit.load.iter().zip(case.curve.load()).map(|(a, b)| (a - b).abs());
                let within = off.zip(&fit.band).filter(|(off, band)| off <= *band).count();
                within as f64 / fit.band.len() as f64
            })
            .collect();
        let part = inside.iter().sum::<f64>() / TRIALS as f64;
        println!("{}: {:.1} % of the points of the true law in the band", case.name, 100.0 * part);
        // The fraction of one curve scatters by some 0.1, that of all by 0.01.
        assert!((0.92..=0.98).contains(&part), "{}: {part}", case.name);
    }
}

#[test]
fn reported_intervals_contain_the_truth_about_as_often_as_they_say() {
    // With 100 trials a fraction scatters by 2.2 %: this is 3.5 times that on either side.
    cover(100, Intervals::Wald, 0.873..=1.0);
}

#[test]
#[ignore = "a thousand trials of each case take a minute"]
fn reported_intervals_contain_the_truth_in_92_to_98_of_100_trials() {
    cover(1000, Intervals::Wald, 0.92..=0.98);
}

#[test]
#[ignore = "a thousand profiles of each case take four minutes"]
fn reported_profiles_contain_the_truth_in_92_to_98_of_100_trials() {
    cover(1000, Intervals::Profile, 0.92..=0.98);
}
