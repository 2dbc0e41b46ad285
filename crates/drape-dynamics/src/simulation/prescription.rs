//! Prescription between steps: what a program does to a simulation that it steps itself.
//!
//! Forces act on the particles during the steps that follow, and bodies are led to where they are to
//! be. Contact, limits of steps and the balance of the energy treat both as what the scene itself
//! prescribes.

use drape_collide::{Shape, Triangulation};
use drape_input::figure_above;
use drape_scene::{BodyMotion, MotionKey, RigidMotion, ShapeMotion};

use super::Simulation;
use crate::error::Error;
use crate::world::Contact;

/// Place to which a body is led, from where it is.
#[derive(Debug, Clone, PartialEq)]
pub enum BodyTarget {
    /// Positions of its vertices, in m, to which they move straight.
    Vertices(Vec<[f64; 3]>),
    /// Rigid displacement.
    Rigid {
        /// Displacement, in m.
        shift: [f64; 3],
        /// Angles about x, then y, then z, in degrees.
        turn: [f64; 3],
        /// Centre of the rotation, in m; the middle of the extent of its vertices if missing.
        center: Option<[f64; 3]>,
    },
}

impl Simulation {
    /// Sets forces on the particles for the steps that follow, in place of earlier ones: three numbers
    /// for each particle, in N; an empty list removes them. They are constant during a step, and
    /// their work is part of [`Energy::work_in`](crate::Energy::work_in).
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

    /// Returns the length of the next step, in s, unless its error makes it shorter.
    #[must_use]
    pub fn next_step(&self) -> f64 {
        self.stepping.next_step()
    }

    /// Returns the bodies at the present time: names and triangles.
    #[must_use]
    pub fn bodies(&self) -> Vec<(String, Triangulation)> {
        let names = self.world.contact.bodies().iter().map(|body| body.name.clone());
        names.zip(self.world.contact.triangulations()).collect()
    }

    /// Leads a body to a place within some seconds, at a steady rate from now on; there it stays. It
    /// takes the place of the body's motion.
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
                let places = [from.vertices.concat(), to.concat()];
                let motion = ShapeMotion::between(times, places, &from.triangles);
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
                let key = |time: f64, shift, turn| MotionKey { time, shift, turn };
                let keys = vec![key(times[0], [0.0; 3], [0.0; 3]), key(times[1], *shift, *turn)];
                let motion = RigidMotion::new(center, keys);
                BodyMotion::Rigid(motion.expect("a motion with keys"))
            }
        };
        // The corners of a floor are far out: its middle counts.
        let speed = match is_floor {
            true => motion.max_speed(&[bodies[index].pose.position]),
            false => motion.max_speed(&from.vertices),
        };
        if let Some(surfaces) = self.world.contact.surfaces() {
            if let Some(end) = surfaces.end_of_inflation(now) {
                return Err(unsuited(format!(
                    "bodies grow to their size until {end} s; move them after that"
                )));
            }
            let most = surfaces.speed_max();
            if !(speed <= most) {
                let needed = figure_above(seconds * speed / most);
                let stiffness = figure_above(surfaces.stiffness_of_speed(speed));
                return Err(unsuited(format!(
                    "the body \"{name}\" moves at {speed:.3} m/s; contact keeps these fabrics apart up \
                     to {most:.3} m/s: give it {needed} s or more, or the scene \
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

/// Middle of the extent of some points.
fn middle(points: &[[f64; 3]]) -> [f64; 3] {
    [0, 1, 2].map(|axis| {
        let values = || points.iter().map(|point| point[axis]);
        0.5 * (values().fold(f64::MAX, f64::min) + values().fold(f64::MIN, f64::max))
    })
}
