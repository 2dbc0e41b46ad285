mod system;

use drape_cloth::{Cloth, SeamBending, State};
use drape_collide::{ParticleContact, Pose};
use drape_implicit::System;
use drape_scene::{Course, Pin, Scene, Track, Until};

use crate::attachments::Attachments;
use crate::bonds::Bonds;
use crate::error::Error;
use crate::ledger::{Entry, Ledger};
use crate::pin_load::PinLoad;
use crate::stitches::Stitches;
use crate::surfaces::Surfaces;

/// Longest time over which contact with a body counts slip in one step of a creeping cloth, in s.
///
/// Below its slip speed a contact that sticks creeps. The length of a creeping step is not a duration,
/// and without this limit cloth would slide off a body during long ones.
const CREEP_TIME: f64 = 0.01;

/// Cloth, bodies, gravity and air as the system that the integrator moves.
#[derive(Debug)]
pub(crate) struct World {
    pub(crate) cloth: Cloth,
    pub(crate) bonds: Bonds,
    pub(crate) state: State,
    pub(crate) contact: ParticleContact,
    /// The surfaces, if they are kept apart: the bodies are then among them and not in the contact of the particles.
    pub(crate) surfaces: Option<Surfaces>,
    /// Acceleration of gravity when it has grown to its value, in m/s².
    full_gravity: [f64; 3],
    /// The one at the end of the step.
    gravity: [f64; 3],
    /// When it begins to grow, in s: when the garment is sewn.
    grows_from: f64,
    /// How long it takes to grow, in s.
    ramp: f64,
    /// What draws the sides of the seams together, until they are one.
    stitches: Option<Stitches>,
    /// Whether the cloth goes to rest without inertia.
    pub(crate) creeps: bool,
    /// The cloth as it hangs when its seams are one, with the friction of its fabrics, and how they bend then.
    finished: Option<(Cloth, SeamBending)>,
    /// What takes a creeping cloth's momentum from it in the course of a step, in N.
    ///
    /// Its steps are to start from rest, but the velocity that it came with makes a good first guess.
    brake: Vec<f64>,
    pub(crate) held: Vec<bool>,
    pub(crate) pins: Vec<Pin>,
    /// What those that do not hold altogether pull by in this step.
    attachments: Attachments,
    /// The bodies that move: which, where it started, its way.
    moving: Vec<(usize, Pose, Track)>,
    /// When bodies and pins begin to move, in s: the time on which they lag.
    moves_from: f64,
    /// Half the air's density times the drag coefficient, in kg/m³; nothing slows a cloth that creeps.
    air: f64,
    /// Drag of each particle over the length of the step, in N/m along its normal.
    drag: Vec<f64>,
    /// Where the energy goes, if that is asked for; not while a garment is sewn.
    pub(crate) ledger: Option<Ledger>,
    /// Whether it is asked for.
    balances: bool,
}

impl World {
    pub(crate) fn new(scene: Scene) -> Result<Self, Error> {
        let contact = scene.particle_contact()?;
        let surfaces = scene.contact.surfaces.then(|| Surfaces::new(&scene)).transpose()?;
        let Scene {
            mut cloth,
            breen,
            positions,
            velocities,
            held,
            pins,
            bodies,
            gravity,
            air,
            sewing,
            ..
        } = scene;
        let moving = bodies.into_iter().enumerate();
        let moving = moving.filter_map(|(index, moving)| match moving.course {
            Some(Course::Rigid(track)) => Some((index, moving.body.pose, track)),
            // Its vertices move among the surfaces.
            Some(Course::Shapes(_)) | None => None,
        });
        let moving = moving.collect();
        let stitches = sewing.as_ref().map(|s| Stitches::new(&s.stitching, &positions, s.seconds));
        let finished =
            sewing.map(|sewing| (std::mem::replace(&mut cloth, sewing.cloth), sewing.bending));
        let mut state = cloth.state(positions).expect("a scene places every particle");
        state.velocities = velocities;
        let threads = stitches.as_ref().map_or_else(Vec::new, Stitches::pairs);
        let mut bonds = Bonds::new(&cloth, breen, (&threads, &state.positions));
        let drag = vec![0.0; cloth.particles()];
        let stored = bonds.stored(&cloth, &state);
        // The balance begins when the garment is sewn.
        let balanced = scene.energy && stitches.is_none();
        let ledger = balanced.then(|| Ledger::new(stored, cloth.particles()));
        let sewing = stitches.is_some();
        let mut world = Self {
            bonds,
            cloth,
            state,
            contact,
            surfaces,
            full_gravity: gravity,
            gravity,
            grows_from: 0.0,
            ramp: scene.clock.ramp,
            stitches,
            finished,
            brake: Vec::new(),
            creeps: false,
            held,
            pins,
            attachments: Attachments::default(),
            moving,
            moves_from: if scene.motion_seconds.is_some() { f64::INFINITY } else { 0.0 },
            air,
            drag,
            ledger,
            balances: scene.energy,
        };
        world.creep(sewing || scene.settle.is_some_and(|settle| !settle.inertia));
        let kinetic = world.kinetic();
        if let Some(ledger) = &mut world.ledger {
            ledger.start = kinetic;
        }
        Ok(world)
    }

    /// Whether the steps are to start from rest.
    pub(crate) fn creep(&mut self, creeps: bool) {
        self.creeps = creeps;
        self.brake.clear();
        self.brake.resize(if creeps { 3 * self.cloth.particles() } else { 0 }, 0.0);
    }

    /// Lets bodies and pins begin their ways at a time, in s, and the cloth keep its momentum.
    pub(crate) fn set_in_motion(&mut self, time: f64) {
        self.moves_from = time;
        self.pins.iter_mut().for_each(|pin| pin.reached(Until::Rest, time));
        self.state.velocities.fill(0.0);
        self.creep(false);
    }

    /// The time on the clock of bodies and pins.
    fn time_of_motion(&self, time: f64) -> f64 {
        (time - self.moves_from).max(0.0)
    }

    /// What draws the sides of the seams together, while they are not one.
    pub(crate) fn stitches(&self) -> Option<&Stitches> {
        self.stitches.as_ref()
    }

    /// Ends the sewing at a time, in s: from now on the nodes of seams are where they have been moved to, and stay together.
    pub(crate) fn sewn(&mut self, time: f64, positions: &[f64]) {
        self.stitches = None;
        self.grows_from = time;
        if let Some((cloth, bending)) = self.finished.take() {
            self.cloth = cloth;
            self.bonds.sew(&self.cloth, bending, positions);
        }
        let state = self.cloth.state(positions.to_vec());
        self.state = state.expect("a place for every particle");
        self.pins.iter_mut().for_each(|pin| pin.reached(Until::Sewn, time));
        if self.balances {
            let stored = self.bonds.stored(&self.cloth, &self.state);
            self.ledger = Some(Ledger::new(stored, self.cloth.particles()));
        }
    }

    /// Calls with the particle's way along its normal since the start of the step, for every
    /// particle that the air resists.
    fn each_drag(&self, positions: &[f64], mut visit: impl FnMut(usize, f64, [f64; 3])) {
        let normals = self.state.normals().chunks_exact(3);
        let moved = positions.chunks_exact(3).zip(self.state.positions.chunks_exact(3));
        for (particle, (normal, (now, start))) in normals.zip(moved).enumerate() {
            if self.drag[particle] > 0.0 {
                let normal = [normal[0], normal[1], normal[2]];
                let way = (0..3).map(|axis| (now[axis] - start[axis]) * normal[axis]).sum();
                visit(particle, way, normal);
            }
        }
    }

    /// What a step to given positions does with the energy outside the connectors. The next step is
    /// opened for the contact.
    fn entry(&mut self, positions: &[f64], dt: f64) -> Entry {
        let mut air = 0.0;
        self.each_drag(positions, |particle, way, _| air += self.drag[particle] * way * way);
        let gravity = self.weight_energy(positions) - self.weight_energy(&self.state.positions);
        let [hold, hold_potential] = self.attachments.work(&self.state.positions, positions);
        if let (Some(surfaces), Some(ledger)) = (&mut self.surfaces, &self.ledger) {
            let energy = surfaces.contact.potential(positions);
            let lost = surfaces.contact.friction_energy().dissipated;
            let moved = positions.iter().zip(&self.state.positions).map(|(end, start)| end - start);
            let brake = moved.zip(&self.brake).map(|(moved, brake)| -moved * brake).sum();
            return Entry {
                gravity,
                hold,
                hold_potential,
                contact: energy - lost - ledger.barrier + ledger.push,
                push: ledger.push,
                drive: surfaces.contact.body_work(positions),
                slip: lost,
                slip_potential: lost,
                air,
                brake,
                ..Entry::default()
            };
        }
        let Self { contact, ledger, state, .. } = self;
        let ledger = ledger.as_mut().expect("entries are made for a ledger");
        let [with, without] = &mut ledger.forces;
        let push = |contact: &mut ParticleContact, forces: &mut [f64]| {
            forces.fill(0.0);
            contact.add_forces(positions, forces);
            contact.potential(positions)
        };
        // A step just opened has no slip and so no friction.
        let potential = push(contact, with);
        let drive = contact.body_friction_work(positions);
        contact.begin(positions, dt);
        let barrier = push(contact, without);
        let moved = positions.iter().zip(&state.positions).map(|(end, start)| end - start);
        let frictions = without.iter().zip(&*with).map(|(without, with)| without - with);
        let slip: f64 = moved.zip(frictions).map(|(moved, friction)| moved * friction).sum();
        let moved = positions.iter().zip(&state.positions).map(|(end, start)| end - start);
        let brake = moved.zip(&self.brake).map(|(moved, brake)| -moved * brake).sum();
        Entry {
            gravity,
            hold,
            hold_potential,
            contact: barrier - ledger.barrier + ledger.push,
            push: ledger.push,
            drive,
            slip: slip + drive,
            slip_potential: potential - barrier - ledger.slip,
            air,
            brake,
            ..Entry::default()
        }
    }

    /// Opens a step for the contact of particles with bodies.
    fn begin_contact(&mut self, start: &[f64], (end_time, dt): (f64, f64)) {
        // A step that is tried again begins where the bodies were at its start.
        self.place_bodies(end_time - dt);
        self.contact.begin(start, if self.creeps { dt.min(CREEP_TIME) } else { dt });
        let rest = if self.ledger.is_some() { self.contact.potential(start) } else { 0.0 };
        self.place_bodies(end_time);
        if let Some(ledger) = &mut self.ledger {
            ledger.slip = self.contact.friction_potential(start);
            ledger.barrier = self.contact.potential(start) - ledger.slip;
            ledger.push = ledger.barrier - rest;
            ledger.connectors = None;
        }
    }

    fn place_bodies(&mut self, time: f64) {
        let time = self.time_of_motion(time);
        for (body, start, track) in &self.moving {
            let pose = track.pose(time, *start);
            self.contact.move_body(*body, pose).expect("a rigid motion turns a pose into a pose");
        }
    }

    /// Takes note of what the pins hold in a step that ends at a time, in s.
    fn hold(&mut self, end_time: f64) {
        if self.pins.iter().all(|pin| pin.release == f64::INFINITY) {
            return;
        }
        self.held.fill(false);
        for pin in self.pins.iter().filter(|pin| pin.is_whole() && pin.holds(end_time)) {
            pin.particles.iter().for_each(|&particle| self.held[particle] = true);
        }
    }

    /// When gravity and bodies have grown, and the last of the pins that let go has done so, in s.
    pub(crate) fn last_change(&self) -> f64 {
        let releases = self.pins.iter().map(|pin| pin.release);
        let grown = self.grows_from + self.ramp;
        let grown = self.surfaces.as_ref().map_or(grown, |surfaces| grown.max(surfaces.grown_at()));
        releases.filter(|release| release.is_finite()).fold(grown, f64::max)
    }

    /// Part of the distances that surfaces keep which they keep by now.
    pub(crate) fn grown(&self) -> f64 {
        self.surfaces.as_ref().map_or(1.0, |surfaces| surfaces.contact.growth_fraction())
    }

    /// What each pin bears at a time, in s, without the inertia of the particles it holds.
    pub(crate) fn pin_loads(&mut self, time: f64) -> Vec<PinLoad> {
        let positions = self.state.positions.clone();
        // What stands in for inertia counts as little as inertia itself.
        self.brake.fill(0.0);
        let mut forces = vec![0.0; positions.len()];
        self.forces(&positions, &mut forces);
        let now = self.time_of_motion(time);
        let load = |pin: &Pin| match (pin.holds(time), pin.is_whole()) {
            (true, true) => PinLoad::of(pin, &positions, &forces),
            (true, false) => {
                PinLoad::of(pin, &positions, &Attachments::of(pin, now).pulls(&positions))
            }
            (false, _) => PinLoad::default(),
        };
        self.pins.iter().map(load).collect()
    }

    pub(crate) fn kinetic(&self) -> f64 {
        let square = |v: &[f64]| v.iter().map(|c| c * c).sum::<f64>();
        let speeds = self.state.velocities.chunks_exact(3).map(square);
        self.cloth.masses().iter().zip(speeds).map(|(mass, square)| 0.5 * mass * square).sum()
    }

    /// Potential energy in the field of gravity, 0 at the origin, in J.
    pub(crate) fn weight_energy(&self, positions: &[f64]) -> f64 {
        let height = |x: &[f64]| -> f64 { x.iter().zip(self.gravity).map(|(x, g)| -x * g).sum() };
        let heights = positions.chunks_exact(3).map(height);
        self.cloth.masses().iter().zip(heights).map(|(mass, height)| mass * height).sum()
    }
}
