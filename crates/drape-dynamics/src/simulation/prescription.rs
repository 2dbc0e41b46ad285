//! Prescriptions between steps, by a program that steps the simulation.
//!
//! A program sets forces on the particles for the following steps, and moves bodies to prescribed
//! positions. Contact, limits of steps and the energy balance treat both like prescriptions of the
//! scene.

use drape_collide::{Shape, Triangulation};
use drape_input::figure_above;
use drape_scene::{BodyMotion, MotionKey, RigidMotion, ShapeMotion};

use super::Simulation;
use crate::error::Error;
use crate::world::Contact;

/// Target to which a body moves from its current position.
#[derive(Debug, Clone, PartialEq)]
pub enum BodyTarget {
    /// Positions of the vertices of the body, in m. Each vertex moves along a straight line.
    Vertices(Vec<[f64; 3]>),
    /// Rigid displacement.
    Rigid {
        /// Displacement, in m.
        shift: [f64; 3],
        /// Angles about x, then y, then z, in degrees.
        turn: [f64; 3],
        /// Centre of the rotation, in m. By default the middle of the extent of the vertices.
        center: Option<[f64; 3]>,
    },
}

impl Simulation {
    /// Sets the forces on the particles for the following steps, in place of earlier ones: three
    /// numbers for each particle, in N. Empty `forces` remove them. The forces are constant during
    /// a step, and their work is part of [`Energy::work_in`](crate::Energy::work_in).
    ///
    /// # Errors
    ///
    /// Returns [`Error::Unsuited`] if the number of `forces` is wrong or a force is not finite.
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

    /// Returns the length of the next step, in s. The estimate of its error may still shorten this
    /// step.
    #[must_use]
    pub fn next_step(&self) -> f64 {
        self.stepping.next_step()
    }

    /// Returns the name and the current [`Triangulation`] of each body.
    #[must_use]
    pub fn bodies(&self) -> Vec<(String, Triangulation)> {
        let names = self.world.contact.bodies().iter().map(|body| body.name.clone());
        names.zip(self.world.contact.triangulations()).collect()
    }

    /// Moves the body `name` to `target` within `seconds`, at a steady rate from now on. The body
    /// stays there. This motion replaces the earlier motion of the body.
    ///
    /// # Errors
    ///
    /// Returns [`Error::Unsuited`] for an unknown body, a wrong number of vertices, a time that is
    /// not positive, a speed that contact cannot stop, vertices in a scene without contact of
    /// surfaces, and while bodies grow to their size or wait for the cloth to rest.
    ///
    /// # Errors
    /// [`Error::Unsuited`] for an unknown body, another number of vertices, a time that is not
    /// positive, a speed that contact cannot stop, vertices in a scene without contact of surfaces,
    /// and while bodies grow to their size or wait for the cloth to rest.
    pub fn lead_body(
        &mut self,
        name: &str,
        target: &BodyTarget,
        seconds: f64,
    ) -> Result<(), Error> {
        let bodies = self.world.contact.bodies();
        let Some(index) = bodies.iter().position(|body| body.name == name) else {
            let names: Vec<&str> = bodies.iter().map(|body| body.name.as_str()).collect();
            let known = if names.is_empty() { "none".into() } else { names.join(", ") };
            return Err(unsuited(format!("there is no body {name:?}; the bodies are: {known}")));
        };
        if !(seconds > 0.0 && seconds <= 1e5) {
            return Err(unsuited(format!(
                "a body moves within {seconds} s; give a time above 0, up to 1e5 s"
            )));
        }

        let is_floor = matches!(bodies[index].shape, Shape::Plane);
        let now = self.time();
        let Some(start) = self.world.motion_time(now) else {
            let message = "bodies wait for the cloth to rest, as motion.seconds of the scene asks \
                           for; step until the phase is \"simulate\"";
            return Err(unsuited(message.into()));
        };

        let times = [start, start + seconds];
        let from = self.world.contact.outline(index, start);
        let motion = match target {
            BodyTarget::Vertices(to) if !is_floor => {
                if self.world.contact.surfaces().is_none() {
                    let message = "only surfaces meet a body that changes its shape; give the scene \
                                   contact.surfaces = true, or move the body with shift and turn";
                    return Err(unsuited(message.into()));
                }
                if to.len() != from.vertices.len() {
                    let (given, needed) = (to.len(), from.vertices.len());
                    return Err(unsuited(format!(
                        "the body \"{name}\" has {needed} vertices, and {given} are given; give them \
                         in the order of the simulation"
                    )));
                }
                let positions = [from.vertices.concat(), to.concat()];
                let motion = ShapeMotion::between(times, positions, &from.triangles);
                BodyMotion::Shapes(motion.map_err(|fault| {
                    unsuited(format!("the body \"{name}\": {fault}; give a sound surface"))
                })?)
            }
            BodyTarget::Vertices(_) => {
                let message = format!("\"{name}\" is a plane; move it with shift and turn");
                return Err(unsuited(message));
            }
            BodyTarget::Rigid { shift, turn, center } => {
                let center = center.unwrap_or_else(|| middle(&from.vertices));
                let numbers = shift.iter().chain(turn).chain(&center);
                if let Some(number) = numbers.into_iter().find(|x| !(x.abs() <= 1e6)) {
                    let message = format!("{number} is no shift, turn or center; give up to 1e6");
                    return Err(unsuited(message));
                }
                let motion = RigidMotion::new(
                    center,
                    vec![
                        MotionKey { time: times[0], shift: [0.0; 3], turn: [0.0; 3] },
                        MotionKey { time: times[1], shift: *shift, turn: *turn },
                    ],
                );
                BodyMotion::Rigid(motion.expect("a motion with keys"))
            }
        };

        // The corners of a floor are far away, so the speed of its middle counts.
        let speed = if is_floor {
            motion.max_speed(&[bodies[index].pose.position])
        } else {
            motion.max_speed(&from.vertices)
        };
        if let Some(surfaces) = self.world.contact.surfaces() {
            if let Some(end) = surfaces.end_of_inflation(now) {
                return Err(unsuited(format!(
                    "bodies grow to their size until {end} s; move them after that"
                )));
            }
            let speed_max = surfaces.speed_max();
            if !(speed <= speed_max) {
                let needed = figure_above(seconds * speed / speed_max);
                let stiffness = figure_above(surfaces.stiffness_of_speed(speed));
                return Err(unsuited(format!(
                    "the body \"{name}\" moves at {speed:.3} m/s; contact keeps these fabrics apart up \
                     to {speed_max:.3} m/s: give it {needed} s or more, or the scene \
                     contact.stiffness = {stiffness}"
                )));
            }
        }

        match (&mut self.world.contact, motion) {
            (Contact::Surfaces(surfaces), motion) => surfaces.lead(index, &from, motion),
            (Contact::Particles(bodies), BodyMotion::Rigid(motion)) => {
                bodies.lead(index, start, motion);
            }
            (Contact::Particles(_), BodyMotion::Shapes(_)) => {}
        }
        Ok(())
    }
}

fn unsuited(reason: String) -> Error {
    Error::Unsuited { reason }
}

/// Returns the middle of the extent of `points`.
fn middle(points: &[[f64; 3]]) -> [f64; 3] {
    [0, 1, 2].map(|axis| {
        let values = points.iter().map(|point| point[axis]);
        0.5 * (values.clone().fold(f64::MAX, f64::min) + values.fold(f64::MIN, f64::max))
    })
}
