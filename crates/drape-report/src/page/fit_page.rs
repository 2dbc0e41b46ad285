//! Report of a fit, as plain data. `fit_html` and `fit_text` write the report.

use serde::Serialize;

use super::law_report::{LawReport, Limits};
use crate::check;
use crate::error::Error;
use crate::parameter::Units;

/// Report of the identification of one fabric, with everything needed to judge it.
///
/// All numbers are in SI. A number in another unit comes with the size of the unit. The page
/// depends on this data alone, so equal data gives equal bytes. Serialised, the data is the report
/// for programs.
///
/// ```
/// use drape_report::{FitPage, Quantity, Units};
///
/// let mass = Quantity {
///     name: "mass per area".to_owned(),
///     value: 0.1056,
///     units: Units::si("kg/m²").with_kes("mg/cm²", 0.01),
///     origin: "sheet".to_owned(),
/// };
/// let page = FitPage { name: "poplin".to_owned(), quantities: vec![mass], ..FitPage::default() };
/// assert!(page.to_text()?.contains("10.56  mg/cm²"));
/// # Ok::<(), drape_report::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct FitPage {
    /// Name of the sheet.
    pub name: String,
    /// Source: who measured the fabric, when, and under which licence.
    pub source: String,
    /// Files from which the report was made, as in "sheet.toml, blake3 0123abcd".
    pub provenance: String,
    /// Program that made the report, as in "drape 0.1.0".
    pub version: String,
    /// Given numbers: mass, thickness, test conditions.
    pub quantities: Vec<Quantity>,
    /// Fitted laws in the order of the report.
    pub laws: Vec<LawReport>,
    /// KES values, given and recomputed.
    pub values: Vec<KesValue>,
    /// Curve files, each with its interpretation and the reason.
    pub readings: Vec<String>,
    /// Assumptions in place of measurements.
    pub assumed: Vec<String>,
    /// Warnings for the reader.
    pub warnings: Vec<String>,
    /// Repairs of the data, each with the reason why it was safe.
    pub repairs: Vec<String>,
    /// Limits beyond which the report marks a number.
    pub limits: Limits,
}

/// Number that was given, not fitted.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Quantity {
    /// Name, as in "mass per area".
    pub name: String,
    /// Value, in SI.
    pub value: f64,
    /// Units.
    pub units: Units,
    /// Origin, as in "sheet". The text may be empty.
    pub origin: String,
}

/// KES value in SI: of the sheet, of the measured curve, and of the fitted law.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct KesValue {
    /// Symbol of the laboratory, as in "2HB".
    pub symbol: String,
    /// Name, as in "bending loop width".
    pub name: String,
    /// Direction, as in "warp". The text may be empty.
    pub direction: String,
    /// Units.
    pub units: Units,
    /// Value of the sheet.
    pub sheet: Option<f64>,
    /// Value from the measured curve.
    pub curve: Option<f64>,
    /// Value from the fitted law.
    pub law: Option<f64>,
}

impl KesValue {
    /// Returns the relative differences of the values of `curve` and `law` from a reference.
    ///
    /// The reference is the value of `sheet`. Without a value of the sheet, `law` is compared with
    /// `curve`.
    #[must_use]
    pub fn differences(&self) -> [Option<f64>; 2] {
        let from = |reference: Option<f64>, value: Option<f64>| {
            let reference = reference.filter(|reference| *reference != 0.0)?;
            Some((value? - reference) / reference.abs()).filter(|ratio| ratio.is_finite())
        };
        [from(self.sheet, self.curve), from(self.sheet.or(self.curve), self.law)]
    }
}

impl FitPage {
    /// Refuses an empty report, numbers that are not finite and texts that cannot be shown.
    ///
    /// [`FitPage::to_html`] and [`FitPage::to_text`] call this method. Call it before serialising.
    ///
    /// # Errors
    /// The first fault.
    pub fn check(&self) -> Result<(), Error> {
        if self.laws.is_empty() && self.values.is_empty() && self.quantities.is_empty() {
            return Err(Error::EmptyReport { name: self.name.clone() });
        }

        let head = [&self.name, &self.source, &self.provenance, &self.version];
        let lists = [&self.readings, &self.assumed, &self.warnings, &self.repairs];
        for text in head.into_iter().chain(lists.into_iter().flatten()) {
            check::text("a text of the report", text)?;
        }

        for quantity in &self.quantities {
            let name = &quantity.name;
            check::text("the name of a quantity", name)?;
            check::text("the origin of a quantity", &quantity.origin)?;
            check::number(|| name.clone(), quantity.value)?;
            quantity.units.check()?;
        }
        for law in &self.laws {
            law.check()?;
        }

        for value in &self.values {
            for text in [&value.symbol, &value.name, &value.direction] {
                check::text("a text of a KES value", text)?;
            }
            value.units.check()?;
            for number in [value.sheet, value.curve, value.law].into_iter().flatten() {
                check::number(|| format!("{} {}", value.symbol, value.direction), number)?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(sheet: Option<f64>, curve: Option<f64>, law: Option<f64>) -> KesValue {
        KesValue {
            symbol: "B".to_owned(),
            name: "bending rigidity".to_owned(),
            direction: "warp".to_owned(),
            units: Units::si("N·m"),
            sheet,
            curve,
            law,
        }
    }

    #[test]
    fn values_are_compared_with_the_sheet_and_else_with_the_curve() {
        let near = |[a, b]: [Option<f64>; 2], expected: [Option<f64>; 2]| {
            let same = |x: Option<f64>, y: Option<f64>| match (x, y) {
                (Some(x), Some(y)) => (x - y).abs() < 1e-12,
                (x, y) => x == y,
            };
            assert!(same(a, expected[0]) && same(b, expected[1]), "{a:?} {b:?}");
        };
        near(value(Some(2.0), Some(2.2), Some(1.9)).differences(), [Some(0.1), Some(-0.05)]);
        near(value(None, Some(2.0), Some(1.9)).differences(), [None, Some(-0.05)]);
        near(value(Some(0.0), Some(2.0), None).differences(), [None, None]);
    }
}
