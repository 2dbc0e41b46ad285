//! Reads the frames of a run, and measures how fast the cloth falls.
//!
//! `cargo run --example falling_sheet -p drape-frames`
#![allow(clippy::print_stdout, reason = "an example prints its result")]

use drape_frames::{Recording, curvatures, samples::SampleRun};

/// Standard gravity, in m/s².
const GRAVITY: f64 = 9.806_65;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // A sheet of 200 mm × 100 mm, bent to a cylinder of a radius of 0.5 m, falls for 0.3 s.
    let times = [0.0, 0.1, 0.2, 0.3];
    let sheet = SampleRun::grid([21, 11], 0.01, &times, |[u, v], time| {
        let angle = (u - 0.1) / 0.5;
        [0.5 * angle.sin(), 1.0 + 0.5 * angle.cos() - 0.5 * GRAVITY * time * time, v]
    });
    let folder = tempfile::tempdir()?;
    sheet.write(folder.path())?;

    let recording = Recording::open(folder.path())?;
    let panel = &recording.manifest().panels[0];
    println!("{}: {} vertices, {} triangles", panel.name, panel.vertices, panel.triangles);
    let mean_height = |cloth: &[[f64; 3]]| {
        cloth.iter().map(|position| position[1]).sum::<f64>() / cloth.len() as f64
    };
    let first = mean_height(&recording.frame(0)?.cloth);
    for number in 0..recording.frame_count() {
        let frame = recording.frame(number)?;
        let time = recording.time(number)?;
        let fallen = first - mean_height(&frame.cloth);
        println!("{time:.1} s: fallen by {:.1} mm", 1e3 * fallen);
        assert!((fallen - 0.5 * GRAVITY * time * time).abs() < 1e-12);
    }

    // The middle of the sheet has the curvature of the cylinder, 2 1/m, to its discretisation.
    let last = recording.frame(recording.frame_count() - 1)?;
    let middle = curvatures(&last.cloth, &recording.topology().cloth)?[2 * (5 * 20 + 10)];
    println!("curvature in the middle: {middle:.3} 1/m");
    assert!((middle / 2.0 - 1.0).abs() < 0.01, "{middle} 1/m");
    Ok(())
}
