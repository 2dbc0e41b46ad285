//! The console: messages on stderr, and how much the user asked to be told.
//!
//! Here are its bars too, [`progress`], and the signals that it sends, [`signal`].
//!
//! The command line installs the console once. Text of the input may hold control characters; none
//! of them reaches a terminal.

pub(crate) mod progress;
pub(crate) mod signal;

use std::borrow::Cow;
use std::fmt::Display;
use std::io::{IsTerminal, Write};
use std::sync::OnceLock;

use clap::ValueEnum;

/// How much a command tells.
#[derive(Clone, Copy, Default)]
pub(crate) struct Console {
    /// Whether notes and progress are left out.
    pub(crate) quiet: bool,
    /// Whether every step of a simulation is told.
    pub(crate) verbose: bool,
    pub(crate) progress: ProgressKind,
}

/// Progress on stderr.
#[derive(Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum ProgressKind {
    /// A bar where stderr is a terminal.
    #[default]
    Auto,
    /// One JSON object a line, for programs: of a run one after each step, with `done`, which
    /// grows from 0 to 1 over all of its phases.
    Json,
    /// None.
    None,
}

static CONSOLE: OnceLock<Console> = OnceLock::new();

impl Console {
    /// Makes this the console of the program; the first one stays.
    pub(crate) fn install(self) {
        let _ = CONSOLE.set(self);
    }

    /// Returns the console of the program.
    pub(crate) fn get() -> Self {
        CONSOLE.get().copied().unwrap_or_default()
    }

    /// Whether progress is shown as a bar.
    pub(crate) fn has_bar(self) -> bool {
        !self.quiet && !self.verbose && self.progress == ProgressKind::Auto
    }
}

/// Whether messages on stderr are coloured: on a terminal, unless `NO_COLOR` is set.
pub(crate) fn is_coloured() -> bool {
    let refused = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
    let dumb = std::env::var_os("TERM").is_some_and(|value| value == "dumb");
    !refused && !dumb && std::io::stderr().is_terminal()
}

/// Writes a message to stderr.
pub(crate) fn tell(text: impl Display) {
    tell_coloured(printable(&text.to_string()));
}

/// Writes a message to stderr that may hold colours; what came from the input was made printable.
pub(crate) fn tell_coloured(text: impl Display) {
    // Where stderr takes nothing, there is nobody to tell; the exit code says the rest.
    let _ = writeln!(std::io::stderr().lock(), "{text}");
}

/// Writes a note to stderr, unless the user asked for quiet.
pub(crate) fn note(text: impl Display) {
    if !Console::get().quiet {
        tell(format_args!("note: {text}"));
    }
}

/// Replaces control characters by the mark of an unknown character, but line ends and tabs.
pub(crate) fn printable(text: &str) -> Cow<'_, str> {
    let is_control = |c: char| c.is_control() && c != '\n' && c != '\t';
    if !text.contains(is_control) {
        return Cow::Borrowed(text);
    }
    Cow::Owned(text.replace(is_control, "\u{fffd}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn control_characters_do_not_reach_a_terminal() {
        assert_eq!(printable("a\tb\n"), "a\tb\n");
        assert_eq!(printable("red \u{1b}[31m name"), "red \u{fffd}[31m name");
    }
}
