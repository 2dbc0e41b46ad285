//! A strip with an exponential toe and friction that grows with the tension.

use drape_fabric::{
    Buckling, ExponentialToe, Memory, ProportionalFriction, TractionBackbone, TractionFriction,
    TractionLaw,
};
use drape_hysteresis::exp_m1;

use crate::forward::strip_drive::strip_state::{StripState, StripStep};

/// Traction law with an exponential toe that stores the end of its toe and the quantities that need
/// an exponential.
pub(crate) struct ExponentialStrip {
    toe: ExponentialToe,
    friction: ProportionalFriction,
    buckling: Buckling,
    /// `$e^{-b} - 1$` with the steepness `$b$`.
    rest: f64,
    rest_stiffness: f64,
    deficit: f64,
}

impl ExponentialStrip {
    /// Prepares `law`; `None` if its toe is not exponential.
    pub(crate) fn new(law: &TractionLaw) -> Option<Self> {
        let TractionBackbone::Exponential(toe) = law.backbone else { return None };
        let friction = match law.friction {
            TractionFriction::Proportional(friction) => friction,
            TractionFriction::Plateau(_) => {
                ProportionalFriction { ratio: 0.0, plateau: 0.0, length: 1.0 }
            }
        };
        Some(Self {
            toe,
            friction,
            buckling: law.buckling,
            rest: exp_m1(-toe.steepness),
            rest_stiffness: toe.rest_stiffness(),
            deficit: toe.deficit(),
        })
    }

    /// Returns the state of a strip at rest that was never stretched.
    pub(crate) fn virgin(&self) -> StripState {
        StripState { memory: Memory::default(), toe: self.toe.toe_strain }
    }

    /// Returns load and state at `strain`, after the state `state`.
    pub(crate) fn step(&self, state: &StripState, strain: f64) -> StripStep {
        let StripState { memory, toe } = *state;
        let ExponentialToe { toe_strain, toe_strain_after, .. } = self.toe;
        let peak = memory.peak.max(strain);
        let moves = strain > memory.peak.max(toe_strain) && toe_strain_after > toe_strain;
        let next_toe = if moves { self.toe.toe(strain) } else { toe };

        // The friction has a weight that follows the load in tension, and decays in compression.
        let ProportionalFriction { ratio, plateau, length } = self.friction;
        let (elastic, weight) = if strain >= 0.0 {
            let tension = self.tension(next_toe, strain);
            (tension, plateau + ratio * tension)
        } else {
            let kept = 1.0 + exp_m1(strain / self.buckling.strain);
            (self.compression(strain), plateau * kept)
        };
        let slip = strain - memory.position;
        let [before, _] = memory.friction;
        let sign = 1_f64.copysign(slip);
        let friction = sign + (before - sign) * (1.0 + exp_m1(-slip.abs() / length));

        let memory = Memory { position: strain, friction: [friction, 0.0], peak };
        StripStep { load: elastic + weight * friction, state: StripState { memory, toe: next_toe } }
    }

    /// Returns the elastic load at a `strain` of at least 0, with a toe that ends at `toe`.
    fn tension(&self, toe: f64, strain: f64) -> f64 {
        let ExponentialToe { base_stiffness, stiffness, steepness, .. } = self.toe;
        let added = if strain > toe {
            strain - self.deficit * toe
        } else {
            let below = exp_m1(steepness * (strain / toe) - steepness);
            toe / steepness * (below - self.rest)
        };
        base_stiffness * strain + stiffness * added
    }

    /// Returns the elastic load at a negative `strain`.
    fn compression(&self, strain: f64) -> f64 {
        let Buckling { strain: scale, stiffness } = self.buckling;
        self.rest_stiffness * scale * exp_m1(strain / scale) - 0.5 * stiffness * strain * strain
    }
}
