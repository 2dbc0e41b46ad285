use drape::report::{Picture, Scene, Surface, View, render};
use drape::scene::Snapshot;

use crate::failure::Failure;

/// Distance between the yarn lines that are drawn, in m, for a cloth of a metre.
const LINE_SPACING: f64 = 0.05;

/// How far below the lowest point of cloth and bodies the floor is, in m.
const FLOOR: f64 = 0.01;

/// From where a garment is seen: from the front, the side and the back, in degrees around the vertical.
const SIDES: [f64; 3] = [0.0, 90.0, 180.0];

/// How high the eye is that sees a garment, in degrees.
const EYE: f64 = 6.0;

/// Pixels of each picture of a garment.
const UPRIGHT: [u32; 2] = [600, 1000];

/// Pixels of a picture that stands alone.
pub(crate) const SIZE: [u32; 2] = [1200, 900];

/// Draws a garment from the front, the side and the back.
pub(crate) fn draw_round(snapshot: &Snapshot) -> Result<Picture, Failure> {
    let side = |azimuth: &f64| draw(snapshot, [Some(*azimuth), Some(EYE)], UPRIGHT);
    let pictures: Result<Vec<Picture>, Failure> = SIDES.iter().map(side).collect();
    Ok(Picture::sheet(&pictures?, SIDES.len()))
}

/// Draws a scene as it was, seen from an azimuth and an elevation in degrees, in so many pixels.
pub(crate) fn draw(
    snapshot: &Snapshot,
    [azimuth, elevation]: [Option<f64>; 2],
    [width, height]: [u32; 2],
) -> Result<Picture, Failure> {
    let Snapshot { positions, coordinates, triangles, bodies, spacing } = snapshot;
    let coordinates: Vec<f64> = coordinates.iter().flatten().copied().collect();
    let bodies_too = bodies.iter().flat_map(|body| &body.positions[..]);
    let all = positions.iter().chain(bodies_too).skip(1).step_by(3);
    let lowest = all.copied().fold(f64::INFINITY, f64::min);
    let size = coordinates.iter().fold(0.0, |size: f64, c| size.max(c.abs()));
    let cloth = Surface::cloth(positions, triangles);
    let scene = Scene {
        cloths: vec![cloth.with_lines(&coordinates, LINE_SPACING * size.max(0.1))],
        bodies: bodies.iter().map(|body| Surface::body(&body.positions, &body.triangles)).collect(),
        floor: Some(lowest - FLOOR),
    };
    let standard = View::default();
    let view = View {
        azimuth_deg: azimuth.unwrap_or(standard.azimuth_deg),
        elevation_deg: elevation.unwrap_or(standard.elevation_deg),
        body_setback: *spacing,
        width,
        height,
        ..standard
    };
    render(&scene, &view).map_err(|error| Failure::Output(error.to_string()))
}
