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
    /// Returns the pins `pins`. `held` says for each particle whether a pin holds it in all
    /// directions at the start.
    pub(crate) fn new(pins: Vec<Pin>, held: Vec<bool>) -> Self {
        Self { pins, held, springs: PinSprings::default() }
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

    /// Returns the release time of each pin, in s.
    pub(crate) fn releases(&self) -> Vec<f64> {
        self.pins.iter().map(|pin| pin.release).collect()
    }

    /// Restores the release times `releases`, in s, and the held particles `held`. Returns `false`
    /// if their numbers do not fit.
    pub(crate) fn restore(&mut self, releases: &[f64], held: &[bool]) -> bool {
        if releases.len() != self.pins.len() || held.len() != self.held.len() {
            return false;
        }
        self.pins.iter_mut().zip(releases).for_each(|(pin, release)| pin.release = *release);
        self.held.copy_from_slice(held);
        true
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
