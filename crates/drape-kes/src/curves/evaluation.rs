//! All KES values of a curve, in laboratory units, each with the reason where it is missing.

use crate::curves::curve::Curve;
use crate::curves::loop_values::{BendingPoints, ShearPoints};
use crate::error::Error;
use crate::symbol::Symbol;

/// Points at which the values of a curve are read.
///
/// ```
/// use drape_kes::{BendingPoints, Curve, Direction, EvaluationPoints, ShearPoints, Symbol, Test};
///
/// let points = EvaluationPoints {
///     maximum_tension: 490.0,
///     bending: BendingPoints::default(),
///     shear: ShearPoints::default(),
/// };
/// // A strip stretched by 4 % along a straight line, and released along another.
/// let strain = vec![0.0, 0.04, 0.01];
/// let curve = Curve::new(Test::Tensile, Direction::Warp, strain, vec![0.0, 490.0, 0.0])?;
/// let read = curve.values(&points).swap_remove(0);
/// assert!(read.symbol == Symbol::Lt && (read.value? - 1.0).abs() < 1e-12);
/// # Ok::<(), drape_kes::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EvaluationPoints {
    /// FM: load at which the tensile test reverses, in N/m.
    pub maximum_tension: f64,
    /// Curvatures at which B and 2HB are read.
    pub bending: BendingPoints,
    /// Angles at which G, 2HG and 2HG5 are read.
    pub shear: ShearPoints,
}

/// KES value that was read from a curve.
#[derive(Debug)]
pub struct CurveValue {
    /// Symbol of the value.
    pub symbol: Symbol,
    /// Value in the laboratory's unit, or the reason why the curve has none.
    pub value: Result<f64, Error>,
}

/// Largest relative difference between a curve's largest load and FM with which EM, WT, LT and RT
/// of the curve count as the values at FM.
///
/// Machines overshoot by about this part, and EM moves by half of it. Two specimens differ by more.
pub(crate) const NEAR_MAXIMUM: f64 = 0.05;

impl Curve {
    /// Returns the KES values of the curve's test at `points`, in laboratory units.
    ///
    /// A loop-bending curve has no value, because its rigidity needs a model of the arch.
    #[must_use]
    pub fn values(&self, points: &EvaluationPoints) -> Vec<CurveValue> {
        let mut values = Vec::new();
        for symbol in Symbol::ALL.into_iter().filter(|symbol| symbol.test() == self.test) {
            let value = self.value(symbol, points).map(|value| value / symbol.factor());
            values.push(CurveValue { symbol, value });
        }
        values
    }

    /// Returns the value of `symbol` at `points`, in SI.
    fn value(&self, symbol: Symbol, points: &EvaluationPoints) -> Result<f64, Error> {
        let EvaluationPoints { maximum_tension, bending, shear } = points;
        match symbol {
            Symbol::B => self.loop_slope(bending.slope),
            Symbol::TwoHb => self.loop_width(bending.width),
            Symbol::G => self.loop_slope(shear.slope),
            Symbol::TwoHg => self.loop_width(shear.width),
            Symbol::TwoHg5 => self.loop_width(shear.wide),
            Symbol::Lt | Symbol::Wt | Symbol::Rt | Symbol::Em => {
                if self.slack {
                    return Err(Error::SlackStrip);
                }

                let values = self.tensile_values()?;
                let (reached, fm) = (values.maximum_tension, *maximum_tension);
                if !((reached / fm - 1.0).abs() <= NEAR_MAXIMUM) {
                    return Err(Error::OtherMaximumTension { reached, fm });
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
    use crate::test::{Direction, Test};

    fn points(maximum_tension: f64) -> EvaluationPoints {
        EvaluationPoints {
            maximum_tension,
            bending: BendingPoints::default(),
            shear: ShearPoints::default(),
        }
    }

    #[test]
    fn a_tensile_curve_has_its_values_in_the_laboratorys_units() {
        let strain = vec![0.0, 0.05, 0.02];
        let load = vec![0.0, 490.3325, 0.0];
        let curve = Curve::new(Test::Tensile, Direction::Warp, strain, load).unwrap();
        let values = curve.values(&points(490.3325));
        // A line: LT 1, WT ½·500·0.05 gf·cm/cm², RT the triangle of 3 over that of 5 percent.
        let exact = [(Symbol::Lt, 1.0), (Symbol::Wt, 12.5), (Symbol::Rt, 60.0), (Symbol::Em, 5.0)];
        assert_eq!(values.len(), exact.len());
        for (read, (wanted, exact)) in values.iter().zip(exact) {
            let found = read.value.as_ref().unwrap();
            assert!(read.symbol == wanted && (found / exact - 1.0).abs() < 1e-12, "{values:?}");
        }
    }

    #[test]
    fn each_value_that_cannot_be_had_says_why() {
        let strain = vec![0.0, 0.05];
        let mut curve =
            Curve::new(Test::Tensile, Direction::Warp, strain, vec![0.0, 490.3325]).unwrap();
        let of = |curve: &Curve, maximum: f64| {
            let values = curve.values(&points(maximum)).into_iter();
            values.map(|read| (read.symbol, read.value.err())).collect::<Vec<_>>()
        };
        let whole = of(&curve, 490.3325);
        assert!(matches!(whole[2], (Symbol::Rt, Some(Error::NoRecovery))), "{whole:?}");
        assert!(whole[3].1.is_none(), "{whole:?}");
        let short = of(&curve, 600.0);
        assert!(matches!(short[3].1, Some(Error::OtherMaximumTension { .. })), "{short:?}");
        curve.slack = true;
        assert!(matches!(of(&curve, 490.3325)[0].1, Some(Error::SlackStrip)));
        let bend = vec![0.0, 60.0, -60.0, 60.0];
        let curve = Curve::new(Test::Bending, Direction::Warp, bend.clone(), bend).unwrap();
        let values = of(&curve, 490.3325);
        assert!(matches!(values[0], (Symbol::B, Some(Error::OutOfRange { .. }))), "{values:?}");
    }
}
