use crate::barrier::Barrier;
use crate::closest::Closest;
use crate::mollifier::Mollifier;
use crate::pair::{Pair, closest};
use crate::vector::{dot, scale, subtract};

/// Derivative of a number by the twelve coordinates of a pair's four vertices.
pub type Gradient = [f64; 12];

/// Second derivatives by the twelve coordinates, row by row.
pub type Hessian = [[f64; 12]; 12];

/// Positive semi-definite part `$c\,D D^T$` of a second derivative.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GaussNewton {
    /// `$c$`, in N/m; never negative.
    pub factor: f64,
    /// `$D$`, the gradient of the distance, without unit.
    pub distance_gradient: Gradient,
}

/// Squared sine of an angle between edges that a difference of their coordinates still resolves.
const PARALLEL: f64 = 1e-28;

/// How the two primitives of a [`Pair`] lie to each other, and the energy of their contact.
///
/// With the distance `$d$`, the min_separation `$\xi$`, the activation_distance `$r$` and the area `$A$` of the pair,
///
/// ```math
/// E = k\,A\,m\,b(d - \xi), \qquad
/// b(g) = \tfrac12 (\hat g - g)^2 \;\; (\hat g/2 \le g < \hat g), \qquad
/// b(g) = -\tfrac14 \hat g^2 (\ln(2g/\hat g) - \tfrac12) \;\; (0 < g < \hat g/2)
/// ```
///
/// with `$\hat g = r - \xi$` and the stiffness `$k$` in N/m³; `$m$` fades two edges out as they
/// become parallel, where their closest points would jump (Li et al. 2020, "Incremental Potential
/// Contact", §5). The sum over all pairs of vertices with triangles and of edges is continuous
/// with its gradient, whatever the closest points lie on. A closed gap, `$d \le \xi$`, has an
/// infinite energy, and derivatives that are not finite.
#[derive(Debug, Clone)]
pub struct Gap {
    closest: Closest,
    distance: f64,
    normal: [f64; 3],
    min_separation: f64,
    area: f64,
    barrier: Barrier,
    mollifier: Mollifier,
    /// The edges that the closest points slide along, in m.
    edges: [[f64; 3]; 2],
}

impl Gap {
    /// The gap of a pair at flat positions, in m.
    ///
    /// # Panics
    ///
    /// If the positions do not activation_distance as far as the pair's vertices.
    pub fn new(pair: &Pair, positions: &[f64]) -> Gap {
        let places = pair.places(positions);
        let closest = closest(pair.kind, places);
        let distance = dot(closest.way, closest.way).sqrt();
        let normal = if distance > 0.0 { scale(closest.way, 1.0 / distance) } else { [0.0; 3] };
        let edge = |[from, to]: [u8; 2]| subtract(places[to as usize], places[from as usize]);
        Gap {
            distance,
            normal,
            min_separation: pair.min_separation,
            area: pair.area,
            barrier: Barrier::strict(pair.activation_distance - pair.min_separation),
            mollifier: Mollifier::new(places, pair.parallel),
            edges: closest.slides.map(edge),
            closest,
        }
    }

    /// Distance `$d$` of the closest points, in m.
    pub fn distance(&self) -> f64 {
        self.distance
    }

    /// Distance above the min_separation, `$g = d - \xi$`, in m.
    pub fn clearance(&self) -> f64 {
        self.distance - self.min_separation
    }

    /// Unit vector from the closest point of the second primitive to that of the first; zero if
    /// they touch.
    pub fn normal(&self) -> [f64; 3] {
        self.normal
    }

    /// Weights `$w_i$` of the vertices: `$\sum w_i x_i = d\,n$`, those of the first primitive sum
    /// to 1 and those of the second to -1.
    pub fn weights(&self) -> [f64; 4] {
        self.closest.weights
    }

    /// Energy in J for a stiffness in N/m³.
    pub fn energy(&self, stiffness: f64) -> f64 {
        let fade = self.mollifier.value();
        // Infinity times zero: edges that are parallel do not push, however near.
        if fade == 0.0 {
            return 0.0;
        }
        stiffness * self.area * fade * self.barrier.energy(self.clearance())
    }

    /// Force in N with which the two push along the normal, without the share that turns edges
    /// from being parallel: the load that friction goes by.
    pub fn normal_force(&self, stiffness: f64) -> f64 {
        -stiffness * self.area * self.mollifier.value() * self.barrier.slope(self.clearance())
    }

    /// Gradient of the energy in N: the negative of the forces on the four vertices.
    pub fn gradient(&self, stiffness: f64) -> Gradient {
        let opening = self.clearance();
        if opening >= self.barrier.range() {
            return [0.0; 12];
        }
        let scaled = stiffness * self.area;
        let slope = scaled * self.mollifier.value() * self.barrier.slope(opening);
        let mut gradient = self.distance_gradient().map(|component| slope * component);
        if self.mollifier.is_active() {
            let energy = scaled * self.barrier.energy(opening);
            for (sum, part) in gradient.iter_mut().zip(self.mollifier.gradient()) {
                *sum += energy * part;
            }
        }
        gradient
    }

    /// Exact second derivative of the energy, in N/m.
    ///
    /// Where the closest points change from one kind of feature to another it jumps, and this is
    /// one of the two.
    pub fn hessian(&self, stiffness: f64) -> Hessian {
        let opening = self.clearance();
        let mut hessian = [[0.0; 12]; 12];
        if opening >= self.barrier.range() {
            return hessian;
        }
        let scaled = stiffness * self.area;
        let fade = scaled * self.mollifier.value();
        let direction = self.distance_gradient();
        add_outer(&mut hessian, fade * self.barrier.curvature(opening), &direction, &direction);
        self.add_curvature(&mut hessian, fade * self.barrier.slope(opening));
        if self.mollifier.is_active() {
            let turn = self.mollifier.gradient();
            let slope = scaled * self.barrier.slope(opening);
            add_outer(&mut hessian, slope, &direction, &turn);
            add_outer(&mut hessian, slope, &turn, &direction);
            self.mollifier.add_hessian(&mut hessian, scaled * self.barrier.energy(opening));
        }
        hessian
    }

    /// The part of the second derivative that is never negative: `$c\,D D^T$` with
    /// `$c = k A m b''$` in N/m and `$D = w \otimes n$`, the gradient of the distance.
    ///
    /// The Gauss–Newton part: it leaves out that the normal turns and that edges become parallel.
    pub fn gauss_newton(&self, stiffness: f64) -> GaussNewton {
        let curvature = self.barrier.curvature(self.clearance());
        GaussNewton {
            factor: stiffness * self.area * self.mollifier.value() * curvature,
            distance_gradient: self.distance_gradient(),
        }
    }

    /// Gradient of the distance, `$w \otimes n$`, without unit.
    pub fn distance_gradient(&self) -> Gradient {
        std::array::from_fn(|k| self.closest.weights[k / 3] * self.normal[k % 3])
    }

    /// Second derivative of the distance, in 1/m.
    pub fn distance_hessian(&self) -> Hessian {
        let mut hessian = [[0.0; 12]; 12];
        self.add_curvature(&mut hessian, 1.0);
        hessian
    }

    /// Adds a multiple of the second derivative of the distance.
    ///
    /// `$D = \tfrac12 |p|^2$` is least over the shares `$t$` of the closest points along the edges
    /// `$e_k$` that they slide on. By the implicit function theorem
    /// `$\nabla^2 D = D_{xx} - D_{xt} D_{tt}^{-1} D_{tx}$` with `$D_{xx} = w w^T \otimes I$`,
    /// `$D_{xt} = \partial_k w \otimes p + w \otimes e_k$` and `$D_{tt} = e_k \cdot e_l$`; then
    /// `$d \nabla^2 d = \nabla^2 D - \nabla d \nabla d^T$`.
    fn add_curvature(&self, hessian: &mut Hessian, factor: f64) {
        let (weights, normal) = (&self.closest.weights, &self.normal);
        let factor = factor / self.distance;
        for (i, row) in hessian.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                let across = f64::from(i % 3 == j % 3) - normal[i % 3] * normal[j % 3];
                *entry += factor * (weights[i / 3] * weights[j / 3] * across);
            }
        }
        let slide = |k: usize| {
            let mut mixed: Gradient =
                std::array::from_fn(|i| weights[i / 3] * self.edges[k][i % 3]);
            let [from, to] = self.closest.slides[k].map(usize::from);
            for axis in 0..3 {
                mixed[3 * to + axis] += self.closest.way[axis];
                mixed[3 * from + axis] -= self.closest.way[axis];
            }
            mixed
        };
        let [e, f] = self.edges;
        match self.closest.sliding {
            0 => {}
            1 => {
                let mixed = slide(0);
                add_outer(hessian, -factor / dot(e, e), &mixed, &mixed);
            }
            _ => {
                // Gram–Schmidt: a sum of squares loses less than the inverse of the Gram matrix.
                let (first, second) = (slide(0), slide(1));
                let share = dot(e, f) / dot(e, e);
                let rest = subtract(f, scale(e, share));
                let second: Gradient = std::array::from_fn(|i| second[i] - share * first[i]);
                add_outer(hessian, -factor / dot(e, e), &first, &first);
                // What is left of parallel edges is rounding; their contact has faded out.
                if dot(rest, rest) > PARALLEL * dot(f, f) {
                    add_outer(hessian, -factor / dot(rest, rest), &second, &second);
                }
            }
        }
    }
}

fn add_outer(hessian: &mut Hessian, factor: f64, a: &Gradient, b: &Gradient) {
    for (row, a) in hessian.iter_mut().zip(a) {
        for (entry, b) in row.iter_mut().zip(b) {
            *entry += factor * a * b;
        }
    }
}
