//! Law made from values, with its deviation from them or with notes on what was assumed.

/// Relative deviation of a law's values from the sheet's that is reported: a tenth of their
/// scatter.
pub(crate) const REPORTED_DEVIATION: f64 = 1e-3;

/// Law from KES values, with the deviation of its own values from them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Matched<L> {
    /// Law found.
    pub law: L,
    /// Relative deviation of its values from those asked for, a ratio.
    pub deviation: f64,
}

/// Law with notes on what was assumed for it.
pub(crate) struct Noted<L> {
    pub(crate) law: L,
    pub(crate) notes: Vec<String>,
}
