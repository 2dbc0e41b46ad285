//! The `drape` command: see `drape --help`.

use std::process::ExitCode;

use clap::Parser;

mod check;
mod command;
mod failure;
mod fit;
mod picture;
mod progress;
mod run;

fn main() -> ExitCode {
    let command = command::Command::parse();
    match command.execute() {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}
