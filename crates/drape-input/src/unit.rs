//! Units of measurement as people write them, and their factors to SI.
//!
//! The workspace has no other table of units. `given` uses it to read the quantities of scenes,
//! fabrics and patterns, and `drape-kes` uses it to read the quantities of sheets and curves.

use crate::diagnostic::value_error::ValueError;
use crate::figure::excerpt;
use crate::spelling::closest;

/// Standard gram-force, in newtons.
///
/// The reading of a balance depends on the local gravity. The unit is defined as 980.665 dyn.
const GRAM_FORCE: f64 = 9.806_65e-3;

/// Inch, in metres.
const INCH: f64 = 0.0254;

/// Standard pound-force, in newtons.
const POUND_FORCE: f64 = 4.448_221_615_260_5;

/// Ounce of avoirdupois over a square yard, in kg/m².
const OUNCE_PER_SQUARE_YARD: f64 = 0.028_349_523_125 / (0.9144 * 0.9144);

/// One degree, in radians.
const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// Kind of quantity, which fixes the admissible units.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Ratio: strain, linearity, resilience.
    Ratio,
    /// Angle, in radians.
    Angle,
    /// Length, in metres.
    Length,
    /// Curvature, in 1/m.
    Curvature,
    /// Force, in newtons.
    Force,
    /// Force per width, in N/m.
    ForcePerWidth,
    /// Moment, in N·m.
    Moment,
    /// Moment per width, in newtons.
    MomentPerWidth,
    /// Bending rigidity per width, in N·m.
    BendingRigidity,
    /// Shear stiffness, in N/(m·rad).
    ShearStiffness,
    /// Work per area, in J/m².
    WorkPerArea,
    /// Pressure, in Pa.
    Pressure,
    /// Mass per area, in kg/m².
    MassPerArea,
    /// Height of a surface, in metres.
    Roughness,
    /// Time, in s.
    Time,
    /// Speed, in m/s.
    Speed,
    /// Angular speed, in rad/s.
    AngularSpeed,
    /// Acceleration, in m/s².
    Acceleration,
    /// Density, in kg/m³.
    Density,
    /// Pressure per distance, in N/m³.
    PressurePerDistance,
}

impl Quantity {
    /// Returns the name of the quantity in messages, such as `force per width`.
    pub fn name(self) -> &'static str {
        // A name begins with a small letter, for it stands inside a sentence.
        match self {
            Self::Ratio => "ratio",
            Self::Angle => "angle",
            Self::Length => "length",
            Self::Curvature => "curvature",
            Self::Force => "force",
            Self::ForcePerWidth => "force per width",
            Self::Moment => "moment",
            Self::MomentPerWidth => "moment per width",
            Self::BendingRigidity => "bending rigidity per width",
            Self::ShearStiffness => "shear stiffness",
            Self::WorkPerArea => "work per area",
            Self::Pressure => "pressure",
            Self::MassPerArea => "mass per area",
            Self::Roughness => "roughness",
            Self::Time => "time",
            Self::Speed => "speed",
            Self::AngularSpeed => "angular speed",
            Self::Acceleration => "acceleration",
            Self::Density => "density",
            Self::PressurePerDistance => "pressure per distance",
        }
    }

    /// Returns the units of this quantity with their factors to SI. The laboratory's unit is the
    /// first.
    ///
    /// Spellings have the form that [`normal_form`] returns: `.` between factors, digits for
    /// powers.
    fn units(self) -> &'static [(&'static str, f64)] {
        match self {
            Self::Ratio => &[("%", 0.01), ("-", 1.0), ("1", 1.0), ("m/m", 1.0), ("mm/mm", 1.0)],
            Self::Angle => &[("deg", DEGREE), ("rad", 1.0), ("mrad", 1e-3)],
            Self::Length => &[
                ("mm", 1e-3),
                ("cm", 1e-2),
                ("m", 1.0),
                ("um", 1e-6),
                ("in", INCH),
                ("inch", INCH),
            ],
            Self::Curvature => &[
                ("1/cm", 1e2),
                ("cm-1", 1e2),
                ("1/m", 1.0),
                ("m-1", 1.0),
                ("1/mm", 1e3),
                ("mm-1", 1e3),
            ],
            Self::Force => &[
                ("gf", GRAM_FORCE),
                ("N", 1.0),
                ("mN", 1e-3),
                ("cN", 1e-2),
                ("kgf", 1e3 * GRAM_FORCE),
                ("kN", 1e3),
                ("lbf", POUND_FORCE),
                ("dyn", 1e-5),
                // Balances and older instruments print a force as the mass with this weight.
                ("g", GRAM_FORCE),
                ("kg", 1e3 * GRAM_FORCE),
            ],
            Self::ForcePerWidth => &[
                ("gf/cm", 1e2 * GRAM_FORCE),
                ("N/m", 1.0),
                ("mN/m", 1e-3),
                ("N/cm", 1e2),
                ("cN/cm", 1.0),
                ("mN/mm", 1.0),
                ("N/mm", 1e3),
                ("kgf/m", 1e3 * GRAM_FORCE),
                ("kgf/cm", 1e5 * GRAM_FORCE),
                ("gf/mm", 1e3 * GRAM_FORCE),
                ("kN/m", 1e3),
                ("N/5cm", 20.0),
                ("lbf/in", POUND_FORCE / INCH),
                ("g/cm", 1e2 * GRAM_FORCE),
                ("mN/cm", 1e-1),
            ],
            Self::Moment => &[
                ("gf.cm", 1e-2 * GRAM_FORCE),
                ("N.m", 1.0),
                ("mN.m", 1e-3),
                ("mN.mm", 1e-6),
                ("uN.m", 1e-6),
                ("N.mm", 1e-3),
                ("N.cm", 1e-2),
                ("gf.mm", 1e-3 * GRAM_FORCE),
                ("g.cm", 1e-2 * GRAM_FORCE),
            ],
            Self::MomentPerWidth => &[
                ("gf.cm/cm", GRAM_FORCE),
                ("N.m/m", 1.0),
                ("mN.m/m", 1e-3),
                ("mN.mm/mm", 1e-3),
                ("mN.cm/cm", 1e-3),
                ("N", 1.0),
                ("mN", 1e-3),
                ("N.cm/cm", 1.0),
                ("N.mm/mm", 1.0),
                ("gf.mm/mm", GRAM_FORCE),
                ("g.cm/cm", GRAM_FORCE),
                ("cN.cm/cm", 1e-2),
                ("uN.m/m", 1e-6),
                ("cN", 1e-2),
            ],
            Self::BendingRigidity => &[
                ("gf.cm2/cm", 1e-2 * GRAM_FORCE),
                ("N.m", 1.0),
                ("N.m2/m", 1.0),
                ("mN.m", 1e-3),
                ("uN.m", 1e-6),
                ("mN.mm", 1e-6),
                ("mN.cm2/cm", 1e-5),
                ("gf.cm", 1e-2 * GRAM_FORCE),
                // Japanese laboratories print a force as the mass with this weight.
                ("g.cm2/cm", 1e-2 * GRAM_FORCE),
                ("g.cm", 1e-2 * GRAM_FORCE),
                // The flexural rigidity of the cantilever test is a weight times a length.
                ("mgf.cm", 1e-5 * GRAM_FORCE),
                ("mg.cm", 1e-5 * GRAM_FORCE),
                ("cN.cm2/cm", 1e-4),
                ("N.cm2/cm", 1e-2),
                ("mN.m2/m", 1e-3),
                ("uN.m2/m", 1e-6),
                ("mN.mm2/mm", 1e-6),
                ("N.mm2/mm", 1e-3),
                ("mN.cm", 1e-5),
                ("cN.cm", 1e-4),
                ("N.mm", 1e-3),
                ("uN.mm", 1e-9),
                ("nN.m", 1e-9),
            ],
            Self::ShearStiffness => &[
                ("gf/(cm.deg)", 1e2 * GRAM_FORCE / DEGREE),
                ("gf/cm.deg", 1e2 * GRAM_FORCE / DEGREE),
                ("gf/cm/deg", 1e2 * GRAM_FORCE / DEGREE),
                ("g/(cm.deg)", 1e2 * GRAM_FORCE / DEGREE),
                ("g/cm.deg", 1e2 * GRAM_FORCE / DEGREE),
                ("g/cm/deg", 1e2 * GRAM_FORCE / DEGREE),
                ("cN/(cm.deg)", 1.0 / DEGREE),
                ("cN/cm.deg", 1.0 / DEGREE),
                ("cN/cm/deg", 1.0 / DEGREE),
                ("N/(m.rad)", 1.0),
                ("N/m.rad", 1.0),
                ("N/m/rad", 1.0),
                ("N/(m.deg)", 1.0 / DEGREE),
                ("N/m.deg", 1.0 / DEGREE),
                ("N/m/deg", 1.0 / DEGREE),
                ("N/m", 1.0),
            ],
            Self::WorkPerArea => &[
                ("gf.cm/cm2", 1e2 * GRAM_FORCE),
                ("g.cm/cm2", 1e2 * GRAM_FORCE),
                ("gf/cm", 1e2 * GRAM_FORCE),
                ("cN.cm/cm2", 1.0),
                ("N.cm/cm2", 1e2),
                ("J/m2", 1.0),
                ("N.m/m2", 1.0),
                ("N/m", 1.0),
                ("mJ/m2", 1e-3),
            ],
            Self::Pressure => &[
                ("gf/cm2", 1e4 * GRAM_FORCE),
                ("Pa", 1.0),
                ("kPa", 1e3),
                ("N/m2", 1.0),
                ("cN/cm2", 1e2),
                ("N/cm2", 1e4),
                ("g/cm2", 1e4 * GRAM_FORCE),
                ("kgf/cm2", 1e7 * GRAM_FORCE),
            ],
            Self::Roughness => &[("um", 1e-6), ("mm", 1e-3), ("m", 1.0)],
            Self::MassPerArea => &[
                ("mg/cm2", 1e-2),
                ("kg/m2", 1.0),
                ("g/m2", 1e-3),
                ("g/cm2", 10.0),
                ("gsm", 1e-3),
                ("gr/m2", 1e-3),
                ("oz/yd2", OUNCE_PER_SQUARE_YARD),
            ],
            Self::Time => &[("s", 1.0), ("ms", 1e-3), ("min", 60.0)],
            Self::Speed => &[("m/s", 1.0), ("cm/s", 1e-2), ("mm/s", 1e-3), ("km/h", 1.0 / 3.6)],
            Self::AngularSpeed => &[("deg/s", DEGREE), ("rad/s", 1.0), ("1/min", 6.0 * DEGREE)],
            Self::Acceleration => &[("m/s2", 1.0), ("cm/s2", 1e-2), ("mm/s2", 1e-3)],
            Self::Density => &[("kg/m3", 1.0), ("g/cm3", 1e3), ("g/m3", 1e-3)],
            Self::PressurePerDistance => &[("N/m3", 1.0), ("Pa/m", 1.0), ("kPa/mm", 1e6)],
        }
    }

    /// Returns the [`Unit`] of a bare number in a sheet, which is the laboratory's unit.
    pub fn laboratory(self) -> Unit {
        let (spelling, factor) = self.units()[0];
        Unit { quantity: self, spelling, factor }
    }

    /// Returns the spellings of the units, such as `gf/cm`.
    pub fn spellings(self) -> impl Iterator<Item = &'static str> {
        self.units().iter().map(|(spelling, _)| *spelling)
    }

    /// Returns the spellings of the units, separated by `, `, for messages.
    pub(crate) fn list(self) -> String {
        let spellings: Vec<&str> = self.units().iter().map(|unit| unit.0).collect();
        spellings.join(", ")
    }
}

/// Unit with its quantity and its factor to SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// Quantity that the unit measures.
    pub quantity: Quantity,
    /// Spelling in normal form, such as `gf.cm2/cm`.
    pub spelling: &'static str,
    /// Value of the unit in SI.
    pub factor: f64,
}

/// Parses `text` as a unit of one of the quantities `accepted`, which are tried in order.
///
/// # Errors
/// [`ValueError`] if `text` is no unit of these quantities.
pub fn parse_unit(text: &str, accepted: &[Quantity]) -> Result<Unit, ValueError> {
    let wanted = normal_form(text);
    for &quantity in accepted {
        if let Some(&(spelling, factor)) = quantity.units().iter().find(|u| u.0 == wanted) {
            return Ok(Unit { quantity, spelling, factor });
        }
    }
    let names: Vec<&str> = accepted.iter().map(|q| q.name()).collect();
    let lists: Vec<String> = accepted.iter().map(|q| q.list()).collect();
    let known = accepted.iter().flat_map(|q| q.units()).map(|u| u.0);
    let close = closest(&wanted, known);
    let hint = close.map(|close| format!("did you mean `{close}`? ")).unwrap_or_default();
    Err(ValueError {
        message: format!("\"{}\" is not a unit of {}", excerpt(text), names.join(" or ")),
        help: format!("{hint}units accepted here: {}", lists.join("; ")),
        intended_value: close.map(str::to_owned),
    })
}

/// Returns whether `text` is a unit in which a measured curve may be given.
#[must_use]
pub fn is_unit(text: &str) -> bool {
    const CURVE_QUANTITIES: [Quantity; 9] = [
        Quantity::Ratio,
        Quantity::Angle,
        Quantity::Length,
        Quantity::Curvature,
        Quantity::Force,
        Quantity::ForcePerWidth,
        Quantity::Moment,
        Quantity::MomentPerWidth,
        Quantity::Pressure,
    ];
    /// Units of other columns in files of curves, such as time and temperature.
    const OTHER_UNITS: [&str; 26] = [
        "s", "sec", "min", "ms", "h", "MPa", "Pa", "kPa", "N/mm2", "J", "mJ", "C", "mm/min",
        "mm/s", "degC", "degF", "V", "mV", "mA", "Hz", "1/s", "s-1", "%/s", "%/min", "uJ", "GPa",
    ];
    let text = text.trim();
    let is_number = text.parse::<f64>().is_ok();
    let is_curve_unit = || parse_unit(text, &CURVE_QUANTITIES).is_ok();
    let is_other_unit = || OTHER_UNITS.contains(&normal_form(text).as_str());
    !is_number && (is_curve_unit() || is_other_unit())
}

/// Number with the unit in which it is written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NumberWithUnit {
    /// Number as it is written, without regard to its unit.
    pub number: f64,
    /// Unit of `number`.
    pub unit: Unit,
}

/// Parses `text` as a number with a unit of `quantity`, such as `"1.2e-5 N.m"`. A bare number such
/// as `"0.118"` is in the laboratory's unit.
///
/// # Errors
/// [`ValueError`] if `text` does not begin with a number, or if a unit of another quantity follows.
pub fn parse_quantity(text: &str, quantity: Quantity) -> Result<NumberWithUnit, ValueError> {
    /// Largest number of letters of a number, more than a number with all its digits needs.
    const NUMBER_MAX: usize = 64;

    // The number is the longest leading part that parses as one. The unit follows.
    let text = text.trim();
    let split = (1..=text.len().min(NUMBER_MAX))
        .rev()
        .filter(|&end| text.is_char_boundary(end))
        .find_map(|end| text[..end].trim_end().parse::<f64>().ok().map(|number| (number, end)));
    let Some((number, end)) = split else {
        let unit = quantity.laboratory().spelling;
        return Err(ValueError {
            message: format!("\"{}\" does not begin with a number", excerpt(text)),
            help: format!("write the number and its unit, such as \"1.5 {unit}\""),
            intended_value: None,
        });
    };

    let unit = match text[end..].trim() {
        "" => quantity.laboratory(),
        spelling => parse_unit(spelling, &[quantity]).map_err(|error| ValueError {
            intended_value: error
                .intended_value
                .map(|unit| format!("{} {unit}", text[..end].trim_end())),
            ..error
        })?,
    };
    Ok(NumberWithUnit { number, unit })
}

/// Returns the normal form of the unit `text`. `gf·cm²/cm`, `gf*cm^2/cm` and `gf cm2/cm` have one
/// normal form.
fn normal_form(text: &str) -> String {
    /// Words for the degree in several languages.
    const DEGREES: [&str; 10] = [
        "degrees", "degree", "degrés", "degré", "grados", "grado", "graus", "grau", "derece",
        "Grad",
    ];

    let mut normal = String::with_capacity(text.len());
    for c in text.trim().chars() {
        match c {
            '·' | '*' | '×' | '⋅' | ' ' | '・' | '･' | '•' | '‧' | '∙' | '．' | '＊'
            | '\u{3000}' => normal.push('.'),
            // Japanese and Chinese programs write some units as one sign.
            '㎎' => normal.push_str("mg"),
            '㎏' => normal.push_str("kg"),
            '㎜' => normal.push_str("mm"),
            '㎝' => normal.push_str("cm"),
            '㎛' => normal.push_str("um"),
            '㎟' => normal.push_str("mm2"),
            '㎠' => normal.push_str("cm2"),
            '㎡' => normal.push_str("m2"),
            '℃' => normal.push_str("degC"),
            '\u{ff10}'..='\u{ff19}' => normal.extend(char::from_u32(c as u32 - 0xfee0)),
            '－' => normal.push('-'),
            '／' => normal.push('/'),
            '％' => normal.push('%'),
            '（' => normal.push('('),
            '）' => normal.push(')'),
            '\u{ff21}'..='\u{ff5a}' => normal.extend(char::from_u32(c as u32 - 0xfee0)),
            '²' => normal.push('2'),
            '³' => normal.push('3'),
            '⁻' | '−' => normal.push('-'),
            '¹' => normal.push('1'),
            '^' => {}
            'µ' | 'μ' => normal.push('u'),
            '°' | 'º' | '゜' | '度' => normal.push_str("deg"),
            letter => normal.push(letter),
        }
    }

    let normal = DEGREES.iter().fold(normal, |text, word| text.replace(word, "deg"));
    match normal.as_str() {
        "deg." | "Deg" | "DEG" => "deg".to_owned(),
        "micron" | "microns" | "Micron" | "ミクロン" | "微米" => "um".to_owned(),
        // German programs write the product without a sign.
        "Nm" | "Nmm" | "Ncm" | "mNm" | "mNmm" | "mNcm" | "uNm" | "cNcm" | "cNmm" => {
            normal.replacen('N', "N.", 1)
        }
        "percent" | "Percent" | "pct" | "Prozent" => "%".to_owned(),
        // Capitals are accepted where they have no other meaning. MN would be a million newtons.
        "MM" | "CM" | "GF" | "KGF" | "Kgf" | "Gf" | "GF/CM" | "gF/cm" | "Gf/cm" | "KN" | "IN" => {
            if normal == "KN" {
                "kN".to_owned()
            } else {
                normal.to_lowercase()
            }
        }
        _ => {
            let parts = normal.replace("grf", "gf").replace("gfcm", "gf.cm");
            // gf/cm° and (cm°) have no sign between the factors.
            parts.replace("cmdeg", "cm.deg")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn laboratory_units_convert_with_the_defined_gram_force() {
        // By hand from 1 gf = 980.665 dyn and 1 degree = pi/180.
        let cases = [
            (Quantity::BendingRigidity, 9.806_65e-5),
            (Quantity::MomentPerWidth, 9.806_65e-3),
            (Quantity::ShearStiffness, 56.187_966),
            (Quantity::ForcePerWidth, 0.980_665),
            (Quantity::WorkPerArea, 0.980_665),
            (Quantity::MassPerArea, 0.01),
            (Quantity::Ratio, 0.01),
        ];
        for (quantity, factor) in cases {
            let unit = quantity.laboratory();
            let error = (unit.factor / factor - 1.0).abs();
            assert!(error < 1e-8, "{}: {} against {factor}", quantity.name(), unit.factor);
        }
    }

    #[test]
    fn one_unit_may_be_spelt_in_many_ways() {
        for text in ["gf.cm2/cm", "gf·cm²/cm", "gf*cm^2/cm", " gf cm2/cm "] {
            let unit = parse_unit(text, &[Quantity::BendingRigidity]).unwrap();
            assert_eq!(unit.spelling, "gf.cm2/cm", "{text}");
        }
        for text in ["1/cm", "cm^-1", "cm⁻¹"] {
            let unit = parse_unit(text, &[Quantity::Curvature]).unwrap();
            assert_eq!(unit.factor, 100.0, "{text}");
        }
        assert_eq!(parse_unit("°", &[Quantity::Angle]).unwrap().spelling, "deg");
        // Letters of full width, as Japanese programs write them.
        for text in ["ｇｆ／ｃｍ", "gf／ｃm", "ＧＦ／ＣＭ"] {
            let unit = parse_unit(text, &[Quantity::ForcePerWidth]).unwrap();
            assert_eq!(unit.spelling, "gf/cm", "{text}");
        }
    }

    #[test]
    fn units_of_japanese_and_german_sheets_are_those_of_kes() {
        let cases = [
            (Quantity::BendingRigidity, "g·cm²/cm", "gf.cm2/cm"),
            (Quantity::BendingRigidity, "ｇｆ・ｃｍ２／ｃｍ", "gf.cm2/cm"),
            (Quantity::BendingRigidity, "gf・㎠/㎝", "gf.cm2/cm"),
            (Quantity::MomentPerWidth, "g・cm/cm", "gf.cm/cm"),
            (Quantity::ShearStiffness, "g/cm･deg", "gf/(cm.deg)"),
            (Quantity::ShearStiffness, "gf/cm・degree", "gf/(cm.deg)"),
            (Quantity::ShearStiffness, "gf/cm・度", "gf/(cm.deg)"),
            (Quantity::ShearStiffness, "gf/(cm°)", "gf/(cm.deg)"),
            (Quantity::WorkPerArea, "gf・cm/cm²", "gf.cm/cm2"),
            (Quantity::WorkPerArea, "g.cm/cm2", "gf.cm/cm2"),
            (Quantity::Roughness, "micron", "um"),
            (Quantity::Roughness, "ミクロン", "um"),
            (Quantity::MassPerArea, "ｍｇ／ｃｍ２", "mg/cm2"),
            (Quantity::Ratio, "％", "%"),
            (Quantity::Moment, "Nmm", "N.mm"),
        ];
        for (quantity, text, same) in cases {
            let [unit, same] = [text, same].map(|text| parse_unit(text, &[quantity]).unwrap());
            assert!((unit.factor / same.factor - 1.0).abs() < 1e-12, "{text}: {unit:?}");
        }
        // 1 mg·cm of the cantilever test is 9.80665e-8 N·m, 1 oz/yd² is 33.906 g/m².
        let flexural = parse_unit("mg.cm", &[Quantity::BendingRigidity]).unwrap().factor;
        assert!((flexural / 9.806_65e-8 - 1.0).abs() < 1e-12, "{flexural}");
        let ounces = parse_unit("oz/yd2", &[Quantity::MassPerArea]).unwrap().factor;
        assert!((ounces / 0.033_905_75 - 1.0).abs() < 1e-6, "{ounces}");
    }

    #[test]
    fn a_unit_of_something_else_is_refused_with_the_list() {
        let error = parse_unit("N/m", &[Quantity::BendingRigidity]).unwrap_err();
        assert_eq!(error.message, "\"N/m\" is not a unit of bending rigidity per width");
        assert!(error.help.contains("did you mean `N.m`?"), "{}", error.help);
    }

    #[test]
    fn a_quantity_is_a_number_with_an_optional_unit() {
        let cases = [
            ("1.2e-5 N.m", Quantity::BendingRigidity, 1.2e-5),
            ("105.6g/m2", Quantity::MassPerArea, 0.1056),
            ("5 cm", Quantity::Length, 0.05),
            ("12", Quantity::MassPerArea, 0.12),
        ];
        for (text, quantity, si) in cases {
            let NumberWithUnit { number, unit } = parse_quantity(text, quantity).unwrap();
            let error = (number * unit.factor / si - 1.0).abs();
            assert!(error < 1e-14, "{text} reads as {} {}", number, unit.spelling);
        }
        assert!(parse_quantity("thick", Quantity::Length).is_err());
    }

    #[test]
    fn units_of_force_are_multiples_of_the_newton() {
        // By hand from 1 kgf = 9.806 65 N and 1 gf/mm = 1 kgf/m.
        let cases = [
            ("kgf", Quantity::Force, 9.806_65),
            ("kg", Quantity::Force, 9.806_65),
            ("cN", Quantity::Force, 0.01),
            ("kgf/m", Quantity::ForcePerWidth, 9.806_65),
            ("gf/mm", Quantity::ForcePerWidth, 9.806_65),
            ("kgf/cm", Quantity::ForcePerWidth, 980.665),
            ("cN/cm", Quantity::ForcePerWidth, 1.0),
        ];
        for (text, quantity, factor) in cases {
            let unit = parse_unit(text, &[quantity]).unwrap();
            assert!((unit.factor / factor - 1.0).abs() < 1e-14, "{text}: {}", unit.factor);
        }
    }
}
