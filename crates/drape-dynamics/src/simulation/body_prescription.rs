//! Bodies that a program leads between steps.

use drape_collide::{Shape, Triangulation};
use drape_scene::{BodyMotion, ShapeMotion};

use super::Simulation;
use super::prescription::{Displacement, unsuited};
use crate::error::Error;
use crate::world::Contact;

/// Target to which a body moves from its current position.
#[derive(Debug, Clone, PartialEq)]
pub enum BodyTarget {
    /// Positions of the vertices of the body, in m. Each vertex moves along a straight line.
    Vertices(Vec<[f64; 3]>),
    /// Rigid displacement, by default about the middle of the extent of the vertices.
    Rigid(Displacement),
}

impl Simulation {
    /// Returns the name and the current [`Triangulation`] of each body, in the order of
    /// [`Scene::bodies`](drape_scene::Scene::bodies). A body without a name in the scene is called
    /// by its kind and number, from 1, such as `sphere 1`.
    #[must_use]
    pub fn bodies(&self) -> Vec<(String, Triangulation)> {
        let names = self.world.contact.bodies().iter().map(|body| body.name.clone());
        names.zip(self.world.contact.triangulations()).collect()
    }

    /// Moves the body `name` to `target` within `seconds`, at a steady rate from now on. The body
    /// stays there. This motion replaces the earlier motion of the body.
    ///
    /// Contact of surfaces stops a body up to the speed that its stiffness is made for. A scene
    /// declares a larger speed with `contact.top_speed`, and a program with
    /// [`ContactSettings::top_speed`](drape_scene::ContactSettings::top_speed).
    ///
    /// # Errors
    /// [`Error::Unsuited`] for an unknown body, another number of vertices, a time that is not
    /// positive, a speed that contact cannot stop, vertices in a scene without contact of surfaces,
    /// and while bodies grow to their size or wait for the cloth to rest, or the cloth rests on a
    /// coarser grid.
    pub fn lead_body(
        &mut self,
        name: &str,
        target: &BodyTarget,
        seconds: f64,
    ) -> Result<(), Error> {
        let index = self.body_index(name)?;
        let times = self.motion_times(seconds)?;
        let from = self.world.contact.outline(index, times[0]);
        let is_floor = matches!(self.world.contact.bodies()[index].shape, Shape::Plane);
        let motion = match target {
            BodyTarget::Vertices(_) if is_floor => {
                let message = format!("\"{name}\" is a plane; move it with shift and turn");
                return Err(unsuited(message));
            }
            BodyTarget::Vertices(to) => {
                BodyMotion::Shapes(self.shape_motion(name, times, (&from, to))?)
            }
            BodyTarget::Rigid(displacement) => {
                BodyMotion::Rigid(displacement.motion(times, &from.vertices)?)
            }
        };

        // The corners of a floor are far away, so the speed of its middle counts.
        let speed = if is_floor {
            motion.max_speed(&[self.world.contact.bodies()[index].pose.position])
        } else {
            motion.max_speed(&from.vertices)
        };
        if let Some(end) = self
            .world
            .contact
            .surfaces()
            .and_then(|surfaces| surfaces.end_of_inflation(self.time()))
        {
            return Err(unsuited(format!(
                "bodies grow to their size until {end} s; move them after that"
            )));
        }
        self.check_speed(&format!("the body \"{name}\""), speed, seconds)?;

        match (&mut self.world.contact, motion) {
            (Contact::Surfaces(surfaces), motion) => surfaces.lead(index, &from, motion),
            (Contact::Particles(bodies), BodyMotion::Rigid(motion)) => {
                bodies.lead(index, times[0], motion);
            }
            (Contact::Particles(_), BodyMotion::Shapes(_)) => {}
        }
        Ok(())
    }

    /// Returns the number of the body `name`.
    fn body_index(&self, name: &str) -> Result<usize, Error> {
        let bodies = self.world.contact.bodies();
        bodies.iter().position(|body| body.name == name).ok_or_else(|| {
            let names: Vec<&str> = bodies.iter().map(|body| body.name.as_str()).collect();
            let known = if names.is_empty() { "none".into() } else { names.join(", ") };
            unsuited(format!("there is no body {name:?}; the bodies are: {known}"))
        })
    }

    /// Returns the motion of the body `name` between `times`, in s on the motion clock, from its
    /// triangles to other vertices.
    fn shape_motion(
        &self,
        name: &str,
        times: [f64; 2],
        (from, to): (&Triangulation, &[[f64; 3]]),
    ) -> Result<ShapeMotion, Error> {
        if self.world.contact.surfaces().is_none() {
            let message = "only surfaces meet a body that changes its shape; give the scene \
                           contact.surfaces = true, or move the body with shift and turn";
            return Err(unsuited(message.into()));
        }
        if to.len() != from.vertices.len() {
            let (given, needed) = (to.len(), from.vertices.len());
            return Err(unsuited(format!(
                "the body \"{name}\" has {needed} vertices, and {given} are given; give them in the \
                 order of the simulation"
            )));
        }
        let positions = [from.vertices.concat(), to.concat()];
        let motion = ShapeMotion::between(times, positions, &from.triangles);
        motion.map_err(|fault| {
            unsuited(format!("the body \"{name}\": {fault}; give a sound surface"))
        })
    }
}
