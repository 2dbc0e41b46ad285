use crate::barrier::Barrier;
use crate::body::{Body, Solid};
use crate::detect::{Chunk, Touch};
use crate::error::{Error, check};
use crate::friction::Friction;
use crate::pose::Pose;
use crate::proximity::SignedDistance;
use crate::vector::{Vector, at, combine, dot, outer};
use rayon::prelude::*;

/// How stiff contact is and where it begins.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ParticleSettings {
    /// Distance `$r$` from a body at which contact begins, in m.
    ///
    /// The middle surface of the cloth rests just inside it: half the cloth's thickness plus what
    /// the picture or the spacing of the particles asks for. Default 1 mm.
    pub activation_distance: f64,
    /// ParticleContact stiffness `$k_A$` per area of cloth, in N/m³.
    ///
    /// The contact pressure is `$-k_A b'(g)$`: `$k_A r/2$` at half the offset, `$2.5\,k_A r$` at a
    /// tenth of it, `$5\,k_A r$` at the surface itself. The default 2·10⁶ N/m³ with the default
    /// offset carries 5 kPa, the pressure of a KES compression test (50 gf/cm²), when a tenth of
    /// the gap is left, and a cloth of 100 g/m² at rest sinks in by 0.5 µm. Higher keeps heavier
    /// loads out; the solver then works harder at each touch.
    pub stiffness: f64,
    /// Speed `$\epsilon_v$` below which a touching particle counts as sticking, in m/s.
    ///
    /// Friction reaches Coulomb's limit at this speed, so a held load creeps at up to it. Smaller
    /// creeps less and makes the step harder to solve. Default 1 mm/s.
    pub slip_speed: f64,
}

impl Default for ParticleSettings {
    fn default() -> ParticleSettings {
        ParticleSettings { activation_distance: 1e-3, stiffness: 2e6, slip_speed: 1e-3 }
    }
}

impl ParticleSettings {
    /// ParticleContact pressure at a distance from a body, in Pa.
    pub fn pressure(&self, distance: f64) -> f64 {
        -self.stiffness * Barrier::new(self.activation_distance).slope(distance)
    }

    fn check(&self) -> Result<(), Error> {
        let positive = |what: &str, value: f64| check(what, value, "above 0", value > 0.0);
        positive("the contact offset (m)", self.activation_distance)?;
        positive("the contact stiffness (N/m³)", self.stiffness)?;
        positive("the slip speed (m/s)", self.slip_speed)
    }
}

/// ParticleContact of cloth particles with rigid bodies: forces, their potential and their derivative.
///
/// Each pair of a particle `$i$` and a body within the offset adds the energy
/// `$k_A A_i b(d)$`, with the lumped area `$A_i$` of the particle, its distance `$d$` and the
/// two-stage barrier `$b$`, and the friction of the step that [`begin`](ParticleContact::begin) opened.
/// The forces are exactly the negative gradient of [`potential`](ParticleContact::potential).
///
/// Only particles are tested: a triangle or a yarn between two particles can cut through a convex
/// edge of a body by about its length squared over eight radii of the edge.
///
/// A position that is not finite gives NaN for its force, its stiffness and the potential, so that
/// no solver can take it for a place out of activation_distance.
#[derive(Debug, Clone)]
pub struct ParticleContact {
    bodies: Vec<Body>,
    solids: Vec<Solid>,
    settings: ParticleSettings,
    areas: Vec<f64>,
    has_mesh: bool,
    chunks: Vec<Chunk>,
    /// Positions that the touches of the chunks belong to.
    seen: Vec<f64>,
    frictions: Vec<Friction>,
    /// Slip below which a contact sticks in this step, in m.
    stick: f64,
}

impl ParticleContact {
    /// ParticleContact of as many particles as there are lumped areas, in m².
    pub fn new(
        bodies: Vec<Body>,
        settings: ParticleSettings,
        areas: Vec<f64>,
    ) -> Result<ParticleContact, Error> {
        settings.check()?;
        let bad = |(_, area): &(usize, &f64)| !area.is_finite() || **area < 0.0;
        if let Some((particle, &area)) = areas.iter().enumerate().find(bad) {
            return Err(Error::InvalidArea { particle, area });
        }
        let solids = bodies.iter().map(Solid::new).collect::<Result<Vec<_>, _>>()?;
        Ok(ParticleContact {
            has_mesh: solids.iter().any(Solid::is_mesh),
            chunks: Chunk::cover(areas.len(), bodies.len()),
            seen: Vec::new(),
            frictions: Vec::new(),
            stick: f64::NAN,
            bodies,
            solids,
            settings,
            areas,
        })
    }

    /// The bodies, in the order in which they were given.
    pub fn bodies(&self) -> &[Body] {
        &self.bodies
    }

    /// The settings.
    pub fn settings(&self) -> &ParticleSettings {
        &self.settings
    }

    /// Opens a step of `dt` seconds: friction takes its normal forces and planes from the start
    /// positions, and slip is counted from there.
    ///
    /// A particle that comes into contact during the step feels no friction until the next.
    /// Without a step opened, contact is frictionless.
    ///
    /// # Panics
    ///
    /// Like all methods that take positions, if there are not three coordinates per particle.
    pub fn begin(&mut self, start: &[f64], dt: f64) {
        self.detect(start);
        self.stick = if dt > 0.0 { self.settings.slip_speed * dt } else { f64::NAN };
        let mut frictions = std::mem::take(&mut self.frictions);
        frictions.clear();
        for touch in self.touches() {
            let coefficient = self.solids[touch.body].friction;
            if coefficient != 0.0 {
                let pressure = self.settings.pressure(touch.proximity.distance);
                frictions.push(Friction {
                    particle: touch.particle,
                    body: touch.body,
                    start: at(start, touch.particle),
                    carried: [0.0; 3],
                    normal: touch.proximity.normal,
                    limit: coefficient * pressure * self.areas[touch.particle],
                });
            }
        }
        self.frictions = frictions;
    }

    /// Moves a body within the open step: friction resists the way of the cloth over the body.
    ///
    /// # Errors
    /// A pose that is none.
    pub fn move_body(&mut self, body: usize, pose: Pose) -> Result<(), Error> {
        if self.bodies[body].pose == pose {
            return Ok(());
        }
        self.bodies[body].pose = pose;
        let frame = self.bodies[body].check()?;
        let before = std::mem::replace(&mut self.solids[body].frame, frame);
        let frame = &self.solids[body].frame;
        for friction in self.frictions.iter_mut().filter(|friction| friction.body == body) {
            friction.carry(&before, frame);
        }
        self.chunks.iter_mut().for_each(|chunk| chunk.forget(body, self.bodies.len()));
        self.seen.clear();
        Ok(())
    }

    /// Work that the bodies have done by friction on the cloth in the open step, in J.
    pub fn body_friction_work(&self, positions: &[f64]) -> f64 {
        let works = self.frictions.iter().map(|friction| {
            let force = friction.force(at(positions, friction.particle), self.stick);
            dot(force, friction.carried)
        });
        works.sum()
    }

    /// Adds the contact and friction forces, in N.
    pub fn add_forces(&mut self, positions: &[f64], forces: &mut [f64]) {
        self.detect(positions);
        self.each_force(positions, &mut |particle, _, force| {
            for (k, value) in force.iter().enumerate() {
                forces[3 * particle + k] += value;
            }
        });
    }

    /// Energy of contact plus the friction potential of the step, in J.
    pub fn potential(&mut self, positions: &[f64]) -> f64 {
        self.detect(positions);
        let barrier = Barrier::new(self.settings.activation_distance);
        let contact: f64 = self
            .touches()
            .map(|touch| self.areas[touch.particle] * barrier.energy(touch.proximity.distance))
            .sum();
        self.settings.stiffness * contact + self.friction_potential(positions)
    }

    /// The part of the step's friction in [`potential`](ParticleContact::potential), in J.
    pub fn friction_potential(&self, positions: &[f64]) -> f64 {
        self.frictions.iter().map(|f| f.energy(at(positions, f.particle), self.stick)).sum()
    }

    /// Hands over the blocks `$-\partial f_i / \partial x_i$`, row by row, in N/m.
    ///
    /// There are no others: a particle's contact depends on its own position only. A particle may
    /// get several blocks, which add up. With `definite` the part of the curved surfaces, which
    /// softens, is left out and no block has a negative eigenvalue.
    pub fn add_stiffness(
        &mut self,
        positions: &[f64],
        definite: bool,
        add: &mut dyn FnMut(usize, [f64; 9]),
    ) {
        self.detect(positions);
        let barrier = Barrier::new(self.settings.activation_distance);
        for touch in self.touches() {
            let SignedDistance { distance, normal, curvature } = &touch.proximity;
            let scale = self.settings.stiffness * self.areas[touch.particle];
            let bend = if definite { 0.0 } else { barrier.slope(*distance) };
            let push = barrier.curvature(*distance);
            let block = combine(&outer(*normal), scale * push, curvature, scale * bend);
            add(touch.particle, block);
        }
        for friction in &self.frictions {
            let position = at(positions, friction.particle);
            add(friction.particle, friction.stiffness(position, self.stick));
        }
    }

    /// Every force as particle, body, force; the touches must be those of the positions.
    pub(crate) fn each_force(
        &self,
        positions: &[f64],
        visit: &mut dyn FnMut(usize, usize, Vector),
    ) {
        for touch in self.touches() {
            let size =
                self.areas[touch.particle] * self.settings.pressure(touch.proximity.distance);
            let force = touch.proximity.normal.map(|n| n * size);
            visit(touch.particle, touch.body, force);
        }
        for friction in &self.frictions {
            let force = friction.force(at(positions, friction.particle), self.stick);
            visit(friction.particle, friction.body, force);
        }
    }

    /// Finds all particles within the offset of a body.
    pub(crate) fn detect(&mut self, positions: &[f64]) {
        assert_eq!(
            positions.len(),
            3 * self.areas.len(),
            "contact needs three coordinates for each particle"
        );
        // Force, potential and stiffness are mostly asked for at the same place. NaN is never
        // equal, and so never taken from here.
        if self.seen == positions {
            return;
        }
        self.seen.clear();
        self.seen.extend_from_slice(positions);
        let (solids, activation_distance) = (&self.solids, self.settings.activation_distance);
        if self.has_mesh {
            let chunks = self.chunks.par_iter_mut();
            chunks.for_each(|chunk| chunk.scan(solids, activation_distance, positions));
        } else {
            // A primitive takes some nanoseconds, less than another thread needs to wake up.
            let chunks = self.chunks.iter_mut();
            chunks.for_each(|chunk| chunk.scan(solids, activation_distance, positions));
        }
    }

    /// All touches, sorted by particle and body.
    pub(crate) fn touches(&self) -> impl Iterator<Item = &Touch> {
        self.chunks.iter().flat_map(|chunk| &chunk.touches)
    }

    /// The smallest distance of all, its particle and its body.
    pub(crate) fn nearest(&self, positions: &[f64]) -> Option<(f64, usize, usize)> {
        let chunks = self.chunks.iter();
        chunks.fold(None, |best, chunk| chunk.nearest(&self.solids, positions, best))
    }
}
