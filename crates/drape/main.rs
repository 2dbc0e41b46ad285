//! The `drape` command: see `drape --help`.

use std::process::ExitCode;

use clap::Parser;

mod batch;
mod bench;
mod check;
mod command;
mod drapemeter;
mod fabric;
mod fabric_page;
mod failure;
mod file;
mod fit;
mod fit_page;
mod kes_value;
mod pattern;
mod picture;
mod progress;
mod quantity;
mod run;
mod say;
mod strain_picture;
mod test;
mod validate;
mod validation_page;
mod verify;

fn main() -> ExitCode {
    let command = command::Command::parse();
    match command.execute() {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}
