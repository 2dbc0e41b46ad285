//! What the files of a draft hold: curves, values, and files that give nothing.

use std::collections::BTreeSet;
use std::path::Path;

use drape_input::{Diagnostic, Diagnostics, Quantity, parse_unit};

use crate::exports::compression;
use crate::exports::curve_draft::{CurveDraft, Key};
use crate::exports::evidence::Evidence;
use crate::exports::files::{Files, is_other};
use crate::exports::found::{Export, OpenDraft, in_words};
use crate::results::average::{Averaged, Given, rounded};
use crate::results::item::Item;
use crate::results::sheet_results::results;
use crate::tables::block::{Lines, blocks};
use crate::tables::columns::Pair;
use crate::tables::file::{self, TableFile};
use crate::tables::grid::{Grid, Row};
use crate::tables::layout::Layout;
use crate::tables::number::Decimal;
use crate::tables::series::Series;
use crate::tables::stated::Around;
use crate::test::Test;

/// Relative difference of the gauges of two curves from which on they are no repeats.
const REPEAT_GAUGE: f64 = 0.1;
/// Rows of a block of numbers that are looked through for values: a longer one is a curve, perhaps
/// with values beside its beginning.
const ROWS_OF_VALUES: usize = 1000;

/// Parts of a draft while the files are read.
#[derive(Default)]
pub(crate) struct Parts {
    pub(crate) curves: Vec<CurveDraft>,
    /// Curves that need a word.
    pub(crate) open: Vec<OpenDraft>,
    /// Curves of strips on the bias.
    pub(crate) bias: Vec<OpenDraft>,
    pub(crate) values: Vec<FileValue>,
    /// Files that gave nothing, with the reason.
    pub(crate) unread: Vec<(String, String)>,
    pub(crate) notes: Vec<String>,
}

/// Value with its place.
#[derive(Clone, Debug)]
pub(crate) struct FileValue {
    /// Name of the fabric, where its table gives one.
    pub(crate) fabric: Option<String>,
    /// Name of the file, and of its sheet; empty for a text file.
    pub(crate) table: (String, String),
    pub(crate) value: Averaged,
}

impl FileValue {
    /// Returns the place of the value in words.
    pub(crate) fn source(&self) -> String {
        let (file, sheet) = &self.table;
        let sheet = if sheet.is_empty() { String::new() } else { format!(", sheet \"{sheet}\"") };
        let (first, last) = self.value.lines;
        let lines = if first == last {
            format!("line {first}")
        } else {
            format!("lines {first} to {last}")
        };
        format!("{file}{sheet}, {lines}")
    }
}

impl Parts {
    /// Reads all files.
    pub(crate) fn of(files: &Files) -> Self {
        let mut parts = Self::default();
        files.files.iter().for_each(|(path, name)| parts.add(path, name, &files.folder));
        parts.join_repeats(&files.folder);
        parts
    }

    /// Returns whether no file holds a curve or a value.
    pub(crate) fn is_empty(&self) -> bool {
        let curves = [self.curves.len(), self.open.len(), self.bias.len()];
        curves == [0; 3] && self.values.is_empty()
    }

    /// Adds what a file holds.
    fn add(&mut self, path: &Path, name: &str, folder: &Path) {
        if is_other(path) {
            self.unread.push((name.to_owned(), "no table, by its ending".into()));
            return;
        }
        let file = match file::read(path, &Layout::default()) {
            Ok(file) => file,
            Err(mistakes) => {
                let words: Vec<String> = mistakes.0.iter().map(in_words).collect();
                self.unread.push((name.to_owned(), words.join("; ")));
                return;
            }
        };
        let export = Export { path, name: name.to_owned(), file: &file, folder };
        let drafts = export.drafts();
        let found = |parts: &Self| {
            parts.curves.len() + parts.open.len() + parts.bias.len() + parts.values.len()
        };
        let before = found(self);
        self.curves.extend(drafts.good);
        self.open.extend(drafts.open);
        self.bias.extend(drafts.bias);
        let mut reasons = Vec::new();
        for grid in &file.grids {
            self.add_values(grid, &export, &mut reasons);
        }
        if found(self) == before {
            if reasons.is_empty() {
                reasons = why_nothing(path, &file);
            }
            self.unread.push((name.to_owned(), reasons.join("; ")));
        } else {
            self.notes.extend(reasons.into_iter().map(|reason| format!("{name}: {reason}")));
        }
    }

    /// Adds the values of a sheet of a file: of its tables of results, and of a compression curve.
    fn add_values(&mut self, grid: &Grid, export: &Export<'_>, reasons: &mut Vec<String>) {
        let found = blocks(grid, Lines::default());
        let mut without: BTreeSet<usize> = BTreeSet::new();
        let mut all: Vec<(Option<String>, Averaged)> = Vec::new();
        for block in found.blocks {
            let beyond = block.rows.iter().skip(ROWS_OF_VALUES);
            without.extend(beyond.map(|row: &Row| row.line));
            let Some(columns) = compression::columns(&block) else { continue };
            let [deformation, load] = columns;
            let line = block.first_line();
            without.extend(block.rows.iter().map(|row| row.line));
            let series = Series {
                path: export.path.to_owned(),
                pair: Pair { deformation, load, label: String::new() },
                decimal: Decimal::Point,
                label: String::new(),
                around: Around::default(),
                several: false,
                block,
            };
            match compression::values(&series, columns) {
                Ok(c) => all.extend(of_compression(c, line).into_iter().map(|value| (None, value))),
                Err(reason) => reasons.push(format!("compression, line {line}: {reason}")),
            }
        }
        let evidence = Evidence::of_rows(&grid.sheet, &[], export.path);
        let told = evidence.direction().ok().filter(|_| evidence.bias().is_none());
        let given = told.map(|told| Given { direction: told.value, why: told.why });
        let of_tables = results(grid, &without, given.as_ref());
        let sheet = |note: String| match grid.sheet.as_str() {
            "" => note,
            sheet => format!("sheet \"{sheet}\": {note}"),
        };
        reasons.extend(of_tables.notes.into_iter().map(sheet));
        for (fabric, values) in of_tables.fabrics {
            all.extend(values.into_iter().map(|value| (fabric.clone(), value)));
        }
        let table = (export.name.clone(), grid.sheet.clone());
        self.values.extend(all.into_iter().map(|(fabric, value)| FileValue {
            fabric,
            table: table.clone(),
            value,
        }));
    }

    /// Joins curves of several files that are alike: the repeats of a laboratory. Arches are no
    /// repeats: they buckle up or down.
    fn join_repeats(&mut self, folder: &Path) {
        let mut joined: Vec<CurveDraft> = Vec::new();
        for curve in std::mem::take(&mut self.curves) {
            let direction = |curve: &CurveDraft| curve.direction.as_ref().ok().map(|d| d.value);
            let plain = |keys: &[Key]| -> Vec<(&'static str, String)> {
                let told = keys.iter().filter(|key| !["header", "decimal"].contains(&key.name));
                told.map(|key| (key.name, key.value.clone())).collect()
            };
            let alike = |other: &&mut CurveDraft| {
                curve.test.value != Test::LoopBending
                    && other.test.value == curve.test.value
                    && direction(other) == direction(&curve)
                    && plain(&other.layout) == plain(&curve.layout)
                    && (0..2).all(|axis| plain(&other.axes[axis]) == plain(&curve.axes[axis]))
            };
            let gauge = |draft: &CurveDraft| draft.read(folder).ok()?.first()?.gauge;
            let is_as_long = |other: &CurveDraft| {
                let lengths = gauge(other).zip(gauge(&curve));
                lengths.is_none_or(|(a, b)| (a / b - 1.0).abs() < REPEAT_GAUGE)
            };
            let is_repeat = |other: &&mut CurveDraft| alike(other) && is_as_long(other);
            if let Some(other) = joined.iter_mut().find(is_repeat) {
                let mut both = other.clone();
                both.files.extend(curve.files.clone());
                if both.layout != curve.layout {
                    both.layout.retain(|key| !["header", "decimal"].contains(&key.name));
                }
                if both.read(folder).is_ok() {
                    *other = both;
                    continue;
                }
            }
            joined.push(curve);
        }
        self.curves = joined;
    }

    /// Returns the mistake of files without anything to read.
    pub(crate) fn nothing(&self, files: &Path) -> Diagnostics {
        let all = &self.unread;
        let is_folder = files.is_dir();
        if all.is_empty() {
            let what = if is_folder { "folder" } else { "archive" };
            let finding = Diagnostic::new(files, format!("the {what} holds no files"));
            return finding.help("export the curves from the instrument's program into it").into();
        }
        let one = |(name, reason): &(String, String)| format!("{name}: {reason}");
        let reasons: Vec<String> = all.iter().take(10).map(one).collect();
        let message = match (is_folder, all.as_slice()) {
            (false, [(_, reason)]) => format!("there is no curve and no value in it: {reason}"),
            (false, _) => {
                format!("no file of the archive is a curve or a value: {}", reasons.join("; "))
            }
            _ => format!("no file of the folder is a curve or a value: {}", reasons.join("; ")),
        };
        let help = "a curve has a line of names above columns of deformation and load, such as \
                    \"Strain (%),Force (gf/cm)\"; a table of values has symbols such as B, 2HB, G, WT, \
                    or their names";
        Diagnostic::new(files, message).help(help).into()
    }
}

/// Returns the values of a compression curve.
fn of_compression(c: compression::Compression, line: usize) -> Vec<Averaged> {
    let values = [
        ("T0", Some(c.t0), Quantity::Length),
        ("TM", Some(c.tm), Quantity::Length),
        ("LC", Some(c.lc), Quantity::Ratio),
        ("WC", Some(c.wc), Quantity::WorkPerArea),
        ("RC", c.rc, Quantity::Ratio),
    ];
    let value = |(key, number, quantity): (&'static str, Option<f64>, Quantity)| {
        let unit = quantity.laboratory();
        Some(Averaged {
            item: Item::Key(key),
            direction: None,
            // The digits of the curve, not those of the sum.
            number: rounded(number?, 6),
            deviation: None,
            unit: parse_unit(unit.spelling, &[quantity]).ok().filter(|_| key != "LC"),
            lines: (line, line),
            remark: "from a compression curve".to_owned(),
        })
    };
    values.into_iter().filter_map(value).collect()
}

/// Returns why a file has no curve and no value.
fn why_nothing(path: &Path, file: &TableFile) -> Vec<String> {
    let mut rows = 0;
    for grid in &file.grids {
        let found = blocks(grid, Lines::default());
        if let Some(block) = found.blocks.iter().max_by_key(|block| block.rows.len()) {
            rows += block.rows.len();
        }
        let evidence = Evidence::of_rows(&grid.sheet, &grid.rows, path);
        if let Some(other) = evidence.other_test().filter(|_| rows > 0) {
            let help = match other.value {
                "surface" => "write MIU, MMD, SMD of its program",
                _ => "write T0, TM, LC, WC, RC of its program",
            };
            return vec![format!("{} it is a {} test: {help} as values", other.why, other.value)];
        }
    }
    if rows == 0 {
        return vec!["it has no rows of numbers".to_owned()];
    }
    vec![
        "no two of its columns are deformation and load by their headings; name them: \
         deformation = { column = 1, unit = \"%\" }, load = { column = 2, unit = \"gf/cm\" }"
            .to_owned(),
    ]
}
