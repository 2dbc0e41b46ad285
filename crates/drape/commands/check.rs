//! `drape check`: reads scenes, fabrics, sheets and patterns without simulating, and verifies the
//! frames of runs.
//!
//! [`describe`] says in SI what a file holds, [`pattern`] how a pattern is cut; [`frames`] reads
//! the folders of runs by `drape::verify`, which shares no code with the simulation.

mod describe;
mod frames;
mod pattern;

use std::path::{Path, PathBuf};

use clap::Args;
use drape::input::Diagnostics;

use self::describe::describe;
use self::pattern::CutOut;
use crate::console::say;
use crate::failure::Failure;
use crate::file;

#[derive(Args)]
pub(crate) struct CheckArguments {
    /// Scenes, fabrics, sheets, patterns, or folders of runs.
    #[arg(required = true, value_name = "FILE")]
    pub(crate) files: Vec<PathBuf>,
    /// Draws the cut panels of a pattern, with the sides of a seam in one colour, as an SVG file.
    #[arg(long, value_name = "SVG")]
    pub(crate) figure: Option<PathBuf>,
    /// Distance between the particles of a cut pattern, in mm.
    #[arg(long, value_name = "MM", default_value_t = 10.0)]
    pub(crate) spacing: f64,
    /// Prints the results for folders of runs as JSON.
    #[arg(long)]
    pub(crate) json: bool,
}

/// Executes `drape check`: reads all files, reports all mistakes together, then verifies the frames
/// of runs.
pub(crate) fn check(arguments: &CheckArguments) -> Result<(), Failure> {
    let (runs, files): (Vec<&PathBuf>, Vec<&PathBuf>) =
        arguments.files.iter().partition(|file| frames::is_run(file));
    if let (true, Some(file)) = (arguments.json, files.first()) {
        let message = format!("--json is for folders of runs, and {} is none", file.display());
        return Err(Failure::Usage(message));
    }
    let spacing = 1e-3 * arguments.spacing;
    let mut mistakes = Vec::new();
    let mut told = |file: &Path, found: Result<String, Diagnostics>| match found {
        Ok(text) => say(format_args!("{}: {}", file.display(), text.trim_end())),
        Err(found) => {
            mistakes.extend(found.0);
            Ok(())
        }
    };
    match (&arguments.figure, &files[..]) {
        (Some(figure), [pattern]) => {
            let cut = CutOut::read(pattern, spacing)?;
            file::write(figure, cut.figure())?;
            told(pattern, Ok(cut.describe()))?;
        }
        (Some(_), _) => {
            return Err(Failure::Usage("--figure is for one pattern at a time".into()));
        }
        (None, files) => {
            for file in files {
                told(file, describe(file, spacing))?;
            }
        }
    }
    Diagnostics::check(mistakes)?;
    frames::verify(&runs, arguments.json)
}
