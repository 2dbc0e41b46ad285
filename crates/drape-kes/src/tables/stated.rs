//! Gauge and width that a file states: above its numbers, or in a column of them.

use crate::tables::block::{Block, unbracketed};
use crate::tables::grid::{Cell, Row};
use crate::tables::heading::{Heading, normal};
use crate::tables::number::{Decimal, parse};
use drape_input::{Quantity, parse_unit};

/// Words of the free length of the specimen.
pub(crate) const GAUGE: [&str; 14] = [
    "gauge length",
    "grip separation",
    "jaw separation",
    "einspannlänge",
    "messlänge",
    "l0",
    "specimen length",
    "longueur utile",
    "distance entre mors",
    "チャック間",
    "つかみ間隔",
    "標点距離",
    "試料長",
    "free length",
];

/// Words of the width of the specimen.
pub(crate) const WIDTH: [&str; 11] = [
    "specimen width",
    "sample width",
    "clamp width",
    "probenbreite",
    "breite",
    "largeur",
    "試料幅",
    "試験片幅",
    "幅",
    "width",
    "anchura",
];

/// Length that a file states.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Stated {
    /// Length, in metres.
    pub(crate) length: f64,
    pub(crate) line: usize,
    /// Name that the file gives it.
    pub(crate) name: String,
}

/// Returns the length that goes by one of some names; `None` where there is none, or two that differ.
pub(crate) fn stated(rows: &[Row], words: &[&str]) -> Option<Stated> {
    let all: Vec<Stated> = rows.iter().filter_map(|row| of_row(row, words)).collect();
    let first = all.first()?.clone();
    all.iter().all(|other| (other.length / first.length - 1.0).abs() < 1e-9).then_some(first)
}

/// Returns the column of lengths whose heading is one of some names, other than the columns of the curve; `None`
/// where there is none, or several.
pub(crate) fn size_column(block: &Block, of_curve: &[usize], words: &[&str]) -> Option<usize> {
    let of_length = |heading: &Heading| {
        let unit = heading.unit.as_deref();
        unit.is_some_and(|unit| parse_unit(unit, &[Quantity::Length]).is_ok())
    };
    let is_size = |column: &usize| {
        let heading = block.headings.get(*column);
        heading.is_some_and(|heading| is_named(&heading.name, words) && of_length(heading))
    };
    let numbers = block.number_columns().into_iter();
    let mut sizes = numbers.filter(|column| !of_curve.contains(column)).filter(is_size);
    sizes.next().filter(|_| sizes.next().is_none())
}

/// Returns whether a name is one of some, or begins with it.
fn is_named(name: &str, words: &[&str]) -> bool {
    let plain = normal(name);
    let is = |word: &&str| plain.starts_with(*word) || (!word.is_ascii() && plain.contains(*word));
    words.iter().any(is)
}

fn of_row(row: &Row, words: &[&str]) -> Option<Stated> {
    let cells: Vec<String> = row.filled().map(|(_, cell)| Cell::text(cell)).collect();
    let (name, value) = match cells.as_slice() {
        [one] => one.split_once([':', '='])?,
        [name, rest @ ..] => (name.as_str(), rest.first()?.as_str()),
        [] => return None,
    };
    let heading = Heading::parse(name);
    if !is_named(&heading.name, words) {
        return None;
    }
    let (number, own) = split_unit(value.trim())?;
    let unit = own.or_else(|| heading.unit.clone()).or_else(|| cells.get(2).cloned())?;
    let unit = parse_unit(unbracketed(&unit), &[Quantity::Length]).ok()?;
    let length = number * unit.factor;
    (length > 0.0).then_some(Stated { length, line: row.line, name: heading.name })
}

/// Splits `50 mm` into number and unit.
fn split_unit(text: &str) -> Option<(f64, Option<String>)> {
    let end = text.find(|letter: char| letter.is_alphabetic()).unwrap_or(text.len());
    let (number, unit) = text.split_at(end);
    let decimal = if number.contains(',') { Decimal::Comma } else { Decimal::Point };
    let number = parse(number, decimal)?;
    Some((number, (!unit.trim().is_empty()).then(|| unit.trim().to_owned())))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tables::grid::Separator;

    #[test]
    fn a_length_is_read_however_it_is_stated() {
        for text in [
            "Gauge length;50;mm\n",
            "Gauge length (mm);50\n",
            "Gauge length: 50 mm\n",
            "Einspannlänge;50,0 mm\n",
            "チャック間距離(mm);50\n",
            "L0;5;cm\n",
        ] {
            let rows = Separator::Semicolon.split(text).expect("it splits");
            let found = stated(&rows, &GAUGE).expect(text);
            assert!((found.length - 0.05).abs() < 1e-12, "{text}: {found:?}");
        }
        let rows = Separator::Semicolon.split("Width;50;mm\nWidth;40;mm\n").expect("it splits");
        assert_eq!(stated(&rows, &WIDTH), None, "which of the two?");
    }
}
