//! The `drape` command: see `drape --help`.

use std::process::ExitCode;

use clap::Parser;

mod batch;
mod check;
mod command;
mod failure;
mod file;
mod fit;
mod fit_page;
mod picture;
mod progress;
mod quantity;
mod run;

fn main() -> ExitCode {
    let command = command::Command::parse();
    match command.execute() {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}
