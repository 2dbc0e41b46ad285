//! Distance and time of impact of two bumpy spheres with `drape-collide`.

mod mesh;
#[cfg(feature = "rival")]
mod rival;

use std::time::Instant;

use drape_collide::{Error, ProximityMesh, earliest_impact, mesh_distance};
use mesh::BumpySphere;

/// Tolerance of the fraction of the motion.
const TOLERANCE: f64 = 1e-6;

/// Number of repetitions. The fastest counts.
const REPETITIONS: usize = 5;

/// Displacement of the second mesh, in m: past the first one, which it grazes.
const SHIFT: [f64; 3] = [-3.0, 0.9, 0.4];

/// Distance of two meshes in m, and fraction of the motion at which they meet.
struct Answer {
    distance: f64,
    fraction: f64,
}

/// Returns the answers for the mesh `first` at rest and the mesh `second`, which moves.
fn answer(first: &BumpySphere, second: &BumpySphere) -> Result<Answer, Error> {
    let still = ProximityMesh::new(&first.positions, &first.triangles)?;
    let moving = ProximityMesh::new(&second.positions, &second.triangles)?;
    let nearest = mesh_distance(&still, &moving);

    let end = second.shifted(1.0);
    let impact = earliest_impact(&still.at_rest(), &moving.moving_to(&end)?, TOLERANCE)?;
    let fraction = impact.expect("the second sphere moves into the first").fraction;

    // The two nearest points are as far apart as the answer says.
    let [p, q] = nearest.points;
    let apart = (0..3).map(|k| (p[k] - q[k]).powi(2)).sum::<f64>().sqrt();
    assert!((apart - nearest.distance).abs() < 1e-14, "{nearest:?}");
    Ok(Answer { distance: nearest.distance, fraction })
}

fn main() -> Result<(), Error> {
    let first = BumpySphere::new(80, 0.0, [0.0; 3]);
    let second = BumpySphere::new(80, 1.3, [2.3, -0.2, 0.1]);
    let mut best = f64::MAX;
    let mut result = answer(&first, &second)?;
    for _ in 0..REPETITIONS {
        let begin = Instant::now();
        result = answer(&first, &second)?;
        best = best.min(1e3 * begin.elapsed().as_secs_f64());
    }

    // At the impact the meshes do not touch yet, and are as near as the tolerance allows.
    let still = ProximityMesh::new(&first.positions, &first.triangles)?;
    let arrived = ProximityMesh::new(&second.shifted(result.fraction), &second.triangles)?;
    let gap = mesh_distance(&still, &arrived).distance;
    let path = SHIFT.iter().map(|shift| shift * shift).sum::<f64>().sqrt();
    assert!(gap > 0.0 && gap <= path * TOLERANCE, "{gap} m apart at the impact");
    print!(
        "{} triangles each, {:.4} m apart, impact at {:.4}: {best:.1} ms",
        first.triangles.len(),
        result.distance,
        result.fraction
    );

    #[cfg(feature = "rival")]
    {
        let (rival, milliseconds) = rival::answer(&first, &second, REPETITIONS);
        assert!((rival.distance - result.distance).abs() < 1e-12, "distance {}", rival.distance);
        assert!((rival.fraction - result.fraction).abs() < 2.0 * TOLERANCE, "{}", rival.fraction);
        print!("; parry3d-f64: {milliseconds:.1} ms");
    }
    println!();
    Ok(())
}
