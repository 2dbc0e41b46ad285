//! Growth of distances: surfaces that start nearer than their distances regain the whole distances.

/// Largest fraction of the nearest pair's distance that becomes its minimum separation in a step.
/// The remainder keeps the force finite, and leaves room to the step filter.
const ROOM: f64 = 0.9;

/// Fraction that counts as the whole, because a sum of equal increments may fall short of 1 by
/// rounding.
const WHOLE: f64 = 1.0 - 1e-9;

/// Growth of the distances of surfaces.
#[derive(Debug, Clone, Copy)]
pub(super) struct Growth {
    /// Fraction of their distances that surfaces kept when the last step was committed, 0 to 1.
    pub(super) fraction: f64,
    /// Energy that growth in the open step adds to the contact, in J.
    pub(super) work: f64,
}

impl Growth {
    /// No growth: surfaces keep all of their distances.
    pub(super) const NONE: Growth = Growth { fraction: 1.0, work: 0.0 };

    /// Returns the fraction of distances after an `increment`.
    pub(super) fn increased(&self, increment: f64) -> f64 {
        let fraction = self.fraction + increment;
        if fraction > WHOLE { 1.0 } else { fraction }
    }

    /// Returns the largest fraction for which the nearest pair has room, or `None` if there is room
    /// for `wanted`. `min_ratio` is the smallest ratio of a distance to its minimum separation at
    /// the fraction `wanted`.
    pub(super) fn limited(&self, wanted: f64, min_ratio: f64) -> Option<f64> {
        let room = ROOM * min_ratio;
        (room < 1.0).then(|| (room * wanted).max(self.fraction))
    }
}
