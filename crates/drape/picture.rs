use drape::report::{Scene, Surface, View, render};
use drape::scene::{Frame, Output, Simulation};

use crate::failure::Failure;

/// Distance between the yarn lines that are drawn, in m, for a cloth of a metre.
const LINE_SPACING: f64 = 0.05;

/// How far below the lowest point of the cloth its floor is, in m.
const FLOOR: f64 = 0.01;

/// Stores a picture of a frame as `picture.png`.
pub(crate) fn draw(
    simulation: &Simulation,
    frame: &Frame,
    view: [Option<f64>; 2],
    output: &Output,
) -> Result<(), Failure> {
    let coordinates: Vec<f64> = simulation.coordinates().iter().flatten().copied().collect();
    let outlines: Vec<_> = simulation
        .contact()
        .bodies()
        .iter()
        .filter(|body| !matches!(body.shape, drape::collide::Shape::Plane))
        .filter_map(|body| body.triangulate().ok())
        .collect();
    let vertices: Vec<Vec<f64>> =
        outlines.iter().map(|outline| outline.vertices.concat()).collect();
    let bodies = vertices.iter().zip(&outlines);
    let lowest = frame.positions.chunks_exact(3).map(|p| p[1]).fold(f64::INFINITY, f64::min);
    let size = coordinates.iter().fold(0.0, |size: f64, c| size.max(c.abs()));
    let cloth = Surface::cloth(&frame.positions, simulation.triangles());
    let scene = Scene {
        cloths: vec![cloth.with_lines(&coordinates, LINE_SPACING * size.max(0.1))],
        bodies: bodies.map(|(v, outline)| Surface::body(v, &outline.triangles)).collect(),
        floor: Some(lowest - FLOOR),
    };
    let [azimuth, elevation] = view;
    let standard = View::default();
    let view = View {
        azimuth_deg: azimuth.unwrap_or(standard.azimuth_deg),
        elevation_deg: elevation.unwrap_or(standard.elevation_deg),
        body_setback: simulation.spacing(),
        ..standard
    };
    let path = output.path("picture.png");
    let stored = render(&scene, &view).and_then(|picture| picture.save(&path));
    stored.map_err(|error| Failure::Output(error.to_string()))
}
