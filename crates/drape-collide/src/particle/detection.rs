//! Detection of the particles within the activation distance of a body.
//!
//! A distance changes by no more than the particle moves, so a particle that was far from a body is
//! not looked at again until it has moved far enough.

use crate::body::{DistanceBound, SignedDistance, Solid};
use crate::vector::{Vector, at, norm, subtract};

/// Number of particles of a chunk, for one thread at a time.
///
/// It is constant, so that no result depends on the number of threads. Some hundred queries of a
/// mesh take a fraction of a millisecond, far more than passing them to another thread.
pub(super) const CHUNK: usize = 256;

/// Relative rounding that is taken off a known distance.
const ROUNDING: f64 = 1e-9;

/// Particle within the activation distance of a body.
#[derive(Debug, Clone)]
pub(crate) struct ActiveParticle {
    pub(crate) particle: usize,
    pub(crate) body: usize,
    pub(crate) signed: SignedDistance,
}

/// Signed distance of a particle from a body, in m.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Nearest {
    pub(crate) distance: f64,
    pub(crate) particle: usize,
    pub(crate) body: usize,
}

/// Lower bound of the distance of a particle from a body at an earlier position.
///
/// A body that moves voids it.
#[derive(Debug, Clone, Copy)]
struct KnownDistance {
    position: Vector,
    distance: f64,
}

impl KnownDistance {
    const NONE: KnownDistance = KnownDistance { position: [0.0; 3], distance: f64::NEG_INFINITY };

    /// Returns a lower bound of the distance at a point, in m.
    fn bound(&self, point: Vector) -> f64 {
        self.distance * (1.0 - ROUNDING) - norm(subtract(point, self.position)) * (1.0 + ROUNDING)
    }
}

/// Consecutive particles with their known distances and those that are active.
#[derive(Debug, Clone)]
pub(crate) struct Chunk {
    first: usize,
    /// For each particle and body.
    known: Vec<KnownDistance>,
    /// Sorted by particle and body.
    pub(crate) active: Vec<ActiveParticle>,
}

impl Chunk {
    /// Chunks for numbers of particles and of bodies.
    pub(crate) fn cover(particles: usize, bodies: usize) -> Vec<Chunk> {
        let firsts = (0..particles).step_by(CHUNK);
        firsts
            .map(|first| Chunk {
                first,
                known: vec![KnownDistance::NONE; CHUNK.min(particles - first) * bodies],
                active: Vec::new(),
            })
            .collect()
    }

    /// Drops the known distances of one of so many bodies, because it moved.
    pub(crate) fn forget(&mut self, body: usize, bodies: usize) {
        let known = self.known.iter_mut().skip(body).step_by(bodies);
        known.for_each(|known| *known = KnownDistance::NONE);
    }

    /// Finds the particles nearer than the activation distance to a solid.
    pub(crate) fn detect(&mut self, solids: &[Solid], activation_distance: f64, positions: &[f64]) {
        self.active.clear();
        for (k, known) in self.known.chunks_mut(solids.len().max(1)).enumerate() {
            let particle = self.first + k;
            let point = at(positions, particle);
            for (body, (solid, known)) in solids.iter().zip(known).enumerate() {
                // The bound of a point of NaN is NaN, so its distance is asked for.
                if known.bound(point) >= activation_distance {
                    continue;
                }
                match solid.distance_within(point, activation_distance) {
                    DistanceBound::AtLeast(distance) => {
                        *known = KnownDistance { position: point, distance };
                    }
                    DistanceBound::Active(signed) => {
                        self.active.push(ActiveParticle { particle, body, signed });
                    }
                }
            }
        }
    }

    /// Returns the particle with the smallest distance, if it is smaller than that at hand.
    pub(crate) fn nearest(
        &self,
        solids: &[Solid],
        positions: &[f64],
        mut nearest: Option<Nearest>,
    ) -> Option<Nearest> {
        for (k, known) in self.known.chunks(solids.len().max(1)).enumerate() {
            let particle = self.first + k;
            let point = at(positions, particle);
            for (body, (solid, known)) in solids.iter().zip(known).enumerate() {
                let limit = nearest.map_or(f64::INFINITY, |nearest| nearest.distance);
                if known.bound(point) < limit {
                    let distance = solid.signed_distance(point).distance;
                    if distance < limit {
                        nearest = Some(Nearest { distance, particle, body });
                    }
                }
            }
        }
        nearest
    }
}
