//! Shipped fabrics: misfit of the laws to the measured curves.

#![allow(clippy::print_stdout)]

use std::path::PathBuf;

use drape_fabric::{BendingBackbone, TractionBackbone};
use drape_fit::{
    Candidate, CurveFit, Fit, FitSettings, identify, identify_tensile, predict_last_cycle,
};
use drape_kes::{Direction, Sheet, Test};

fn sheet(name: &str) -> Sheet {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../fabrics").join(name);
    Sheet::read(folder).expect("a shipped sheet is good")
}

fn fabric(name: &str) -> Fit {
    let fit = identify(&sheet(name)).expect("a shipped fabric is identified");
    fit.curves.iter().for_each(print);
    fit
}

fn print(fit: &CurveFit) {
    println!(
        "{}: {:.3} % (weighted {:.3} %), R² {:.5}, neighbours {:.3}, {:.0} independent, {} steps, {} evaluations, {:?}",
        fit.name,
        100.0 * fit.misfit,
        100.0 * fit.weighted_misfit,
        fit.r_squared,
        fit.autocorrelation,
        fit.effective_points,
        fit.iterations,
        fit.evaluations,
        fit.stop
    );
    for (i, candidate) in fit.candidates.iter().enumerate() {
        let mark = if i == fit.chosen { "*" } else { " " };
        let Candidate { law, parameters, misfit, criterion, prediction } = candidate;
        println!(
            "  {mark} {law}: {parameters} parameters, {:.3} %, {criterion:.1?}, predicts {prediction:.4?}",
            100.0 * misfit
        );
    }
    for estimate in &fit.parameters {
        println!(
            "    {:12} {:12.5e} ± {:?} unweighted {:.5e}",
            estimate.name, estimate.value, estimate.standard_error, estimate.unweighted
        );
    }
}

fn misfit(fit: &Fit, name: &str) -> f64 {
    let curve = fit.curves.iter().find(|curve| curve.name == name);
    curve.expect("a curve of that name").misfit
}

#[test]
fn three_growing_cycles_of_the_cupro_strips_are_followed_within_two_percent() {
    let fit = fabric("cupro-weave");
    for name in ["stretch 8 cm, warp", "stretch 8 cm, weft"] {
        // 2 % is what Ngo Ngoc and Boivin reached, on one cycle each; here it is 1 %.
        let misfit = misfit(&fit, name);
        assert!(misfit < 0.0105, "{name}: {misfit}");
    }
}

#[test]
fn the_last_cycle_of_the_cupro_strips_is_predicted_from_the_first_two() {
    let sheet = sheet("cupro-weave");
    let tensile = sheet.curves.iter().filter(|curve| curve.test == Test::Tensile);
    for curve in tensile {
        let predictions = predict_last_cycle(curve, &FitSettings::default()).expect("three cycles");
        for p in &predictions {
            println!(
                "{}, {}: cycles 1 and 2 {:.2} %, cycle 3 {:.2} %, its peak {:+.1} %",
                curve.name,
                p.law,
                100.0 * p.fitted,
                100.0 * p.error,
                100.0 * p.peak_error
            );
        }
        let of = |law: &str| predictions.iter().find(|p| p.law == law).expect("a law compared");
        let (still, moving) =
            (of("primed: a priming zone"), of("primed: a priming zone that moves"));
        // A straight line ends below the next, larger cycle.
        assert!(still.peak_error < 0.0 && still.peak_error > -0.135, "{}", still.peak_error);
        if curve.direction == Direction::Warp {
            // The moving toe fits two cycles better, and the third worse.
            assert!(moving.fitted < still.fitted, "{} {}", moving.fitted, still.fitted);
            assert!(moving.error > still.error, "{} {}", moving.error, still.error);
        }
        let fit = identify_tensile(curve, &FitSettings::default()).expect("identified").fit;
        // The selected law follows the strip as closely as the law of the paper does, and predicts
        // its last cycle about as well.
        let chosen = &fit.candidates[fit.chosen];
        let primed = "primed: a priming zone";
        let primed = fit.candidates.iter().find(|c| c.law == primed).expect("compared");
        assert!(chosen.misfit <= 1.005 * primed.misfit, "{:#?}", fit.candidates);
        let [found, paper] = [chosen, primed].map(|c| c.prediction.expect("three cycles"));
        assert!(found < 1.1 * paper, "{found} {paper}");
    }
}

#[test]
fn the_cupro_arches_give_rigidities_within_the_scatter_of_the_instrument() {
    let fit = fabric("cupro-weave");
    // Fits of the elastica alone to the single files scatter over these ranges.
    let ranges = [(fit.fabric.warp, 4e-6..1.7e-5), (fit.fabric.weft, 4e-6..2.3e-5)];
    for (direction, range) in ranges {
        let rigidity = direction.bending.backbone.respond(0.0).tangent;
        assert!(range.contains(&rigidity), "{rigidity:e} outside {range:?}");
        assert!(direction.bending.friction.plateau() > 0.0);
    }
}

#[test]
fn tagawas_law_is_found_again_in_the_loops_generated_from_it() {
    let fit = fabric("tagawa-2003");
    let BendingBackbone::Linear { rigidity } = fit.fabric.warp.bending.backbone else {
        panic!("a line was asked for")
    };
    let friction = fit.fabric.warp.bending.friction.elements[0];
    let gram_force = 9.806_65e-3;
    let exact = [
        (rigidity, 0.12266e-2 * gram_force),
        (friction.plateau, 0.5 * 0.1181 * gram_force),
        (friction.length, 100.0 / 24.94),
    ];
    for (found, exact) in exact {
        // The file has five decimals of gf·cm/cm, 1e-5 of its range: rounding.
        assert!((found / exact - 1.0).abs() < 2e-4, "{found:e} against {exact:e}");
    }
    assert!(misfit(&fit, "bending loops, warp") < 1e-5);
}

#[test]
fn tagawas_tensile_polynomial_is_found_again() {
    let fit = fabric("tagawa-2003");
    let TractionBackbone::Polynomial(found) = fit.fabric.warp.traction.backbone else {
        panic!("the priming zone was taken for a curve that it follows to 4 % only")
    };
    // gf/cm to N/m, and percent to ratio to the power of each term.
    let unit = 0.980_665;
    for (found, exact) in [(found.quadratic, 8.5748e4 * unit), (found.quartic, 0.1191e8 * unit)] {
        assert!((found / exact - 1.0).abs() < 1e-5, "{found:e} against {exact:e}");
    }
    assert!(misfit(&fit, "tensile, warp") < 1e-6);
}

#[test]
fn matsudairas_values_become_fabrics_that_have_them() {
    for (name, b, two_hb) in [("matsudaira-a", 0.118, 0.124), ("matsudaira-b", 0.067, 0.033)] {
        let fit = fabric(name);
        let bending = fit.fabric.weft.bending;
        let rigidity = bending.backbone.respond(0.0).tangent / 9.806_65e-5;
        let width = 2.0 * bending.friction.plateau() / 9.806_65e-3;
        assert!((rigidity / b - 1.0).abs() < 1e-12, "{name}: B is {rigidity}");
        assert!((width / two_hb - 1.0).abs() < 1e-12, "{name}: 2HB is {width}");
        assert!(fit.assumed.iter().any(|note| note.starts_with("traction: not measured")));
    }
}

#[test]
fn every_shipped_curve_is_followed_within_two_percent_but_the_arches() {
    for name in ["cupro-weave", "tagawa-2003", "matsudaira-a", "matsudaira-b"] {
        for curve in fabric(name).curves {
            // The force of the arches drifts by as much as the stiffness changes it, and up and
            // down disagree.
            let most = if curve.test == Test::LoopBending { 0.09 } else { 0.02 };
            assert!(curve.misfit < most, "{}: {}", curve.name, curve.misfit);
        }
    }
}
