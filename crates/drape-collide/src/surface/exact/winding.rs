//! Points inside bodies, by the solid angle of their triangles.

use std::f64::consts::PI;

use crate::surface::contact_surface::Surface;
use crate::vector::{Vector, at, cross, dot, norm, subtract};

/// Returns whether `point` is inside the body of `group`, for the flat `positions` of all vertices.
///
/// The triangles of a closed body fill the whole sphere of directions around a point inside, and
/// none of it around a point outside. A floor fills half of the sphere from below, and minus half
/// from above.
pub(crate) fn encloses(surface: &Surface, group: u32, point: Vector, positions: &[f64]) -> bool {
    let triangles = surface.triangles().iter();
    let angle: f64 = triangles
        .filter(|corners| surface.primitives().group(corners[0]) == group)
        .map(|corners| {
            solid_angle(corners.map(|vertex| subtract(at(positions, vertex as usize), point)))
        })
        .sum();
    angle > PI
}

/// Returns the solid angle of the triangle `a`, `b`, `c` seen from the origin, in sr, with the sign
/// of the triangle's orientation \[VOS83\].
fn solid_angle([a, b, c]: [Vector; 3]) -> f64 {
    let [la, lb, lc] = [a, b, c].map(norm);
    let volume = dot(a, cross(b, c));
    2.0 * volume.atan2(la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_face_of_a_cube_fills_a_sixth_of_the_sphere() {
        let corners = [[-1.0, -1.0, 1.0], [1.0, -1.0, 1.0], [1.0, 1.0, 1.0], [-1.0, 1.0, 1.0]];
        let halves = [[0, 1, 2], [0, 2, 3]].map(|t| solid_angle(t.map(|k: usize| corners[k])));
        assert!((halves[0] + halves[1] - 2.0 * PI / 3.0).abs() < 1e-15, "{halves:?}");
        let turned = solid_angle([corners[1], corners[0], corners[2]]);
        assert!((turned + halves[0]).abs() < 1e-15, "{turned}");
    }
}
