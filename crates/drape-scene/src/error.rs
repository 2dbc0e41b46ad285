//! Error of reading a scene.

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
