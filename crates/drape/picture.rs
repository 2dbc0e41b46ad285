use drape::report::{Picture, Scene, Surface, View, render};
use drape::scene::Snapshot;

use crate::failure::Failure;

/// Distance between the yarn lines that are drawn, in m, for a cloth of a metre.
const LINE_SPACING: f64 = 0.05;

/// How far below the lowest point of the cloth its floor is, in m.
const FLOOR: f64 = 0.01;

/// Pixels of a picture that stands alone.
pub(crate) const SIZE: [u32; 2] = [1200, 900];

/// Draws a scene as it was, seen from an azimuth and an elevation in degrees, in so many pixels.
pub(crate) fn draw(
    snapshot: &Snapshot,
    [azimuth, elevation]: [Option<f64>; 2],
    [width, height]: [u32; 2],
) -> Result<Picture, Failure> {
    let Snapshot { positions, coordinates, triangles, bodies, spacing } = snapshot;
    let coordinates: Vec<f64> = coordinates.iter().flatten().copied().collect();
    let lowest = positions.chunks_exact(3).map(|p| p[1]).fold(f64::INFINITY, f64::min);
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
