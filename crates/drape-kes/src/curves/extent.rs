//! Extent: smallest and largest number of a column of a curve.

/// Lowest and highest value of a column.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// Lowest value.
    pub low: f64,
    /// Highest value.
    pub high: f64,
}

impl Extent {
    /// Returns the extent of `values`; from infinity to minus infinity for no value.
    pub(crate) fn from_values(values: &[f64]) -> Self {
        let empty = Self { low: f64::INFINITY, high: f64::NEG_INFINITY };
        values.iter().fold(empty, |e, &v| Self { low: e.low.min(v), high: e.high.max(v) })
    }

    /// Returns the difference of `high` and `low`.
    #[must_use]
    pub fn span(self) -> f64 {
        self.high - self.low
    }
}
