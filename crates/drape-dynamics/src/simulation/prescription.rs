//! Prescriptions between steps, by a program that steps the simulation: forces, gravity, moving
//! air, and the checks that all prescriptions share.
//!
//! A program sets forces on the particles, gravity and the velocity of the air for the following
//! steps. It leads bodies (`body_prescription.rs`) and pins (`pin_prescription.rs`). Contact,
//! limits of steps and the energy balance treat these values like prescriptions of the scene, and a
//! saved state holds them.

use drape_input::figure_above;
use drape_scene::{MotionKey, RigidMotion};

use super::{CoarserGrid, Simulation};
use crate::error::Error;
use crate::stepping::RestDetector;

/// Largest acceleration of gravity, in m/s²: of a centrifuge of ten thousand g.
const GRAVITY_MAX: f64 = 1e5;

/// Largest speed of the air, in m/s. Faster air is not incompressible, and the law of drag does not
/// hold.
const AIR_SPEED_MAX: f64 = 100.0;

/// Longest time within which a body or a pin moves, in s.
const SECONDS_MAX: f64 = 1e5;

/// Shortest time within which a body or a pin moves, in s.
const SECONDS_MIN: f64 = 1e-12;

/// Largest coordinate of a displacement, in m or degrees.
const DISPLACEMENT_MAX: f64 = 1e6;

/// Largest relative rounding error of a speed, which is a quotient with a difference of times that
/// may be far from 0.
const SPEED_ERROR: f64 = 1e-4;

/// Rigid displacement of a body or a pin. The default is at rest.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Displacement {
    /// Shift, in m.
    pub shift: [f64; 3],
    /// Angles about x, then y, then z, in degrees.
    pub turn: [f64; 3],
    /// Centre of the rotation, in m. By default the middle of the extent of what moves.
    pub center: Option<[f64; 3]>,
}

impl Displacement {
    /// Returns the motion of `points` between `times`, in s on the motion clock.
    ///
    /// # Errors
    /// [`Error::Unsuited`] for numbers that are not finite or too large.
    pub(super) fn motion(self, times: [f64; 2], points: &[[f64; 3]]) -> Result<RigidMotion, Error> {
        let Self { shift, turn, center } = self;
        let center = center.unwrap_or_else(|| middle(points));
        let numbers = shift.iter().chain(&turn).chain(&center);
        if let Some(number) = numbers.into_iter().find(|x| !(x.abs() <= DISPLACEMENT_MAX)) {
            let message = format!("{number} is no shift, turn or center; give up to 1e6");
            return Err(unsuited(message));
        }
        let motion = RigidMotion::new(
            center,
            vec![
                MotionKey { time: times[0], shift: [0.0; 3], turn: [0.0; 3] },
                MotionKey { time: times[1], shift, turn },
            ],
        );
        Ok(motion.expect("a motion with keys"))
    }
}

impl Simulation {
    /// Sets the forces on the particles for the following steps, in place of earlier ones: three
    /// numbers for each particle, in N. Empty `forces` remove them. The forces are constant during
    /// a step, and their work is part of [`Energy::work_in`](crate::Energy::work_in).
    ///
    /// # Errors
    /// [`Error::Unsuited`] for another number of forces, or numbers that are not finite.
    pub fn apply_forces(&mut self, forces: &[f64]) -> Result<(), Error> {
        let needed = self.world.state.positions.len();
        if !forces.is_empty() && forces.len() != needed {
            let given = forces.len();
            return Err(unsuited(format!(
                "{given} numbers are no forces on {} particles; give 3 for each, in N",
                needed / 3
            )));
        }
        if let Some(index) = forces.iter().position(|force| !force.is_finite()) {
            let (particle, force) = (index / 3, forces[index]);
            return Err(unsuited(format!(
                "the force on particle {particle} is {force} N; give finite numbers"
            )));
        }
        self.world.external.values = forces.to_vec();
        Ok(())
    }

    /// Returns the acceleration of gravity, in m/s². A ramp of the scene may still lead to it.
    #[must_use]
    pub fn gravity(&self) -> [f64; 3] {
        self.coarser.front().map_or_else(|| self.world.gravity(), CoarserGrid::gravity)
    }

    /// Sets the acceleration of gravity to `acceleration`, in m/s², from the next step on. A ramp
    /// of the scene (`time.ramp`) that has not ended leads to the new value.
    ///
    /// [`Energy::gravity`](crate::Energy::gravity) is the work against the weight along the path,
    /// with the gravity of each step, so that the energy balance stays closed.
    ///
    /// # Errors
    /// [`Error::Unsuited`] for numbers that are not finite, or above 1e5 m/s².
    pub fn set_gravity(&mut self, acceleration: [f64; 3]) -> Result<(), Error> {
        if let Some(number) = acceleration.into_iter().find(|g| !(g.abs() <= GRAVITY_MAX)) {
            return Err(unsuited(format!(
                "gravity of {number} m/s²; give three numbers, each up to {GRAVITY_MAX:e} in size"
            )));
        }
        self.set_gravity_of_grids(acceleration);
        Ok(())
    }

    /// Sets the acceleration of gravity on all grids to `acceleration`, in m/s².
    pub(super) fn set_gravity_of_grids(&mut self, acceleration: [f64; 3]) {
        self.coarser.iter_mut().for_each(|grid| grid.set_gravity(acceleration));
        if self.world.gravity() != acceleration {
            self.world.set_gravity(acceleration);
            self.wake();
        }
    }

    /// Sets the velocity of the air to `velocity`, in m/s, from the next step on: a wind that is
    /// equal everywhere and passes round nothing. The drag follows from the velocity of the cloth
    /// relative to the air, with `air.density` and `air.drag` of the scene. The work of the wind,
    /// its force times its velocity, is part of [`Energy::work_in`](crate::Energy::work_in). The
    /// air dissipates the part of this work by which the cloth is slower than the wind.
    ///
    /// # Errors
    /// [`Error::Unsuited`] for numbers that are not finite, for air faster than 100 m/s, and where
    /// air has no effect: in a scene whose `air.density` or `air.drag` is 0, and while the cloth
    /// relaxes without inertia.
    pub fn set_air_velocity(&mut self, velocity: [f64; 3]) -> Result<(), Error> {
        let speed = velocity.iter().map(|v| v * v).sum::<f64>().sqrt();
        if !(speed <= AIR_SPEED_MAX) {
            return Err(unsuited(format!(
                "air of the velocity {velocity:?} m/s; give three numbers, at most {AIR_SPEED_MAX} m/s \
                 together"
            )));
        }
        if speed > 0.0 && !self.world.air().resists() {
            let message = "the air of this scene has no drag; give air.density and air.drag of the \
                           scene values above 0";
            return Err(unsuited(message.into()));
        }
        if speed > 0.0 && (self.world.relaxes() || !self.coarser.is_empty()) {
            let message = "the air has no effect while the cloth relaxes without inertia; step until \
                           the phase is \"simulate\", or give the scene settle.inertia = true";
            return Err(unsuited(message.into()));
        }
        if self.world.air().velocity() != velocity {
            self.world.set_air_velocity(velocity);
            self.wake();
        }
        Ok(())
    }

    /// Returns the length of the next step, in s. The estimate of its error may still shorten this
    /// step.
    #[must_use]
    pub fn next_step(&self) -> f64 {
        self.stepping.next_step()
    }

    /// Begins to wait for rest again, because the forces on the cloth have changed.
    pub(super) fn wake(&mut self) {
        self.rest = RestDetector::new(self.rest.criteria);
    }

    /// Checks that bodies and pins of the grid of the scene move: no coarser grid is in front.
    pub(super) fn check_grid(&self) -> Result<(), Error> {
        if self.coarser.is_empty() {
            return Ok(());
        }
        let message = "the cloth rests on a coarser grid first; step until coarser_grid of a step \
                       is None, or leave [refine] out";
        Err(unsuited(message.into()))
    }

    /// Returns start and end on the motion clock, in s, of a motion that begins now and takes
    /// `seconds`.
    pub(super) fn motion_times(&self, seconds: f64) -> Result<[f64; 2], Error> {
        self.check_grid()?;
        if !(seconds > 0.0 && seconds <= SECONDS_MAX) {
            return Err(unsuited(format!(
                "a motion within {seconds} s; give a time above 0, up to 1e5 s"
            )));
        }
        let Some(start) = self.world.motion_time(self.time()) else {
            let message = "bodies and pins wait for the cloth to rest, as motion.seconds of the scene \
                           asks for; step until the phase is \"simulate\"";
            return Err(unsuited(message.into()));
        };
        // The speed of a motion is read off a thousandth of its time.
        if seconds < SECONDS_MIN.max(1e3 * f64::EPSILON * start / SPEED_ERROR) {
            return Err(unsuited(format!(
                "a motion within {seconds} s, {start} s after the start; give a length of a step"
            )));
        }
        Ok([start, start + seconds])
    }

    /// Checks that contact can stop `subject`, which moves at `speed`, in m/s, for `seconds`.
    pub(super) fn check_speed(&self, subject: &str, speed: f64, seconds: f64) -> Result<(), Error> {
        let Some(surfaces) = self.world.contact.surfaces() else { return Ok(()) };
        let largest = surfaces.speeds.largest;
        if speed <= (1.0 + SPEED_ERROR) * largest {
            return Ok(());
        }

        let needed = figure_above(seconds * speed / largest);
        let remedy = surfaces.speeds.remedy(speed);
        let remedy = remedy.map_or(String::new(), |remedy| format!(", or the scene {remedy}"));
        Err(unsuited(format!(
            "{subject} moves at {speed:.3} m/s; contact keeps these fabrics apart up to {largest:.3} \
             m/s: give it {needed} s or more{remedy}"
        )))
    }
}

/// Returns an [`Error::Unsuited`] with `reason`.
pub(super) fn unsuited(reason: String) -> Error {
    Error::Unsuited { reason }
}

/// Returns the middle of the extent of `points`.
pub(super) fn middle(points: &[[f64; 3]]) -> [f64; 3] {
    [0, 1, 2].map(|axis| {
        let values = points.iter().map(|point| point[axis]);
        0.5 * (values.clone().fold(f64::MAX, f64::min) + values.fold(f64::MIN, f64::max))
    })
}
