//! Pins that a program leads between steps, and particles that it holds and releases.

use std::collections::BTreeSet;

use drape_collide::equivalence_classes;

use super::Simulation;
use super::prescription::{Displacement, middle, unsuited};
use crate::error::Error;

/// Target to which a pin moves from its current position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PinTarget {
    /// Position of the middle of the pin's extent, in m. A pin of one particle moves there. The pin
    /// does not turn.
    Place([f64; 3]),
    /// Rigid displacement, by default about the middle of the pin's extent.
    Rigid(Displacement),
}

impl Simulation {
    /// Returns the number of pins: the pins of the scene in its order, and then the pins of
    /// [`hold`](Self::hold).
    #[must_use]
    pub fn pin_count(&self) -> usize {
        self.world.pins().count()
    }

    /// Returns the numbers of the particles that the pin `pin` holds, from 0: particle `i` has the
    /// coordinates `3 * i`, `3 * i + 1` and `3 * i + 2` of [`positions`](Self::positions).
    ///
    /// # Errors
    /// [`Error::Unsuited`] for a pin that does not exist.
    pub fn pin_particles(&self, pin: usize) -> Result<&[usize], Error> {
        self.world.pins().get(pin).map(|pin| &pin.particles[..]).ok_or_else(|| self.no_pin(pin))
    }

    /// Moves the pin `pin` to `target` within `seconds`, at a steady rate from now on. The pin
    /// stays there. This motion replaces the earlier motion of the pin. With the time
    /// [`next_step`](Self::next_step) the pin arrives at the end of the next step.
    ///
    /// A pin that moves by more than the distance of the particles in a step divides the step where
    /// surfaces are kept apart. Surfaces never intersect: a step in which cloth or bodies are in
    /// the way of the pin ends with an error. The work of the pin is part of
    /// [`Energy::work_in`](crate::Energy::work_in).
    ///
    /// # Errors
    /// [`Error::Unsuited`] for a pin that does not exist or no longer holds a particle, numbers
    /// that are not finite, a time that is not positive, and a speed at which contact does not keep
    /// the fabrics apart. The same error is returned while the garment is sewn, while pins wait for
    /// the cloth to rest, and while the cloth rests on a coarser grid.
    pub fn lead_pin(&mut self, pin: usize, target: &PinTarget, seconds: f64) -> Result<(), Error> {
        self.check_sewn()?;
        let times = self.motion_times(seconds)?;
        let led = self.world.pins().get(pin).ok_or_else(|| self.no_pin(pin))?;
        if led.particles.is_empty() || led.release <= self.time() {
            let message = format!("pin {pin} holds no particle any more; hold particles anew");
            return Err(unsuited(message));
        }

        // Springs of a pin that holds in some directions lead its particles only nearly, so this
        // pin moves from the positions that are prescribed.
        let positions = &self.world.state.positions;
        let start: Vec<[f64; 3]> = if led.holds_all_axes() {
            led.particles.iter().map(|&p| std::array::from_fn(|k| positions[3 * p + k])).collect()
        } else {
            led.positions(times[0]).map(|held| held.position).collect()
        };
        let displacement = match *target {
            PinTarget::Place(place) => {
                let from = middle(&start);
                let shift = std::array::from_fn(|axis| place[axis] - from[axis]);
                Displacement { shift, ..Displacement::default() }
            }
            PinTarget::Rigid(displacement) => displacement,
        };
        let motion = displacement.motion(times, &start)?;
        self.check_speed(&format!("pin {pin}"), motion.max_speed(&start), seconds)?;
        self.world.lead_pin(pin, start, motion);
        self.wake();
        Ok(())
    }

    /// Holds `particles`, given by their numbers, where they are, in all directions, from now on.
    /// Returns the number of their pin, which [`lead_pin`](Self::lead_pin) leads and
    /// [`pin_loads`](Self::pin_loads) lists. A particle leaves the pin that held it before.
    /// Particles that are sewn to one of `particles` are held with it.
    ///
    /// Particles in flight stop at once. Their kinetic energy is negative work of the pin in
    /// [`Energy::work_in`](crate::Energy::work_in). The number of a pin whose particles have all
    /// been [released](Self::release) is given to the next pin.
    ///
    /// # Errors
    /// [`Error::Unsuited`] for no particles, particles that do not exist, and particles that are
    /// gathered along a seam. The same error is returned while the garment is sewn and while the
    /// cloth rests on a coarser grid. Nothing is held then.
    pub fn hold(&mut self, particles: &[usize]) -> Result<usize, Error> {
        self.check_sewn()?;
        self.check_particles(particles)?;
        if particles.is_empty() {
            return Err(unsuited("no particles to hold; give one or more".into()));
        }
        let mut particles = particles.to_vec();
        particles.sort_unstable();
        particles.dedup();
        let ties = &self.parts.seams.ties;
        if let Some(tie) =
            ties.iter().find(|tie| particles.binary_search(&(tie.particle as usize)).is_ok())
        {
            let [first, second] = tie.ends;
            return Err(unsuited(format!(
                "particle {} is gathered along a seam between the particles {first} and {second}; hold \
                 one of these",
                tie.particle
            )));
        }

        for particle in self.sewn_to(&particles) {
            self.world.free(particle);
        }
        let before = self.world.kinetic_energy();
        self.stepping.stop(&mut self.world, &particles);
        let lost = before - self.world.kinetic_energy();
        if let Some(balance) = &mut self.world.balance {
            balance.stop(lost);
        }
        self.wake();
        Ok(self.world.hold(&particles))
    }

    /// Releases `particles`, which pins hold, from now on: they leave all pins. Particles that are
    /// sewn to one of `particles` are released with it.
    ///
    /// # Errors
    /// [`Error::Unsuited`] for particles that do not exist or that no pin holds. The same error is
    /// returned while the garment is sewn and while the cloth rests on a coarser grid. Nothing is
    /// released then.
    pub fn release(&mut self, particles: &[usize]) -> Result<(), Error> {
        self.check_sewn()?;
        self.check_particles(particles)?;
        let end_time = self.time() + self.next_step();
        for &particle in particles {
            let sewn = self.sewn_to(&[particle]);
            let pins = self.world.pins();
            if !sewn.iter().any(|&particle| pins.hold_particle(particle, end_time)) {
                return Err(unsuited(format!(
                    "no pin holds particle {particle}; release particles of pin_particles"
                )));
            }
        }

        for particle in self.sewn_to(particles) {
            self.world.free(particle);
        }
        self.wake();
        Ok(())
    }

    /// Returns `particles` with all particles that seams merge with one of them, and the gathered
    /// particles that lie beside one of these, in rising order.
    fn sewn_to(&self, particles: &[usize]) -> Vec<usize> {
        let seams = &self.parts.seams;
        let mut sewn = particles.to_vec();
        if !seams.is_empty() {
            let count = self.world.cloth.particle_count();
            let classes = equivalence_classes(count, &seams.pairs).expect("pairs name particles");
            let given: BTreeSet<u32> =
                particles.iter().map(|&particle| classes[particle]).collect();
            let merged = classes.iter().enumerate().filter(|(_, class)| given.contains(class));
            sewn.extend(merged.map(|(particle, _)| particle));
            let gathered = seams
                .ties
                .iter()
                .filter(|tie| tie.ends.iter().any(|&end| given.contains(&classes[end as usize])));
            sewn.extend(gathered.map(|tie| tie.particle as usize));
        }
        sewn.sort_unstable();
        sewn.dedup();
        sewn
    }

    /// Checks that the seams are closed on the grid of the scene.
    fn check_sewn(&self) -> Result<(), Error> {
        self.check_grid()?;
        if self.world.closing_springs().is_none() {
            return Ok(());
        }
        let message = "the garment is being sewn; step until the phase is no longer \"sew\"";
        Err(unsuited(message.into()))
    }

    /// Checks that `particles` exist.
    fn check_particles(&self, particles: &[usize]) -> Result<(), Error> {
        let count = self.world.cloth.particle_count();
        match particles.iter().find(|&&particle| particle >= count) {
            None => Ok(()),
            Some(particle) => Err(unsuited(format!(
                "there is no particle {particle}; the cloth has {count}, numbered from 0"
            ))),
        }
    }

    /// Returns the error that there is no pin `pin`.
    fn no_pin(&self, pin: usize) -> Error {
        let count = self.pin_count();
        unsuited(format!("there is no pin {pin}; the simulation has {count}, numbered from 0"))
    }
}
