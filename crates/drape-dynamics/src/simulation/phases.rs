use drape_implicit::{Error, Integrator, IntegratorState};
use drape_scene::Settle;

use super::Simulation;
use super::rest::Accuracy;
use crate::pace::Pace;
use crate::scheme::{Integration, Scheme};
use crate::summary::{Phase, PhaseName, Status};
use crate::weld::{Weld, join};

/// Widest gap at which the two sides of a seam become one, in m. What the pull of a stitch leaves is a tenth of it.
const CLOSED: f64 = 1e-4;

/// How much longer than it should the drawing together of the seams may take.
const PATIENCE: f64 = 2.0;

/// How far a particle may move in one step while the garment is sewn, in spacings. Half of it took a T-shirt half as long
/// again, twice of it as well.
const STRIDE: f64 = 1.0;

/// Tolerance of the steps while a garment is sewn, over g, and what may be out of balance when its sides become one: what
/// matters of the way is that it ends closed, untangled and calm. With a third of it hems came to rest within 2 mm of
/// where they do now.
const TOLERANCE: f64 = 0.3;

/// How well steps are solved while a garment is sewn.
pub(super) const SEWING: Accuracy = Accuracy { tolerance: TOLERANCE, energy: 1e-2 };

/// How far steps go while a garment is sewn, of particles that are so far apart, in m.
pub(super) fn strides(spacing: f64) -> Settle {
    Settle { speed: 0.0, residual: 0.0, stride: STRIDE * spacing, inertia: false }
}

/// Order of the formula that a scheme asks for.
pub(super) fn order(scheme: &Scheme) -> f64 {
    match scheme {
        Scheme::Implicit(settings) if settings.integrator == Integrator::Bdf2 => 2.0,
        _ => 1.0,
    }
}

impl Simulation {
    /// Sets up a scheme for the system that is solved now.
    pub(super) fn start(&mut self, scheme: &Scheme) -> Result<Integration, Error> {
        match &mut self.weld {
            Some(weld) => weld.start(&mut self.world, scheme),
            None => scheme.start(&self.world),
        }
    }

    /// Ends the sewing when the seams are closed, or when they do not close.
    pub(super) fn judge_seams(&mut self) -> Result<(), Error> {
        let Some(stitches) = self.world.stitches() else { return Ok(()) };
        let (end, (gap, [a, b])) = (stitches.end(), stitches.widest(&self.motion.positions));
        if self.time() < end {
            return Ok(());
        }
        let late = self.time() >= PATIENCE * end;
        if gap <= CLOSED && (late || self.imbalance <= TOLERANCE) {
            return self.sew();
        }
        if late {
            let [x, y, z] = [0, 1, 2].map(|axis| self.motion.positions[3 * a as usize + axis]);
            let [one, other] = [a, b].map(|node| self.panel_of(node as usize));
            let reason = format!(
                "the seam between \"{one}\" and \"{other}\" is still open by {:.2} mm near ({x:.4}, {y:.4}, {z:.4}) m",
                1e3 * gap
            );
            self.reason = Some(reason);
            self.status = Status::SeamsOpen;
        }
        Ok(())
    }

    /// The two sides of every seam become one, and the garment begins to hang.
    fn sew(&mut self) -> Result<(), Error> {
        let mut positions = self.motion.positions.clone();
        join(&self.sewn, self.world.cloth.masses(), &mut positions);
        self.worn.iter_mut().for_each(|worn| worn.hang(&positions));
        self.world.sewn(self.time(), &positions);
        self.world.creep(self.settle.is_some_and(|settle| !settle.inertia));
        self.weld = Some(Weld::new(&self.world, &self.sewn)?);
        self.begin(if self.settle.is_some() { PhaseName::Relax } else { PhaseName::Simulate });
        self.go_on(positions)
    }

    /// The bodies and pins begin to move, and the cloth at rest has inertia from now on, for so many seconds.
    pub(super) fn set_in_motion(&mut self, seconds: f64) -> Result<(), Error> {
        (self.rested, self.settle, self.motion_seconds) = (true, None, None);
        self.world.set_in_motion(self.time());
        self.clock.end = self.time() + seconds;
        self.clock.ticks_max = self.clock.ticks_per_step;
        self.begin(PhaseName::Simulate);
        self.go_on(self.motion.positions.clone())
    }

    /// A phase begins; the next frame is its first.
    fn begin(&mut self, name: PhaseName) {
        self.phases.push(Phase { name, start: self.time(), frame: self.frames + 1 });
    }

    /// Ends a run in which a garment fell off.
    pub(super) fn judge_fall(&mut self) {
        if self.settle.is_some()
            && let Some(reason) = self.fallen()
        {
            (self.status, self.reason) = (Status::FellOff, Some(reason));
        }
    }

    /// Goes on from rest as the world now moves.
    fn go_on(&mut self, positions: Vec<f64>) -> Result<(), Error> {
        self.motion =
            IntegratorState { time: self.motion.time, ..IntegratorState::at_rest(positions) };
        let creeps = self.world.creeps.then_some(Accuracy::CREEPING);
        let (scheme, accuracy) = self.scheme.on_the_way(creeps);
        self.integration = self.start(&scheme)?;
        self.accuracy = accuracy;
        self.pace = Pace::new(self.clock, self.settle, order(&self.scheme));
        Ok(())
    }

    /// The formula of the steps that are made now.
    pub(super) fn integrator(&self) -> Integrator {
        match &self.scheme {
            Scheme::Implicit(settings) if !self.world.creeps => settings.integrator,
            _ => Integrator::BackwardEuler,
        }
    }

    /// Name of the panel that a node is of.
    fn panel_of(&self, node: usize) -> &str {
        let mut panels = self.panels.iter();
        panels.find(|panel| panel.particles.contains(&node)).map_or("", |panel| &panel.name)
    }
}
