//! Where mistakes in the keys of a fabric go.

/// Takes the key, the message and the remedy of a mistake.
pub(crate) type Report<'a> = dyn FnMut(&str, &str, &str) + 'a;
