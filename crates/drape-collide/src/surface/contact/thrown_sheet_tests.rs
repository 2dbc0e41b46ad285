//! A sheet thrown at a plate shows what each safeguard of the step filter prevents.

use super::{PinchPolicy, SurfaceContact, SurfaceSettings, SurfaceStart};
use crate::surface::step_filter::Safeguards;
use crate::{Body, ContactDistances, Pose, Shape, Surface, SurfaceParts, SurfaceTrial};

/// Vertices along a side of the sheet.
const SIDE: usize = 11;

/// Displacement of a trial step, in m.
const STEP: f64 = 0.06;

/// Number of trial steps.
const STEPS: usize = 30;

/// Result of a throw.
#[derive(Debug)]
struct ThrowResult {
    /// Whether a step went through the plate or into it.
    intersects: bool,
    /// Smallest distance that a vertex fell, in m.
    least_displacement: f64,
}

/// Returns a slanting sheet over a plate, and the positions of the sheet's and the plate's
/// vertices, in m.
fn sheet_over_plate() -> (Surface, Vec<f64>, Vec<f64>) {
    let plate = Shape::Box { half_extents: [0.15, 0.0005, 0.15], edge_radius: 0.0 };
    let plate = Body::new("plate", plate, Pose::new([0.0, -0.08, 0.0])).triangulate().unwrap();
    let spacing = 0.01;
    let along_side = |k: usize| spacing * (k as f64 - 0.5 * (SIDE - 1) as f64);
    let vertices = (0..SIDE * SIDE).map(|v| [along_side(v % SIDE), along_side(v / SIDE)]);
    let flat: Vec<f64> = vertices.clone().flat_map(|[x, z]| [x, 0.0, z]).collect();
    let positions: Vec<f64> = vertices.flat_map(|[x, z]| [x, 0.3 * x + 0.2 * z, z]).collect();
    let cells = (0..SIDE * (SIDE - 1)).filter(|k| k % SIDE < SIDE - 1).map(|k| k as u32);
    let row = SIDE as u32;
    let mut triangles: Vec<[u32; 3]> =
        cells.flat_map(|a| [[a, a + row, a + 1], [a + 1, a + row, a + row + 1]]).collect();
    let free = SIDE * SIDE;
    triangles.extend(plate.triangles.iter().map(|t| t.map(|corner| corner + free as u32)));
    let bodies = plate.vertices.as_flattened().to_vec();
    let surface = Surface::new(SurfaceParts {
        rest_positions: [flat, bodies.clone()].concat(),
        triangles,
        areas: vec![spacing * spacing; free + plate.vertices.len()],
        groups: (0..free + plate.vertices.len()).map(|v| u32::from(v >= free)).collect(),
        distances: vec![ContactDistances { activation_distance: 3e-4, min_separation: 1e-4 }; 2],
        free_vertices: free,
        seam_pairs: Vec::new(),
        ties: Vec::new(),
    });
    (surface.unwrap(), positions, bodies)
}

/// Throws the sheet in trial steps that only the filter with `safeguards` limits.
fn throw(safeguards: Safeguards) -> ThrowResult {
    let (surface, start, bodies) = sheet_over_plate();
    let settings = SurfaceSettings {
        stiffness: 1e8,
        sticking_displacement: SurfaceSettings::STICKING_DISPLACEMENT,
        friction_coefficients: vec![0.0; 4],
        pinch: PinchPolicy::Error,
    };
    let mut contact = SurfaceContact::new(surface, settings, bodies.clone()).unwrap();
    contact.limiter.filter.safeguards = safeguards;
    let mut step = contact.begin(SurfaceStart::new(&start, &bodies)).unwrap();
    let mut positions = start.clone();
    let mut intersects = false;
    for _ in 0..STEPS {
        let mut displacements: Vec<f64> =
            (0..positions.len()).map(|k| if k % 3 == 1 { -STEP } else { 0.0 }).collect();
        step.limit(SurfaceTrial {
            start: &positions,
            displacements: &mut displacements,
            held: &[],
            obstacle_time: 0.0,
            obstacle_advance: &mut 0.0,
        })
        .unwrap();
        positions.iter_mut().zip(&displacements).for_each(|(x, dx)| *x += dx);
        intersects |= !step.intersections(&positions).unwrap().is_empty();
    }
    let moved = positions.iter().zip(&start).skip(1).step_by(3).map(|(end, start)| start - end);
    ThrowResult { intersects, least_displacement: moved.fold(f64::INFINITY, f64::min) }
}

#[test]
fn with_all_safeguards_the_sheet_comes_to_the_plate_and_never_intersects_it() {
    let end = throw(Safeguards::default());
    assert!(!end.intersects && end.least_displacement > 0.04, "{end:?}");
}

#[test]
fn without_swept_detection_the_drift_budget_stops_the_sheet() {
    let old_pairs = Safeguards { swept_detection: false, ..Safeguards::default() };
    let end = throw(old_pairs);
    assert!(!end.intersects && end.least_displacement < 0.01, "{end:?}");
    let end = throw(Safeguards { drift_budget: false, ..old_pairs });
    assert!(end.intersects, "{end:?}");
}

#[test]
fn without_the_freeze_of_pairs_without_room_they_intersect() {
    let end = throw(Safeguards { freeze: false, ..Safeguards::default() });
    assert!(end.intersects, "{end:?}");
}
