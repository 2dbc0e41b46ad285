//! One fabric measured on strips of different lengths.

#![allow(clippy::print_stdout)]

use std::path::PathBuf;

use drape_fabric::{Law, TractionLaw};
use drape_fit::{
    CurveFit, FitSettings, Toe, TractionModel, identify_loop_bending, identify_tensile,
};
use drape_input::Document;
use drape_kes::{Curve, Sheet, Test};

/// Reads curves of the cupro weave, some of which its sheet does not use.
fn curves(test: &str, slack: bool, files: &[(&str, &str)]) -> Vec<Curve> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../fabrics/cupro-weave");
    let mut text = String::from("name = \"cupro\"\n");
    for (file, direction) in files {
        text.push_str(&format!(
            "[[curve]]\nname = \"{file}\"\ntest = \"{test}\"\ndirection = \"{direction}\"\nfile = \"{file}\"\n\
             deformation = {{ column = \"clamp_distance_m\", unit = \"m\", gauge = \"specimen_length_m\" }}\n\
             load = {{ column = \"force_N\", unit = \"N\", width = \"clamp_width_m\" }}\n"
        ));
        if slack {
            text.push_str("slack = true\n");
        }
    }
    let sheet = Document::new(folder.join("gauges.toml"), text);
    Sheet::from_document(&sheet).expect("a good sheet").curves
}

fn print(fit: &CurveFit) {
    println!(
        "{}: residual {:.2} %, {:.0} independent points",
        fit.name,
        100.0 * fit.misfit,
        fit.effective_points
    );
    for estimate in &fit.parameters {
        match &estimate.standard_error {
            Ok(error) => {
                println!("    {:12} {:11.4e} ± {error:.1e}", estimate.name, estimate.value)
            }
            Err(reason) => println!("    {:12} {:11.4e}, {reason}", estimate.name, estimate.value),
        }
    }
}

fn value(fit: &CurveFit, name: &str) -> f64 {
    fit.parameters.iter().find(|estimate| estimate.name == name).expect("a parameter").value
}

/// Returns the strain of a virgin fabric at a tension.
fn strain_at(law: &TractionLaw, tension: f64) -> f64 {
    let (mut low, mut high) = (0.0, 0.2);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if law.respond(&law.virgin(), middle).load < tension { low = middle } else { high = middle }
    }
    high
}

#[test]
fn strips_of_two_lengths_agree_to_the_scatter_of_specimens() {
    let settings = FitSettings {
        traction: Some(TractionModel::Primed),
        toe: Some(Toe::Still),
        ..FitSettings::default()
    };
    for direction in ["warp", "weft"] {
        let files = ["2cm", "8cm"].map(|gauge| format!("stretch-{gauge}-{direction}.csv"));
        let files: Vec<(&str, &str)> = files.iter().map(|file| (&**file, direction)).collect();
        let laws: Vec<TractionLaw> = curves("tensile", true, &files)
            .iter()
            .map(|curve| {
                let found = identify_tensile(curve, &settings).expect("identified");
                println!("load to {:.1} N/m", curve.load_range().high);
                print(&found.fit);
                found.law
            })
            .collect();
        for tension in [10.0, 20.0, 40.0, 70.0] {
            let [short, long] = [0, 1].map(|i| strain_at(&laws[i], tension));
            let ratio = short / long;
            println!(
                "  {direction}, {tension} N/m: strain {:.2} % of 2 cm, {:.2} % of 8 cm, ratio {ratio:.2}",
                100.0 * short,
                100.0 * long
            );
            assert!(ratio > 0.5 && ratio < 2.0, "{direction}: {ratio}");
        }
    }
}

#[test]
fn arches_of_one_fabric_scatter_by_more_than_their_errors() {
    for direction in ["warp", "weft"] {
        let files =
            ["up", "down-1", "down-2"].map(|kind| format!("loop-bend-{kind}-{direction}.csv"));
        let files: Vec<(&str, &str)> = files.iter().map(|file| (&**file, direction)).collect();
        let curves = curves("loop-bending", false, &files);
        let alone: Vec<f64> = curves
            .iter()
            .map(|curve| {
                assert_eq!(curve.test, Test::LoopBending);
                let fit = identify_loop_bending(&[curve], &FitSettings::default());
                let fit = fit.expect("identified").swap_remove(0).fit;
                println!("gauge {:.3} m", curve.gauge.expect("a gauge"));
                print(&fit);
                // The band of the law is a load, of the size of what the law leaves.
                let widest = fit.band.iter().copied().fold(0.0, f64::max);
                assert!(widest > 0.02 * fit.rms && widest < 5.0 * fit.rms, "{widest}, {}", fit.rms);
                value(&fit, "rigidity")
            })
            .collect();
        let up_down = alone[0] / alone[1];
        println!("  {direction}: rigidities {alone:?}, up over down {up_down:.2}");
        // Weight acts on both with opposite signs, and the zero drifts: they differ by a factor of
        // a few.
        assert!(up_down > 0.1 && up_down < 10.0, "{direction}: {up_down}");
    }
}
