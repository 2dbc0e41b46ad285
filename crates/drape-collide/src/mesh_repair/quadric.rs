//! Quadric: mean squared distance to planes, as a function of a point \[GH97\].

use std::ops::Add;

use crate::vector::{Vector, cross, dot, norm, scale, subtract};

/// Sum of squared distances to the planes of triangles, weighted by their areas:
/// `$x^\top A x + 2 b^\top x + c$`.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Quadric {
    /// Upper triangle of the symmetric matrix: xx, xy, xz, yy, yz, zz.
    a: [f64; 6],
    b: Vector,
    c: f64,
    /// Sum of the areas, in m².
    area: f64,
}

impl Quadric {
    /// Returns the quadric of the plane of a triangle, or zero for a triangle without area.
    pub(crate) fn from_triangle([p, q, r]: [Vector; 3]) -> Quadric {
        let doubled = cross(subtract(q, p), subtract(r, p));
        let area = 0.5 * norm(doubled);
        if !(area > 0.0) {
            return Quadric::default();
        }
        let n = scale(doubled, 0.5 / area);
        let d = -dot(n, p);
        let a = [n[0] * n[0], n[0] * n[1], n[0] * n[2], n[1] * n[1], n[1] * n[2], n[2] * n[2]];
        Quadric { a: a.map(|x| area * x), b: scale(n, area * d), c: area * d * d, area }
    }

    /// Returns the mean squared distance of the point `x` from the planes, in m². The result is
    /// never negative.
    pub(crate) fn mean_square(&self, x: Vector) -> f64 {
        let [xx, xy, xz, yy, yz, zz] = self.a;
        let ax = [
            xx * x[0] + xy * x[1] + xz * x[2],
            xy * x[0] + yy * x[1] + yz * x[2],
            xz * x[0] + yz * x[1] + zz * x[2],
        ];
        let sum = dot(x, ax) + 2.0 * dot(self.b, x) + self.c;
        if self.area > 0.0 { (sum / self.area).max(0.0) } else { 0.0 }
    }
}

impl Add for Quadric {
    type Output = Quadric;

    fn add(self, other: Quadric) -> Quadric {
        Quadric {
            a: std::array::from_fn(|k| self.a[k] + other.a[k]),
            b: std::array::from_fn(|k| self.b[k] + other.b[k]),
            c: self.c + other.c,
            area: self.area + other.area,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_value_is_the_squared_distance_to_the_plane() {
        let quadric = Quadric::from_triangle([[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]]);
        for (point, distance) in [([3.0, -2.0, 1.0], 0.0), ([0.4, 0.7, 3.5], 2.5)] {
            let found = quadric.mean_square(point).sqrt();
            assert!((found - distance).abs() < 1e-12, "{found}, not {distance}");
        }
        assert_eq!(Quadric::from_triangle([[1.0; 3]; 3]).mean_square([0.0; 3]), 0.0);
    }
}
