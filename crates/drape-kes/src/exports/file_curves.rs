//! Curves of one file: each table with the columns of a test is drafted with everything that was
//! detected.

use std::path::Path;

use drape_input::{Diagnostic, Quantity, Remedy, parse_unit, toml_string};

use crate::curves::curve::Curve;
use crate::exports::curve_draft::{CurveDraft, Key};
use crate::exports::evidence::{Evidence, Reasoned};
use crate::exports::files::Files;
use crate::sheets::axis::{AxisKeys, deformation_quantities, load_quantities};
use crate::tables::file::TableFile;
use crate::tables::find::{Request, decimal_sign, find_all, is_repeat};
use crate::tables::grid::Grid;
use crate::tables::heading::words::Words;
use crate::tables::heading::{self, Kind};
use crate::tables::layout::{Column, Layout, Take};
use crate::tables::number::{Decimal, Evidence as Sign};
use crate::tables::series::Series;
use crate::tables::stated::{GAUGE, WIDTH};
use crate::test::{Direction, Test};

/// Tests whose curves are searched.
const TESTS: [Test; 3] = [Test::Tensile, Test::Shear, Test::Bending];

/// File of exports.
pub(crate) struct Export<'a> {
    /// Path of the file.
    pub(crate) path: &'a Path,
    /// Name of the file relative to the folder of the sheet.
    pub(crate) name: String,
    pub(crate) file: &'a TableFile,
    /// Files of the sheet, of which this is one.
    pub(crate) files: &'a Files,
}

/// Drafts of the curves of a file.
#[derive(Default)]
pub(crate) struct Drafts {
    /// Drafts that the reader of sheets accepts.
    pub(crate) good: Vec<CurveDraft>,
    /// Drafts that a person has to complete.
    pub(crate) open: Vec<OpenDraft>,
    /// Drafts of strips on the bias, to which no law is fitted.
    pub(crate) bias: Vec<OpenDraft>,
}

/// Draft that a person has to complete, with the reason.
#[derive(Clone)]
pub(crate) struct OpenDraft {
    pub(crate) draft: CurveDraft,
    pub(crate) reason: String,
}

/// Series with its number among the series of its test.
#[derive(Clone)]
struct TestSeries {
    test: Test,
    number: usize,
    count: usize,
    series: Series,
}

/// Keys of gauge and width, and what the file does not state.
struct SizeKeys {
    axis_keys: [Vec<Key>; 2],
    missing: Option<String>,
}

/// Series of one test and direction in one sheet of a file.
struct CurveGroup {
    test: Result<Reasoned<Test>, String>,
    direction: Result<Reasoned<Direction>, String>,
    members: Vec<TestSeries>,
    is_kes: bool,
    /// Place that names a strip cut on the bias.
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

    /// Returns the layout that selects all tables of `grid`.
    fn layout(grid: &Grid) -> Layout {
        let sheet = (!grid.sheet.is_empty()).then(|| Column::Name(grid.sheet.clone()));
        Layout { sheet, table: Take::All, ..Layout::default() }
    }

    /// Finds the series of all tests in `grid`, grouped by test and direction.
    fn groups(&self, grid: &Grid) -> Vec<CurveGroup> {
        let mut places: Vec<Vec<TestSeries>> = Vec::new();
        for test in TESTS {
            let undeclared = [AxisKeys::default(), AxisKeys::default()];
            let request = Request {
                test,
                direction: Direction::Warp,
                deformation: undeclared[0].query("deformation", test),
                load: undeclared[1].query("load", test),
            };
            let Ok(found) = find_all(self.path, self.file, &Self::layout(grid), &request) else {
                continue;
            };
            let count = found.series.len();
            for (index, series) in found.series.into_iter().enumerate() {
                let member = TestSeries { test, number: index + 1, count, series };
                match places.iter_mut().find(|place| place[0].is_at(&member)) {
                    Some(place) => place.push(member),
                    None => places.push(vec![member]),
                }
            }
        }

        let mut groups: Vec<CurveGroup> = Vec::new();
        for place in places {
            let group = self.group(&place);
            let matching = groups.iter_mut().find(|other| other.has_kind_of(&group));
            match matching {
                Some(other) => other.members.extend(group.members),
                None => groups.push(group),
            }
        }
        groups
    }

    /// Returns the group of the `candidates`: one pair of columns, for each test whose columns it
    /// may be.
    fn group(&self, candidates: &[TestSeries]) -> CurveGroup {
        let first = &candidates[0];
        let evidence = Evidence::from_series(&first.series, self.path);
        let named = evidence.test();
        let is_named = named.is_some();
        let named_member = named
            .as_ref()
            .and_then(|named| candidates.iter().find(|member| member.test == named.value));
        let may_be_tensile = candidates.iter().any(|member| member.test == Test::Tensile);

        let (test, member) = match (named, named_member) {
            (Some(named), Some(member)) => (Ok(named), member.clone()),
            // An arch is bent by moving its clamps, so its columns look like a tensile test.
            (Some(named), None)
                if named.value == Test::Bending && evidence.is_arch && may_be_tensile =>
            {
                let test = Test::LoopBending;
                (Ok(Reasoned { value: test, ..named }), TestSeries { test, ..first.clone() })
            }
            (Some(named), None) => {
                let reason = format!(
                    "its columns are those of a {} test, and {} it is {}",
                    first.test.name(),
                    named.why,
                    named.value.name()
                );
                (Err(reason), first.clone())
            }
            (None, _) if candidates.len() == 1 => {
                let why = format!("by its columns, {}", first.series.column_names());
                (Ok(Reasoned { value: first.test, why }), first.clone())
            }
            (None, _) => (first.series.assume_tensile(), first.clone()),
        };

        // The columns of a compression or surface test may look like the columns of another test.
        let test = match evidence.other_test().filter(|_| !is_named) {
            Some(other) if first.test != Test::Bending => Err(format!(
                "{} it is a {} test, which a sheet takes as values",
                other.why, other.value
            )),
            _ => test,
        };
        let (direction, bias) = (evidence.direction(), evidence.bias());
        CurveGroup { direction, is_kes: evidence.is_kes, members: vec![member], test, bias }
    }

    /// Drafts the curve of `group`, and adds the verified draft to `drafts`.
    fn draft(&self, grid: &Grid, group: &CurveGroup, drafts: &mut Drafts) {
        let first = &group.members[0];
        let test = match &group.test {
            Ok(told) => told.clone(),
            Err(reason) => Reasoned { value: first.test, why: reason.clone() },
        };
        let mut draft = CurveDraft {
            test,
            direction: group.direction.clone(),
            files: vec![self.name.clone()],
            layout: group.table_keys(grid),
            axes: [Vec::new(), Vec::new()],
            remarks: first.series.unused_columns(),
        };

        // The draft is open if anything is missing or ambiguous.
        let mut reasons = Vec::new();
        reasons.extend(group.test.as_ref().err().cloned());
        reasons.extend(group.direction.as_ref().err().cloned());
        reasons.extend(group.reason_against_repeats());
        let size_keys = first.size_keys(group.is_kes);
        reasons.extend(size_keys.missing);
        draft.axes = size_keys.axis_keys;

        self.add_slack(&mut draft);
        match draft.read(self.files) {
            Ok(curves) => draft = self.with_detected_keys(draft, group, &curves),
            Err(mistakes) if reasons.is_empty() => {
                reasons.extend(mistakes.0.iter().map(describe_mistake));
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

    /// Adds the key of a slack strip, if the first length is less than the gauge.
    fn add_slack(&self, draft: &mut CurveDraft) {
        /// Negative strain at the start above which a strip is slack.
        const SLACK_MIN: f64 = 1e-3;

        let mut slack = draft.clone();
        let why = "at the start the clamps are nearer than the strip is long";
        slack.layout.push(Key::new("slack", "true", why));
        let is_slack = slack.read(self.files).is_ok_and(|curves| {
            curves.iter().all(|curve| curve.deformation().first().is_some_and(|q| *q < -SLACK_MIN))
        });
        if draft.test.value == Test::Tensile && is_slack {
            *draft = slack;
        }
    }

    /// Adds everything that was detected as keys, if the reader of sheets then reads the same
    /// `curves`.
    fn with_detected_keys(
        &self,
        draft: CurveDraft,
        group: &CurveGroup,
        curves: &[Curve],
    ) -> CurveDraft {
        let member = &group.members[0];
        let mut whole = draft.clone();
        whole.layout.splice(0..0, self.text_keys(group));
        whole.layout.extend(group.line_keys());
        let is_alone = group.members.len() == 1 && !member.series.has_neighbours;
        whole.axes = member.axis_keys(&draft.axes, is_alone);

        // A length needs its zero, which is the one that gives the detected curves.
        let mut candidates = Vec::new();
        if whole.axes[0].iter().any(|key| key.name == "gauge") {
            for zero in ["extension", "distance", "position"] {
                let mut with_zero = whole.clone();
                let why = "taken from its heading and where it begins";
                with_zero.axes[0].push(Key::new("zero", toml_string(zero), why));
                candidates.push(with_zero);
            }
        }
        candidates.push(whole);
        let reads_same =
            |draft: &CurveDraft| draft.read(self.files).is_ok_and(|read| read == curves);
        candidates.into_iter().find(reads_same).unwrap_or(draft)
    }

    /// Returns the keys of encoding, separator and decimal sign of a text file.
    fn text_keys(&self, group: &CurveGroup) -> Vec<Key> {
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
        let series = &group.members[0].series;
        if let Ok(sign) = decimal_sign(series, &Layout::default())
            && let Some((line, text)) = series.fraction(sign)
        {
            let why = format!("\"{text}\" on line {line}");
            keys.push(Key::new("decimal", toml_string(sign.name()), why));
        }
        keys
    }
}

impl TestSeries {
    /// Returns whether `other` has the same columns of the same rows, for another test.
    fn is_at(&self, other: &Self) -> bool {
        let [place, other_place] =
            [self, other].map(|member| (member.series.block.first_line(), member.series.pair.load));
        self.test != other.test && place == other_place
    }

    /// Returns the keys of gauge and width that the file does not state. The sizes of the Kawabata
    /// instruments are assumed if the file `is_kes`.
    fn size_keys(&self, is_kes: bool) -> SizeKeys {
        let Self { test, series, .. } = self;
        let [deformation, load] = [
            (series.pair.deformation, deformation_quantities(*test)),
            (series.pair.load, load_quantities(*test)),
        ]
        .map(|(column, accepted)| {
            let heading = series.block.headings.get(column)?;
            Some(parse_unit(heading.unit.as_deref()?, accepted).ok()?.quantity)
        });
        let is_length = deformation == Some(Quantity::Length);
        let is_whole_load = load == Some(load_quantities(*test)[1]);
        let mut axis_keys = [Vec::new(), Vec::new()];
        let mut missing = Vec::new();
        let [no_gauge, no_width] = [GAUGE, WIDTH]
            .map(|words| series.stated(words).is_none() && series.size_column(words).is_none());
        let gauge = (is_length && no_gauge).then_some(("gauge", "5 cm"));
        let width = (is_whole_load && no_width).then_some(("width", "20 cm"));
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
            axis_keys[axis].push(Key::new(key, toml_string(usual), why));
        }
        SizeKeys { axis_keys, missing: (!missing.is_empty()).then(|| missing.join(" and ")) }
    }

    /// Returns all keys of both axes: columns, units, gauge and width. The `assumed` keys are kept.
    /// Columns are named only if the series `is_alone`.
    fn axis_keys(&self, assumed: &[Vec<Key>; 2], is_alone: bool) -> [Vec<Key>; 2] {
        let Self { test, series, .. } = self;
        let axes = [
            (series.pair.deformation, deformation_quantities(*test), ("gauge", GAUGE)),
            (series.pair.load, load_quantities(*test), ("width", WIDTH)),
        ];
        let mut keys = axes.map(|(column, accepted, size)| {
            let mut keys = Vec::new();
            if is_alone {
                keys.push(series.column_key(column));
            }
            keys.extend(series.unit_keys(column, accepted, size));
            keys
        });
        for (keys, assumed) in keys.iter_mut().zip(assumed) {
            // An assumed size replaces the size that the file states.
            if !assumed.is_empty() {
                keys.retain(|key| !["gauge", "width"].contains(&key.name));
            }
            keys.extend_from_slice(assumed);
        }
        keys
    }
}

impl CurveGroup {
    /// Returns the keys of sheet, specimens and tables.
    fn table_keys(&self, grid: &Grid) -> Vec<Key> {
        let mut keys = Vec::new();
        if !grid.sheet.is_empty() {
            keys.push(Key::new("sheet", toml_string(&grid.sheet), ""));
        }
        let are_specimens =
            self.members.iter().all(|member| member.series.label.contains("specimen "));
        let first = &self.members[0];
        let are_all = self.members.len() == first.count;
        let labels: Vec<String> =
            self.members.iter().map(|series| format!("\"{}\"", series.series.label)).collect();
        if are_specimens && are_all && first.count > 1 {
            keys.push(Key::new("specimen", "\"all\"", format!("repeats: {}", labels.join(", "))));
        } else if first.count > 1 {
            let numbers: Vec<String> =
                self.members.iter().map(|member| member.number.to_string()).collect();
            let value = match numbers.as_slice() {
                [number] => number.clone(),
                numbers => format!("[{}]", numbers.join(", ")),
            };
            keys.push(Key::new(
                "table",
                value,
                format!("of {}: {}", first.count, labels.join(", ")),
            ));
        }
        keys
    }

    /// Returns the reason why several tables are no repeats, according to their titles.
    fn reason_against_repeats(&self) -> Option<String> {
        let labels: Vec<&str> =
            self.members.iter().map(|member| member.series.label.as_str()).collect();
        if labels.len() < 2 || is_repeat(&labels) {
            return None;
        }
        Some(format!(
            "{} tables could be the curve; keep one number in `table`, or all where they are repeats",
            labels.len()
        ))
    }

    /// Returns whether `other` has the same test and direction, and is equally certain.
    fn has_kind_of(&self, other: &Self) -> bool {
        let [direction, other_direction] = [self, other]
            .map(|group| group.direction.as_ref().ok().map(|direction| direction.value));
        self.members[0].test == other.members[0].test
            && self.bias.is_some() == other.bias.is_some()
            && self.test.is_ok() == other.test.is_ok()
            && direction == other_direction
    }

    /// Returns the keys of header and cycles.
    fn line_keys(&self) -> Vec<Key> {
        let block = &self.members[0].series.block;
        let mut keys = Vec::new();
        let have_one_header =
            self.members.iter().all(|member| member.series.block.header_line == block.header_line);
        match block.header_line.filter(|_| have_one_header) {
            Some(line) => {
                keys.push(Key::new("header", line.to_string(), "line of the names of the columns"));
            }
            None if have_one_header => {
                keys.push(Key::new("header", "false", "no line names the columns"))
            }
            None => {}
        }

        let cycle_column = (0..block.width()).find(|column| {
            let heading = block.headings.get(*column);
            heading.and_then(|heading| heading::kind(&heading.name)) == Some(Kind::Cycle)
        });
        if let Some(column) = cycle_column {
            let why = format!("one history, by column {}; or 1, [1, 2]", block.column_name(column));
            keys.push(Key::new("cycle", "\"all\"", why));
        }
        keys
    }
}

impl Series {
    /// Returns a remark on the columns of numbers that have no use. Times and numbers of rows or
    /// cycles have a use.
    fn unused_columns(&self) -> Vec<String> {
        // The columns beside several curves belong to the other curves.
        if self.has_neighbours {
            return Vec::new();
        }
        let mut names = Vec::new();
        for column in self.block.number_columns() {
            let Some(heading) = self.block.headings.get(column) else { continue };
            if heading.name.is_empty() || self.uses(column) {
                continue;
            }
            let unit = heading.unit.as_ref().map_or(String::new(), |unit| format!(" ({unit})"));
            names.push(format!("\"{}\"{unit}", heading.name));
        }
        if names.is_empty() {
            return Vec::new();
        }
        vec![format!("columns without a use: {}", names.join(", "))]
    }

    /// Returns whether the curve uses `column`: for an axis, a size, a time, or the number of a row
    /// or cycle.
    fn uses(&self, column: usize) -> bool {
        let heading = self.block.headings.get(column);
        let kind = heading.and_then(|heading| heading::kind(&heading.name));
        let unit = heading.and_then(|heading| heading.unit.as_deref());
        let has_unit_of_time =
            unit.is_some_and(|unit| ["s", "sec", "min", "ms", "h", "秒"].contains(&unit));
        [self.pair.deformation, self.pair.load].contains(&column)
            || matches!(kind, Some(Kind::Cycle | Kind::Specimen))
            || has_unit_of_time
            || self.time_column() == Some(column)
            || [GAUGE, WIDTH].iter().any(|words| self.size_column(words) == Some(column))
    }

    /// Returns the keys of the unit of `column`, and of the size that a length or a whole load
    /// needs.
    fn unit_keys(
        &self,
        column: usize,
        accepted: &[Quantity],
        (size, words): (&'static str, Words),
    ) -> Vec<Key> {
        let unit = self.unit(column).and_then(|unit| parse_unit(unit, accepted).ok());
        let Some(unit) = unit else { return Vec::new() };
        let heading = self.block.headings.get(column);
        let written = heading.and_then(|heading| heading.unit.as_deref());
        let why = match (written, self.block.units_line) {
            (None, _) => "in the cells".to_owned(),
            (_, Some(line)) => format!("of the units on line {line}"),
            _ => "of the heading".to_owned(),
        };
        let mut keys = vec![Key::new("unit", toml_string(unit.spelling), why)];
        if unit.quantity == Quantity::Length || Some(&unit.quantity) == accepted.get(1) {
            keys.extend(self.size_key(size, words));
        }
        keys
    }

    /// Returns the names of the columns of deformation and load.
    fn column_names(&self) -> String {
        let [q, f] = [self.pair.deformation, self.pair.load].map(|c| self.block.column_name(c));
        format!("{q} and {f}")
    }

    /// Returns a tensile test for a length with a force, unless the length goes both ways.
    fn assume_tensile(&self) -> Result<Reasoned<Test>, String> {
        /// Part of the largest length below zero above which the length is no tensile extension.
        const BOTH_WAYS: f64 = 0.3;

        let (mut low, mut high) = (0.0_f64, 0.0_f64);
        for row in &self.block.rows {
            let cell = row.cells.get(self.pair.deformation);
            let number =
                cell.and_then(|cell| cell.number(Decimal::Comma).or(cell.number(Decimal::Point)));
            if let Some(number) = number {
                (low, high) = (low.min(number), high.max(number));
            }
        }
        if -low > BOTH_WAYS * high {
            let reason = "a length with a force may be tensile or shear, and it goes both ways";
            return Err(reason.to_owned());
        }
        let why = format!(
            "ASSUMED: {} may be of shear too, but nothing says so and the length goes one way",
            self.column_names()
        );
        Ok(Reasoned { value: Test::Tensile, why })
    }

    /// Returns the key `name` of the gauge or the width that the file states under one of `words`.
    fn size_key(&self, name: &'static str, words: Words) -> Option<Key> {
        if let Some(stated) = self.stated(words) {
            let length = format!("{} mm", drape_input::figure(1e3 * stated.length));
            let why = format!("\"{}\" on line {}", stated.name, stated.line);
            return Some(Key::new(name, toml_string(&length), why));
        }
        let column = self.size_column(words)?;
        Some(Key { name, why: "of the column".into(), ..self.column_key(column) })
    }

    /// Returns the key that names `column`: by its name if no other column has the name, else by
    /// its number.
    fn column_key(&self, column: usize) -> Key {
        let heading = self.block.headings.get(column).filter(|heading| !heading.name.is_empty());
        if let Some(heading) = heading
            && self.block.headings.iter().filter(|other| other.is_named(&heading.name)).count() == 1
        {
            return Key::new("column", toml_string(&heading.name), "");
        }
        Key::new("column", (column + 1).to_string(), "")
    }

    /// Returns the first number that has the decimal sign `sign`, with its line.
    fn fraction(&self, sign: Decimal) -> Option<(usize, String)> {
        let columns = [self.pair.deformation, self.pair.load];
        for row in &self.block.rows {
            let cells = columns.iter().filter_map(|&column| row.cells.get(column));
            for cell in cells {
                if cell.evidence() == Some(Sign::Only(sign)) {
                    return Some((row.line, cell.text()));
                }
            }
        }
        None
    }
}

/// Returns `mistake` with its remedy on one line.
pub(crate) fn describe_mistake(mistake: &Diagnostic) -> String {
    let line = mistake.line.filter(|_| !mistake.file.ends_with("sheet.toml"));
    let line = line.map_or(String::new(), |line| format!("line {line}: "));
    let mistake = mistake.clone().in_words(Remedy::to_string);
    let help = mistake.help.map_or(String::new(), |help| format!(" ({help})"));
    format!("{line}{}{help}", mistake.message)
}
