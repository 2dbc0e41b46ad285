//! `drape fabric`: what fabrics there are, what one is, how two differ.

use std::path::{Path, PathBuf};

use drape::fabric::Fabric;
use drape::fit::Settings;
use drape::input::Document;

use crate::batch;
use crate::command::FabricCommand;
use crate::fabric_page::{compare_page, show_page};
use crate::failure::Failure;
use crate::say::say;
use crate::{file, fit};

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

/// A fabric from its file, or from a sheet, which is fitted on the way.
pub(crate) fn read(path: &Path) -> Result<Fabric, Failure> {
    if path.is_dir() {
        return Ok(fit::identified(path, &Settings::default())?.0.fabric);
    }
    let document = Document::read(path)?;
    let table: toml::Table = document.decode()?;
    if table.contains_key("density") || table.contains_key("shear") {
        return Ok(Fabric::from_document(&document)?);
    }
    Ok(fit::identified(path, &Settings::default())?.0.fabric)
}

fn list(folders: &[PathBuf]) -> Result<(), Failure> {
    let sheets = batch::sheets(folders)?;
    say(format_args!("{:<44} {:>6} {:>7}  {:<38} sheet", "fabric", "g/m²", "mm", "measured"))?;
    for path in &sheets {
        match drape::kes::Sheet::read(path) {
            Ok(sheet) => say(line(path, &sheet))?,
            Err(error) => Failure::from(fit::input(path, error)).print(),
        }
    }
    Ok(())
}

/// What a sheet has: mass, thickness, curves by test, values by symbol.
fn line(path: &Path, sheet: &drape::kes::Sheet) -> String {
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
    let page = show_page(&read(path)?);
    say(page.to_text()?.trim_end())?;
    if let Some(written) = fit::store(&page, &batch::stem(path), report)? {
        say(format_args!("page written to {}", written.display()))?;
    }
    Ok(())
}

fn compare(paths: [&PathBuf; 2], report: Option<&Path>) -> Result<(), Failure> {
    let page = compare_page([&read(paths[0])?, &read(paths[1])?]);
    say(page.to_text()?.trim_end())?;
    if let Some(folder) = report {
        let [first, second] = paths.map(|path| batch::stem(path));
        let path = folder.join(format!("{first}-and-{second}.html"));
        file::write(&path, &page.to_html()?)?;
        say(format_args!("page written to {}", path.display()))?;
    }
    Ok(())
}
