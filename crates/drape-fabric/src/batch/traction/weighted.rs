//! The traction laws with a priming zone and with a polynomial for a batch. The weight of their
//! friction has three knots: the ends of buckling and of the priming zone, and zero strain.
#![allow(clippy::needless_range_loop, reason = "a lane indexes several arrays")]

use drape_hysteresis::BlimanSorine;

use crate::batch::batch_law::Responses;
use crate::batch::friction::PreparedFriction;
use crate::batch::lanes::{LANES, Lanes, any, positive};
use crate::batch::memories::{LaneMemory, MemoryBatch, Toe};
use crate::batch::traction::compression::Compression;
use crate::batch::traction::toe::toe_end;
use crate::batch::weighted_law::{Knot, WeightedLaw};
use crate::laws::traction::buckling::Buckling;
use crate::laws::traction::polynomial::Polynomial;
use crate::laws::traction::primed::Primed;

/// Elastic load of a traction law without an exponential toe.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum WeightedBackbone {
    /// Priming zone, then a line.
    Primed(Primed),
    /// Even polynomial of the strain.
    Polynomial(Polynomial),
}

/// A traction law without an exponential toe for many connectors side by side.
///
/// The memory contains the end of the priming zone ([`Toe`]). A law without a priming zone has this
/// end at a strain of 1, on which no weight depends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct WeightedTraction {
    backbone: WeightedBackbone,
    friction: PreparedFriction,
    compression: Compression,
    /// Weight of the friction at rest.
    at_rest: f64,
    /// Derivative of the weight with respect to the strain of a buckled yarn.
    buckled_slope: f64,
}

impl WeightedTraction {
    /// Prepares a law with the elastic load `backbone`, which has the stiffness `rest` at rest.
    pub(crate) fn new(
        backbone: WeightedBackbone,
        rest: f64,
        friction: &BlimanSorine,
        buckling: Buckling,
    ) -> Self {
        let at_rest = match &backbone {
            WeightedBackbone::Primed(primed) => 2.0 - 1.0 / primed.toe_ratio,
            WeightedBackbone::Polynomial(_) => 1.0,
        };
        Self {
            backbone,
            friction: PreparedFriction::new(friction),
            compression: Compression { rest, buckling },
            at_rest,
            buckled_slope: at_rest / buckling.strain,
        }
    }

    /// Adds the elastic load in tension of a law with the priming zone `primed`, and its tangent if
    /// `TANGENT`.
    #[inline(always)]
    fn add_tension<const TANGENT: bool>(
        &self,
        primed: &Primed,
        memory: &MemoryBatch<'_>,
        trial: &Lanes,
        responses: &mut Responses,
    ) {
        let Responses { load, tangent } = responses;
        let Primed { stiffness, toe_ratio, toe_strain, toe_strain_after } = *primed;
        let deficit = 1.0 - toe_ratio;
        for lane in 0..LANES {
            let (strain, toe) = (positive(trial[lane]), memory.lane(lane).toe);
            // The slope of the weight in the priming zone is (1 − r)/(r ε_c).
            let bend = toe_ratio * toe.weight_slope * strain;
            let within = stiffness * strain * (bend + 2.0 * toe_ratio - 1.0);
            let beyond = stiffness * (strain - deficit * toe.end);
            let bends = strain <= toe.end;
            load[lane] += if bends { within } else { beyond };
            if TANGENT {
                let slope = stiffness * (2.0 * bend + 2.0 * toe_ratio - 1.0);
                tangent[lane] += if bends { slope } else { stiffness };
            }
        }

        // If the priming zone moves with the strain, its end replaces the end in the memory.
        if self.extends_toe(primed, memory, trial) {
            for lane in 0..LANES {
                let strain = trial[lane];
                let moves = strain > memory.lane(lane).peak.max(toe_strain);
                let toe = toe_end(primed.toe_strain, primed.toe_strain_after, strain);
                let change = stiffness * deficit * (memory.lane(lane).toe.end - toe);
                load[lane] += if moves { change } else { 0.0 };
                if TANGENT {
                    let growth = (toe_strain_after - toe) / toe_strain;
                    tangent[lane] -= if moves { stiffness * deficit * growth } else { 0.0 };
                }
            }
        }
    }

    /// Returns whether any lane of `trial` is stretched beyond its largest elongation, which moves
    /// its toe.
    #[inline(always)]
    fn extends_toe(&self, primed: &Primed, memory: &MemoryBatch<'_>, trial: &Lanes) -> bool {
        any(|lane| trial[lane] > memory.lane(lane).peak.max(primed.toe_strain))
    }
}

/// Returns whether a path from `position` begins below `knot`. A falling path from the knot does.
#[inline(always)]
fn is_below(position: f64, knot: f64, rising: bool) -> bool {
    (position < knot) | (!rising & (position == knot))
}

impl WeightedLaw for WeightedTraction {
    const KNOTS: usize = 3;
    const DEPENDS_ON_PEAK: bool = true;

    #[inline(always)]
    fn friction(&self) -> &PreparedFriction {
        &self.friction
    }

    #[inline(always)]
    fn toe(&self, peak: f64) -> Toe {
        match &self.backbone {
            WeightedBackbone::Primed(primed) => {
                let end = toe_end(primed.toe_strain, primed.toe_strain_after, peak);
                Toe { end, weight_slope: (1.0 - self.at_rest) / end }
            }
            WeightedBackbone::Polynomial(_) => Toe { end: 1.0, weight_slope: 0.0 },
        }
    }

    #[inline(always)]
    fn peak(&self, peak: f64, trial: f64) -> f64 {
        peak.max(trial)
    }

    #[inline(always)]
    fn weight(&self, lane: LaneMemory, strain: f64) -> f64 {
        let toe = lane.toe;
        let stretched = self.at_rest + toe.weight_slope * strain;
        let compressed = positive(self.at_rest + self.buckled_slope * strain);
        let within = if strain >= 0.0 { stretched } else { compressed };
        if strain >= toe.end { 1.0 } else { within }
    }

    #[inline(always)]
    fn weight_slope(&self, lane: LaneMemory, rising: bool) -> f64 {
        let (position, toe) = (lane.position, lane.toe);
        let is_primed = is_below(position, toe.end, rising);
        let is_compressed = is_below(position, 0.0, rising);
        let is_buckled = is_below(position, -self.compression.buckling.strain, rising);
        let mut slope = if is_primed { toe.weight_slope } else { 0.0 };
        slope = if is_compressed { self.buckled_slope } else { slope };
        if is_buckled { 0.0 } else { slope }
    }

    #[inline(always)]
    fn knot(&self, knot: usize, lane: LaneMemory) -> Knot {
        let toe = lane.toe;
        let (position, slope_change) = match knot {
            0 => (-self.compression.buckling.strain, self.buckled_slope),
            1 => (0.0, toe.weight_slope - self.buckled_slope),
            _ => (toe.end, -toe.weight_slope),
        };
        Knot { position, slope_change }
    }

    #[inline(always)]
    fn add_elastic<const TANGENT: bool>(
        &self,
        memory: &MemoryBatch<'_>,
        trial: &Lanes,
        responses: &mut Responses,
    ) {
        match &self.backbone {
            WeightedBackbone::Primed(primed) => {
                self.add_tension::<TANGENT>(primed, memory, trial, responses);
            }
            WeightedBackbone::Polynomial(Polynomial { quadratic, quartic }) => {
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
        self.compression.add_load::<TANGENT>(trial, responses);
    }

    #[inline(always)]
    fn add_elastic_energy(&self, memory: &MemoryBatch<'_>, trial: &Lanes, energies: &mut Lanes) {
        match &self.backbone {
            WeightedBackbone::Primed(primed) => {
                for lane in 0..LANES {
                    let strain = positive(trial[lane]);
                    energies[lane] += primed.fixed_energy(memory.lane(lane).toe.end, strain);
                }

                if self.extends_toe(primed, memory, trial) {
                    let Primed { stiffness, toe_ratio, toe_strain, toe_strain_after } = *primed;
                    for lane in 0..LANES {
                        let (strain, toe) = (trial[lane], memory.lane(lane).toe.end);
                        let peak = memory.lane(lane).peak.max(toe_strain);
                        // Integral of the moving toe less the integral of the toe in the memory.
                        let beyond = strain - peak;
                        let toes = (toe_strain_after - toe) * beyond
                            - toe_strain
                                * (toe_end(primed.toe_strain, primed.toe_strain_after, strain)
                                    - toe);
                        let reduction = stiffness * (1.0 - toe_ratio) * toes;
                        energies[lane] -= if beyond > 0.0 { reduction } else { 0.0 };
                    }
                }
            }
            WeightedBackbone::Polynomial(Polynomial { quadratic, quartic }) => {
                for lane in 0..LANES {
                    let strain = positive(trial[lane]);
                    let square = strain * strain;
                    let mean = quadratic / 3.0 + quartic * square / 5.0;
                    energies[lane] += strain * square * mean;
                }
            }
        }
        self.compression.add_energy(trial, energies);
    }
}
