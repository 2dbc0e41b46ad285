use std::f64::consts::PI;

use crate::surface::Surface;
use crate::surface_contact::SurfaceContact;
use crate::vector::{Vector, at, cross, dot, norm, subtract};

impl Surface {
    /// Whether a place is in the body of a group: its triangles, seen from behind, then fill the whole sphere of
    /// directions, and else none of it. Those of a floor fill half of it from below, and half of it, seen from in front,
    /// from above.
    pub(crate) fn encloses(&self, group: u32, place: Vector, places: &[f64]) -> bool {
        let own = self.triangles().iter().filter(|corners| self.group(corners[0]) == group);
        let from = |vertex: u32| subtract(at(places, vertex as usize), place);
        let angle: f64 = own.map(|corners| solid_angle(corners.map(from))).sum();
        angle > PI
    }
}

impl SurfaceContact {
    /// Whether a free vertex is in a body, for the free vertices' positions, in m.
    #[must_use]
    pub fn is_inside_body(&self, vertex: usize, positions: &[f64]) -> bool {
        let places = self.all(positions, self.progress);
        let bodies = self.surface.free_count()..self.surface.vertex_count();
        let mut groups: Vec<u32> = bodies.map(|v| self.surface.group(v as u32)).collect();
        groups.dedup();
        groups.iter().any(|&group| self.surface.encloses(group, at(&places, vertex), &places))
    }
}

/// Solid angle of a triangle seen from the origin, its sign the triangle's sense (van Oosterom & Strackee 1983, "The Solid
/// Angle of a Plane Triangle").
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
