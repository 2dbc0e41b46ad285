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
    /// A strip is stretched along its yarns (KES-FB1).
    Tensile,
    /// A strip is sheared at constant tension (KES-FB1).
    Shear,
    /// A strip is bent to a uniform curvature (KES-FB2).
    Bending,
    /// Two parallel clamps approach and the strip between them buckles into an arch.
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
