//! KES bending test of a law: the loop over ±2.5 cm⁻¹, and B and 2HB read from it.
//!
//! `cargo run --example bending_loop -p drape-fabric`
#![allow(clippy::print_stdout, reason = "an example prints its result")]

use drape_fabric::{BendingBackbone, BendingLaw, BlimanSorine, Law, drive};

fn main() {
    let law = BendingLaw {
        backbone: BendingBackbone::Linear { rigidity: 1.2e-5 },
        rest_curvature: 0.0,
        friction: BlimanSorine::first_order(6e-4, 4.0).expect("a friction"),
    };

    // Loading to 250 1/m, unloading to −250 1/m and back, read at 50, 100 and 150 1/m on the upper
    // branches of the second cycle.
    let history = [250.0, -250.0, 50.0, 100.0, 150.0, 250.0, 150.0, 100.0, 50.0, -250.0];
    let moments = drive(&law, law.virgin(), &history);
    let (rising, falling) = (&moments[2..5], [moments[8], moments[7], moments[6]]);

    // B: mean slope of both branches between 0.5 and 1.5 cm⁻¹; 2HB: width at 1 cm⁻¹.
    let slope = |branch: &[f64]| (branch[2] - branch[0]) / 100.0;
    let rigidity = 0.5 * (slope(rising) + slope(&falling));
    let width = rising[1] - falling[1];
    // The friction is at its plateau there, so the loop returns the parameters.
    assert!((rigidity / 1.2e-5 - 1.0).abs() < 1e-9, "B = {rigidity:e} N·m");
    assert!((width / (2.0 * 6e-4) - 1.0).abs() < 1e-9, "2HB = {width:e} N");

    // Work lost over the closed cycle: 4 F_c [κ − x_f tanh(κ/x_f)].
    let upper = [250.0, -250.0].iter().fold(law.virgin(), |memory, &k| law.commit(&memory, k));
    let there = law.commit(&upper, 250.0);
    let lost = law.work(&upper, 250.0) + law.work(&there, -250.0);
    let exact = 4.0 * 6e-4 * (250.0 - 4.0 * (250.0_f64 / 4.0).tanh());
    assert!((lost / exact - 1.0).abs() < 1e-9, "{lost} against {exact} J/m²");
    println!("B {rigidity:.3e} N·m, 2HB {width:.3e} N, work per cycle {lost:.4} J/m²");
}
