//! Opening of a step for contact: its times, and the energy with which it begins.

/// What a world keeps, so that contact never refuses a list: coordinates, forces and gaps of all
/// particles, and coordinates of all bodies.
pub(crate) const ALL_PARTICLES: &str = "the world keeps numbers of all its particles and bodies";

/// Step for which contact is prepared.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ContactStep<'a> {
    /// Positions of the particles at the start of the step, in m.
    pub(crate) positions: &'a [f64],
    /// Time at the end of the step, in s.
    pub(crate) end_time: f64,
    /// Length of the step, in s.
    pub(crate) dt: f64,
    /// Start of the step on the motion clock, in s.
    pub(crate) motion_start: f64,
    /// End of the step on the motion clock, in s.
    pub(crate) motion_end: f64,
    /// Whether this is a step of quasi-static relaxation.
    pub(crate) relaxes: bool,
    /// Whether the energy of contact is asked for.
    pub(crate) with_energy: bool,
    /// Gap of the open seams at each particle, in m, while a garment is sewn.
    pub(crate) seam_gaps: Option<&'a [f64]>,
}

/// Energy of contact at the start of a step, in J.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct ContactEnergy {
    /// Potential of contact, for surfaces with the potential of their friction.
    pub(crate) contact: f64,
    /// Potential of contact without friction.
    pub(crate) without_friction: f64,
    /// Potential of the friction with bodies, which have moved since the last step.
    pub(crate) friction: f64,
    /// Work on contact by the motion of bodies in this step. For surfaces, the work of growing
    /// distances instead.
    pub(crate) body_work: f64,
}
