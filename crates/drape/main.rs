//! The `drape` command: see `drape --help`.
//!
//! From the top down: [`command`] reads the arguments, one module of [`commands`] carries each
//! command out, [`pages`] turns its results into pages and pictures, and [`say`], [`console`], [`file`],
//! [`progress`] and [`failure`] are all that writes. [`keep`] keeps what a run has come to, and
//! notes what asks the program to end.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process::ExitCode;

use clap::Parser;

// What a person types, and what is done.
mod command;
mod commands;

// What a person is shown.
mod pages;

// Where it goes: stdout, files, stderr, the exit code.
mod console;
mod failure;
mod file;
mod input;
mod keep;
mod progress;
mod say;

/// What is told after a panic.
const PANICKED: &str = "error: this is a mistake of the program, not of its input; please report it with \
     the lines above. A run goes on from its last checkpoint with `drape resume FOLDER`";

fn main() -> ExitCode {
    keep::signal::let_large_files_fail();
    let command = command::CommandLine::parse();
    // A panic has told where it was; what the command wrote until then is whole.
    match catch_unwind(AssertUnwindSafe(|| command.execute())) {
        Ok(Ok(())) => ExitCode::SUCCESS,
        Ok(Err(failure)) => failure.report(),
        Err(_) => {
            console::tell(PANICKED);
            ExitCode::from(70)
        }
    }
}
