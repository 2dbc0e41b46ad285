//! From the text of a bending test to a law, and from the law to moments that were not measured.

use std::path::Path;
use std::time::Instant;

use drape_fabric::{Law, drive};
use drape_fit::{FitSettings, identify_bending};
use drape_kes::{Direction, SheetDraft, Test};

/// Bending rigidity in gf·cm²/cm, plateau of the friction in gf·cm/cm, and length of the friction
/// in 1/cm.
const TRUTH: [f64; 3] = [0.12, 0.05, 0.04];

/// Units of moments per width and of curvatures, in SI.
const MOMENT: f64 = 9.806_65e-3;
const CURVATURE: f64 = 100.0;

/// Moment that follows a curvature with Dahl friction, as an instrument would measure it.
#[derive(Default)]
struct Specimen {
    curvature: f64,
    friction: f64,
}

impl Specimen {
    /// Bends the specimen to `curvature`, in 1/cm, and returns its moment, in gf·cm/cm.
    fn bend(&mut self, curvature: f64) -> f64 {
        let [rigidity, plateau, length] = TRUTH;
        let path = curvature - self.curvature;
        let limit = plateau * path.signum();
        self.friction = limit + (self.friction - limit) * (-path.abs() / length).exp();
        self.curvature = curvature;
        rigidity * curvature + self.friction
    }
}

/// Returns the table of a cycle between ±2.5 1/cm, with the digits of an export.
fn table() -> String {
    let mut text = String::from("Curvature (1/cm);Moment (gf.cm/cm)\n");
    let mut specimen = Specimen::default();
    let steps = (0..=100).chain((-100..100).rev()).chain(-99..=0);
    for curvature in steps.map(|step| 0.025 * f64::from(step)) {
        text += &format!("{curvature:.3};{:.4}\n", specimen.bend(curvature));
    }
    text
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let text = table();
    let begin = Instant::now();
    let drafts = SheetDraft::from_bytes("bending-warp.csv", text.as_bytes())?;
    let sheet = drafts[0].read(Path::new(""))?;
    let curve = sheet.curves_of(Test::Bending, Direction::Warp).next().ok_or("a curve")?;
    let law = identify_bending(curve, &FitSettings::default())?.law;

    // Small cycles about a bend, which no test had.
    let history = [1.0, 0.7, 1.0, 0.85, 2.0, -0.3];
    let moments = drive(&law, law.virgin(), &history.map(|curvature| CURVATURE * curvature));
    let milliseconds = 1e3 * begin.elapsed().as_secs_f64();

    let mut specimen = Specimen::default();
    for (moment, curvature) in moments.iter().zip(history) {
        let truth = MOMENT * specimen.bend(curvature);
        let error = (moment - truth).abs() / (MOMENT * TRUTH[1]);
        assert!(error < 2e-3, "{moment} N at {curvature} 1/cm, not {truth} N");
    }
    println!(
        "{} points became a law, whose moments are right: {milliseconds:.1} ms",
        curve.load().len()
    );
    Ok(())
}
