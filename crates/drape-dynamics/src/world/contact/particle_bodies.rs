//! Bodies that particles touch, in scenes where surfaces are not kept apart, and how these bodies
//! move.

use drape_collide::{ParticleContact, Pose, Triangulation};
use drape_scene::{BodyMotion, RigidMotion, Scene};
use serde::{Deserialize, Serialize};

use super::step::{ALL_PARTICLES, ContactEnergy, ContactStep};
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
    /// Poses of the bodies at the start of the simulation.
    start: Vec<Pose>,
    /// Bodies that the scene moves.
    moving: Vec<MovingBody>,
    /// Bodies that a program leads, with motions that replace the motions of the scene.
    led: Vec<MovingBody>,
    /// Contact forces at the end of a step, with and without the friction of the step, in N.
    forces: ForcePair,
}

/// Body that moves rigidly.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct MovingBody {
    /// Number of the body.
    body: usize,
    /// Pose of the body at the start of its motion.
    start: Pose,
    motion: RigidMotion,
}

/// Contact forces on all particles, in N.
#[derive(Debug)]
struct ForcePair {
    with_friction: Vec<f64>,
    without_friction: Vec<f64>,
}

/// Energy that friction exchanges with bodies in a step, in J.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FrictionWork {
    /// Potential of contact and friction at the end of the step.
    pub(crate) potential: f64,
    /// Potential of contact alone.
    pub(crate) contact_potential: f64,
    /// Work of the friction on moving bodies.
    pub(crate) body_work: f64,
    /// Work against friction with the friction force at the end of the step.
    pub(crate) loss: f64,
}

impl ParticleBodies {
    /// Returns the contact of particles for the checked `scene`.
    ///
    /// # Errors
    ///
    /// Returns an error if the contact settings of `scene` are invalid.
    pub(crate) fn new(scene: &Scene) -> Result<Self, Error> {
        let moving = scene.bodies.iter().enumerate().filter_map(|(index, moving)| {
            let Some(BodyMotion::Rigid(motion)) = &moving.motion else { return None };
            Some(MovingBody { body: index, start: moving.body.pose, motion: motion.clone() })
        });
        let numbers = scene.start.positions.len();
        let (with_friction, without_friction) = (vec![0.0; numbers], vec![0.0; numbers]);
        Ok(Self {
            contact: scene.particle_contact()?,
            start: scene.bodies.iter().map(|moving| moving.body.pose).collect(),
            moving: moving.collect(),
            led: Vec::new(),
            forces: ForcePair { with_friction, without_friction },
        })
    }

    /// Returns the triangles of `body` at `time` on the motion clock, in s.
    pub(crate) fn outline(&self, body: usize, time: f64) -> Triangulation {
        let mut posed = self.contact.bodies()[body].clone();
        posed.pose = self.pose_at(body, time);
        posed.triangulate().expect("contact has checked it")
    }

    /// Replaces the motion of `body` by `motion`, from its pose at `time` on the motion clock, in
    /// s.
    pub(crate) fn lead(&mut self, body: usize, time: f64, motion: RigidMotion) {
        let start = self.pose_at(body, time);
        self.led.retain(|led| led.body != body);
        self.led.push(MovingBody { body, start, motion });
    }

    /// Returns the bodies that a program leads.
    pub(crate) fn led(&self) -> &[MovingBody] {
        &self.led
    }

    /// Restores the bodies `led` that a program leads, at `time` on the motion clock, in s. Returns
    /// `false` if they do not fit.
    pub(crate) fn restore_led(&mut self, led: Vec<MovingBody>, time: f64) -> bool {
        let is_sound = |led: &MovingBody| led.body < self.start.len() && led.motion.is_sound();
        if !led.iter().all(is_sound) {
            return false;
        }

        self.led = led;
        for body in 0..self.start.len() {
            let pose = self.pose_at(body, time);
            if self.contact.move_body(body, pose).is_err() {
                return false;
            }
        }
        true
    }

    /// Returns the pose of `body` at `time` on the motion clock, in s.
    fn pose_at(&self, body: usize, time: f64) -> Pose {
        let mut motions = self.led.iter().chain(&self.moving);
        let moving = motions.find(|moving| moving.body == body);
        moving.map_or(self.start[body], |moving| moving.motion.pose_at(time, moving.start))
    }

    /// Prepares contact for `step`. Returns the energy of contact at its start, if `step` asks for
    /// it.
    pub(crate) fn begin(&mut self, step: &ContactStep<'_>) -> Option<ContactEnergy> {
        // A repeated step begins with the bodies where they were at its start.
        self.move_bodies(step.motion_start);
        let dt = if step.relaxes { step.dt.min(SLIP_TIME_MAX) } else { step.dt };
        self.contact.begin(step.positions, dt).expect(ALL_PARTICLES);
        let potential_before =
            step.with_energy.then(|| self.contact.potential(step.positions).expect(ALL_PARTICLES));
        self.move_bodies(step.motion_end);
        let potential_before = potential_before?;

        let friction = self.contact.friction_potential(step.positions).expect(ALL_PARTICLES);
        let contact = self.contact.potential(step.positions).expect(ALL_PARTICLES) - friction;
        Some(ContactEnergy {
            contact,
            without_friction: contact,
            friction,
            body_work: contact - potential_before,
        })
    }

    /// Returns the energy exchanged by friction in a step of the length `dt`, in s, from the
    /// positions `start` to `end`. Prepares contact for the next step.
    pub(crate) fn friction_work(&mut self, start: &[f64], end: &[f64], dt: f64) -> FrictionWork {
        let Self { contact, forces: ForcePair { with_friction, without_friction }, .. } = self;
        let potential = evaluate(contact, end, with_friction);
        let body_work = contact.body_friction_work(end).expect(ALL_PARTICLES);

        // A step that has just begun has no slip, and therefore no friction.
        contact.begin(end, dt).expect(ALL_PARTICLES);
        let contact_potential = evaluate(contact, end, without_friction);

        let moved = end.iter().zip(start).map(|(end, start)| end - start);
        let frictions =
            without_friction.iter().zip(&*with_friction).map(|(without, with)| without - with);
        let slip: f64 = moved.zip(frictions).map(|(moved, friction)| moved * friction).sum();
        FrictionWork { potential, contact_potential, body_work, loss: slip + body_work }
    }

    /// Moves the bodies to their poses at `time` on the motion clock, in s.
    fn move_bodies(&mut self, time: f64) {
        let Self { contact, moving, led, .. } = self;
        let moving = moving.iter().filter(|moving| led.iter().all(|led| led.body != moving.body));
        for MovingBody { body, start, motion } in moving.chain(&*led) {
            let pose = motion.pose_at(time, *start);
            contact.move_body(*body, pose).expect("a rigid motion turns a pose into a pose");
        }
    }
}

/// Overwrites `forces` with the forces of `contact` at `positions`, in N. Returns the potential, in
/// J.
fn evaluate(contact: &mut ParticleContact, positions: &[f64], forces: &mut [f64]) -> f64 {
    forces.fill(0.0);
    contact.add_forces(positions, forces).expect(ALL_PARTICLES);
    contact.potential(positions).expect(ALL_PARTICLES)
}
