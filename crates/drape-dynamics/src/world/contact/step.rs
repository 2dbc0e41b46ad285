//! Opening of a step for contact: its times, and the energy with which it begins.

/// Step that is opened for contact.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ContactStep<'a> {
    /// Positions of the particles at its start, in m.
    pub(crate) positions: &'a [f64],
    /// Time of its end, in s.
    pub(crate) end_time: f64,
    /// Length, in s.
    pub(crate) dt: f64,
    /// Its start and its end on the clock of motions, in s.
    pub(crate) motion_start: f64,
    pub(crate) motion_end: f64,
    /// Whether it is a step of quasi-static relaxation.
    pub(crate) relaxes: bool,
    /// Whether energies are asked for.
    pub(crate) with_energy: bool,
    /// Gap of the open seams at each particle, in m, while a garment is sewn.
    pub(crate) seam_gaps: Option<&'a [f64]>,
}

/// Energy of contact at the start of a step, in J.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct ContactEnergy {
    /// Potential of contact without friction.
    pub(crate) contact: f64,
    /// Potential of the friction with bodies, which have moved on since the last step.
    pub(crate) friction: f64,
    /// Work that the motion of bodies in this step does on contact; of surfaces, that of the growth
    /// of their distances.
    pub(crate) body_work: f64,
}
