//! Pins: particles that are held, or led along a motion.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::scene::motion::RigidMotion;

/// Pin of a scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Pin {
    /// Particles that it holds.
    pub particles: Vec<usize>,
    /// Their positions at the start, in m.
    pub start: Vec<[f64; 3]>,
    /// Their motion; none if they stay.
    pub motion: Option<RigidMotion>,
    /// Time at which it lets go, in s; infinite if it never does.
    pub release: f64,
    /// Event at which it lets go.
    pub until: HoldUntil,
    /// Whether it holds along x, y and z.
    pub axes: [bool; 3],
}

/// Event at which a pin lets go.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum HoldUntil {
    /// The run ends.
    #[default]
    End,
    /// The garment is sewn.
    Sewn,
    /// The cloth has come to rest, and bodies begin to move.
    Rest,
}

/// Particle with the position at which a pin holds it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeldParticle {
    /// Index of the particle.
    pub particle: usize,
    /// Position, in m.
    pub position: [f64; 3],
}

impl Pin {
    /// Returns whether it holds its particles in a step that ends at a time, in s.
    #[must_use]
    pub fn holds(&self, end_time: f64) -> bool {
        end_time <= self.release
    }

    /// Returns whether its particles are held in all directions; they are attached by springs
    /// otherwise.
    #[must_use]
    pub fn holds_all_axes(&self) -> bool {
        self.axes == [true; 3]
    }

    /// Returns whether its particles are among the first `particle_count`, each with a finite
    /// position, and its motion is sound. A pin from a file may be damaged.
    #[must_use]
    pub fn is_sound(&self, particle_count: usize) -> bool {
        self.particles.len() == self.start.len()
            && self.particles.iter().all(|&particle| particle < particle_count)
            && self.start.iter().flatten().all(|x| x.is_finite())
            && self.motion.as_ref().is_none_or(RigidMotion::is_sound)
            && !self.release.is_nan()
    }

    /// Sets the time of its release, in s, if it is to hold until an event.
    pub fn release_at(&mut self, event: HoldUntil, time: f64) {
        if self.until == event {
            self.release = time;
        }
    }

    /// Returns its particles with their positions at a time on the clock of motions, in s.
    pub fn positions(&self, time: f64) -> impl Iterator<Item = HeldParticle> {
        let moved = self.motion.as_ref().map(|motion| motion.transform(time));
        let place = move |&start: &[f64; 3]| moved.as_ref().map_or(start, |moved| moved(start));
        let places = self.particles.iter().zip(self.start.iter().map(place));
        places.map(|(&particle, position)| HeldParticle { particle, position })
    }

    /// Writes the positions of its particles at a time on the clock of motions, in s, into the flat
    /// array of all positions. A pin without a motion leaves them as they are.
    pub fn write_positions(&self, time: f64, positions: &mut [f64]) {
        if self.motion.is_some() {
            for HeldParticle { particle, position } in self.positions(time) {
                positions[3 * particle..3 * particle + 3].copy_from_slice(&position);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pin_lets_go_at_its_event_and_at_no_other() {
        let mut pin = Pin {
            particles: vec![3],
            start: vec![[1.0, 2.0, 3.0]],
            motion: None,
            release: f64::INFINITY,
            until: HoldUntil::Sewn,
            axes: [true; 3],
        };
        pin.release_at(HoldUntil::Rest, 1.0);
        assert!(pin.holds(2.0));
        pin.release_at(HoldUntil::Sewn, 1.5);
        assert!(pin.holds(1.5) && !pin.holds(1.51));
    }
}
