//! Counts, distances and loads of the contact of particles.

use super::detection::{ActiveParticle, NearestBody};

/// Counts, distances and loads of particles in contact with bodies.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct ParticleSummary {
    /// Number of particles within the activation distance of at least one body.
    pub touching: usize,
    /// Number of particles inside at least one body.
    pub inside: usize,
    /// Number of particles whose position is not finite. The other counts leave them out.
    pub invalid: usize,
    /// Smallest signed distance of a particle from a body, in m, infinite without any.
    pub min_distance: f64,
    /// Particle and body of the smallest distance.
    pub nearest: Option<NearestParticle>,
    /// Force of the cloth on each body, including friction of the open step, in N.
    pub loads: Vec<[f64; 3]>,
}

/// Particle with the smallest distance from a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
pub struct NearestParticle {
    /// Number of the particle, from 0.
    pub particle: usize,
    /// Number of the body, in the order in which they were given.
    pub body: usize,
}

impl ParticleSummary {
    /// Returns the summary of the `active` particles, in their order. The caller adds the loads.
    pub(super) fn new<'a>(
        active: impl Iterator<Item = &'a ActiveParticle>,
        nearest_inactive: impl FnOnce() -> Option<NearestBody>,
        positions: &[f64],
        bodies: usize,
    ) -> ParticleSummary {
        let (mut touching, mut inside) = (ParticleCounter::default(), ParticleCounter::default());
        let mut nearest: Option<NearestBody> = None;
        for ActiveParticle { particle, body, signed } in active {
            let (particle, body, distance) = (*particle, *body, signed.distance);
            touching.count(particle, distance.is_finite());
            inside.count(particle, distance < 0.0);
            if distance < nearest.map_or(f64::INFINITY, |nearest| nearest.distance) {
                nearest = Some(NearestBody { distance, particle, body });
            }
        }
        let nearest = nearest.or_else(nearest_inactive);

        let points = positions.chunks(3);
        let finite = points.clone().filter(|point| point.iter().all(|value| value.is_finite()));
        ParticleSummary {
            touching: touching.total,
            inside: inside.total,
            invalid: points.len() - finite.count(),
            min_distance: nearest.map_or(f64::INFINITY, |nearest| nearest.distance),
            nearest: nearest
                .map(|NearestBody { particle, body, .. }| NearestParticle { particle, body }),
            loads: vec![[0.0; 3]; bodies],
        }
    }
}

/// Returns the number of particles in `active` with a finite distance, each counted once.
pub(super) fn touching_particle_count<'a>(
    active: impl Iterator<Item = &'a ActiveParticle>,
) -> usize {
    let mut touching = ParticleCounter::default();
    active.for_each(|active| touching.count(active.particle, active.signed.distance.is_finite()));
    touching.total
}

/// ParticleCounter of particles, each counted once although it may be active with several bodies in
/// a row.
#[derive(Default)]
struct ParticleCounter {
    total: usize,
    last: Option<usize>,
}

impl ParticleCounter {
    /// Counts `particle` if it `counts` and is not the last one counted.
    fn count(&mut self, particle: usize, counts: bool) {
        if counts && self.last != Some(particle) {
            self.total += 1;
            self.last = Some(particle);
        }
    }
}
