//! Mollifier of the contact of two edges.

use crate::vector::{Vector, cross, dot, subtract};

/// Mollifier: factor that fades out the contact of two edges as they become parallel.
///
/// ```math
/// m = c (2 - c), \qquad c = \min(1, |e_1 \times e_2|^2 / \epsilon)
/// ```
///
/// with the threshold `$\epsilon$` of the pair \[Li20, eq. 24\]. The factor is continuous with its
/// gradient. For a vertex and a triangle it is 1 throughout.
#[derive(Debug, Clone)]
pub(crate) struct Mollifier {
    /// Vector `$e_1$` of the first edge, in m.
    first: Vector,
    /// Vector `$e_2$` of the second edge, in m.
    second: Vector,
    threshold: f64,
    /// Fraction `$c$`.
    fraction: f64,
}

impl Mollifier {
    /// Returns the mollifier of the edges between the first two and the last two `points`.
    pub(crate) fn new(points: [Vector; 4], threshold: f64) -> Mollifier {
        let (first, second) = (subtract(points[1], points[0]), subtract(points[3], points[2]));
        let normal = cross(first, second);
        let square = dot(normal, normal);
        let fraction = if square < threshold { square / threshold } else { 1.0 };
        Mollifier { first, second, threshold, fraction }
    }

    /// Returns whether the factor varies.
    pub(crate) fn is_active(&self) -> bool {
        self.fraction < 1.0
    }

    /// Returns the value `$m$`.
    pub(crate) fn value(&self) -> f64 {
        self.fraction * (2.0 - self.fraction)
    }

    /// Returns the derivative of `$m$` with respect to the coordinates of the four ends, in 1/m.
    pub(crate) fn gradient(&self) -> [f64; 12] {
        let factor = 2.0 * (1.0 - self.fraction) / self.threshold;
        self.square_gradient().map(|component| factor * component)
    }

    /// Adds `factor` times the second derivative of `$m$` to `hessian`.
    pub(crate) fn add_hessian(&self, hessian: &mut [[f64; 12]; 12], factor: f64) {
        let curvature = -2.0 * factor / self.threshold.powi(2);
        let slope = 2.0 * factor * (1.0 - self.fraction) / self.threshold;
        let gradient = self.square_gradient();
        for (i, row) in hessian.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                *entry += curvature * gradient[i] * gradient[j] + slope * self.square_hessian(i, j);
            }
        }
    }

    /// Returns the derivative of `$|e_1 \times e_2|^2$`. With respect to `$e_1$` it is
    /// `$2 (|e_2|^2 e_1 - (e_1 \cdot e_2) e_2)$`, and likewise for `$e_2$`.
    fn square_gradient(&self) -> [f64; 12] {
        let (a, b) = (self.first, self.second);
        let [aa, ab, bb] = [dot(a, a), dot(a, b), dot(b, b)];
        std::array::from_fn(|k| {
            let axis = k % 3;
            let by_edge =
                if k < 6 { bb * a[axis] - ab * b[axis] } else { aa * b[axis] - ab * a[axis] };
            2.0 * SIGNS[k / 3] * by_edge
        })
    }

    /// Returns the entry at `row` and `column` of the second derivative of
    /// `$|e_1 \times e_2|^2 = |e_1|^2 |e_2|^2 - (e_1 \cdot e_2)^2$`.
    fn square_hessian(&self, row: usize, column: usize) -> f64 {
        let (i, j) = (row % 3, column % 3);
        let same = f64::from(i == j);
        let (a, b) = (self.first, self.second);
        let by_edges = if row < 6 && column < 6 {
            dot(b, b) * same - b[i] * b[j]
        } else if row >= 6 && column >= 6 {
            dot(a, a) * same - a[i] * a[j]
        } else if row < 6 {
            2.0 * a[i] * b[j] - b[i] * a[j] - dot(a, b) * same
        } else {
            2.0 * b[i] * a[j] - a[i] * b[j] - dot(a, b) * same
        };
        2.0 * SIGNS[row / 3] * SIGNS[column / 3] * by_edges
    }
}

/// Signs of the four ends in the two edge vectors.
const SIGNS: [f64; 4] = [-1.0, 1.0, -1.0, 1.0];
