//! Coulomb friction of pairs, without creep.
//!
//! Each pair is a spring that yields: an elastic, perfectly plastic element (Jenkins), like the
//! limit of the fabric's friction. Normal force and tangent plane are lagged: they are taken at the
//! start of the step \[Li20, §5\]. With the slip `$u$` of the step and the stretch `$e_0$` from
//! earlier steps, both in the tangent plane, the stretch `$e = e_0 + u$` has the potential
//!
//! ```math
//! E = \frac{F}{2\delta} |e|^2 \;\; (|e| \le \delta), \qquad
//! E = F (|e| - \tfrac12\delta) \;\; (|e| > \delta)
//! ```
//!
//! with `$F$` the coefficient times the normal force and `$\delta$` the sticking displacement.
//! Stretch beyond `$\delta$` is lost when the step ends. Friction that depends on speed creeps
//! under any load. Here a load below Coulomb's limit comes to rest.
//!
//! [`contact`](super::contact) sets up the friction when a step begins, and evaluates it at trial
//! positions. When the step is accepted, it stores the tangential displacement `$e$` of each pair.

use serde::{Deserialize, Serialize};

use super::barrier::{Gap, Gradient};
use super::pair::{Pair, PairKey};
use crate::vector::{
    Matrix, Vector, add, at, combine, dot, norm, outer, projection, scale, subtract,
};

/// Coulomb friction of all pairs of a contact, in a step and between steps.
#[derive(Debug)]
pub(crate) struct SurfaceFriction {
    /// Coefficient of friction for each two groups, row by row.
    coefficients: Vec<f64>,
    group_count: usize,
    /// Sticking displacement `$\delta$`, in m.
    sticking_displacement: f64,
    pairs: Vec<PairFriction>,
    pub(crate) stretches: Vec<Stretch>,
}

/// Friction of a pair of primitives in the open step.
#[derive(Debug, Clone)]
struct PairFriction {
    key: PairKey,
    vertices: [u32; 4],
    weights: [f64; 4],
    normal: Vector,
    /// Anchor: `$\sum w_i x_i$` at the step's start less the stretch from earlier steps, in m.
    anchor: Vector,
    /// Largest friction force `$F$`, in N.
    limit: f64,
}

/// Active pair with its gap.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ActiveGap<'a> {
    pub(crate) pair: &'a Pair,
    pub(crate) gap: &'a Gap,
}

/// Energies of friction in the open step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FrictionEnergy {
    /// Potential of friction, in J, including the dissipated part.
    pub potential: f64,
    /// Part of the potential that is dissipated if the step ends here, in J.
    pub dissipated: f64,
    /// Part of `dissipated` in the friction of cloth on cloth, in J.
    pub dissipated_on_cloth: f64,
}

/// Elastic stretch of a pair between two steps.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct Stretch {
    key: PairKey,
    /// Stretch, in m.
    vector: Vector,
}

impl Stretch {
    /// Returns whether `stretches` are finite and sorted by pair, with each pair once.
    pub(crate) fn are_valid(stretches: &[Stretch]) -> bool {
        stretches.is_sorted_by(|a, b| a.key < b.key)
            && stretches.iter().flat_map(|stretch| stretch.vector).all(f64::is_finite)
    }
}

impl SurfaceFriction {
    /// Returns friction without pairs. `coefficients` holds a value for each two of `group_count`
    /// groups, row by row.
    pub(crate) fn new(
        coefficients: Vec<f64>,
        group_count: usize,
        sticking_displacement: f64,
    ) -> SurfaceFriction {
        SurfaceFriction {
            coefficients,
            group_count,
            sticking_displacement,
            pairs: Vec::new(),
            stretches: Vec::new(),
        }
    }

    /// Ends the friction of a step without keeping its stretches.
    pub(crate) fn clear(&mut self) {
        self.pairs.clear();
    }

    /// Adds the friction of the `active` pair between two `groups`. `positions` are those at the
    /// step's start, in m, and `stiffness` is the stiffness of contact, in N/m³. Pairs are added in
    /// their order.
    pub(crate) fn open_pair(
        &mut self,
        active: ActiveGap<'_>,
        groups: [u32; 2],
        positions: &[f64],
        stiffness: f64,
    ) {
        let [a, b] = groups.map(|group| group as usize);
        let coefficient = self.coefficients[a * self.group_count + b];
        let limit = coefficient * active.gap.normal_force(stiffness);
        if limit > 0.0 {
            self.pairs.push(PairFriction::new(active, positions, limit, &self.stretches));
        }
    }

    /// Ends the step at `positions`. Stretch beyond the sticking displacement is lost.
    pub(crate) fn commit(&mut self, positions: &[f64]) {
        let sticking = self.sticking_displacement;
        self.stretches.clear();
        let pairs = self.pairs.iter();
        self.stretches.extend(pairs.map(|pair| pair.elastic_stretch(positions, sticking)));
    }

    /// Returns the energies if the step ends at `positions`. The first `free_count` vertices are
    /// cloth.
    pub(crate) fn energy(&self, positions: &[f64], free_count: usize) -> FrictionEnergy {
        let mut total = FrictionEnergy::default();
        for pair in &self.pairs {
            let FrictionEnergy { potential, dissipated, .. } =
                pair.energy(positions, self.sticking_displacement);
            total.potential += potential;
            total.dissipated += dissipated;
            // Adding zero for other pairs keeps the sum's bits.
            let is_cloth = pair.vertices.iter().all(|vertex| (*vertex as usize) < free_count);
            total.dissipated_on_cloth += if is_cloth { dissipated } else { 0.0 };
        }
        total
    }

    /// Calls `visit` with the vertices of each pair and the gradient of its potential at
    /// `positions`, in N.
    pub(crate) fn for_each_gradient(
        &self,
        positions: &[f64],
        mut visit: impl FnMut(&[u32; 4], &Gradient),
    ) {
        for pair in &self.pairs {
            visit(&pair.vertices, &pair.gradient(positions, self.sticking_displacement));
        }
    }

    /// Calls `visit` with the vertices of each pair, their weights and the pair's stiffness at
    /// `positions`, in N/m.
    pub(crate) fn for_each_stiffness(
        &self,
        positions: &[f64],
        mut visit: impl FnMut([u32; 4], [f64; 4], &Matrix),
    ) {
        for pair in &self.pairs {
            let block = pair.stiffness(positions, self.sticking_displacement);
            visit(pair.vertices, pair.weights, &block);
        }
    }
}

impl PairFriction {
    /// Returns the friction of an `active` pair with the largest force `limit`, in N. `positions`
    /// are those at the step's start, `stretches` belong to earlier steps.
    fn new(
        active: ActiveGap<'_>,
        positions: &[f64],
        limit: f64,
        stretches: &[Stretch],
    ) -> PairFriction {
        let ActiveGap { pair, gap } = active;
        let (weights, normal) = (gap.weights(), gap.normal());
        let earlier = stretches.binary_search_by_key(&pair.key(), |stretch| stretch.key);
        let earlier = earlier.map_or([0.0; 3], |index| stretches[index].vector);

        // The tangent plane has turned since, so a part along the normal is removed.
        let stretch = subtract(earlier, scale(normal, dot(earlier, normal)));
        let mut friction = PairFriction {
            key: pair.key(),
            vertices: pair.vertices,
            weights,
            normal,
            anchor: [0.0; 3],
            limit,
        };
        friction.anchor = subtract(friction.offset(positions), stretch);
        friction
    }

    /// Returns `$\sum w_i x_i$` at `positions`, in m.
    fn offset(&self, positions: &[f64]) -> Vector {
        let mut sum = [0.0; 3];
        for (weight, vertex) in self.weights.iter().zip(self.vertices) {
            sum = add(sum, scale(at(positions, vertex as usize), *weight));
        }
        sum
    }

    /// Returns the stretch `$e$` at `positions`, in m.
    fn stretch(&self, positions: &[f64]) -> Vector {
        let moved = subtract(self.offset(positions), self.anchor);
        subtract(moved, scale(self.normal, dot(moved, self.normal)))
    }

    /// Returns the energies if the step ends at `positions`, for the displacement `sticking`, in m.
    fn energy(&self, positions: &[f64], sticking: f64) -> FrictionEnergy {
        let length = norm(self.stretch(positions));
        let excess = (length - sticking).max(0.0);
        let kept = length - excess;
        let lost = self.limit * excess;
        FrictionEnergy {
            potential: 0.5 * self.limit * kept * kept / sticking + lost,
            dissipated: lost,
            dissipated_on_cloth: 0.0,
        }
    }

    /// Returns the gradient of the potential at `positions`, in N.
    fn gradient(&self, positions: &[f64], sticking: f64) -> Gradient {
        let stretch = self.stretch(positions);
        let pull = self.limit / norm(stretch).max(sticking);
        std::array::from_fn(|k| self.weights[k / 3] * pull * stretch[k % 3])
    }

    /// Returns the second derivative of the potential with respect to `$\sum w_i x_i$` at
    /// `positions`, row by row, in N/m. The matrix is positive semidefinite.
    fn stiffness(&self, positions: &[f64], sticking: f64) -> Matrix {
        let stretch = self.stretch(positions);
        let length = norm(stretch);
        let pull = self.limit / length.max(sticking);
        let plane = projection(self.normal);
        let along = if length > sticking { pull / (length * length) } else { 0.0 };
        combine(&plane, pull, &outer(stretch), -along)
    }

    /// Returns the elastic [`Stretch`] if the step ends at `positions`.
    fn elastic_stretch(&self, positions: &[f64], sticking: f64) -> Stretch {
        let stretch = self.stretch(positions);
        let length = norm(stretch);
        let fraction = if length > sticking { sticking / length } else { 1.0 };
        Stretch { key: self.key, vector: scale(stretch, fraction) }
    }
}
