//! Pins: particles that are held, or led along a motion.
//!
//! A program may lead a pin, hold further particles and release particles between steps. A steered
//! pin replaces the pin of the scene until the simulation is reset to a state before it.
//!
//! A pin that holds in all directions prescribes the positions of its particles, and the solver
//! leaves them out. A pin that holds in some directions is a spring in each of them (`springs.rs`).
//! Loads of pins are read off the forces at a state (`load.rs`).

mod load;
mod springs;

use drape_scene::{HoldUntil, MotionResolution, Pin, RigidMotion};
use serde::{Deserialize, Serialize};

pub use self::load::PinLoad;
pub(crate) use self::springs::PinSprings;

/// Pins of a world.
#[derive(Debug)]
pub(crate) struct Pins {
    /// Pins of the scene, without the changes of a program.
    scene: Vec<Pin>,
    /// Pins of the scene, then the pins of a program.
    pins: Vec<Pin>,
    /// Whether a program has changed the pins.
    is_steered: bool,
    /// Whether each particle is held in all directions in this step.
    pub(crate) held: Vec<bool>,
    /// Springs of the pins that hold in some directions, in this step.
    pub(crate) springs: PinSprings,
}

impl Pins {
    /// Returns the pins `pins`. `held` says for each particle whether a pin holds it in all
    /// directions at the start.
    pub(crate) fn new(pins: Vec<Pin>, held: Vec<bool>) -> Self {
        Self { scene: pins.clone(), pins, is_steered: false, held, springs: PinSprings::default() }
    }

    /// Prepares the pins for a step that ends at `end_time` of the simulation and `motion_end` on
    /// the motion clock, in s. Writes the final positions of the held particles to `target`.
    pub(crate) fn begin(&mut self, end_time: f64, motion_end: f64, target: &mut [f64]) {
        self.update_held(end_time);
        self.springs.clear();
        for pin in self.pins.iter().filter(|pin| pin.holds(end_time)) {
            if pin.holds_all_axes() {
                pin.write_positions(motion_end, target);
            } else {
                self.springs.add(pin, motion_end);
            }
        }
    }

    /// Returns whether a step between the two `times` on the motion clock, in s, resolves the
    /// motions of all pins to `resolution`.
    pub(crate) fn are_resolved(&self, times: [f64; 2], resolution: MotionResolution) -> bool {
        let motions = self.pins.iter().filter_map(|pin| Some((pin, pin.motion.as_ref()?)));
        motions.into_iter().all(|(pin, motion)| motion.is_resolved(times, &pin.start, resolution))
    }

    /// Releases the pins that hold until `event`, at `time`, in s.
    pub(crate) fn release(&mut self, event: HoldUntil, time: f64) {
        self.pins.iter_mut().for_each(|pin| pin.release_at(event, time));
    }

    /// Restores the `saved` pins. Returns `false` if they do not fit.
    pub(crate) fn restore(&mut self, saved: SavedPins) -> bool {
        let SavedPins { steered, releases, held } = saved;
        let is_steered = steered.is_some();
        let pins = steered.unwrap_or_else(|| self.scene.clone());
        let are_known = pins.len() >= self.scene.len()
            && pins.iter().all(|pin| pin.is_sound(self.held.len()))
            && releases.len() == pins.len()
            && held.len() == self.held.len();
        if !are_known {
            return false;
        }

        (self.pins, self.held, self.is_steered) = (pins, held, is_steered);
        self.pins.iter_mut().zip(releases).for_each(|(pin, release)| pin.release = release);
        true
    }

    /// Returns whether the pins of the scene hold each particle in all directions at the start.
    pub(crate) fn held_at_start(&self) -> Vec<bool> {
        let mut held = vec![false; self.held.len()];
        let pins = self.scene.iter().filter(|pin| pin.holds_all_axes());
        pins.flat_map(|pin| &pin.particles).for_each(|&particle| held[particle] = true);
        held
    }

    /// Returns the pins between two steps.
    pub(crate) fn saved(&self) -> SavedPins {
        SavedPins {
            steered: self.is_steered.then(|| self.pins.clone()),
            releases: self.pins.iter().map(|pin| pin.release).collect(),
            held: self.held.clone(),
        }
    }

    /// Returns whether a program has changed the pins.
    pub(crate) fn is_steered(&self) -> bool {
        self.is_steered
    }

    /// Returns the number of pins.
    pub(crate) fn count(&self) -> usize {
        self.pins.len()
    }

    /// Returns the pin `number`.
    pub(crate) fn get(&self, number: usize) -> Option<&Pin> {
        self.pins.get(number)
    }

    /// Leads the pin `number` along `motion` from the positions `start` of its particles, in m.
    pub(crate) fn lead(&mut self, number: usize, start: Vec<[f64; 3]>, motion: RigidMotion) {
        let pin = &mut self.pins[number];
        (pin.start, pin.motion) = (start, Some(motion));
        self.is_steered = true;
    }

    /// Holds `particles` in all directions where they are at `positions`, in m, from now on.
    /// Returns the number of their pin. A pin of a program whose particles have all been released
    /// gives its number to the new pin.
    pub(crate) fn hold(&mut self, particles: &[usize], positions: &[f64]) -> usize {
        let start = particles.iter().map(|&p| std::array::from_fn(|k| positions[3 * p + k]));
        let pin = Pin {
            particles: particles.to_vec(),
            start: start.collect(),
            motion: None,
            release: f64::INFINITY,
            until: HoldUntil::End,
            axes: [true; 3],
        };
        particles.iter().for_each(|&particle| self.held[particle] = true);
        self.is_steered = true;

        let added = self.scene.len()..self.pins.len();
        match added.into_iter().find(|&number| self.pins[number].particles.is_empty()) {
            Some(number) => {
                self.pins[number] = pin;
                number
            }
            None => {
                self.pins.push(pin);
                self.pins.len() - 1
            }
        }
    }

    /// Returns whether a pin holds `particle` in a step that ends at `end_time`, in s.
    pub(crate) fn hold_particle(&self, particle: usize, end_time: f64) -> bool {
        let mut holding = self.pins.iter().filter(|pin| pin.holds(end_time));
        holding.any(|pin| pin.particles.contains(&particle))
    }

    /// Takes `particle` out of all pins.
    pub(crate) fn free(&mut self, particle: usize) {
        self.is_steered = true;
        self.held[particle] = false;
        for pin in &mut self.pins {
            if let Some(index) = pin.particles.iter().position(|&held| held == particle) {
                pin.particles.remove(index);
                pin.start.remove(index);
            }
        }
    }

    /// Returns the time of the last release after `time`, in s, or `time` if there is none.
    pub(crate) fn last_release(&self, time: f64) -> f64 {
        let releases = self.pins.iter().map(|pin| pin.release);
        releases.filter(|release| release.is_finite()).fold(time, f64::max)
    }

    /// Returns the loads of the pins at `times`, with the particles at `positions`, in m, under
    /// `forces`, in N.
    pub(crate) fn loads(
        &self,
        times: LoadTimes,
        positions: &[f64],
        forces: &[f64],
    ) -> Vec<PinLoad> {
        let loads = self.pins.iter().map(|pin| {
            if !pin.holds(times.now) {
                PinLoad::default()
            } else if pin.holds_all_axes() {
                PinLoad::new(pin, positions, forces)
            } else {
                let springs = PinSprings::new(pin, times.motion);
                PinLoad::new(pin, positions, &springs.reactions(positions))
            }
        });
        loads.collect()
    }

    /// Updates the held particles for a step that ends at `end_time`, in s.
    fn update_held(&mut self, end_time: f64) {
        if !self.is_steered && self.pins.iter().all(|pin| pin.release == f64::INFINITY) {
            return;
        }
        self.held.fill(false);
        for pin in self.pins.iter().filter(|pin| pin.holds_all_axes() && pin.holds(end_time)) {
            pin.particles.iter().for_each(|&particle| self.held[particle] = true);
        }
    }
}

/// Pins between two steps.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct SavedPins {
    /// All pins, if a program has changed them.
    steered: Option<Vec<Pin>>,
    /// Times of the releases of the pins, in s.
    releases: Vec<f64>,
    /// Whether each particle is held in all directions.
    held: Vec<bool>,
}

/// Time at which loads are read.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LoadTimes {
    /// Time of the simulation, in s.
    pub(crate) now: f64,
    /// Time on the clock of motions, in s.
    pub(crate) motion: f64,
}
