//! Report of a step: the work it took, its energy balance, and why an attempt stopped.

use core::ops::AddAssign;

/// Work done by one call of [`Stepper::advance`](crate::Stepper::advance), rejected attempts
/// included.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Report {
    /// Accepted sub-steps: 1 unless the step was halved.
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
    /// Conjugate-gradient iterations in them.
    pub linear_iterations: usize,
    /// Linear systems left unfinished, at the iteration limit or at a direction of negative
    /// curvature.
    pub linear_truncations: usize,
    /// Factorisations of the preconditioner begun again, with a larger shift, after a collapsed
    /// pivot.
    pub pivot_shifts: usize,
    /// Exact stiffnesses given up for definite ones, because the first direction of the linear
    /// solve was one of negative curvature.
    pub negative_curvatures: usize,
    /// Backtracks of line searches.
    pub backtracks: usize,
    /// Largest final residual of the accepted sub-steps, relative as
    /// [`Settings::tolerance`](crate::Settings::tolerance) is.
    pub residual: f64,
    /// Largest energy left to gain in a sub-step that ended for it, as a fraction of its kinetic
    /// energy; see [`Settings::energy_tolerance`](crate::Settings::energy_tolerance). 0 if none
    /// did.
    pub energy_left: f64,
    /// Energy balance, if asked for.
    pub energy: Option<Energy>,
}

impl AddAssign<&Report> for Report {
    /// Adds the work of another step; residual and energy left are the larger of both.
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

/// Energy balance over accepted sub-steps. In sampled sub-steps every entry is computed on its own; they
/// close, `work = kinetic + potential + numerical_dissipation`, if the forces are those of the potential.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energy {
    /// Growth of the kinetic energy, in J.
    pub kinetic: f64,
    /// Growth of the incremental potential, work against friction included, in J.
    pub potential: f64,
    /// Work of the forces that move the held particles, by their values at the end of each
    /// sub-step, and of obstacles, along each sub-step, in J.
    pub work: f64,
    /// Energy that the formula of the step lost, and the residual that the solver left, in J: by
    /// differences of velocities, and by the work of the forces along each sub-step.
    pub numerical_dissipation: f64,
    /// Energy exchanged in sub-steps whose straight path leads through an obstacle, in J: there
    /// forces have no work along it, and the loss is what the other entries leave.
    pub unproved: f64,
}

impl Energy {
    /// Energy that the entries leave open, in J: the error of the quadrature along the sub-steps,
    /// or of the forces.
    #[must_use]
    pub fn open(&self) -> f64 {
        self.work - self.kinetic - self.potential - self.numerical_dissipation
    }
}

impl AddAssign for Energy {
    fn add_assign(&mut self, other: Self) {
        self.kinetic += other.kinetic;
        self.potential += other.potential;
        self.work += other.work;
        self.numerical_dissipation += other.numerical_dissipation;
        self.unproved += other.unproved;
    }
}

/// Reason why an attempt at a step was given up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Stop {
    /// The iteration limit was reached.
    Iterations,
    /// No step along the last direction found made progress.
    LineSearch,
    /// The stiffness given as definite is not.
    Indefinite,
    /// The step filter did not let the prescribed motions go on.
    Blocked,
    /// The step filter found intersections in the solution.
    Intersection,
}

impl Stop {
    /// Remedy, for the end of a message.
    pub(crate) fn remedy(self) -> &'static str {
        match self {
            Self::Blocked => "slow what moves by prescription, or leave room where it moves to",
            _ => "shorten the step or allow more halvings",
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
            energy: Some(Energy { work: residual, kinetic: 3.0 * residual, ..Energy::default() }),
        };
        let mut sum = Report::default();
        for (k, residual) in [(2, 0.5), (3, 0.25), (4, 0.125)] {
            sum += &of(k, residual);
        }
        let energy = Energy { work: 0.875, kinetic: 2.625, ..Energy::default() };
        assert_eq!(sum, Report { energy: Some(energy), ..of(9, 0.5) });
    }
}
