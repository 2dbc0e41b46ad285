//! Contact of particles: the object that a solver holds.

use super::detection::{ActiveParticle, NearestBody, ParticleChunk};
use super::friction::Friction;
use super::settings::ParticleSettings;
use super::summary::{ParticleSummary, touching_particle_count};
use crate::barrier::Barrier;
use crate::body::{Body, BodyFrame, Pose, SignedDistance, Solid};
use crate::error::{Error, check, check_index, check_length};
use crate::threads::*;
use crate::vector::{Vector, at, combine, dot, outer};

/// Contact of cloth particles with rigid bodies: potential, forces and stiffness.
///
/// Each pair of a particle `$i$` and a body within the activation distance adds the energy
/// `$k_A A_i b(d)$`, with the lumped area `$A_i$` of the particle, its distance `$d$` and the
/// two-stage barrier `$b$`, and the friction of the step that [`begin`](ParticleContact::begin)
/// opened. The forces are exactly the negative gradient of
/// [`potential`](ParticleContact::potential).
///
/// Only particles are tested. A triangle or a yarn between two particles can cut through a convex
/// edge of a body by about the square of its length over eight radii of the edge.
///
/// A position that is not finite gives NaN for its force, its stiffness and the potential. A solver
/// therefore cannot take it for a position away from bodies.
///
/// After the first step, only [`summary`](ParticleContact::summary) allocates memory.
#[derive(Debug, Clone)]
pub struct ParticleContact {
    bodies: Vec<Body>,
    solids: Vec<Solid>,
    settings: ParticleSettings,
    areas: Vec<f64>,
    has_mesh: bool,
    chunks: Vec<ParticleChunk>,
    /// Positions at which the active particles of the chunks were detected, in m.
    detected_at: Vec<f64>,
    frictions: Vec<Friction>,
    /// Slip `$\epsilon$` below which a particle sticks in the open step, in m.
    sticking_slip: f64,
}

impl ParticleContact {
    /// Returns the contact of particles with `bodies`. `areas` holds the lumped area of each
    /// particle, in m².
    ///
    /// # Errors
    /// A body, a setting or an area is out of range.
    pub fn new(
        bodies: Vec<Body>,
        settings: ParticleSettings,
        areas: Vec<f64>,
    ) -> Result<ParticleContact, Error> {
        settings.check()?;
        if let Some(particle) = areas.iter().position(|area| !area.is_finite() || *area < 0.0) {
            return Err(Error::InvalidArea { particle, area: areas[particle] });
        }

        let solids = bodies.iter().map(Body::solid).collect::<Result<Vec<_>, _>>()?;
        Ok(ParticleContact {
            has_mesh: solids.iter().any(Solid::is_mesh),
            chunks: ParticleChunk::cover(areas.len(), bodies.len()),
            detected_at: Vec::new(),
            frictions: Vec::new(),
            sticking_slip: f64::NAN,
            bodies,
            solids,
            settings,
            areas,
        })
    }

    /// Returns the bodies, in the order in which [`new`](ParticleContact::new) took them.
    #[must_use]
    pub fn bodies(&self) -> &[Body] {
        &self.bodies
    }

    /// Returns the settings.
    #[must_use]
    pub fn settings(&self) -> &ParticleSettings {
        &self.settings
    }

    /// Opens a step of `dt` seconds. Friction takes its normal forces and tangent planes from the
    /// positions `start`, in m, and slip is measured from there.
    ///
    /// A particle that comes into contact during the step has no friction until the next step.
    /// Without an open step, contact is frictionless.
    ///
    /// # Errors
    ///
    /// There are not three coordinates for each particle, as for all methods that take positions;
    /// or `dt` is not finite.
    pub fn begin(&mut self, start: &[f64], dt: f64) -> Result<(), Error> {
        check("the length of a step (s)", dt, "finite", true)?;
        self.detect(start)?;
        self.sticking_slip = if dt > 0.0 { self.settings.slip_speed * dt } else { f64::NAN };
        // The list is taken out while `self` is read, and keeps its memory.
        let mut frictions = std::mem::take(&mut self.frictions);
        frictions.clear();
        for active in self.active() {
            let coefficient = self.solids[active.body].friction;
            if coefficient != 0.0 {
                let pressure = self.settings.pressure(active.signed.distance);
                frictions.push(Friction {
                    particle: active.particle,
                    body: active.body,
                    start: at(start, active.particle),
                    carried: [0.0; 3],
                    normal: active.signed.normal,
                    limit: coefficient * pressure * self.areas[active.particle],
                });
            }
        }
        self.frictions = frictions;
        Ok(())
    }

    /// Moves `body` to `pose` within the open step. Friction resists the slip of the cloth over the
    /// body.
    ///
    /// # Errors
    /// There is no such body, or the pose is out of range. Then the body stays where it is.
    pub fn move_body(&mut self, body: usize, pose: Pose) -> Result<(), Error> {
        check_index("body", body, self.bodies.len())?;
        if self.bodies[body].pose == pose {
            return Ok(());
        }
        let frame = BodyFrame::new(&pose, &self.bodies[body].name)?;
        self.bodies[body].pose = pose;
        let before = std::mem::replace(&mut self.solids[body].frame, frame);
        let frame = &self.solids[body].frame;
        for friction in self.frictions.iter_mut().filter(|friction| friction.body == body) {
            friction.carry(&before, frame);
        }
        self.chunks.iter_mut().for_each(|chunk| chunk.forget(body, self.bodies.len()));
        self.detected_at.clear();
        Ok(())
    }

    /// Returns the work of friction that the moved bodies did on the cloth at `positions` in the
    /// open step, in J.
    ///
    /// # Errors
    ///
    /// There are not three coordinates for each particle.
    pub fn body_friction_work(&self, positions: &[f64]) -> Result<f64, Error> {
        self.check_coordinates("positions", positions)?;
        let works = self.frictions.iter().map(|friction| {
            let force = friction.force(at(positions, friction.particle), self.sticking_slip);
            dot(force, friction.carried)
        });
        Ok(works.sum())
    }

    /// Adds the contact and friction forces at `positions`, in N, to `forces`.
    ///
    /// # Errors
    ///
    /// There are not three coordinates or three forces for each particle.
    pub fn add_forces(&mut self, positions: &[f64], forces: &mut [f64]) -> Result<(), Error> {
        self.check_coordinates("forces", forces)?;
        self.detect(positions)?;
        self.for_each_force(positions, &mut |particle, _, force| {
            for (k, value) in force.iter().enumerate() {
                forces[3 * particle + k] += value;
            }
        });
        Ok(())
    }

    /// Returns the energy of contact at `positions` plus the friction potential of the step, in J.
    ///
    /// # Errors
    ///
    /// There are not three coordinates for each particle.
    pub fn potential(&mut self, positions: &[f64]) -> Result<f64, Error> {
        self.detect(positions)?;
        let barrier = Barrier::new(self.settings.activation_distance);
        let contact: f64 = self
            .active()
            .map(|active| self.areas[active.particle] * barrier.energy(active.signed.distance))
            .sum();
        Ok(self.settings.stiffness * contact + self.friction_potential(positions)?)
    }

    /// Returns the friction part of [`potential`](ParticleContact::potential), in J.
    ///
    /// # Errors
    ///
    /// There are not three coordinates for each particle.
    pub fn friction_potential(&self, positions: &[f64]) -> Result<f64, Error> {
        self.check_coordinates("positions", positions)?;
        let frictions = self.frictions.iter();
        Ok(frictions.map(|f| f.energy(at(positions, f.particle), self.sticking_slip)).sum())
    }

    /// Calls `add` with the particle and the block `$-\partial f_i / \partial x_i$`, row by row, in
    /// N/m.
    ///
    /// A particle's contact depends on its position only, so there are no blocks between particles.
    /// A particle may have several blocks, which add up. With `definite`, the curvature of
    /// surfaces, which softens, is left out and no block has a negative eigenvalue.
    ///
    /// # Errors
    ///
    /// There are not three coordinates for each particle.
    pub fn add_stiffness(
        &mut self,
        positions: &[f64],
        definite: bool,
        add: &mut dyn FnMut(usize, [f64; 9]),
    ) -> Result<(), Error> {
        self.detect(positions)?;
        let barrier = Barrier::new(self.settings.activation_distance);
        for active in self.active() {
            let SignedDistance { distance, normal, curvature } = &active.signed;
            let scale = self.settings.stiffness * self.areas[active.particle];
            let bend = if definite { 0.0 } else { barrier.slope(*distance) };
            let push = barrier.curvature(*distance);
            let block = combine(&outer(*normal), scale * push, curvature, scale * bend);
            add(active.particle, block);
        }
        for friction in &self.frictions {
            let position = at(positions, friction.particle);
            add(friction.particle, friction.stiffness(position, self.sticking_slip));
        }
        Ok(())
    }

    /// Returns counts, distances and loads at `positions`.
    ///
    /// # Errors
    ///
    /// There are not three coordinates for each particle.
    pub fn summary(&self, positions: &[f64]) -> Result<ParticleSummary, Error> {
        let mut current = self.clone();
        current.detect(positions)?;
        let nearest = || current.nearest(positions);
        let bodies = current.bodies.len();
        let mut summary = ParticleSummary::new(current.active(), nearest, positions, bodies);
        current.for_each_force(positions, &mut |_, body, force| {
            for (load, value) in summary.loads[body].iter_mut().zip(force) {
                *load -= value;
            }
        });
        Ok(summary)
    }

    /// Returns the number of particles within the activation distance of at least one body, like
    /// [`summary`](ParticleContact::summary), without allocating memory.
    ///
    /// # Errors
    ///
    /// There are not three coordinates for each particle.
    pub fn touching_particle_count(&mut self, positions: &[f64]) -> Result<usize, Error> {
        self.detect(positions)?;
        Ok(touching_particle_count(self.active()))
    }

    /// Checks that `list` has three numbers of `what` for each particle.
    fn check_coordinates(&self, what: &'static str, list: &[f64]) -> Result<(), Error> {
        check_length(what, list.len(), 3 * self.areas.len())
    }

    /// Calls `visit` with particle, body and force, in N, of every contact. The active particles
    /// must have been detected at `positions`.
    fn for_each_force(&self, positions: &[f64], visit: &mut dyn FnMut(usize, usize, Vector)) {
        for active in self.active() {
            let size = self.areas[active.particle] * self.settings.pressure(active.signed.distance);
            let force = active.signed.normal.map(|n| n * size);
            visit(active.particle, active.body, force);
        }
        for friction in &self.frictions {
            let force = friction.force(at(positions, friction.particle), self.sticking_slip);
            visit(friction.particle, friction.body, force);
        }
    }

    /// Detects all particles within the activation distance of a body at `positions`.
    fn detect(&mut self, positions: &[f64]) -> Result<(), Error> {
        self.check_coordinates("positions", positions)?;
        // Force, potential and stiffness are mostly evaluated at equal positions. NaN is never
        // equal, so positions of NaN are detected each time.
        if self.detected_at == positions {
            return Ok(());
        }
        self.detected_at.clear();
        self.detected_at.extend_from_slice(positions);

        let (solids, activation_distance) = (&self.solids, self.settings.activation_distance);
        if self.has_mesh {
            let chunks = self.chunks.par_iter_mut();
            chunks.for_each(|chunk| chunk.detect(solids, activation_distance, positions));
        } else {
            // A primitive takes some nanoseconds, less than another thread needs to wake up.
            let chunks = self.chunks.iter_mut();
            chunks.for_each(|chunk| chunk.detect(solids, activation_distance, positions));
        }
        Ok(())
    }

    /// Returns each [`ActiveParticle`], sorted by particle and body.
    fn active(&self) -> impl Iterator<Item = &ActiveParticle> {
        self.chunks.iter().flat_map(|chunk| &chunk.active)
    }

    /// Returns the smallest signed distance of a particle at `positions` from a body.
    fn nearest(&self, positions: &[f64]) -> Option<NearestBody> {
        let chunks = self.chunks.iter();
        chunks.fold(None, |nearest, chunk| chunk.nearest(&self.solids, positions, nearest))
    }
}
