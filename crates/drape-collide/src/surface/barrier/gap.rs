//! Gap of a pair: its distance above the minimum separation, and the energy of its contact.

use super::mollifier::Mollifier;
use crate::barrier::Barrier;
use crate::error::Error;
use crate::surface::distance::ClosestPoints;
use crate::surface::pair::{Pair, closest, distance};
use crate::vector::{dot, scale, subtract};

/// Derivative with respect to the twelve coordinates of a pair's four vertices.
pub type Gradient = [f64; 12];

/// Second derivatives with respect to the twelve coordinates, row by row.
pub type Hessian = [[f64; 12]; 12];

/// Gauss–Newton part `$c\,D D^T$` of a second derivative, positive semidefinite.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GaussNewton {
    /// Factor `$c$`, in N/m, never negative.
    pub factor: f64,
    /// Gradient `$D$` of the distance, without unit.
    pub distance_gradient: Gradient,
}

/// Squared sine of the smallest angle between edges that their coordinates resolve.
const PARALLEL: f64 = 1e-28;

/// Gap of a [`Pair`] at given positions, and the energy of its contact.
///
/// With the distance `$d$`, the minimum separation `$\xi$`, the activation distance `$\hat d$` and
/// the area `$A$` of the pair,
///
/// ```math
/// E = k\,A\,m\,b(d - \xi), \qquad
/// b(g) = \tfrac12 (\hat g - g)^2 \;\; (\hat g/2 \le g < \hat g), \qquad
/// b(g) = -\tfrac14 \hat g^2 (\ln(2g/\hat g) - \tfrac12) \;\; (0 < g < \hat g/2)
/// ```
///
/// with `$\hat g = \hat d - \xi$` and the stiffness `$k$` in N/m³ \[Che25\]. The mollifier `$m$`
/// fades out two edges as they become parallel, where their closest points would jump
/// \[Li20, §5\]. The sum over all pairs of vertices with triangles and of edges is continuous with
/// its gradient, whatever features the closest points lie on. A closed gap, `$d \le \xi$`, has an
/// infinite energy, and derivatives that are not finite.
#[derive(Debug, Clone)]
pub struct Gap {
    closest: ClosestPoints,
    distance: f64,
    normal: [f64; 3],
    min_separation: f64,
    area: f64,
    barrier: Barrier,
    mollifier: Mollifier,
    /// Edges along which the closest points slide, in m.
    edges: [[f64; 3]; 2],
}

impl Gap {
    /// Returns the gap of `pair` at the flat `positions`, in m.
    ///
    /// # Errors
    ///
    /// A vertex of `pair` has no position.
    pub fn new(pair: &Pair, positions: &[f64]) -> Result<Gap, Error> {
        pair.check_positions(positions)?;
        Ok(Gap::at(pair, positions))
    }

    /// Returns the gap of `pair` at the flat `positions` of all vertices, in m.
    pub(crate) fn at(pair: &Pair, positions: &[f64]) -> Gap {
        let points = pair.points(positions);
        let closest = closest(pair.kind, points);
        let distance = distance(&closest);
        let normal = if distance > 0.0 { scale(closest.offset, 1.0 / distance) } else { [0.0; 3] };
        let edges = closest
            .slides
            .map(|[from, to]: [u8; 2]| subtract(points[to as usize], points[from as usize]));
        Gap {
            distance,
            normal,
            min_separation: pair.min_separation,
            area: pair.area,
            barrier: Barrier::strict(pair.activation_distance - pair.min_separation),
            mollifier: Mollifier::new(points, pair.parallel),
            edges,
            closest,
        }
    }

    /// Returns the distance `$d$` of the closest points, in m.
    #[must_use]
    pub fn distance(&self) -> f64 {
        self.distance
    }

    /// Returns the clearance: the distance above the minimum separation, `$g = d - \xi$`, in m.
    #[must_use]
    pub fn clearance(&self) -> f64 {
        self.distance - self.min_separation
    }

    /// Returns the unit normal `$n$` from the closest point of the second primitive to the closest
    /// point of the first. It is zero if the primitives touch.
    #[must_use]
    pub fn normal(&self) -> [f64; 3] {
        self.normal
    }

    /// Returns the weights `$w_i$` of the vertices, with `$\sum w_i x_i = d\,n$`. The weights of
    /// the first primitive sum to 1, the weights of the second to -1.
    #[must_use]
    pub fn weights(&self) -> [f64; 4] {
        self.closest.weights
    }

    /// Returns the energy for `stiffness`, in N/m³. The energy is in J.
    #[must_use]
    pub fn energy(&self, stiffness: f64) -> f64 {
        let fade = self.mollifier.value();
        // Parallel edges do not repel each other, however near: infinity times zero would be NaN.
        if fade == 0.0 {
            return 0.0;
        }
        stiffness * self.area * fade * self.barrier.energy(self.clearance())
    }

    /// Returns the normal force for `stiffness`, in N, as the load of friction. The mollifier's
    /// gradient adds nothing to it.
    #[must_use]
    pub fn normal_force(&self, stiffness: f64) -> f64 {
        -stiffness * self.area * self.mollifier.value() * self.barrier.slope(self.clearance())
    }

    /// Returns the gradient of the energy for `stiffness`, in N: the negative forces on the four
    /// vertices.
    #[must_use]
    pub fn gradient(&self, stiffness: f64) -> Gradient {
        let clearance = self.clearance();
        if clearance >= self.barrier.activation() {
            return [0.0; 12];
        }
        let scaled = stiffness * self.area;

        let slope = scaled * self.mollifier.value() * self.barrier.slope(clearance);
        let mut gradient = self.distance_gradient().map(|component| slope * component);
        // The product rule adds the gradient of the mollifier.
        if self.mollifier.is_active() {
            let energy = scaled * self.barrier.energy(clearance);
            for (sum, part) in gradient.iter_mut().zip(self.mollifier.gradient()) {
                *sum += energy * part;
            }
        }
        gradient
    }

    /// Returns the exact second derivative of the energy for `stiffness`, in N/m.
    ///
    /// The derivative jumps where the closest points change from one kind of feature to another.
    /// There the result is one of the two values.
    #[must_use]
    pub fn hessian(&self, stiffness: f64) -> Hessian {
        let clearance = self.clearance();
        let mut hessian = [[0.0; 12]; 12];
        if clearance >= self.barrier.activation() {
            return hessian;
        }

        // The barrier's curvature along the distance, and its slope times the distance's curvature.
        let scaled = stiffness * self.area;
        let fade = scaled * self.mollifier.value();
        let direction = self.distance_gradient();
        add_outer(&mut hessian, fade * self.barrier.curvature(clearance), &direction, &direction);
        self.add_curvature(&mut hessian, fade * self.barrier.slope(clearance));
        // The product rule adds the derivatives of the mollifier.
        if self.mollifier.is_active() {
            let turn = self.mollifier.gradient();
            let slope = scaled * self.barrier.slope(clearance);
            add_outer(&mut hessian, slope, &direction, &turn);
            add_outer(&mut hessian, slope, &turn, &direction);
            self.mollifier.add_hessian(&mut hessian, scaled * self.barrier.energy(clearance));
        }
        hessian
    }

    /// Returns the Gauss–Newton part of the second derivative: `$c\,D D^T$` with `$c = k A m b''$`,
    /// in N/m, and `$D = w \otimes n$`, the gradient of the distance.
    ///
    /// The matrix is positive semidefinite. It leaves out the derivatives of the normal and of the
    /// mollifier. `stiffness` is in N/m³.
    #[must_use]
    pub fn gauss_newton(&self, stiffness: f64) -> GaussNewton {
        let curvature = self.barrier.curvature(self.clearance());
        GaussNewton {
            factor: stiffness * self.area * self.mollifier.value() * curvature,
            distance_gradient: self.distance_gradient(),
        }
    }

    /// Returns the gradient of the distance, `$w \otimes n$`, as a [`Gradient`] without unit.
    #[must_use]
    pub fn distance_gradient(&self) -> Gradient {
        std::array::from_fn(|k| self.closest.weights[k / 3] * self.normal[k % 3])
    }

    /// Returns the second derivative of the distance as a [`Hessian`], in 1/m.
    #[must_use]
    pub fn distance_hessian(&self) -> Hessian {
        let mut hessian = [[0.0; 12]; 12];
        self.add_curvature(&mut hessian, 1.0);
        hessian
    }

    /// Adds `factor` times the second derivative of the distance to `hessian`.
    ///
    /// `$D = \tfrac12 |p|^2$` is least over the fractions `$t$` of the closest points along the
    /// edges `$e_k$` on which they slide. By the implicit function theorem
    /// `$\nabla^2 D = D_{xx} - D_{xt} D_{tt}^{-1} D_{tx}$` with `$D_{xx} = w w^T \otimes I$`,
    /// `$D_{xt} = \partial_k w \otimes p + w \otimes e_k$` and `$D_{tt} = e_k \cdot e_l$`. Then
    /// `$d \nabla^2 d = \nabla^2 D - \nabla d \nabla d^T$`.
    fn add_curvature(&self, hessian: &mut Hessian, factor: f64) {
        let (weights, normal) = (&self.closest.weights, &self.normal);
        let factor = factor / self.distance;

        // $D_{xx}$ less the outer product of the gradient of the distance.
        for (i, row) in hessian.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                let across = f64::from(i % 3 == j % 3) - normal[i % 3] * normal[j % 3];
                *entry += factor * (weights[i / 3] * weights[j / 3] * across);
            }
        }

        // The closest points slide along no, one or two edges.
        let [e, f] = self.edges;
        match self.closest.sliding {
            0 => {}
            1 => {
                let mixed = self.slide_derivative(0);
                add_outer(hessian, -factor / dot(e, e), &mixed, &mixed);
            }
            _ => {
                // Gram–Schmidt: a sum of squares loses less than the inverse of the Gram matrix.
                let (first, second) = (self.slide_derivative(0), self.slide_derivative(1));
                let along = dot(e, f) / dot(e, e);
                let across = subtract(f, scale(e, along));
                let second: Gradient = std::array::from_fn(|i| second[i] - along * first[i]);
                add_outer(hessian, -factor / dot(e, e), &first, &first);
                // For parallel edges `across` is rounding, and their contact has faded out.
                if dot(across, across) > PARALLEL * dot(f, f) {
                    add_outer(hessian, -factor / dot(across, across), &second, &second);
                }
            }
        }
    }

    /// Returns `$D_{xt}$` for the slide along edge `k`, in m.
    fn slide_derivative(&self, k: usize) -> Gradient {
        let weights = &self.closest.weights;
        let mut mixed: Gradient = std::array::from_fn(|i| weights[i / 3] * self.edges[k][i % 3]);
        let [from, to] = self.closest.slides[k].map(usize::from);
        for axis in 0..3 {
            mixed[3 * to + axis] += self.closest.offset[axis];
            mixed[3 * from + axis] -= self.closest.offset[axis];
        }
        mixed
    }
}

/// Adds `factor` times the outer product of the gradients `a` and `b` to `hessian`.
fn add_outer(hessian: &mut Hessian, factor: f64, a: &Gradient, b: &Gradient) {
    for (row, a) in hessian.iter_mut().zip(a) {
        for (entry, b) in row.iter_mut().zip(b) {
            *entry += factor * a * b;
        }
    }
}
