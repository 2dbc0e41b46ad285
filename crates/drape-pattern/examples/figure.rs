//! Cuts a pattern at a spacing in mm and draws the panels:
//! `cargo run --release -p drape-pattern --example figure -- shirt.json 15 shirt.svg`

use std::error::Error;

use drape_pattern::{Cutter, Pattern, figure};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [pattern, spacing, picture] = arguments.as_slice() else {
        return Err("give a pattern, a spacing in mm and the name of the picture".into());
    };
    let pattern = Pattern::read(pattern)?;
    let cut = Cutter::new(0.001 * spacing.parse::<f64>()?).cut(&pattern)?;
    Ok(std::fs::write(picture, figure(&pattern, &cut))?)
}
