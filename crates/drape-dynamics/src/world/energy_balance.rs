//! Balance of the energy of a cloth, summed over the accepted steps.
//!
//! Energy that internal forces store and lose comes from their memories, that of contact, friction
//! with bodies and air from their forces. In one of some thirty sub-steps the loss of the integrator
//! is found by itself too, from differences of velocities and from the work of all forces along the
//! sub-step, by quadrature; in the others it is what the other entries leave. The residual of the
//! balance, [`Energy::residual`], therefore tells whether forces, potentials and works agree. The
//! cost of rotation is what the memories miss of the internal forces' potential.

use drape_implicit::Report;
use serde::{Deserialize, Serialize};

use super::contact::ContactEnergy;

/// Balance of the energy since the start, in J: the energy put in is stored, or lost to friction in
/// the fabric, to friction with bodies and of cloth on cloth, to the air, to the integrator, or to the rotation of the
/// cloth.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Energy {
    /// Kinetic energy.
    pub kinetic: f64,
    /// Energy stored in the fabric since the start.
    pub elastic: f64,
    /// Work done against the weight; the fall makes it negative.
    pub gravity: f64,
    /// Energy stored in the contact with bodies since the start.
    pub contact: f64,
    /// Energy lost in the fabric's friction.
    pub friction_dissipated: f64,
    /// Energy lost in the friction with bodies.
    pub body_dissipated: f64,
    /// Energy lost in the friction of cloth on cloth.
    pub cloth_dissipated: f64,
    /// Energy lost to the air.
    pub air_dissipated: f64,
    /// Energy lost by the formula of the integrator, and by the residual that the solver leaves.
    pub numerical_dissipated: f64,
    /// Cost of the rotation of the cloth: a step measures curvatures along the normals at its
    /// start, the memory of the bending friction along those at its end. Of either sign, some
    /// thousandths of the friction at usual steps, less at shorter ones, and nothing where bending
    /// has no friction.
    #[serde(rename = "turning_dissipated")]
    pub rotation_dissipated: f64,
    /// Work done on the cloth by bodies that move, by pins and by forces that a program applies; where
    /// a pin holds in some directions alone, the work of its springs counts.
    pub work_in: f64,
    /// Residual of the balance: what its entries leave open in the sub-steps, one of some thirty, in
    /// which each is found by itself. It is the error of a quadrature, some millionths of what these
    /// exchange, unless forces and potentials contradict each other.
    #[serde(rename = "remainder")]
    pub residual: f64,
    /// Energy exchanged in steps whose straight path leads through a body or through other cloth:
    /// their loss to the integrator is taken for what the other entries leave.
    pub unproved: f64,
}

/// Sums of the energy over the steps.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(crate) struct EnergyBalance {
    /// Energy stored by the internal forces now, in J.
    stored: f64,
    /// Energy of contact at the start of the step.
    #[serde(skip)]
    contact: ContactEnergy,
    /// Potential of the internal forces when it was first and last asked for in this step, in J.
    /// With the balance on, the integrator does so at the start and at the end.
    #[serde(skip)]
    internal: Option<FirstAndLast>,
    /// Kinetic energy at the start, in J.
    kinetic_at_start: f64,
    sums: Energy,
}

#[derive(Debug, Clone, Copy, Default)]
struct FirstAndLast {
    first: f64,
    last: f64,
}

/// Energies of one step, in J.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct StepEnergy {
    /// Work against the weight.
    pub(crate) gravity: f64,
    /// Work of the forces that a program applies.
    pub(crate) external_work: f64,
    /// Growth of the energy of contact.
    pub(crate) contact: f64,
    /// Work of the springs of pins, with their forces at the end of the step.
    pub(crate) spring_work: f64,
    /// Fall of the potential of these springs, which jumps with their prescribed positions at the
    /// start of the step.
    pub(crate) spring_potential_fall: f64,
    /// Work of bodies that move, or of the growth of distances of surfaces, against contact.
    pub(crate) body_work: f64,
    /// Work of the friction of bodies that move.
    pub(crate) body_friction_work: f64,
    /// Work against the friction of surfaces, with its force at the end of the step.
    pub(crate) body_friction_loss: f64,
    /// Part of this loss that is of cloth on cloth.
    pub(crate) cloth_friction_loss: f64,
    /// Growth of the potential of that friction, of which the solution of the step is the minimum.
    pub(crate) body_friction_potential: f64,
    /// Work against the air, with its force at the end of the step; its potential is half of that.
    pub(crate) air: f64,
    /// Work against the forces that remove momentum.
    pub(crate) momentum_removal: f64,
    /// Loss in the friction of the internal forces.
    pub(crate) internal_friction: f64,
    /// Energy stored by the internal forces at the end.
    pub(crate) stored: f64,
}

impl EnergyBalance {
    /// Begins a balance with the energy that the internal forces store, and the kinetic energy, in
    /// J.
    pub(crate) fn new(stored: f64, kinetic: f64) -> Self {
        Self { stored, kinetic_at_start: kinetic, ..Self::default() }
    }

    /// Opens a step with the energy of contact at its start.
    pub(crate) fn begin(&mut self, contact: ContactEnergy) {
        self.contact = contact;
        self.internal = None;
    }

    /// Energy of contact at the start of the step.
    pub(crate) fn contact_at_start(&self) -> ContactEnergy {
        self.contact
    }

    /// Notes a potential of the internal forces that was evaluated in the step, in J.
    pub(crate) fn note_internal_potential(&mut self, potential: f64) {
        let first = self.internal.map_or(potential, |noted| noted.first);
        self.internal = Some(FirstAndLast { first, last: potential });
    }

    /// Adds an accepted step.
    pub(crate) fn add(&mut self, step: &StepEnergy) {
        let FirstAndLast { first, last } = self.internal.unwrap_or_default();
        let sums = &mut self.sums;
        sums.rotation_dissipated +=
            last - first - (step.stored - self.stored) - step.internal_friction;
        sums.gravity += step.gravity;
        sums.contact += step.contact;
        sums.work_in += step.body_work + step.body_friction_work + step.spring_work;
        sums.work_in += step.external_work;
        sums.elastic += step.stored - self.stored;
        sums.friction_dissipated += step.internal_friction;
        sums.body_dissipated += step.body_friction_loss - step.cloth_friction_loss;
        sums.cloth_dissipated += step.cloth_friction_loss;
        sums.air_dissipated += step.air;
        // The integrator takes potentials for the work of all forces. For forces that grow along
        // the step, as friction and drag with the speed, that falls short of the work at its end.
        sums.numerical_dissipated +=
            step.body_friction_potential - step.body_friction_loss - 0.5 * step.air;
        sums.numerical_dissipated += step.spring_work - step.spring_potential_fall;
        sums.numerical_dissipated += step.body_friction_work;
        sums.numerical_dissipated += step.momentum_removal;
        self.stored = step.stored;
    }

    /// Adds the loss and the work that the integrator reports.
    pub(crate) fn add_report(&mut self, report: &Report) {
        if let Some(energy) = &report.energy {
            self.sums.numerical_dissipated += energy.numerical_dissipation;
            self.sums.work_in += energy.work;
            self.sums.unproved += energy.unproved;
        }
    }

    /// Balance so far, with the kinetic energy now, in J.
    pub(crate) fn energy(&self, kinetic: f64) -> Energy {
        let Energy { elastic, gravity, contact, .. } = self.sums;
        let Energy { friction_dissipated, air_dissipated, .. } = self.sums;
        let Energy { body_dissipated, cloth_dissipated, .. } = self.sums;
        let held = kinetic - self.kinetic_at_start + elastic + gravity + contact;
        let rotation = self.sums.rotation_dissipated;
        let surfaces = body_dissipated + cloth_dissipated;
        let lost = friction_dissipated + surfaces + air_dissipated + rotation;
        let residual = self.sums.work_in - held - lost - self.sums.numerical_dissipated;
        Energy { kinetic, residual, ..self.sums }
    }
}
