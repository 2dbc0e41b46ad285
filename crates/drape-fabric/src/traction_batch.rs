#![allow(clippy::needless_range_loop, reason = "a lane is a place in many arrays")]

use drape_hysteresis::exp_m1;

use crate::batch::{BatchLaw, LANES, Lanes, Responses, Sliders, any, positive};
use crate::memories::{Lane, Remembered};
use crate::{Buckling, Polynomial, Primed, TractionBackbone, TractionLaw};

/// A [`TractionLaw`] for many segments side by side.
///
/// The length of the priming zone is kept with the memory. For a law without one it is 1, where
/// nothing depends on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TractionBatch {
    law: TractionLaw,
    sliders: Sliders,
    /// Weight of the friction at rest.
    at_rest: f64,
    /// Growth of the weight while a buckled yarn straightens.
    straightening: f64,
}

impl TractionBatch {
    /// Prepares a law.
    #[must_use]
    pub fn new(law: TractionLaw) -> Self {
        let at_rest = match &law.backbone {
            TractionBackbone::Primed(primed) => 2.0 - 1.0 / primed.toe_ratio,
            TractionBackbone::Polynomial(_) => 1.0,
        };
        Self {
            law,
            sliders: Sliders::new(&law.friction),
            at_rest,
            straightening: at_rest / law.buckling.strain,
        }
    }

    #[inline(always)]
    fn tension<const TANGENT: bool>(
        &self,
        primed: &Primed,
        (memory, trial): (&Remembered<'_>, &Lanes),
        responses: &mut Responses,
    ) {
        let Responses { load, tangent } = responses;
        let Primed { stiffness, toe_ratio, toe_strain, toe_strain_after } = *primed;
        let bow = 1.0 - toe_ratio;
        for lane in 0..LANES {
            let (strain, [toe, priming]) = (positive(trial[lane]), memory.lane(lane).toe);
            // The weight's slope in the toe is (1 − r)/(r ε_c).
            let bend = toe_ratio * priming * strain;
            let within = stiffness * strain * (bend + 2.0 * toe_ratio - 1.0);
            let beyond = stiffness * (strain - bow * toe);
            let bends = strain <= toe;
            load[lane] += if bends { within } else { beyond };
            if TANGENT {
                let slope = stiffness * (2.0 * bend + 2.0 * toe_ratio - 1.0);
                tangent[lane] += if bends { slope } else { stiffness };
            }
        }
        if self.lengthens(primed, memory, trial) {
            for lane in 0..LANES {
                let strain = trial[lane];
                let new = strain > memory.lane(lane).peak.max(toe_strain);
                // The toe moves along: it takes the place of the one that was kept.
                let toe = toe_after(primed, strain);
                let softer = stiffness * bow * (memory.lane(lane).toe[0] - toe);
                load[lane] += if new { softer } else { 0.0 };
                if TANGENT {
                    let growth = (toe_strain_after - toe) / toe_strain;
                    tangent[lane] -= if new { stiffness * bow * growth } else { 0.0 };
                }
            }
        }
    }

    /// Whether some lane is stretched further than ever and its toe with it.
    #[inline(always)]
    fn lengthens(&self, primed: &Primed, memory: &Remembered<'_>, trial: &Lanes) -> bool {
        any(|lane| trial[lane] > memory.lane(lane).peak.max(primed.toe_strain))
    }

    #[inline(always)]
    fn compression<const TANGENT: bool>(&self, trial: &Lanes, responses: &mut Responses) {
        let Responses { load, tangent } = responses;
        let rest = self.law.backbone.rest_stiffness();
        let Buckling { strain, stiffness } = self.law.buckling;
        for lane in 0..LANES {
            let squeeze = -positive(-trial[lane]);
            let lost = exp_m1(squeeze / strain);
            load[lane] += rest * strain * lost - 0.5 * stiffness * squeeze * squeeze;
            if TANGENT {
                // In tension the slope is the other branch's.
                let slope = rest * (1.0 + lost) - stiffness * squeeze;
                let at_rest = rest;
                tangent[lane] += if squeeze < 0.0 { slope - at_rest } else { 0.0 };
            }
        }
    }
}

/// [`Primed::toe`] in straight arithmetic.
#[inline(always)]
fn toe_after(primed: &Primed, peak: f64) -> f64 {
    let beyond = positive(peak - primed.toe_strain) / primed.toe_strain;
    primed.toe_strain - (primed.toe_strain_after - primed.toe_strain) * exp_m1(-beyond)
}

impl BatchLaw for TractionBatch {
    const KNOTS: usize = 3;
    const AGES: bool = true;

    #[inline(always)]
    fn sliders(&self) -> &Sliders {
        &self.sliders
    }

    #[inline(always)]
    fn toe(&self, peak: f64) -> [f64; 2] {
        match &self.law.backbone {
            TractionBackbone::Primed(primed) => {
                let end = toe_after(primed, peak);
                [end, (1.0 - self.at_rest) / end]
            }
            TractionBackbone::Polynomial(_) => [1.0, 0.0],
        }
    }

    #[inline(always)]
    fn peak(&self, peak: f64, trial: f64) -> f64 {
        peak.max(trial)
    }

    #[inline(always)]
    fn weight(&self, lane: Lane, strain: f64) -> f64 {
        let [toe, priming] = lane.toe;
        let stretched = self.at_rest + priming * strain;
        let squeezed = positive(self.at_rest + self.straightening * strain);
        let within = if strain >= 0.0 { stretched } else { squeezed };
        if strain >= toe { 1.0 } else { within }
    }

    #[inline(always)]
    fn slope(&self, lane: Lane, rising: bool) -> f64 {
        let at = lane.position;
        let below = |knot: f64| (at < knot) | (!rising & (at == knot));
        let [toe, priming] = lane.toe;
        let mut slope = if below(toe) { priming } else { 0.0 };
        slope = if below(0.0) { self.straightening } else { slope };
        if below(-self.law.buckling.strain) { 0.0 } else { slope }
    }

    #[inline(always)]
    fn knot(&self, knot: usize, lane: Lane) -> (f64, f64) {
        let [toe, priming] = lane.toe;
        match knot {
            0 => (-self.law.buckling.strain, self.straightening),
            1 => (0.0, priming - self.straightening),
            _ => (toe, -priming),
        }
    }

    #[inline(always)]
    fn elastic<const TANGENT: bool>(
        &self,
        memory: &Remembered<'_>,
        trial: &Lanes,
        responses: &mut Responses,
    ) {
        match &self.law.backbone {
            TractionBackbone::Primed(primed) => {
                self.tension::<TANGENT>(primed, (memory, trial), responses);
            }
            TractionBackbone::Polynomial(Polynomial { quadratic, quartic }) => {
                for lane in 0..LANES {
                    let strain = positive(trial[lane]);
                    let square = strain * strain;
                    responses.load[lane] += square * (quadratic + quartic * square);
                    if TANGENT {
                        let slope = 2.0 * quadratic + 4.0 * quartic * square;
                        responses.tangent[lane] += strain * slope;
                    }
                }
            }
        }
        if any(|lane| trial[lane] < 0.0) {
            self.compression::<TANGENT>(trial, responses);
        }
    }

    #[inline(always)]
    fn energy(&self, memory: &Remembered<'_>, trial: &Lanes, energies: &mut Lanes) {
        match &self.law.backbone {
            TractionBackbone::Primed(primed) => {
                for lane in 0..LANES {
                    let strain = positive(trial[lane]);
                    energies[lane] += primed.fixed_energy(memory.lane(lane).toe[0], strain);
                }
                if self.lengthens(primed, memory, trial) {
                    let Primed { stiffness, toe_ratio, toe_strain, toe_strain_after } = *primed;
                    for lane in 0..LANES {
                        let (strain, toe) = (trial[lane], memory.lane(lane).toe[0]);
                        let seen = memory.lane(lane).peak.max(toe_strain);
                        // The moving toe's integral less that of the one that was kept.
                        let way = strain - seen;
                        let toes = (toe_strain_after - toe) * way
                            - toe_strain * (toe_after(primed, strain) - toe);
                        let softer = stiffness * (1.0 - toe_ratio) * toes;
                        energies[lane] -= if way > 0.0 { softer } else { 0.0 };
                    }
                }
            }
            TractionBackbone::Polynomial(Polynomial { quadratic, quartic }) => {
                for lane in 0..LANES {
                    let strain = positive(trial[lane]);
                    let square = strain * strain;
                    let mean = quadratic / 3.0 + quartic * square / 5.0;
                    energies[lane] += strain * square * mean;
                }
            }
        }
        if any(|lane| trial[lane] < 0.0) {
            let rest = self.law.backbone.rest_stiffness();
            let Buckling { strain, stiffness } = self.law.buckling;
            for lane in 0..LANES {
                let squeeze = -positive(-trial[lane]);
                let lost = exp_m1(squeeze / strain);
                energies[lane] += rest * strain * (strain * lost - squeeze)
                    - stiffness * squeeze * squeeze * squeeze / 6.0;
            }
        }
    }
}
