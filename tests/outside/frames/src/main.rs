//! Two flags of a program: their frames become GLB in memory, and the verifier finds the frame in
//! which they pass through each other.

use std::time::Instant;

use drape_export::{Clip, write_glb};
use drape_frames::{Frame, Manifest, Recording, SurfacePart, Topology};
use drape_verify::Verifier;

/// Vertices of a flag along its width and its height, and their distance in m.
const COLUMNS: u32 = 41;
const ROWS: u32 = 25;
const SPACING: f64 = 0.02;

/// Number of frames.
const FRAMES: usize = 21;

/// Returns the distance of the second flag from the first one at their poles in the frame `number`,
/// in m: 5 mm less in each frame. Farther from the poles the flags are farther apart.
fn clearance(number: usize) -> f64 {
    0.0875 - 0.005 * number as f64
}

/// Returns the frame `number`, in which the first flag waves and the second one slants.
fn frame(number: usize, material: &[[f64; 2]]) -> Frame {
    let time = number as f64 / 25.0;
    let waving = |[u, v]: [f64; 2]| [u, v, 0.04 * u * (9.0 * u + v - 8.0 * time).sin()];
    let slanting = |[u, v]: [f64; 2]| [u, v, clearance(number) + 0.25 * u];
    let points = material.iter().copied();
    let cloth = points.clone().map(waving).chain(points.map(slanting)).collect();
    Frame { time, cloth, ..Frame::default() }
}

/// Returns the length of the first chunk of a GLB file, and the text in it.
fn json(glb: &[u8]) -> (usize, &str) {
    let word = |at: usize| u32::from_le_bytes([glb[at], glb[at + 1], glb[at + 2], glb[at + 3]]);
    assert_eq!((&glb[..4], word(4)), (&b"glTF"[..], 2));
    assert_eq!(word(8) as usize, glb.len(), "the header has the length of the file");
    let length = word(12) as usize;
    (length, std::str::from_utf8(&glb[20..20 + length]).expect("JSON is text"))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let begin = Instant::now();
    let points = (0..ROWS).flat_map(|row| (0..COLUMNS).map(move |column| [column, row]));
    let material: Vec<[f64; 2]> =
        points.map(|point| point.map(|count| SPACING * f64::from(count))).collect();
    let frames = (0..FRAMES).map(|number| frame(number, &material)).collect();

    // The second flag has the numbers after the first one.
    let cells = (0..ROWS - 1).flat_map(|row| (0..COLUMNS - 1).map(move |column| [column, row]));
    let corners = cells.flat_map(|[column, row]| {
        let first = row * COLUMNS + column;
        [[first, first + 1, first + COLUMNS], [first + 1, first + COLUMNS + 1, first + COLUMNS]]
    });
    let one: Vec<[u32; 3]> = corners.collect();
    let vertices = material.len();
    let other = one.iter().map(|corners| corners.map(|corner| corner + vertices as u32));
    let part = |name: &str| SurfacePart {
        name: name.to_owned(),
        vertices,
        triangles: one.len(),
        ..SurfacePart::default()
    };
    let manifest = Manifest { panels: vec![part("red"), part("blue")], ..Manifest::default() };
    let topology = Topology {
        material: material.repeat(2),
        cloth: one.iter().copied().chain(other).collect(),
        bodies: Vec::new(),
    };
    let recording = Recording::of_frames(manifest, topology, frames)?;

    let mut glb = Vec::new();
    write_glb(&Clip::new(&recording, 0..=FRAMES - 1, None)?, &mut glb)?;
    let (length, text) = json(&glb);
    assert!(text.contains("\"red\"") && text.contains("\"blue\"") && text.contains("animations"));
    // The binary part has at least the positions of both flags in every frame.
    assert!(glb.len() - length > FRAMES * 2 * vertices * 12, "{} bytes", glb.len());

    // The flags intersect in the frames in which the poles have passed each other.
    let verifier = Verifier::new(recording);
    for number in 0..FRAMES {
        let verdict = verifier.verify(number)?;
        let is_clear = clearance(number) > 0.0;
        assert_eq!(verdict.holds(), is_clear, "frame {number}: {verdict:?}");
        assert_eq!(verdict.intersections == 0, is_clear, "frame {number}: {verdict:?}");
    }
    let milliseconds = 1e3 * begin.elapsed().as_secs_f64();
    println!("{FRAMES} frames in {} bytes of GLB, and verified: {milliseconds:.0} ms", glb.len());
    Ok(())
}
