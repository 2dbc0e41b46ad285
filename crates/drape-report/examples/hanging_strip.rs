//! Draws a hanging strip of cloth in waves, and a measured loop with a fitted line.
//!
//! `cargo run --release -p drape-report --example hanging_strip -- FOLDER` writes `strip.png` and
//! `loop.svg` to a folder; without an argument it takes one in the temporary folder.

#![allow(clippy::print_stdout)]

use std::error::Error;
use std::path::PathBuf;

use drape_report::plot::{Axis, Branch, BranchKind, LoopPlot, Point, loop_svg};
use drape_report::{Picture, Scene, Surface, View, render};

/// Number of cells along each side of the strip.
const CELLS: u32 = 20;

/// Side of a cell, in m.
const SIDE: f64 = 0.02;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().nth(1).map_or_else(std::env::temp_dir, PathBuf::from);
    let folder = folder.join("drape-report");
    std::fs::create_dir_all(&folder)?;
    let (picture, plot) = (folder.join("strip.png"), folder.join("loop.svg"));
    strip()?.save(&picture)?;
    std::fs::write(&plot, loop_svg(&measured_loop())?)?;
    println!("{} and {}", picture.display(), plot.display());
    Ok(())
}

/// Draws the strip above a floor, its warp hanging down, in waves along the weft.
fn strip() -> Result<Picture, drape_report::Error> {
    let (mut positions, mut coordinates, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
    for row in 0..=CELLS {
        for column in 0..=CELLS {
            let [weft, warp] = [column, row].map(|k| SIDE * f64::from(k));
            positions.extend([0.8 * weft, warp, 0.03 * (50.0 * weft).sin()]);
            coordinates.extend([weft, warp]);
            if column < CELLS && row < CELLS {
                let corner = (CELLS + 1) * row + column;
                let above = corner + CELLS + 1;
                triangles.push([corner, corner + 1, above + 1]);
                triangles.push([corner, above + 1, above]);
            }
        }
    }
    let scene = Scene {
        cloths: vec![Surface::cloth(&positions, &triangles).with_lines(&coordinates, 0.04)],
        floor: Some(-0.05),
        ..Scene::default()
    };
    render(&scene, &View { width: 640, height: 480, ..View::default() })
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
