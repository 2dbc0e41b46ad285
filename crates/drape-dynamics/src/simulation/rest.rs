use drape_implicit::{Error, Integrator, IntegratorState, Method, Settings};

use super::Simulation;
use crate::scheme::Scheme;

/// Time for which the cloth must stay slow to be at rest, in s.
///
/// A swing stops for a moment at each end of its way; a tenth of a second is longer than that for
/// everything but a cloth of many metres, and short against the seconds a drape takes.
const REST_TIME: f64 = 0.1;

/// Part of the imbalance of a creeping cloth to which its next step is solved: the forces that drive
/// the cloth are then known to some per cent. Steps solved better cost more and lead to the same rest.
const CREEP_TOLERANCE: f64 = 0.1;

/// The loosest tolerance of a creeping step. Looser ones saved no time on a cloth on a cube.
const CREEP_TOLERANCE_MAX: f64 = 1e-2;

/// Part of the kinetic energy of a creeping step that it may leave to be gained: its forces are stiff, and most of what is
/// out of balance after a few iterations hardly moves the cloth. From four starts a cloth on a cube took 1450 tangents
/// without it, 810 with it, and 800 with three times as much; a cloth on a sphere then stored 2 % more.
const CREEP_ENERGY: f64 = 3e-3;

/// An imbalance of so many times the one of rest is the last that leaves energy to be gained.
const NEAR_REST: f64 = 2.0;

/// How well a creeping step is solved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Accuracy {
    /// Root-mean-square error of the acceleration that it may leave, over g.
    pub tolerance: f64,
    /// Part of its kinetic energy that it may leave to be gained.
    pub energy: f64,
}

impl Accuracy {
    /// Of the first steps.
    pub(super) const CREEPING: Self = Self { tolerance: CREEP_TOLERANCE_MAX, energy: CREEP_ENERGY };
}

/// Linear residual relative to the nonlinear one at which the linear solver of a creeping step stops:
/// with so loose a tolerance a better direction is wasted. From 0.003 to 0.03 the time fell by a third.
const CREEP_FORCING: f64 = 0.03;

impl Simulation {
    /// Root-mean-square acceleration of the free particles in the last step, in m/s². A creeping cloth
    /// began it at rest.
    pub(super) fn acceleration(&self, dt: f64) -> f64 {
        let IntegratorState { velocities, previous, .. } = &self.motion;
        let Some(previous) = previous else { return 0.0 };
        // The step may have been made in parts; the last one is as long as it says.
        let dt = if previous.dt < dt { previous.dt } else { dt };
        let kept = if self.world.creeps { 0.0 } else { 1.0 };
        let changes = velocities.chunks_exact(3).zip(previous.velocities.chunks_exact(3));
        let (mut squares, mut free) = (0.0, 0_usize);
        for ((now, before), _) in changes.zip(&self.world.held).filter(|(_, held)| !**held) {
            let change = now.iter().zip(before).map(|(now, before)| now - kept * before);
            squares += change.map(|change| change * change).sum::<f64>();
            free += 1;
        }
        (squares / free.max(1) as f64).sqrt() / dt
    }

    /// Whether the cloth is at rest after a step of so many ticks. A creeping cloth is solved the
    /// better the nearer it is.
    pub(super) fn judge_rest(&mut self, ticks: usize) -> Result<(), Error> {
        let Some(settle) = self.settle else { return Ok(()) };
        let mut exact = true;
        if let (true, Scheme::Implicit(settings)) = (self.world.creeps, &self.scheme) {
            let Accuracy { tolerance, energy } = self.accuracy;
            exact = energy == 0.0
                && tolerance <= settings.tolerance.max(CREEP_TOLERANCE * settle.residual);
            let decade = 10.0_f64.powf((CREEP_TOLERANCE * self.imbalance).log10().floor());
            let tolerance = tolerance.min(decade.max(settings.tolerance));
            let near = self.imbalance <= NEAR_REST * settle.residual;
            let wanted = Accuracy { tolerance, energy: if near { 0.0 } else { energy } };
            if wanted != self.accuracy {
                self.accuracy = wanted;
                self.integration = self.start(&creeping(settings, wanted))?;
            }
        }
        let slow = self.speed_max <= settle.speed && self.imbalance <= settle.residual;
        let busy = self.world.last_change();
        let quiet = slow && exact && self.time() >= busy;
        self.quiet_ticks = if quiet { self.quiet_ticks + ticks } else { 0 };
        Ok(())
    }

    pub(super) fn settled(&self) -> bool {
        self.rested || self.at_rest()
    }

    pub(super) fn at_rest(&self) -> bool {
        self.settle.is_some() && self.quiet_ticks as f64 * self.clock.tick() >= REST_TIME
    }
}

impl Scheme {
    /// The scheme for steps that creep, with the accuracy that they begin with, or that do not; and their accuracy.
    pub(super) fn on_the_way(&self, creeps: Option<Accuracy>) -> (Self, Accuracy) {
        match (self, creeps) {
            (Self::Implicit(settings), Some(Accuracy { tolerance, energy })) => {
                let tolerance = settings.tolerance.max(tolerance);
                let accuracy = Accuracy { tolerance, energy };
                (creeping(settings, accuracy), accuracy)
            }
            (Self::Implicit(settings), None) => {
                let tolerance = settings.tolerance;
                (self.clone(), Accuracy { tolerance, energy: 0.0 })
            }
            (Self::Explicit, _) => (Self::Explicit, Accuracy { tolerance: 0.0, energy: 0.0 }),
        }
    }
}

/// Settings of creeping steps, by the formula without a past. A tangent kept for a second iteration is worth nothing in
/// long ones. Begun where the last step leads, a cloth on a cube took 23 300 iterations of conjugate gradients instead of
/// 33 400, one on a sphere 75 200 instead of 123 000, a gathered flounce 108 700 instead of 208 300, a T-shirt as many.
fn creeping(settings: &Settings, accuracy: Accuracy) -> Scheme {
    let method = match settings.method {
        Method::Broyden => Method::Newton,
        chosen => chosen,
    };
    let Accuracy { tolerance, energy: energy_tolerance } = accuracy;
    let newton_forcing = CREEP_FORCING;
    let integrator = Integrator::BackwardEuler;
    let begin_at_prediction = true;
    Scheme::Implicit(Settings {
        method,
        tolerance,
        energy_tolerance,
        newton_forcing,
        integrator,
        begin_at_prediction,
        ..settings.clone()
    })
}
