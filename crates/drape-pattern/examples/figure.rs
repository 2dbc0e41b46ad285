//! Cuts a pattern and draws its panels.
//!
//! `cargo run --release -p drape-pattern --example figure -- shirt.json 15 shirt.svg` reads a
//! pattern, cuts it at a spacing in mm and writes the drawing; without arguments it takes the shirt
//! that ships with the crate, 15 mm and a file in the temporary folder.

#![allow(clippy::print_stdout)]

use std::error::Error;

use drape_pattern::{Cutter, Pattern, Quality, figure};

fn main() -> Result<(), Box<dyn Error>> {
    let shirt = concat!(env!("CARGO_MANIFEST_DIR"), "/patterns/shirt.json");
    let drawing = std::env::temp_dir().join("drape-pattern-shirt.svg");
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (pattern, spacing, drawing) = match arguments.as_slice() {
        [] => (shirt, "15", drawing.as_path()),
        [pattern, spacing, drawing] => (pattern.as_str(), spacing.as_str(), drawing.as_ref()),
        _ => return Err("give a pattern, a spacing in mm and the name of the drawing".into()),
    };
    let pattern = Pattern::read(pattern)?;
    let cut = Cutter::new(0.001 * spacing.parse::<f64>()?).cut(&pattern)?;
    // Cells and triangles together fill the panels, but for the chords across curved edges.
    for (panel, own) in pattern.panels().iter().zip(&cut.panels) {
        let quality = Quality::new(panel, own, cut.spacing);
        assert!(quality.area_error.abs() < 5e-3, "{}: {quality:?}", panel.name());
    }
    std::fs::write(drawing, figure(&pattern, &cut))?;
    let (panels, particles) = (cut.panels.len(), cut.particle_count());
    println!("{panels} panels, {particles} particles when sewn: {}", drawing.display());
    Ok(())
}
