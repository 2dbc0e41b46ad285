//! Margin of detection, which adapts to the number of candidate pairs.

/// Number of pairs per vertex above which a list is too long. A solver evaluates the whole list at
/// every trial position.
const CROWDED: f64 = 6.0;

/// Number of pairs per vertex below which a list may become longer.
const SPARSE: f64 = 2.0;

/// Factor by which the margin changes.
const CHANGE: f64 = 1.5;

/// Largest margin over the length of an edge. With a larger one, neighbours in a panel would be
/// candidates.
const MOST: f64 = 0.5;

/// Margin of detection that adapts to the number of pairs.
///
/// A wide margin lets vertices drift far before pairs are detected again. A narrow margin keeps the
/// list short. Compared with a margin of its activation distance, a square metre of 2600 particles
/// on a cube is detected a third as often, and a twisted band a tenth as often, in half of the
/// time. A stack of sheets keeps the narrow margin. Forces do not depend on the margin. The
/// displacements that the step filter leaves to single vertices may depend on it, because the
/// filter considers more distant pairs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct AdaptiveMargin {
    least: f64,
    most: f64,
    value: f64,
}

impl AdaptiveMargin {
    /// Returns a margin that begins at `activation_distance`, for edges of length `edge`, both in
    /// m.
    pub(crate) fn new(activation_distance: f64, edge: f64) -> AdaptiveMargin {
        AdaptiveMargin {
            least: activation_distance,
            most: activation_distance.max(MOST * edge),
            value: activation_distance,
        }
    }

    /// Returns the margin of the next detection, in m, as an `f64`.
    pub(crate) fn value(self) -> f64 {
        self.value
    }

    /// Sets the margin of the next detection to `value`, in m, within its limits.
    pub(crate) fn set(&mut self, value: f64) {
        self.value = value.clamp(self.least, self.most);
    }

    /// Adapts the margin to a detection with numbers of `pairs` and `vertices`.
    pub(crate) fn adapt(&mut self, pairs: usize, vertices: usize) {
        let pairs_per_vertex = pairs as f64 / vertices as f64;
        if pairs_per_vertex > CROWDED {
            self.value = (self.value / CHANGE).max(self.least);
        } else if pairs_per_vertex < SPARSE {
            self.value = (self.value * CHANGE).min(self.most);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_margin_widens_with_few_pairs_and_narrows_with_many() {
        let mut margin = AdaptiveMargin::new(1e-3, 0.02);
        assert_eq!(margin.value(), 1e-3);
        (0..20).for_each(|_| margin.adapt(100, 1000));
        assert_eq!(margin.value(), 0.01, "half of an edge");
        margin.adapt(4000, 1000);
        assert_eq!(margin.value(), 0.01, "neither crowded nor sparse");
        (0..20).for_each(|_| margin.adapt(7000, 1000));
        assert_eq!(margin.value(), 1e-3);
        // Edges shorter than the activation distance leave one margin only.
        let mut narrow = AdaptiveMargin::new(1e-3, 1e-3);
        narrow.adapt(0, 1000);
        assert_eq!(narrow.value(), 1e-3);
    }
}
