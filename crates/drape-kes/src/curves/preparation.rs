//! What was done to a curve before a law is fitted to it.

use crate::curves::steady::SteadyPath;

/// What was done to a curve before a law is fitted to it, and what it is.
#[derive(Clone, Debug, PartialEq)]
pub struct Preparation {
    /// Break of the strip, whose points after it were left out.
    pub rupture: Option<Rupture>,
    /// What was done to the path of the deformation; `None` where it is as measured.
    pub path: Option<SteadyPath>,
    /// Whether the zero of its strain was given, so that nothing need be said of it.
    pub zero_is_given: bool,
}

/// Break of a strip in a tensile test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rupture {
    /// Strain at the break, a ratio.
    pub strain: f64,
    /// Load per width at the break, in N/m.
    pub load: f64,
    /// Number of points after it.
    pub points_after: usize,
}
