//! Bends a specimen of a cupro weave in a simulated KES instrument, and compares its loop with that
//! of the laws of the fabric.
//!
//! `cargo run --release -p drape-validate --example bending_test`

#![allow(clippy::print_stdout, reason = "an example prints its result")]

use drape_fabric::Fabric;
use drape_input::Document;
use drape_kes::{Direction, Test};
use drape_validate::instrument::{Comparison, Resolution};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let text = include_str!("../fabrics/cupro-weave.toml");
    let fabric = Fabric::from_document(&Document::new("cupro-weave.toml", text))?;
    let resolution = Resolution { spacing: 0.005, points: 10 };
    let found = Comparison::run(&fabric, Test::Bending, Direction::Weft, resolution)?;
    println!("curvature, 1/cm   moment, mN   of the law, mN");
    let loads = found.measured.load().iter().zip(found.ideal.load());
    for (curvature, (moment, law)) in found.measured.deformation().iter().zip(loads) {
        println!("{:15.2}   {:10.4}   {:14.4}", 0.01 * curvature, 1e3 * moment, 1e3 * law);
    }
    println!("distance of the loops: {:.3} % of the range of moments", 100.0 * found.distance());
    Ok(())
}
