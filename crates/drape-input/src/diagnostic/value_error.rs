//! Value error: why a value is not what is needed, without a place.
//!
//! `unit` and `spelling` find the reasons, and the decoder adds the place.

/// Reason why a value is not what is needed, such as a text that is no unit, with the remedy.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ValueError {
    /// Reason, which quotes the text.
    pub message: String,
    /// Remedy for the user.
    pub help: String,
    /// Text that was probably meant, if it is known.
    pub intended_value: Option<String>,
}
