use serde::Serialize;

/// How a run went: the content of `summary.json`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Summary {
    /// `ok`, or why the run ended.
    pub status: Status,
    /// What the solver said of the step that ended the run, and where surfaces were then nearest to each other.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// Version of the program.
    pub version: String,
    /// Hash of the scene and its fabrics.
    pub scene_hash: String,
    /// Number of particles.
    pub particles: usize,
    /// What was done one after the other.
    pub phases: Vec<Phase>,
    /// Steps made.
    pub steps: usize,
    /// Frames of the run, the first at its start.
    pub frames: usize,
    /// Time reached, in s.
    pub simulated_seconds: f64,
    /// Time taken, in s.
    pub wall_seconds: f64,
    /// Processor time taken by all threads, in s, where the system tells.
    pub cpu_seconds: Option<f64>,
    /// Number of threads.
    pub threads: usize,
    /// What the solver did.
    pub solver: Solver,
    /// Where the energy is and went, unless the scene does without.
    pub energy: Option<Energy>,
    /// How far the cloth is deformed at the end.
    pub strain: Strain,
    /// How it touches the bodies at the end.
    pub contact: Contacts,
    /// Whether it came to rest by the scene's criterion.
    pub settled: bool,
    /// Largest speed of a particle at the end, in m/s.
    pub speed_max: f64,
    /// Root-mean-square acceleration at the end over g: what the forces lack for balance.
    pub imbalance: f64,
    /// Hash of the final positions, velocities and memories.
    pub state_hash: String,
    /// What the user should know about the result.
    pub warnings: Vec<String>,
    /// What the scene asks to be measured.
    pub measures: serde_json::Map<String, serde_json::Value>,
}

/// A part of a run.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Phase {
    /// What is done in it.
    pub name: PhaseName,
    /// When it begins, in s.
    pub start: f64,
    /// Number of its first frame.
    pub frame: usize,
}

/// What is done in a phase.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum PhaseName {
    /// Seams are drawn together, without gravity.
    Sew,
    /// The cloth goes to rest.
    Relax,
    /// It moves in time.
    Simulate,
}

/// Why a run ended.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub enum Status {
    /// It reached its end, or came to rest.
    #[serde(rename = "ok")]
    Ok,
    /// The end came before the rest that the scene asks for.
    #[serde(rename = "did not settle")]
    DidNotSettle,
    /// The sides of a seam could not be drawn together.
    #[serde(rename = "seams open")]
    SeamsOpen,
    /// A garment fell off its body.
    #[serde(rename = "fell off")]
    FellOff,
    /// Surfaces that started too near could not part.
    #[serde(rename = "held together")]
    HeldTogether,
    /// Surfaces crossed in a step, however short.
    #[serde(rename = "certificate failed")]
    CertificateFailed,
    /// A step could not be solved.
    #[serde(rename = "solver failed")]
    SolverFailed,
}

/// Work of the solver.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Solver {
    /// Mean number of iterations per step.
    pub iterations_mean: f64,
    /// Largest number of iterations of a step.
    pub iterations_max: usize,
    /// Attempts that were given up for a shorter step.
    pub rejected_steps: usize,
    /// Attempts that were given up because their error was too large.
    pub inexact_steps: usize,
    /// Accepted parts of steps.
    pub sub_steps: usize,
    /// Largest residual of an accepted step: rms acceleration error relative to g. Steps that creep to rest may end
    /// earlier, with little energy left to gain, but for the last ones.
    pub residual_max: f64,
    /// Most energy that such a step left to be gained, over its kinetic energy.
    pub energy_left_max: f64,
    /// Largest error of the positions that an accepted step was estimated to make, in m, where the
    /// scene limits it.
    pub error_max: Option<f64>,
    /// Evaluations of all forces.
    pub force_evaluations: usize,
    /// Assemblies of the stiffness.
    pub tangents: usize,
    /// Evaluations of the potential.
    pub potential_evaluations: usize,
    /// Iterations of the linear solver.
    pub linear_iterations: usize,
}

/// Balance of the energy since the start, in J: what was put in is stored, or lost in one of five ways.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Energy {
    /// Of motion.
    pub kinetic: f64,
    /// Stored in the fabric since the start.
    pub elastic: f64,
    /// Work done against the weight; the fall makes it negative.
    pub gravity: f64,
    /// Stored in the contact with bodies since the start.
    pub contact: f64,
    /// Lost in the fabric's friction.
    pub friction_dissipated: f64,
    /// Lost in the friction with bodies.
    pub body_dissipated: f64,
    /// Lost to the air.
    pub air_dissipated: f64,
    /// Lost by the formula of the integrator, and what the solver leaves of its equations.
    pub numerical_dissipated: f64,
    /// What the turning of the cloth costs: a step measures curvatures along the normals at its start,
    /// the memory of the bending friction along those at its end. Of either sign, some thousandths of
    /// the friction at usual steps, less at shorter ones, and nothing where bending has no friction.
    pub turning_dissipated: f64,
    /// Work done on the cloth by bodies that move and by whatever holds particles: where that holds in some directions
    /// alone, what it gives way by counts.
    pub work_in: f64,
    /// What the other entries leave of the balance: rounding.
    pub remainder: f64,
}

/// Deformation at the end.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Strain {
    /// Largest strain of a yarn segment, a ratio.
    pub traction_max: f64,
    /// Strain that 99 of 100 segments do not exceed, a ratio.
    pub traction_p99: f64,
    /// Largest shear angle, in rad.
    pub shear_max: f64,
    /// Curvature that 99 of 100 places do not exceed, in 1/m.
    pub curvature_p99: f64,
}

/// Contact of surfaces or, without them, of particles with bodies.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Contacts {
    /// Largest number of pairs of primitives, or of particles and bodies, that touched after a step.
    pub pairs_max: usize,
    /// Smallest distance of two surfaces after any step, or of a particle from a body at the end, in m; none where
    /// nothing was near.
    pub min_distance: Option<f64>,
    /// Crossings of surfaces at the end, found by exact arithmetic, those of cloth that let a body through among them; or
    /// particles inside a body.
    pub intersections: usize,
    /// Crossings of surfaces that were found after steps, which were then taken back.
    pub crossings_found: usize,
    /// Largest number of particles that bodies pinched after a step, and that kept less of their distance from them.
    pub thinned_max: usize,
    /// Largest number of particles that had let a body through after a step: it is not promised that cloth and bodies do
    /// not intersect there.
    pub released_max: usize,
    /// Part of the distances that surfaces keep which they kept at the start, below 1 only with `contact.grow`, and which
    /// they keep at the end. In between no two came nearer than the part of that time.
    pub grown_from: f64,
    /// See [`grown_from`](Contacts::grown_from).
    pub grown: f64,
}
