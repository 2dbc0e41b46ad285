//! Gravity, which may grow to its value over a ramp, and the energy of the cloth in its field.

/// Gravity during a simulation.
#[derive(Debug)]
pub(crate) struct Gravity {
    /// Acceleration at the end of the ramp, in m/s².
    full: [f64; 3],
    /// Acceleration at the end of the step, in m/s².
    now: [f64; 3],
    /// Time at which the ramp begins, in s. For a garment this is the end of the sewing.
    ramp_start: f64,
    /// Length of the ramp, in s.
    ramp: f64,
}

impl Gravity {
    /// Returns gravity with `acceleration`, in m/s². Its ramp begins at time 0 and takes `ramp`, in
    /// s.
    pub(crate) fn new(acceleration: [f64; 3], ramp: f64) -> Self {
        Self { full: acceleration, now: acceleration, ramp_start: 0.0, ramp }
    }

    /// Returns the acceleration at the end of the ramp, in m/s².
    pub(crate) fn acceleration(&self) -> [f64; 3] {
        self.full
    }

    /// Sets the acceleration at the end of the ramp to `acceleration`, in m/s², from the next step
    /// on.
    pub(crate) fn set_acceleration(&mut self, acceleration: [f64; 3]) {
        self.full = acceleration;
    }

    /// Begins the ramp at `time`, in s.
    pub(crate) fn start_ramp(&mut self, time: f64) {
        self.ramp_start = time;
    }

    /// Moves the ramp so that it ends at `time`, in s.
    pub(crate) fn finish_ramp(&mut self, time: f64) {
        self.ramp_start = time - self.ramp;
    }

    /// Returns the time at which the ramp begins, in s.
    pub(crate) fn ramp_start(&self) -> f64 {
        self.ramp_start
    }

    /// Returns the time at which the ramp ends, in s.
    pub(crate) fn ramp_end(&self) -> f64 {
        self.ramp_start + self.ramp
    }

    /// Prepares a step that ends at `end_time`, in s.
    pub(crate) fn begin(&mut self, end_time: f64) {
        let elapsed = end_time - self.ramp_start;
        let fraction = if elapsed < self.ramp { (elapsed / self.ramp).max(0.0) } else { 1.0 };
        self.now = self.full.map(|g| fraction * g);
    }

    /// Prepares a step without gravity.
    pub(crate) fn begin_without(&mut self) {
        self.now = [0.0; 3];
    }

    /// Overwrites `forces` with the weights of particles with `masses`, in N.
    pub(crate) fn write_forces(&self, masses: &[f64], forces: &mut [f64]) {
        for (force, mass) in forces.chunks_exact_mut(3).zip(masses) {
            force.iter_mut().zip(self.now).for_each(|(f, g)| *f = mass * g);
        }
    }

    /// Returns the potential energy of particles with `masses` at `positions`, in J. It is 0 at the
    /// origin.
    pub(crate) fn potential(&self, masses: &[f64], positions: &[f64]) -> f64 {
        let potentials = positions
            .chunks_exact(3)
            .map(|x| -> f64 { x.iter().zip(self.now).map(|(x, g)| -x * g).sum() });
        masses.iter().zip(potentials).map(|(mass, potential)| mass * potential).sum()
    }
}
