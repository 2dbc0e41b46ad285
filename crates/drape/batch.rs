//! Many sheets at once.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use drape::fit::identify_all;
use drape::report::{FitPage, Trust};

use crate::command::FitArguments;
use crate::failure::Failure;
use crate::say::say;
use crate::{file, fit, progress};

const SHEET_FILE: &str = "sheet.toml";
/// Folders deeper than this below one that was named are not searched: a link back up would never end.
const DEEPEST: usize = 8;

/// The sheets that some paths mean: files, folders with a sheet, and sheets in folders below.
pub(crate) fn sheets(paths: &[PathBuf]) -> Result<Vec<PathBuf>, Failure> {
    let mut sheets = Vec::new();
    for path in paths {
        if !path.is_dir() || path.join(SHEET_FILE).exists() {
            sheets.push(path.clone());
            continue;
        }
        let mut found = BTreeSet::new();
        search(path, DEEPEST, &mut found)?;
        if found.is_empty() {
            let message = format!("{} holds no {SHEET_FILE}", path.display());
            return Err(Failure::Usage(message));
        }
        sheets.extend(found);
    }
    Ok(sheets)
}

fn search(folder: &Path, depth: usize, found: &mut BTreeSet<PathBuf>) -> Result<(), Failure> {
    let unreadable = |error| Failure::Output(format!("cannot read {}: {error}", folder.display()));
    for entry in std::fs::read_dir(folder).map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        if path.is_dir() && path.join(SHEET_FILE).exists() {
            found.insert(path);
        } else if path.is_dir() && depth > 0 {
            search(&path, depth - 1, found)?;
        }
    }
    Ok(())
}

/// Names for the files of each sheet: its folder's, or the file's; with a number where that is taken.
fn names(sheets: &[PathBuf]) -> Vec<String> {
    let mut taken = BTreeSet::new();
    let name = |sheet: &PathBuf| {
        let stem = stem(sheet);
        let numbered = (2..).map(|number| format!("{stem}-{number}"));
        let mut candidates = std::iter::once(stem.clone()).chain(numbered);
        candidates.find(|name| taken.insert(name.clone())).expect("there is always a next number")
    };
    sheets.iter().map(name).collect()
}

/// The name that a sheet goes by: its folder's, or the file's.
pub(crate) fn stem(sheet: &Path) -> String {
    let named = if sheet.file_name().is_some_and(|name| name == SHEET_FILE) {
        sheet.parent().filter(|folder| folder.file_name().is_some()).unwrap_or(sheet)
    } else {
        sheet
    };
    let name = if named.is_dir() { named.file_name() } else { named.file_stem() };
    name.map_or("fabric".into(), |name| name.to_string_lossy().into_owned())
}

/// Head of the table of a batch.
const HEAD: [&str; 5] = ["fabric", "fit", "misfit", "warnings", "assumed"];

/// What is kept of a fitted sheet: little, because there may be thousands.
struct Row {
    name: String,
    trust: Trust,
    misfit: Option<f64>,
    warnings: usize,
    assumed: usize,
}

/// Fits every sheet, on all threads; a bad one does not stop the others.
#[expect(clippy::print_stderr, reason = "messages of the program go to stderr")]
pub(crate) fn fit_all(sheets: &[PathBuf], arguments: &FitArguments) -> Result<(), Failure> {
    let bar = progress::bar(sheets.len() as u64, "{pos}/{len} sheets, {per_sec}, {eta} left");
    let inputs: Vec<(&PathBuf, String)> = sheets.iter().zip(names(sheets)).collect();
    let settings = arguments.laws.settings();
    let read = |(path, name): &(&PathBuf, String)| {
        free(path, name, arguments)?;
        fit::read(path)
    };
    let rows = identify_all(&inputs, &settings, read, |(path, name), found| {
        let row = found.and_then(|(sheet, fit)| {
            let page = fit::page(sheet, fit, &settings)?;
            file::write(&target(path, name, arguments), fit.fabric.to_toml())?;
            fit::store(&page, name, arguments.report.as_deref())?;
            Ok(Row::new(&page))
        });
        bar.inc(1);
        row.map_err(|failure| failure.of(path))
    });
    bar.finish_and_clear();
    let failed = rows.iter().filter(|row| row.is_err()).count();
    if arguments.json {
        let rows: Vec<_> = sheets.iter().zip(&rows).map(json).collect();
        let json = serde_json::to_string_pretty(&rows);
        say(json.expect("numbers and strings have a JSON form"))?;
    } else {
        let [name, fit, misfit, warnings, assumed] = HEAD;
        say(format_args!("{name:<36} {fit:<10} {misfit:>8} {warnings:>8} {assumed:>8}  sheet"))?;
        for (sheet, row) in sheets.iter().zip(&rows) {
            say(line(sheet, row))?;
        }
    }
    rows.iter().filter_map(|row| row.as_ref().err()).for_each(Failure::print);
    eprintln!("{} of {} sheets fitted", sheets.len() - failed, sheets.len());
    if failed > 0 { Err(Failure::Batch) } else { Ok(()) }
}

/// Where the fabric of a sheet goes.
fn target(sheet: &Path, name: &str, arguments: &FitArguments) -> PathBuf {
    match &arguments.output {
        Some(folder) => folder.join(format!("{name}.toml")),
        None => fit::beside(sheet),
    }
}

/// Refuses to replace a fabric unless that is allowed.
fn free(sheet: &Path, name: &str, arguments: &FitArguments) -> Result<(), Failure> {
    let path = target(sheet, name, arguments);
    if path.exists() && !arguments.force {
        return Err(Failure::Usage(format!("{} exists; replace it with --force", path.display())));
    }
    Ok(())
}

impl Row {
    /// The worst of a page.
    fn new(page: &FitPage) -> Self {
        let verdicts = page.laws.iter().map(|law| law.verdict(&page.limits).trust);
        let misfits = page.laws.iter().filter_map(|law| law.statistics.as_ref());
        Self {
            name: page.name.clone(),
            trust: verdicts.max().unwrap_or(Trust::Unjudged),
            misfit: misfits.map(|statistics| statistics.misfit).reduce(f64::max),
            warnings: page.warnings.len(),
            assumed: page.assumed.len(),
        }
    }
}

fn line(sheet: &Path, row: &Result<Row, Failure>) -> String {
    let path = sheet.display();
    let Ok(Row { name, trust, misfit, warnings, assumed }) = row else {
        return format!("{:<36} {:<10} {:>26}  {path}", "", "failed", "");
    };
    let misfit = misfit.map_or(String::new(), |misfit| format!("{:.2} %", 100.0 * misfit));
    let trust = trust.name();
    format!("{name:<36} {trust:<10} {misfit:>8} {warnings:>8} {assumed:>8}  {path}")
}

fn json((sheet, row): (&PathBuf, &Result<Row, Failure>)) -> serde_json::Value {
    match row {
        Ok(row) => serde_json::json!({
            "sheet": sheet,
            "fabric": row.name,
            "trust": row.trust,
            "misfit": row.misfit,
            "warnings": row.warnings,
            "assumed": row.assumed,
        }),
        Err(failure) => serde_json::json!({ "sheet": sheet, "error": failure.to_string() }),
    }
}
