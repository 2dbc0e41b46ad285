//! KES values of a sheet, of its curves and of the identified laws, side by side.

use drape_fabric::Fabric;
use drape_kes::{Direction, EvaluationPoints, Sheet, Symbol, Test};

use crate::settings::FitSettings;
use crate::values::simulated::fabric_values;

/// Relative difference of two values that is reported.
///
/// Specimens of one fabric differ by up to 5 %. A larger difference comes from another specimen,
/// another evaluation, or a unit.
const DISAGREEMENT: f64 = 0.05;

/// One KES value from sheet, curve and law, in the laboratory's unit.
#[derive(Clone, Debug, PartialEq)]
pub struct ValueComparison {
    /// Direction of the value.
    pub direction: Direction,
    /// Symbol of the value.
    pub symbol: Symbol,
    /// Value printed on the sheet.
    pub sheet: Option<f64>,
    /// Value of the first curve of its test and direction, or the reason why there is none.
    pub curve: Result<f64, String>,
    /// Value of the identified law.
    pub law: Option<f64>,
}

impl ValueComparison {
    /// Returns a warning if the values of `sheet` and `curve` differ by more than 5 %.
    #[must_use]
    pub fn warning(&self) -> Option<String> {
        let (sheet, curve) = (self.sheet?, *self.curve.as_ref().ok()?);
        let apart = (curve / sheet - 1.0).abs();
        let (direction, symbol) = (self.direction.name(), self.symbol.name());
        (apart > DISAGREEMENT || !apart.is_finite()).then(|| {
            format!(
                "{direction} {symbol}: the sheet says {sheet:.4} {unit}, its curve {curve:.4}; the law \
                 follows the curve",
                unit = self.symbol.unit()
            )
        })
    }
}

/// Compares all KES values of `fabric` with the values of its `sheet` and of the sheet's curves.
#[must_use]
pub fn compare_values(
    sheet: &Sheet,
    fabric: &Fabric,
    settings: &FitSettings,
) -> Vec<ValueComparison> {
    let points = settings.evaluation_points(sheet);
    let mut comparisons = Vec::new();
    for direction in [Direction::Warp, Direction::Weft] {
        let law = fabric_values(fabric, direction, &points);
        for symbol in Symbol::ALL {
            comparisons.push(ValueComparison {
                direction,
                symbol,
                sheet: sheet.values(direction).get(symbol),
                curve: curve_value(sheet, direction, symbol, &points),
                law: law.get(symbol).filter(|_| reaches(sheet, direction, symbol, &points)),
            });
        }
    }
    comparisons
}

/// Returns the value of `symbol` of the first curve of its test and `direction`, or the reason why
/// there is none.
fn curve_value(
    sheet: &Sheet,
    direction: Direction,
    symbol: Symbol,
    points: &EvaluationPoints,
) -> Result<f64, String> {
    let test = symbol.test();
    let curve = sheet.curves_of(test, direction).next();
    let curve = curve.ok_or_else(|| format!("no {} curve was measured", test.name()))?;
    let read = curve.values(points).into_iter().find(|read| read.symbol == symbol);
    let read = read.expect("a curve has the values of its test");
    read.value.map_err(|error| error.to_string())
}

/// Part of FM that a tensile curve must reach, so that its law has values at FM.
const REACHED: f64 = 0.95;

/// Returns whether the curve of a law reaches the point where the value `symbol` is read. The
/// tensile values of a law beyond its curve are a guess. A law without a curve was made from
/// values.
fn reaches(sheet: &Sheet, direction: Direction, symbol: Symbol, points: &EvaluationPoints) -> bool {
    let curve = sheet.curves_of(symbol.test(), direction).next();
    let reached = curve.filter(|curve| curve.test == Test::Tensile && !curve.slack);
    reached.is_none_or(|curve| curve.load_range().high >= REACHED * points.maximum_tension)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_disagreement_of_more_than_one_in_twenty_is_named() {
        let row = |sheet: f64, curve: f64| ValueComparison {
            direction: Direction::Warp,
            symbol: Symbol::TwoHb,
            sheet: Some(sheet),
            curve: Ok(curve),
            law: None,
        };
        assert_eq!(row(0.05, 0.052).warning(), None);
        let warning = row(0.05, 0.06).warning().unwrap();
        assert!(warning.starts_with("warp 2HB: the sheet says 0.0500 gf·cm/cm"), "{warning}");
        assert!(row(0.0, 0.06).warning().is_some());
    }
}
