//! Lines that commands write to stdout.

use std::fmt::Display;
use std::io::{ErrorKind, Write};

use serde::Serialize;

use crate::console::{Console, printable};
use crate::failure::Failure;

/// Writes `text` to stdout as a line. A closed pipe is no failure.
pub(crate) fn say(text: impl Display) -> Result<(), Failure> {
    match writeln!(std::io::stdout().lock(), "{}", printable(&text.to_string())) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::Output(format!("cannot write to stdout: {error}")))
        }
        _ => Ok(()),
    }
}

/// Writes `text`, which says where a result was stored, to stdout, unless the user asked for quiet.
pub(crate) fn say_written(text: impl Display) -> Result<(), Failure> {
    if Console::get().quiet { Ok(()) } else { say(text) }
}

/// Writes `value` to stdout as indented JSON.
pub(crate) fn say_json(value: &impl Serialize) -> Result<(), Failure> {
    say(serde_json::to_string_pretty(value).expect("results always have a JSON form"))
}
