//! Report of a step: counters of its work, its energy balance, and the reason why an attempt
//! stopped.

use core::ops::AddAssign;

/// Work done by one call of [`Stepper::advance`](crate::Stepper::advance), rejected attempts
/// included.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
#[non_exhaustive]
pub struct Report {
    /// Accepted sub-steps: 1 unless the step was divided.
    pub sub_steps: usize,
    /// Rejected attempts, each followed by a halving.
    pub rejected: usize,
    /// Nonlinear iterations.
    pub iterations: usize,
    /// Evaluations of the forces.
    pub force_evaluations: usize,
    /// Evaluations of the potential.
    pub potential_evaluations: usize,
    /// Assemblies of the stiffness.
    pub stiffness_assemblies: usize,
    /// Linear systems solved.
    pub linear_solves: usize,
    /// Iterations of conjugate gradients in all linear systems.
    pub linear_iterations: usize,
    /// Linear systems that stopped before their target, at the iteration limit or at a direction of
    /// negative curvature.
    pub linear_truncations: usize,
    /// Factorisations of the preconditioner that a collapsed pivot ended. Each was repeated with a
    /// larger shift.
    pub pivot_shifts: usize,
    /// Exact stiffnesses that a definite stiffness replaced, because the linear solve met negative
    /// curvature before any progress.
    pub negative_curvatures: usize,
    /// Backtracks of line searches.
    pub backtracks: usize,
    /// Largest final residual of the accepted sub-steps, in the relative unit of
    /// [`Settings::tolerance`](crate::Settings::tolerance).
    pub residual: f64,
    /// Largest predicted decrease of the energy that remained in a sub-step which
    /// [`Settings::energy_tolerance`](crate::Settings::energy_tolerance) ended, as a fraction of
    /// the kinetic energy of the sub-step. 0 if the energy tolerance ended no sub-step.
    pub energy_left: f64,
    /// Energy balance, if [`Settings::energy_balance`](crate::Settings::energy_balance) is set.
    pub energy: Option<StepEnergy>,
}

impl AddAssign<&Report> for Report {
    /// Adds the counters of `other`. `residual` and `energy_left` become the larger of both.
    fn add_assign(&mut self, other: &Report) {
        self.sub_steps += other.sub_steps;
        self.rejected += other.rejected;
        self.iterations += other.iterations;
        self.force_evaluations += other.force_evaluations;
        self.potential_evaluations += other.potential_evaluations;
        self.stiffness_assemblies += other.stiffness_assemblies;
        self.linear_solves += other.linear_solves;
        self.linear_iterations += other.linear_iterations;
        self.linear_truncations += other.linear_truncations;
        self.pivot_shifts += other.pivot_shifts;
        self.negative_curvatures += other.negative_curvatures;
        self.backtracks += other.backtracks;
        self.residual = self.residual.max(other.residual);
        self.energy_left = self.energy_left.max(other.energy_left);
        if let Some(energy) = other.energy {
            *self.energy.get_or_insert_default() += energy;
        }
    }
}

/// Energy balance over accepted sub-steps.
///
/// In sampled sub-steps every entry is computed independently. The balance closes,
/// `work = kinetic + potential + numerical_dissipation`, if the forces are the negative gradient of
/// the potential.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct StepEnergy {
    /// Increase of the kinetic energy, in J.
    pub kinetic: f64,
    /// Increase of the incremental potential, including work against friction, in J.
    pub potential: f64,
    /// Work of the forces that move the held particles, plus work of the obstacles, in J. The
    /// forces on held particles are taken at the end of each sub-step, the obstacles' along each
    /// sub-step.
    pub work: f64,
    /// Energy that the formula of the step and the residual of the solver dissipated, in J.
    /// Computed from differences of velocities and from the work of the forces along each sub-step.
    pub numerical_dissipation: f64,
    /// Energy exchanged in sub-steps whose straight path leads through an obstacle, in J. The
    /// forces have no finite work along such a path, so the numerical dissipation is the difference
    /// of the other entries and proves nothing.
    pub unproved: f64,
    /// Energy that the sub-steps exchanged, in J: the sum of the absolute changes of kinetic energy
    /// and potential, the absolute dissipation of the formula, and the absolute work on held
    /// particles, of each sub-step.
    pub exchanged: f64,
    /// Energy exchanged in sampled sub-steps, in J, in which the balance is a proof. In a sub-step
    /// that exchanges less than the rounding of its potentials resolves, what they resolve counts.
    pub proved: f64,
}

impl StepEnergy {
    /// Returns the difference of the two sides of the balance, in J: the error of the quadrature
    /// along the sub-steps, or of the forces.
    #[must_use]
    pub fn open(&self) -> f64 {
        self.work - self.kinetic - self.potential - self.numerical_dissipation
    }
}

impl AddAssign for StepEnergy {
    fn add_assign(&mut self, other: Self) {
        self.kinetic += other.kinetic;
        self.potential += other.potential;
        self.work += other.work;
        self.numerical_dissipation += other.numerical_dissipation;
        self.unproved += other.unproved;
        self.exchanged += other.exchanged;
        self.proved += other.proved;
    }
}

/// Reason why an attempt at a step stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Stop {
    /// The iteration limit was reached.
    Iterations,
    /// No step along the last direction made progress.
    LineSearch,
    /// The stiffness that the system gave as definite is not definite.
    Indefinite,
    /// The step filter stopped the prescribed motions.
    Blocked,
    /// The step filter found intersections in the solution.
    Intersection,
}

impl Stop {
    /// Returns the remedy for `self`, as the last part of a message.
    pub(crate) fn remedy(self) -> &'static str {
        match self {
            Self::Blocked => "slow what moves by prescription, or leave room where it moves to",
            _ => "shorten the step, or raise max_halvings of the settings",
        }
    }
}

impl core::fmt::Display for Stop {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::Iterations => "iteration limit",
            Self::LineSearch => "no progress along the last direction",
            Self::Indefinite => "the stiffness given as definite is not",
            Self::Blocked => "the prescribed motions are blocked",
            Self::Intersection => "the solution has intersections",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_work_of_steps_adds_up_and_the_worst_of_them_stays() {
        let of = |k: usize, residual: f64| Report {
            sub_steps: k,
            rejected: 2 * k,
            iterations: 3 * k,
            force_evaluations: 4 * k,
            potential_evaluations: 5 * k,
            stiffness_assemblies: 6 * k,
            linear_solves: 7 * k,
            linear_iterations: 8 * k,
            linear_truncations: 9 * k,
            pivot_shifts: 10 * k,
            negative_curvatures: 11 * k,
            backtracks: 12 * k,
            residual,
            energy_left: 2.0 * residual,
            energy: Some(StepEnergy {
                work: residual,
                kinetic: 3.0 * residual,
                ..StepEnergy::default()
            }),
        };
        let mut sum = Report::default();
        for (k, residual) in [(2, 0.5), (3, 0.25), (4, 0.125)] {
            sum += &of(k, residual);
        }
        let energy = StepEnergy { work: 0.875, kinetic: 2.625, ..StepEnergy::default() };
        assert_eq!(sum, Report { energy: Some(energy), ..of(9, 0.5) });
    }
}
