use std::path::PathBuf;

use clap::{Args, Parser};

use crate::failure::Failure;
use crate::{check, fit, run};

/// From measured fabric to moving cloth.
#[derive(Parser)]
#[command(name = "drape", version, propagate_version = true)]
pub(crate) enum Command {
    /// Identifies a fabric from KES curves or values and writes fabric.toml.
    Fit(FitArguments),
    /// Simulates a scene: frames, a picture and summary.json.
    Run(RunArguments),
    /// Validates scenes, fabrics and sheets without simulating.
    Check(CheckArguments),
}

#[derive(Args)]
pub(crate) struct FitArguments {
    /// The sheet, a TOML file, or its folder.
    pub(crate) sheet: PathBuf,
    /// The fabric to write [default: fabric.toml beside the sheet].
    #[arg(short, long, value_name = "FABRIC.toml")]
    pub(crate) output: Option<PathBuf>,
    /// Replaces a fabric that is there already.
    #[arg(long)]
    pub(crate) force: bool,
    /// Prints the fit as JSON.
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Args)]
pub(crate) struct RunArguments {
    /// The scene, a TOML file.
    pub(crate) scene: PathBuf,
    /// Folder for the results [default: the scene's, or out/NAME].
    #[arg(short, long, value_name = "FOLDER")]
    pub(crate) output: Option<PathBuf>,
    /// Number of threads [default: all].
    #[arg(long, value_name = "N")]
    pub(crate) threads: Option<usize>,
    /// Ends the simulation at this time, in seconds.
    #[arg(long, value_name = "SECONDS")]
    pub(crate) until: Option<f64>,
    /// Replaces the results of an earlier run.
    #[arg(long)]
    pub(crate) force: bool,
    /// Prints the summary as JSON.
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Args)]
pub(crate) struct CheckArguments {
    /// Scenes, fabrics or sheets.
    #[arg(required = true, value_name = "FILE")]
    pub(crate) files: Vec<PathBuf>,
}

impl Command {
    pub(crate) fn execute(&self) -> Result<(), Failure> {
        match self {
            Self::Fit(arguments) => fit::fit(arguments),
            Self::Run(arguments) => run::run(arguments),
            Self::Check(arguments) => check::check(arguments),
        }
    }
}
