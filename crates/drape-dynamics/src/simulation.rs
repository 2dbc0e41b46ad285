mod advance;
mod growth;
mod outcome;
mod phases;
mod rest;

use std::collections::BTreeMap;
use std::ops::Range;

use drape_implicit::{ErrorEstimate, IntegratorState, Report};
use drape_scene::{Clock, Panel, Scene, Settle, Stitching};

use self::rest::Accuracy;
use crate::error::Error;
use crate::frame::Frame;
use crate::measures::{FreeEdge, free_edges};
use crate::pace::Pace;
use crate::pin_load::PinLoad;
use crate::scheme::{Integration, Scheme};
use crate::stopwatch::Stopwatch;
use crate::stretch::reaches;
use crate::summary::{Energy, Phase, PhaseName, Solver, Status, Summary};
use crate::weld::Weld;
use crate::world::World;
use crate::worn::{Worn, lowest};

/// Acceleration that residuals are relative to, in m/s².
const GRAVITY: f64 = 9.81;

/// A scene in motion.
#[derive(Debug)]
pub struct Simulation {
    pub(crate) world: World,
    motion: IntegratorState,
    scheme: Scheme,
    integration: Integration,
    /// What makes sewn nodes one, once they are sewn.
    weld: Option<Weld>,
    /// The nodes of the seams.
    pub(crate) sewn: Stitching,
    /// The edges of panels that are not sewn.
    pub(crate) free_edges: Vec<FreeEdge>,
    /// What was measured at the end of the run.
    measures: serde_json::Map<String, serde_json::Value>,
    /// How well steps are solved now.
    accuracy: Accuracy,
    /// How long it goes on with motion when it has come to rest, in s, until it has.
    motion_seconds: Option<f64>,
    /// Whether it came to rest before it was set in motion.
    rested: bool,
    estimate: ErrorEstimate,
    clock: Clock,
    pace: Pace,
    settle: Option<Settle>,
    scene_hash: String,
    steps: usize,
    ticks: usize,
    quiet_ticks: usize,
    speed_max: f64,
    imbalance: f64,
    spacing: f64,
    pub(crate) panels: Vec<PanelSpan>,
    pub(crate) worn: Vec<Worn>,
    /// The lowest point of the bodies, in m, if a garment that is below it falls for ever.
    pub(crate) ground: Option<f64>,
    /// How far each fabric was measured, by its name and the keys of its laws.
    pub(crate) reaches: BTreeMap<String, BTreeMap<String, f64>>,
    phases: Vec<Phase>,
    warnings: Vec<String>,
    frames: usize,
    status: Status,
    reason: Option<String>,
    solver: Solver,
    iterations: usize,
    pairs_max: usize,
    /// Most particles that were thinned, and that were released, after any step.
    pinched_max: [usize; 2],
    /// The smallest distance of two surfaces after any step, in m.
    distance_min: f64,
    stopwatch: Stopwatch,
}

/// Which particles are a panel's.
#[derive(Debug, Clone)]
pub(crate) struct PanelSpan {
    pub(crate) name: String,
    /// Name of its fabric in the scene.
    pub(crate) fabric: String,
    pub(crate) particles: Range<usize>,
}

/// What one step did.
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
    /// The solver's report.
    pub report: Report,
    /// Whether the simulation is over.
    pub finished: bool,
}

/// Watches a running simulation. What is not told of here passes unseen; `()` sees nothing.
pub trait Progress {
    /// A step is done, and the time is so many ticks of the clock.
    fn step(&mut self, _step: &Step, _ticks: usize) {}

    /// A frame is due.
    ///
    /// # Errors
    /// What keeps the frame from being stored; the run then ends with it.
    fn frame(&mut self, _frame: &Frame) -> Result<(), Error> {
        Ok(())
    }
}

impl Progress for () {}

impl Simulation {
    /// Prepares a scene.
    ///
    /// # Errors
    /// When the solver cannot be set up.
    pub fn new(scene: Scene) -> Result<Self, Error> {
        let scheme = Scheme::of(&scene);
        Self::with_scheme(scene, scheme)
    }

    /// Prepares a scene with another scheme than it asks for.
    ///
    /// # Errors
    /// When the solver cannot be set up.
    pub fn with_scheme(scene: Scene, scheme: Scheme) -> Result<Self, Error> {
        let (clock, settle, scene_hash) = (scene.clock, scene.settle, scene.hash.clone());
        let scene_motion = scene.motion_seconds;
        let spacings = scene.panels.iter().flat_map(|panel| panel.lattice.spacing);
        let spacing = spacings.fold(f64::INFINITY, f64::min);
        let span = |panel: &Panel| PanelSpan {
            name: panel.name.clone(),
            fabric: scene.materials[panel.material].name.clone(),
            particles: panel.particles(),
        };
        let panels = scene.panels.iter().map(span).collect();
        let worn = scene.garments.iter().cloned();
        let worn: Vec<Worn> = worn.map(|own| Worn::new(own, &scene.positions)).collect();
        let ground = if worn.is_empty() {
            None
        } else {
            lowest(scene.bodies.iter().map(|moving| &moving.body))
        };
        let reaches = reaches(&scene.materials);
        let free_edges = free_edges(&scene);
        let sewn = scene.sewing.as_ref();
        let sewn = sewn.map_or_else(Stitching::default, |sewing| sewing.stitching.clone());
        let world = World::new(scene)?;
        let creeps = if sewn.is_empty() {
            world.creeps.then_some(Accuracy::CREEPING)
        } else {
            Some(phases::SEWING)
        };
        let (now, accuracy) = scheme.on_the_way(creeps);
        let integration = now.start(&world)?;
        let order = phases::order(&scheme);
        let name = match (sewn.is_empty(), settle) {
            (false, _) => PhaseName::Sew,
            (true, Some(_)) => PhaseName::Relax,
            (true, None) => PhaseName::Simulate,
        };
        let strides = if sewn.is_empty() { settle } else { Some(phases::strides(spacing)) };
        Ok(Self {
            motion: IntegratorState {
                velocities: world.state.velocities.clone(),
                ..IntegratorState::at_rest(world.state.positions.clone())
            },
            estimate: ErrorEstimate::new(world.cloth.particles()),
            world,
            scheme,
            integration,
            weld: None,
            sewn,
            free_edges,
            measures: serde_json::Map::new(),
            accuracy,
            motion_seconds: scene_motion,
            rested: false,
            pace: Pace::new(clock, strides, order),
            clock,
            settle,
            scene_hash,
            steps: 0,
            ticks: 0,
            quiet_ticks: 0,
            speed_max: 0.0,
            imbalance: f64::NAN,
            spacing,
            panels,
            worn,
            ground,
            reaches,
            phases: vec![Phase { name, start: 0.0, frame: 0 }],
            warnings: Vec::new(),
            frames: 0,
            status: Status::Ok,
            reason: None,
            solver: Solver::default(),
            iterations: 0,
            pairs_max: 0,
            pinched_max: [0; 2],
            distance_min: f64::INFINITY,
            stopwatch: Stopwatch::start(),
        })
    }

    /// Time of the end at the latest, in ticks of the clock.
    #[must_use]
    pub fn ticks_to_do(&self) -> usize {
        self.clock.ticks_to_do()
    }

    /// Time so far, in s.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.ticks as f64 * self.clock.tick()
    }

    /// The cloth now.
    #[must_use]
    pub fn frame(&self) -> Frame {
        let positions = self.motion.positions.clone();
        let bodies = self.outlines().into_iter().flat_map(|outline| outline.vertices).flatten();
        let (bodies, grown) = (bodies.collect(), self.world.grown());
        Frame { number: self.frames, time: self.time(), positions, bodies, grown }
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
    pub fn contact(&self) -> &drape_collide::ParticleContact {
        &self.world.contact
    }

    /// Whether the scene asks for rest.
    #[must_use]
    pub fn settles(&self) -> bool {
        self.settle.is_some()
    }

    /// What each pin bears, in the order of the scene, without the inertia of what it holds; nothing once it has let go.
    pub fn pin_loads(&mut self) -> Vec<PinLoad> {
        self.world.pin_loads(self.time())
    }

    /// The balance of the energy since the start, unless the scene does without.
    #[must_use]
    pub fn energy(&self) -> Option<Energy> {
        let ledger = self.world.ledger.as_ref()?;
        Some(ledger.balance(self.world.kinetic()))
    }

    /// Advances by one step.
    ///
    /// # Errors
    /// When the step cannot be solved even in parts; the state is then the last good one.
    pub fn step(&mut self) -> Result<Step, drape_implicit::Error> {
        // The clock counts ticks; a sum of lengths would drift.
        self.motion.time = self.time();
        let (ticks, report) = self.advance()?;
        let dt = ticks as f64 * self.clock.tick();
        self.steps += 1;
        self.ticks += ticks;
        self.count(&report);
        let square = |v: &[f64]| v.iter().map(|c| c * c).sum::<f64>();
        let squares = self.motion.velocities.chunks_exact(3).map(square);
        self.speed_max = squares.fold(0.0, f64::max).sqrt();
        self.imbalance = self.acceleration(dt) / GRAVITY;
        self.pace.follow(ticks, self.speed_max * dt);
        match self.world.stitches() {
            Some(_) => self.judge_seams()?,
            None => {
                self.judge_rest(ticks)?;
                self.judge_fall();
            }
        }
        self.judge_growth();
        if let (true, Some(seconds)) = (self.at_rest(), self.motion_seconds) {
            self.set_in_motion(seconds)?;
        }
        Ok(Step {
            time: self.time(),
            dt,
            speed_max: self.speed_max,
            imbalance: self.imbalance,
            report,
            finished: self.at_rest()
                || self.status != Status::Ok
                || self.ticks >= self.ticks_to_do(),
        })
    }

    /// Runs to the end, to rest, or to a step that cannot be solved; how it ended is in the summary.
    ///
    /// # Errors
    /// Only those of the watcher.
    pub fn run(&mut self, progress: &mut dyn Progress) -> Result<Summary, Error> {
        progress.frame(&self.frame())?;
        loop {
            let before = self.ticks / self.clock.ticks_per_frame;
            let phases = self.phases.len();
            let step = match self.step() {
                Ok(step) => step,
                Err(error) => {
                    self.fail(&error);
                    break;
                }
            };
            progress.step(&step, self.ticks);
            let due = self.ticks / self.clock.ticks_per_frame > before;
            if step.finished || due || self.phases.len() > phases {
                self.frames += 1;
                progress.frame(&self.frame())?;
            }
            if step.finished {
                if self.status == Status::Ok && self.settle.is_some() && !self.settled() {
                    self.status = Status::DidNotSettle;
                }
                break;
            }
        }
        self.measures = self.measure();
        self.warnings = [self.sunk(), self.extrapolated(), self.stunted()].concat();
        Ok(self.summary())
    }
}
