//! Draws a measured loop with a fitted line.
//!
//! `cargo run --release -p drape-report --example measured_loop -- loop.svg` writes the figure to a
//! file. Without an argument the file is in the temporary folder.

#![allow(clippy::print_stdout)]

use std::error::Error;
use std::path::PathBuf;

use drape_report::plot::{Axis, Branch, BranchKind, LoopPlot, Point, loop_svg};

fn main() -> Result<(), Box<dyn Error>> {
    let default = || std::env::temp_dir().join("measured_loop.svg");
    let path = std::env::args().nth(1).map_or_else(default, PathBuf::from);
    std::fs::write(&path, loop_svg(&measured_loop())?)?;
    println!("{}", path.display());
    Ok(())
}

/// Returns a bending loop of the rigidity 40 µN·m with a friction of 2 mN, and the line between.
fn measured_loop() -> LoopPlot {
    let branch = |kind, friction: f64| Branch {
        kind,
        cycle: 1,
        points: (0..=50)
            .map(|k| {
                let curvature = 5.0 * f64::from(k);
                let fitted = 4e-5 * curvature;
                let measured = Some(fitted + friction);
                Point { deformation: curvature, measured, fitted: Some(fitted), band: None }
            })
            .collect(),
    };
    LoopPlot {
        title: "bending, warp".to_owned(),
        deformation: Axis::new("curvature", "1/cm", 100.0),
        load: Axis::new("moment per width", "gf·cm/cm", 9.80665e-3),
        branches: vec![branch(BranchKind::Loading, 2e-3), branch(BranchKind::Unloading, -2e-3)],
        law: "fitted law".to_owned(),
        marks: Vec::new(),
    }
}
