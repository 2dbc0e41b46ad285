//! The stiffness of surfaces in contact against differences of their forces.

use crate::sheets::{ALL, Between, DISTANCES, SPACING, level, sheets, surface};
use drape_collide::{PinchPolicy, SurfaceContact, SurfaceSettings, SurfaceStart};

const STICK: f64 = 1e-4;

/// Of the differences, in m.
const STEP: f64 = 1e-9;

/// Sum of the forces on the free sheet when all of it is moved by a displacement.
fn pull(contact: &mut SurfaceContact, positions: &[f64], displacement: [f64; 3]) -> [f64; 3] {
    let moved: Vec<f64> =
        positions.iter().zip(displacement.iter().cycle()).map(|(x, w)| x + w).collect();
    let mut forces = vec![0.0; moved.len()];
    contact.energy(&moved).unwrap().add_forces(&mut forces).unwrap();
    let mut sum = [0.0; 3];
    for force in forces.chunks(3) {
        sum = [0, 1, 2].map(|k| sum[k] + force[k]);
    }
    sum
}

/// Sum of all blocks: what a sheet that is moved as a whole meets.
fn sum_of_blocks(contact: &mut SurfaceContact, positions: &[f64]) -> [f64; 9] {
    let mut sum = [0.0; 9];
    contact.energy(positions).unwrap().add_stiffness(&mut |[i, j], block| {
        for (k, sum) in sum.iter_mut().enumerate() {
            *sum += block[k];
            if i != j {
                *sum += block[3 * (k % 3) + k / 3];
            }
        }
    });
    sum
}

/// A flat sheet over a flat body neither turns nor bends the distances of its pairs, so what
/// `add_stiffness` leaves out is zero for its motion as a whole: up and down against the barrier,
/// and along against friction that holds or slides.
#[test]
fn a_flat_sheet_meets_the_derivative_of_its_forces() {
    let (side, spacing) = (6, 5e-3);
    let mut parts = sheets(2, side, spacing);
    parts.free_vertices = side * side;
    let bodies = parts.rest_positions[3 * parts.free_vertices..].to_vec();
    let settings = SurfaceSettings {
        stiffness: 1e9,
        sticking_displacement: STICK,
        friction_coefficients: vec![0.4; 4],
        pinch: PinchPolicy::Error,
    };
    let height = 2.0 * DISTANCES.min_separation
        + 0.36 * (2.0 * DISTANCES.activation_distance - 2.0 * DISTANCES.min_separation);
    // No vertex is within activation distance of an edge that it is not over: all pairs push
    // straight up.
    let offset = [0.45 * spacing, 0.2 * spacing, height];
    let start: Vec<f64> = bodies.iter().zip(offset.iter().cycle()).map(|(x, o)| x + o).collect();
    for (slip, slides) in [([0.3 * STICK, -0.2 * STICK], false), ([2.0 * STICK, 1.5 * STICK], true)]
    {
        let mut contact =
            SurfaceContact::new(surface(&parts), settings.clone(), bodies.clone()).unwrap();
        contact.begin(SurfaceStart::new(&start, &bodies)).unwrap();
        let displacement = [slip[0], slip[1], 0.0];
        let positions: Vec<f64> =
            start.iter().zip(displacement.iter().cycle()).map(|(x, w)| x + w).collect();
        let stiffness = sum_of_blocks(&mut contact, &positions);
        let size = stiffness[8];
        assert!(size > 0.0 && contact.pairs().summary().touching > 50);
        for axis in 0..3 {
            let displacements =
                [STEP, -STEP].map(|step| [0, 1, 2].map(|k| if k == axis { step } else { 0.0 }));
            let [ahead, behind] =
                displacements.map(|displacement| pull(&mut contact, &positions, displacement));
            for k in 0..3 {
                let slope = (behind[k] - ahead[k]) / (2.0 * STEP);
                let entry = stiffness[3 * k + axis];
                assert!((slope - entry).abs() < 1e-5 * size, "{k} by {axis}: {entry}, not {slope}");
            }
        }
        // Along the slip a pair that slides resists no more than it does already, and across it
        // does.
        let along = [0, 1].map(|k| stiffness[3 * k] * slip[0] + stiffness[3 * k + 1] * slip[1]);
        let across = stiffness[0] * slip[1] * slip[1] - 2.0 * stiffness[1] * slip[0] * slip[1]
            + stiffness[4] * slip[0] * slip[0];
        let resists = along.iter().any(|force| force.abs() > 1e-9 * size * STICK);
        assert!(across > 0.0 && resists != slides, "along {along:?}, across {across}");
    }
}

#[test]
fn bodies_have_no_stiffness_of_their_own() {
    // The sheet is beyond the first corner of the first plate.
    let mut between = Between::new(PinchPolicy::Error, 1.2 * SPACING, [-4e-4, 4e-4]);
    let lower = between.contact.state().body_positions().chunks(3).take(8).map(|corner| corner[1]);
    let [first, middle] = [lower.clone().next().unwrap(), lower.sum::<f64>() / 8.0];
    let height = first + 3e-4 * (first - middle).signum();
    let mut blocks = 0;
    between.contact.energy(&level(height)).unwrap().add_stiffness(&mut |vertices, _| {
        assert!(vertices.iter().all(|&vertex| vertex < ALL), "{vertices:?}");
        blocks += 1;
    });
    assert!(blocks > ALL, "{blocks}");
}
