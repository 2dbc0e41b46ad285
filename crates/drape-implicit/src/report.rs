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
    pub tangents: usize,
    /// Linear systems solved.
    pub linear_solves: usize,
    /// Conjugate-gradient iterations in them.
    pub linear_iterations: usize,
    /// Linear systems left unfinished at the iteration limit.
    pub linear_truncations: usize,
    /// Shifts of the preconditioner's diagonal after a collapsed pivot.
    pub pivot_shifts: usize,
    /// Exact tangents that had a direction of negative curvature.
    pub negative_curvatures: usize,
    /// Shortenings in line searches.
    pub cuts: usize,
    /// Largest final residual of the accepted sub-steps, relative as
    /// [`Settings::tolerance`](crate::Settings::tolerance) is.
    pub residual: f64,
    /// The energy balance, if asked for.
    pub energy: Option<Energy>,
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
}

impl core::fmt::Display for Stop {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::Iterations => "iteration limit",
            Self::LineSearch => "no progress along the last direction",
            Self::Indefinite => "the stiffness given as definite is not",
        })
    }
}
