//! Gauge and width that a file states above its numbers.

use crate::tables::grid::{Cell, Row};
use crate::tables::heading::{Heading, normal};
use crate::tables::number::{Decimal, parse};
use crate::unit::{Quantity, parse_unit};

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
pub(crate) const WIDTH: [&str; 10] = [
    "specimen width",
    "sample width",
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

fn of_row(row: &Row, words: &[&str]) -> Option<Stated> {
    let cells: Vec<String> = row.filled().map(|(_, cell)| Cell::text(cell)).collect();
    let (name, value) = match cells.as_slice() {
        [one] => one.split_once([':', '='])?,
        [name, rest @ ..] => (name.as_str(), rest.first()?.as_str()),
        [] => return None,
    };
    let heading = Heading::parse(name);
    let plain = normal(&heading.name);
    if !words
        .iter()
        .any(|word| plain.starts_with(word) || (!word.is_ascii() && plain.contains(word)))
    {
        return None;
    }
    let (number, own) = split_unit(value.trim())?;
    let unit = own.or_else(|| heading.unit.clone()).or_else(|| cells.get(2).cloned())?;
    let unit = parse_unit(unit.trim_matches(['(', ')', '[', ']']), &[Quantity::Length]).ok()?;
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
