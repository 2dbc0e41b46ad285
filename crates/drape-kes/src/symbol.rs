//! Symbols of the KES values, with their units and tests \[Kaw80\].

use crate::test::Test;
use drape_input::Quantity;

/// Symbol of a KES value of one direction.
///
/// ```
/// use drape_kes::{Symbol, Test};
///
/// assert_eq!((Symbol::TwoHb.name(), Symbol::TwoHb.test()), ("2HB", Test::Bending));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Symbol {
    /// Bending rigidity per width.
    B,
    /// Width of the bending loop.
    TwoHb,
    /// Shear stiffness.
    G,
    /// Width of the shear loop at the small angle.
    TwoHg,
    /// Width of the shear loop at the large angle.
    TwoHg5,
    /// Linearity of the tensile curve.
    Lt,
    /// Tensile work.
    Wt,
    /// Tensile resilience.
    Rt,
    /// Extension at the maximum load.
    Em,
}

impl serde::Serialize for Symbol {
    /// Writes the symbol as laboratories write it.
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

impl Symbol {
    /// All symbols, in the order in which laboratories print them.
    pub const ALL: [Self; 9] = [
        Self::B,
        Self::TwoHb,
        Self::G,
        Self::TwoHg,
        Self::TwoHg5,
        Self::Lt,
        Self::Wt,
        Self::Rt,
        Self::Em,
    ];

    /// Returns the symbol as laboratories write it: `"2HB"` for [`Symbol::TwoHb`]. The name is also
    /// the key in a sheet.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::B => "B",
            Self::TwoHb => "2HB",
            Self::G => "G",
            Self::TwoHg => "2HG",
            Self::TwoHg5 => "2HG5",
            Self::Lt => "LT",
            Self::Wt => "WT",
            Self::Rt => "RT",
            Self::Em => "EM",
        }
    }

    /// Returns the laboratory's unit, such as `"gf·cm²/cm"` for `B`. The unit of `LT` is empty.
    #[must_use]
    pub fn unit(self) -> &'static str {
        match self {
            Self::B => "gf·cm²/cm",
            Self::TwoHb => "gf·cm/cm",
            Self::G => "gf/(cm·deg)",
            Self::TwoHg | Self::TwoHg5 => "gf/cm",
            Self::Lt => "",
            Self::Wt => "gf·cm/cm²",
            Self::Rt | Self::Em => "%",
        }
    }

    /// Returns the test that gives the value: [`Test::Bending`] for `B` and `2HB`.
    #[must_use]
    pub fn test(self) -> Test {
        match self {
            Self::B | Self::TwoHb => Test::Bending,
            Self::G | Self::TwoHg | Self::TwoHg5 => Test::Shear,
            Self::Lt | Self::Wt | Self::Rt | Self::Em => Test::Tensile,
        }
    }

    /// Returns the size of the laboratory's unit in SI: a value times this factor is in SI. The
    /// factor of `LT` is 1.
    #[must_use]
    pub fn factor(self) -> f64 {
        let quantity = match self {
            Self::B => Quantity::BendingRigidity,
            Self::TwoHb => Quantity::MomentPerWidth,
            Self::G => Quantity::ShearStiffness,
            Self::TwoHg | Self::TwoHg5 => Quantity::ForcePerWidth,
            Self::Lt => return 1.0,
            Self::Wt => Quantity::WorkPerArea,
            Self::Rt | Self::Em => Quantity::Ratio,
        };
        quantity.laboratory().factor
    }
}
