//! Tests and directions of a measurement.

use serde::{Deserialize, Serialize};

/// Test that a curve comes from, which fixes the meaning of deformation and load.
///
/// | test | deformation | load, per width |
/// |---|---|---|
/// | tensile | strain, a ratio | force, in N/m |
/// | shear | shear angle, in rad | force, in N/m |
/// | bending | curvature, in 1/m | moment, in N |
/// | loop bending | clamp distance over specimen length, minus one | force, in N/m |
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
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
    /// Returns the name in sheets and messages: `"bending"` for [`Test::Bending`].
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Tensile => "tensile",
            Self::Shear => "shear",
            Self::Bending => "bending",
            Self::LoopBending => "loop-bending",
        }
    }

    /// Largest curvature of the standard bending test (KES-FB2), in 1/m: 2.5 1/cm.
    pub const LARGEST_CURVATURE: f64 = 250.0;
    /// Largest angle of the standard shear test (KES-FB1), in rad: 8°.
    pub const LARGEST_ANGLE: f64 = 8.0 * std::f64::consts::PI / 180.0;

    /// Returns the largest deformation of the standard test to each side, in SI. Returns `None` for
    /// a test that ends at a load, and for [`Test::LoopBending`], which has no standard.
    ///
    /// ```
    /// assert_eq!(drape_kes::Test::Bending.standard_deformation(), Some(250.0));
    /// ```
    #[must_use]
    pub fn standard_deformation(self) -> Option<f64> {
        match self {
            Self::Bending => Some(Self::LARGEST_CURVATURE),
            Self::Shear => Some(Self::LARGEST_ANGLE),
            Self::Tensile | Self::LoopBending => None,
        }
    }

    /// Returns `deformation`, in SI, as a text in the laboratory's unit: percent, degrees or 1/cm.
    ///
    /// ```
    /// assert_eq!(drape_kes::Test::Bending.describe(250.0), "2.50 1/cm");
    /// ```
    #[must_use]
    pub fn describe(self, deformation: f64) -> String {
        match self {
            Self::Tensile | Self::LoopBending => format!("{:.2} %", 100.0 * deformation),
            Self::Shear => format!("{:.2}°", deformation.to_degrees()),
            Self::Bending => format!("{:.2} 1/cm", 0.01 * deformation),
        }
    }
}

/// Yarns along which a strip was cut and loaded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Direction {
    /// Along the loom.
    Warp,
    /// Across the loom.
    Weft,
}

impl Direction {
    /// Returns the name in sheets and messages: `"warp"` or `"weft"`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Warp => "warp",
            Self::Weft => "weft",
        }
    }
}
