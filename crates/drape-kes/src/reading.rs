//! All KES values that a curve has, in the laboratory's units, each with the reason where it has none.

use crate::unit::Quantity;
use crate::{BendingPoints, Curve, Error, ShearPoints, Test, Values};

/// A KES value of one direction.
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

impl Symbol {
    /// All of them, in the order in which laboratories print them.
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

    /// The symbol as it is written, which is its key in a sheet.
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

    /// The laboratory's unit; LT has none.
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

    /// The test whose curve has the value.
    #[must_use]
    pub fn test(self) -> Test {
        match self {
            Self::B | Self::TwoHb => Test::Bending,
            Self::G | Self::TwoHg | Self::TwoHg5 => Test::Shear,
            Self::Lt | Self::Wt | Self::Rt | Self::Em => Test::Tensile,
        }
    }

    /// One of the laboratory's units, in SI.
    fn factor(self) -> f64 {
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

impl Values {
    /// A value by its symbol, in the laboratory's unit.
    #[must_use]
    pub fn get(&self, symbol: Symbol) -> Option<f64> {
        match symbol {
            Symbol::B => self.b,
            Symbol::TwoHb => self.two_hb,
            Symbol::G => self.g,
            Symbol::TwoHg => self.two_hg,
            Symbol::TwoHg5 => self.two_hg5,
            Symbol::Lt => self.lt,
            Symbol::Wt => self.wt,
            Symbol::Rt => self.rt,
            Symbol::Em => self.em,
        }
    }

    /// The place of a value.
    pub fn get_mut(&mut self, symbol: Symbol) -> &mut Option<f64> {
        match symbol {
            Symbol::B => &mut self.b,
            Symbol::TwoHb => &mut self.two_hb,
            Symbol::G => &mut self.g,
            Symbol::TwoHg => &mut self.two_hg,
            Symbol::TwoHg5 => &mut self.two_hg5,
            Symbol::Lt => &mut self.lt,
            Symbol::Wt => &mut self.wt,
            Symbol::Rt => &mut self.rt,
            Symbol::Em => &mut self.em,
        }
    }
}

/// Where the values of a curve are read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    /// FM: the load at which the tensile test turns back, in N/m.
    pub maximum_tension: f64,
    /// Where B and 2HB are read.
    pub bending: BendingPoints,
    /// Where G, 2HG and 2HG5 are read.
    pub shear: ShearPoints,
}

/// Distance of a curve's largest load from FM, relative, up to which its EM, WT, LT and RT are those of FM.
///
/// Machines overshoot by as much, and EM moves by half of it: less than two specimens differ by.
const NEAR_MAXIMUM: f64 = 0.05;

impl Curve {
    /// The KES values of the curve's test in the laboratory's units, each with the reason where it has none.
    ///
    /// A loop-bending curve has none: its rigidity takes a model of the arch.
    #[must_use]
    pub fn values(&self, reading: &Reading) -> Vec<(Symbol, Result<f64, Error>)> {
        let symbols = Symbol::ALL.into_iter().filter(|symbol| symbol.test() == self.test);
        let read = |symbol: Symbol| {
            let value = self.value(symbol, reading);
            (symbol, value.map(|value| value / symbol.factor()))
        };
        symbols.map(read).collect()
    }

    /// One value, in SI.
    fn value(&self, symbol: Symbol, reading: &Reading) -> Result<f64, Error> {
        let Reading { maximum_tension, bending, shear } = reading;
        match symbol {
            Symbol::B => self.loop_slope(bending.slope),
            Symbol::TwoHb => self.loop_width(bending.width),
            Symbol::G => self.loop_slope(shear.slope),
            Symbol::TwoHg => self.loop_width(shear.width),
            Symbol::TwoHg5 => self.loop_width(shear.wide),
            Symbol::Lt | Symbol::Wt | Symbol::Rt | Symbol::Em => {
                if self.slack {
                    return Err(Error::Slack);
                }
                let values = self.tensile_values()?;
                let (reached, wanted) = (values.maximum_tension, *maximum_tension);
                if !((reached / wanted - 1.0).abs() <= NEAR_MAXIMUM) {
                    return Err(Error::OtherLoad { reached, wanted });
                }
                match symbol {
                    Symbol::Lt => Ok(values.linearity),
                    Symbol::Wt => Ok(values.work),
                    Symbol::Em => Ok(values.extension),
                    _ => values.resilience.ok_or(Error::NoRecovery),
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Direction;

    fn reading(maximum_tension: f64) -> Reading {
        Reading {
            maximum_tension,
            bending: BendingPoints::default(),
            shear: ShearPoints::default(),
        }
    }

    #[test]
    fn a_pull_has_its_values_in_the_laboratorys_units() {
        let strain = vec![0.0, 0.05, 0.02];
        let load = vec![0.0, 490.3325, 0.0];
        let curve = Curve::new(Test::Tensile, Direction::Warp, strain, load).unwrap();
        let values = curve.values(&reading(490.3325));
        // A line: LT 1, WT ½·500·0.05 gf·cm/cm², RT the triangle of 3 over that of 5 percent.
        let exact = [(Symbol::Lt, 1.0), (Symbol::Wt, 12.5), (Symbol::Rt, 60.0), (Symbol::Em, 5.0)];
        assert_eq!(values.len(), exact.len());
        for ((symbol, found), (wanted, exact)) in values.iter().zip(exact) {
            let found = found.as_ref().unwrap();
            assert!(*symbol == wanted && (found / exact - 1.0).abs() < 1e-12, "{values:?}");
        }
    }

    #[test]
    fn each_value_that_cannot_be_had_says_why() {
        let strain = vec![0.0, 0.05];
        let mut curve =
            Curve::new(Test::Tensile, Direction::Warp, strain, vec![0.0, 490.3325]).unwrap();
        let of = |curve: &Curve, maximum: f64| {
            let values = curve.values(&reading(maximum)).into_iter();
            values.map(|(symbol, value)| (symbol, value.err())).collect::<Vec<_>>()
        };
        let whole = of(&curve, 490.3325);
        assert!(matches!(whole[2], (Symbol::Rt, Some(Error::NoRecovery))), "{whole:?}");
        assert!(whole[3].1.is_none(), "{whole:?}");
        let short = of(&curve, 600.0);
        assert!(matches!(short[3].1, Some(Error::OtherLoad { .. })), "{short:?}");
        curve.slack = true;
        assert!(matches!(of(&curve, 490.3325)[0].1, Some(Error::Slack)));
        let bend = vec![0.0, 60.0, -60.0, 60.0];
        let curve = Curve::new(Test::Bending, Direction::Warp, bend.clone(), bend).unwrap();
        let values = of(&curve, 490.3325);
        assert!(matches!(values[0], (Symbol::B, Some(Error::OutOfRange { .. }))), "{values:?}");
    }
}
