use crate::gap::{Gradient, Hessian};
use crate::vector::{Vector, cross, dot, subtract};

/// What fades the contact of two edges out as they become parallel.
///
/// ```math
/// m = c (2 - c), \qquad c = \min(1, |e_1 \times e_2|^2 / \epsilon)
/// ```
///
/// with the threshold `$\epsilon$` of the pair (Li et al. 2020, "Incremental Potential Contact",
/// eq. 24). Continuous with its gradient; 1 throughout for a vertex and a triangle.
#[derive(Debug, Clone)]
pub(crate) struct Mollifier {
    along: Vector,
    other: Vector,
    threshold: f64,
    /// `$c$`.
    share: f64,
}

impl Mollifier {
    /// Of edges between the first two places and between the last two.
    pub(crate) fn new(places: [Vector; 4], threshold: f64) -> Mollifier {
        let (along, other) = (subtract(places[1], places[0]), subtract(places[3], places[2]));
        let normal = cross(along, other);
        let square = dot(normal, normal);
        let share = if square < threshold { square / threshold } else { 1.0 };
        Mollifier { along, other, threshold, share }
    }

    /// Whether it has any derivative.
    pub(crate) fn is_active(&self) -> bool {
        self.share < 1.0
    }

    pub(crate) fn value(&self) -> f64 {
        self.share * (2.0 - self.share)
    }

    /// Derivative of `$m$`, in 1/m.
    pub(crate) fn gradient(&self) -> Gradient {
        let factor = 2.0 * (1.0 - self.share) / self.threshold;
        self.square_gradient().map(|component| factor * component)
    }

    /// Adds a multiple of the second derivative of `$m$`.
    pub(crate) fn add_hessian(&self, hessian: &mut Hessian, factor: f64) {
        let bend = -2.0 * factor / self.threshold.powi(2);
        let slope = 2.0 * factor * (1.0 - self.share) / self.threshold;
        let gradient = self.square_gradient();
        for (i, row) in hessian.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                *entry += bend * gradient[i] * gradient[j] + slope * self.square_bend(i, j);
            }
        }
    }

    /// Derivative of `$|e_1 \times e_2|^2$`: `$2 (|e_2|^2 e_1 - (e_1 \cdot e_2) e_2)$` by
    /// `$e_1$`, and likewise by `$e_2$`.
    fn square_gradient(&self) -> Gradient {
        let (a, b) = (self.along, self.other);
        let [aa, ab, bb] = [dot(a, a), dot(a, b), dot(b, b)];
        std::array::from_fn(|k| {
            let axis = k % 3;
            let by_edge =
                if k < 6 { bb * a[axis] - ab * b[axis] } else { aa * b[axis] - ab * a[axis] };
            2.0 * SIGNS[k / 3] * by_edge
        })
    }

    /// Second derivative of `$|e_1 \times e_2|^2 = |e_1|^2 |e_2|^2 - (e_1 \cdot e_2)^2$`.
    fn square_bend(&self, row: usize, column: usize) -> f64 {
        let (i, j) = (row % 3, column % 3);
        let same = f64::from(i == j);
        let (a, b) = (self.along, self.other);
        let by_edges = match (row < 6, column < 6) {
            (true, true) => dot(b, b) * same - b[i] * b[j],
            (false, false) => dot(a, a) * same - a[i] * a[j],
            (true, false) => 2.0 * a[i] * b[j] - b[i] * a[j] - dot(a, b) * same,
            (false, true) => 2.0 * b[i] * a[j] - a[i] * b[j] - dot(a, b) * same,
        };
        2.0 * SIGNS[row / 3] * SIGNS[column / 3] * by_edges
    }
}

/// How the ends make up the edges.
const SIGNS: [f64; 4] = [-1.0, 1.0, -1.0, 1.0];
