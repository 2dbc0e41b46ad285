//! Explicit steps, as a cross-check of the implicit steps. Explicit steps do not use the solver.

use super::path_work::{Path, PathWork};
use super::state::{IntegratorState, Span, check_particles};
use crate::check::{check_length, check_step};
use crate::error::{Error, Quantity};
use crate::linear::block_matrix::BlockMatrix;
use crate::linear::vector::first_not_finite;
use crate::report::{Report, StepEnergy};
use crate::step_filter::SystemRef;
use crate::system::{Stiffness, System};

/// Length of a sub-step as a fraction of the largest stable step. The bound holds for the stiffness
/// at the start of a call, and a system may stiffen within the call. The cost is inversely
/// proportional to this fraction.
const SAFETY: f64 = 0.5;

/// Largest number of sub-steps of one call. A stiffness that requires more sub-steps belongs to a
/// system whose motion has diverged.
const MAX_SUB_STEPS: f64 = 1e7;

/// Integrator by semi-implicit Euler steps, short enough for stability.
///
/// Positions advance with the old velocities. Then velocities advance with the forces at the new
/// positions:
///
/// ```math
/// x_1 = x_0 + \mathrm{dt}\,v_0, \qquad v_1 = v_0 + \mathrm{dt}\,M^{-1} f(x_1)
/// ```
///
/// A sub-step needs one evaluation of the forces. The method is of first order and symplectic: on a
/// system that conserves energy the error of the energy oscillates but does not grow. Explicit
/// steps thus separate the energy that an implicit formula dissipates from the energy that the
/// system dissipates. (\[THK03\] advances cloth by explicit Euler steps.) The largest stable step
/// is `2/ω` for the fastest oscillation `ω`. For cloth this is about a hundredth of an implicit
/// step, so explicit steps are a cross-check and not a method for results. Step filters are not
/// supported: particles may pass through obstacles that rely on a filter.
#[derive(Debug)]
pub struct Explicit {
    fraction: f64,
    stiffness: BlockMatrix,
    sparsity_version: u64,
    positions: Vec<f64>,
    velocities: Vec<f64>,
    forces: Vec<f64>,
    /// Sums of magnitudes in the rows of the stiffness, in N/m.
    row_sums: Vec<f64>,
    path_work: PathWork,
}

impl Explicit {
    /// Allocates an integrator for `system`.
    #[must_use]
    pub fn new(system: &dyn System) -> Self {
        let length = 3 * system.particle_count();
        Self {
            fraction: SAFETY,
            stiffness: BlockMatrix::zeros(system.sparsity()),
            sparsity_version: system.sparsity_version(),
            positions: vec![0.0; length],
            velocities: vec![0.0; length],
            forces: vec![0.0; length],
            row_sums: vec![0.0; length],
            path_work: PathWork::new(length),
        }
    }

    /// Sets the length of sub-steps to `fraction` of the stability bound. The default is one half.
    /// Shorter sub-steps show the order of the error.
    ///
    /// # Errors
    /// [`Error::Setting`] if `fraction` is not positive and finite.
    pub fn with_fraction(self, fraction: f64) -> Result<Self, Error> {
        if !(fraction > 0.0 && fraction.is_finite()) {
            let range = "positive and finite";
            return Err(Error::Setting { name: "fraction", value: fraction, range });
        }
        Ok(Self { fraction, ..self })
    }

    /// Advances `state` by exactly `dt`, in s, in equal sub-steps. The numerical dissipation in the
    /// report is the energy that the formula dissipated. It is negative if the energy grew.
    ///
    /// # Errors
    /// [`Error::NotFinite`] if the motion diverges. [`Error::StepLength`], [`Error::Dimension`],
    /// [`Error::Mass`] and [`Error::OutsideSparsity`] for inadmissible input.
    /// [`Error::Cancelled`].
    pub fn advance(
        &mut self,
        system: &mut dyn System,
        state: &mut IntegratorState,
        dt: f64,
    ) -> Result<Report, Error> {
        let mut report = Report { stiffness_assemblies: 1, ..Report::default() };
        let stable = self.stable_step(system, state, dt)?;
        let required = (dt / (self.fraction * stable)).ceil().max(1.0);
        if !(required <= MAX_SUB_STEPS) {
            let (quantity, time) = (Quantity::Stiffness, state.time);
            return Err(Error::NotFinite { quantity, particle: 0, time, dt });
        }

        // Ends of sub-steps are fractions of `dt`, so that rounding does not add up.
        let (count, origin) = (required as usize, state.time);
        for step in 1..=count {
            if system.is_cancelled() {
                return Err(Error::Cancelled);
            }
            let end = origin + dt * (step as f64 / count as f64);
            let span = Span { start: state.time, end, dt: dt / count as f64 };
            let energy = self.sub_step(system, state, span, &mut report)?;
            *report.energy.get_or_insert_default() += energy;
        }

        report.sub_steps = count;
        report.force_evaluations += count;
        report.potential_evaluations += 2 * count;
        Ok(report)
    }

    /// Returns the length of the longest stable step from `state`, in s: `2/ω`, with `ω²` bounded
    /// by the largest sum of magnitudes in a row of `M⁻¹K` (Gershgorin's circles). Infinite without
    /// stiffness. The system begins a step of length `dt`, in s.
    ///
    /// # Errors
    /// [`Error::StepLength`], [`Error::Dimension`], [`Error::Mass`] and
    /// [`Error::OutsideSparsity`].
    pub fn stable_step(
        &mut self,
        system: &mut dyn System,
        state: &IntegratorState,
        dt: f64,
    ) -> Result<f64, Error> {
        let particles = self.positions.len() / 3;
        check_step(dt)?;
        check_particles(system, particles)?;
        state.check(particles)?;
        if system.sparsity_version() != self.sparsity_version {
            *self = Self { fraction: self.fraction, ..Self::new(system) };
        }
        check_length("sparsity", particles, self.stiffness.sparsity().particle_count())?;

        self.positions.copy_from_slice(&state.positions);
        system.begin(state.time + dt, dt, &state.positions, &mut self.positions);
        self.stiffness.clear();
        system.stiffness(&state.positions, Stiffness::Exact, &mut self.stiffness);
        if let Some([row, column]) = self.stiffness.outside_sparsity() {
            return Err(Error::OutsideSparsity { row, column });
        }

        self.row_sums.fill(0.0);
        let sparsity = self.stiffness.sparsity();
        for row in 0..sparsity.particle_count() {
            for slot in sparsity.row(row) {
                let column = sparsity.columns()[slot] as usize;
                let entries = self.stiffness.blocks()[slot];
                for (k, entry) in entries.iter().enumerate() {
                    self.row_sums[3 * row + k / 3] += entry.abs();
                    if column != row {
                        self.row_sums[3 * column + k % 3] += entry.abs();
                    }
                }
            }
        }

        let held = system.held();
        let mut square_frequency: f64 = 0.0;
        for (particle, mass) in system.masses().iter().enumerate().filter(|(p, _)| !held[*p]) {
            for row in &self.row_sums[3 * particle..3 * particle + 3] {
                square_frequency = square_frequency.max(row / mass);
            }
        }
        Ok(2.0 / square_frequency.sqrt())
    }

    /// Takes the sub-step `span`. Returns the energy balance of the sub-step.
    fn sub_step(
        &mut self,
        system: &mut dyn System,
        state: &mut IntegratorState,
        span: Span,
        report: &mut Report,
    ) -> Result<StepEnergy, Error> {
        let Span { start: time, end, dt } = span;
        let Self { positions, velocities, forces, path_work, .. } = self;
        positions.copy_from_slice(&state.positions);
        system.begin(end, dt, &state.positions, positions);
        let before = system.potential(&state.positions);

        let held = system.held();
        let moving = state.positions.iter().zip(&state.velocities);
        for (k, (end, (start, velocity))) in positions.iter_mut().zip(moving).enumerate() {
            if !held[k / 3] {
                *end = start + dt * velocity;
            }
        }
        system.forces(positions, forces);
        if let Some(particle) = first_not_finite(forces).or_else(|| first_not_finite(positions)) {
            return Err(Error::NotFinite { quantity: Quantity::Force, particle, time, dt });
        }

        // Velocities at the end, and the work of inertia and forces over the displacements.
        let mut energy = StepEnergy::default();
        let [mut inertia_work, mut end_work] = [0.0; 2];
        for (particle, (mass, held)) in system.masses().iter().zip(system.held()).enumerate() {
            let range = 3 * particle..3 * particle + 3;
            for k in range.clone() {
                let start = state.velocities[k];
                let displacement = positions[k] - state.positions[k];
                velocities[k] =
                    if *held { displacement / dt } else { start + dt * forces[k] / mass };
                let inertia = mass * (velocities[k] - start) / dt * displacement;
                inertia_work += inertia;
                end_work += forces[k] * displacement;
                if *held {
                    energy.work += inertia - forces[k] * displacement;
                }
            }
            let [speed_after, speed_before] = [&velocities[..], &state.velocities]
                .map(|v| v[range.clone()].iter().map(|v| v * v).sum::<f64>());
            energy.kinetic += 0.5 * mass * (speed_after - speed_before);
        }

        // The work of the forces along the path separates the formula's error from the forces' own.
        let after = system.potential(positions);
        energy.potential = after - before;
        let formula_loss = inertia_work - energy.kinetic;
        let exchanged = energy.kinetic.abs() + energy.potential.abs() + energy.work.abs();
        let path = Path {
            start: &state.positions,
            end: positions,
            potentials: [before, after],
            end_work,
            exchanged: exchanged + formula_loss.abs(),
        };
        let work = path_work.measure(&mut SystemRef::Free(system), &path, report);
        energy.numerical_dissipation = formula_loss + work.forces - end_work;

        system.accept(positions, velocities, dt);
        state.advance(span, positions, velocities);
        Ok(energy)
    }
}
