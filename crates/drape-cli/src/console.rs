//! The console: messages on stderr, and how many of them the user asked for.
//!
//! The submodules are the progress bars, [`progress`], and the signals that ask the program to end,
//! [`signal`].
//!
//! The command line installs the console once. Text from the input may hold control characters, and
//! [`printable`] keeps them from the terminal.

pub(crate) mod progress;
pub(crate) mod signal;

use std::borrow::Cow;
use std::fmt::Display;
use std::io::{IsTerminal, Write};
use std::sync::OnceLock;

use clap::ValueEnum;

/// Amount of messages and progress on stderr.
#[derive(Clone, Copy, Default)]
pub(crate) struct Console {
    /// Whether notes and progress are left out.
    pub(crate) quiet: bool,
    /// Whether every step of a simulation prints a line.
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
    /// Makes `self` the console of the program. Only the first call has an effect.
    pub(crate) fn install(self) {
        let _ = CONSOLE.set(self);
    }

    /// Returns the installed console, or the `Default` one before [`Self::install`].
    pub(crate) fn get() -> Self {
        CONSOLE.get().copied().unwrap_or_default()
    }

    /// Returns whether progress is shown as a bar.
    pub(crate) fn has_bar(self) -> bool {
        !self.quiet && !self.verbose && self.progress == ProgressKind::Auto
    }
}

/// Returns whether messages on stderr are coloured: on a terminal, unless `NO_COLOR` is set or
/// `TERM` is `dumb`.
pub(crate) fn is_coloured() -> bool {
    let refused = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
    let dumb = std::env::var_os("TERM").is_some_and(|value| value == "dumb");
    !refused && !dumb && std::io::stderr().is_terminal()
}

/// Writes `text` to stderr as a line, with control characters replaced.
pub(crate) fn print_message(text: impl Display) {
    print_coloured(printable(&text.to_string()));
}

/// Writes `text` to stderr as a line. `text` may hold colours, so the caller must have made parts
/// from the input [`printable`].
pub(crate) fn print_coloured(text: impl Display) {
    // If stderr cannot be written, only the exit code remains to report the failure.
    let _ = writeln!(std::io::stderr().lock(), "{text}");
}

/// Writes `text` to stderr as a note, unless the user asked for quiet.
pub(crate) fn note(text: impl Display) {
    if !Console::get().quiet {
        print_message(format_args!("note: {text}"));
    }
}

/// Replaces each control character of `text` by U+FFFD, except line ends and tabs.
pub(crate) fn printable(text: &str) -> Cow<'_, str> {
    if !text.contains(is_unprintable) {
        return Cow::Borrowed(text);
    }
    Cow::Owned(text.replace(is_unprintable, "\u{fffd}"))
}

fn is_unprintable(character: char) -> bool {
    character.is_control() && character != '\n' && character != '\t'
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
