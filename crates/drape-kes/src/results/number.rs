//! Number of a cell of results, with its scatter and its unit.

use crate::results::label::written_unit::WrittenUnit;
use crate::tables::grid::Cell;
use crate::tables::number::scattered::{Spread, leading_number, scattered};
use crate::tables::number::{Decimal, Evidence, evidence, parse};

/// Number of a cell.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct CellNumber {
    pub(crate) number: f64,
    pub(crate) scatter: Option<Scatter>,
    /// Unit within the cell; empty where there is none.
    pub(crate) unit: String,
}

/// Scatter of a number, as a cell gives it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Scatter {
    /// Standard deviation, in the unit of the number.
    Deviation(f64),
    /// Standard deviation in percent of the number.
    Percent(f64),
    /// In percent, where the number is one too: `true` where the percent sign stands behind both.
    PercentOrUnit(f64, bool),
    /// Number of which it is not known what it is.
    Unclear(f64),
}

/// Returns the number of a cell; `None` where it holds something else.
pub(crate) fn of_cell(cell: &Cell, decimal: Decimal) -> Option<CellNumber> {
    if let Some(number) = cell.number(decimal) {
        // 100 times 0.041 is not 4.1 to the last digit.
        let tidy = |number: f64| drape_input::figure(number).parse().unwrap_or(number);
        let number = if matches!(cell, Cell::Percent(_)) { tidy(number) } else { number };
        let unit = cell.unit().to_owned();
        return number.is_finite().then_some(CellNumber { number, scatter: None, unit });
    }
    let Cell::Text(text) = cell else { return None };
    let text = without_sign(without_mark(text));
    if let Some(number) = parse(text, decimal) {
        return Some(CellNumber { number, scatter: None, unit: String::new() });
    }
    let Some(parts) = scattered(text) else {
        let (number, unit) = with_unit(text)?;
        return Some(CellNumber {
            number: parse(number, decimal)?,
            scatter: None,
            unit: unit.to_owned(),
        });
    };
    let number = parse(parts.number, decimal)?;
    let deviation = parse(parts.deviation, decimal)?;
    let scatter = match parts.spread {
        Spread::Absolute => Scatter::Deviation(deviation),
        Spread::Percent => Scatter::Percent(deviation),
        Spread::PercentOrUnit => Scatter::PercentOrUnit(deviation, parts.unit == "%"),
        Spread::Unclear => Scatter::Unclear(deviation),
    };
    let is_both = parts.spread == Spread::PercentOrUnit;
    let unit = if is_both { "" } else { parts.unit }.to_owned();
    Some(CellNumber { number, scatter: Some(scatter), unit })
}

/// Returns whether a cell holds a number, with a mark of a footnote or without.
pub(crate) fn is_number(cell: &Cell) -> bool {
    let is_text = |text: &str| {
        let text = without_sign(without_mark(text));
        evidence(text).is_some() || with_unit(text).is_some()
    };
    cell.is_value() || matches!(cell, Cell::Text(text) if is_text(text))
}

/// Splits `213 g/m2` into its number and its unit, one of any quantity.
fn with_unit(text: &str) -> Option<(&str, &str)> {
    let (number, unit) = leading_number(text)?;
    WrittenUnit::of(unit, true).filter(|unit| unit.is_known).map(|_| (number, unit))
}

/// Returns the decimal signs that the numbers of a cell speak for.
pub(crate) fn signs(cell: &Cell) -> Vec<Evidence> {
    let Cell::Text(text) = cell else { return Vec::new() };
    let text = without_sign(without_mark(text));
    let parts = match scattered(text) {
        Some(parts) => vec![parts.number, parts.deviation],
        None => {
            let with_unit = with_unit(text).and_then(|(number, _)| evidence(number));
            return cell.evidence().or_else(|| evidence(text)).or(with_unit).into_iter().collect();
        }
    };
    parts.into_iter().filter_map(evidence).collect()
}

/// Returns a text without the marks of footnotes at its end.
fn without_mark(text: &str) -> &str {
    text.trim_end_matches(['*', '†', '‡', '¹', ' '])
}

/// Returns whether a cell holds a standard deviation alone, behind its sign: `± 0.003`.
pub(crate) fn is_deviation(cell: &Cell) -> bool {
    matches!(cell, Cell::Text(text) if without_sign(text) != text)
}

/// Returns a text without the sign of a standard deviation before it.
fn without_sign(text: &str) -> &str {
    ["±", "+/-"].iter().find_map(|sign| text.strip_prefix(sign)).unwrap_or(text).trim()
}

/// Returns the decimal sign of cells; `Err` holds why it cannot be told.
pub(crate) fn decimal<'c>(
    cells: impl Iterator<Item = (usize, &'c Cell)>,
) -> Result<Decimal, String> {
    let [mut point, mut comma, mut either] = [None, None, None];
    for (line, cell) in cells {
        for sign in signs(cell) {
            let here = || (line, cell.text());
            match sign {
                Evidence::Of(Decimal::Point) => _ = point.get_or_insert_with(here),
                Evidence::Of(Decimal::Comma) => _ = comma.get_or_insert_with(here),
                Evidence::Either if cell.text().contains(',') => {
                    _ = either.get_or_insert_with(here)
                }
                Evidence::Either | Evidence::Whole => {}
            }
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
        of_cell(&Cell::Text(text.to_owned()), decimal)
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
        assert_eq!((found.number, found.scatter), (0.085, Some(Scatter::Deviation(0.004))));
        let found = of("58 ± 2 %", Decimal::Point).expect("a number");
        assert_eq!(found.scatter, Some(Scatter::PercentOrUnit(2.0, true)));
        for text in ["n.d.", "<0.01", "-", "", "0.1-0.2", "2024-05-01"] {
            assert_eq!(of(text, Decimal::Point), None, "{text}");
        }
    }

    #[test]
    fn the_decimal_sign_of_a_table_is_told_or_asked_for() {
        let of = |texts: &[&str]| {
            let cells: Vec<Cell> =
                texts.iter().map(|text| Cell::Text((*text).to_owned())).collect();
            decimal(cells.iter().enumerate())
        };
        assert_eq!(of(&["0,085±0,004", "12"]), Ok(Decimal::Comma));
        assert_eq!(of(&["0.085 (0.004)", "1,234"]), Ok(Decimal::Point));
        assert!(of(&["0.085", "0,061"]).is_err_and(|reason| reason.contains("one sign")));
        assert!(of(&["1,234"]).is_err_and(|reason| reason.contains("1.234 or 1234")));
    }
}
