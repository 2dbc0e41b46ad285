//! Load of compressed yarns, for a batch.
#![allow(clippy::needless_range_loop, reason = "a lane indexes several arrays")]

use drape_hysteresis::exp_m1;

use crate::batch::batch_law::Responses;
use crate::batch::lanes::{LANES, Lanes, any, positive};
use crate::laws::traction::buckling::Buckling;

/// Compression of yarns that buckle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Compression {
    /// Stiffness at rest, in N/m.
    pub(crate) rest: f64,
    pub(crate) buckling: Buckling,
}

impl Compression {
    /// Adds the elastic load of the compressed lanes of `trial`, and its tangent if `TANGENT`.
    ///
    /// For these lanes `responses` must contain the tangent of tension at zero strain already.
    #[inline(always)]
    pub(crate) fn add_load<const TANGENT: bool>(&self, trial: &Lanes, responses: &mut Responses) {
        if !any(|lane| trial[lane] < 0.0) {
            return;
        }
        let Responses { load, tangent } = responses;
        let rest = self.rest;
        let Buckling { strain, stiffness } = self.buckling;
        for lane in 0..LANES {
            let compression = -positive(-trial[lane]);
            let lost = exp_m1(compression / strain);
            load[lane] += rest * strain * lost - 0.5 * stiffness * compression * compression;
            if TANGENT {
                let slope = rest * (1.0 + lost) - stiffness * compression;
                tangent[lane] += if compression < 0.0 { slope - rest } else { 0.0 };
            }
        }
    }

    /// Adds the elastic energy per area of the compressed lanes of `trial` to `energies`, in J/m².
    #[inline(always)]
    pub(crate) fn add_energy(&self, trial: &Lanes, energies: &mut Lanes) {
        if !any(|lane| trial[lane] < 0.0) {
            return;
        }
        let Buckling { strain, stiffness } = self.buckling;
        for lane in 0..LANES {
            let compression = -positive(-trial[lane]);
            let lost = exp_m1(compression / strain);
            energies[lane] += self.rest * strain * (strain * lost - compression)
                - stiffness * compression * compression * compression / 6.0;
        }
    }
}
