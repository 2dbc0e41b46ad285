//! Simulation: a scene from its start to the end of its run, phase by phase.
//!
//! A run has up to three phases: a garment is sewn, the cloth comes to rest, bodies and pins move.
//! The chapter `stepping` makes the steps. After each step the simulation checks whether the phase,
//! or the run, is over. `run.rs` makes all steps and reports to a watcher. `saved.rs` stores the
//! state from which an interrupted run resumes. `coarser_grid.rs` relaxes the cloth on coarser
//! grids first. `seams.rs` ends the sewing. A program acts between steps in `prescription.rs`,
//! `body_prescription.rs` and `pin_prescription.rs`. `vertex_buffer.rs` hands out the surface for a
//! picture. `plan.rs` lists the phases that remain, `step_failure.rs` describes a step that failed.

pub(crate) mod body_prescription;
pub(crate) mod coarser_grid;

#[cfg(test)]
mod contact_tests;
pub(crate) mod pin_prescription;
pub(crate) mod plan;
pub(crate) mod prescription;
pub(crate) mod run;
pub(crate) mod saved;
mod seams;
#[cfg(test)]
mod sewing_tests;
mod step_failure;
mod vertex_buffer;

use std::collections::VecDeque;
use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use drape_cloth::Interpolation;
use drape_frames::{Frame, Manifest, Topology};
use drape_implicit::{Report, Stop};
use drape_scene::{Relaxation, Scene, Source};
use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::measure::garment_parts::GarmentParts;
use crate::measure::{fallen, note_slides};
use crate::record::snapshot::Snapshot;
use crate::record::state_hash::state_hash;
use crate::record::stopwatch::{Stopwatch, thread_count};
use crate::record::summary::{GridRecord, Phase, PhaseName, Status, Strain, Summary};
use crate::record::topology;
use crate::stepping::statistics::Statistics;
use crate::stepping::{
    AcceptedStep, PhaseSteps, ReferenceScheme, RestDetector, Scheme, StepMotion, Stepping,
};
use crate::world::{ALL_PARTICLES, ClosestPlace, Energy, PinLoad, World};

/// Unit of imbalances, in m/s².
const GRAVITY: f64 = 9.81;

/// Simulation of a scene.
///
/// ```
/// use drape_dynamics::Simulation;
/// use drape_input::Document;
/// use drape_scene::Scene;
///
/// let fabric = Document::new("plain.toml", r#"
///     name = "plain weave"
///     density = 0.12
///     thickness = 0.0003
///     shear.stiffness = 35
///     [warp.traction.primed]
///     stiffness = 5000
///     toe_ratio = 0.7
///     toe_strain = 0.01
///     toe_strain_after = 0.015
///     [warp]
///     bending.rigidity = 1.2e-5
///     [weft.traction.primed]
///     stiffness = 4000
///     toe_ratio = 0.7
///     toe_strain = 0.02
///     toe_strain_after = 0.03
///     [weft]
///     bending.rigidity = 0.8e-5
/// "#);
/// let scene = Document::new("towel.toml", r#"
///     spacing = 0.02
///     fabric.plain.file = "plain.toml"
///     panel = [{ name = "towel", fabric = "plain", rectangle = [0.2, 0.3] }]
///     pin = [{ panel = "towel", edge = "top" }]
///     time = { step = 0.005, end = 0.02 }
/// "#);
/// let mut simulation = Simulation::new(Scene::from_documents(&scene, &[fabric])?)?;
/// let summary = simulation.run(&mut ())?;
/// assert_eq!((summary.steps, summary.particles), (4, 11 * 16));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Simulation {
    pub(crate) world: World,
    stepping: Stepping,
    rest: RestDetector,
    phases: Phases,
    /// Panels, garments and seams, for measures.
    parts: GarmentParts,
    statistics: Statistics,
    last: LastStep,
    outcome: Outcome,
    /// Times of the frames until now, in s.
    frame_times: Vec<f64>,
    /// Smallest distance of particles before deformation, in m.
    spacing: f64,
    source: Source,
    stopwatch: Stopwatch,
    /// Remaining coarser grids, the current one first.
    coarser: VecDeque<CoarserGrid>,
    /// Records of the coarser grids that are finished.
    grids: Vec<GridRecord>,
    /// Number of further steps after each of which the memories of friction are reset.
    steps_to_forget: usize,
}

/// Coarser grid on which the cloth is relaxed, with the interpolation to the next grid.
#[derive(Debug)]
struct CoarserGrid {
    simulation: Box<Simulation>,
    /// Indices of each panel's coordinates in the positions of the grid, and the interpolation of
    /// the panel to the next grid.
    panels: Vec<(Range<usize>, Interpolation)>,
}

/// Phases of a run.
#[derive(Debug, Clone, Serialize, Deserialize)]
struct Phases {
    begun: Vec<Phase>,
    /// Time for which bodies and pins move after the cloth has come to rest, in s. `None` once they
    /// move, or if they need not wait.
    motion_seconds: Option<f64>,
    /// Whether the cloth came to rest before bodies and pins moved.
    rested: bool,
}

/// Motion of the cloth after the last step.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
struct LastStep {
    /// Largest speed of a particle, in m/s.
    speed_max: f64,
    /// Root-mean-square acceleration of the free particles, over g.
    imbalance: f64,
}

/// Outcome of a run.
#[derive(Debug)]
struct Outcome {
    status: Status,
    /// Reason why the run ended early.
    reason: Option<String>,
    /// Warnings that were raised during the run.
    events: Vec<String>,
    warnings: Vec<String>,
    measures: serde_json::Map<String, serde_json::Value>,
    /// Position to which `reason` refers, in m.
    place: Option<[f64; 3]>,
}

impl Outcome {
    /// Returns the outcome of a run that goes on, with the warnings `events` until now.
    fn new(events: Vec<String>) -> Self {
        Self {
            status: Status::Ok,
            reason: None,
            events,
            warnings: Vec::new(),
            measures: serde_json::Map::new(),
            place: None,
        }
    }
}

/// Step of a simulation.
#[derive(Debug, Clone, PartialEq)]
pub struct Step {
    /// Time reached, in s.
    pub time: f64,
    /// Length of the step, in s.
    pub dt: f64,
    /// Largest speed of a particle, in m/s.
    pub speed_max: f64,
    /// Root-mean-square acceleration of the free particles, over g.
    pub imbalance: f64,
    /// Report of the solver.
    pub report: Report,
    /// Warnings about the step, such as a seam that was sewn stretched or a garment that slid.
    pub events: Vec<String>,
    /// Phase of the run.
    pub phase: PhaseName,
    /// Spacing of the coarser grid on which the step was made, in m. `None` on the grid of the
    /// scene. The cloth of the scene stays at its start until then.
    pub coarser_grid: Option<f64>,
    /// Whether the simulation is over.
    pub finished: bool,
}

impl Simulation {
    /// Prepares the simulation of `scene` with the [`Scheme`] that the scene asks for.
    ///
    /// # Errors
    /// When the solver cannot be set up, or when `scene` has a [fault](Scene::fault).
    pub fn new(scene: Scene) -> Result<Self, Error> {
        let scheme = Scheme::new(&scene.solver);
        Self::with_scheme(scene, scheme)
    }

    /// Prepares the simulation of `scene` with the scheme `reference`, which checks the schemes
    /// that a scene can ask for.
    ///
    /// # Errors
    /// [`Error::Unsuited`] when the scheme cannot simulate the scene: only `Cholesky` keeps
    /// surfaces apart, and explicit steps neither sew nor come to rest.
    pub fn with_reference_scheme(scene: Scene, reference: ReferenceScheme) -> Result<Self, Error> {
        if let Some(objection) = reference.objection(&scene) {
            return Err(Error::Unsuited { reason: objection.to_owned() });
        }
        let scheme = Scheme::reference(reference, &scene.solver);
        Self::with_scheme(scene, scheme)
    }

    /// Prepares the simulation of `scene` with `scheme` instead of the scheme that the scene asks
    /// for.
    ///
    /// # Errors
    /// When the solver cannot be set up, or when `scene` has a [fault](Scene::fault).
    pub fn with_scheme(mut scene: Scene, scheme: Scheme) -> Result<Self, Error> {
        if let Some(fault) = scene.fault() {
            return Err(Error::Unsuited { reason: fault });
        }
        let coarser = CoarserGrid::take_from(&mut scene, &scheme)?;
        let spacings = scene.panels.iter().flat_map(|panel| panel.lattice.spacing());
        let spacing = spacings.fold(f64::INFINITY, f64::min);
        let (schedule, source) = (scene.schedule, scene.source.clone());
        let parts = GarmentParts::new(&scene);
        let world = World::new(scene)?;

        // The first phase sews the garment if there are seams.
        let steps = if parts.seams.is_empty() {
            PhaseSteps::new(schedule.relaxation, world.relaxes())
        } else {
            PhaseSteps::sewing(spacing)
        };
        let name = match schedule.relaxation {
            _ if !parts.seams.is_empty() => PhaseName::Sew,
            Some(_) => PhaseName::Relax,
            None => PhaseName::Simulate,
        };

        Ok(Self {
            stepping: Stepping::new(&world, scheme, schedule.clock, steps)?,
            statistics: Statistics::new(&world),
            world,
            rest: RestDetector::new(schedule.relaxation),
            phases: Phases {
                begun: vec![Phase { name, start: 0.0, frame: 0 }],
                motion_seconds: schedule.motion_seconds,
                rested: false,
            },
            parts,
            last: LastStep { speed_max: 0.0, imbalance: f64::NAN },
            outcome: Outcome::new(Vec::new()),
            frame_times: Vec::new(),
            spacing,
            source,
            stopwatch: Stopwatch::start(),
            coarser,
            grids: Vec::new(),
            steps_to_forget: 0,
        })
    }

    /// Cancels the current step as soon as `flag` is set, at any point of the solver.
    pub fn give_up_when(&mut self, flag: Arc<AtomicBool>) {
        self.coarser.iter_mut().for_each(|grid| grid.give_up_when(&flag));
        self.world.cancel = Some(flag);
    }

    /// Returns the current time, in s.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.coarser.front().map_or_else(|| self.stepping.time(), CoarserGrid::time)
    }

    /// Returns the current time, in ticks of the clock.
    pub(crate) fn ticks(&self) -> usize {
        self.coarser.front().map_or_else(|| self.stepping.ticks(), CoarserGrid::ticks)
    }

    /// Returns the current positions of cloth and bodies as a [`Frame`], without pressures. Its
    /// number is the number of frames that [`run`](Self::run) has handed on, so a program that
    /// takes frames itself numbers them.
    #[must_use]
    pub fn frame(&self) -> Frame {
        let bodies = self.world.contact.triangulations();
        let bodies: Vec<[f64; 3]> = bodies.into_iter().flat_map(|body| body.vertices).collect();
        let number = self.frame_times.len();
        Frame {
            number,
            time: self.time(),
            growth_fraction: self.world.contact.growth_fraction(),
            cloth: self.world.state.positions.as_chunks::<3>().0.to_vec(),
            bodies_frame: (!bodies.is_empty()).then_some(number),
            bodies,
            ..Frame::default()
        }
    }

    /// Returns the current cloth and bodies for a picture, as a [`Snapshot`].
    #[must_use]
    pub fn snapshot(&self) -> Snapshot {
        Snapshot::new(&self.world, &self.parts, self.spacing)
    }

    /// Returns the triangles and material coordinates that all frames share, as a [`Topology`].
    #[must_use]
    pub fn topology(&self) -> Topology {
        topology::topology(&self.world)
    }

    /// Returns the panels and bodies that all frames share, as a [`Manifest`]. With the
    /// [`topology`](Self::topology) and some [`frame`](Self::frame)s it makes a
    /// [`Recording`](drape_frames::Recording::of_frames), which exports and the verifier take.
    #[must_use]
    pub fn manifest(&self) -> Manifest {
        topology::manifest(&self.world, &self.parts)
    }

    /// Returns the smallest distance of particles before deformation, in m.
    #[must_use]
    pub fn spacing(&self) -> f64 {
        self.spacing
    }

    /// Returns the current positions of the particles, three numbers for each, in m.
    #[must_use]
    pub fn positions(&self) -> &[f64] {
        &self.world.state.positions
    }

    /// Returns the current velocities of the particles, three numbers for each, in m/s.
    #[must_use]
    pub fn velocities(&self) -> &[f64] {
        &self.world.state.velocities
    }

    /// Returns the criteria of rest, if the scene asks for rest.
    #[must_use]
    pub fn rest_criteria(&self) -> Option<Relaxation> {
        self.rest.criteria
    }

    /// Returns whether the scene asks for rest.
    #[must_use]
    pub fn settles(&self) -> bool {
        self.rest.criteria.is_some()
    }

    /// Returns the loads of the pins by their numbers: the pins of the scene in its order, then the
    /// pins of [`hold`](Self::hold). The inertia of the particles that a pin holds is not in its
    /// load. The load of a released pin is zero.
    pub fn pin_loads(&mut self) -> Vec<PinLoad> {
        self.world.pin_loads(self.stepping.time())
    }

    /// Returns the energy balance since the start, or `None` if the scene switches it off.
    #[must_use]
    pub fn energy(&self) -> Option<Energy> {
        self.world.energy()
    }

    /// Returns the hash of positions, velocities and memories, which two runs share only if all
    /// bits agree.
    #[must_use]
    pub fn state_hash(&self) -> String {
        state_hash(&self.world)
    }

    /// Hashes positions and velocities after each step from now on, for [`Summary::step_hashes`]. A
    /// run that resumes from a checkpoint continues the hashes of the earlier run.
    pub fn hash_steps(&mut self) {
        self.statistics.hashes.get_or_insert_default();
    }

    /// Advances by one step. The steps of a garment first sew it, and [`Step::phase`] says when
    /// that is over. A program that steps itself stops at [`Step::finished`].
    ///
    /// # Errors
    /// Returns an error if the step cannot be solved even in parts. The state is then the last
    /// accepted state.
    /// [`Stop::Blocked`](drape_implicit::Stop::Blocked) and
    /// [`Stop::Intersection`](drape_implicit::Stop::Intersection) in it mean that pins or bodies press
    /// surfaces into each other: let them move more slowly, or elsewhere.
    pub fn step(&mut self) -> Result<Step, drape_implicit::Error> {
        if !self.coarser.is_empty() {
            return self.step_on_coarser_grid();
        }
        let earlier_events = self.outcome.events.len();

        let AcceptedStep { ticks, report } =
            self.stepping.advance(&mut self.world, &mut self.statistics)?;
        let dt = ticks as f64 * self.stepping.clock().tick();
        let relaxes = self.world.relaxes();
        if let Some(balance) = &mut self.world.balance {
            balance.add_report(&report, relaxes);
        }
        self.statistics.add_step(&report, &mut self.world);

        let velocities = self.world.state.velocities.chunks_exact(3);
        let squares = velocities.map(|velocity| velocity.iter().map(|v| v * v).sum::<f64>());
        let speed_max = squares.fold(0.0, f64::max).sqrt();
        let imbalance = self.stepping.acceleration(&self.world, dt) / GRAVITY;
        self.last = LastStep { speed_max, imbalance };
        self.stepping.adapt_to_displacement(ticks, speed_max * dt);
        if self.steps_to_forget > 0 {
            self.steps_to_forget -= 1;
            self.world.forget();
        }

        // The step may have ended the phase or the run.
        if self.world.closing_springs().is_some() {
            self.check_seams()?;
        } else {
            self.check_rest(ticks)?;
            self.check_fall();
        }
        self.check_growth();
        if self.is_at_rest()
            && let Some(seconds) = self.phases.motion_seconds
        {
            self.set_in_motion(seconds)?;
        }

        Ok(Step {
            time: self.time(),
            dt,
            speed_max,
            imbalance,
            report,
            events: self.outcome.events[earlier_events..].to_vec(),
            phase: self.phase(),
            coarser_grid: None,
            finished: self.outcome.status != Status::Ok || self.is_over(),
        })
    }

    /// Returns the current phase of the run.
    fn phase(&self) -> PhaseName {
        self.phases.begun.last().map_or(PhaseName::Simulate, |phase| phase.name)
    }

    /// Returns the [`Summary`] of the run until now.
    #[must_use]
    pub fn summary(&self) -> Summary {
        let World { cloth, state, .. } = &self.world;
        let strains = cloth.strains(state).expect(ALL_PARTICLES);

        let limits = self.source.contact_limits.iter();
        Summary {
            status: self.outcome.status.clone(),
            reason: self.outcome.reason.clone(),
            version: env!("CARGO_PKG_VERSION").into(),
            scene_hash: self.source.hash.clone(),
            particles: cloth.particle_count(),
            phases: self.phases.begun.clone(),
            coarser_grids: self.grids.clone(),
            steps: self.statistics.steps,
            frames: self.frame_times.len(),
            frame_times: self.frame_times.clone(),
            simulated_seconds: self.time(),
            wall_seconds: self.stopwatch.wall_seconds(),
            cpu_seconds: self.stopwatch.cpu_seconds(),
            threads: thread_count(),
            solver: self.statistics.solver(),
            energy: self.energy(),
            strain: Strain {
                traction_max: strains.traction_max,
                traction_p99: strains.traction_p99,
                shear_max: strains.shear_max,
                curvature_p99: strains.curvature_p99,
            },
            contact: self.statistics.contacts(&self.world),
            settled: self.has_settled(),
            speed_max: self.last.speed_max,
            imbalance: self.last.imbalance,
            state_hash: self.state_hash(),
            step_hashes: self.statistics.hashes.clone(),
            warnings: self.outcome.warnings.clone(),
            contact_limits: limits.map(|limit| limit.text.clone()).collect(),
            measures: self.outcome.measures.clone(),
            place: self.outcome.place,
        }
    }

    /// Begins the phase `name`. Its first frame is the next frame.
    fn begin_phase(&mut self, name: PhaseName) {
        let (start, frame) = (self.time(), self.frame_times.len());
        self.phases.begun.push(Phase { name, start, frame });
    }

    /// Sets bodies and pins in motion for `seconds`. The cloth, which is at rest, has inertia from
    /// now on.
    fn set_in_motion(&mut self, seconds: f64) -> Result<(), drape_implicit::Error> {
        self.phases.rested = true;
        self.phases.motion_seconds = None;
        self.rest.criteria = None;
        self.world.set_in_motion(self.stepping.time());
        self.stepping.end_after(seconds);
        self.begin_phase(PhaseName::Simulate);
        self.restart(None)
    }

    /// Continues from rest at the positions of the world, with steps for `relaxation`.
    fn restart(&mut self, relaxation: Option<Relaxation>) -> Result<(), drape_implicit::Error> {
        let steps = PhaseSteps::new(relaxation, self.world.relaxes());
        self.stepping.restart(&mut self.world, steps)
    }

    /// Updates the detection of rest after a step of `ticks`.
    fn check_rest(&mut self, ticks: usize) -> Result<(), drape_implicit::Error> {
        let Some(criteria) = self.rest.criteria else { return Ok(()) };
        let LastStep { speed_max, imbalance } = self.last;
        let exact = self.stepping.refine(&mut self.world, &criteria, imbalance)?;
        let counts = exact && self.time() >= self.world.last_change();
        self.rest.update(&StepMotion { ticks, speed_max, imbalance, counts });
        Ok(())
    }

    /// Records garments that slide, and ends a run in which a garment fell off.
    fn check_fall(&mut self) {
        if !self.settles() {
            return;
        }
        let time = self.time();
        let slid = note_slides(&mut self.parts, &self.world.state.positions, time);
        self.outcome.events.extend(slid);
        if let Some(reason) = fallen(&self.parts, &self.world.state.positions) {
            self.end_early(Status::FellOff, reason);
        }
    }

    /// Ends a run in which surfaces cannot reach the distances that they are to keep.
    fn check_growth(&mut self) {
        let Some(surfaces) = self.world.contact.surfaces() else { return };
        if self.outcome.status == Status::Ok && surfaces.growth_is_stuck(self.time()) {
            let percent = 100.0 * surfaces.growth_fraction();
            let reason = format!(
                "surfaces came to {percent:.2} % of the distances that they keep{}",
                self.closest_place().map(|place| format!("; {place}")).unwrap_or_default()
            );
            self.end_early(Status::HeldTogether, reason);
        }
    }

    /// Records that a step failed with `error`.
    fn fail(&mut self, error: &drape_implicit::Error) {
        let status = match error {
            drape_implicit::Error::NotConverged { stop: Stop::Intersection, .. } => {
                Status::Intersecting
            }
            _ => Status::SolverFailed,
        };
        let is_moving =
            self.phases.begun.last().is_some_and(|phase| phase.name == PhaseName::Simulate);
        let failure = step_failure::describe(error, self.closest_place().as_ref(), is_moving);
        let open_seam = self.describe_open_seam();
        self.end_early(status, format!("{failure}{open_seam}"));
    }

    /// Ends the run with `status` and `reason`.
    fn end_early(&mut self, status: Status, reason: String) {
        self.outcome.status = status;
        self.outcome.reason = Some(reason);
    }

    /// Returns where surfaces are closest to their minimum separation.
    fn closest_place(&self) -> Option<ClosestPlace> {
        self.world.contact.surfaces()?.closest_place(&self.world.state.positions)
    }

    fn is_at_rest(&self) -> bool {
        self.rest.is_at_rest(self.stepping.clock().tick())
    }

    /// Returns whether no step remains: the cloth is at rest, or the time is over.
    fn is_over(&self) -> bool {
        self.is_at_rest() || self.ticks() >= self.end_ticks()
    }

    fn has_settled(&self) -> bool {
        self.phases.rested || self.is_at_rest()
    }
}
