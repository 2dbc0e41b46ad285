//! Jobs of a fit: sheets, and tables from which a sheet is drafted first, each with the files that
//! it writes.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use drape::input::Diagnostics;
use drape::kes::{Sheet, SheetDraft};

use super::arguments::FitArguments;
use crate::commands::sheets::{self, SHEET_FILE, drafted};
use crate::failure::Failure;
use drape::run::file;

/// Sheet to be fitted.
pub(crate) struct Job {
    /// Path of the sheet. A drafted sheet is written there.
    pub(crate) sheet: PathBuf,
    /// Draft of the sheet, if the sheet is drafted from tables.
    draft: Option<SheetDraft>,
    /// Name of the page, and of the fabric in a folder of several.
    pub(crate) name: String,
    /// Path of the fabric.
    pub(crate) fabric: PathBuf,
}

/// Returns the jobs of `arguments`. Several jobs have different names.
pub(crate) fn jobs(arguments: &FitArguments) -> Result<Vec<Job>, Failure> {
    let mut jobs = Vec::new();
    for path in &arguments.sheets {
        if sheets::holds_tables(path) {
            jobs.extend(table_jobs(path, arguments)?);
        } else if arguments.fabric.is_some() {
            let path = path.display();
            let message = format!("--fabric takes one of several in tables, and {path} is a sheet");
            return Err(Failure::Usage(message));
        } else {
            let paths = sheets::find_sheets(std::slice::from_ref(path))?;
            jobs.extend(paths.into_iter().map(Job::from_sheet));
        }
    }

    if let [job] = &mut jobs[..] {
        if let Some(fabric) = &arguments.output {
            job.write_to(fabric.clone());
        }
        return Ok(jobs);
    }
    // Several jobs are named by their stems, with a number where a stem repeats.
    let mut taken = BTreeSet::new();
    for job in &mut jobs {
        let stem = job.name.clone();
        let numbered = (2..).map(|number| format!("{stem}-{number}"));
        let mut candidates = std::iter::once(stem.clone()).chain(numbered);
        let name = candidates.find(|name| taken.insert(name.clone()));
        job.name = name.expect("there is always a next number");
        if let Some(folder) = &arguments.output {
            job.write_to(folder.join(format!("{}.toml", job.name)));
        }
    }
    Ok(jobs)
}

/// Returns the jobs of the sheets that are drafted from the tables at `path`: all of them, or the
/// one of `--fabric`.
fn table_jobs(path: &Path, arguments: &FitArguments) -> Result<Vec<Job>, Failure> {
    let is_alone = arguments.sheets.len() == 1;
    let folder = match &arguments.output {
        Some(output) if is_alone => output.parent().unwrap_or(Path::new("")),
        Some(output) => output,
        None => tables_folder(path),
    };
    let mut drafts = drafted::drafts(path, folder, arguments.fabric.as_deref())?;
    // With several fabrics the output is a folder, and the paths in the sheets start there.
    if let (true, true, Some(output)) = (drafts.len() > 1, is_alone, &arguments.output) {
        drafted::refuse_file(path, output, &drafts)?;
        drafts = drafted::drafts(path, output, None)?;
    }
    let several = drafts.len() > 1;
    Ok(drafts.into_iter().map(|draft| Job::from_draft(path, draft, several)).collect())
}

/// Returns the folder of tables.
fn tables_folder(path: &Path) -> &Path {
    if path.is_dir() { path } else { path.parent().unwrap_or(Path::new("")) }
}

impl Job {
    fn from_sheet(sheet: PathBuf) -> Self {
        Self {
            name: sheets::stem(&sheet),
            fabric: sheets::fabric_beside(&sheet),
            draft: None,
            sheet,
        }
    }

    /// Returns the job of `draft`, whose files lie beside the tables, or in their folder.
    fn from_draft(path: &Path, draft: SheetDraft, several: bool) -> Self {
        let name = drafted::name(path, &draft, several);
        let folder = tables_folder(path);
        let (sheet, fabric) = if path.is_dir() && !several {
            let sheet = folder.join(SHEET_FILE);
            let fabric = sheets::fabric_beside(&sheet);
            (sheet, fabric)
        } else {
            let fabric = folder.join(format!("{name}.toml"));
            (drafted::sheet_beside(&fabric), fabric)
        };
        Self { name, sheet, fabric, draft: Some(draft) }
    }

    /// Sets the path of the fabric. A drafted sheet moves beside `fabric`.
    fn write_to(&mut self, fabric: PathBuf) {
        if self.is_drafted() {
            self.sheet = drafted::sheet_beside(&fabric);
        }
        self.fabric = fabric;
    }

    /// Returns whether the sheet is drafted from tables.
    pub(crate) fn is_drafted(&self) -> bool {
        self.draft.is_some()
    }

    /// Refuses to replace existing files unless `force` is set. `help` is the remedy for the
    /// fabric.
    pub(crate) fn refuse_existing(&self, force: bool, help: &str) -> Result<(), Failure> {
        if self.is_drafted() && !force && self.sheet.exists() {
            let sheet = self.sheet.display();
            return Err(Failure::Usage(format!(
                "{sheet} exists, the sheet of these tables: fit it with drape fit {sheet}, or replace it with --force"
            )));
        }
        Ok(file::refuse_existing(&self.fabric, force, help)?)
    }

    /// Writes the sheet, if it is drafted.
    pub(crate) fn write_sheet(&self) -> Result<(), Failure> {
        let Some(draft) = &self.draft else { return Ok(()) };
        Ok(file::write(&self.sheet, &draft.text)?)
    }

    /// Reads the [`Sheet`], or parses its draft.
    pub(crate) fn read(&self) -> Result<Sheet, Diagnostics> {
        match &self.draft {
            Some(draft) => drafted::read(draft, &self.sheet),
            None => sheets::read(&self.sheet),
        }
    }
}
