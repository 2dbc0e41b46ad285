use crate::contact::ParticleContact;

/// How the cloth lies to the bodies.
#[derive(Debug, Clone, PartialEq)]
pub struct ParticleSummary {
    /// Number of particles within the offset of at least one body.
    pub touching: usize,
    /// Number of particles inside at least one body.
    pub inside: usize,
    /// Number of particles whose position is not finite; they count in nothing else.
    pub invalid: usize,
    /// Smallest signed distance of a particle from a body, in m; infinite if there is none.
    pub min_distance: f64,
    /// The particle and the body of the smallest distance.
    pub nearest: Option<NearestParticle>,
    /// Force of the cloth on each body, friction of the open step included, in N.
    pub loads: Vec<[f64; 3]>,
}

/// The particle with the smallest distance from a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NearestParticle {
    /// The particle, from 0.
    pub particle: usize,
    /// The body, in the order in which they were given.
    pub body: usize,
}

impl ParticleContact {
    /// Counts, distances and loads at given positions.
    ///
    /// # Panics
    ///
    /// If there are not three coordinates per particle.
    pub fn summary(&self, positions: &[f64]) -> ParticleSummary {
        let mut current = self.clone();
        current.detect(positions);
        let (mut touching, mut inside) = (Counter::default(), Counter::default());
        let mut best: Option<(f64, usize, usize)> = None;
        for touch in current.touches() {
            let distance = touch.proximity.distance;
            touching.count(touch.particle, distance.is_finite());
            inside.count(touch.particle, distance < 0.0);
            if distance < best.map_or(f64::INFINITY, |(least, ..)| least) {
                best = Some((distance, touch.particle, touch.body));
            }
        }
        if best.is_none() {
            best = current.nearest(positions);
        }
        let mut loads = vec![[0.0; 3]; self.bodies().len()];
        current.each_force(positions, &mut |_, body, force| {
            for (load, value) in loads[body].iter_mut().zip(force) {
                *load -= value;
            }
        });
        let finite = |point: &&[f64]| point.iter().all(|value| value.is_finite());
        let points = positions.chunks(3);
        ParticleSummary {
            touching: touching.total,
            inside: inside.total,
            invalid: points.len() - points.filter(finite).count(),
            min_distance: best.map_or(f64::INFINITY, |(distance, ..)| distance),
            nearest: best.map(|(_, particle, body)| NearestParticle { particle, body }),
            loads,
        }
    }
}

/// Counts particles, each once although it may touch several bodies in a row.
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
