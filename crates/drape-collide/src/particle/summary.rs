//! Counts, distances and loads of the contact of particles.

use super::detection::{ActiveParticle, Nearest};

/// Counts, distances and loads of particles in contact with bodies.
#[derive(Debug, Clone, PartialEq)]
pub struct ParticleSummary {
    /// Number of particles within the activation distance of at least one body.
    pub touching: usize,
    /// Number of particles inside at least one body.
    pub inside: usize,
    /// Number of particles whose position is not finite; they count in nothing else.
    pub invalid: usize,
    /// Smallest signed distance of a particle from a body, in m; infinite if there is none.
    pub min_distance: f64,
    /// Particle and body of the smallest distance.
    pub nearest: Option<NearestParticle>,
    /// Force of the cloth on each body, friction of the open step included, in N.
    pub loads: Vec<[f64; 3]>,
}

/// Particle with the smallest distance from a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NearestParticle {
    /// Number of the particle, from 0.
    pub particle: usize,
    /// Number of the body, in the order in which they were given.
    pub body: usize,
}

impl ParticleSummary {
    /// Summary of active particles, in their order; loads are added by the caller.
    pub(super) fn new<'a>(
        active: impl Iterator<Item = &'a ActiveParticle>,
        nearest_inactive: impl FnOnce() -> Option<Nearest>,
        positions: &[f64],
        bodies: usize,
    ) -> ParticleSummary {
        let (mut touching, mut inside) = (Counter::default(), Counter::default());
        let mut nearest: Option<Nearest> = None;
        for ActiveParticle { particle, body, signed } in active {
            let (particle, body, distance) = (*particle, *body, signed.distance);
            touching.count(particle, distance.is_finite());
            inside.count(particle, distance < 0.0);
            if distance < nearest.map_or(f64::INFINITY, |nearest| nearest.distance) {
                nearest = Some(Nearest { distance, particle, body });
            }
        }
        let nearest = nearest.or_else(nearest_inactive);
        let finite = |point: &&[f64]| point.iter().all(|value| value.is_finite());
        let points = positions.chunks(3);
        ParticleSummary {
            touching: touching.total,
            inside: inside.total,
            invalid: points.len() - points.filter(finite).count(),
            min_distance: nearest.map_or(f64::INFINITY, |nearest| nearest.distance),
            nearest: nearest
                .map(|Nearest { particle, body, .. }| NearestParticle { particle, body }),
            loads: vec![[0.0; 3]; bodies],
        }
    }
}

/// Returns the number of particles with a finite distance, each once.
pub(super) fn touching_particles<'a>(active: impl Iterator<Item = &'a ActiveParticle>) -> usize {
    let mut touching = Counter::default();
    active.for_each(|active| touching.count(active.particle, active.signed.distance.is_finite()));
    touching.total
}

/// Counter of particles, each once although it may be active with several bodies in a row.
#[derive(Default)]
struct Counter {
    total: usize,
    last: Option<usize>,
}

impl Counter {
    fn count(&mut self, particle: usize, counts: bool) {
        if counts && self.last != Some(particle) {
            self.total += 1;
            self.last = Some(particle);
        }
    }
}
