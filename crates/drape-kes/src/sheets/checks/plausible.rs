//! Checks of values: a value that no fabric has is an error, a value that few fabrics have is a
//! warning.

use std::ops::RangeInclusive;

use crate::sheets::file::stated::Measured;
use crate::sheets::findings::Findings;
use crate::test::Direction;
use drape_input::Quantity;

/// Bending rigidities that a fabric can have, in N·m.
///
/// Published tables are off by a factor of ten after a careless conversion, and a factor of ten in
/// B changes a drape beyond recognition. A sheet with a rigidity outside this range is refused.
/// Gauze is near 3e-7, canvas near 5e-4.
const BENDING_RIGIDITY: RangeInclusive<f64> = 1e-7..=1e-3;

/// Source of the ranges of mass and bending \[FHX22\].
const SURVEY: &str = "5th to 95th percentile of 251 measured fabrics: X. Feng, W. Huang, W. Xu, H. Wang, ACM Transactions on Graphics 41(6), 2022";
/// Source of the range of shear \[Lui08, WOR11\].
const SHEAR_SURVEY: &str = "nine in ten of the fabrics of the same mass per area, by a line through 19 fabrics: C. Luible, PhD thesis, University of Geneva, 2008; H. Wang, J. F. O'Brien, R. Ramamoorthi, ACM Transactions on Graphics 30(4), 2011";

/// 5th and 95th percentile over 251 measured fabrics: mass per area, in kg/m².
const USUAL_DENSITY: RangeInclusive<f64> = 0.041..=0.487;
/// 5th and 95th percentile over 251 measured fabrics: bending rigidity along the warp, in N·m.
const USUAL_WARP_BENDING: RangeInclusive<f64> = 1.2e-6..=1.1e-4;
/// 5th and 95th percentile over 251 measured fabrics: bending rigidity along the weft, in N·m.
const USUAL_WEFT_BENDING: RangeInclusive<f64> = 9.8e-7..=5.1e-5;
/// 5th and 95th percentile over 251 measured fabrics: bending length (B/w)^(1/3), in metres.
const USUAL_BENDING_LENGTH: RangeInclusive<f64> = 0.011..=0.033;

/// Shear stiffness of fabrics by their mass per area, over 19 fabrics \[Lui08, WOR11\]: intercept
/// and slope of `$\ln G$` against `$\ln w$`, in N/m per rad and kg/m².
const SHEAR_BY_DENSITY: [f64; 2] = [4.65, 0.574];
/// Standard deviation of `$\ln G$` about the line, with the doubt about the unit of one source.
const SHEAR_DEVIATION: f64 = 0.66;
/// Standard deviations about the mean within which nine in ten lie.
const NINE_IN_TEN: f64 = 1.645;

/// Standard gravity, in m/s².
const GRAVITY: f64 = 9.806_65;

/// Returns whether a fabric can have the bending rigidity `b`. An impossible rigidity is reported
/// with the value that was probably meant.
pub(crate) fn bending_rigidity(b: &Measured, findings: &mut Findings<'_>) -> bool {
    if BENDING_RIGIDITY.contains(&b.si) {
        return true;
    }
    let message = format!(
        "{} is {:.3e} N.m; fabrics lie between {:e} and {:e} N.m",
        b.written,
        b.si,
        BENDING_RIGIDITY.start(),
        BENDING_RIGIDITY.end()
    );
    findings.error(&b.key, message, suggestions(b));
    false
}

/// Returns the readings of the number of `b` that give the rigidity of a usual fabric, as a
/// question.
fn suggestions(b: &Measured) -> String {
    let usual_range = USUAL_WEFT_BENDING.start()..=USUAL_WARP_BENDING.end();
    let unit = Quantity::BendingRigidity.laboratory();
    let readings = [
        (b.number, format!("\"{} N.m\"", b.number)),
        (b.number * 1e-3, format!("\"{} mN.m\"", b.number)),
        (b.number * 1e-6, format!("\"{} uN.m\"", b.number)),
        (b.number * unit.factor, format!("{} in {}", b.number, unit.spelling)),
        (b.si / 10.0, format!("a tenth of it, \"{:.4e} N.m\"", b.si / 10.0)),
        (b.si * 10.0, format!("ten times it, \"{:.4e} N.m\"", b.si * 10.0)),
    ];

    let likely_readings: Vec<String> = readings
        .into_iter()
        .filter(|(si, _)| usual_range.contains(&si))
        .map(|(_, text)| text)
        .collect();
    if likely_readings.is_empty() {
        return format!("a bare number is in {}: check value and unit", unit.spelling);
    }
    format!("did you mean {}? a bare number is in {}", likely_readings.join(", or "), unit.spelling)
}

/// Masses per area that a fabric can have, in kg/m²: from a veil to a carpet.
const DENSITY: RangeInclusive<f64> = 5e-3..=5.0;

/// Reports a mass per area `w` that no fabric has, with the value that was probably meant, and
/// warns about a mass per area that few fabrics have.
pub(crate) fn density(w: &Measured, findings: &mut Findings<'_>) {
    if !DENSITY.contains(&w.si) {
        let message = format!("{} is {:.3e} kg/m2; no fabric has that", w.written, w.si);
        let readings = [("mg/cm2", 0.01), ("g/m2", 1e-3), ("kg/m2", 1.0), ("g/cm2", 10.0)];
        let likely_readings: Vec<String> = readings
            .into_iter()
            .filter(|(_, factor)| USUAL_DENSITY.contains(&(w.number * factor)))
            .map(|(unit, _)| format!("\"{} {unit}\"", w.number))
            .collect();

        let help = match likely_readings.as_slice() {
            [] => "a bare number is in mg/cm2: check value and unit".to_owned(),
            readings => {
                format!("did you mean {}? a bare number is in mg/cm2", readings.join(" or "))
            }
        };
        findings.error(&w.key, message, help);
        return;
    }

    let usual = UsualRange { name: "mass per area", unit: "kg/m2", range: USUAL_DENSITY };
    usual.check(w.si, &w.key, findings);
}

/// Warns about a bending rigidity `b` or a bending length that few fabrics have. The bending length
/// needs the mass per area `w`.
pub(crate) fn bending(
    direction: Direction,
    b: &Measured,
    w: Option<&Measured>,
    findings: &mut Findings<'_>,
) {
    let range = match direction {
        Direction::Warp => USUAL_WARP_BENDING,
        Direction::Weft => USUAL_WEFT_BENDING,
    };
    UsualRange { name: "bending rigidity", unit: "N.m", range }.check(b.si, &b.key, findings);
    if let Some(w) = w {
        let length = bending_length(b.si, w.si);
        let usual = UsualRange { name: "bending length", unit: "m", range: USUAL_BENDING_LENGTH };
        usual.check(length, &b.key, findings);
    }
}

/// Returns the publication of the usual range of the value `symbol` of the sheet; `None` where
/// there is no range.
pub(crate) fn usual_source(symbol: &str) -> Option<&'static str> {
    match symbol {
        "W" | "B" | "c" => Some(SURVEY),
        "G" => Some(SHEAR_SURVEY),
        _ => None,
    }
}

/// Returns the range of the value `symbol` that nine in ten fabrics have, in SI. The symbol `c`
/// stands for the bending length. `None` where the value was not measured on many fabrics.
pub(crate) fn usual_range(
    symbol: &str,
    direction: Option<Direction>,
    density: Option<f64>,
) -> Option<RangeInclusive<f64>> {
    match (symbol, direction) {
        ("W", _) => Some(USUAL_DENSITY),
        ("B", Some(Direction::Warp)) => Some(USUAL_WARP_BENDING),
        ("B", Some(Direction::Weft)) => Some(USUAL_WEFT_BENDING),
        ("c", _) => Some(USUAL_BENDING_LENGTH),
        ("G", _) => {
            let [intercept, slope] = SHEAR_BY_DENSITY;
            let middle = intercept + slope * density?.ln();
            let apart = NINE_IN_TEN * SHEAR_DEVIATION;
            Some((middle - apart).exp()..=(middle + apart).exp())
        }
        _ => None,
    }
}

/// Returns the bending length `$(B/w)^{1/3}$`, in m, of a `rigidity` in N·m and a `density`, the
/// mass per area in kg/m².
pub(crate) fn bending_length(rigidity: f64, density: f64) -> f64 {
    (rigidity / (density * GRAVITY)).cbrt()
}

/// Range of a quantity over most fabrics, in SI.
struct UsualRange {
    name: &'static str,
    unit: &'static str,
    range: RangeInclusive<f64>,
}

impl UsualRange {
    /// Warns about a `value` outside the range.
    fn check(&self, value: f64, key: &str, findings: &mut Findings<'_>) {
        let Self { name, unit, range } = self;
        if range.contains(&value) {
            return;
        }
        let message = format!(
            "a {name} of {value:.3e} {unit} is unusual; nine fabrics in ten have {:.2e} to {:.2e}",
            range.start(),
            range.end()
        );
        findings.warn(key, message, "check the value and its unit");
    }
}
