//! A `[[curve]]` of a sheet and its table files, read into curves in SI.
//!
//! Each axis is read once, as numbers with their parsed unit. Conversion and checks use that unit.

use std::path::{Path, PathBuf};

use drape_input::{Diagnostic, closest};

use crate::curves::curve::Curve;
use crate::error::Error;
use crate::sheets::axis::AxisKeys;
use crate::sheets::checks::suspect::{AxesAsWritten, CurveKeyPaths, examine};
use crate::sheets::convert::{deformation, load};
use crate::sheets::file::CurveFile;
use crate::sheets::file::forms::{FileNames, LineCount};
use crate::sheets::findings::Findings;
use crate::tables::block::Lines;
use crate::tables::encoding;
use crate::tables::file;
use crate::tables::find::{FoundSeries, Request, find};
use crate::tables::layout::Layout;
use crate::tables::series::Series;
use crate::test::{Direction, Test};

/// Keys of a `[[curve]]`, checked.
struct CurveKeys {
    test: Test,
    direction: Direction,
    slack: bool,
    /// Strain of the file at which the strip is taut and carries no load, if the sheet gives it.
    zero_strain: Option<f64>,
    deformation: AxisKeys,
    load: AxisKeys,
    layout: Layout,
    paths: CurveKeyPaths,
}

/// Reads the curves that `curve` describes, the one with the number `index` of the sheet. Returns
/// no curve after reporting a mistake.
///
/// Repeats are returned as one curve, their mean. Strips of loop bending are fitted together, and
/// are returned one by one.
pub(crate) fn read(index: usize, curve: &CurveFile, findings: &mut Findings<'_>) -> Vec<Curve> {
    let path = format!("curve[{index}]");
    let key = |key: &str| format!("{path}.{key}");
    let &CurveFile { test, direction, slack, .. } = curve;
    let zero_strain = curve.zero_strain.as_ref().map(|zero| zero.at(key("zero_strain")));
    let layout = layout(&path, curve, findings);

    // The units of the axes depend on the test.
    if findings.faults.cover(&key("test")) {
        return Vec::new();
    }
    let deformation = AxisKeys::deformation(&path, &curve.deformation, test, findings);
    let load = AxisKeys::load(&path, &curve.load, test, findings);

    // All keys have been read, so that all mistakes are reported before the first one ends the
    // reading.
    if let Some(zero) = zero_strain.as_ref().filter(|_| slack || test != Test::Tensile) {
        let (message, help) = if slack {
            (
                "the zero of strain is given, and is to be fitted",
                "leave out `slack` or `zero_strain`",
            )
        } else {
            ("only a tensile curve has a zero of strain", "leave it out")
        };
        findings.error(&zero.key, message, help);
        return Vec::new();
    }

    // A wrong or misspelt key may have changed the meaning of the others.
    let (Some(deformation), Some(load), Some(layout)) = (deformation, load, layout) else {
        return Vec::new();
    };
    if findings.faults.concern(&path) {
        return Vec::new();
    }

    let paths = CurveKeyPaths {
        file: key("file"),
        deformation: key("deformation"),
        load: key("load"),
        zero_strain: key("zero_strain"),
        sign_is_declared: deformation.reversed.is_some() || load.reversed.is_some(),
    };
    let zero_strain = zero_strain.map(|zero| zero.si);
    let keys = CurveKeys { test, direction, slack, zero_strain, deformation, load, layout, paths };

    // Repeats of a test are averaged; strips of loop bending stay apart.
    let FileNames(files) = &curve.file;
    let curves: Option<Vec<Vec<Curve>>> =
        files.iter().map(|file| keys.read_file(file, findings)).collect();
    let Some(mut curves) = curves.map(|curves| curves.concat()) else { return Vec::new() };
    if test != Test::LoopBending && curves.len() > 1 {
        curves = match Curve::mean(curves) {
            Ok(mean) => vec![mean],
            Err(error) => {
                let help = "name the alike ones, such as table = [1, 3], or the cycles that all of them have: \
                            cycle = 1";
                findings.error(&keys.paths.file, error.to_string(), help);
                return Vec::new();
            }
        };
    }

    if let Some(name) = &curve.name {
        let several = curves.len() > 1;
        for (index, curve) in curves.iter_mut().enumerate() {
            curve.name = if several { format!("{name}, {}", index + 1) } else { name.clone() };
        }
    }
    curves
}

/// Returns the layout of the file that `curve`, at the key path `path`, declares. Returns `None`
/// after reporting a mistake.
fn layout(path: &str, curve: &CurveFile, findings: &mut Findings<'_>) -> Option<Layout> {
    let label = curve.encoding.as_deref();
    let encoding = label.and_then(encoding::by_label);
    if let (Some(label), None) = (label, encoding) {
        let help = "write UTF-8, UTF-16LE, windows-1252 or Shift_JIS, or leave it out";
        let message = format!("\"{label}\" is not an encoding");
        findings.error(&format!("{path}.encoding"), message, help);
        return None;
    }
    Some(Layout {
        encoding,
        separator: curve.separator,
        decimal: curve.decimal,
        lines: Lines {
            skip: curve.skip.map_or(0, |LineCount(count)| count),
            header: curve.header.map(|LineCount(count)| count),
        },
        sheet: curve.sheet.clone(),
        table: curve.table.clone(),
        specimen: curve.specimen.clone(),
        cycle: curve.cycle.clone(),
    })
}

impl CurveKeys {
    /// Reads the curves of `file`. Returns `None` after reporting a mistake. Every finding names
    /// test, direction and file.
    fn read_file(&self, file: &str, findings: &mut Findings<'_>) -> Option<Vec<Curve>> {
        /// Largest number of bytes in the name of a file.
        const FILE_NAME_MAX: usize = 255;

        let (errors, warnings) = (findings.errors.len(), findings.warnings.len());
        let curves = self.read_curves(file, findings);
        let test = format!("{} {}", self.test.name(), self.direction.name());
        let added = findings.errors[errors..].iter_mut().chain(&mut findings.warnings[warnings..]);
        for mistake in added {
            // A mistake in the file itself has its name already. A name that no file can have is
            // printed once.
            let is_named = mistake.file.ends_with(file) || file.len() > FILE_NAME_MAX;
            mistake.message +=
                &if is_named { format!(" ({test})") } else { format!(" ({test}, {file})") };
        }
        curves
    }

    /// Reads the curves of `file`, and adds a reading. Returns `None` after reporting a mistake.
    fn read_curves(&self, file: &str, findings: &mut Findings<'_>) -> Option<Vec<Curve>> {
        let path = self.path_of(file, findings)?;
        let read = file::read(&path, &self.layout, findings.document.access());
        let table_file = findings.collect(read)?;
        let request = Request {
            test: self.test,
            direction: self.direction,
            deformation: self.deformation.query("deformation", self.test),
            load: self.load.query("load", self.test),
        };

        let FoundSeries { series, mut reading, warnings } =
            findings.collect(find(&path, &table_file, &self.layout, &request))?;
        for warning in warnings {
            findings.warn(&self.paths.file, warning.message, warning.help);
        }

        let mut points = 0;
        let mut curves = Vec::new();
        for (index, mut series) in series.into_iter().enumerate() {
            series.drop_empty_rows();
            points += series.block.rows.len();
            let (name, scales) = self.curve(&series, findings)?;
            if index == 0 {
                reading.extend(scales);
            }
            reading.extend(name.remarks());
            curves.push(name);
        }

        let name = format!("{file}, {} {}", self.test.name(), self.direction.name());
        let words = format!("{name}: {points} points; {}", reading.join("; "));
        findings.readings.push(words);
        Some(curves)
    }

    /// Converts `series` to a curve. Returns the curve and what its axes were taken for, or `None`
    /// after reporting a mistake.
    fn curve(&self, series: &Series, findings: &mut Findings<'_>) -> Option<(Curve, [String; 2])> {
        let deformation = deformation(self.test, &self.deformation, series, findings)?;
        let load = load(self.test, &self.load, series, findings)?;
        let words = [deformation.reading, load.reading];
        let (q, f) = (deformation.written, load.written);

        match Curve::new(self.test, self.direction, deformation.si, load.si) {
            Ok(mut curve) => {
                (curve.gauge, curve.slack) = (q.size, self.slack);
                // The unit of the times has no effect: only ratios of times are used.
                let curve = match series.times() {
                    Some(times) => curve.with_time(times),
                    None => curve,
                };
                let zero_strain = self.zero_strain;
                let written = AxesAsWritten { deformation: q, load: f, zero_strain };
                let curve = examine(curve, &written, &self.paths, findings)?;
                Some((curve, words))
            }
            Err(error) => {
                let help = match error {
                    Error::TooFewPoints { .. } => "write one point per line",
                    _ => "check that the right column is named",
                };
                let finding = Diagnostic::new(&series.path, error.to_string());
                findings.errors.push(finding.help(help));
                None
            }
        }
    }

    /// Returns the path of the table file `file`, which is in the folder of the sheet.
    fn path_of(&self, file: &str, findings: &mut Findings<'_>) -> Option<PathBuf> {
        let path = match findings.document.beside(file) {
            Ok(path) => path,
            Err(misplaced) => {
                findings.error(&self.paths.file, misplaced.to_string(), misplaced.help());
                return None;
            }
        };
        if file::is_there(&path, findings.document.access()) {
            return Some(path);
        }
        let help = suggest_name(&path, file);
        let message = format!("there is no file {}", path.display());
        findings.error(&self.paths.file, message, help);
        None
    }
}

/// Suggests an existing file whose name is close to `written`, in the folder of `path`.
fn suggest_name(path: &Path, written: &str) -> String {
    let mut names: Vec<String> = path
        .parent()
        .and_then(|folder| std::fs::read_dir(folder).ok())
        .into_iter()
        .flatten()
        .flatten()
        .filter_map(|entry| entry.file_name().into_string().ok())
        .filter(|name| !name.ends_with(".toml"))
        .collect();
    names.sort();

    match closest(written, names.iter().map(String::as_str)) {
        Some(close) => format!("did you mean \"{close}\"?"),
        None => "files are looked for beside the sheet".to_owned(),
    }
}
