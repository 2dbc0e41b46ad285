use drape_implicit::Report;

use crate::summary::Energy;

/// Where the energy of a cloth went, summed up over the steps, in J.
///
/// Each entry is found by itself: what the connectors store and lose from their memories, contact and
/// friction with bodies and air from their forces, and the loss of the integrator from its formula. So
/// what is left of the balance, [`Energy::remainder`], tells whether they agree.
#[derive(Debug, Clone, Default)]
pub(crate) struct Ledger {
    /// Stored in the connectors now.
    pub(crate) stored: f64,
    /// In the contact with bodies at the start of the step.
    pub(crate) barrier: f64,
    /// Potential of the friction with bodies at the start of the step, which they have moved on from.
    pub(crate) slip: f64,
    /// What their way in this step did to the energy of contact; of surfaces, what keeping more distance did.
    pub(crate) push: f64,
    /// Potential of the connectors when it was first and last asked for in this step. With the balance
    /// on, the integrator does so at the start and at the end.
    pub(crate) connectors: Option<[f64; 2]>,
    /// Room for forces, one of them with and one without the friction of the step.
    pub(crate) forces: [Vec<f64>; 2],
    /// Kinetic energy at the start.
    pub(crate) start: f64,
    sums: Energy,
}

/// Work done on the way of one step, in J.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Entry {
    /// Against the weight.
    pub(crate) gravity: f64,
    /// Growth of the energy of contact.
    pub(crate) contact: f64,
    /// By what holds particles in some directions, with its force at the end of the step.
    pub(crate) hold: f64,
    /// Fall of its potential, which has leapt with the places that it holds to at the start of the step.
    pub(crate) hold_potential: f64,
    /// By bodies that move, or by surfaces that keep more distance, against contact; and by friction of bodies.
    pub(crate) push: f64,
    pub(crate) drive: f64,
    /// Against the friction with bodies, with its force at the end of the step.
    pub(crate) slip: f64,
    /// Growth of the same friction's potential, which is what the step's solution is the minimum of.
    pub(crate) slip_potential: f64,
    /// Against the air, with its force at the end of the step; its potential is half of that.
    pub(crate) air: f64,
    /// Against what takes a creeping cloth's momentum.
    pub(crate) brake: f64,
    /// Lost in the friction of the connectors.
    pub(crate) friction: f64,
    /// Stored in the connectors at the end.
    pub(crate) stored: f64,
}

impl Ledger {
    pub(crate) fn new(stored: f64, particles: usize) -> Self {
        let forces = [vec![0.0; 3 * particles], vec![0.0; 3 * particles]];
        Self { stored, forces, ..Self::default() }
    }

    /// Takes note of the potential of the connectors somewhere in the step.
    pub(crate) fn saw(&mut self, potential: f64) {
        let first = self.connectors.map_or(potential, |[first, _]| first);
        self.connectors = Some([first, potential]);
    }

    pub(crate) fn enter(&mut self, entry: &Entry) {
        let [start, end] = self.connectors.unwrap_or_default();
        let sums = &mut self.sums;
        sums.turning_dissipated += end - start - (entry.stored - self.stored) - entry.friction;
        sums.gravity += entry.gravity;
        sums.contact += entry.contact;
        sums.work_in += entry.push + entry.drive + entry.hold;
        sums.elastic += entry.stored - self.stored;
        sums.friction_dissipated += entry.friction;
        sums.body_dissipated += entry.slip;
        sums.air_dissipated += entry.air;
        // The integrator takes potentials for the work of all forces. For forces that grow along the
        // step, as friction and drag with the speed, that falls short of the work at its end.
        sums.numerical_dissipated += entry.slip_potential - entry.slip - 0.5 * entry.air;
        sums.numerical_dissipated += entry.hold - entry.hold_potential;
        sums.numerical_dissipated += entry.drive;
        sums.numerical_dissipated += entry.brake;
        self.stored = entry.stored;
    }

    /// Adds what the integrator reports.
    pub(crate) fn report(&mut self, report: &Report) {
        if let Some(energy) = &report.energy {
            self.sums.numerical_dissipated += energy.numerical_dissipation;
            self.sums.work_in += energy.work;
        }
    }

    /// The balance so far, given the kinetic energy now.
    pub(crate) fn balance(&self, kinetic: f64) -> Energy {
        let Energy { elastic, gravity, contact, .. } = self.sums;
        let Energy { friction_dissipated, body_dissipated, air_dissipated, .. } = self.sums;
        let held = kinetic - self.start + elastic + gravity + contact;
        let turning = self.sums.turning_dissipated;
        let lost = friction_dissipated + body_dissipated + air_dissipated + turning;
        let remainder = self.sums.work_in - held - lost - self.sums.numerical_dissipated;
        Energy { kinetic, remainder, ..self.sums }
    }
}
