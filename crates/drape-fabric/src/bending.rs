use drape_hysteresis::{BlimanSorine, Slip};

use crate::Piecewise;
use crate::law::{Law, Memory, Response};

/// Bending moment per width of a fabric against signed curvature [Ngo Ngoc & Boivin 2004, eq. 4].
///
/// ```math
/// M = M_e(\kappa - \kappa_0) + M_{fr}
/// ```
///
/// The curvature is signed: bent through zero to the other side, the fabric goes on along its loop
/// and does not reverse.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BendingLaw {
    /// Elastic moment.
    pub backbone: BendingBackbone,
    /// Curvature `$\kappa_0$` at rest: a crease or a fold, in 1/m.
    pub rest_curvature: f64,
    /// Friction moment of first or second order; its plateau is in N, its length in 1/m.
    pub friction: BlimanSorine,
}

/// Elastic bending moment per width, odd in the curvature.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum BendingBackbone {
    /// Proportional to the curvature, with the rigidity `$k_b = B$` in N·m.
    Linear {
        /// Bending rigidity per width, in N·m.
        rigidity: f64,
    },
    /// Breen's quadratic and line; the slope is in N·m, the intercept in N, the knot in 1/m.
    Piecewise(Piecewise),
}

impl BendingBackbone {
    /// Moment per width and its slope at a curvature, in N and N·m.
    #[must_use]
    pub fn respond(&self, curvature: f64) -> Response {
        match self {
            Self::Linear { rigidity } => {
                Response { load: rigidity * curvature, tangent: *rigidity }
            }
            Self::Piecewise(piecewise) => {
                Response { load: piecewise.load(curvature), tangent: piecewise.tangent(curvature) }
            }
        }
    }

    /// Energy per area at a curvature, in J/m².
    #[must_use]
    pub fn energy(&self, curvature: f64) -> f64 {
        match self {
            Self::Linear { rigidity } => 0.5 * rigidity * curvature * curvature,
            Self::Piecewise(piecewise) => piecewise.energy(curvature),
        }
    }
}

impl BendingLaw {
    fn slip(&self, memory: &Memory, curvature: f64) -> Slip {
        Slip::from(curvature - memory.position)
    }
}

impl Law for BendingLaw {
    fn respond(&self, memory: &Memory, curvature: f64) -> Response {
        let elastic = self.backbone.respond(curvature - self.rest_curvature);
        let (load, tangent) = self.friction.respond(memory.friction, self.slip(memory, curvature));
        Response { load: elastic.load + load, tangent: elastic.tangent + tangent }
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
