//! Receiver of mistakes in the keys of a fabric.

/// Function that receives the key, the message and the remedy of a mistake.
pub(crate) type Report<'a> = dyn FnMut(&str, &str, &str) + 'a;
