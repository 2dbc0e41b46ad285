//! Summary of a run: the content of `summary.json`.

use serde::{Deserialize, Serialize};

use crate::record::step_hashes::StepHashes;
use crate::world::Energy;

/// Summary of a run: the content of `summary.json`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Summary {
    /// `ok`, or the reason why the run ended early.
    pub status: Status,
    /// Error message of the step that ended the run, with the position where surfaces were closest
    /// to each other then.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// Version of the program.
    pub version: String,
    /// Hash of the scene and its fabrics.
    pub scene_hash: String,
    /// Number of particles.
    pub particles: usize,
    /// Phases in their order.
    pub phases: Vec<Phase>,
    /// Records of the coarser grids on which the cloth was relaxed first. Their steps are not part
    /// of `steps`.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub coarser_grids: Vec<GridRecord>,
    /// Number of steps.
    pub steps: usize,
    /// Number of frames. The first frame is at the start.
    pub frames: usize,
    /// Time of each frame, in s.
    pub frame_times: Vec<f64>,
    /// Time reached, in s.
    pub simulated_seconds: f64,
    /// Wall-clock time taken, in s.
    pub wall_seconds: f64,
    /// Processor time taken by all threads, in s, if the system reports it.
    pub cpu_seconds: Option<f64>,
    /// Number of threads.
    pub threads: usize,
    /// Work of the solver.
    pub solver: Solver,
    /// Energy balance, or `None` if the scene switches it off.
    pub energy: Option<Energy>,
    /// Deformation of the cloth at the end.
    pub strain: Strain,
    /// Contact over the run and at its end.
    pub contact: Contacts,
    /// Whether the cloth came to rest by the scene's criteria.
    pub settled: bool,
    /// Largest speed of a particle at the end, in m/s.
    pub speed_max: f64,
    /// Root-mean-square acceleration at the end over g: the imbalance of the forces.
    pub imbalance: f64,
    /// Hash of the final positions, velocities and memories.
    pub state_hash: String,
    /// Hashes after the steps, if they are asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub step_hashes: Option<StepHashes>,
    /// Warnings about the result.
    pub warnings: Vec<String>,
    /// Limits of the guarantees of contact on the bodies, a sentence each.
    pub contact_limits: Vec<String>,
    /// Measures of garments by key, empty without seams: `seam_gap_max` and `lowest` in m,
    /// `free_edges`, `openings`, `girths`, `strain` and, where surfaces touch, `pressure`. All
    /// numbers are in SI, angles in rad.
    pub measures: serde_json::Map<String, serde_json::Value>,
    /// Position of the open seam that ended the run early, in m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub place: Option<[f64; 3]>,
}

/// Result of the run on a coarser grid.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GridRecord {
    /// Smallest distance of particles before deformation, in m.
    pub spacing: f64,
    /// Number of particles.
    pub particles: usize,
    /// Number of steps.
    pub steps: usize,
    /// Number of iterations of conjugate gradients in all linear solves.
    pub linear_iterations: usize,
    /// Time at the end of the run on this grid, in s.
    pub end: f64,
    /// Whether the next grid began with the cloth of this grid.
    pub carried: bool,
}

/// Phase of a run.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Phase {
    /// Name of the phase.
    pub name: PhaseName,
    /// Time at which the phase begins, in s.
    pub start: f64,
    /// Number of the first frame of the phase.
    pub frame: usize,
}

/// Name of a phase.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PhaseName {
    /// Seams are closed, without gravity.
    Sew,
    /// The cloth comes to rest.
    Relax,
    /// The cloth moves in time.
    Simulate,
}

/// Reason why a run ended.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub enum Status {
    /// The run reached its end, or the cloth came to rest.
    #[serde(rename = "ok")]
    Ok,
    /// The end came before the rest that the scene asks for.
    #[serde(rename = "did not settle")]
    DidNotSettle,
    /// A seam could not be closed.
    #[serde(rename = "seams open")]
    SeamsOpen,
    /// A garment fell off its body.
    #[serde(rename = "fell off")]
    FellOff,
    /// Surfaces that started too near to each other could not part.
    #[serde(rename = "held together")]
    HeldTogether,
    /// Surfaces intersected after a step, however short, or intersect in a state that was accepted.
    #[serde(rename = "certificate failed")]
    Intersecting,
    /// The balance of energy does not close.
    #[serde(rename = "energy")]
    Unbalanced,
    /// A step could not be solved.
    #[serde(rename = "solver failed")]
    SolverFailed,
    /// The run was asked to end before its end.
    #[serde(rename = "interrupted")]
    Interrupted,
}

/// Work of the solver.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Solver {
    /// Mean number of iterations per step.
    pub iterations_mean: f64,
    /// Largest number of iterations of a step.
    pub iterations_max: usize,
    /// Number of attempts that were abandoned for a shorter step.
    pub rejected_steps: usize,
    /// Number of attempts that were abandoned because their error was too large.
    pub inexact_steps: usize,
    /// Number of accepted parts of steps.
    pub sub_steps: usize,
    /// Largest residual of an accepted step: root-mean-square error of the acceleration over g.
    /// Steps of quasi-static relaxation except the last ones may end with a larger residual if
    /// little energy remains to be gained.
    pub residual_max: f64,
    /// Largest energy that such a step left unminimized, over its kinetic energy.
    pub energy_left_max: f64,
    /// Largest estimated error of the positions of an accepted step, in m, if the scene limits
    /// errors.
    pub error_max: Option<f64>,
    /// Number of evaluations of all forces.
    pub force_evaluations: usize,
    /// Number of assemblies of the stiffness.
    #[serde(rename = "tangents")]
    pub stiffness_assemblies: usize,
    /// Number of evaluations of the potential.
    pub potential_evaluations: usize,
    /// Largest number of linear systems that a step solved.
    pub linear_solves_max: usize,
    /// Number of iterations of the linear solver.
    pub linear_iterations: usize,
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
    /// Largest number of pairs of primitives, or of particles and bodies, that touched after a
    /// step.
    pub pairs_max: usize,
    /// Smallest distance of two surfaces at the start and after any step, or of a particle from a
    /// body at the end, in m. `None` if nothing was near.
    pub min_distance: Option<f64>,
    /// Number of intersections of surfaces at the end, by exact arithmetic, including cloth that
    /// let a body through. Without surfaces, the number of particles inside a body.
    pub intersections: usize,
    /// Largest number of intersections of surfaces after a step that was accepted: of cloth that
    /// let a body through, and of the sides of seams that had opened again. A run with such an
    /// intersection ends with the status [`Intersecting`](Status::Intersecting).
    pub intersections_max: usize,
    /// Number of intersections that were found after steps, which were then taken back.
    #[serde(rename = "crossings_found")]
    pub intersections_found: usize,
    /// Number of exempt intersections at the end: intersections of the two sides of a seam that is
    /// closed, within [`CLOSED_GAP`](drape_frames::CLOSED_GAP), before its vertices are merged. 0
    /// once a garment is sewn.
    #[serde(rename = "exempt_intersections")]
    pub exempt: usize,
    /// Largest number of exempt intersections after a step.
    #[serde(rename = "exempt_intersections_max")]
    pub exempt_max: usize,
    /// Largest depth of an exempt intersection after any step, in m: the shortest distance by which
    /// an edge of one side would have to move to leave a triangle of the other. It is at most the
    /// gap of a closed seam.
    pub exempt_penetration_max: f64,
    /// Largest number of particles with reduced distances after a step, because bodies pinched the
    /// cloth.
    pub thinned_max: usize,
    /// Largest number of particles that had let a body through after a step. Cloth and bodies may
    /// intersect there.
    pub released_max: usize,
    /// Fraction of their distances that surfaces kept at the start, 0 to 1. Below 1 only with
    /// `contact.grow`. At any time in between, surfaces kept at least the fraction of that time.
    #[serde(rename = "grown_from")]
    pub start_growth_fraction: f64,
    /// Fraction of their distances that surfaces keep at the end, 0 to 1.
    #[serde(rename = "grown")]
    pub growth_fraction: f64,
}
