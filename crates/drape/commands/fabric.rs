//! `drape fabric`: lists fabrics, shows one, compares two.

use std::path::{Path, PathBuf};

use clap::Subcommand;
use drape::fabric::Fabric;
use drape::input::{Diagnostic, Diagnostics};
use drape::kes::Sheet;
use drape::reports::{compare_page, show_page};
use drape::scene::Model;
use serde_json::{Value, json};

use crate::commands::fit::store;
use crate::commands::sheets;
use crate::failure::Failure;
use crate::input;
use crate::say::{say, say_json, say_written};
use drape::file;

#[derive(Subcommand)]
pub(crate) enum FabricCommand {
    /// Lists the sheets in folders: mass, thickness, what was measured.
    List {
        /// Folders to search.
        #[arg(default_value = "fabrics", value_name = "FOLDER")]
        folders: Vec<PathBuf>,
        /// Prints the sheets as JSON, in SI.
        #[arg(long)]
        json: bool,
    },
    /// Shows a fabric: its parameters, the loops an instrument would draw, its KES values.
    Show {
        /// A fabric, or a sheet, which is fitted first; - for standard input.
        fabric: PathBuf,
        /// Folder for a page with plots.
        #[arg(long, value_name = "FOLDER")]
        report: Option<PathBuf>,
        /// Prints the page as JSON, in SI.
        #[arg(long)]
        json: bool,
    },
    /// Compares two fabrics: their loops overlaid, a table of their values.
    Compare {
        /// Fabrics, or sheets, which are fitted first.
        #[arg(required = true, num_args = 2, value_names = ["FIRST", "SECOND"])]
        fabrics: Vec<PathBuf>,
        /// Folder for a page with plots.
        #[arg(long, value_name = "FOLDER")]
        report: Option<PathBuf>,
        /// Prints the page as JSON, in SI.
        #[arg(long)]
        json: bool,
    },
}

/// Executes `drape fabric`.
pub(crate) fn fabric(command: &FabricCommand) -> Result<(), Failure> {
    match command {
        FabricCommand::List { folders, json } => list(folders, *json),
        FabricCommand::Show { fabric, report, json } => show(fabric, report.as_deref(), *json),
        FabricCommand::Compare { fabrics, report, json } => {
            let [first, second] = fabrics.as_slice() else {
                let message = format!("two fabrics are compared, {} were given", fabrics.len());
                return Err(Failure::Usage(message));
            };
            compare([first, second], report.as_deref(), *json)
        }
    }
}

/// Reads a fabric from its file, or from a sheet or its folder, which it fits.
pub(crate) fn read(path: &Path) -> Result<Fabric, Failure> {
    let sheet = path.join(sheets::SHEET_FILE);
    let file = if path.is_dir() { &sheet } else { path };
    Ok(drape::fabric_of(&input::document(file)?, Model::Kes)?)
}

fn list(folders: &[PathBuf], json: bool) -> Result<(), Failure> {
    let paths = sheets::sheets(folders)?;
    let sheets: Vec<_> = paths.iter().map(|path| (path, sheets::read(path))).collect();
    if json {
        let rows = sheets.iter().filter_map(|(path, sheet)| Some(row(path, sheet.as_ref().ok()?)));
        say_json(&rows.collect::<Vec<_>>())?;
    } else {
        table(&sheets)?;
    }
    let failed = sheets.into_iter().filter_map(|(_, sheet)| sheet.err());
    let mistakes: Vec<Diagnostic> = failed.flat_map(|mistakes| mistakes.0).collect();
    Ok(Diagnostics::check(mistakes)?)
}

/// Prints the table of the sheets that could be read.
fn table(sheets: &[(&PathBuf, Result<Sheet, Diagnostics>)]) -> Result<(), Failure> {
    say(format_args!("{:<44} {:>6} {:>7}  {:<38} sheet", "fabric", "g/m²", "mm", "measured"))?;
    let read = sheets.iter().filter_map(|(path, sheet)| Some((path, sheet.as_ref().ok()?)));
    for (path, sheet) in read {
        say(line(path, sheet))?;
    }
    Ok(())
}

/// Returns the tests of a sheet that have curves, and whether it has values.
fn measured(sheet: &Sheet) -> Vec<&str> {
    let mut tests: Vec<&str> = sheet.curves.iter().map(|curve| curve.test.name()).collect();
    tests.dedup();
    if !sheet.warp.is_empty() || !sheet.weft.is_empty() {
        tests.push("values");
    }
    tests
}

/// Returns a sheet as JSON.
fn row(path: &Path, sheet: &Sheet) -> Value {
    json!({
        "sheet": path,
        "name": sheet.name,
        "density": sheet.density(),
        "thickness": sheet.thickness(),
        "measured": measured(sheet),
    })
}

/// Line of the table for a sheet: mass, thickness, tests that have curves, and whether it has
/// values.
fn line(path: &Path, sheet: &Sheet) -> String {
    let number = |value: Option<f64>, scale: f64, digits: usize| {
        value.map_or("–".into(), |value| format!("{:.digits$}", value * scale))
    };
    format!(
        "{:<44} {:>6} {:>7}  {:<38} {}",
        sheet.name,
        number(sheet.density(), 1e3, 1),
        number(sheet.thickness(), 1e3, 3),
        measured(sheet).join(", "),
        path.display()
    )
}

fn show(path: &Path, report: Option<&Path>, json: bool) -> Result<(), Failure> {
    let sheet = sheets::of(path).and_then(|path| sheets::read(path).ok());
    let page = show_page(&read(path)?, sheet.as_ref());
    if json {
        say_json(&page)?;
    } else {
        say(page.to_text()?.trim_end())?;
    }
    if let (Some(written), false) = (store(&page, &sheets::stem(path), report)?, json) {
        say_written(format_args!("page written to {}", written.display()))?;
    }
    Ok(())
}

fn compare(paths: [&PathBuf; 2], report: Option<&Path>, json: bool) -> Result<(), Failure> {
    let page = compare_page([&read(paths[0])?, &read(paths[1])?]);
    if json {
        say_json(&page)?;
    } else {
        say(page.to_text()?.trim_end())?;
    }
    if let Some(folder) = report {
        let [first, second] = paths.map(|path| sheets::stem(path));
        let path = folder.join(format!("{first}-and-{second}.html"));
        file::write(&path, &page.to_html()?)?;
        if !json {
            say_written(format_args!("page written to {}", path.display()))?;
        }
    }
    Ok(())
}
