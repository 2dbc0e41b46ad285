//! The `drape` command: see `drape --help`.
//!
//! From the top down: [`command`] reads the arguments, one module of [`commands`] carries each
//! command out, [`pages`] draws its results, and [`say`], [`console`], [`file`] and [`failure`] are
//! all that writes.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process::ExitCode;

use clap::Parser;
use console::signal;
use failure::Failure;

// What a person types, and what is done.
mod command;
mod commands;

// What a person is shown.
mod pages;

// Where it goes: stdout, stderr, the exit code.
mod console;
mod failure;
mod input;
mod say;

/// What is told after a panic.
const PANICKED: &str = "error: this is a mistake of the program, not of its input; please report it with \
     the lines above. A run goes on from its last checkpoint with `drape resume FOLDER`";

fn main() -> ExitCode {
    signal::let_large_files_fail();
    let command = command::CommandLine::parse();
    ended(|| command.execute())
}

/// Exit code of a command, which is executed and whose failure is told.
fn ended(command: impl FnOnce() -> Result<(), Failure>) -> ExitCode {
    // A panic has told where it was; what the command wrote until then is whole.
    match catch_unwind(AssertUnwindSafe(command)) {
        Ok(Ok(())) => ExitCode::SUCCESS,
        Ok(Err(failure)) => failure.report(),
        Err(_) => {
            console::tell(PANICKED);
            ExitCode::from(70)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_ends_with_70() {
        let codes =
            [ended(|| panic!("a mistake")), ended(|| Ok(())), ended(|| Err(Failure::Batch))];
        let right = [ExitCode::from(70), ExitCode::SUCCESS, ExitCode::from(3)];
        assert_eq!(codes.map(|code| format!("{code:?}")), right.map(|code| format!("{code:?}")));
    }
}
