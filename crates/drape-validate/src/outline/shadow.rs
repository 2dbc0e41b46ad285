//! Shadow of a draped specimen from straight above, in square pixels.
//!
//! The area of the shadow gives the drape coefficient. The edge of the shadow gives the folds.

use std::f64::consts::TAU;

/// Side of the pixels in which the shadow is measured, in m.
const PIXEL: f64 = 5e-4;

/// Triangulated surface, with material coordinates and positions in space of its particles.
#[derive(Clone, Copy)]
pub(crate) struct Surface<'a> {
    /// Corners of the triangles.
    pub(crate) triangles: &'a [[u32; 3]],
    /// Material coordinates of the particles, in m.
    pub(crate) coordinates: &'a [[f64; 2]],
    /// Positions of the particles, three numbers each, in m.
    pub(crate) positions: &'a [f64],
}

/// Shadow from straight above, in square pixels.
pub(crate) struct Shadow {
    side: usize,
    dark: Vec<bool>,
}

impl Shadow {
    /// Returns the shadow of the part of `surface` that lies within `radius`, in m, of the middle
    /// of the material coordinates.
    pub(crate) fn new(surface: Surface<'_>, radius: f64) -> Self {
        let Surface { triangles, coordinates, positions } = surface;
        let side = (2.2 * radius / PIXEL).ceil() as usize;
        let mut shadow = Self { side, dark: vec![false; side * side] };

        // Triangles at the specimen's edge are split, so that the shadow follows the edge.
        for triangle in triangles {
            let material = triangle.map(|corner| coordinates[corner as usize]);
            let plan = triangle.map(|corner| {
                let first = 3 * corner as usize;
                [positions[first], positions[first + 2]]
            });
            for part in parts() {
                let middle =
                    [0, 1, 2].map(|k| part.iter().map(|corner| corner[k]).sum::<f64>() / 3.0);
                let [u, v] = weighted_sum(middle, material);
                if u.hypot(v) <= radius {
                    shadow.darken(part.map(|corner| weighted_sum(corner, plan)));
                }
            }
        }
        shadow
    }

    /// Returns the shadow together with the shadow of a disc of `radius`, in m, around the middle
    /// of the picture.
    pub(crate) fn with_disc(mut self, radius: f64) -> Self {
        let half = 0.5 * self.side as f64;
        for (k, dark) in self.dark.iter_mut().enumerate() {
            let [row, column] =
                [k / self.side, k % self.side].map(|index| index as f64 + 0.5 - half);
            *dark |= row.hypot(column) * PIXEL <= radius;
        }
        self
    }

    /// Darkens the pixels whose middles lie in the triangle with `corners`, in m.
    fn darken(&mut self, corners: [[f64; 2]; 3]) {
        let half = 0.5 * self.side as f64;
        let [a, b, c] = corners.map(|corner| corner.map(|x| x / PIXEL + half));
        let sign = doubled_area(a, b, c).signum();

        // Only pixels in the box around the triangle are tried.
        let [columns, rows] = [0, 1].map(|axis| {
            let low = a[axis].min(b[axis]).min(c[axis]) - 0.5;
            let high = a[axis].max(b[axis]).max(c[axis]) - 0.5;
            low.ceil().max(0.0) as usize..=(high.floor().max(-1.0) + 1.0) as usize
        });
        for row in rows {
            for column in columns.clone() {
                let point = [column as f64 + 0.5, row as f64 + 0.5];
                let is_inside = [(a, b), (b, c), (c, a)]
                    .iter()
                    .all(|&(p, q)| sign * doubled_area(p, q, point) >= 0.0);
                if is_inside && row < self.side && column < self.side {
                    self.dark[row * self.side + column] = true;
                }
            }
        }
    }

    /// Returns the area of the shadow, in m².
    pub(crate) fn area(&self) -> f64 {
        self.dark.iter().filter(|dark| **dark).count() as f64 * PIXEL * PIXEL
    }

    /// Returns the radius of the shadow's edge at 720 even angles, in m: the distance of the
    /// outermost dark pixel in the direction of each angle.
    pub(crate) fn edge(&self) -> Vec<f64> {
        /// Angles at which the edge is read.
        const ANGLES: usize = 720;
        (0..ANGLES).map(|k| self.edge_radius(TAU * k as f64 / ANGLES as f64)).collect()
    }

    /// Returns the distance of the outermost dark pixel in the direction of `angle`, in m.
    fn edge_radius(&self, angle: f64) -> f64 {
        let half = 0.5 * self.side as f64;
        let (sin, cos) = angle.sin_cos();
        let outermost = (0..self.side).rev().find(|steps| {
            let r = *steps as f64 * 0.5;
            let [column, row] = [half + r * cos, half + r * sin].map(|x| x as usize);
            row < self.side && column < self.side && self.dark[row * self.side + column]
        });
        outermost.unwrap_or(0) as f64 * 0.5 * PIXEL
    }
}

/// Returns the sum of `points`, weighted with `weights`.
fn weighted_sum(weights: [f64; 3], points: [[f64; 2]; 3]) -> [f64; 2] {
    let mut sum = [0.0; 2];
    for (weight, [x, y]) in weights.iter().zip(points) {
        sum = [sum[0] + weight * x, sum[1] + weight * y];
    }
    sum
}

/// Returns twice the signed area of the triangle `p`, `q`, `r`.
fn doubled_area(p: [f64; 2], q: [f64; 2], r: [f64; 2]) -> f64 {
    (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
}

/// Parts into which each side of a triangle is split.
const PARTS: usize = 4;

/// Returns the small triangles into which a triangle is split. Each of their corners is given by
/// its weights at the three corners of the triangle.
fn parts() -> impl Iterator<Item = [[f64; 3]; 3]> {
    // Weights of a point of the grid in the triangle.
    fn weights(i: usize, j: usize) -> [f64; 3] {
        let [a, b] = [i, j].map(|k| k as f64 / PARTS as f64);
        [1.0 - a - b, a, b]
    }

    (0..PARTS).flat_map(move |i| {
        (0..PARTS - i).flat_map(move |j| {
            let upright = [weights(i, j), weights(i + 1, j), weights(i, j + 1)];
            let turned = (i + j + 2 <= PARTS)
                .then(|| [weights(i + 1, j + 1), weights(i, j + 1), weights(i + 1, j)]);
            std::iter::once(upright).chain(turned)
        })
    })
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    #[test]
    fn the_shadow_of_a_flat_disc_is_the_disc() {
        // One square sheet of two triangles around it.
        let corners = [[-0.15, -0.15], [0.15, -0.15], [0.15, 0.15], [-0.15, 0.15]];
        let count = 40;
        let mut coordinates = Vec::new();
        let mut triangles = Vec::new();
        for i in 0..=count {
            for j in 0..=count {
                let at = |k: usize| corners[0][0] + 0.3 * k as f64 / count as f64;
                coordinates.push([at(i), at(j)]);
            }
        }
        for i in 0..count {
            for j in 0..count {
                let corner = |a: usize, b: usize| ((i + a) * (count + 1) + j + b) as u32;
                triangles.push([corner(0, 0), corner(1, 0), corner(1, 1)]);
                triangles.push([corner(0, 0), corner(1, 1), corner(0, 1)]);
            }
        }
        let positions: Vec<f64> = coordinates.iter().flat_map(|&[u, v]| [u, 0.0, -v]).collect();
        let shadow = Shadow::new(
            Surface { triangles: &triangles, coordinates: &coordinates, positions: &positions },
            0.127,
        );
        assert!((shadow.area() / (PI * 0.127 * 0.127) - 1.0).abs() < 2e-3, "{}", shadow.area());
        let edge = shadow.edge();
        assert!(edge.iter().all(|r| (r - 0.127).abs() < 2e-3), "{edge:?}");
    }
}
