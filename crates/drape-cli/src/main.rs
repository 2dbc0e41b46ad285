//! The `drape` command: see `drape --help`.
//!
//! From the top down: [`command`] parses the arguments, one module of [`commands`] carries out each
//! command, and [`pages`] draws the results. Output goes through [`say`], [`console`],
//! [`file`](drape::run::file) and [`failure`] only.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process::ExitCode;

use clap::Parser;
use console::signal;
use failure::Failure;

// Arguments, and what a command does.
mod command;
mod commands;

// Pages and pictures.
mod pages;

// Input and output: files, stdout, stderr, the exit code.
mod console;
mod failure;
mod input;
mod remedy;
mod say;

/// Message after a panic.
const PANICKED: &str = "error: this is a mistake of the program, not of its input; please report it with \
     the lines above. A run goes on from its last checkpoint with `drape resume FOLDER`";

fn main() -> ExitCode {
    signal::let_large_files_fail();
    let command = command::CommandLine::parse();
    exit_code(|| command.execute())
}

/// Runs `command`, prints its failure, and returns the exit code.
fn exit_code(command: impl FnOnce() -> Result<(), Failure>) -> ExitCode {
    // The panic hook has printed the place. Files are replaced as a whole, so none is cut off.
    match catch_unwind(AssertUnwindSafe(command)) {
        Ok(Ok(())) => ExitCode::SUCCESS,
        Ok(Err(failure)) => failure.report(),
        Err(_) => {
            console::print_message(PANICKED);
            ExitCode::from(70)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_ends_with_70() {
        let codes = [
            exit_code(|| panic!("a mistake")),
            exit_code(|| Ok(())),
            exit_code(|| Err(Failure::Batch)),
        ];
        let expected = [ExitCode::from(70), ExitCode::SUCCESS, ExitCode::from(3)];
        assert_eq!(codes.map(|code| format!("{code:?}")), expected.map(|code| format!("{code:?}")));
    }
}
