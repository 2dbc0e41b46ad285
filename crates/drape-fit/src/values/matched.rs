//! Law made from values, with its deviation from them or with notes on assumptions.

/// Relative deviation of a law's values from the values of the sheet that is reported: a tenth of
/// the scatter of values.
pub(crate) const REPORTED_DEVIATION: f64 = 1e-3;

/// Law from KES values, with the deviation of its values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Matched<L> {
    /// Law with nearly the given values.
    pub law: L,
    /// Relative deviation of the law's values from the given values, a ratio.
    pub deviation: f64,
}

/// Law with notes on assumptions.
pub(crate) struct Noted<L> {
    pub(crate) law: L,
    pub(crate) notes: Vec<String>,
}
