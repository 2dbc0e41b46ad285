//! Shadow of a draped specimen from straight above, in square pixels.
//!
//! Its area gives the drape coefficient, its edge the folds.

use std::f64::consts::TAU;

/// Side of the squares in which the shadow is measured, in m.
const PIXEL: f64 = 5e-4;

/// Parts into which the side of a triangle is split to follow the specimen's edge.
const PARTS: usize = 4;

/// Angles at which the edge is read.
const ANGLES: usize = 720;

/// Triangulated surface: places of its particles in the material and in space.
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
    /// The shadow of the part of a surface that lies within a radius in its material coordinates.
    pub(crate) fn of(
        Surface { triangles, coordinates, positions }: Surface<'_>,
        radius: f64,
    ) -> Self {
        let side = (2.2 * radius / PIXEL).ceil() as usize;
        let mut shadow = Self { side, dark: vec![false; side * side] };
        let material = |weights: [f64; 3], triangle: &[u32; 3]| {
            let mut sum = [0.0; 2];
            for (weight, &corner) in weights.iter().zip(triangle) {
                let [u, v] = coordinates[corner as usize];
                sum = [sum[0] + weight * u, sum[1] + weight * v];
            }
            sum[0].hypot(sum[1])
        };
        let place = |weights: [f64; 3], triangle: &[u32; 3]| {
            let mut sum = [0.0; 2];
            for (weight, &corner) in weights.iter().zip(triangle) {
                let corner = 3 * corner as usize;
                sum =
                    [sum[0] + weight * positions[corner], sum[1] + weight * positions[corner + 2]];
            }
            sum
        };
        for triangle in triangles {
            for part in parts() {
                let mean =
                    [0, 1, 2].map(|k| part.iter().map(|corner| corner[k]).sum::<f64>() / 3.0);
                if material(mean, triangle) <= radius {
                    shadow.darken(part.map(|corner| place(corner, triangle)));
                }
            }
        }
        shadow
    }

    /// The shadow with that of a disc around the middle, of a radius in m.
    pub(crate) fn with_disc(mut self, radius: f64) -> Self {
        let half = 0.5 * self.side as f64;
        for (k, dark) in self.dark.iter_mut().enumerate() {
            let [row, column] = [k / self.side, k % self.side].map(|at| at as f64 + 0.5 - half);
            *dark |= row.hypot(column) * PIXEL <= radius;
        }
        self
    }

    /// Darkens the squares whose middles lie in a triangle.
    fn darken(&mut self, corners: [[f64; 2]; 3]) {
        let half = 0.5 * self.side as f64;
        let [a, b, c] = corners.map(|corner| corner.map(|x| x / PIXEL + half));
        let cross = |p: [f64; 2], q: [f64; 2], r: [f64; 2]| {
            (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
        };
        let sign = cross(a, b, c).signum();
        let range = |axis: usize| {
            let low = a[axis].min(b[axis]).min(c[axis]) - 0.5;
            let high = a[axis].max(b[axis]).max(c[axis]) - 0.5;
            low.ceil().max(0.0) as usize..=(high.floor().max(-1.0) + 1.0) as usize
        };
        for row in range(1) {
            for column in range(0) {
                let point = [column as f64 + 0.5, row as f64 + 0.5];
                let inside =
                    [(a, b), (b, c), (c, a)].iter().all(|&(p, q)| sign * cross(p, q, point) >= 0.0);
                if inside && row < self.side && column < self.side {
                    self.dark[row * self.side + column] = true;
                }
            }
        }
    }

    /// Returns the area of the shadow, in m².
    pub(crate) fn area(&self) -> f64 {
        self.dark.iter().filter(|dark| **dark).count() as f64 * PIXEL * PIXEL
    }

    /// Returns the radius of the outermost dark pixel at each angle, in m.
    pub(crate) fn edge(&self) -> Vec<f64> {
        let half = 0.5 * self.side as f64;
        let radius = |angle: f64| {
            let (sin, cos) = angle.sin_cos();
            let dark = |steps: &usize| {
                let r = *steps as f64 * 0.5;
                let [column, row] = [half + r * cos, half + r * sin].map(|x| x as usize);
                row < self.side && column < self.side && self.dark[row * self.side + column]
            };
            let outermost = (0..self.side).rev().find(dark);
            outermost.unwrap_or(0) as f64 * 0.5 * PIXEL
        };
        (0..ANGLES).map(|k| radius(TAU * k as f64 / ANGLES as f64)).collect()
    }
}

/// The small triangles of a triangle, by the weights of its corners.
fn parts() -> impl Iterator<Item = [[f64; 3]; 3]> {
    let at = |i: usize, j: usize| {
        let [a, b] = [i, j].map(|k| k as f64 / PARTS as f64);
        [1.0 - a - b, a, b]
    };
    (0..PARTS).flat_map(move |i| {
        (0..PARTS - i).flat_map(move |j| {
            let upright = [at(i, j), at(i + 1, j), at(i, j + 1)];
            let turned =
                (i + j + 2 <= PARTS).then(|| [at(i + 1, j + 1), at(i, j + 1), at(i + 1, j)]);
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
        let shadow = Shadow::of(
            Surface { triangles: &triangles, coordinates: &coordinates, positions: &positions },
            0.127,
        );
        assert!((shadow.area() / (PI * 0.127 * 0.127) - 1.0).abs() < 2e-3, "{}", shadow.area());
        let edge = shadow.edge();
        assert!(edge.iter().all(|r| (r - 0.127).abs() < 2e-3), "{edge:?}");
    }
}
