//! The law of bending for a batch. The weight of its friction is constant and has no knots.
#![allow(clippy::needless_range_loop, reason = "a lane indexes several arrays")]

use crate::batch::batch_law::Responses;
use crate::batch::friction::PreparedFriction;
use crate::batch::lanes::{LANES, Lanes};
use crate::batch::memories::{LaneMemory, MemoryBatch, Toe};
use crate::batch::weighted_law::{Knot, WeightedLaw};
use crate::laws::bending::BendingLaw;

/// A [`BendingLaw`] for many connectors side by side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BendingBatch {
    law: BendingLaw,
    friction: PreparedFriction,
}

impl BendingBatch {
    /// Prepares `law` for a batch.
    #[must_use]
    pub fn new(law: BendingLaw) -> Self {
        let friction = PreparedFriction::new(&law.friction);
        Self { law, friction }
    }

    /// Returns the law before its preparation.
    #[must_use]
    pub fn law(&self) -> &BendingLaw {
        &self.law
    }
}

impl WeightedLaw for BendingBatch {
    const KNOTS: usize = 0;
    const DEPENDS_ON_PEAK: bool = false;

    #[inline(always)]
    fn friction(&self) -> &PreparedFriction {
        &self.friction
    }

    #[inline(always)]
    fn toe(&self, _peak: f64) -> Toe {
        Toe::default()
    }

    #[inline(always)]
    fn peak(&self, peak: f64, trial: f64) -> f64 {
        peak.max(trial.abs())
    }

    #[inline(always)]
    fn weight(&self, _lane: LaneMemory, _deformation: f64) -> f64 {
        1.0
    }

    #[inline(always)]
    fn weight_slope(&self, _lane: LaneMemory, _rising: bool) -> f64 {
        0.0
    }

    #[inline(always)]
    fn knot(&self, _knot: usize, _lane: LaneMemory) -> Knot {
        Knot { position: 0.0, slope_change: 0.0 }
    }

    #[inline(always)]
    fn add_elastic<const TANGENT: bool>(
        &self,
        _memory: &MemoryBatch<'_>,
        trial: &Lanes,
        responses: &mut Responses,
    ) {
        for lane in 0..LANES {
            let response = self.law.backbone.respond(trial[lane] - self.law.rest_curvature);
            responses.load[lane] += response.load;
            if TANGENT {
                responses.tangent[lane] += response.tangent;
            }
        }
    }

    #[inline(always)]
    fn add_elastic_energy(&self, _memory: &MemoryBatch<'_>, trial: &Lanes, energies: &mut Lanes) {
        for lane in 0..LANES {
            let curvature = trial[lane] - self.law.rest_curvature;
            energies[lane] += self.law.backbone.energy(curvature);
        }
    }
}
