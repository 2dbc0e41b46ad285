//! The `drape` command: see `drape --help`.
//!
//! From the top down: [`command`] reads the arguments, one module of [`commands`] carries each
//! command out, [`pages`] turns its results into pages and pictures, and [`say`], [`console`], [`file`],
//! [`progress`] and [`failure`] are all that writes. [`signal`] notes what asks the program to end.

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
mod progress;
mod say;

// What ends it early.
mod signal;

fn main() -> ExitCode {
    signal::let_large_files_fail();
    let command = command::CommandLine::parse();
    match command.execute() {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}
