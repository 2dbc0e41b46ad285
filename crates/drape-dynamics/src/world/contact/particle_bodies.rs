//! Bodies that particles touch, in scenes where surfaces are not kept apart, and how these bodies
//! move.

use drape_collide::{ParticleContact, Pose, Triangulation};
use drape_scene::{BodyMotion, RigidMotion, Scene};

use super::step::{ContactEnergy, ContactStep};
use crate::error::Error;

/// Longest time over which contact with a body counts slip in one step of quasi-static relaxation,
/// in s.
///
/// Below its slip speed a contact that sticks slips slowly. The length of a step of relaxation
/// is not a duration, and without this limit cloth would slide off a body during long ones.
const SLIP_TIME_MAX: f64 = 0.01;

/// Contact of particles with bodies.
#[derive(Debug)]
pub(crate) struct ParticleBodies {
    pub(crate) contact: ParticleContact,
    moving: Vec<MovingBody>,
    /// Forces of contact at the end of a step, with the friction of the step and without it, in N.
    forces: ForcePair,
}

/// A body that moves as a rigid one.
#[derive(Debug)]
struct MovingBody {
    /// Its number.
    body: usize,
    /// Its pose at the start.
    start: Pose,
    motion: RigidMotion,
}

#[derive(Debug)]
struct ForcePair {
    with_friction: Vec<f64>,
    without_friction: Vec<f64>,
}

/// Energy that a step exchanged with bodies by friction, in J.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FrictionWork {
    /// Potential of contact and friction at the end of the step.
    pub(crate) potential: f64,
    /// Potential of contact alone.
    pub(crate) contact_potential: f64,
    /// Work of the friction of bodies that move.
    pub(crate) body_work: f64,
    /// Work against the friction with its force at the end of the step.
    pub(crate) loss: f64,
}

impl ParticleBodies {
    /// Bodies of a scene that has been checked.
    pub(crate) fn new(scene: &Scene) -> Result<Self, Error> {
        let moving = scene.bodies.iter().enumerate().filter_map(|(index, moving)| {
            let Some(BodyMotion::Rigid(motion)) = &moving.motion else { return None };
            Some(MovingBody { body: index, start: moving.body.pose, motion: motion.clone() })
        });
        let numbers = scene.start.positions.len();
        let (with_friction, without_friction) = (vec![0.0; numbers], vec![0.0; numbers]);
        Ok(Self {
            contact: scene.particle_contact()?,
            moving: moving.collect(),
            forces: ForcePair { with_friction, without_friction },
        })
    }

    /// Triangles of a body at a time on the clock of motions, in s.
    pub(crate) fn outline(&self, body: usize, time: f64) -> Triangulation {
        let mut own = self.contact.bodies()[body].clone();
        own.pose = self.pose_at(body, time);
        own.triangulate().expect("contact has checked it")
    }

    /// Leads a body along a motion from where it is at a time on the clock of motions, in s.
    pub(crate) fn lead(&mut self, body: usize, time: f64, motion: RigidMotion) {
        let start = self.pose_at(body, time);
        self.moving.retain(|moving| moving.body != body);
        self.moving.push(MovingBody { body, start, motion });
    }

    /// Pose of a body at a time on the clock of motions, in s.
    fn pose_at(&self, body: usize, time: f64) -> Pose {
        let moving = self.moving.iter().find(|moving| moving.body == body);
        moving.map_or(self.contact.bodies()[body].pose, |own| own.motion.pose_at(time, own.start))
    }

    /// Opens a step and returns the energy of contact at its start if that is asked for.
    pub(crate) fn begin(&mut self, step: &ContactStep<'_>) -> Option<ContactEnergy> {
        // A step that is tried again begins where the bodies were at its start.
        self.move_bodies(step.motion_start);
        self.contact
            .begin(step.positions, if step.relaxes { step.dt.min(SLIP_TIME_MAX) } else { step.dt });
        let at_rest = step.with_energy.then(|| self.contact.potential(step.positions));
        self.move_bodies(step.motion_end);
        let at_rest = at_rest?;
        let friction = self.contact.friction_potential(step.positions);
        let contact = self.contact.potential(step.positions) - friction;
        Some(ContactEnergy { contact, friction, body_work: contact - at_rest })
    }

    /// Energy exchanged by friction in a step of a length, in s, that ends at some positions. Opens
    /// the next step.
    pub(crate) fn friction_work(&mut self, start: &[f64], end: &[f64], dt: f64) -> FrictionWork {
        let Self { contact, forces: ForcePair { with_friction, without_friction }, .. } = self;
        let evaluate = |contact: &mut ParticleContact, forces: &mut [f64]| {
            forces.fill(0.0);
            contact.add_forces(end, forces);
            contact.potential(end)
        };
        let potential = evaluate(contact, with_friction);
        let body_work = contact.body_friction_work(end);
        // A step just opened has no slip and so no friction.
        contact.begin(end, dt);
        let contact_potential = evaluate(contact, without_friction);
        let moved = end.iter().zip(start).map(|(end, start)| end - start);
        let frictions =
            without_friction.iter().zip(&*with_friction).map(|(without, with)| without - with);
        let slip: f64 = moved.zip(frictions).map(|(moved, friction)| moved * friction).sum();
        FrictionWork { potential, contact_potential, body_work, loss: slip + body_work }
    }

    /// Moves the bodies to their poses at a time on the clock of motions, in s.
    fn move_bodies(&mut self, time: f64) {
        for MovingBody { body, start, motion } in &self.moving {
            let pose = motion.pose_at(time, *start);
            self.contact.move_body(*body, pose).expect("a rigid motion turns a pose into a pose");
        }
    }
}
