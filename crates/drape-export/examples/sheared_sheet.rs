//! Exports a run as an animation for other programs, and as a page; maps the shear of its cloth.
//!
//! `cargo run --example sheared_sheet -p drape-export`
#![allow(clippy::print_stdout, reason = "an example prints its result")]

use std::fs::File;

use drape_export::{Clip, Field, Fields, write_glb, write_usda};
use drape_frames::{Recording, samples::SampleRun};

/// Sine of the angle by which the sheet is sheared each second.
const RATE: f64 = 0.1;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // A sheet of 200 mm × 200 mm, whose warp leans over more in each frame.
    let times = [0.0, 0.5, 1.0];
    let sheet = SampleRun::grid([21, 21], 0.01, &times, |[u, v], time| {
        let sine = RATE * time;
        [u + sine * v, 0.0, (1.0 - sine * sine).sqrt() * v]
    });
    let folder = tempfile::tempdir()?;
    sheet.write(folder.path())?;
    let recording = Recording::open(folder.path())?;

    let clip = Clip::new(&recording, 0..=2, None)?;
    let path = folder.path().join("sheet.usda");
    write_usda(&clip, File::create(&path)?)?;
    let text = std::fs::read_to_string(&path)?;
    assert!(text.contains("metersPerUnit = 1") && text.contains("upAxis = \"Y\""));
    println!("sheet.usda: {} bytes", text.len());

    let mut glb = Vec::new();
    write_glb(&clip, &mut glb)?;
    let length = u32::from_le_bytes(glb[8..12].try_into()?);
    assert_eq!((&glb[..4], length as usize), (&b"glTF"[..], glb.len()));
    println!("sheet.glb: {length} bytes");

    // The field of shear is the angle between the yarns, in the unit that the field names.
    let last = recording.frame(2)?;
    let shear = Fields::new(&recording).values(Field::Shear, &last, None).ok_or("no shear")?;
    let [least, most] = Field::Shear.range(std::slice::from_ref(&shear));
    println!("{}: {least:.3} to {most:.3} {}", Field::Shear.label(), Field::Shear.unit());
    let expected = RATE.asin().to_degrees();
    assert!(shear.iter().all(|angle| (angle.abs() - expected).abs() < 1e-9), "{expected}");
    Ok(())
}
