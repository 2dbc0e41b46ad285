//! Error of reading a scene.

use std::path::{Path, PathBuf};

use drape_input::Diagnostics;

use crate::scene::Scene;
use crate::tangle::Tangle;

/// Scene that is refused: its mistakes, with the scene where it could be made in spite of them, so
/// that what is wrong can be shown in it.
#[derive(Debug)]
pub struct Refused {
    /// The mistakes.
    pub error: Error,
    /// The scene; none where a part of it could not be made.
    pub scene: Option<Box<Scene>>,
}

impl From<Error> for Box<Refused> {
    fn from(error: Error) -> Self {
        Self::new(Refused { error, scene: None })
    }
}

impl From<Diagnostics> for Box<Refused> {
    fn from(mistakes: Diagnostics) -> Self {
        Error::from(mistakes).into()
    }
}

impl Refused {
    /// Returns the refusal with mistakes of values: what the implied file at `path` says has no
    /// file and no line.
    pub(crate) fn without_file(mut self: Box<Self>, path: &Path) -> Box<Self> {
        let mistakes = match &mut self.error {
            Error::Input(mistakes) => mistakes,
            Error::Tangled(tangle) => &mut tangle.mistakes,
        };
        for mistake in mistakes.0.iter_mut().filter(|mistake| mistake.file == path) {
            mistake.file = PathBuf::new();
            (mistake.line, mistake.column, mistake.span) = (None, None, None);
            for edit in mistake.edits.iter_mut().filter(|edit| edit.file == path) {
                edit.file = PathBuf::new();
                edit.old = None;
            }
        }
        self
    }

    /// Returns the refusal of a scene that could be made.
    pub(crate) fn with(error: impl Into<Error>, scene: Scene) -> Box<Self> {
        Box::new(Self { error: error.into(), scene: Some(Box::new(scene)) })
    }
}

/// Error of reading a scene.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The scene, or a file that it names, has mistakes: correct them; all that were found are
    /// listed.
    #[error(transparent)]
    Input(#[from] Diagnostics),
    /// Surfaces cross at the start, or are too near: move panels and bodies apart.
    #[error("{}", .0.mistakes)]
    Tangled(Box<Tangle>),
}
