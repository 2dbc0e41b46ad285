//! Changes of a curve before a law is fitted to it.

use crate::curves::steady::SteadyPath;

/// Changes of a curve before a law is fitted to it.
#[derive(Clone, Debug, PartialEq)]
pub struct Preparation {
    /// Break of the strip. The points after the break were removed.
    pub rupture: Option<Rupture>,
    /// Change of the path of the deformation; `None` for a path as measured.
    pub path: Option<SteadyPath>,
    /// Whether the zero of strain was given, so that no remark on the zero is needed.
    pub zero_is_given: bool,
}

/// Break of a strip in a tensile test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rupture {
    /// Strain at the break, a ratio.
    pub strain: f64,
    /// Load per width at the break, in N/m.
    pub load: f64,
    /// Number of points after the break.
    pub points_after: usize,
}
