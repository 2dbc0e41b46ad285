use crate::body::{Reach, Solid};
use crate::proximity::SignedDistance;
use crate::vector::{Vector, at, norm, subtract};

/// Particles that one thread looks after at a time.
///
/// A constant, so that no result depends on the number of threads. Some hundred queries of a mesh
/// take a fraction of a millisecond, well above the cost of handing them over.
pub(crate) const CHUNK: usize = 256;

/// Guard of a known distance against rounding, as a share of it.
const ROUNDING: f64 = 1e-9;

/// A particle within the offset of a body.
#[derive(Debug, Clone)]
pub(crate) struct Touch {
    pub(crate) particle: usize,
    pub(crate) body: usize,
    pub(crate) proximity: SignedDistance,
}

/// What is known of one particle and one body: a place and the distance from the body there.
///
/// A distance changes by no more than the way gone, so the pair needs no query while the particle
/// stays near that place. A body that moves voids this.
#[derive(Debug, Clone, Copy)]
struct Known {
    place: Vector,
    distance: f64,
}

impl Known {
    const NOTHING: Known = Known { place: [0.0; 3], distance: f64::NEG_INFINITY };

    /// Lower bound of the distance at a point, in m.
    fn bound(&self, point: Vector) -> f64 {
        self.distance * (1.0 - ROUNDING) - norm(subtract(point, self.place)) * (1.0 + ROUNDING)
    }
}

/// A run of particles with all that is known of them.
#[derive(Debug, Clone)]
pub(crate) struct Chunk {
    first: usize,
    /// Per particle and body.
    known: Vec<Known>,
    /// Sorted by particle and body.
    pub(crate) touches: Vec<Touch>,
}

impl Chunk {
    /// Chunks for a number of particles and of bodies.
    pub(crate) fn cover(particles: usize, bodies: usize) -> Vec<Chunk> {
        let firsts = (0..particles).step_by(CHUNK);
        firsts
            .map(|first| Chunk {
                first,
                known: vec![Known::NOTHING; CHUNK.min(particles - first) * bodies],
                touches: Vec::new(),
            })
            .collect()
    }

    /// Forgets what is known of one of so many bodies, because it moved.
    pub(crate) fn forget(&mut self, body: usize, bodies: usize) {
        self.known.iter_mut().skip(body).step_by(bodies).for_each(|k| *k = Known::NOTHING);
    }

    /// Finds the particles nearer than `activation_distance` to a solid.
    pub(crate) fn scan(&mut self, solids: &[Solid], activation_distance: f64, positions: &[f64]) {
        self.touches.clear();
        for (k, known) in self.known.chunks_mut(solids.len().max(1)).enumerate() {
            let particle = self.first + k;
            let point = at(positions, particle);
            for (body, (solid, known)) in solids.iter().zip(known).enumerate() {
                // A point of NaN has no bound, and so is asked for.
                if known.bound(point) >= activation_distance {
                    continue;
                }
                match solid.distance_within(point, activation_distance) {
                    Reach::Clear(distance) => {
                        *known = Known { place: point, distance };
                    }
                    Reach::Near(proximity) => {
                        self.touches.push(Touch { particle, body, proximity })
                    }
                }
            }
        }
    }

    /// The smallest distance, its particle and its body, if smaller than the one at hand.
    pub(crate) fn nearest(
        &self,
        solids: &[Solid],
        positions: &[f64],
        mut best: Option<(f64, usize, usize)>,
    ) -> Option<(f64, usize, usize)> {
        for (k, known) in self.known.chunks(solids.len().max(1)).enumerate() {
            let particle = self.first + k;
            let point = at(positions, particle);
            for (body, (solid, known)) in solids.iter().zip(known).enumerate() {
                let limit = best.map_or(f64::INFINITY, |(distance, ..)| distance);
                if known.bound(point) < limit {
                    let distance = solid.signed_distance(point).distance;
                    if distance < limit {
                        best = Some((distance, particle, body));
                    }
                }
            }
        }
        best
    }
}
