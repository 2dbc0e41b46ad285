//! Contents of the files of a draft: curves, values, and files without either.

use std::collections::BTreeSet;
use std::path::Path;

use drape_input::{Diagnostic, Diagnostics, Quantity, parse_unit, round_digits};

use crate::exports::compression;
use crate::exports::curve_draft::{CurveDraft, Key};
use crate::exports::evidence::Evidence;
use crate::exports::file_curves::{Export, OpenDraft, describe_mistake};
use crate::exports::files::{Files, holds_no_table};
use crate::results::average::{AssumedDirection, AveragedValue};
use crate::results::item::Item;
use crate::results::sheet_results::results;
use crate::tables::block::{Lines, blocks};
use crate::tables::columns::Pair;
use crate::tables::file::{self, TableFile};
use crate::tables::grid::{Grid, Row};
use crate::tables::layout::Layout;
use crate::tables::number::Decimal;
use crate::tables::series::Series;
use crate::tables::stated::Surroundings;
use crate::test::Test;

/// Contents of the files of a draft.
#[derive(Default)]
pub(crate) struct FileContents {
    pub(crate) curves: Vec<CurveDraft>,
    /// Curves that a person has to complete.
    pub(crate) open: Vec<OpenDraft>,
    /// Curves of strips on the bias.
    pub(crate) bias: Vec<OpenDraft>,
    pub(crate) values: Vec<FileValue>,
    /// Files without a curve or value, with the reason.
    pub(crate) unread: Vec<(String, String)>,
    pub(crate) notes: Vec<String>,
}

/// Value of a file with its place.
#[derive(Clone, Debug)]
/// Name of the fabric, if its table gives a name.
pub(crate) struct FileValue {
    /// Name of the fabric, where its table gives one.
    pub(crate) fabric: Option<String>,
    /// Name of the file and name of its sheet. A text file has an empty name of a sheet.
    pub(crate) table: (String, String),
    pub(crate) value: AveragedValue,
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

impl FileContents {
    /// Reads all `files`.
    pub(crate) fn from_files(files: &Files) -> Self {
        let mut parts = Self::default();
        files.files.iter().for_each(|(path, name)| parts.add(path, name, files));
        parts.join_repeats(files);
        parts
    }

    /// Returns whether no file holds a curve or a value.
    pub(crate) fn is_empty(&self) -> bool {
        let curves = [self.curves.len(), self.open.len(), self.bias.len()];
        curves == [0; 3] && self.values.is_empty()
    }

    /// Adds the contents of the file `path` with the given `name`, one of `files`. Its curves are
    /// verified in the folder of `files`.
    fn add(&mut self, path: &Path, name: &str, files: &Files) {
        if holds_no_table(path) {
            self.unread.push((name.to_owned(), "no table, by its ending".into()));
            return;
        }
        let file = match file::read(path, &Layout::default(), &files.access) {
            Ok(file) => file,
            Err(mistakes) => {
                let words: Vec<String> = mistakes.0.iter().map(describe_mistake).collect();
                self.unread.push((name.to_owned(), words.join("; ")));
                return;
            }
        };

        let export = Export { path, name: name.to_owned(), file: &file, files };
        let drafts = export.drafts();
        let before = self.count();
        self.curves.extend(drafts.good);
        self.open.extend(drafts.open);
        self.bias.extend(drafts.bias);
        let mut reasons = Vec::new();
        for grid in &file.grids {
            self.add_values(grid, &export, &mut reasons);
        }
        if self.count() == before {
            if reasons.is_empty() {
                reasons = reason_for_nothing(path, &file);
            }
            self.unread.push((name.to_owned(), reasons.join("; ")));
        } else {
            self.notes.extend(reasons.into_iter().map(|reason| format!("{name}: {reason}")));
        }
    }

    /// Returns the number of curves and values.
    fn count(&self) -> usize {
        self.curves.len() + self.open.len() + self.bias.len() + self.values.len()
    }

    /// Adds the values of a sheet of a file: its tables of results and its compression curves. Adds
    /// to `reasons` what has no use.
    fn add_values(&mut self, grid: &Grid, export: &Export<'_>, reasons: &mut Vec<String>) {
        /// Largest number of rows of a block that are searched for values. A longer block is a
        /// curve, perhaps with values beside its beginning.
        const ROWS_OF_VALUES: usize = 1000;

        let mut without: BTreeSet<usize> = BTreeSet::new();
        let mut all: Vec<(Option<String>, AveragedValue)> = Vec::new();
        for block in blocks(grid, Lines::default()).blocks {
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
                around: Surroundings::default(),
                has_neighbours: false,
                block,
            };
            match compression::values(&series, columns) {
                Ok(values) => all.extend(
                    compression_values(values, line).into_iter().map(|value| (None, value)),
                ),
                Err(reason) => reasons.push(format!("compression, line {line}: {reason}")),
            }
        }

        // The name of the sheet or the file may name the direction of all values.
        let evidence = Evidence::from_rows(&grid.sheet, &[], export.path);
        let direction = evidence.direction().ok().filter(|_| evidence.bias().is_none());
        let assumed = direction
            .map(|direction| AssumedDirection { direction: direction.value, why: direction.why });
        let of_tables = results(grid, &without, assumed.as_ref());
        reasons.extend(of_tables.notes.into_iter().map(|note| match grid.sheet.as_str() {
            "" => note,
            sheet => format!("sheet \"{sheet}\": {note}"),
        }));
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

    /// Joins curves of several files that are repeats of one test. Arches are never joined, because
    /// they may buckle up or down.
    fn join_repeats(&mut self, files: &Files) {
        let mut joined: Vec<CurveDraft> = Vec::new();
        for curve in std::mem::take(&mut self.curves) {
            let is_repeat = |other: &&mut CurveDraft| are_alike(other, &curve, files);
            if let Some(first) = joined.iter_mut().find(is_repeat) {
                let mut both = first.clone();
                both.files.extend(curve.files.clone());
                if both.layout != curve.layout {
                    both.layout.retain(|key| !FILE_KEYS.contains(&key.name));
                }
                if both.read(files).is_ok() {
                    *first = both;
                    continue;
                }
            }
            joined.push(curve);
        }
        self.curves = joined;
    }

    /// Returns the mistake of `files` without a curve or value.
    pub(crate) fn nothing(&self, files: &Path) -> Diagnostics {
        let is_folder = files.is_dir();
        if self.unread.is_empty() {
            let kind = if is_folder { "folder" } else { "archive" };
            let finding = Diagnostic::new(files, format!("the {kind} holds no files"));
            return finding.help("export the curves from the instrument's program into it").into();
        }

        let reasons: Vec<String> =
            self.unread.iter().take(10).map(|(name, reason)| format!("{name}: {reason}")).collect();
        let message = match (is_folder, self.unread.as_slice()) {
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

/// Keys of the layout that may differ between the files of repeats.
const FILE_KEYS: [&str; 2] = ["header", "decimal"];

/// Returns whether two drafts are repeats of one test: their keys agree, and their gauges are
/// equal.
fn are_alike(first: &CurveDraft, second: &CurveDraft, files: &Files) -> bool {
    /// Relative difference of the gauges of two curves above which the curves are no repeats.
    const REPEAT_GAUGE: f64 = 0.1;

    let [direction, other_direction] =
        [first, second].map(|curve| curve.direction.as_ref().ok().map(|direction| direction.value));
    let have_one_layout = first.test.value != Test::LoopBending
        && first.test.value == second.test.value
        && direction == other_direction
        && have_equal_keys(&first.layout, &second.layout)
        && first.axes.iter().zip(&second.axes).all(|(a, b)| have_equal_keys(a, b));
    // The files are read only if the keys agree, because reading takes time.
    have_one_layout && {
        let [gauge, other_gauge] =
            [first, second].map(|curve| curve.read(files).ok()?.first()?.gauge);
        gauge.zip(other_gauge).is_none_or(|(a, b)| (a / b - 1.0).abs() < REPEAT_GAUGE)
    }
}

/// Returns whether two lists of keys agree, except in the keys that may differ between files.
fn have_equal_keys(first: &[Key], second: &[Key]) -> bool {
    let [first, second] = [first, second].map(|keys| {
        keys.iter()
            .filter(|key| !FILE_KEYS.contains(&key.name))
            .map(|key| (key.name, &key.value))
            .collect::<Vec<_>>()
    });
    first == second
}

/// Returns the values of the compression curve on `line` as values of a sheet.
fn compression_values(c: compression::Compression, line: usize) -> Vec<AveragedValue> {
    let values = [
        ("T0", Some(c.t0), Quantity::Length),
        ("TM", Some(c.tm), Quantity::Length),
        ("LC", Some(c.lc), Quantity::Ratio),
        ("WC", Some(c.wc), Quantity::WorkPerArea),
        ("RC", c.rc, Quantity::Ratio),
    ];
    let mut values_of_sheet = Vec::new();
    for (key, number, quantity) in values {
        let Some(number) = number else { continue };
        let unit = quantity.laboratory();
        values_of_sheet.push(AveragedValue {
            item: Item::Key(key),
            direction: None,
            // The integral has no more digits than the curve.
            number: round_digits(number, 6),
            deviation: None,
            unit: parse_unit(unit.spelling, &[quantity]).ok().filter(|_| key != "LC"),
            lines: (line, line),
            remark: "from a compression curve".to_owned(),
        });
    }
    values_of_sheet
}

/// Returns the reasons why `file` has no curve and no value.
fn reason_for_nothing(path: &Path, file: &TableFile) -> Vec<String> {
    let mut rows = 0;
    for grid in &file.grids {
        let blocks = blocks(grid, Lines::default()).blocks;
        rows += blocks.iter().map(|block| block.rows.len()).max().unwrap_or(0);
        let evidence = Evidence::from_rows(&grid.sheet, &grid.rows, path);
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
