//! Limits of a run, as arguments.

use clap::Args;
use drape::run::Limits;

/// Limits of a run. A run that reaches a limit ends with a checkpoint.
#[derive(Args)]
pub(crate) struct LimitArguments {
    /// Ends the run with a checkpoint after this time, in seconds (exit code 8).
    #[arg(long, value_name = "SECONDS", value_parser = positive)]
    max_wall: Option<f64>,
    /// Ends the run with a checkpoint when the program takes more memory, in MB (exit code 8).
    #[arg(long, value_name = "MB", value_parser = positive)]
    max_memory: Option<f64>,
    /// Ends the run with a checkpoint when its results take more of the disk, in MB (exit code 8).
    #[arg(long, value_name = "MB", value_parser = positive)]
    max_disk: Option<f64>,
}

impl LimitArguments {
    /// Returns the [`Limits`] that the arguments name.
    pub(crate) fn limits(&self) -> Limits {
        let Self { max_wall, max_memory, max_disk } = *self;
        Limits { max_wall, max_memory, max_disk }
    }
}

/// Parses `text` as a finite number above 0.
pub(crate) fn positive(text: &str) -> Result<f64, String> {
    let number: f64 = text.parse().map_err(|_| "no number".to_owned())?;
    if number > 0.0 && number.is_finite() {
        return Ok(number);
    }
    Err("not a number above 0".into())
}
