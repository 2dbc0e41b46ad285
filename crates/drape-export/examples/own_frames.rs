//! Exports and verifies the frames of a program of its own, which has no folder of frames.
//!
//! `cargo run --example own_frames -p drape-export`
#![allow(clippy::print_stdout, reason = "an example prints its result")]

use drape_export::{Clip, write_glb, write_pc2, write_usda};
use drape_frames::{Frame, Manifest, Recording, SurfacePart, Topology};
use drape_verify::Verifier;

/// Vertices of the flag along its width and its height.
const COLUMNS: u32 = 31;
const ROWS: u32 = 21;

/// Distance of the vertices, in m.
const SPACING: f64 = 0.02;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // A flag, whose waves run from the pole to its free edge.
    let points = (0..ROWS).flat_map(|row| (0..COLUMNS).map(move |column| [column, row]));
    let material: Vec<[f64; 2]> =
        points.map(|point| point.map(|count| SPACING * f64::from(count))).collect();
    let frame = |time: f64| {
        let position = |[u, v]: [f64; 2]| [u, v, 0.05 * u * (12.0 * u - 9.0 * time).sin()];
        let cloth = material.iter().map(|point| position(*point)).collect();
        Frame { time, cloth, ..Frame::default() }
    };
    let frames: Vec<Frame> = (0..=24).map(|number| frame(f64::from(number) / 24.0)).collect();

    // Its triangles, two for each cell of the grid.
    let cells = (0..ROWS - 1).flat_map(|row| (0..COLUMNS - 1).map(move |column| [column, row]));
    let triangles = cells.flat_map(|[column, row]| {
        let first = row * COLUMNS + column;
        [[first, first + 1, first + COLUMNS], [first + 1, first + COLUMNS + 1, first + COLUMNS]]
    });
    let triangles: Vec<[u32; 3]> = triangles.collect();

    let flag = SurfacePart {
        name: "flag".to_owned(),
        vertices: material.len(),
        triangles: triangles.len(),
        ..SurfacePart::default()
    };
    let manifest = Manifest { panels: vec![flag], ..Manifest::default() };
    let topology = Topology { material, cloth: triangles, bodies: Vec::new() };
    let recording = Recording::of_frames(manifest, topology, frames)?;

    // Formats of other programs, here into memory.
    let clip = Clip::new(&recording, 0..=24, None)?;
    let (mut glb, mut usda, mut pc2) = (Vec::new(), Vec::new(), Vec::new());
    write_glb(&clip, &mut glb)?;
    write_usda(&clip, &mut usda)?;
    write_pc2(&clip, &mut pc2)?;
    println!("GLB {} bytes, USDA {}, PC2 {}", glb.len(), usda.len(), pc2.len());
    assert!(glb.starts_with(b"glTF") && usda.starts_with(b"#usda") && pc2.starts_with(b"POINTCAC"));

    // All pairs of triangles of each frame.
    let verifier = Verifier::new(recording);
    for number in 0..verifier.recording().frame_count() {
        let verdict = verifier.verify(number)?;
        assert!(verdict.holds() && verdict.triangles == 1200, "frame {number}: {verdict:?}");
    }
    println!("25 frames without an intersection");
    Ok(())
}
