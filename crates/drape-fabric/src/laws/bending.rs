//! Law of bending: moment per width against curvature.

use drape_hysteresis::{BlimanSorine, Response, Slip};

use crate::laws::law::{Law, Memory};
use crate::laws::piecewise::Piecewise;
use crate::laws::varying::Varying;

/// Bending moment per width against signed curvature \[NB04, eq. 4\].
///
/// ```math
/// M = M_e(\kappa - \kappa_0) + M_{fr}
/// ```
///
/// The curvature is signed: a fabric that is bent through zero to the other side continues along
/// its loop and does not reverse. The paper prints the rigidity in N·m², without a width. In this
/// law the rigidity is per width, in N·m, and the moment per width is in N.
///
/// ```
/// use drape_fabric::{BendingBackbone, BendingLaw, BlimanSorine, Law};
///
/// let law = BendingLaw {
///     backbone: BendingBackbone::Linear { rigidity: 1.2e-5 },
///     rest_curvature: 0.0,
///     friction: BlimanSorine::none(),
/// };
/// assert!((law.respond(&law.virgin(), 100.0).load - 1.2e-3).abs() < 1e-18);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BendingLaw {
    /// Elastic moment per width.
    pub backbone: BendingBackbone,
    /// Curvature `$\kappa_0$` at rest, for example of a crease, in 1/m.
    pub rest_curvature: f64,
    /// Friction moment of first or second order, with a plateau in N and a length in 1/m.
    pub friction: BlimanSorine,
}

/// Elastic bending moment per width, odd in the curvature.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum BendingBackbone {
    /// Line `$M_e = B\,\kappa$` with the KES bending rigidity `$B$`.
    Linear {
        /// Bending rigidity per width, in N·m.
        rigidity: f64,
    },
    /// Rigidity that changes with the curvature: stiffnesses in N·m, transition in 1/m.
    Varying(Varying),
    /// Quadratic and line: slope in N·m, intercept in N, knot in 1/m.
    Piecewise(Piecewise),
}

impl BendingBackbone {
    /// Returns the moment per width and its derivative at `curvature`, in N and N·m.
    #[must_use]
    pub fn respond(&self, curvature: f64) -> Response {
        match self {
            Self::Linear { rigidity } => {
                Response { load: rigidity * curvature, tangent: *rigidity }
            }
            Self::Varying(varying) => varying.respond(curvature),
            Self::Piecewise(piecewise) => {
                Response { load: piecewise.load(curvature), tangent: piecewise.tangent(curvature) }
            }
        }
    }

    /// Returns the energy per area at `curvature`, in J/m².
    #[must_use]
    pub fn energy(&self, curvature: f64) -> f64 {
        match self {
            Self::Linear { rigidity } => 0.5 * rigidity * curvature * curvature,
            Self::Varying(varying) => varying.energy(curvature * curvature),
            Self::Piecewise(piecewise) => piecewise.energy(curvature),
        }
    }
}

impl BendingLaw {
    /// Returns the slip of the friction from `memory` to `curvature`.
    fn slip(&self, memory: &Memory, curvature: f64) -> Slip {
        Slip::from(curvature - memory.position)
    }
}

impl Law for BendingLaw {
    fn respond(&self, memory: &Memory, curvature: f64) -> Response {
        let elastic = self.backbone.respond(curvature - self.rest_curvature);
        let friction = self.friction.respond(memory.friction, self.slip(memory, curvature));
        Response { load: elastic.load + friction.load, tangent: elastic.tangent + friction.tangent }
    }

    fn work(&self, memory: &Memory, curvature: f64) -> f64 {
        self.backbone.energy(curvature - self.rest_curvature)
            - self.backbone.energy(memory.position - self.rest_curvature)
            + self.friction.work(memory.friction, self.slip(memory, curvature))
    }

    fn commit(&self, memory: &Memory, curvature: f64) -> Memory {
        Memory {
            position: curvature,
            friction: self.friction.advance(memory.friction, self.slip(memory, curvature)),
            peak: memory.peak.max(curvature.abs()),
        }
    }

    fn stored(&self, memory: &Memory) -> f64 {
        self.backbone.energy(memory.position - self.rest_curvature)
            + self.friction.stored(memory.friction)
    }
}
