//! Curves of one file: every table that has the columns of a test, drafted with what was detected.

use std::path::Path;

use drape_input::{Diagnostic, Quantity, parse_unit, toml_string};

use crate::curves::curve::Curve;
use crate::exports::curve_draft::{CurveDraft, Key};
use crate::exports::evidence::{Evidence, Told};
use crate::sheets::axis::{AxisKeys, deformation_quantities, load_quantities};
use crate::tables::file::TableFile;
use crate::tables::find::{Request, decimal, every, is_repeat};
use crate::tables::grid::{Cell, Grid};
use crate::tables::heading::words::Words;
use crate::tables::heading::{self, Kind};
use crate::tables::layout::{Column, Layout, Take};
use crate::tables::number::{Decimal, Evidence as Sign};
use crate::tables::series::Series;
use crate::tables::stated::{GAUGE, WIDTH};
use crate::test::{Direction, Test};

/// Tests whose curves are looked for.
const TESTS: [Test; 3] = [Test::Tensile, Test::Shear, Test::Bending];
/// Negative strain at the start from which on a strip is slack.
const SLACK_MIN: f64 = 1e-3;
/// Part of its largest value below zero from which on a length is no tensile extension.
const BOTH_WAYS: f64 = 0.3;

/// File of exports, and its path relative to the folder of the sheet.
pub(crate) struct Export<'a> {
    pub(crate) path: &'a Path,
    pub(crate) name: String,
    pub(crate) file: &'a TableFile,
    /// Folder of the sheet.
    pub(crate) folder: &'a Path,
}

/// Drafts of a file: those that the reader of sheets takes, and those that need a word.
#[derive(Default)]
pub(crate) struct Drafts {
    pub(crate) good: Vec<CurveDraft>,
    pub(crate) open: Vec<OpenDraft>,
    /// Drafts of strips on the bias, to which no law is fitted.
    pub(crate) bias: Vec<OpenDraft>,
}

/// Draft of a section that a person has to complete, with the reason.
#[derive(Clone)]
pub(crate) struct OpenDraft {
    pub(crate) draft: CurveDraft,
    pub(crate) reason: String,
}

/// Series with its number among those of its test.
#[derive(Clone)]
struct Item {
    test: Test,
    number: usize,
    of: usize,
    series: Series,
}

/// Keys of gauge and width, with what is missing: those keys are to be filled in.
struct Sizes {
    axes: [Vec<Key>; 2],
    missing: Option<String>,
}

/// Series of one test and direction in one sheet of a file.
struct Group {
    test: Result<Told<Test>, String>,
    direction: Result<Told<Direction>, String>,
    items: Vec<Item>,
    is_kes: bool,
    /// Text that says that the strip was cut on the bias.
    bias: Option<String>,
}

impl Export<'_> {
    /// Drafts the curves of the file.
    pub(crate) fn drafts(&self) -> Drafts {
        let mut drafts = Drafts::default();
        for grid in &self.file.grids {
            for group in self.groups(grid) {
                self.draft(grid, &group, &mut drafts);
            }
        }
        drafts
    }

    fn layout(grid: &Grid) -> Layout {
        let sheet = (!grid.sheet.is_empty()).then(|| Column::Name(grid.sheet.clone()));
        Layout { sheet, table: Take::All, ..Layout::default() }
    }

    /// Finds the series of all tests in a sheet, by test and direction.
    fn groups(&self, grid: &Grid) -> Vec<Group> {
        let mut places: Vec<Vec<Item>> = Vec::new();
        for test in TESTS {
            let open = [AxisKeys::default(), AxisKeys::default()];
            let request = Request {
                test,
                direction: Direction::Warp,
                deformation: open[0].query("deformation", test),
                load: open[1].query("load", test),
            };
            let Ok(found) = every(self.path, self.file, &Self::layout(grid), &request) else {
                continue;
            };
            let of = found.series.len();
            for (index, series) in found.series.into_iter().enumerate() {
                let item = Item { test, number: index + 1, of, series };
                match places.iter_mut().find(|place| place[0].is_at(&item)) {
                    Some(place) => place.push(item),
                    None => places.push(vec![item]),
                }
            }
        }
        let mut groups: Vec<Group> = Vec::new();
        for place in places {
            let group = self.group(place);
            let same = |other: &&mut Group| {
                let value = |group: &Group| group.direction.as_ref().ok().map(|told| told.value);
                other.items[0].test == group.items[0].test
                    && other.bias.is_some() == group.bias.is_some()
                    && other.test.is_ok() == group.test.is_ok()
                    && value(other) == value(&group)
            };
            match groups.iter_mut().find(same) {
                Some(other) => other.items.extend(group.items),
                None => groups.push(group),
            }
        }
        groups
    }

    /// Tells test and direction of a series that has the columns of one test or several.
    fn group(&self, place: Vec<Item>) -> Group {
        let evidence = Evidence::of_series(&place[0].series, self.path);
        let fits = |test: Test| place.iter().find(|item| item.test == test);
        let first = place[0].test;
        let (test, item) = match (evidence.test(), place.len()) {
            (Some(told), _) => match fits(told.value) {
                Some(item) => (Ok(told), item.clone()),
                None if told.value == Test::Bending
                    && evidence.is_arch
                    && fits(Test::Tensile).is_some() =>
                {
                    let test = Test::LoopBending;
                    (Ok(Told { value: test, ..told }), Item { test, ..place[0].clone() })
                }
                None => {
                    let (named, test) = (told.value.name(), first.name());
                    let reason = format!(
                        "its columns are those of a {test} test, and {} it is {named}",
                        told.why
                    );
                    (Err(reason), place[0].clone())
                }
            },
            (None, 1) => {
                let Told { value, why } = Told { value: first, why: place[0].series.columns() };
                let test = Ok(Told { value, why: format!("by its columns, {why}") });
                (test, place[0].clone())
            }
            (None, _) => (place[0].series.tensile(), place[0].clone()),
        };
        let other = evidence.other_test().filter(|_| evidence.test().is_none());
        let test = match other {
            Some(other) if first != Test::Bending => Err(format!(
                "{} it is a {} test, which a sheet takes as values",
                other.why, other.value
            )),
            _ => test,
        };
        let (direction, bias) = (evidence.direction(), evidence.bias());
        Group { direction, is_kes: evidence.is_kes, items: vec![item], test, bias }
    }

    /// Drafts a group, and verifies the draft.
    fn draft(&self, grid: &Grid, group: &Group, drafts: &mut Drafts) {
        let first = &group.items[0];
        let test = match &group.test {
            Ok(told) => told.clone(),
            Err(reason) => Told { value: first.test, why: reason.clone() },
        };
        let mut draft = CurveDraft {
            test,
            direction: group.direction.clone(),
            files: vec![self.name.clone()],
            layout: group.choice(grid),
            axes: [Vec::new(), Vec::new()],
            remarks: first.series.unused_columns(),
        };
        let mut reasons = Vec::new();
        reasons.extend(group.test.as_ref().err().cloned());
        reasons.extend(group.direction.as_ref().err().cloned());
        reasons.extend(group.not_repeats());
        let sizes = first.sizes(group.is_kes);
        reasons.extend(sizes.missing);
        draft.axes = sizes.axes;
        self.add_slack(&mut draft);
        let read = draft.read(self.folder);
        match read {
            Ok(curves) => draft = self.declared(draft, group, &curves),
            Err(mistakes) if reasons.is_empty() => {
                reasons.extend(mistakes.0.iter().map(in_words));
            }
            Err(_) => {}
        }
        if let Some(place) = &group.bias {
            let reason = format!(
                "by {place} it is a strip at 45° to the yarns, on the bias: a law has a warp and a weft, and none is \
                 fitted to the bias"
            );
            drafts.bias.push(OpenDraft { draft, reason });
        } else if reasons.is_empty() {
            drafts.good.push(draft);
        } else {
            drafts.open.push(OpenDraft { draft, reason: reasons.join("; ") });
        }
    }

    /// Adds the key of a slack strip, where the first length is less than the gauge.
    fn add_slack(&self, draft: &mut CurveDraft) {
        let mut slack = draft.clone();
        let why = "at the start the clamps are nearer than the strip is long";
        slack.layout.push(Key::new("slack", "true", why));
        let is_short = |curve: &Curve| curve.deformation().first().is_some_and(|q| *q < -SLACK_MIN);
        let is_tensile = draft.test.value == Test::Tensile;
        if is_tensile && slack.read(self.folder).is_ok_and(|curves| curves.iter().all(is_short)) {
            *draft = slack;
        }
    }

    /// Adds everything that was detected as keys, where that reads the same curves.
    fn declared(&self, draft: CurveDraft, group: &Group, curves: &[Curve]) -> CurveDraft {
        let item = &group.items[0];
        let mut whole = draft.clone();
        whole.layout.splice(0..0, self.characters(group));
        whole.layout.extend(group.lines());
        let alone = group.items.len() == 1 && !item.series.several;
        whole.axes = item.axes(&draft.axes, alone);
        let same = |draft: &CurveDraft| draft.read(self.folder).is_ok_and(|read| read == curves);
        if whole.axes[0].iter().any(|key| key.name == "gauge") {
            for zero in ["extension", "distance", "position"] {
                let mut with_zero = whole.clone();
                let why = "taken from its heading and where it begins";
                with_zero.axes[0].push(Key::new("zero", toml_string(zero), why));
                if same(&with_zero) {
                    return with_zero;
                }
            }
        }
        if same(&whole) { whole } else { draft }
    }

    /// Returns the keys of encoding, separator and decimal sign of a text file.
    fn characters(&self, group: &Group) -> Vec<Key> {
        let mut keys = Vec::new();
        if let Some(encoding) = self.file.encoding {
            let why = self.file.reading.first().map_or("", String::as_str);
            keys.push(Key::new("encoding", toml_string(encoding.name()), why));
        }
        let separator = self.file.grids.first().and_then(|grid| grid.separator);
        if let Some(separator) = separator {
            let why = "parts the lines into most numbers";
            keys.push(Key::new("separator", toml_string(separator.name()), why));
        }
        let series = &group.items[0].series;
        if let Ok(sign) = decimal(series, &Layout::default())
            && let Some((line, text)) = series.fraction(sign)
        {
            let why = format!("\"{text}\" on line {line}");
            keys.push(Key::new("decimal", toml_string(sign.name()), why));
        }
        keys
    }
}

impl Item {
    /// Returns whether another item is the same columns of the same rows.
    fn is_at(&self, other: &Self) -> bool {
        let place = |item: &Self| (item.series.block.first_line(), item.series.pair.load);
        self.test != other.test && place(self) == place(other)
    }

    /// Returns the keys of gauge and width that must be there: stated ones need none; those of the
    /// Kawabata instruments are assumed.
    fn sizes(&self, is_kes: bool) -> Sizes {
        let Self { test, series, .. } = self;
        let quantity = |column: usize, accepted: &[Quantity]| {
            let heading = series.block.headings.get(column)?;
            Some(parse_unit(heading.unit.as_deref()?, accepted).ok()?.quantity)
        };
        let of_length = quantity(series.pair.deformation, deformation_quantities(*test))
            == Some(Quantity::Length);
        let whole =
            quantity(series.pair.load, load_quantities(*test)) == Some(load_quantities(*test)[1]);
        let mut axes = [Vec::new(), Vec::new()];
        let mut missing = Vec::new();
        let is_open =
            |words: Words| series.stated(words).is_none() && series.size_column(words).is_none();
        let gauge = (of_length && is_open(GAUGE)).then_some(("gauge", "5 cm"));
        let width = (whole && is_open(WIDTH)).then_some(("width", "20 cm"));
        for (axis, needed) in [gauge, width].into_iter().enumerate() {
            let Some((key, usual)) = needed else { continue };
            let why = if is_kes {
                format!(
                    "ASSUMED: the file states none; {usual} is that of the Kawabata instruments"
                )
            } else {
                missing.push(format!("the file does not state its {key}"));
                "not in the file: write the right one".to_owned()
            };
            axes[axis].push(Key::new(key, toml_string(usual), why));
        }
        Sizes { axes, missing: (!missing.is_empty()).then(|| missing.join(" and ")) }
    }

    /// Returns all keys of both axes: columns, units, gauge, width.
    fn axes(&self, assumed: &[Vec<Key>; 2], alone: bool) -> [Vec<Key>; 2] {
        let Self { test, series, .. } = self;
        let axis = |column: usize,
                    accepted: &[Quantity],
                    assumed: &[Key],
                    words: Words,
                    size: &'static str| {
            let mut keys = Vec::new();
            let heading = series.block.headings.get(column);
            if alone {
                keys.push(series.column_key(column));
            }
            let written = heading.and_then(|heading| heading.unit.as_deref());
            let unit = series.unit(column).and_then(|unit| parse_unit(unit, accepted).ok());
            if let Some(unit) = unit {
                let why = match (written, series.block.units_line) {
                    (None, _) => "in the cells".to_owned(),
                    (_, Some(line)) => format!("of the units on line {line}"),
                    _ => "of the heading".to_owned(),
                };
                keys.push(Key::new("unit", toml_string(unit.spelling), why));
            }
            let sized = unit.is_some_and(|unit| {
                unit.quantity == Quantity::Length || Some(&unit.quantity) == accepted.get(1)
            });
            if sized && assumed.is_empty() {
                keys.extend(series.size_key(size, words));
            }
            keys.extend_from_slice(assumed);
            keys
        };
        [
            axis(
                series.pair.deformation,
                deformation_quantities(*test),
                &assumed[0],
                GAUGE,
                "gauge",
            ),
            axis(series.pair.load, load_quantities(*test), &assumed[1], WIDTH, "width"),
        ]
    }
}

impl Group {
    /// Returns the keys of sheet and tables.
    fn choice(&self, grid: &Grid) -> Vec<Key> {
        let mut keys = Vec::new();
        if !grid.sheet.is_empty() {
            keys.push(Key::new("sheet", toml_string(&grid.sheet), ""));
        }
        let specimens = self.items.iter().all(|item| item.series.label.contains("specimen "));
        let first = &self.items[0];
        let all = self.items.len() == first.of;
        let labels: Vec<String> =
            self.items.iter().map(|item| format!("\"{}\"", item.series.label)).collect();
        if specimens && all && first.of > 1 {
            keys.push(Key::new("specimen", "\"all\"", format!("repeats: {}", labels.join(", "))));
        } else if first.of > 1 {
            let numbers: Vec<String> =
                self.items.iter().map(|item| item.number.to_string()).collect();
            let value = match numbers.as_slice() {
                [one] => one.clone(),
                several => format!("[{}]", several.join(", ")),
            };
            keys.push(Key::new("table", value, format!("of {}: {}", first.of, labels.join(", "))));
        }
        keys
    }

    /// Returns why several tables are no repeats, as far as their titles say.
    fn not_repeats(&self) -> Option<String> {
        let labels: Vec<&str> = self.items.iter().map(|item| item.series.label.as_str()).collect();
        if labels.len() < 2 || is_repeat(&labels) {
            return None;
        }
        Some(format!(
            "{} tables could be the curve; keep one number in `table`, or all where they are repeats",
            labels.len()
        ))
    }

    /// Returns the keys of header and cycles.
    fn lines(&self) -> Vec<Key> {
        let block = &self.items[0].series.block;
        let mut keys = Vec::new();
        let same = self.items.iter().all(|item| item.series.block.header_line == block.header_line);
        match block.header_line.filter(|_| same) {
            Some(line) => {
                keys.push(Key::new("header", line.to_string(), "line of the names of the columns"));
            }
            None if same => keys.push(Key::new("header", "false", "no line names the columns")),
            None => {}
        }
        let is_cycle = |column: &usize| {
            let heading = block.headings.get(*column);
            heading.and_then(|heading| heading::kind(&heading.name)) == Some(Kind::Cycle)
        };
        if let Some(column) = (0..block.width()).find(is_cycle) {
            let why = format!("one history, by column {}; or 1, [1, 2]", block.column_name(column));
            keys.push(Key::new("cycle", "\"all\"", why));
        }
        keys
    }
}

impl Series {
    /// Returns a remark on the columns of numbers that have no use, other than times and numbers of
    /// rows or cycles.
    fn unused_columns(&self) -> Vec<String> {
        let Self { block, pair, .. } = self;
        let is_time = |column: usize| {
            let unit = block.headings.get(column).and_then(|heading| heading.unit.as_deref());
            unit.is_some_and(|unit| ["s", "sec", "min", "ms", "h", "秒"].contains(&unit))
        };
        let is_used = |column: usize| {
            let kind = block.headings.get(column).and_then(|heading| heading::kind(&heading.name));
            let is_size =
                [GAUGE, WIDTH].iter().any(|words| self.size_column(words) == Some(column));
            [pair.deformation, pair.load].contains(&column)
                || matches!(kind, Some(Kind::Cycle | Kind::Specimen))
                || is_size
                || is_time(column)
        };
        let unused = block.number_columns().into_iter().filter(|column| !is_used(*column));
        let named: Vec<String> = unused
            .filter_map(|column| {
                let heading =
                    block.headings.get(column).filter(|heading| !heading.name.is_empty())?;
                let unit = heading.unit.as_ref().map_or(String::new(), |unit| format!(" ({unit})"));
                Some(format!("\"{}\"{unit}", heading.name))
            })
            .collect();
        // Beside several curves the others are those of the others.
        if named.is_empty() || self.several {
            return Vec::new();
        }
        vec![format!("columns without a use: {}", named.join(", "))]
    }

    /// Returns the names of the two columns.
    fn columns(&self) -> String {
        let [q, f] = [self.pair.deformation, self.pair.load].map(|c| self.block.column_name(c));
        format!("{q} and {f}")
    }

    /// Takes a length with a force for a tensile test, unless it goes both ways.
    fn tensile(&self) -> Result<Told<Test>, String> {
        let value = |row: &crate::tables::grid::Row| {
            let cell = row.cells.get(self.pair.deformation)?;
            cell.number(Decimal::Comma).or(cell.number(Decimal::Point))
        };
        let numbers = || self.block.rows.iter().filter_map(value);
        let (low, high) = (numbers().fold(0.0, f64::min), numbers().fold(0.0, f64::max));
        if -low > BOTH_WAYS * high {
            let reason = "a length with a force may be tensile or shear, and it goes both ways";
            return Err(reason.to_owned());
        }
        let why = format!(
            "ASSUMED: {} may be of shear too, but nothing says so and the length goes one way",
            self.columns()
        );
        Ok(Told { value: Test::Tensile, why })
    }

    /// Returns the key of the gauge or of the width that the file states.
    fn size_key(&self, name: &'static str, words: Words) -> Option<Key> {
        if let Some(found) = self.stated(words) {
            let length = format!("{} mm", drape_input::figure(1e3 * found.length));
            let why = format!("\"{}\" on line {}", found.name, found.line);
            return Some(Key::new(name, toml_string(&length), why));
        }
        let column = self.size_column(words)?;
        Some(Key { name, why: "of the column".into(), ..self.column_key(column) })
    }

    /// Returns a key that names a column: by its name where that is the only one, else by its
    /// number.
    fn column_key(&self, column: usize) -> Key {
        let heading = self.block.headings.get(column).filter(|heading| !heading.name.is_empty());
        let number = || Key::new("column", (column + 1).to_string(), "");
        let Some(heading) = heading else { return number() };
        let same = self.block.headings.iter().filter(|other| other.is_named(&heading.name));
        if same.count() == 1 {
            Key::new("column", toml_string(&heading.name), "")
        } else {
            number()
        }
    }

    /// Returns the first number that shows its decimal sign, with its line.
    fn fraction(&self, sign: Decimal) -> Option<(usize, String)> {
        let columns = [self.pair.deformation, self.pair.load];
        self.block.rows.iter().find_map(|row| {
            let cells = columns.iter().filter_map(|&column| row.cells.get(column));
            let shows = |cell: &&Cell| cell.evidence() == Some(Sign::Of(sign));
            cells.clone().find(shows).map(|cell| (row.line, cell.text()))
        })
    }
}

/// Returns a mistake with its remedy, on one line.
pub(crate) fn in_words(mistake: &Diagnostic) -> String {
    let line = mistake.line.filter(|_| !mistake.file.ends_with("sheet.toml"));
    let line = line.map_or(String::new(), |line| format!("line {line}: "));
    let help = mistake.help.as_deref().map_or(String::new(), |help| format!(" ({help})"));
    format!("{line}{}{help}", mistake.message)
}
