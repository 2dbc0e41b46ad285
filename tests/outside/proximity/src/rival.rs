//! The same two questions to `parry3d-f64`, whose meshes are rigid.

use std::time::Instant;

use parry3d_f64::math::{Pose, Vector};
use parry3d_f64::query::{ShapeCastOptions, cast_shapes, distance};
use parry3d_f64::shape::TriMesh;

use crate::mesh::BumpySphere;
use crate::{Answer, SHIFT};

/// Returns the mesh of `sphere`.
fn mesh(sphere: &BumpySphere) -> TriMesh {
    let vertices = sphere.positions.iter().map(|[x, y, z]| Vector::new(*x, *y, *z)).collect();
    TriMesh::new(vertices, sphere.triangles.clone()).expect("a mesh")
}

/// Returns the answers for `first` at rest and `second`, which moves, and the shortest time of
/// `repetitions`, in ms.
pub fn answer(first: &BumpySphere, second: &BumpySphere, repetitions: usize) -> (Answer, f64) {
    let [x, y, z] = SHIFT;
    let (still, here) = (Vector::new(0.0, 0.0, 0.0), Pose::identity());
    let options = ShapeCastOptions::with_max_time_of_impact(1.0);
    let mut answer = Answer { distance: f64::NAN, fraction: f64::NAN };
    let mut best = f64::MAX;
    for _ in 0..repetitions {
        let begin = Instant::now();
        let (first, second) = (mesh(first), mesh(second));
        let apart = distance(&here, &first, &here, &second).expect("meshes are supported");
        let velocity = Vector::new(x, y, z);
        let hit = cast_shapes(&here, still, &first, &here, velocity, &second, options);
        let hit = hit.expect("meshes are supported").expect("an impact");
        answer = Answer { distance: apart.distance, fraction: hit.time_of_impact };
        best = best.min(1e3 * begin.elapsed().as_secs_f64());
    }
    (answer, best)
}
