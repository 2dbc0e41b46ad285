//! Detection of the particles within the activation distance of a body.
//!
//! A distance changes by at most the displacement of the particle. A particle far from a body is
//! therefore checked again only after it has moved far enough.

use crate::body::{DistanceBound, SignedDistance, Solid};
use crate::vector::{Vector, at, norm, subtract};

/// Number of particles in a chunk, which one thread handles at a time.
///
/// The number is constant, so no result depends on the number of threads. Some hundred queries of a
/// mesh take a fraction of a millisecond, far longer than passing them to another thread.
pub(super) const CHUNK: usize = 256;

/// Relative rounding error that is subtracted from a known distance.
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
pub(crate) struct NearestBody {
    pub(crate) distance: f64,
    pub(crate) particle: usize,
    pub(crate) body: usize,
}

/// Lower bound of a particle's distance from a body, at an earlier position of the particle.
///
/// The bound is dropped when the body moves.
#[derive(Debug, Clone, Copy)]
struct KnownDistance {
    position: Vector,
    distance: f64,
}

impl KnownDistance {
    const NONE: KnownDistance = KnownDistance { position: [0.0; 3], distance: f64::NEG_INFINITY };

    /// Returns a lower bound of the distance at `point`, in m.
    fn bound(&self, point: Vector) -> f64 {
        self.distance * (1.0 - ROUNDING) - norm(subtract(point, self.position)) * (1.0 + ROUNDING)
    }
}

/// Consecutive particles with their known distances, and the active ones among them.
#[derive(Debug, Clone)]
pub(crate) struct ParticleChunk {
    first: usize,
    /// Known distances for each particle and body, particle by particle.
    known: Vec<KnownDistance>,
    /// Active particles, sorted by particle and body.
    pub(crate) active: Vec<ActiveParticle>,
}

impl ParticleChunk {
    /// Returns chunks that cover numbers of `particles` and `bodies`.
    pub(crate) fn cover(particles: usize, bodies: usize) -> Vec<ParticleChunk> {
        let firsts = (0..particles).step_by(CHUNK);
        firsts
            .map(|first| ParticleChunk {
                first,
                known: vec![KnownDistance::NONE; CHUNK.min(particles - first) * bodies],
                active: Vec::new(),
            })
            .collect()
    }

    /// Drops the known distances of `body`, which moved. `body_count` is the number of all bodies.
    pub(crate) fn forget(&mut self, body: usize, body_count: usize) {
        let known = self.known.iter_mut().skip(body).step_by(body_count);
        known.for_each(|known| *known = KnownDistance::NONE);
    }

    /// Detects the particles that are nearer than `activation_distance`, in m, to one of `solids`.
    pub(crate) fn detect(&mut self, solids: &[Solid], activation_distance: f64, positions: &[f64]) {
        self.active.clear();
        for (k, known) in self.known.chunks_mut(solids.len().max(1)).enumerate() {
            let particle = self.first + k;
            let point = at(positions, particle);
            for (body, (solid, known)) in solids.iter().zip(known).enumerate() {
                // The bound of a point of NaN is NaN, so the distance is evaluated.
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

    /// Returns the particle with the smallest distance if it is below `nearest`, else `nearest`.
    pub(crate) fn nearest(
        &self,
        solids: &[Solid],
        positions: &[f64],
        mut nearest: Option<NearestBody>,
    ) -> Option<NearestBody> {
        for (k, known) in self.known.chunks(solids.len().max(1)).enumerate() {
            let particle = self.first + k;
            let point = at(positions, particle);
            for (body, (solid, known)) in solids.iter().zip(known).enumerate() {
                let limit = nearest.map_or(f64::INFINITY, |nearest| nearest.distance);
                if known.bound(point) < limit {
                    let distance = solid.signed_distance(point).distance;
                    if distance < limit {
                        nearest = Some(NearestBody { distance, particle, body });
                    }
                }
            }
        }
        nearest
    }
}
