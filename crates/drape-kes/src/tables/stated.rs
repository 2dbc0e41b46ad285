//! Gauge and width that a file states: above its numbers, or in a column of them.

use crate::tables::block::{Block, unbracketed};
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
pub(crate) struct Stated {
    /// Length, in metres.
    pub(crate) length: f64,
    pub(crate) line: usize,
    /// Name that the file gives it.
    pub(crate) name: String,
}

/// What a sheet holds around its curves.
#[derive(Clone, Debug, Default)]
pub(crate) struct Around {
    /// Lines of text.
    pub(crate) rows: Vec<Row>,
    /// Tables with a column of gauges or of widths.
    pub(crate) tables: Vec<Block>,
}

impl Around {
    /// Returns the length that goes by one of some names; `None` where there is none, or two that
    /// differ.
    ///
    /// In a table of several specimens the rows with the `title` of the curve decide.
    pub(crate) fn stated(&self, title: &str, words: Words) -> Option<Stated> {
        let mut all: Vec<Stated> = self.rows.iter().flat_map(|row| of_row(row, words)).collect();
        if all.is_empty() {
            all = self.tables.iter().flat_map(|block| of_table(block, title, words)).collect();
        }
        let first = all.first()?.clone();
        all.iter().all(|other| (other.length / first.length - 1.0).abs() < 1e-9).then_some(first)
    }
}

/// Returns whether a table has a column of gauges or of widths.
pub(crate) fn has_sizes(block: &Block) -> bool {
    [GAUGE, WIDTH].iter().any(|words| size_column(block, &[], words).is_some())
}

/// Returns the lengths of the rows of a table, or of the rows that have a name.
fn of_table(block: &Block, title: &str, words: Words) -> Vec<Stated> {
    let Some(column) = size_column(block, &[], words) else { return Vec::new() };
    let heading = &block.headings[column];
    let is_title = |text: String| !title.is_empty() && normal(&text) == normal(title);
    let is_titled = |row: &&Row| row.filled().any(|(_, cell)| is_title(cell.text()));
    let titled: Vec<&Row> = block.rows.iter().filter(is_titled).collect();
    let rows = if titled.is_empty() { block.rows.iter().collect() } else { titled };
    let of_row = |row: &Row| {
        let value = row.cells.get(column)?.text();
        let (number, own) = split_unit(value.trim())?;
        let unit = parse_unit(&own.or(heading.unit.clone())?, &[Quantity::Length]).ok()?;
        let length = number * unit.factor;
        (length > 0.0).then(|| Stated { length, line: row.line, name: heading.name.clone() })
    };
    rows.into_iter().filter_map(of_row).collect()
}

/// Returns the column of lengths whose heading is one of some names, other than the columns of the
/// curve; `None` where there is none, or several.
pub(crate) fn size_column(block: &Block, of_curve: &[usize], words: Words) -> Option<usize> {
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
fn is_named(name: &str, words: Words) -> bool {
    let plain = normal(name);
    single(words).any(|word| {
        let ends = |rest: &str| !rest.starts_with(|letter: char| letter.is_alphanumeric());
        let is_start = plain.strip_prefix(word).is_some_and(|rest| word.len() > 2 || ends(rest));
        is_start || (!word.is_ascii() && plain.contains(word))
    })
}

/// Returns the lengths of a row: each stands behind its name, in one cell or in the next.
fn of_row(row: &Row, words: Words) -> Vec<Stated> {
    let cells: Vec<String> = row.filled().map(|(_, cell)| Cell::text(cell)).collect();
    let length = |name: &str, value: &str, next: Option<&String>| {
        let heading = Heading::parse(name);
        if !is_named(&heading.name, words) {
            return None;
        }
        let (number, own) = split_unit(value.trim())?;
        let unit = own.or_else(|| heading.unit.clone()).or_else(|| next.cloned())?;
        let unit = parse_unit(unbracketed(&unit), &[Quantity::Length]).ok()?;
        let length = number * unit.factor;
        (length > 0.0).then_some(Stated { length, line: row.line, name: heading.name })
    };
    if let [one] = cells.as_slice() {
        // "Gauge length: 50 mm", "Gauge length 50 mm".
        let sign = one.split_once([':', '=', '：']);
        let digit = || one.split_at_checked(one.find(|letter: char| letter.is_ascii_digit())?);
        let pair = sign.or_else(digit);
        return pair.and_then(|(name, value)| length(name, value, None)).into_iter().collect();
    }
    let of_place = |place: usize| {
        let (name, value) = (&cells[place], cells.get(place + 1)?);
        length(name, value, cells.get(place + 2))
    };
    (0..cells.len()).filter_map(of_place).collect()
}

/// Splits `50 mm` into number and unit.
fn split_unit(text: &str) -> Option<(f64, Option<String>)> {
    let of_unit = |letter: char| letter.is_alphabetic() || "㎜㎝".contains(letter);
    let end = text.find(of_unit).unwrap_or(text.len());
    let (number, unit) = text.split_at(end);
    let decimal = if number.contains(',') { Decimal::Comma } else { Decimal::Point };
    let number = parse(number, decimal)?;
    Some((number, (!unit.trim().is_empty()).then(|| unit.trim().to_owned())))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tables::grid::Separator;

    fn around(text: &str) -> Around {
        let rows = Separator::Semicolon.split(text).expect("it splits");
        Around { rows, ..Around::default() }
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
            Around { tables, ..Around::default() }
        };
        let same = table(&text(50.0));
        let near = |found: Option<Stated>, wanted: f64| {
            assert!(found.is_some_and(|found| (found.length - wanted).abs() < 1e-12));
        };
        near(same.stated("", GAUGE), 0.2);
        near(same.stated("1 _ 1", WIDTH), 0.05);
        let other = table(&text(25.0));
        assert_eq!(other.stated("", WIDTH), None, "which of the two?");
        near(other.stated("1 _ 2", WIDTH), 0.025);
    }
}
