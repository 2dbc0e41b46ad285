//! `drape completions` and `drape man`: shell completions and manual pages, generated from the
//! arguments of the commands.

use std::path::PathBuf;

use clap::{Args, Command};
use clap_complete::Shell;
use clap_mangen::Man;

use crate::failure::Failure;
use crate::say::{say, say_written};
use drape::run::file;

#[derive(Args)]
pub(crate) struct CompletionsArguments {
    /// The shell.
    #[arg(value_enum)]
    shell: Shell,
}

#[derive(Args)]
pub(crate) struct ManArguments {
    /// Folder for the pages of all commands, `drape.1`, `drape-run.1` and so on [default: prints
    /// `drape.1`].
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,
}

/// Executes `drape completions`. `command` is the whole command line.
pub(crate) fn completions(
    arguments: &CompletionsArguments,
    mut command: Command,
) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut command, "drape", &mut script);
    say(String::from_utf8_lossy(&script).trim_end())
}

/// Executes `drape man`. `command` is the whole command line.
pub(crate) fn man(arguments: &ManArguments, mut command: Command) -> Result<(), Failure> {
    command.build();
    let Some(folder) = &arguments.output else {
        return say(String::from_utf8_lossy(&page(&command)?).trim_end());
    };

    let mut pending = vec![command];
    let mut count = 0;
    while let Some(command) = pending.pop() {
        let name = command.get_display_name().unwrap_or(command.get_name()).to_owned();
        file::write(&folder.join(format!("{name}.1")), page(&command)?)?;
        count += 1;
        pending.extend(command.get_subcommands().filter(|c| c.get_name() != "help").cloned());
    }
    say_written(format_args!("{count} pages written to {}", folder.display()))
}

/// Returns the manual page of `command`.
fn page(command: &Command) -> Result<Vec<u8>, Failure> {
    let mut page = Vec::new();
    let rendered = Man::new(command.clone()).render(&mut page);
    rendered.map_err(|error| Failure::Output(format!("cannot write a manual page: {error}")))?;
    Ok(page)
}
