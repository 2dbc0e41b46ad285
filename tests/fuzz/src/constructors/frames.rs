//! Frames in memory, with the verifier and the files for other programs.

use drape::export::{Clip, write_glb, write_pc2, write_usda};
use drape::frames::{Frame, Manifest, Recording, SurfacePart, Topology, curvatures};
use drape::verify::Verifier;

use crate::shapes::Source;

fn part(source: &mut Source<'_>, name: &str, vertices: usize, triangles: usize) -> SurfacePart {
    let (vertices, triangles) = (source.length(vertices), source.length(triangles));
    SurfacePart { name: name.into(), vertices, triangles, ..SurfacePart::default() }
}

pub fn recording(source: &mut Source<'_>) {
    let places = source.odd_points(8);
    let count = places.len();
    let cloth = source.triangles(5, count);
    let _ = curvatures(&places, &cloth);
    let manifest =
        Manifest { panels: vec![part(source, "panel", count, cloth.len())], ..Manifest::default() };
    let material = (0..source.length(count)).map(|_| [source.odd(), source.odd()]).collect();
    let topology = Topology { material, cloth, bodies: source.triangles(2, count) };
    let frame = |source: &mut Source<'_>, cloth: Vec<[f64; 3]>| Frame {
        time: source.odd(),
        cloth,
        ..Frame::default()
    };
    let frames = (0..source.below(3)).map(|_| frame(source, places.clone())).collect();
    let Ok(recording) = Recording::of_frames(manifest, topology, frames) else { return };
    let number = source.number(2) as usize;
    let _ = recording.frame(number);
    let _ = recording.time(number);
    let verifier = Verifier::new(recording);
    let _ = verifier.verify(number);
    let _ = verifier.verify(0);
    let recording = verifier.recording();
    if let Ok(clip) = Clip::new(recording, 0..=number.min(4), None) {
        let _ = write_glb(&clip, &mut Vec::new());
        let _ = write_usda(&clip, &mut Vec::new());
        let _ = write_pc2(&clip, &mut Vec::new());
    }
}
