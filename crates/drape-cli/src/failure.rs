//! Failures of commands, with their messages on stderr and their exit codes.

use std::fmt;
use std::path::Path;
use std::process::ExitCode;

use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};
use drape::input::{Diagnostic, Diagnostics};

use crate::console::{is_coloured, print_coloured, print_message, printable};
use crate::input;
use crate::remedy;
use drape::run::file;

/// Failure that ends a command, with its exit code.
pub(crate) enum Failure {
    /// Exit code 2: the arguments do not fit together.
    Usage(String),
    /// Exit code 3: the input has mistakes.
    Input(Diagnostics),
    /// Exit code 3: a sheet gives no fabric.
    Fit(drape::fit::Error),
    /// Exit code 3: saved frames cannot be read.
    Frames(drape::frames::Error),
    /// Exit code 3: some sheets of a batch failed. Each failure was printed before.
    Batch,
    /// Exit code 4: surfaces intersect.
    Intersecting(String),
    /// Exit code 5: the solver failed, or the cloth did not settle.
    Solver(String),
    /// Exit code 7: a figure is beyond its limit.
    Limit(String),
    /// Exit code 8: a run reached a limit that the user set.
    Stopped(String),
    /// Exit code 128 + `signal`: the program was asked to end.
    Interrupted { signal: u8, message: String },
    /// Exit code `code`, from the first of several failures. Each failure was printed before.
    Several { code: u8 },
    /// Exit code 6: a file could not be written.
    Output(String),
}

impl Failure {
    /// Prints the failure and returns its [`code`](Self::code).
    pub(crate) fn report(&self) -> ExitCode {
        self.print();
        ExitCode::from(self.code())
    }

    /// Returns the exit code, which the guide lists.
    pub(crate) fn code(&self) -> u8 {
        match self {
            Self::Usage(_) => 2,
            Self::Input(_) | Self::Fit(_) | Self::Frames(_) | Self::Batch => 3,
            Self::Intersecting(_) => 4,
            Self::Solver(_) => 5,
            Self::Output(_) => 6,
            Self::Limit(_) => 7,
            Self::Stopped(_) => 8,
            Self::Interrupted { signal, .. } => 128 + signal,
            Self::Several { code } => *code,
        }
    }

    /// Prints the failure. A [`Diagnostic`] is printed with the line of its file.
    pub(crate) fn print(&self) {
        match self {
            Self::Input(mistakes) => {
                let mistakes = mistakes.clone().in_words(remedy::in_words);
                mistakes.shown().iter().for_each(|mistake| print_coloured(render(mistake)));
                mistakes
                    .hidden_count_text()
                    .iter()
                    .for_each(|rest| print_message(format_args!("error: {rest}")));
            }
            Self::Batch | Self::Several { .. } => {}
            failure => print_message(format_args!("error: {failure}")),
        }
    }

    /// Returns the failure for `error`, of a picture that cannot be drawn or encoded.
    pub(crate) fn from_picture(error: drape::render::Error) -> Self {
        Self::Output(error.to_string())
    }

    /// Turns a [`Self::Fit`] failure into an input failure that names the file of `sheet`. Other
    /// failures stay as they are.
    pub(crate) fn in_sheet(self, sheet: &Path) -> Self {
        match self {
            Self::Fit(error) => {
                let file = input::sheet_file(sheet);
                let mistake = match input::document(&file) {
                    Ok(document) => drape::run::fit_mistake(&document, &error),
                    Err(_) => Diagnostic::new(input::message_path(sheet), error.to_string()),
                };
                Self::Input(mistake.into())
            }
            failure => failure,
        }
    }
}

impl From<drape::fit::Error> for Failure {
    fn from(error: drape::fit::Error) -> Self {
        Self::Fit(error)
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Usage(message)
            | Self::Intersecting(message)
            | Self::Solver(message)
            | Self::Output(message)
            | Self::Limit(message)
            | Self::Stopped(message)
            | Self::Interrupted { message, .. } => f.write_str(message),
            Self::Several { .. } => f.write_str("not all scenes could be run"),
            Self::Input(mistakes) => mistakes.clone().in_words(remedy::in_words).fmt(f),
            Self::Fit(error) => error.fmt(f),
            Self::Frames(error) => error.fmt(f),
            Self::Batch => f.write_str("not all sheets could be fitted"),
        }
    }
}

impl From<drape::frames::Error> for Failure {
    fn from(error: drape::frames::Error) -> Self {
        use drape::frames::Error;
        match &error {
            Error::Occupied { folder } => Self::Usage(format!(
                "{} holds results already; give another folder, or allow it with --force",
                folder.display()
            )),
            Error::Write { .. } => Self::Output(error.to_string()),
            _ => Self::Frames(error),
        }
    }
}

impl From<drape::export::Error> for Failure {
    fn from(error: drape::export::Error) -> Self {
        use drape::export::Error;
        match error {
            Error::Frames(error) => error.into(),
            Error::Write(_) => Self::Output(format!("cannot write: {error}")),
            error => Self::Usage(error.to_string()),
        }
    }
}

impl From<drape::render::Error> for Failure {
    /// Converts `error`, whose cause is a shape or a number of the input that cannot be drawn.
    fn from(error: drape::render::Error) -> Self {
        Self::Input(Diagnostic::new("report", error.to_string()).into())
    }
}

impl From<drape::report::Error> for Failure {
    /// Converts `error`, whose cause is a name or a number of the input that cannot be shown.
    fn from(error: drape::report::Error) -> Self {
        Self::Input(Diagnostic::new("report", error.to_string()).into())
    }
}

impl From<drape::sweep::Error> for Failure {
    fn from(error: drape::sweep::Error) -> Self {
        match error {
            drape::sweep::Error::Input(mistakes) => Self::Input(mistakes),
            error => Self::Output(error.to_string()),
        }
    }
}

impl From<Diagnostics> for Failure {
    fn from(mistakes: Diagnostics) -> Self {
        Self::Input(mistakes)
    }
}

impl From<drape::scene::Error> for Failure {
    fn from(error: drape::scene::Error) -> Self {
        match error {
            drape::scene::Error::Input(mistakes) => Self::Input(mistakes),
            drape::scene::Error::Tangled(tangle) => Self::Input(tangle.mistakes),
            error => Self::Solver(error.to_string()),
        }
    }
}

impl From<file::Error> for Failure {
    fn from(error: file::Error) -> Self {
        match error {
            file::Error::Exists { .. } => Self::Usage(error.to_string()),
            error => Self::Output(error.to_string()),
        }
    }
}

impl From<drape::run::Error> for Failure {
    fn from(error: drape::run::Error) -> Self {
        use drape::run::Error;
        match error {
            Error::File(error) => error.into(),
            Error::Input(mistakes) => Self::Input(mistakes),
            Error::Dynamics(error) => error.into(),
            Error::Frames(error) => error.into(),
            Error::Folder { .. } | Error::LastFrame { .. } | Error::Space { .. } => {
                Self::Output(error.to_string())
            }
            Error::Locked { folder } => Self::Usage(format!(
                "another run is writing to {}; wait for its end, or give another folder with -o",
                folder.display()
            )),
            Error::Interrupted { folder } => Self::Usage(format!(
                "{place} holds a run that was interrupted; go on with `drape resume {place}`, or begin anew \
                 with --force",
                place = folder.display()
            )),
            Error::GradedBy { folder } => Self::Usage(format!(
                "{} holds the run that grading.run names; give another folder with -o",
                folder.display()
            )),
            Error::End { end, step } => {
                Self::Usage(format!("--until {end}: a step takes {step} s already"))
            }
            Error::Damaged { path, reason } => Self::Input(
                Diagnostic::new(path, reason)
                    .help("the file is not as it was written: restore it, or run the scene anew with drape run --force")
                    .into(),
            ),
            Error::NotBegun { path, reason } => Self::Usage(format!(
                "{}: {reason}; a folder that `drape run` has begun has it",
                path.display()
            )),
            Error::Ended { folder, status } => Self::Usage(format!(
                "{}: the run has ended ({status}); go on beyond its end with --extend SECONDS",
                folder.display()
            )),
            Error::Failed { folder, status } => Self::Usage(format!(
                "{}: the run has ended ({status}); it would end so again: change its scene, and run it anew \
                 with drape run --force",
                folder.display()
            )),
            error => Self::Usage(error.to_string()),
        }
    }
}

impl From<drape::dynamics::Error> for Failure {
    fn from(error: drape::dynamics::Error) -> Self {
        use drape::dynamics::Error;
        match error {
            Error::Frames(error) => error.into(),
            Error::Checkpoint(error) => error.into(),
            Error::Unfit { reason } => Self::Solver(format!(
                "the checkpoint does not fit the scene: {reason}; run the scene anew with --force"
            )),
            error => Self::Solver(error.to_string()),
        }
    }
}

impl From<drape::checkpoint::Error> for Failure {
    fn from(error: drape::checkpoint::Error) -> Self {
        use drape::checkpoint::Error;
        match &error {
            Error::Write { .. } | Error::Irregular { .. } => Self::Output(error.to_string()),
            Error::Read { path, .. } => {
                Self::Input(Diagnostic::new(path, error.to_string()).into())
            }
            _ => Self::Solver(error.to_string()),
        }
    }
}

/// Formats `mistake` in one paragraph, without the line of its file.
fn render_without_source(mistake: &Diagnostic) -> String {
    printable(&format!("error: {mistake}")).into_owned()
}

/// Formats `mistake` with the marked line of its file, if the file can be read.
fn render(mistake: &Diagnostic) -> String {
    let file_text = mistake.span.as_ref().and_then(|_| input::source(&mistake.file));
    let (Some(file_text), Some(span)) = (file_text, mistake.span.clone()) else {
        return render_without_source(mistake);
    };
    let text = file_text.trim_start_matches('\u{feff}');
    if text.get(span.clone()).is_none() {
        // The file has changed since it was read.
        return render_without_source(mistake);
    }

    // Every text goes to a terminal, so control characters are replaced first.
    let source = mask_control_characters(text);
    let path = mistake.file.display().to_string();
    let [path, message] = [&path, &mistake.message].map(|text| printable(text).into_owned());
    let help = mistake.help.as_deref().map(|help| printable(help).into_owned());

    let annotation = AnnotationKind::Primary.span(span);
    let snippet = Snippet::source(&*source).path(&path).annotation(annotation);
    let mut group = Level::ERROR.primary_title(&message).element(snippet);
    if let Some(help) = &help {
        group = group.element(Level::HELP.message(help));
    }
    let renderer = if is_coloured() { Renderer::styled() } else { Renderer::plain() };
    renderer.render(&[group])
}

/// Replaces every byte of a control character in `source` by `?`, so that byte offsets into the
/// text stay valid.
fn mask_control_characters(source: &str) -> String {
    source
        .chars()
        .map(|c| {
            let is_kept = !c.is_control() || matches!(c, '\n' | '\r' | '\t');
            if is_kept { c.to_string() } else { "?".repeat(c.len_utf8()) }
        })
        .collect()
}
