//! Explicit steps, as a cross-check of the implicit ones.

use crate::error::Quantity;
use crate::incremental::first_not_finite;
use crate::{
    BlockMatrix, Energy, Error, IntegratorState, PreviousState, Report, Stiffness, System,
};

/// Part of the largest stable step that is taken: the bound holds for the stiffness where a call starts, and a
/// system may stiffen within it. Smaller costs in proportion.
const SAFETY: f64 = 0.5;

/// Largest number of sub-steps of one call. A stiffness that asks for more comes from a system that has blown up.
const MAX_SUB_STEPS: f64 = 1e7;

/// Advances a motion by semi-implicit Euler steps, as many as stability asks for.
///
/// Positions move with the old velocities, then velocities with the forces at the new positions:
///
/// ```math
/// x_1 = x_0 + \mathrm{dt}\,v_0, \qquad v_1 = v_0 + \mathrm{dt}\,M^{-1} f(x_1)
/// ```
///
/// One evaluation of the forces per sub-step, of first order, and symplectic: on a system that conserves energy the
/// error of the energy swings but does not grow, which tells apart what an implicit formula loses from what the
/// system does. (Tagawa, Hayashi & Kijima 2003 move their cloth by explicit Euler steps.) The largest stable step
/// is `2/ω` of the fastest oscillation. For cloth that is some hundredth of an implicit step: a cross-check, not a
/// way to get results.
#[derive(Debug)]
pub struct Explicit {
    fraction: f64,
    stiffness: BlockMatrix,
    version: u64,
    positions: Vec<f64>,
    velocities: Vec<f64>,
    forces: Vec<f64>,
    rows: Vec<f64>,
}

impl Explicit {
    /// Prepares to advance a system.
    pub fn new(system: &dyn System) -> Self {
        let length = 3 * system.particles();
        Self {
            fraction: SAFETY,
            stiffness: BlockMatrix::zeros(system.sparsity()),
            version: system.sparsity_version(),
            positions: vec![0.0; length],
            velocities: vec![0.0; length],
            forces: vec![0.0; length],
            rows: vec![0.0; length],
        }
    }

    /// The same with sub-steps of another fraction of the stability bound than one half: shorter ones show the
    /// order of the error.
    #[must_use]
    pub fn with_fraction(self, fraction: f64) -> Self {
        Self { fraction, ..self }
    }

    /// Advances the motion by exactly `dt`, in s, in equal sub-steps. The report's energy is the drift: what the
    /// formula lost (or, negative, made).
    ///
    /// # Errors
    /// [`Error::NotFinite`] where the motion blows up, and others for input that no step can be made with.
    pub fn advance(
        &mut self,
        system: &mut dyn System,
        state: &mut IntegratorState,
        dt: f64,
    ) -> Result<Report, Error> {
        if !(dt > 0.0 && dt.is_finite()) {
            return Err(Error::StepLength { dt });
        }
        let expected = self.positions.len();
        for (what, found) in
            [("positions", state.positions.len()), ("velocities", state.velocities.len())]
        {
            if found != expected {
                return Err(Error::Dimension { what, expected, found });
            }
        }
        if system.sparsity_version() != self.version {
            *self = Self::new(system).with_fraction(self.fraction);
        }
        let mut report = Report { stiffness_assemblies: 1, ..Report::default() };
        let stable = self.stable_step(system, state, dt)?;
        let wanted = (dt / (self.fraction * stable)).ceil().max(1.0);
        if !(wanted <= MAX_SUB_STEPS) {
            let (quantity, time) = (Quantity::Stiffness, state.time);
            return Err(Error::NotFinite { quantity, particle: 0, time, dt });
        }
        let (count, origin) = (wanted as usize, state.time);
        for step in 1..=count {
            let end = origin + dt * (step as f64 / count as f64);
            let energy = self.sub_step(system, state, (end, dt / count as f64))?;
            *report.energy.get_or_insert_default() += energy;
        }
        report.sub_steps = count;
        report.force_evaluations = count;
        report.potential_evaluations = 2 * count;
        Ok(report)
    }

    /// Length of the longest stable step from a motion, in s: `2/ω`, with `ω²` bounded by the largest sum of
    /// magnitudes in a row of `M⁻¹K` (Gershgorin's circles). Infinite without stiffness.
    ///
    /// # Errors
    /// [`Error::OutsideSparsity`].
    pub fn stable_step(
        &mut self,
        system: &mut dyn System,
        state: &IntegratorState,
        dt: f64,
    ) -> Result<f64, Error> {
        self.positions.copy_from_slice(&state.positions);
        system.begin(state.time + dt, dt, &state.positions, &mut self.positions);
        self.stiffness.clear();
        system.stiffness(&state.positions, Stiffness::Exact, &mut self.stiffness);
        if let Some([row, column]) = self.stiffness.outside_sparsity() {
            return Err(Error::OutsideSparsity { row, column });
        }
        self.rows.fill(0.0);
        let sparsity = self.stiffness.sparsity();
        for row in 0..sparsity.particles() {
            for slot in sparsity.row(row) {
                let column = sparsity.columns()[slot] as usize;
                let entries = self.stiffness.blocks()[slot];
                for (k, entry) in entries.iter().enumerate() {
                    self.rows[3 * row + k / 3] += entry.abs();
                    if column != row {
                        self.rows[3 * column + k % 3] += entry.abs();
                    }
                }
            }
        }
        let held = system.held();
        let mut fastest: f64 = 0.0;
        for (particle, mass) in system.masses().iter().enumerate().filter(|(p, _)| !held[*p]) {
            for row in &self.rows[3 * particle..3 * particle + 3] {
                fastest = fastest.max(row / mass);
            }
        }
        Ok(2.0 / fastest.sqrt())
    }

    /// One sub-step to a time, of a length, both in s. Returns what it did with the energy.
    fn sub_step(
        &mut self,
        system: &mut dyn System,
        state: &mut IntegratorState,
        (end, dt): (f64, f64),
    ) -> Result<Energy, Error> {
        let Self { positions, velocities, forces, .. } = self;
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
            return Err(Error::NotFinite {
                quantity: Quantity::Force,
                particle,
                time: state.time,
                dt,
            });
        }
        let mut energy = Energy::default();
        for (particle, (mass, held)) in system.masses().iter().zip(system.held()).enumerate() {
            let range = 3 * particle..3 * particle + 3;
            for k in range.clone() {
                let start = state.velocities[k];
                let moved = positions[k] - state.positions[k];
                velocities[k] = if *held { moved / dt } else { start + dt * forces[k] / mass };
                if *held {
                    energy.work += (mass * (velocities[k] - start) / dt - forces[k]) * moved;
                }
            }
            let speed = |v: &[f64]| v[range.clone()].iter().map(|v| v * v).sum::<f64>();
            energy.kinetic += 0.5 * mass * (speed(velocities) - speed(&state.velocities));
        }
        energy.potential = system.potential(positions) - before;
        energy.numerical_dissipation = energy.work - energy.kinetic - energy.potential;
        system.accept(positions, velocities, dt);
        let previous = state.previous.get_or_insert_with(|| PreviousState {
            dt,
            positions: vec![0.0; positions.len()],
            velocities: vec![0.0; velocities.len()],
        });
        previous.dt = dt;
        previous.positions.copy_from_slice(&state.positions);
        previous.velocities.copy_from_slice(&state.velocities);
        state.positions.copy_from_slice(positions);
        state.velocities.copy_from_slice(velocities);
        state.time = end;
        Ok(energy)
    }
}
