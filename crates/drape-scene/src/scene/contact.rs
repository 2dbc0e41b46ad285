//! Settings of the contact of cloth and bodies.

use drape_collide::{ParticleSettings, PinchPolicy};

/// Settings of the contact of cloth and bodies.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactSettings {
    /// Whether all surfaces are kept apart; only particles are kept out of bodies otherwise.
    pub surfaces: bool,
    /// Contact of particles with bodies. Its activation distance counts for surfaces too.
    pub particles: ParticleSettings,
    /// Stiffness of the contact of surfaces, in N/m³; without one, the fabrics' thickness under
    /// pressure gives it.
    pub stiffness: Option<f64>,
    /// Top speed at which a program moves bodies and pins, in m/s. Without `stiffness` the contact
    /// of surfaces is stiff enough to stop bodies and pins at this speed.
    pub top_speed: Option<f64>,
    /// Displacement of surfaces that stick, before they slide, in m.
    pub sticking_displacement: f64,
    /// Treatment of cloth that bodies close on.
    pub pinch: PinchPolicy,
    /// Growth of bodies at the start.
    pub inflation: Option<Inflation>,
    /// Growth of the distances that surfaces keep.
    pub growth: Option<DistanceGrowth>,
}

/// Growth of bodies that start smaller than they are, so that cloth which would start inside them
/// starts outside.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Inflation {
    /// Depth below their places at which their vertices start, along the normals, in m.
    pub depth: f64,
    /// Time until they have their size, in s.
    pub seconds: f64,
}

impl Inflation {
    /// Returns the fraction of the depth that remains at a time, in s, 0 to 1.
    #[must_use]
    pub fn remaining(&self, time: f64) -> f64 {
        (1.0 - time / self.seconds).clamp(0.0, 1.0)
    }
}

/// Growth of the distances of surfaces that start nearer to each other than their minimum
/// separation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DistanceGrowth {
    /// Time until surfaces keep their whole distances, in s, if nothing holds them together.
    pub seconds: f64,
}

impl DistanceGrowth {
    /// Smallest distance of two surfaces from which it starts, in m: a thousand times the least gap
    /// that the step filter tells from none.
    pub const START_DISTANCE_MIN: f64 = 1e-6;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bodies_grow_evenly_to_their_size() {
        let inflation = Inflation { depth: 0.01, seconds: 2.0 };
        let remaining = [0.0, 0.5, 2.0, 3.0].map(|time| inflation.remaining(time));
        assert_eq!(remaining, [1.0, 0.75, 0.0, 0.0]);
    }
}
