//! `drape fabric`: lists fabrics, shows one, compares two.

use std::path::{Path, PathBuf};

use clap::Subcommand;
use drape::fabric::Fabric;
use drape::kes::Sheet;
use drape::scene::{FabricRequest, Model};

use crate::commands::fit::store;
use crate::commands::sheets;
use crate::failure::Failure;
use crate::file;
use crate::pages::fabric::{compare_page, show_page};
use crate::say::say;

#[derive(Subcommand)]
pub(crate) enum FabricCommand {
    /// Lists the sheets in folders: mass, thickness, what was measured.
    List {
        /// Folders to search.
        #[arg(default_value = "fabrics", value_name = "FOLDER")]
        folders: Vec<PathBuf>,
    },
    /// Shows a fabric: its parameters, the loops an instrument would draw, its KES values.
    Show {
        /// A fabric, or a sheet, which is fitted first.
        fabric: PathBuf,
        /// Folder for a page with plots.
        #[arg(long, value_name = "FOLDER")]
        report: Option<PathBuf>,
    },
    /// Compares two fabrics: their loops overlaid, a table of their values.
    Compare {
        /// Fabrics, or sheets, which are fitted first.
        #[arg(required = true, num_args = 2, value_names = ["FIRST", "SECOND"])]
        fabrics: Vec<PathBuf>,
        /// Folder for a page with plots.
        #[arg(long, value_name = "FOLDER")]
        report: Option<PathBuf>,
    },
}

/// Executes `drape fabric`.
pub(crate) fn fabric(command: &FabricCommand) -> Result<(), Failure> {
    match command {
        FabricCommand::List { folders } => list(folders),
        FabricCommand::Show { fabric, report } => show(fabric, report.as_deref()),
        FabricCommand::Compare { fabrics, report } => {
            let [first, second] = fabrics.as_slice() else {
                let message = format!("two fabrics are compared, {} were given", fabrics.len());
                return Err(Failure::Usage(message));
            };
            compare([first, second], report.as_deref())
        }
    }
}

/// Reads a fabric from its file, or from a sheet or its folder, which it fits.
pub(crate) fn read(path: &Path) -> Result<Fabric, Failure> {
    let sheet = path.join(sheets::SHEET_FILE);
    let file = if path.is_dir() { &sheet } else { path };
    Ok(drape::scene_fabric(FabricRequest { file, model: Model::Kes })?)
}

fn list(folders: &[PathBuf]) -> Result<(), Failure> {
    let sheets = sheets::sheets(folders)?;
    say(format_args!("{:<44} {:>6} {:>7}  {:<38} sheet", "fabric", "g/m²", "mm", "measured"))?;
    for path in &sheets {
        match sheets::read(path) {
            Ok(sheet) => say(line(path, &sheet))?,
            Err(mistakes) => Failure::from(mistakes).print(),
        }
    }
    Ok(())
}

/// Line of the table for a sheet: mass, thickness, tests that have curves, and whether it has
/// values.
fn line(path: &Path, sheet: &Sheet) -> String {
    let number = |value: Option<f64>, scale: f64, digits: usize| {
        value.map_or("–".into(), |value| format!("{:.digits$}", value * scale))
    };
    let mut tests: Vec<&str> = sheet.curves.iter().map(|curve| curve.test.name()).collect();
    tests.dedup();
    if !sheet.warp.is_empty() || !sheet.weft.is_empty() {
        tests.push("values");
    }
    format!(
        "{:<44} {:>6} {:>7}  {:<38} {}",
        sheet.name,
        number(sheet.density(), 1e3, 1),
        number(sheet.thickness(), 1e3, 3),
        tests.join(", "),
        path.display()
    )
}

fn show(path: &Path, report: Option<&Path>) -> Result<(), Failure> {
    let sheet = sheets::of(path).and_then(|path| sheets::read(path).ok());
    let page = show_page(&read(path)?, sheet.as_ref());
    say(page.to_text()?.trim_end())?;
    if let Some(written) = store(&page, &sheets::stem(path), report)? {
        say(format_args!("page written to {}", written.display()))?;
    }
    Ok(())
}

fn compare(paths: [&PathBuf; 2], report: Option<&Path>) -> Result<(), Failure> {
    let page = compare_page([&read(paths[0])?, &read(paths[1])?]);
    say(page.to_text()?.trim_end())?;
    if let Some(folder) = report {
        let [first, second] = paths.map(|path| sheets::stem(path));
        let path = folder.join(format!("{first}-and-{second}.html"));
        file::write(&path, &page.to_html()?)?;
        say(format_args!("page written to {}", path.display()))?;
    }
    Ok(())
}
