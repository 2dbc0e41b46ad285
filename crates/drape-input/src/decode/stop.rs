//! Reasons why a reading of a text ends.

use std::fmt;

/// Reason why a reading ends before the end of the text.
#[derive(Debug)]
pub(super) enum Stop {
    /// A structure has no value for this key.
    Missing(&'static str),
    /// The structure with this name has no value for the key.
    Needs { structure: &'static str, key: &'static str },
    /// Any other reason, in words.
    Other(String),
}

impl fmt::Display for Stop {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Missing(key) | Self::Needs { key, .. } => write!(f, "{key} is missing"),
            Self::Other(message) => f.write_str(message),
        }
    }
}

impl std::error::Error for Stop {}

impl serde::de::Error for Stop {
    fn custom<T: fmt::Display>(message: T) -> Self {
        Self::Other(message.to_string())
    }

    fn missing_field(key: &'static str) -> Self {
        Self::Missing(key)
    }
}
