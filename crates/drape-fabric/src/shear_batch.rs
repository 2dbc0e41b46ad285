#![allow(clippy::needless_range_loop, reason = "a lane is a place in many arrays")]

use crate::batch::{BatchLaw, LANES, Lanes, Responses, Sliders, any};
use crate::memories::{Lane, Remembered};
use crate::{Locking, ShearBackbone, ShearLaw};

/// A [`ShearLaw`] for many corners side by side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShearBatch {
    law: ShearLaw,
    sliders: Sliders,
}

impl ShearBatch {
    /// Prepares a law.
    #[must_use]
    pub fn new(law: ShearLaw) -> Self {
        let sliders = Sliders::new(&law.friction);
        Self { law, sliders }
    }

    /// The jamming of the yarns, if some lane has got there.
    #[inline(always)]
    fn jammed(&self, trial: &Lanes) -> Option<Locking> {
        self.law.locking.filter(|locking| any(|lane| trial[lane].abs() > locking.onset))
    }
}

impl BatchLaw for ShearBatch {
    const KNOTS: usize = 1;
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
    fn weight(&self, _lane: Lane, deformation: f64) -> f64 {
        1.0 + self.law.growth * deformation.abs()
    }

    #[inline(always)]
    fn slope(&self, lane: Lane, rising: bool) -> f64 {
        let falls = (lane.position < 0.0) | (!rising & (lane.position == 0.0));
        if falls { -self.law.growth } else { self.law.growth }
    }

    #[inline(always)]
    fn knot(&self, _knot: usize, _lane: Lane) -> (f64, f64) {
        (0.0, 2.0 * self.law.growth)
    }

    #[inline(always)]
    fn elastic<const TANGENT: bool>(
        &self,
        _memory: &Remembered<'_>,
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
            ShearBackbone::Piecewise(piecewise) => {
                for lane in 0..LANES {
                    load[lane] += piecewise.load(trial[lane]);
                    if TANGENT {
                        tangent[lane] += piecewise.tangent(trial[lane]);
                    }
                }
            }
        }
        if let Some(locking) = self.jammed(trial) {
            let at_onset = self.law.backbone.respond(locking.onset);
            for lane in 0..LANES {
                let size = trial[lane].abs();
                let beyond = size > locking.onset;
                let (response, _) = locking.respond(at_onset, size);
                let free = self.law.backbone.respond(trial[lane]);
                let more = response.load.copysign(trial[lane]) - free.load;
                load[lane] += if beyond { more } else { 0.0 };
                if TANGENT {
                    let more = response.tangent - free.tangent;
                    tangent[lane] += if beyond { more } else { 0.0 };
                }
            }
        }
    }

    #[inline(always)]
    fn energy(&self, _memory: &Remembered<'_>, trial: &Lanes, energies: &mut Lanes) {
        for lane in 0..LANES {
            energies[lane] += self.law.backbone.energy(trial[lane]);
        }
        if self.jammed(trial).is_some() {
            // The logarithm of the jamming's energy is the library's, one lane at a time.
            for lane in 0..LANES {
                let free = self.law.backbone.energy(trial[lane]);
                energies[lane] += self.law.elastic(trial[lane]).1 - free;
            }
        }
    }
}
