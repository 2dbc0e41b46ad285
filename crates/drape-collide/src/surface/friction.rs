//! Coulomb friction of pairs, without creep.
//!
//! A pair is a spring that yields, the elastic and perfectly plastic element (Jenkins) that the
//! fabric's friction has for its limit. Normal force and tangent plane are lagged: those at the
//! start of the step \[Li20, §5\]. With the slip `$u$` of the step and the stretch `$e_0$` of the
//! steps before, both in that plane, the stretch `$e = e_0 + u$` has the potential
//!
//! ```math
//! E = \frac{F}{2\delta} |e|^2 \;\; (|e| \le \delta), \qquad
//! E = F (|e| - \tfrac12\delta) \;\; (|e| > \delta)
//! ```
//!
//! with `$F$` the coefficient times the normal force and `$\delta$` the sticking displacement.
//! Stretch beyond `$\delta$` is lost when the step ends. Unlike friction that needs a speed to act,
//! a load below Coulomb's limit comes to rest.
//!
//! [`contact`](super::contact) opens the friction of a step, evaluates it at trial positions and
//! keeps the stretches when the step is accepted.

use serde::{Deserialize, Serialize};

use super::barrier::{Gap, Gradient};
use super::pair::{Pair, PairKey};
use crate::vector::{
    Matrix, Vector, add, at, combine, dot, norm, outer, projection, scale, subtract,
};

/// Coulomb friction of all pairs of a contact, in a step and between steps.
#[derive(Debug)]
pub(crate) struct SurfaceFriction {
    /// Coefficient of each two groups, row by row.
    coefficients: Vec<f64>,
    groups: usize,
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
    /// Anchor: `$\sum w_i x_i$` at the step's start less the stretch of the steps before, in m.
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

/// Energies of friction in a step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FrictionEnergy {
    /// Potential of friction, the dissipated part included, in J.
    pub potential: f64,
    /// Dissipated part of the potential if the step ends here, in J.
    pub dissipated: f64,
    /// Dissipated part in the friction of cloth on cloth, in J.
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
    /// Returns whether stretches are finite and sorted as the pairs are, each once.
    pub(crate) fn are_right(stretches: &[Stretch]) -> bool {
        stretches.is_sorted_by(|a, b| a.key < b.key)
            && stretches.iter().flat_map(|own| own.vector).all(f64::is_finite)
    }
}

impl SurfaceFriction {
    /// No friction yet, for a number of groups.
    pub(crate) fn new(
        coefficients: Vec<f64>,
        groups: usize,
        sticking_displacement: f64,
    ) -> SurfaceFriction {
        let (pairs, stretches) = (Vec::new(), Vec::new());
        SurfaceFriction { coefficients, groups, sticking_displacement, pairs, stretches }
    }

    /// Ends the friction of a step without keeping its stretches.
    pub(crate) fn clear(&mut self) {
        self.pairs.clear();
    }

    /// Adds the friction of an active pair of two groups, in the order of the pairs, from the
    /// positions at the step's start, for a stiffness of contact in N/m³.
    pub(crate) fn open_pair(
        &mut self,
        active: ActiveGap<'_>,
        groups: [u32; 2],
        positions: &[f64],
        stiffness: f64,
    ) {
        let [a, b] = groups.map(|group| group as usize);
        let limit = self.coefficients[a * self.groups + b] * active.gap.normal_force(stiffness);
        if limit > 0.0 {
            self.pairs.push(PairFriction::new(active, positions, limit, &self.stretches));
        }
    }

    /// Ends the step at some positions: the stretch beyond the sticking displacement is lost.
    pub(crate) fn commit(&mut self, positions: &[f64]) {
        let sticking = self.sticking_displacement;
        self.stretches.clear();
        let pairs = self.pairs.iter();
        self.stretches.extend(pairs.map(|pair| pair.elastic_stretch(positions, sticking)));
    }

    /// Returns the energies if the step ends at some positions, in J; the first vertices, so many,
    /// are those of cloth.
    pub(crate) fn energy(&self, positions: &[f64], free: usize) -> FrictionEnergy {
        self.pairs.iter().fold(FrictionEnergy::default(), |sum, pair| {
            let FrictionEnergy { potential, dissipated, .. } =
                pair.energy(positions, self.sticking_displacement);
            let is_cloth = pair.vertices.iter().all(|vertex| (*vertex as usize) < free);
            let on_cloth = if is_cloth { dissipated } else { 0.0 };
            FrictionEnergy {
                potential: sum.potential + potential,
                dissipated: sum.dissipated + dissipated,
                dissipated_on_cloth: sum.dissipated_on_cloth + on_cloth,
            }
        })
    }

    /// Calls `visit` with the vertices and the gradient of the potential of each pair, in N.
    pub(crate) fn each_gradient(
        &self,
        positions: &[f64],
        mut visit: impl FnMut(&[u32; 4], &Gradient),
    ) {
        for pair in &self.pairs {
            visit(&pair.vertices, &pair.gradient(positions, self.sticking_displacement));
        }
    }

    /// Calls `visit` with the vertices, their weights and the stiffness of each pair, in N/m.
    pub(crate) fn each_stiffness(
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
    /// Friction of a pair with a largest force, in N, from the positions at the step's start.
    fn new(
        active: ActiveGap<'_>,
        positions: &[f64],
        limit: f64,
        stretches: &[Stretch],
    ) -> PairFriction {
        let ActiveGap { pair, gap } = active;
        let (weights, normal) = (gap.weights(), gap.normal());
        let found = stretches.binary_search_by_key(&pair.key(), |stretch| stretch.key);
        let stretch = found.map_or([0.0; 3], |index| stretches[index].vector);
        let stretch = subtract(stretch, scale(normal, dot(stretch, normal)));
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

    /// Returns `$\sum w_i x_i$`, in m.
    fn offset(&self, positions: &[f64]) -> Vector {
        let mut sum = [0.0; 3];
        for (weight, vertex) in self.weights.iter().zip(self.vertices) {
            sum = add(sum, scale(at(positions, vertex as usize), *weight));
        }
        sum
    }

    /// Returns the stretch `$e$`, in m.
    fn stretch(&self, positions: &[f64]) -> Vector {
        let moved = subtract(self.offset(positions), self.anchor);
        subtract(moved, scale(self.normal, dot(moved, self.normal)))
    }

    /// Returns the energies if the step ends at some positions.
    fn energy(&self, positions: &[f64], sticking: f64) -> FrictionEnergy {
        let length = norm(self.stretch(positions));
        let over = (length - sticking).max(0.0);
        let held = length - over;
        let lost = self.limit * over;
        FrictionEnergy {
            potential: 0.5 * self.limit * held * held / sticking + lost,
            dissipated: lost,
            dissipated_on_cloth: 0.0,
        }
    }

    /// Returns the gradient of the potential, in N.
    fn gradient(&self, positions: &[f64], sticking: f64) -> Gradient {
        let stretch = self.stretch(positions);
        let pull = self.limit / norm(stretch).max(sticking);
        std::array::from_fn(|k| self.weights[k / 3] * pull * stretch[k % 3])
    }

    /// Returns the second derivative of the potential by `$\sum w_i x_i$`, positive semidefinite,
    /// in N/m.
    fn stiffness(&self, positions: &[f64], sticking: f64) -> Matrix {
        let stretch = self.stretch(positions);
        let length = norm(stretch);
        let pull = self.limit / length.max(sticking);
        let plane = projection(self.normal);
        let along = if length > sticking { pull / (length * length) } else { 0.0 };
        combine(&plane, pull, &outer(stretch), -along)
    }

    /// Returns the elastic stretch when the step ends at some positions.
    fn elastic_stretch(&self, positions: &[f64], sticking: f64) -> Stretch {
        let stretch = self.stretch(positions);
        let length = norm(stretch);
        let part = if length > sticking { sticking / length } else { 1.0 };
        Stretch { key: self.key, vector: scale(stretch, part) }
    }
}
