//! Noise-free recovery: parameters → curve → fit must return every parameter that the curve
//! determines.
//!
//! The fabrics are random within the ranges of real ones, and the search starts from the
//! features of the curve, never from the truth.

#![allow(clippy::print_stdout)]

mod random;

use drape_fabric::{
    BendingBackbone, BendingLaw, BlimanSorine, Buckling, Dahl, Law, Piecewise, Polynomial, Primed,
    ShearBackbone, ShearLaw, TractionBackbone, TractionLaw, drive,
};
use drape_fit::{
    CurveFit, FitSettings, FrictionOrder, Identified, LoopModel, Plateau, Toe, TractionModel,
    identify_bending, identify_shear, identify_tensile,
};
use drape_kes::{Curve, Direction, Test};
use random::Random;

const FABRICS: u64 = 100;

/// Largest relative error of a parameter.
///
/// The loads are exact to 1e-16 of their range and the worst conditioned parameter, the short
/// friction length of a second order, moves them by some 1e-4 of it per unit: 1e-6 leaves five
/// digits for that.
const TOLERANCE: f64 = 1e-6;

fn primed_settings() -> FitSettings {
    FitSettings {
        traction: Some(TractionModel::Primed),
        toe: Some(Toe::Moving),
        ..FitSettings::default()
    }
}

/// One law for bending and shear, with a plateau that may grow.
fn loops(model: LoopModel) -> FitSettings {
    FitSettings {
        bending: Some(model),
        shear: Some(model),
        plateau: Some(Plateau::Growing),
        ..FitSettings::default()
    }
}

/// Returns a history through reversals, in steps of about the given size.
fn history(reversals: &[f64], step: f64) -> Vec<f64> {
    let mut history = vec![reversals[0]];
    for ends in reversals.windows(2) {
        let count = ((ends[1] - ends[0]).abs() / step).ceil() as usize;
        history
            .extend((1..=count).map(|i| ends[0] + (ends[1] - ends[0]) * i as f64 / count as f64));
    }
    history
}

fn curve(test: Test, law: &impl Law, deformation: Vec<f64>, zero: f64) -> Curve {
    let driven: Vec<f64> = match test {
        Test::Shear => deformation.iter().map(|angle: &f64| angle.sin()).collect(),
        _ => deformation.clone(),
    };
    let load = drive(law, law.virgin(), &driven).iter().map(|load| load + zero).collect();
    Curve::new(test, Direction::Warp, deformation, load).expect("a curve of a law")
}

fn values(fit: &CurveFit) -> Vec<f64> {
    fit.parameters.iter().map(|estimate| estimate.value).collect()
}

/// Asserts the largest relative error over many fabrics, and prints its fabric and parameter.
fn worst<L>(
    name: &str,
    fabrics: u64,
    mut fabric: impl FnMut(&mut Random) -> (Vec<f64>, Identified<L>),
) {
    let mut worst = (0.0, String::new());
    let (mut iterations, mut failures) = (0, 0);
    for seed in 0..fabrics {
        let mut random = Random(seed * 7919 + 17);
        let (truth, found) = fabric(&mut random);
        iterations += found.fit.iterations;
        assert_eq!(truth.len(), found.fit.parameters.len());
        let mut bad = false;
        for (exact, estimate) in truth.iter().zip(&found.fit.parameters) {
            let (parameter, value) = (estimate.name, estimate.value);
            // A parameter whose true value is zero is judged by the misfit alone.
            let error = if *exact == 0.0 { 0.0 } else { (value / exact - 1.0).abs() };
            bad |= !(error <= TOLERANCE);
            if !(error <= worst.0) {
                let text = format!(
                    "fabric {seed}: {parameter} is {value:e}, exactly {exact:e}; misfit {:e}, {:?}; {truth:?} {:?}",
                    found.fit.misfit,
                    found.fit.stop,
                    values(&found.fit)
                );
                worst = (error, text);
            }
        }
        failures += usize::from(bad);
    }
    println!(
        "{name}: {fabrics} fabrics, {failures} failed, worst relative error {:.1e}, {:.1} iterations on average",
        worst.0,
        iterations as f64 / fabrics as f64
    );
    assert!(
        worst.0 <= TOLERANCE,
        "{name}: {failures} of {fabrics} off, worst by {:e}: {}",
        worst.0,
        worst.1
    );
}

/// The strain at which a virgin fabric bears 490 N/m is 2 to 10 %, the toe a fifth to three fifths
/// of it.
fn primed(random: &mut Random) -> (Vec<f64>, TractionLaw, f64) {
    let top = random.logarithmic(0.02, 0.1);
    let toe_ratio = random.between(0.52, 0.9);
    let toe_strain = top * random.between(0.2, 0.6);
    let growth = random.between(1.05, 1.9);
    let plateau = random.between(2.0, 40.0);
    let length = top * random.logarithmic(0.01, 0.2);
    let mut law = TractionLaw {
        backbone: TractionBackbone::Primed(Primed {
            stiffness: 1.0,
            toe_ratio,
            toe_strain,
            toe_strain_after: growth * toe_strain,
        }),
        friction: BlimanSorine::none().into(),
        buckling: Buckling::default(),
    };
    let stiffness = 490.0 / law.respond(&law.virgin(), top).load;
    if let TractionBackbone::Primed(primed) = &mut law.backbone {
        primed.stiffness = stiffness;
    }
    law.friction = BlimanSorine::first_order(plateau, length).expect("a friction").into();
    (vec![stiffness, toe_ratio, toe_strain, growth, plateau, length], law, top)
}

#[test]
fn a_primed_traction_law_is_recovered_from_one_kes_cycle() {
    worst("primed traction, one cycle", FABRICS, |random| {
        let (truth, law, top) = primed(random);
        let curve = curve(Test::Tensile, &law, history(&[0.0, top, 0.0], top / 120.0), 0.0);
        (truth, identify_tensile(&curve, &primed_settings()).expect("identified"))
    });
}

#[test]
fn a_primed_traction_law_is_recovered_from_three_growing_cycles() {
    worst("primed traction, three cycles", 30, |random| {
        let (truth, law, top) = primed(random);
        let reversals = [0.0, 0.7 * top, 0.0, 0.85 * top, 0.0, top, 0.0];
        let curve = curve(Test::Tensile, &law, history(&reversals, top / 60.0), 0.0);
        (truth, identify_tensile(&curve, &primed_settings()).expect("identified"))
    });
}

#[test]
fn a_polynomial_traction_law_is_recovered() {
    worst("polynomial traction", FABRICS, |random| {
        let top = random.logarithmic(0.02, 0.1);
        let share = random.between(0.05, 0.95);
        let (quadratic, quartic) =
            (490.0 * share / top.powi(2), 490.0 * (1.0 - share) / top.powi(4));
        let (plateau, length) = (random.between(2.0, 40.0), top * random.logarithmic(0.01, 0.2));
        let law = TractionLaw {
            backbone: TractionBackbone::Polynomial(Polynomial { quadratic, quartic }),
            friction: BlimanSorine::first_order(plateau, length).expect("a friction").into(),
            buckling: Buckling::default(),
        };
        let curve = curve(Test::Tensile, &law, history(&[0.0, top, 0.0], top / 120.0), 0.0);
        let truth = vec![quadratic, quartic, plateau, length];
        (
            truth,
            identify_tensile(
                &curve,
                &FitSettings {
                    traction: Some(TractionModel::Polynomial),
                    ..FitSettings::default()
                },
            )
            .expect("identified"),
        )
    });
}

/// The KES bending cycle, ±2.5 cm⁻¹ from rest, in steps of 0.02 cm⁻¹.
fn bending_history() -> Vec<f64> {
    history(&[0.0, 250.0, -250.0, 0.0], 2.0)
}

/// Rigidity within the 5th to 95th percentile of warp and weft; 2HB of 0.2 to 2 cm⁻¹ times B.
fn bending(random: &mut Random) -> (f64, f64, f64) {
    let rigidity = random.logarithmic(9.8e-7, 1.1e-4);
    let plateau = rigidity * random.logarithmic(10.0, 100.0);
    let zero = 0.1 * rigidity * 250.0 * random.between(-1.0, 1.0);
    (rigidity, plateau, zero)
}

#[test]
fn a_bending_law_with_first_order_friction_is_recovered() {
    worst("bending, first order", FABRICS, |random| {
        let (rigidity, plateau, zero) = bending(random);
        let length = random.logarithmic(2.0, 80.0);
        let law = BendingLaw {
            backbone: BendingBackbone::Linear { rigidity },
            rest_curvature: 0.0,
            friction: BlimanSorine::first_order(plateau, length).expect("a friction"),
        };
        let curve = curve(Test::Bending, &law, bending_history(), zero);
        let truth = vec![rigidity, zero, plateau, length];
        (
            truth,
            identify_bending(&curve, &loops(LoopModel::Linear(FrictionOrder::First)))
                .expect("identified"),
        )
    });
}

#[test]
fn a_bending_law_with_second_order_friction_is_recovered() {
    worst("bending, second order", FABRICS, |random| {
        let (rigidity, plateau, zero) = bending(random);
        let length = random.logarithmic(15.0, 80.0);
        // The slow element is negative (stiction) or positive (loops that grow with their
        // amplitude).
        let (order, sign) = match random.unit() < 0.5 {
            true => (FrictionOrder::Second, -1.0),
            false => (FrictionOrder::TwoElements, 2.0),
        };
        let slow = sign * random.between(0.2, 0.7);
        let ratio = random.logarithmic(0.08, 0.5);
        let law = BendingLaw {
            backbone: BendingBackbone::Linear { rigidity },
            rest_curvature: 0.0,
            friction: BlimanSorine {
                elements: [
                    Dahl { plateau, length: ratio * length },
                    Dahl { plateau: slow * plateau, length },
                ],
            },
        };
        let curve = curve(Test::Bending, &law, bending_history(), zero);
        let truth = vec![rigidity, zero, plateau, length, slow, ratio];
        (truth, identify_bending(&curve, &loops(LoopModel::Linear(order))).expect("identified"))
    });
}

#[test]
fn breens_quadratic_and_line_are_recovered_from_the_first_branch() {
    worst("bending, quadratic and line", FABRICS, |random| {
        let (slope, plateau, _) = bending(random);
        let knot = random.between(20.0, 150.0);
        let law = BendingLaw {
            backbone: BendingBackbone::Piecewise(Piecewise { slope, intercept: plateau, knot }),
            rest_curvature: 0.0,
            friction: BlimanSorine::none(),
        };
        let curve = curve(Test::Bending, &law, bending_history(), 0.0);
        (
            vec![slope, plateau, knot],
            identify_bending(&curve, &loops(LoopModel::Piecewise)).expect("identified"),
        )
    });
}

/// G of 0.2 to 2 gf/(cm·deg), a loop half as wide as the load at 2° or less, an angle of 0.1° to 1°
/// to slip.
fn shear(random: &mut Random, grows: bool) -> (Vec<f64>, Curve) {
    let stiffness = random.logarithmic(11.0, 112.0);
    let plateau = stiffness * random.logarithmic(0.004, 0.03);
    let length = random.logarithmic(0.1, 1.0).to_radians();
    let growth = if grows { random.between(1.0, 12.0) } else { 0.0 };
    let zero = stiffness * random.between(-0.01, 0.01);
    let law = ShearLaw {
        backbone: ShearBackbone::Linear { stiffness },
        friction: BlimanSorine::first_order(plateau, length).expect("a friction"),
        growth,
        locking: None,
    };
    let reversals = [0.0, 8.0, -8.0, 0.0].map(f64::to_radians);
    let curve = curve(Test::Shear, &law, history(&reversals, 0.05_f64.to_radians()), zero);
    (vec![stiffness, zero, growth, plateau, length], curve)
}

#[test]
fn a_shear_law_with_a_growing_plateau_is_recovered() {
    worst("shear, growing plateau", FABRICS, |random| {
        let (truth, curve) = shear(random, true);
        (
            truth,
            identify_shear(&curve, &loops(LoopModel::Linear(FrictionOrder::First)))
                .expect("identified"),
        )
    });
}

#[test]
fn a_shear_law_with_a_constant_plateau_is_recovered() {
    worst("shear, constant plateau", FABRICS, |random| {
        let (truth, curve) = shear(random, false);
        (
            truth,
            identify_shear(&curve, &loops(LoopModel::Linear(FrictionOrder::First)))
                .expect("identified"),
        )
    });
}

/// Returns the largest difference between the curves of two laws, over the range of the first.
fn difference(history: &[f64], first: &BendingLaw, second: &BendingLaw) -> f64 {
    let drive = |law: &BendingLaw| drive(law, law.virgin(), history);
    let (first, second) = (drive(first), drive(second));
    let (low, high) = first
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &m| (low.min(m), high.max(m)));
    let apart = first.iter().zip(&second).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    apart / (high - low)
}

fn bending_with(friction: BlimanSorine) -> BendingLaw {
    BendingLaw {
        backbone: BendingBackbone::Linear { rigidity: 1.2e-5 },
        rest_curvature: 0.0,
        friction,
    }
}

#[test]
fn a_friction_length_far_below_the_sampling_leaves_no_trace() {
    // Steps of 2 1/m: a friction length of a fiftieth of one is at its plateau at every sample.
    let short = bending_with(BlimanSorine::first_order(6e-4, 0.04).expect("a friction"));
    let shorter = bending_with(BlimanSorine::first_order(6e-4, 0.02).expect("a friction"));
    let apart = difference(&bending_history(), &short, &shorter);
    // e^{-2/0.04} of the plateau.
    assert!(apart < 1e-15, "the curves differ by {apart:e} of their range");
}

#[test]
fn the_plateaus_of_two_elements_of_like_length_are_told_apart_by_their_sum_only() {
    // The same sum of plateaus in different shares, with lengths that differ by 1 %.
    let one = bending_with(BlimanSorine::second_order(9e-4, 3e-4, 0.99, 20.0).expect("a friction"));
    let other =
        bending_with(BlimanSorine::second_order(7e-4, 1e-4, 0.99, 20.0).expect("a friction"));
    let apart = difference(&bending_history(), &one, &other);
    // 2e-4·(1 − ratio)·e^{-1} at most, doubled after a reversal, of a range of 7e-3: below what any
    // instrument resolves.
    assert!(apart < 3e-4, "the curves differ by {apart:e} of their range");
}
