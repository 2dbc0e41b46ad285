//! Number of a cell of results, with its scatter and its unit.

use crate::results::label::written_unit::WrittenUnit;
use crate::tables::grid::Cell;
use crate::tables::number::scattered::{Spread, leading_number, scattered};
use crate::tables::number::{Decimal, Evidence, evidence, parse};

/// Number of a cell.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct CellNumber {
    pub(crate) number: f64,
    pub(crate) scatter: Option<CellScatter>,
    /// Unit within the cell; empty for a number without unit.
    pub(crate) unit: String,
}

/// Scatter of a number in a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum CellScatter {
    /// Standard deviation, in the unit of the number.
    Deviation(f64),
    /// Standard deviation in percent of the number.
    Percent(f64),
    /// Percent of the number, or in the unit of the number if that is percent. `true` if the
    /// percent sign stands behind both numbers.
    PercentOrUnit(f64, bool),
    /// Number with an unclear meaning.
    Unclear(f64),
}

/// Parses the number of `cell` with the sign `decimal`; `None` for a cell with another content.
pub(crate) fn parse_cell(cell: &Cell, decimal: Decimal) -> Option<CellNumber> {
    if let Some(number) = cell.number(decimal) {
        // The digits of a displayed percentage are kept: 100 times 0.041 is not 4.1 to the last
        // digit.
        let number = if matches!(cell, Cell::Percent(_)) {
            drape_input::figure(number).parse().unwrap_or(number)
        } else {
            number
        };
        let unit = cell.unit().to_owned();
        return number.is_finite().then_some(CellNumber { number, scatter: None, unit });
    }

    let Cell::Text(text) = cell else { return None };
    let text = strip_sign(strip_marks(text));
    if let Some(number) = parse(text, decimal) {
        return Some(CellNumber { number, scatter: None, unit: String::new() });
    }
    let Some(parts) = scattered(text) else {
        let (number, unit) = split_unit(text)?;
        return Some(CellNumber {
            number: parse(number, decimal)?,
            scatter: None,
            unit: unit.to_owned(),
        });
    };

    let number = parse(parts.number, decimal)?;
    let deviation = parse(parts.deviation, decimal)?;
    let scatter = match parts.spread {
        Spread::Absolute => CellScatter::Deviation(deviation),
        Spread::Percent => CellScatter::Percent(deviation),
        Spread::PercentOrUnit => CellScatter::PercentOrUnit(deviation, parts.unit == "%"),
        Spread::Unclear => CellScatter::Unclear(deviation),
    };
    let is_both = parts.spread == Spread::PercentOrUnit;
    let unit = if is_both { "" } else { parts.unit }.to_owned();
    Some(CellNumber { number, scatter: Some(scatter), unit })
}

/// Returns whether `cell` holds a number, with or without the mark of a footnote.
pub(crate) fn is_number(cell: &Cell) -> bool {
    if cell.is_value() {
        return true;
    }
    let Cell::Text(text) = cell else { return false };
    let text = strip_sign(strip_marks(text));
    evidence(text).is_some() || split_unit(text).is_some()
}

/// Splits a `text` such as `213 g/m2` into its number and its unit.
fn split_unit(text: &str) -> Option<(&str, &str)> {
    let (number, unit) = leading_number(text)?;
    WrittenUnit::parse(unit, true).filter(|unit| unit.is_known).map(|_| (number, unit))
}

/// Returns the evidence of the numbers of `cell` for a decimal sign.
pub(crate) fn decimal_evidence(cell: &Cell) -> Vec<Evidence> {
    let Cell::Text(text) = cell else { return Vec::new() };
    let text = strip_sign(strip_marks(text));
    if let Some(parts) = scattered(text) {
        return [parts.number, parts.deviation].into_iter().filter_map(evidence).collect();
    }
    let before_unit = split_unit(text).and_then(|(number, _)| evidence(number));
    cell.evidence().or_else(|| evidence(text)).or(before_unit).into_iter().collect()
}

/// Returns `text` without the marks of footnotes at its end.
fn strip_marks(text: &str) -> &str {
    text.trim_end_matches(['*', '†', '‡', '¹', ' '])
}

/// Returns whether `cell` holds only a standard deviation, behind its sign: `± 0.003`.
pub(crate) fn is_deviation(cell: &Cell) -> bool {
    matches!(cell, Cell::Text(text) if strip_sign(text) != text)
}

/// Returns `text` without the sign of a standard deviation before it.
fn strip_sign(text: &str) -> &str {
    ["±", "+/-"].iter().find_map(|sign| text.strip_prefix(sign)).unwrap_or(text).trim()
}

/// Returns the decimal sign of `cells`. `Err` holds the reason why the sign is ambiguous.
pub(crate) fn decimal_sign<'c>(
    cells: impl Iterator<Item = (usize, &'c Cell)>,
) -> Result<Decimal, String> {
    let [mut point, mut comma, mut either] = [None, None, None];
    for (line, cell) in cells {
        for sign in decimal_evidence(cell) {
            let first = match sign {
                Evidence::Only(Decimal::Point) => &mut point,
                Evidence::Only(Decimal::Comma) => &mut comma,
                Evidence::Either if cell.text().contains(',') => &mut either,
                Evidence::Either | Evidence::Whole => continue,
            };
            first.get_or_insert_with(|| (line, cell.text()));
        }
    }
    match (point, comma, either) {
        (Some((line, point)), Some((other, comma)), _) => Err(format!(
            "\"{point}\" on line {line} has a decimal point, \"{comma}\" on line {other} a comma: write all \
             numbers with one sign"
        )),
        (None, Some(_), _) => Ok(Decimal::Comma),
        (None, None, Some((line, text))) => Err(format!(
            "\"{text}\" on line {line} may be {} or {}, and no other number tells: write it with a decimal point, or \
             without the comma",
            text.replace(',', "."),
            text.replace(',', "")
        )),
        _ => Ok(Decimal::Point),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(text: &str, decimal: Decimal) -> Option<CellNumber> {
        parse_cell(&Cell::Text(text.to_owned()), decimal)
    }

    #[test]
    fn a_cell_has_a_number_with_its_scatter_and_its_unit() {
        let plain =
            |number: f64, unit: &str| Some(CellNumber { number, scatter: None, unit: unit.into() });
        assert_eq!(of("0.112", Decimal::Point), plain(0.112, ""));
        assert_eq!(of("0,112*", Decimal::Comma), plain(0.112, ""));
        assert_eq!(of("213 g/m2", Decimal::Point), plain(213.0, "g/m2"));
        assert_eq!(of("0.112 gf·cm²/cm", Decimal::Point), plain(0.112, "gf·cm²/cm"));
        let found = of("0,085±0,004", Decimal::Comma).expect("a number");
        assert_eq!((found.number, found.scatter), (0.085, Some(CellScatter::Deviation(0.004))));
        let found = of("58 ± 2 %", Decimal::Point).expect("a number");
        assert_eq!(found.scatter, Some(CellScatter::PercentOrUnit(2.0, true)));
        for text in ["n.d.", "<0.01", "-", "", "0.1-0.2", "2024-05-01"] {
            assert_eq!(of(text, Decimal::Point), None, "{text}");
        }
    }

    #[test]
    fn the_decimal_sign_of_a_table_is_told_or_asked_for() {
        let of = |texts: &[&str]| {
            let cells: Vec<Cell> =
                texts.iter().map(|text| Cell::Text((*text).to_owned())).collect();
            decimal_sign(cells.iter().enumerate())
        };
        assert_eq!(of(&["0,085±0,004", "12"]), Ok(Decimal::Comma));
        assert_eq!(of(&["0.085 (0.004)", "1,234"]), Ok(Decimal::Point));
        assert!(of(&["0.085", "0,061"]).is_err_and(|reason| reason.contains("one sign")));
        assert!(of(&["1,234"]).is_err_and(|reason| reason.contains("1.234 or 1234")));
    }
}
