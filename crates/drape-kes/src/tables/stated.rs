//! Gauge and width that a file states, above its numbers or in a column.

use crate::tables::block::{Block, without_brackets};
use crate::tables::grid::{Cell, Row};
use crate::tables::heading::words::{Words, single};
use crate::tables::heading::{Heading, normal};
use crate::tables::number::{Decimal, parse};
use drape_input::{Quantity, parse_unit};

/// Words of the free length of the specimen.
pub(crate) const GAUGE: Words = &[
    "gauge length, gage length, grip separation, jaw separation, clamp separation, specimen length",
    "free length, initial length, nominal length, test length, clamping length, l0, lo",
    "einspannlänge, messlänge, anfangslänge, freie länge, prüflänge",
    "longueur utile, longueur initiale, distance entre mors, écartement des mors",
    "distanza tra i morsetti, lunghezza utile, lunghezza iniziale",
    "distancia entre mordazas, longitud inicial, longitud útil, longitud de referencia",
    "distância entre garras, comprimento útil, comprimento inicial",
    "çene mesafesi, çene aralığı, ölçü uzunluğu, ölçüm uzunluğu, başlangıç uzunluğu",
    "チャック間, つかみ間隔, つかみ間距離, 掴み間隔, 標点距離, 標点間距離, 試料長, ゲージ長, 初期長",
    "夹距, 夹持距离, 夹持长度, 夹头间距, 隔距, 标距, 试样长度, 初始长度",
];

/// Words of the width of the specimen.
pub(crate) const WIDTH: Words = &[
    "specimen width, sample width, clamp width, strip width, width, probenbreite, breite",
    "largeur, larghezza, anchura, ancho, largura, genişlik, numune genişliği",
    "試料幅, 試験片幅, 幅, 巾, 试样宽度, 宽度",
];

/// Length that a file states.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct StatedLength {
    /// Length, in metres.
    pub(crate) length: f64,
    pub(crate) line: usize,
    /// Name of the length in the file.
    pub(crate) name: String,
}

/// Texts and tables around the curves of a sheet.
#[derive(Clone, Debug, Default)]
pub(crate) struct Surroundings {
    /// Lines of text.
    pub(crate) rows: Vec<Row>,
    /// Tables with a column of gauges or widths.
    pub(crate) tables: Vec<Block>,
}

impl Surroundings {
    /// Returns the length under one of `words`; `None` if there is none, or if two lengths differ.
    ///
    /// In a table of several specimens the rows with the `title` of the curve decide.
    pub(crate) fn stated(&self, title: &str, words: Words) -> Option<StatedLength> {
        let mut all: Vec<StatedLength> =
            self.rows.iter().flat_map(|row| lengths_of_row(row, words)).collect();
        if all.is_empty() {
            all = self
                .tables
                .iter()
                .flat_map(|block| lengths_of_table(block, title, words))
                .collect();
        }
        let first = all.first()?.clone();
        let are_equal = all.iter().all(|length| (length.length / first.length - 1.0).abs() < 1e-9);
        are_equal.then_some(first)
    }
}

/// Returns whether `block` has a column of gauges or widths.
pub(crate) fn has_sizes(block: &Block) -> bool {
    [GAUGE, WIDTH].iter().any(|words| size_column(block, &[], words).is_some())
}

/// Returns the lengths of the rows of `block` with the name `title`, or of all rows if no row has
/// the name.
fn lengths_of_table(block: &Block, title: &str, words: Words) -> Vec<StatedLength> {
    let Some(column) = size_column(block, &[], words) else { return Vec::new() };
    let heading = &block.headings[column];
    let title = normal(title);
    let is_titled = |row: &&Row| {
        !title.is_empty() && row.filled().any(|(_, cell)| normal(&cell.text()) == title)
    };
    let titled: Vec<&Row> = block.rows.iter().filter(is_titled).collect();
    let rows = if titled.is_empty() { block.rows.iter().collect() } else { titled };
    rows.into_iter()
        .filter_map(|row| {
            let value = row.cells.get(column)?.text();
            stated_length(heading, &value, heading.unit.as_deref(), row.line)
        })
        .collect()
}

/// Returns the column of lengths of `block` whose heading is one of `words`, except the columns
/// `of_curve`. Returns `None` if there is none, or several.
pub(crate) fn size_column(block: &Block, of_curve: &[usize], words: Words) -> Option<usize> {
    let mut sizes = block.number_columns().into_iter().filter(|column| {
        let Some(heading) = block.headings.get(*column) else { return false };
        let unit = heading.unit.as_deref();
        !of_curve.contains(column)
            && is_size_name(&heading.name, words)
            && unit.is_some_and(|unit| parse_unit(unit, &[Quantity::Length]).is_ok())
    });
    sizes.next().filter(|_| sizes.next().is_none())
}

/// Returns whether `name` begins with one of `words`.
fn is_size_name(name: &str, words: Words) -> bool {
    let plain = normal(name);
    single(words).any(|word| {
        let is_start = plain.strip_prefix(word).is_some_and(|rest| {
            word.len() > 2 || !rest.starts_with(|letter: char| letter.is_alphanumeric())
        });
        is_start || (!word.is_ascii() && plain.contains(word))
    })
}

/// Returns the lengths of `row`: each stands behind its name, in one cell or in the next cell.
fn lengths_of_row(row: &Row, words: Words) -> Vec<StatedLength> {
    let cells: Vec<String> = row.filled().map(|(_, cell)| Cell::text(cell)).collect();
    if let [cell] = cells.as_slice() {
        // "Gauge length: 50 mm", "Gauge length 50 mm".
        let digit = cell.find(|letter: char| letter.is_ascii_digit());
        let pair = cell
            .split_once([':', '=', '：'])
            .or_else(|| digit.and_then(|place| cell.split_at_checked(place)));
        let length = pair.and_then(|(name, value)| named_length(name, value, None, (row, words)));
        return length.into_iter().collect();
    }
    let mut lengths = Vec::new();
    for (place, pair) in cells.windows(2).enumerate() {
        let unit = cells.get(place + 2).map(String::as_str);
        lengths.extend(named_length(&pair[0], &pair[1], unit, (row, words)));
    }
    lengths
}

/// Returns the length `value` behind `name`, if the name is one of the words. The unit stands
/// behind the number, in the name, or in the `next` cell.
fn named_length(
    name: &str,
    value: &str,
    next: Option<&str>,
    (row, words): (&Row, Words),
) -> Option<StatedLength> {
    let heading = Heading::parse(name);
    if !is_size_name(&heading.name, words) {
        return None;
    }
    stated_length(&heading, value, heading.unit.as_deref().or(next), row.line)
}

/// Returns the length `value` with the name of `heading`. A value without a unit has the given
/// `unit`.
fn stated_length(
    heading: &Heading,
    value: &str,
    unit: Option<&str>,
    line: usize,
) -> Option<StatedLength> {
    let (number, written) = split_unit(value.trim())?;
    let unit = written.or(unit)?;
    let unit = parse_unit(without_brackets(unit), &[Quantity::Length]).ok()?;
    let length = number * unit.factor;
    (length > 0.0).then(|| StatedLength { length, line, name: heading.name.clone() })
}

/// Splits a `text` such as `50 mm` into number and unit.
fn split_unit(text: &str) -> Option<(f64, Option<&str>)> {
    let is_of_unit = |letter: char| letter.is_alphabetic() || "㎜㎝".contains(letter);
    let end = text.find(is_of_unit).unwrap_or(text.len());
    let (number, unit) = text.split_at(end);
    let decimal = if number.contains(',') { Decimal::Comma } else { Decimal::Point };
    let number = parse(number, decimal)?;
    Some((number, Some(unit.trim()).filter(|unit| !unit.is_empty())))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tables::grid::Separator;

    fn around(text: &str) -> Surroundings {
        let rows = Separator::Semicolon.split(text).expect("it splits");
        Surroundings { rows, ..Surroundings::default() }
    }

    #[test]
    fn a_length_is_read_however_it_is_stated() {
        for text in [
            "Gauge length;50;mm\n",
            "Gauge length (mm);50\n",
            "Gauge length: 50 mm\n",
            "Gauge length 50 mm\n",
            "Width;40;mm;Gauge length;50;mm\n",
            "夹距;50 mm\n",
            "Einspannlänge;50,0 mm\n",
            "チャック間距離(mm);50\n",
            "L0;5;cm\n",
        ] {
            let found = around(text).stated("", GAUGE).expect(text);
            assert!((found.length - 0.05).abs() < 1e-12, "{text}: {found:?}");
        }
        let two = around("Width;50;mm\nWidth;40;mm\n");
        assert_eq!(two.stated("", WIDTH), None, "which of the two?");
        assert_eq!(around("Load cell;50;N\nLongest;50;mm\n").stated("", GAUGE), None);
    }

    #[test]
    fn a_table_of_specimens_states_their_sizes() {
        let text = |second: f64| {
            format!(
                "名前;厚さ;幅;ゲージ長\n;mm;mm;cm\n1 _ 1;0,4;50,0;20,0\n1 _ 2;0,4;{second};20,0\n"
            )
        };
        let table = |text: &str| {
            let rows = Separator::Semicolon.split(text).expect("it splits");
            let grid = crate::tables::grid::Grid { rows, ..Default::default() };
            let tables = crate::tables::block::blocks(&grid, Default::default()).blocks;
            assert!(tables.iter().any(has_sizes), "{text}");
            Surroundings { tables, ..Surroundings::default() }
        };
        let same = table(&text(50.0));
        let near = |found: Option<StatedLength>, wanted: f64| {
            assert!(found.is_some_and(|found| (found.length - wanted).abs() < 1e-12));
        };
        near(same.stated("", GAUGE), 0.2);
        near(same.stated("1 _ 1", WIDTH), 0.05);
        let other = table(&text(25.0));
        assert_eq!(other.stated("", WIDTH), None, "which of the two?");
        near(other.stated("1 _ 2", WIDTH), 0.025);
    }
}
