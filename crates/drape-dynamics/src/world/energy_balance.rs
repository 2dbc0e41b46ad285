//! Energy balance of a cloth, summed over the accepted steps.
//!
//! The stored and dissipated energies of internal forces come from their memories. The energies of
//! contact, of friction with bodies and of air come from their forces. In about one of thirty
//! sub-steps the dissipation of the integrator is computed independently: from differences of
//! velocities, and from the work of all forces along the sub-step, by quadrature. In the other
//! sub-steps it is the difference of the other entries. The residual of the balance,
//! [`Energy::residual`], therefore shows whether forces, potentials and works agree. The rotation
//! entry is the difference between the potential of the internal forces and their memories. The
//! residual is judged against the energy exchanged in the proved sub-steps.

use drape_implicit::Report;
use serde::{Deserialize, Serialize};

use super::air_drag::DragEnergy;
use super::contact::ContactEnergy;

/// Energy balance since the start, in J. The energy put in is stored, or dissipated by friction in
/// the fabric, by friction with bodies, by friction of cloth on cloth, by the air, by the
/// integrator, or by the rotation of the cloth.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Energy {
    /// Kinetic energy.
    pub kinetic: f64,
    /// Energy stored in the fabric since the start.
    pub elastic: f64,
    /// Work done against the weight. Negative when the cloth falls.
    pub gravity: f64,
    /// Energy stored in the contact with bodies since the start.
    pub contact: f64,
    /// Energy dissipated by friction in the fabric.
    pub friction_dissipated: f64,
    /// Energy dissipated by friction with bodies.
    pub body_dissipated: f64,
    /// Energy dissipated by friction of cloth on cloth.
    pub cloth_dissipated: f64,
    /// Energy dissipated by the motion of the cloth relative to the air.
    pub air_dissipated: f64,
    /// Energy of contact that was set free where bodies pinched cloth that then kept less distance
    /// from them, or none.
    pub pinch_released: f64,
    /// Energy dissipated by the formula of the integrator and by the residual of the solver.
    pub numerical_dissipated: f64,
    /// Part of `numerical_dissipated` and `rotation_dissipated` that steps of quasi-static
    /// relaxation took. They take energy on purpose: cloth comes to rest without swinging.
    pub relaxation_dissipated: f64,
    /// Cost of the rotation of the cloth. A step measures curvatures along the normals at its
    /// start, and the memory of the bending friction measures curvatures along the normals at its
    /// end. The entry has either sign. It is some thousandths of the friction at usual steps,
    /// smaller at shorter steps, and 0 if bending has no friction.
    #[serde(rename = "turning_dissipated")]
    pub rotation_dissipated: f64,
    /// Work done on the cloth by moving bodies, by pins, by moving air and by forces that a program
    /// sets. For a pin that holds in some directions only, the work of its springs counts. A
    /// particle that a program holds in flight gives its kinetic energy to its pin.
    pub work_in: f64,
    /// Residual of the balance in the sub-steps in which every entry is computed independently
    /// (about one of thirty). It is the error of a quadrature, some millionths of the energy
    /// exchanged, unless forces and potentials contradict each other.
    #[serde(rename = "remainder")]
    pub residual: f64,
    /// Energy exchanged in steps whose straight path leads through a body or through other cloth.
    /// The dissipation of the integrator in these steps is the difference of the other entries.
    pub unproved: f64,
    /// Energy exchanged since the start: the sum over all sub-steps of the absolute changes of
    /// kinetic energy and potential, of the dissipation of the formula, and of the work on held
    /// particles. Energy that changes its form and changes back counts twice.
    pub exchanged: f64,
    /// Part of `exchanged` in the sub-steps in which every entry is computed independently.
    pub proved: f64,
}

impl Energy {
    /// Returns the energy that is unaccounted for as a fraction of what was exchanged where every
    /// entry is computed independently. Returns 0 where nothing was.
    #[must_use]
    pub fn unaccounted_fraction(&self) -> f64 {
        if self.proved > 0.0 { self.residual.abs() / self.proved } else { 0.0 }
    }

    /// Returns the energy that steps in time lost to the integration, in J, without what steps of
    /// quasi-static relaxation took. It is negative if the integration gained energy.
    #[must_use]
    pub fn integration_loss(&self) -> f64 {
        self.numerical_dissipated + self.rotation_dissipated - self.relaxation_dissipated
    }
}

/// Sums of the energy over the steps.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(crate) struct EnergyBalance {
    /// Energy stored by the internal forces now, in J.
    stored: f64,
    /// Energy of contact at the start of the step.
    #[serde(skip)]
    contact: ContactEnergy,
    /// Potential of the internal forces when it was first and last evaluated in this step, in J.
    /// With an energy balance the integrator evaluates it at the start and at the end.
    #[serde(skip)]
    internal: Option<FirstAndLast>,
    /// Energy of contact without friction at the end of the last step, in J.
    contact_at_end: Option<f64>,
    /// Energy that the integration had dissipated at the end of the last step, in J.
    integrated: f64,
    /// Kinetic energy at the start of the balance, in J.
    kinetic_at_start: f64,
    sums: Energy,
}

/// First and last potential of the internal forces in a step, in J.
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
    /// Work of the forces that a program sets.
    pub(crate) external_work: f64,
    /// Increase of the energy of contact.
    pub(crate) contact: f64,
    /// Energy of contact without friction at the end of the step.
    pub(crate) contact_at_end: f64,
    /// Work of the springs of pins, with their forces at the end of the step.
    pub(crate) spring_work: f64,
    /// Decrease of the potential of these springs. The potential jumps with the prescribed
    /// positions at the start of the step.
    pub(crate) spring_potential_fall: f64,
    /// Work of moving bodies, or of growing distances of surfaces, against contact.
    pub(crate) body_work: f64,
    /// Work of the friction on moving bodies.
    pub(crate) body_friction_work: f64,
    /// Work against the friction of surfaces, with the friction at the end of the step.
    pub(crate) body_friction_loss: f64,
    /// Part of `body_friction_loss` that is friction of cloth on cloth.
    pub(crate) cloth_friction_loss: f64,
    /// Increase of the potential of this friction. The solution of the step minimizes this
    /// potential.
    pub(crate) body_friction_potential: f64,
    /// Energy exchanged with the air, with the drag at the end of the step.
    pub(crate) air: DragEnergy,
    /// Work against the forces that remove momentum.
    pub(crate) momentum_removal: f64,
    /// Energy dissipated by the friction of the internal forces.
    pub(crate) internal_friction: f64,
    /// Energy stored by the internal forces at the end of the step.
    pub(crate) stored: f64,
}

impl EnergyBalance {
    /// Returns a balance that begins with the energy `stored` by the internal forces and the energy
    /// `kinetic`, in J.
    pub(crate) fn new(stored: f64, kinetic: f64) -> Self {
        Self { stored, kinetic_at_start: kinetic, ..Self::default() }
    }

    /// Prepares a step with the energy `contact` at its start.
    pub(crate) fn begin(&mut self, contact: ContactEnergy) {
        self.contact = contact;
        self.internal = None;
    }

    /// Returns the energy of contact at the start of the step.
    pub(crate) fn contact_at_start(&self) -> ContactEnergy {
        self.contact
    }

    /// Records `potential`, a value of the potential of the internal forces in this step, in J.
    pub(crate) fn note_internal_potential(&mut self, potential: f64) {
        let first = self.internal.map_or(potential, |noted| noted.first);
        self.internal = Some(FirstAndLast { first, last: potential });
    }

    /// Adds the energies of the accepted `step`.
    pub(crate) fn add(&mut self, step: &StepEnergy) {
        let FirstAndLast { first, last } = self.internal.unwrap_or_default();

        let sums = &mut self.sums;
        sums.rotation_dissipated +=
            last - first - (step.stored - self.stored) - step.internal_friction;
        sums.gravity += step.gravity;
        sums.contact += step.contact;
        // Between two steps contact changes only where the state of pinched cloth does.
        let before = self.contact.without_friction - self.contact.body_work;
        let released = self.contact_at_end.map_or(0.0, |end| end - before);
        self.contact_at_end = Some(step.contact_at_end);
        sums.contact -= released;
        sums.pinch_released += released;
        sums.work_in += step.body_work + step.body_friction_work + step.spring_work;
        sums.work_in += step.external_work;
        sums.work_in += step.air.air_work;
        sums.elastic += step.stored - self.stored;
        sums.friction_dissipated += step.internal_friction;
        sums.body_dissipated += step.body_friction_loss - step.cloth_friction_loss;
        sums.cloth_dissipated += step.cloth_friction_loss;
        sums.air_dissipated += step.air.dissipated;

        // The integrator replaces the work of all forces by differences of potentials. Friction and
        // drag grow with the speed along the step, so their potentials are smaller than the work
        // with the forces at the end.
        sums.numerical_dissipated +=
            step.body_friction_potential - step.body_friction_loss - 0.5 * step.air.squared_path;
        sums.numerical_dissipated += step.spring_work - step.spring_potential_fall;
        sums.numerical_dissipated += step.body_friction_work;
        sums.numerical_dissipated += step.momentum_removal;
        self.stored = step.stored;
    }

    /// Counts the kinetic energy `lost`, in J, of particles that a pin has stopped as negative work
    /// of the pin.
    pub(crate) fn stop(&mut self, lost: f64) {
        self.sums.work_in -= lost;
    }

    /// Adds the dissipation and the work that the integrator reports in `report`. `relaxes` says
    /// whether the step was one of quasi-static relaxation.
    pub(crate) fn add_report(&mut self, report: &Report, relaxes: bool) {
        let sums = &mut self.sums;
        if let Some(energy) = &report.energy {
            sums.numerical_dissipated += energy.numerical_dissipation;
            sums.work_in += energy.work;
            sums.unproved += energy.unproved;
            sums.exchanged += energy.exchanged;
            sums.proved += energy.proved;
        }
        let integrated = sums.numerical_dissipated + sums.rotation_dissipated;
        if relaxes {
            sums.relaxation_dissipated += integrated - self.integrated;
        }
        self.integrated = integrated;
    }

    /// Returns the balance since the start, in J, with the current kinetic energy `kinetic`.
    pub(crate) fn energy(&self, kinetic: f64) -> Energy {
        let Energy { elastic, gravity, contact, .. } = self.sums;
        let Energy { friction_dissipated, air_dissipated, .. } = self.sums;
        let Energy { body_dissipated, cloth_dissipated, .. } = self.sums;
        let stored = kinetic - self.kinetic_at_start + elastic + gravity + contact;
        let rotation = self.sums.rotation_dissipated;
        let surfaces = body_dissipated + cloth_dissipated + self.sums.pinch_released;
        let lost = friction_dissipated + surfaces + air_dissipated + rotation;
        let residual = self.sums.work_in - stored - lost - self.sums.numerical_dissipated;
        Energy { kinetic, residual, ..self.sums }
    }
}
