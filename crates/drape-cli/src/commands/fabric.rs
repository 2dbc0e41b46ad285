//! `drape fabric`: lists fabrics, shows one, compares several, writes one for other programs.

mod compare;
mod export;
mod list;
mod read;
pub(crate) mod report;

use std::path::{Path, PathBuf};

use clap::Subcommand;
use drape::run::reports::show_page;

use self::compare::compare;
pub(crate) use self::export::MaterialArguments;
use self::export::export;
use self::list::list;
pub(crate) use self::read::read;
use crate::commands::fit::store;
use crate::commands::sheets;
use crate::failure::Failure;
use crate::say::{say, say_json, say_written};

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
    /// Compares fabrics: what was measured and the laws beside it, with the differences from the
    /// first; curves and loops overlaid.
    Compare {
        /// Fabrics, or sheets, which are fitted first, two or more. What was measured is in a
        /// sheet, or in the sheet beside a fabric that was fitted to it.
        #[arg(required = true, num_args = 2.., value_name = "FABRIC")]
        fabrics: Vec<PathBuf>,
        /// Folder for a page with plots.
        #[arg(long, value_name = "FOLDER")]
        report: Option<PathBuf>,
        /// Prints the page as JSON, in SI.
        #[arg(long)]
        json: bool,
    },
    /// Writes a fabric as the material of another program: Blender, ppf-contact-solver, Browzwear,
    /// U3M.
    Export(MaterialArguments),
}

/// Executes `drape fabric`.
pub(crate) fn fabric(command: &FabricCommand) -> Result<(), Failure> {
    match command {
        FabricCommand::List { folders, json } => list(folders, *json),
        FabricCommand::Show { fabric, report, json } => show(fabric, report.as_deref(), *json),
        FabricCommand::Compare { fabrics, report, json } => {
            compare(fabrics, report.as_deref(), *json)
        }
        FabricCommand::Export(arguments) => export(arguments),
    }
}

/// Prints the page of the fabric at `path`, and stores it in the folder `report`.
fn show(path: &Path, report: Option<&Path>, json: bool) -> Result<(), Failure> {
    let sheet = sheets::sheet_path(path).and_then(|path| sheets::read(path).ok());
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
