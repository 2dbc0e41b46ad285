//! Standard deviations that a sheet states behind its values: `"0.118 ± 0.006"`.

use crate::symbol::Symbol;
use crate::test::Direction;
use drape_input::{NumberWithUnit, Quantity, ValueError, parse_quantity};

/// Standard deviation of a value that a law uses, as the sheet states it.
///
/// ```
/// use drape_input::Document;
/// use drape_kes::{Direction, Sheet};
///
/// let text = "name = \"poplin\"\n[warp]\nB = \"0.118 ± 0.006\"\n";
/// let sheet = Sheet::from_document(&Document::new("sheet.toml", text))?;
/// assert_eq!(sheet.warp.b, Some(0.118));
/// assert_eq!((sheet.scatter[0].direction, sheet.scatter[0].deviation), (Direction::Warp, 0.006));
/// # Ok::<(), drape_kes::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scatter {
    /// Direction of the value.
    pub direction: Direction,
    /// Symbol of the value.
    pub symbol: Symbol,
    /// Standard deviation, in the laboratory's unit.
    pub deviation: f64,
}

/// Standard deviation of a value that no law uses, as the sheet states it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OtherScatter {
    /// Symbol of the value, such as `T` or `MIU`.
    pub symbol: &'static str,
    /// Direction of the value; `None` for a value without a direction.
    pub direction: Option<Direction>,
    /// Standard deviation, in the laboratory's unit.
    pub deviation: f64,
}

/// Signs between a value and its standard deviation.
const SIGNS: [&str; 3] = ["±", "+/-", "+-"];

/// Value and standard deviation that one text states.
pub(crate) struct ValueWithDeviation {
    pub(crate) value: NumberWithUnit,
    /// Standard deviation, in SI.
    pub(crate) deviation: f64,
}

/// Parses a value of `quantity` with its standard deviation. Returns `None` if `text` states no
/// standard deviation.
///
/// ```text
/// 0.118 ± 0.006    0.118 ± 0.006 gf.cm2/cm    (0.118 ± 0.006) gf.cm2/cm    1.2e-5 N.m ± 5 %
/// ```
pub(crate) fn parse(
    text: &str,
    quantity: Quantity,
) -> Option<Result<ValueWithDeviation, ValueError>> {
    let (value, deviation) = split(text)?;
    Some(parse_parts(value, deviation, quantity))
}

/// Returns whether `text` has numbers and no unit.
pub(crate) fn is_bare(text: &str) -> bool {
    let (value, deviation) = split(text).unwrap_or((text, "0"));
    is_number(value) && is_number(deviation)
}

/// Splits `text` at the sign between a value and its standard deviation.
fn split(text: &str) -> Option<(&str, &str)> {
    SIGNS.iter().find_map(|sign| text.split_once(sign))
}

/// Returns whether `text` is a number without a unit, in brackets or not.
fn is_number(text: &str) -> bool {
    text.trim_matches(['(', ')', ' ']).parse::<f64>().is_ok()
}

/// Parses a `value` of `quantity` and the `deviation` behind it. A percentage is a share of the
/// value, except where `quantity` is itself a ratio.
fn parse_parts(
    value: &str,
    deviation: &str,
    quantity: Quantity,
) -> Result<ValueWithDeviation, ValueError> {
    let [value_is_bare, deviation_is_bare] = [value, deviation].map(is_number);
    // One pair of brackets may stand around both numbers.
    let value = value.trim().trim_start_matches('(').trim();
    let deviation = deviation.replacen(')', " ", usize::from(!deviation.contains('(')));

    let mut value = parse_quantity(value, quantity)?;

    // A standard deviation in percent is relative to the value.
    let share =
        deviation.trim().strip_suffix('%').and_then(|share| share.trim().parse::<f64>().ok());
    if let Some(percent) = share.filter(|_| quantity != Quantity::Ratio) {
        let deviation = 0.01 * percent * value.number * value.unit.factor;
        return Ok(ValueWithDeviation { value, deviation });
    }

    let mut deviation = parse_quantity(&deviation, quantity)?;
    // A unit behind only one of the numbers is the unit of both.
    if value_is_bare {
        value.unit = deviation.unit;
    } else if deviation_is_bare {
        deviation.unit = value.unit;
    }
    Ok(ValueWithDeviation { value, deviation: deviation.number * deviation.unit.factor })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_unit_stands_where_laboratories_write_it() {
        let b = Quantity::BendingRigidity;
        let unit = b.laboratory().factor;
        let cases = [
            ("0.118 ± 0.006", 0.118 * unit, 0.006 * unit),
            ("0.118 +/- 0.006 gf.cm2/cm", 0.118 * unit, 0.006 * unit),
            ("(1.2e-5 ± 3e-7) N.m", 1.2e-5, 3e-7),
            ("1.2e-5 N.m +- 3e-7 N.m", 1.2e-5, 3e-7),
            ("1.2e-5 N.m ± 5 %", 1.2e-5, 6e-7),
            ("1.2e-5 N.m ± 3e-7", 1.2e-5, 3e-7),
            ("1.2e-5 N.m ± 0.003 gf.cm2/cm", 1.2e-5, 0.003 * unit),
            ("0.118 gf.cm2/cm ± 3e-7 N.m", 0.118 * unit, 3e-7),
        ];
        for (text, value, deviation) in cases {
            let parted = parse(text, b).expect("a deviation").expect("it parses");
            let found = parted.value.number * parted.value.unit.factor;
            assert!((found / value - 1.0).abs() < 1e-12, "{text}: {found}");
            assert!((parted.deviation / deviation - 1.0).abs() < 1e-12, "{text}");
        }
        let strain =
            parse("4.5 ± 0.3 %", Quantity::Ratio).expect("a deviation").expect("it parses");
        assert!((strain.value.number * strain.value.unit.factor - 0.045).abs() < 1e-15);
        assert!((strain.deviation - 0.003).abs() < 1e-15);
        assert!(parse("0.118", b).is_none());
        assert!(is_bare("0.75 ± 0.02") && is_bare("0.75") && !is_bare("75 ± 2 %"));
        assert!(parse("0.118 ± many", b).is_some_and(|parted| parted.is_err()));
    }
}
