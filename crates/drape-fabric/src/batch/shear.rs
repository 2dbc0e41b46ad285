//! The law of shear for a batch. The weight of its friction has one knot, at zero shear.
#![allow(clippy::needless_range_loop, reason = "a lane indexes several arrays")]

use crate::batch::batch_law::Responses;
use crate::batch::friction::PreparedFriction;
use crate::batch::lanes::{LANES, Lanes, any};
use crate::batch::memories::{LaneMemory, MemoryBatch, Toe};
use crate::batch::weighted_law::{Knot, WeightedLaw};
use crate::laws::shear::{Elastic, Locking, ShearBackbone, ShearLaw};

/// A [`ShearLaw`] for many connectors side by side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShearBatch {
    law: ShearLaw,
    friction: PreparedFriction,
}

impl ShearBatch {
    /// Prepares `law` for a batch.
    #[must_use]
    pub fn new(law: ShearLaw) -> Self {
        let friction = PreparedFriction::new(&law.friction);
        Self { law, friction }
    }

    /// Returns the locking, if the shear of any lane of `trial` is beyond its onset.
    #[inline(always)]
    fn locked(&self, trial: &Lanes) -> Option<Locking> {
        self.law.locking.filter(|locking| any(|lane| trial[lane].abs() > locking.onset))
    }
}

impl WeightedLaw for ShearBatch {
    const KNOTS: usize = 1;
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
    fn weight(&self, _lane: LaneMemory, deformation: f64) -> f64 {
        1.0 + self.law.growth * deformation.abs()
    }

    #[inline(always)]
    fn weight_slope(&self, lane: LaneMemory, rising: bool) -> f64 {
        let falls = (lane.position < 0.0) | (!rising & (lane.position == 0.0));
        if falls { -self.law.growth } else { self.law.growth }
    }

    #[inline(always)]
    fn knot(&self, _knot: usize, _lane: LaneMemory) -> Knot {
        Knot { position: 0.0, slope_change: 2.0 * self.law.growth }
    }

    #[inline(always)]
    fn add_elastic<const TANGENT: bool>(
        &self,
        _memory: &MemoryBatch<'_>,
        trial: &Lanes,
        responses: &mut Responses,
    ) {
        let Responses { load, tangent } = responses;
        match self.law.backbone {
            ShearBackbone::Linear { stiffness } => {
                for lane in 0..LANES {
                    load[lane] += stiffness * trial[lane];
                    if TANGENT {
                        tangent[lane] += stiffness;
                    }
                }
            }
            ShearBackbone::Varying(varying) => {
                for lane in 0..LANES {
                    let response = varying.respond(trial[lane]);
                    load[lane] += response.load;
                    if TANGENT {
                        tangent[lane] += response.tangent;
                    }
                }
            }
            ShearBackbone::Piecewise(piecewise) => {
                for lane in 0..LANES {
                    load[lane] += piecewise.load(trial[lane]);
                    if TANGENT {
                        tangent[lane] += piecewise.tangent(trial[lane]);
                    }
                }
            }
        }

        // In lanes beyond the onset, the load of locking replaces the load of the backbone.
        if let Some(locking) = self.locked(trial) {
            let at_onset = self.law.backbone.respond(locking.onset);
            for lane in 0..LANES {
                let size = trial[lane].abs();
                let beyond = size > locking.onset;
                let Elastic { response, .. } = locking.respond(at_onset, size);
                let free = self.law.backbone.respond(trial[lane]);
                let load_change = response.load.copysign(trial[lane]) - free.load;
                load[lane] += if beyond { load_change } else { 0.0 };
                if TANGENT {
                    let tangent_change = response.tangent - free.tangent;
                    tangent[lane] += if beyond { tangent_change } else { 0.0 };
                }
            }
        }
    }

    #[inline(always)]
    fn add_elastic_energy(&self, _memory: &MemoryBatch<'_>, trial: &Lanes, energies: &mut Lanes) {
        for lane in 0..LANES {
            energies[lane] += self.law.backbone.energy(trial[lane]);
        }
        if self.locked(trial).is_some() {
            // The energy of locking has a logarithm, which is computed one lane at a time.
            for lane in 0..LANES {
                let free = self.law.backbone.energy(trial[lane]);
                energies[lane] += self.law.elastic(trial[lane]).energy - free;
            }
        }
    }
}
