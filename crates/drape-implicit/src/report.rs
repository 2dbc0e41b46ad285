use core::ops::AddAssign;

/// What one call of [`Stepper::advance`](crate::Stepper::advance) took, rejected attempts included.
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
    /// Linear systems left unfinished, at the iteration limit or at a direction of negative curvature.
    pub linear_truncations: usize,
    /// Factorisations of the preconditioner begun anew, with a larger shift, after a collapsed pivot.
    pub pivot_shifts: usize,
    /// Exact tangents given up for definite ones, because a direction of negative curvature was met at once.
    pub negative_curvatures: usize,
    /// Shortenings in line searches.
    pub backtracks: usize,
    /// Largest final residual of the accepted sub-steps, relative as
    /// [`Settings::tolerance`](crate::Settings::tolerance) is.
    pub residual: f64,
    /// Most that a sub-step which ended for it promised to gain yet, over its kinetic energy; see
    /// [`Settings::energy_tolerance`](crate::Settings::energy_tolerance). Zero if none did.
    pub energy_left: f64,
    /// The energy balance, if asked for.
    pub energy: Option<Energy>,
}

impl AddAssign<&Report> for Report {
    /// Adds up the work of several steps; the residual and the energy left are the largest of them.
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

/// Energy balance over accepted sub-steps: `work = kinetic + potential + numerical_dissipation`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energy {
    /// Growth of the kinetic energy, in J.
    pub kinetic: f64,
    /// Growth of the incremental potential, work against friction included, in J.
    pub potential: f64,
    /// Work of the forces that move the held particles, those at the end of each sub-step, in J.
    pub work: f64,
    /// What the formula of the step lost, in J.
    pub numerical_dissipation: f64,
}

impl AddAssign for Energy {
    fn add_assign(&mut self, other: Self) {
        self.kinetic += other.kinetic;
        self.potential += other.potential;
        self.work += other.work;
        self.numerical_dissipation += other.numerical_dissipation;
    }
}

/// Why an attempt at a step was given up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Stop {
    /// The iteration limit was reached.
    Iterations,
    /// No step along the last direction found made progress.
    LineSearch,
    /// The stiffness given as definite is not.
    Indefinite,
    /// What moves by prescription was not allowed to go on.
    Blocked,
    /// The system did not certify the solution.
    Intersection,
}

impl core::fmt::Display for Stop {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::Iterations => "iteration limit",
            Self::LineSearch => "no progress along the last direction",
            Self::Indefinite => "the stiffness given as definite is not",
            Self::Blocked => "what moves by prescription is blocked",
            Self::Intersection => "the solution was not certified",
        })
    }
}
