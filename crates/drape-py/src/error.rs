//! Mistakes and failures as the exceptions of `drape._errors`.

use std::collections::BTreeMap;
use std::ffi::CString;

use drape::input::{Diagnostic, Diagnostics, Edit, Subject};
use pyo3::prelude::*;

use crate::remedy;

/// Kind of a failure: the name of its exception.
#[derive(Clone, Copy)]
pub(crate) enum Kind {
    Usage,
    Solver,
    Output,
    /// A fault of a library.
    Fault,
}

/// Returns the exception of a failure.
pub(crate) fn failure(kind: Kind, message: impl ToString) -> PyErr {
    let name = match kind {
        Kind::Usage => "UsageError",
        Kind::Solver => "SolverError",
        Kind::Output => "OutputError",
        Kind::Fault => "InternalError",
    };
    let message = message.to_string();
    raised(|module| module.getattr(name)?.call1((message,)))
}

/// Returns the exception of mistakes of an input, which lists them.
pub(crate) fn input(mistakes: &Diagnostics) -> PyErr {
    let mistakes = mistakes.clone().in_words(remedy::in_words);
    raised(|module| {
        let edit = |one: &Edit| {
            let file = one.file.display().to_string();
            module.getattr("Edit")?.call1((file, &one.key, &one.old, &one.new))
        };
        let mistake = |one: &Diagnostic| {
            let file = one.file.display().to_string();
            let subject: BTreeMap<&str, &str> =
                one.subject.iter().flat_map(Subject::names).collect();
            let edits: PyResult<Vec<_>> = one.edits.iter().map(edit).collect();
            let (message, help) = (&one.message, &one.help);
            let key = one.key.as_ref().map(ToString::to_string);
            module
                .getattr("Mistake")?
                .call1((file, one.line, one.column, message, help, subject, edits?, key))
        };
        let list: PyResult<Vec<_>> = mistakes.0.iter().map(mistake).collect();
        module.getattr("InputError")?.call1((mistakes.to_string(), list?))
    })
}

fn raised<F>(make: F) -> PyErr
where
    F: for<'py> FnOnce(&Bound<'py, PyModule>) -> PyResult<Bound<'py, PyAny>>,
{
    Python::attach(|py| {
        let made = py.import("drape._errors").and_then(|module| make(&module));
        made.map_or_else(|error| error, PyErr::from_value)
    })
}

/// Warns of what deserves a second look, as a `RunWarning`.
pub(crate) fn warn(py: Python<'_>, note: &str) -> PyResult<()> {
    let category = py.import("drape._errors")?.getattr("RunWarning")?;
    let note = note.trim_start_matches("warning: ").trim_start_matches("note: ");
    let message = CString::new(note.replace('\0', " "))?;
    PyErr::warn(py, &category, &message, 2)
}

/// Returns the exception of one mistake.
pub(crate) fn mistake(one: Diagnostic) -> PyErr {
    input(&one.into())
}

/// Returns the exception of a scene that is refused.
pub(crate) fn of_scene(error: drape::scene::Error) -> PyErr {
    match error {
        drape::scene::Error::Input(mistakes) => input(&mistakes),
        drape::scene::Error::Tangled(tangle) => input(&tangle.mistakes),
        error => failure(Kind::Solver, error),
    }
}

/// Returns the exception of frames that cannot be read or written.
pub(crate) fn of_frames(error: drape::frames::Error) -> PyErr {
    use drape::frames::Error;
    match error {
        Error::Occupied { folder } => failure(
            Kind::Usage,
            format!(
                "{} holds results already; give another folder, or allow it with replace=True",
                folder.display()
            ),
        ),
        Error::LostFrames { path, found, frames } => failure(
            Kind::Output,
            format!(
                "{} has {found} frames, of {frames} that the checkpoint counts; run the scene anew \
                 with replace=True",
                path.display()
            ),
        ),
        error => failure(Kind::Output, error),
    }
}

/// Returns the exception of a simulation that cannot go on.
pub(crate) fn of_dynamics(error: drape::dynamics::Error) -> PyErr {
    use drape::dynamics::Error;
    match error {
        Error::Unfit { reason } => failure(
            Kind::Solver,
            format!(
                "the checkpoint does not fit the scene: {reason}; run the scene anew with \
                 replace=True"
            ),
        ),
        Error::Frames(error) => of_frames(error),
        Error::Checkpoint(error) => of_checkpoint(error),
        Error::Unsuited { reason } => failure(Kind::Usage, reason),
        error => failure(Kind::Solver, error),
    }
}

/// Returns the exception of a checkpoint that cannot be written or read.
fn of_checkpoint(error: drape::checkpoint::Error) -> PyErr {
    use drape::checkpoint::Error;
    match error {
        Error::Write { .. } | Error::Read { .. } | Error::Irregular { .. } => {
            failure(Kind::Output, error)
        }
        error => failure(Kind::Solver, error),
    }
}

/// Returns the exception of a run that cannot begin, go on or be kept, with a remedy in Python.
pub(crate) fn of_run(error: drape::run::Error) -> PyErr {
    use drape::run::Error;
    let message = match error {
        Error::Input(mistakes) => return input(&mistakes),
        Error::Dynamics(error) => return of_dynamics(error),
        Error::Frames(error) => return of_frames(error),
        Error::File(_) | Error::Folder { .. } | Error::LastFrame { .. } | Error::Space { .. } => {
            return failure(Kind::Output, error);
        }
        Error::Damaged { path, reason } => {
            let help = "the file is not as it was written: restore it, or run the scene anew with replace=True";
            return mistake(Diagnostic::new(path, reason).help(help));
        }
        Error::Locked { folder } => format!(
            "another run is writing to {}; wait for its end, or give another folder",
            folder.display()
        ),
        Error::GradedBy { folder } => format!(
            "{} holds the run that grading.run names; give another folder",
            folder.display()
        ),
        Error::Interrupted { folder } => format!(
            "{0} holds a run that was interrupted; go on with drape.resume({0:?}), or begin anew \
             with replace=True",
            folder.display().to_string()
        ),
        Error::End { end, step } => format!("until={end}: a step takes {step} s already"),
        Error::Ended { folder, status } => format!(
            "{}: the run has ended ({status}); go on beyond its end with extend=SECONDS",
            folder.display()
        ),
        Error::Failed { folder, status } => format!(
            "{}: the run has ended ({status}); it would end so again: change its scene, and run it \
             anew with replace=True",
            folder.display()
        ),
        other => other.to_string(),
    };
    failure(Kind::Usage, message)
}
