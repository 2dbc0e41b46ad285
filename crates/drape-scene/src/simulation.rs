use std::time::Instant;

use drape_implicit::{Motion, Report, Stepper};

use crate::SceneError;
use crate::frame::Frame;
use crate::scene::{Clock, Scene};
use crate::summary::{Contacts, Energy, Solver, Status, Strain, Summary};
use crate::world::World;

/// Time for which the cloth must stay slow to be at rest, in s.
///
/// A swing stops for a moment at each end of its way; a tenth of a second is longer than that for
/// everything but a cloth of many metres, and short against the seconds a drape takes.
const REST_TIME: f64 = 0.1;

/// Part of the spacing that the fastest particle may move in one lengthened step.
///
/// Where the scene allows longer steps ([`Clock::step_max`]), they are taken while the cloth is slow
/// by this measure. A larger part reaches rest in fewer steps but lets the path, which a fabric with
/// friction remembers, depend on the steps.
const MOTION_PER_STEP: f64 = 0.25;

/// A scene in motion.
#[derive(Debug)]
pub struct Simulation {
    world: World,
    motion: Motion,
    stepper: Stepper,
    clock: Clock,
    scene_hash: String,
    steps: usize,
    /// Time in units of the clock's step.
    ticks: usize,
    last_ticks: usize,
    quiet_ticks: usize,
    speed_max: f64,
    spacing: f64,
    status: Status,
    solver: Solver,
    iterations: usize,
    pairs_max: usize,
    initial_energy: f64,
    initial_weight: f64,
    start: Instant,
    start_cpu: Option<f64>,
}

/// What one step did.
#[derive(Debug, Clone, PartialEq)]
pub struct Step {
    /// Time reached, in s.
    pub time: f64,
    /// Largest speed of a particle, in m/s.
    pub speed_max: f64,
    /// The solver's report.
    pub report: Report,
    /// Whether the simulation is over.
    pub finished: bool,
}

/// Watches a running simulation.
pub trait Progress {
    /// A step is done, and the time is so many ticks of the clock.
    fn step(&mut self, step: &Step, ticks: usize);

    /// A frame is due.
    ///
    /// # Errors
    /// What keeps the frame from being stored; the run then ends with it.
    fn frame(&mut self, frame: &Frame) -> Result<(), SceneError>;
}

impl Simulation {
    /// Prepares a scene.
    ///
    /// # Errors
    /// When the solver cannot be set up.
    pub fn new(scene: Scene) -> Result<Self, SceneError> {
        let (settings, clock, scene_hash) = (scene.solver.clone(), scene.clock, scene.hash.clone());
        let spacings = scene.panels.iter().flat_map(|panel| panel.lattice.spacing);
        let spacing = spacings.fold(f64::INFINITY, f64::min);
        let world = World::new(scene);
        let stepper = Stepper::new(&world, settings)?;
        let motion = Motion::at_rest(world.state.positions.clone());
        let initial_weight = world.weight_energy(&motion.positions);
        let initial_energy = initial_weight + world.cloth.stored(&world.state);
        Ok(Self {
            world,
            motion,
            stepper,
            clock,
            scene_hash,
            steps: 0,
            ticks: 0,
            last_ticks: 1,
            quiet_ticks: 0,
            speed_max: 0.0,
            spacing,
            status: Status::Ok,
            solver: Solver::default(),
            iterations: 0,
            pairs_max: 0,
            initial_energy,
            initial_weight,
            start: Instant::now(),
            start_cpu: cpu_seconds(),
        })
    }

    /// Time of the end at the latest, in units of the clock's step.
    #[must_use]
    pub fn ticks_to_do(&self) -> usize {
        (self.clock.end / self.clock.step).round() as usize
    }

    /// Time so far, in units of the clock's step.
    #[must_use]
    pub fn ticks(&self) -> usize {
        self.ticks
    }

    /// Time so far, in s.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.ticks as f64 * self.clock.step
    }

    /// The cloth now.
    #[must_use]
    pub fn frame(&self) -> Frame {
        Frame {
            number: self.ticks.div_ceil(self.clock.ticks_per_frame),
            time: self.time(),
            positions: self.motion.positions.clone(),
        }
    }

    /// Smallest distance of particles before deformation, in m.
    #[must_use]
    pub fn spacing(&self) -> f64 {
        self.spacing
    }

    /// Material coordinates of the particles, in m.
    #[must_use]
    pub fn coordinates(&self) -> &[[f64; 2]] {
        self.world.cloth.coordinates()
    }

    /// Triangles of the surface.
    #[must_use]
    pub fn triangles(&self) -> &[[u32; 3]] {
        self.world.cloth.triangles()
    }

    /// The bodies and the cloth's contact with them.
    #[must_use]
    pub fn contact(&self) -> &drape_collide::Contact {
        &self.world.contact
    }

    /// Advances by one step.
    ///
    /// # Errors
    /// When the step cannot be solved even in parts; the state is then the last good one.
    pub fn step(&mut self) -> Result<Step, drape_implicit::Error> {
        // The clock counts ticks; a sum of lengths would drift.
        self.motion.time = self.time();
        let ticks = self.next_ticks();
        let dt = ticks as f64 * self.clock.step;
        let report = self.stepper.advance(&mut self.world, &mut self.motion, dt)?;
        self.steps += 1;
        self.ticks += ticks;
        self.last_ticks = ticks;
        self.solver.iterations_max = self.solver.iterations_max.max(report.iterations);
        self.solver.rejected_steps += report.rejected;
        self.solver.residual_max = self.solver.residual_max.max(report.residual);
        self.solver.force_evaluations += report.force_evaluations;
        self.solver.linear_iterations += report.linear_iterations;
        self.solver.tangents += report.tangents;
        self.solver.potential_evaluations += report.potential_evaluations;
        self.iterations += report.iterations;
        let survey = self.world.contact.survey(&self.motion.positions);
        self.pairs_max = self.pairs_max.max(survey.touching);
        let square = |v: &[f64]| v.iter().map(|c| c * c).sum::<f64>();
        let squares = self.motion.velocities.chunks_exact(3).map(square);
        self.speed_max = squares.fold(0.0, f64::max).sqrt();
        let quiet = self.clock.rest_speed.is_some_and(|limit| self.speed_max <= limit);
        self.quiet_ticks = if quiet { self.quiet_ticks + ticks } else { 0 };
        Ok(Step {
            time: self.time(),
            speed_max: self.speed_max,
            report,
            finished: self.settled() || self.ticks >= self.ticks_to_do(),
        })
    }

    /// Length of the next step in ticks: one, or twice the last while the cloth is slow, but never
    /// past a frame or the end.
    fn next_ticks(&self) -> usize {
        let frame = self.clock.ticks_per_frame - self.ticks % self.clock.ticks_per_frame;
        let limit = frame.min(self.ticks_to_do() - self.ticks);
        let slow = MOTION_PER_STEP * self.spacing / self.speed_max;
        let longest = (slow.min(self.clock.step_max) / self.clock.step) as usize;
        (2 * self.last_ticks).min(longest).min(limit).max(1)
    }

    /// Runs to the end, to rest, or to a step that cannot be solved; how it ended is in the summary.
    ///
    /// # Errors
    /// Only those of the watcher.
    pub fn run(&mut self, progress: &mut dyn Progress) -> Result<Summary, SceneError> {
        progress.frame(&self.frame())?;
        loop {
            let Ok(step) = self.step() else {
                self.status = Status::SolverFailed;
                break;
            };
            progress.step(&step, self.ticks);
            if step.finished || self.ticks.is_multiple_of(self.clock.ticks_per_frame) {
                progress.frame(&self.frame())?;
            }
            if step.finished {
                if self.clock.rest_speed.is_some() && !self.settled() {
                    self.status = Status::DidNotSettle;
                }
                break;
            }
        }
        Ok(self.summary())
    }

    fn settled(&self) -> bool {
        self.quiet_ticks as f64 * self.clock.step >= REST_TIME
    }

    /// How the run has gone so far.
    #[must_use]
    pub fn summary(&self) -> Summary {
        let World { cloth, state, contact, losses, .. } = &self.world;
        let strains = cloth.strains(state);
        let survey = contact.survey(&state.positions);
        let kinetic = self.world.kinetic();
        let elastic = cloth.stored(state);
        let weight = self.world.weight_energy(&state.positions);
        let spent = kinetic + elastic + weight + losses.friction + losses.air;
        Summary {
            status: self.status.clone(),
            version: env!("CARGO_PKG_VERSION").into(),
            scene_hash: self.scene_hash.clone(),
            particles: cloth.particles(),
            steps: self.steps,
            simulated_seconds: self.time(),
            wall_seconds: self.start.elapsed().as_secs_f64(),
            cpu_seconds: cpu_seconds().zip(self.start_cpu).map(|(now, start)| now - start),
            threads: rayon::current_num_threads(),
            solver: Solver {
                iterations_mean: self.iterations as f64 / self.steps.max(1) as f64,
                ..self.solver
            },
            energy: Energy {
                kinetic,
                elastic,
                gravity: weight - self.initial_weight,
                friction_dissipated: losses.friction,
                air_dissipated: losses.air,
                numerical_dissipated: self.initial_energy - spent,
                work_in: 0.0,
            },
            strain: Strain {
                traction_max: strains.traction_max,
                traction_p99: strains.traction_p99,
                shear_max: strains.shear_max,
                curvature_p99: strains.curvature_p99,
            },
            contact: Contacts {
                pairs_max: self.pairs_max,
                min_distance: Some(survey.min_distance).filter(|d| d.is_finite()),
                intersections: survey.inside,
            },
            settled: self.settled(),
            speed_max: self.speed_max,
            state_hash: self.state_hash(),
            measures: serde_json::Map::new(),
        }
    }

    /// Hash of positions, velocities and memories to the last bit.
    #[must_use]
    pub fn state_hash(&self) -> String {
        let mut hasher = blake3::Hasher::new();
        let state = &self.world.state;
        for value in state.positions.iter().chain(&state.velocities) {
            hasher.update(&value.to_le_bytes());
        }
        for memory in state.memories() {
            let [first, second] = memory.friction;
            for value in [memory.position, first, second, memory.peak] {
                hasher.update(&value.to_le_bytes());
            }
        }
        hasher.finalize().to_hex().to_string()
    }
}

/// Processor time of the process so far, in s, where the system tells.
#[cfg(unix)]
fn cpu_seconds() -> Option<f64> {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
    Some(time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9)
}

#[cfg(not(unix))]
fn cpu_seconds() -> Option<f64> {
    None
}
