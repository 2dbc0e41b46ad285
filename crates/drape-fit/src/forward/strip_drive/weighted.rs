//! A strip with a traction law of the papers, whose friction has a plateau.

use drape_fabric::{BlimanSorine, Memory, Primed, TractionBackbone, TractionFriction, TractionLaw};
use drape_hysteresis::Slip;

use crate::forward::strip_drive::strip_state::{StripState, StripStep};

/// Traction law of the papers that stores the length of its priming zone, which needs an
/// exponential.
///
/// It is the law of drape-fabric, in half the time along a history.
pub(crate) struct WeightedStrip<'a> {
    law: &'a TractionLaw,
    friction: BlimanSorine,
    primed: Option<Primed>,
    /// Weight of the friction at rest.
    weight_at_rest: f64,
}

impl<'a> WeightedStrip<'a> {
    /// Prepares `law` for a history.
    pub(crate) fn new(law: &'a TractionLaw) -> Self {
        let (primed, weight_at_rest) = match law.backbone {
            TractionBackbone::Primed(primed) => (Some(primed), 2.0 - 1.0 / primed.toe_ratio),
            TractionBackbone::Polynomial(_) | TractionBackbone::Exponential(_) => (None, 1.0),
        };
        let friction = match law.friction {
            TractionFriction::Plateau(friction) => friction,
            TractionFriction::Proportional(_) => BlimanSorine::none(),
        };
        Self { law, friction, primed, weight_at_rest }
    }

    /// Returns the state of a strip at rest that was never stretched.
    pub(crate) fn virgin(&self) -> StripState {
        let toe = self.primed.map_or(0.0, |primed| primed.toe_strain);
        StripState { memory: Memory::default(), toe }
    }

    /// Returns load and state at `strain`, after the state `state`.
    ///
    /// With the toe ratio `$r$` the elastic load is
    /// `$k\varepsilon((1 - r)\varepsilon/\varepsilon_c + 2r - 1)$` up to the end `$\varepsilon_c$`
    /// of the priming zone, and `$k(\varepsilon - (1 - r)\varepsilon_c)$` beyond \[NB04, eq. 3\].
    pub(crate) fn step(&self, state: &StripState, strain: f64) -> StripStep {
        let StripState { memory, toe } = *state;
        let peak = memory.peak.max(strain);
        let (elastic, next_toe) = match self.primed {
            Some(primed) if strain >= 0.0 => {
                let Primed { stiffness, toe_ratio, toe_strain, toe_strain_after } = primed;
                let quadratic = 1.0 - toe_ratio;
                let longer = strain > memory.peak.max(toe_strain);
                let grows = longer && toe_strain_after != toe_strain;
                let next = if grows { primed.toe(strain) } else { toe };
                let load = if longer || strain > toe {
                    stiffness * (strain - quadratic * next)
                } else {
                    stiffness * strain * (quadratic * strain / toe + 2.0 * toe_ratio - 1.0)
                };
                (load, next)
            }
            _ => (self.law.elastic(memory.peak, strain).load, toe),
        };
        let friction = self.friction(state, strain);
        let memory = Memory { position: strain, friction, peak };
        let load = elastic + friction[0] + friction[1];
        StripStep { load, state: StripState { memory, toe: next_toe } }
    }

    /// Returns the friction at `strain` after a monotonic step from `state`. The step is split
    /// where the slope of the weight changes.
    fn friction(&self, state: &StripState, strain: f64) -> [f64; 2] {
        let StripState { memory, toe } = *state;
        let slack = -self.law.buckling.strain;
        let mut ends: Vec<f64> = [slack, 0.0, toe]
            .into_iter()
            .filter(|knot| {
                (*knot > memory.position && *knot < strain)
                    || (*knot < memory.position && *knot > strain)
            })
            .collect();
        if strain < memory.position {
            ends.reverse();
        }
        ends.push(strain);
        let (mut from, mut loads) = (memory.position, memory.friction);
        for to in ends {
            let slip = Slip::weighted(to - from, self.weight(from, toe), self.weight(to, toe));
            loads = self.friction.advance(loads, slip);
            from = to;
        }
        loads
    }

    /// Returns the weight of the friction at `strain`, with a priming zone that ends at `toe`.
    fn weight(&self, strain: f64, toe: f64) -> f64 {
        let slack = -self.law.buckling.strain;
        if strain >= toe {
            1.0
        } else if strain >= 0.0 {
            self.weight_at_rest + (1.0 - self.weight_at_rest) * strain / toe
        } else {
            self.weight_at_rest * (1.0 - strain / slack).max(0.0)
        }
    }
}
