#![allow(clippy::needless_range_loop, reason = "a lane is a place in many arrays")]

use crate::BendingLaw;
use crate::batch::{BatchLaw, LANES, Lanes, Responses, Sliders};
use crate::memories::{Lane, Remembered};

/// A [`BendingLaw`] for many triples side by side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BendingBatch {
    law: BendingLaw,
    sliders: Sliders,
}

impl BendingBatch {
    /// Prepares a law.
    #[must_use]
    pub fn new(law: BendingLaw) -> Self {
        let sliders = Sliders::new(&law.friction);
        Self { law, sliders }
    }

    /// The law.
    #[must_use]
    pub fn law(&self) -> &BendingLaw {
        &self.law
    }
}

impl BatchLaw for BendingBatch {
    const KNOTS: usize = 0;
    const AGES: bool = false;

    #[inline(always)]
    fn sliders(&self) -> &Sliders {
        &self.sliders
    }

    #[inline(always)]
    fn toe(&self, _peak: f64) -> [f64; 2] {
        [0.0; 2]
    }

    #[inline(always)]
    fn peak(&self, peak: f64, trial: f64) -> f64 {
        peak.max(trial.abs())
    }

    #[inline(always)]
    fn weight(&self, _lane: Lane, _deformation: f64) -> f64 {
        1.0
    }

    #[inline(always)]
    fn slope(&self, _lane: Lane, _rising: bool) -> f64 {
        0.0
    }

    #[inline(always)]
    fn knot(&self, _knot: usize, _lane: Lane) -> (f64, f64) {
        (0.0, 0.0)
    }

    #[inline(always)]
    fn elastic<const TANGENT: bool>(
        &self,
        _memory: &Remembered<'_>,
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
    fn energy(&self, _memory: &Remembered<'_>, trial: &Lanes, energies: &mut Lanes) {
        for lane in 0..LANES {
            let curvature = trial[lane] - self.law.rest_curvature;
            energies[lane] += self.law.backbone.energy(curvature);
        }
    }
}
