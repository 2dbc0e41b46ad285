//! Law of traction: tension per width against strain along one yarn system.
//!
//! `primed`, `polynomial` and `exponential` are the elastic loads. `toe` is the end of a toe that
//! depends on the largest elongation. `buckling` is the load in compression. `proportional` is the
//! friction that grows with the tension.

pub(crate) mod buckling;
pub(crate) mod exponential;
pub(crate) mod polynomial;
pub(crate) mod primed;
pub(crate) mod proportional;
pub(crate) mod toe;

use drape_hysteresis::{BlimanSorine, Dahl, Loads, Response};

use crate::laws::law::{Law, Memory};
use crate::laws::path::Path;
use crate::laws::traction::buckling::Buckling;
use crate::laws::traction::exponential::ExponentialToe;
use crate::laws::traction::polynomial::Polynomial;
use crate::laws::traction::primed::Primed;
use crate::laws::traction::proportional::{ProportionalFriction, Weight, WeightedStep};

/// Tension per width of a woven fabric along one of its yarn systems, against strain.
///
/// ```math
/// F = F_e(\varepsilon, \hat\varepsilon) + F_{fr}
/// ```
///
/// with the elastic backbone `$F_e$` ([`TractionBackbone`]; [`Buckling`] in compression) and the
/// friction `$F_{fr}$` ([`TractionFriction`]).
///
/// ```
/// use drape_fabric::{BlimanSorine, Buckling, Law, Primed, TractionBackbone, TractionLaw};
///
/// let toe = Primed {
///     stiffness: 4000.0,
///     toe_ratio: 0.7,
///     toe_strain: 0.01,
///     toe_strain_after: 0.01,
/// };
/// let law = TractionLaw {
///     backbone: TractionBackbone::Primed(toe),
///     friction: BlimanSorine::none().into(),
///     buckling: Buckling::default(),
/// };
/// assert!((law.respond(&law.virgin(), 0.01).load - toe.toe_load()).abs() < 1e-12);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TractionLaw {
    /// Elastic load in tension, per width.
    pub backbone: TractionBackbone,
    /// Internal friction.
    pub friction: TractionFriction,
    /// Elastic load in compression, per width.
    pub buckling: Buckling,
}

/// Elastic load of a fabric in tension, per width.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TractionBackbone {
    /// Exponential toe that continues as its tangent, beside a line.
    Exponential(ExponentialToe),
    /// Priming zone, then a line \[NB04, eq. 3\].
    Primed(Primed),
    /// Even polynomial of the strain \[THK03, fig. 8a\].
    Polynomial(Polynomial),
}

/// Internal friction of a fabric in tension, per width.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TractionFriction {
    /// Bliman–Sorine friction with a plateau in N/m and a length that is a strain. All backbones
    /// may have it. With an exponential toe only the first element acts, with a weight of one in
    /// tension. In the priming zone the plateau has the weight
    ///
    /// ```math
    /// g(\varepsilon) = \frac{(1-r)\,\varepsilon/\varepsilon_c + 2r-1}{r}\;
    /// (0 \le \varepsilon \le \varepsilon_c), \qquad g = 1\;(\varepsilon > \varepsilon_c)
    /// ```
    ///
    /// because only some of the yarns bear load there. Below zero strain the yarns buckle and the
    /// weight falls linearly to zero at `$-\varepsilon_b$`. The factor printed in \[NB04, eq. 3\],
    /// `$a\varepsilon + b$`, has the unit of a strain and jumps at `$\varepsilon_c$`. The weight
    /// `$g$` is the printed factor times `$k_t/F_1$`.
    Plateau(BlimanSorine),
    /// Friction in proportion to the elastic load, for [`TractionBackbone::Exponential`]. With any
    /// other backbone the law has no friction.
    Proportional(ProportionalFriction),
}

/// Upper end of the search for the strain at a load, a ratio.
const LARGEST_STRAIN: f64 = 10.0;

/// Number of bisections in the search for the strain at a load: enough for all bits of a number.
const BISECTIONS: usize = 60;

impl TractionLaw {
    /// Returns the strain at which a virgin fabric carries `load`, in N/m, including its friction.
    /// Returns `None` if the fabric does not carry the load at any strain up to ten.
    ///
    /// ```
    /// use drape_fabric::{BlimanSorine, Buckling, Primed, TractionBackbone, TractionLaw};
    ///
    /// let toe = Primed {
    ///     stiffness: 4000.0,
    ///     toe_ratio: 0.7,
    ///     toe_strain: 0.01,
    ///     toe_strain_after: 0.01,
    /// };
    /// let law = TractionLaw {
    ///     backbone: TractionBackbone::Primed(toe),
    ///     friction: BlimanSorine::none().into(),
    ///     buckling: Buckling::default(),
    /// };
    /// let strain = law.strain_at(toe.toe_load()).expect("the fabric carries the load of its toe");
    /// assert!((strain - 0.01).abs() < 1e-12);
    /// assert_eq!(law.strain_at(1e6), None);
    /// ```
    #[must_use]
    pub fn strain_at(&self, load: f64) -> Option<f64> {
        let virgin = self.virgin();
        let (mut low, mut high) = (0.0, LARGEST_STRAIN);
        if self.respond(&virgin, high).load < load {
            return None;
        }
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (low + high);
            if self.respond(&virgin, middle).load < load {
                low = middle;
            } else {
                high = middle;
            }
        }
        Some(high)
    }
}

impl From<BlimanSorine> for TractionFriction {
    fn from(friction: BlimanSorine) -> Self {
        Self::Plateau(friction)
    }
}

impl From<ProportionalFriction> for TractionFriction {
    fn from(friction: ProportionalFriction) -> Self {
        Self::Proportional(friction)
    }
}

impl TractionFriction {
    /// Returns a friction of zero, for any [`TractionBackbone`].
    #[must_use]
    pub fn none() -> Self {
        Self::Plateau(BlimanSorine::none())
    }

    /// Returns whether the friction is zero at every strain.
    #[must_use]
    pub fn is_none(&self) -> bool {
        match self {
            Self::Plateau(friction) => friction.elements.iter().all(|e| e.plateau == 0.0),
            Self::Proportional(friction) => friction.is_none(),
        }
    }
}

impl TractionBackbone {
    /// Returns the stiffness of `self` at rest, in N/m.
    #[must_use]
    pub fn rest_stiffness(&self) -> f64 {
        match self {
            Self::Exponential(toe) => toe.rest_stiffness(),
            Self::Primed(primed) => primed.stiffness * (2.0 * primed.toe_ratio - 1.0),
            Self::Polynomial(_) => 0.0,
        }
    }

    /// Returns load and tangent at `strain`, at least 0, after the largest elongation `peak`.
    fn respond(&self, peak: f64, strain: f64) -> Response {
        match self {
            Self::Exponential(toe) => toe.respond(peak, strain),
            Self::Primed(primed) => primed.respond(peak, strain),
            Self::Polynomial(polynomial) => polynomial.respond(strain),
        }
    }

    /// Returns the energy per area at `strain`, at least 0, after the largest elongation `peak`, in
    /// J/m².
    fn energy(&self, peak: f64, strain: f64) -> f64 {
        match self {
            Self::Exponential(toe) => toe.energy(peak, strain),
            Self::Primed(primed) => primed.energy(peak, strain),
            Self::Polynomial(polynomial) => polynomial.energy(strain),
        }
    }
}

impl TractionLaw {
    /// Returns the elastic load and its tangent at `strain` after the largest elongation `peak`, in
    /// N/m.
    #[must_use]
    pub fn elastic(&self, peak: f64, strain: f64) -> Response {
        if strain >= 0.0 {
            self.backbone.respond(peak, strain)
        } else {
            self.buckling.respond(self.backbone.rest_stiffness(), strain)
        }
    }

    /// Returns the elastic energy per area at `strain` after the largest elongation `peak`, in
    /// J/m².
    fn elastic_energy(&self, peak: f64, strain: f64) -> f64 {
        if strain >= 0.0 {
            self.backbone.energy(peak, strain)
        } else {
            self.buckling.energy(self.backbone.rest_stiffness(), strain)
        }
    }

    /// Returns the path of a friction with a plateau from `memory` to `strain`.
    fn path(&self, memory: &Memory, strain: f64) -> Path {
        let slack = -self.buckling.strain;
        let (toe, at_rest) = match &self.backbone {
            TractionBackbone::Primed(p) => (p.toe(memory.peak), 2.0 - 1.0 / p.toe_ratio),
            TractionBackbone::Exponential(_) | TractionBackbone::Polynomial(_) => (0.0, 1.0),
        };
        Path::new(memory.position, strain, &[slack, 0.0, toe], |strain| {
            if strain >= toe {
                1.0
            } else if strain >= 0.0 {
                at_rest + (1.0 - at_rest) * strain / toe
            } else {
                at_rest * (1.0 - strain / slack).max(0.0)
            }
        })
    }

    /// Returns the friction of a law with an exponential toe. A friction with a plateau becomes a
    /// [`ProportionalFriction`] with the ratio 0.
    pub(crate) fn proportional(&self) -> ProportionalFriction {
        match self.friction {
            TractionFriction::Proportional(friction) => friction,
            TractionFriction::Plateau(friction) => {
                let [Dahl { plateau, length }, _] = friction.elements;
                ProportionalFriction { ratio: 0.0, plateau, length }
            }
        }
    }

    /// Returns the friction of a law without an exponential toe. A friction in proportion to the
    /// elastic load becomes [`BlimanSorine::none`].
    pub(crate) fn plateau(&self) -> BlimanSorine {
        match self.friction {
            TractionFriction::Plateau(friction) => friction,
            TractionFriction::Proportional(_) => BlimanSorine::none(),
        }
    }

    /// Returns the friction whose weight follows the tension, if the backbone is an exponential
    /// toe.
    fn weighted_by_tension(&self) -> Option<WeightedByTension> {
        let TractionBackbone::Exponential(toe) = self.backbone else { return None };
        let (friction, buckling) = (self.proportional(), self.buckling);
        Some(WeightedByTension { toe, friction, buckling })
    }
}

impl Law for TractionLaw {
    fn respond(&self, memory: &Memory, strain: f64) -> Response {
        let elastic = self.elastic(memory.peak, strain);
        let friction = match self.weighted_by_tension() {
            Some(friction) => friction.respond(memory, strain),
            None => self.path(memory, strain).respond(&self.plateau(), memory.friction),
        };
        Response { load: elastic.load + friction.load, tangent: elastic.tangent + friction.tangent }
    }

    fn work(&self, memory: &Memory, strain: f64) -> f64 {
        let friction = match self.weighted_by_tension() {
            Some(friction) => friction.work(memory, strain),
            None => self.path(memory, strain).work(&self.plateau(), memory.friction),
        };
        self.elastic_energy(memory.peak, strain) - self.elastic_energy(memory.peak, memory.position)
            + friction
    }

    fn commit(&self, memory: &Memory, strain: f64) -> Memory {
        let friction = match self.weighted_by_tension() {
            Some(friction) => friction.advance(memory, strain),
            None => self.path(memory, strain).advance(&self.plateau(), memory.friction),
        };
        Memory { position: strain, friction, peak: memory.peak.max(strain) }
    }

    fn stored(&self, memory: &Memory) -> f64 {
        let friction = match self.weighted_by_tension() {
            Some(friction) => friction.stored(memory),
            None => self.plateau().stored(memory.friction),
        };
        self.elastic_energy(memory.peak, memory.position) + friction
    }
}

/// Friction that grows with the tension, with the parameters of its weight.
///
/// The state of the friction is the first of the two friction loads of a [`Memory`].
struct WeightedByTension {
    toe: ExponentialToe,
    friction: ProportionalFriction,
    buckling: Buckling,
}

impl WeightedByTension {
    /// Returns the element whose load is the state of the friction.
    fn element(&self) -> Dahl {
        self.friction.element()
    }

    /// Returns the friction loads after the path from `memory` to `strain`.
    fn advance(&self, memory: &Memory, strain: f64) -> Loads {
        let [state, _] = memory.friction;
        [self.element().advance(state, strain - memory.position), 0.0]
    }

    /// Returns the weight at `strain` after the largest elongation `peak`, in N/m, and its slope.
    fn weight(&self, peak: f64, strain: f64) -> Response {
        let ProportionalFriction { ratio, plateau, .. } = self.friction;
        if strain < 0.0 {
            let scale = self.buckling.strain;
            let load = plateau * (strain / scale).exp();
            return Response { load, tangent: load / scale };
        }
        let elastic = self.toe.respond(peak, strain);
        Response { load: plateau + ratio * elastic.load, tangent: ratio * elastic.tangent }
    }

    /// Returns the friction's load and tangent at a trial `strain`.
    fn respond(&self, memory: &Memory, strain: f64) -> Response {
        let [state, _] = memory.friction;
        let weight = self.weight(memory.peak, strain);
        let end = self.element().respond(state, strain - memory.position);
        Response {
            load: weight.load * end.load,
            tangent: weight.tangent * end.load + weight.load * end.tangent,
        }
    }

    /// Returns the friction's work from `memory` to a trial `strain`, in J/m².
    fn work(&self, memory: &Memory, strain: f64) -> f64 {
        let [state, _] = memory.friction;
        // The toe moves at strains beyond all earlier ones.
        let seen = memory.peak.max(self.toe.toe_strain);
        self.work_along(memory.position, strain, state, [self.toe.toe(memory.peak), seen])
    }

    /// Returns the work between the strains `from` and `to`, in J/m², with the friction's `state`
    /// at the start. The toe ends at the first of `knots` and begins to move at the second.
    fn work_along(&self, from: f64, to: f64, state: f64, knots: [f64; 2]) -> f64 {
        let Self { toe, friction, buckling } = self;
        let weight = Weight { toe, friction, buckling };
        let [end, seen] = knots;
        let pieces = [
            (f64::NEG_INFINITY, 0.0, weight.compressed()),
            (0.0, end, weight.within_toe(end)),
            (end, seen, weight.beyond_toe(end)),
            (seen, f64::INFINITY, weight.virgin()),
        ];
        let (element, sign) = (self.element(), 1_f64.copysign(to - from));
        let works = pieces.into_iter().map(|(low, high, piece)| {
            let (start, stop) = (from.clamp(low, high), to.clamp(low, high));
            if start == stop {
                return 0.0;
            }
            let state = element.advance(state, start - from);
            piece.work(WeightedStep { from: start, to: stop, sign, state }, self.friction.length)
        });
        works.sum()
    }

    /// Returns the largest work that the friction can return from the state `memory`, in J/m².
    ///
    /// The friction returns this work on the path back to a state of zero, which has the length
    /// `$x_f\ln(1+|g|)$`. On every other path the friction returns less, so the work of a path less
    /// the change of this energy is never negative.
    fn stored(&self, memory: &Memory) -> f64 {
        let [state, _] = memory.friction;
        let path = self.friction.length * state.abs().ln_1p();
        let unloaded = memory.position - path.copysign(state);
        let knots = [self.toe.toe(memory.peak), f64::INFINITY];
        -self.work_along(memory.position, unloaded, state, knots)
    }
}
