use serde::Serialize;

use crate::check;
use crate::error::ReportError;
use crate::law_report::{LawReport, Limits};
use crate::parameter::Units;
use crate::{fit_html, fit_text};

/// A report of the identification of one fabric: everything that tells whether to believe it.
///
/// All numbers are in SI; units that stand beside SI are given with their size. The page is drawn from this
/// data alone, so the same data gives the same bytes. It serialises as the machine's report.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct FitPage {
    /// The name of the sheet.
    pub name: String,
    /// Who measured what, when, under which licence.
    pub source: String,
    /// What the report was made from, as in "sheet.toml, blake3 0123abcd".
    pub provenance: String,
    /// What made the report, as in "drape 0.1.0".
    pub version: String,
    /// Numbers that were taken as given: mass, thickness, test conditions.
    pub quantities: Vec<Quantity>,
    /// The fitted laws in the order of the report.
    pub laws: Vec<LawReport>,
    /// The KES values, given and recomputed.
    pub values: Vec<KesValue>,
    /// What was assumed because nothing measured it.
    pub assumed: Vec<String>,
    /// What a reader must know before use.
    pub warnings: Vec<String>,
    /// What was repaired in the data, and why that was safe.
    pub repairs: Vec<String>,
    /// Limits beyond which the report points its finger.
    pub limits: Limits,
}

/// A number that was given, not fitted.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Quantity {
    /// What it is, as in "mass per area".
    pub name: String,
    /// Its value, in SI.
    pub value: f64,
    /// Its units.
    pub units: Units,
    /// Where it comes from, as in "sheet"; may be empty.
    pub origin: String,
}

/// A KES value as the sheet gives it, and as it follows from the curve and from the fitted law, in SI.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct KesValue {
    /// The laboratory's symbol, as in "2HB".
    pub symbol: String,
    /// What it is, as in "bending loop width".
    pub name: String,
    /// The direction, as in "warp"; may be empty.
    pub direction: String,
    /// Its units.
    pub units: Units,
    /// As the sheet gives it.
    pub sheet: Option<f64>,
    /// Recomputed from the measured curve.
    pub curve: Option<f64>,
    /// Recomputed from the fitted law.
    pub law: Option<f64>,
}

impl KesValue {
    /// How far the curve's and the law's values are from the reference, as ratios of the reference.
    ///
    /// The reference is the sheet's value; where there is none, the law is compared with the curve.
    pub fn differences(&self) -> [Option<f64>; 2] {
        let from = |reference: Option<f64>, value: Option<f64>| {
            let reference = reference.filter(|reference| *reference != 0.0)?;
            Some((value? - reference) / reference.abs()).filter(|ratio| ratio.is_finite())
        };
        [from(self.sheet, self.curve), from(self.sheet.or(self.curve), self.law)]
    }
}

impl FitPage {
    /// Refuses an empty report, numbers that are none and texts that cannot be shown.
    ///
    /// The page and the text check by themselves; call it before serialising.
    pub fn check(&self) -> Result<(), ReportError> {
        if self.laws.is_empty() && self.values.is_empty() && self.quantities.is_empty() {
            return Err(ReportError::EmptyReport { name: self.name.clone() });
        }
        let head = [&self.name, &self.source, &self.provenance, &self.version];
        let lists = [&self.assumed, &self.warnings, &self.repairs];
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

    /// The report as one HTML page that needs nothing else: no network, no fonts, no other file.
    pub fn to_html(&self) -> Result<String, ReportError> {
        self.check()?;
        Ok(fit_html::render(self))
    }

    /// The report as text for a terminal, in columns.
    pub fn to_text(&self) -> Result<String, ReportError> {
        self.check()?;
        Ok(fit_text::render(self))
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
