//! Pins: particles that are held, or led along a motion.
//!
//! A pin that holds in all directions prescribes the positions of its particles, and the solver
//! leaves them out. A pin that holds in some directions is a spring in each of them (`springs.rs`).
//! Loads of pins are read off the forces at a state (`load.rs`).

mod load;
mod springs;

use drape_scene::{HoldUntil, MotionResolution, Pin};

pub use self::load::PinLoad;
pub(crate) use self::springs::PinSprings;

/// Pins of a world.
#[derive(Debug)]
pub(crate) struct Pins {
    pins: Vec<Pin>,
    /// Whether each particle is held in all directions in this step.
    pub(crate) held: Vec<bool>,
    /// Springs of the pins that hold in some directions, in this step.
    pub(crate) springs: PinSprings,
}

impl Pins {
    /// Pins of a cloth, with the particles that they hold in all directions at the start.
    pub(crate) fn new(pins: Vec<Pin>, held: Vec<bool>) -> Self {
        Self { pins, held, springs: PinSprings::default() }
    }

    /// Opens a step that ends at a time, in s, and at one on the clock of motions: writes the
    /// positions of the held particles at its end.
    pub(crate) fn begin(&mut self, end_time: f64, motion_end: f64, target: &mut [f64]) {
        self.update_held(end_time);
        self.springs.clear();
        for pin in self.pins.iter().filter(|pin| pin.holds(end_time)) {
            match pin.holds_all_axes() {
                true => pin.write_positions(motion_end, target),
                false => self.springs.add(pin, motion_end),
            }
        }
    }

    /// Whether a step between two times on the clock of motions, in s, resolves the motions of all
    /// pins.
    pub(crate) fn are_resolved(&self, times: [f64; 2], resolution: MotionResolution) -> bool {
        let motions = self.pins.iter().filter_map(|pin| Some((pin, pin.motion.as_ref()?)));
        motions.into_iter().all(|(pin, motion)| motion.is_resolved(times, &pin.start, resolution))
    }

    /// Releases the pins that hold until an event, at its time, in s.
    pub(crate) fn release(&mut self, event: HoldUntil, time: f64) {
        self.pins.iter_mut().for_each(|pin| pin.release_at(event, time));
    }

    /// Times of the releases of the pins, in s.
    pub(crate) fn releases(&self) -> Vec<f64> {
        self.pins.iter().map(|pin| pin.release).collect()
    }

    /// Returns to times of releases, in s, and to held particles; false if they are not as many.
    pub(crate) fn restore(&mut self, releases: &[f64], held: &[bool]) -> bool {
        if releases.len() != self.pins.len() || held.len() != self.held.len() {
            return false;
        }
        self.pins.iter_mut().zip(releases).for_each(|(pin, release)| pin.release = *release);
        self.held.copy_from_slice(held);
        true
    }

    /// Time of the last release after a time, in s, or that time if none is.
    pub(crate) fn last_release(&self, time: f64) -> f64 {
        let releases = self.pins.iter().map(|pin| pin.release);
        releases.filter(|release| release.is_finite()).fold(time, f64::max)
    }

    /// Loads of the pins at a time, in s, and at one on the clock of motions, from the forces on
    /// all particles.
    pub(crate) fn loads(
        &self,
        times: LoadTimes,
        positions: &[f64],
        forces: &[f64],
    ) -> Vec<PinLoad> {
        let load = |pin: &Pin| match (pin.holds(times.now), pin.holds_all_axes()) {
            (true, true) => PinLoad::new(pin, positions, forces),
            (true, false) => {
                let springs = PinSprings::of(pin, times.motion);
                PinLoad::new(pin, positions, &springs.reactions(positions))
            }
            (false, _) => PinLoad::default(),
        };
        self.pins.iter().map(load).collect()
    }

    /// Updates the held particles for a step that ends at a time, in s.
    fn update_held(&mut self, end_time: f64) {
        if self.pins.iter().all(|pin| pin.release == f64::INFINITY) {
            return;
        }
        self.held.fill(false);
        for pin in self.pins.iter().filter(|pin| pin.holds_all_axes() && pin.holds(end_time)) {
            pin.particles.iter().for_each(|&particle| self.held[particle] = true);
        }
    }
}

/// Time at which loads are read.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LoadTimes {
    /// Time of the simulation, in s.
    pub(crate) now: f64,
    /// Time on the clock of motions, in s.
    pub(crate) motion: f64,
}
