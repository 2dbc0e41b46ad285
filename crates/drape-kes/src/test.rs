//! Tests and directions of a measurement.

/// Test that a curve comes from, which fixes the meaning of deformation and load.
///
/// | test | deformation | load, per width |
/// |---|---|---|
/// | tensile | strain, a ratio | force, in N/m |
/// | shear | shear angle, in rad | force, in N/m |
/// | bending | curvature, in 1/m | moment, in N |
/// | loop bending | clamp distance over specimen length, minus one | force, in N/m |
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Test {
    /// Stretching of a strip along its yarns (KES-FB1).
    Tensile,
    /// Shearing of a strip at constant tension (KES-FB1).
    Shear,
    /// Bending of a strip to a uniform curvature (KES-FB2).
    Bending,
    /// Buckling of a strip into an arch between two approaching, parallel clamps.
    LoopBending,
}

impl Test {
    /// Returns the name used in sheets and messages.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Tensile => "tensile",
            Self::Shear => "shear",
            Self::Bending => "bending",
            Self::LoopBending => "loop-bending",
        }
    }
}

/// Yarns along which a strip was cut and loaded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Direction {
    /// Along the loom.
    Warp,
    /// Across the loom.
    Weft,
}

impl Direction {
    /// Returns the name used in sheets and messages.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Warp => "warp",
            Self::Weft => "weft",
        }
    }
}
