use crate::gap::{Gap, Gradient};
use crate::pair::{Pair, PairKind};
use crate::vector::{Block, Vector, across, add, at, combine, dot, norm, outer, scale, subtract};

/// Coulomb friction of a pair of primitives during one step, with what it remembers of those before.
///
/// A spring that gives way: normal force and tangent plane are those at the step's start
/// ("lagged"), and with the slip `$u$` of the step and the stretch `$e_0$` that is left of those
/// before, both in that plane, the stretch `$e = e_0 + u$` has the potential
///
/// ```math
/// E = \frac{F}{2\delta} |e|^2 \;\; (|e| \le \delta), \qquad
/// E = F (|e| - \tfrac12\delta) \;\; (|e| > \delta)
/// ```
///
/// `$F$` is the coefficient times the normal force, `$\delta$` the way after which the pair
/// slides. What is stretched beyond `$\delta$` is lost when the step ends. It is the elastic and
/// perfectly plastic element (Jenkins) that the fabric's friction has for its limit; other than a
/// friction that needs a speed to act, it lets nothing creep.
#[derive(Debug, Clone)]
pub(crate) struct Slip {
    key: (PairKind, [u32; 2]),
    pub(crate) vertices: [u32; 4],
    pub(crate) weights: [f64; 4],
    normal: Vector,
    /// `$\sum w_i x_i$` at the step's start less the stretch that was left, in m.
    anchor: Vector,
    /// `$F$`, in N.
    limit: f64,
}

/// Energies of friction in a step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FrictionEnergy {
    /// Potential of friction, the dissipated part included, in J.
    pub potential: f64,
    /// Part of the potential that is lost if the step ends here, in J.
    pub dissipated: f64,
    /// Part of the dissipated energy that cloth loses on cloth, in J.
    pub dissipated_on_cloth: f64,
}

/// What is left of a pair's stretch between two steps, in m.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Anchor {
    key: (PairKind, [u32; 2]),
    stretch: Vector,
}

impl Slip {
    /// The friction of a pair from the places of all vertices at the step's start on.
    ///
    /// `limit` is the largest force in N; the anchors of the step before are sorted by pair.
    pub(crate) fn new(
        pair: &Pair,
        (gap, places): (&Gap, &[f64]),
        limit: f64,
        anchors: &[Anchor],
    ) -> Slip {
        let (weights, normal) = (gap.weights(), gap.normal());
        let found = anchors.binary_search_by_key(&pair.key(), |anchor| anchor.key);
        let stretch = found.map_or([0.0; 3], |index| anchors[index].stretch);
        let stretch = subtract(stretch, scale(normal, dot(stretch, normal)));
        let mut slip = Slip {
            key: pair.key(),
            vertices: pair.vertices,
            weights,
            normal,
            anchor: [0.0; 3],
            limit,
        };
        slip.anchor = subtract(slip.point(places), stretch);
        slip
    }

    fn point(&self, places: &[f64]) -> Vector {
        let mut sum = [0.0; 3];
        for (weight, vertex) in self.weights.iter().zip(self.vertices) {
            sum = add(sum, scale(at(places, vertex as usize), *weight));
        }
        sum
    }

    fn stretch(&self, places: &[f64]) -> Vector {
        let moved = subtract(self.point(places), self.anchor);
        subtract(moved, scale(self.normal, dot(moved, self.normal)))
    }

    /// Energies of the friction if the step ends at these positions.
    pub(crate) fn energy(&self, places: &[f64], stick: f64) -> FrictionEnergy {
        let length = norm(self.stretch(places));
        let over = (length - stick).max(0.0);
        let held = length - over;
        let lost = self.limit * over;
        FrictionEnergy {
            potential: 0.5 * self.limit * held * held / stick + lost,
            dissipated: lost,
            dissipated_on_cloth: 0.0,
        }
    }

    /// Gradient of the potential, in N.
    pub(crate) fn gradient(&self, places: &[f64], stick: f64) -> Gradient {
        let stretch = self.stretch(places);
        let pull = self.limit / norm(stretch).max(stick);
        std::array::from_fn(|k| self.weights[k / 3] * pull * stretch[k % 3])
    }

    /// Second derivative of the potential by `$\sum w_i x_i$`, never indefinite, in N/m.
    pub(crate) fn stiffness(&self, places: &[f64], stick: f64) -> Block {
        let stretch = self.stretch(places);
        let length = norm(stretch);
        let pull = self.limit / length.max(stick);
        let plane = across(self.normal);
        let along = if length > stick { pull / (length * length) } else { 0.0 };
        combine(&plane, pull, &outer(stretch), -along)
    }

    /// What is left of the stretch when the step ends at these places.
    pub(crate) fn kept(&self, places: &[f64], stick: f64) -> Anchor {
        let stretch = self.stretch(places);
        let length = norm(stretch);
        let part = if length > stick { stick / length } else { 1.0 };
        Anchor { key: self.key, stretch: scale(stretch, part) }
    }
}
