//! Conversion of files of others: patterns to TOML or drawings, exports of instruments to sheets.

use std::path::{Path, PathBuf};

use drape::input::Diagnostic;
use drape::kes::SheetDraft;
use drape::pattern::{Error, Paper, Pattern, Request, Unit};
use drape::run::file::FileKind;
use drape::run::reports::VERSION;
use pyo3::prelude::*;

use crate::error::{Kind, failure, input, mistake};
use crate::threads::compute;

/// Kinds of files of which a pattern is made.
const PATTERNS: [FileKind; 2] = [FileKind::Drawing, FileKind::Pattern];

/// Widths that a drawing may have, in mm.
const WIDTHS: std::ops::RangeInclusive<f64> = 100.0..=100_000.0;

/// What a conversion is asked for.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Conversion {
    unit: Option<String>,
    size: Option<String>,
    paper: Option<String>,
    width: Option<f64>,
    /// Name of a pattern in DXF.
    style: String,
}

/// Text of a file that a conversion gives, and what its name has beside that which is asked for.
type NamedText = (String, String);

/// Converts the pattern at `path` to a file of the kind `kind`: `"pattern"` is TOML, `"drawing"` is
/// SVG, `"dxf"` is DXF. Returns the files, and notes on choices of the reader and on parts that
/// the files do not contain.
#[pyfunction]
pub(crate) fn convert_pattern(
    py: Python<'_>,
    path: PathBuf,
    kind: &str,
    conversion: Conversion,
) -> PyResult<(Vec<NamedText>, Vec<String>)> {
    compute(py, || converted(path, kind, conversion))?
}

fn converted(
    path: PathBuf,
    kind: &str,
    conversion: Conversion,
) -> PyResult<(Vec<NamedText>, Vec<String>)> {
    FileKind::expect(&path, &PATTERNS).map_err(|mistakes| input(&mistakes))?;
    conversion.check(kind == "drawing")?;
    let Conversion { unit, size, paper, width, style } = conversion;
    let unit = unit.map(|word| {
        let known = Unit::parse(&word);
        known.ok_or_else(|| usage(format!("unit={word:?}: it is mm, cm, m, in, pt or px")))
    });
    let request = Request { unit: unit.transpose()?, size, ..Request::new(&path) };
    let pattern = Pattern::read_as(&request).map_err(|error| match error {
        Error::Input(mistakes) => input(&mistakes),
        other => mistake(Diagnostic::new(&path, other.to_string())),
    })?;
    let mut notes: Vec<String> = pattern.notes().iter().map(ToString::to_string).collect();
    let files = match (kind, paper) {
        ("drawing", None) => vec![(String::new(), pattern.to_svg(width))],
        ("drawing", Some(word)) => {
            let pages = pattern.to_pages(paper_of(&word)?).into_iter();
            pages.map(|page| (format!("-{}", page.name), page.svg)).collect()
        }
        ("dxf", _) => {
            let drawing = pattern.to_dxf(&style);
            notes.extend(drawing.notes.iter().map(ToString::to_string));
            vec![(String::new(), drawing.text)]
        }
        _ => vec![(String::new(), pattern.to_toml(&heading(&path)))],
    };
    Ok((files, notes))
}

/// Drafts the sheet of a folder of exports, for a place beside which its files are named; returns
/// its text, and the notes on what was taken.
#[pyfunction]
pub(crate) fn draft_sheet(
    py: Python<'_>,
    folder: PathBuf,
    beside: PathBuf,
) -> PyResult<(String, Vec<String>)> {
    let draft = compute(py, || SheetDraft::of_folder(&folder, &beside))?;
    let draft = draft.map_err(|error| match error {
        drape::kes::Error::Input(mistakes) => input(&mistakes),
        other => mistake(Diagnostic::new(&folder, other.to_string())),
    })?;
    Ok((draft.text, draft.notes))
}

impl Conversion {
    /// Refuses what does not belong to the result.
    fn check(&self, is_drawing: bool) -> PyResult<()> {
        if !is_drawing && (self.paper.is_some() || self.width.is_some()) {
            return Err(usage("paper and width are for a drawing: write it to a *.svg"));
        }
        if self.paper.is_some() && self.width.is_some() {
            return Err(usage("paper and width: give one of them"));
        }
        match self.width {
            Some(width) if !WIDTHS.contains(&width) => {
                Err(usage(format!("width={width}: a width in mm from 100 to 100000, such as 900")))
            }
            _ => Ok(()),
        }
    }
}

/// Returns a paper by its word.
fn paper_of(word: &str) -> PyResult<Paper> {
    Paper::parse(word).ok_or_else(|| {
        usage(format!(
            "paper={word:?}: it is a4, a3, a2, a1, a0, letter, legal, tabloid, or a size in mm from 100x100 \
             on, such as 210x297"
        ))
    })
}

fn usage(message: impl ToString) -> PyErr {
    failure(Kind::Usage, message)
}

/// Returns the first line of a pattern converted from `path`, which the command writes too.
fn heading(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    format!("Pattern converted from {name} by {VERSION}. Lengths are in mm, angles in degrees.")
}
