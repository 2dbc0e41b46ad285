//! Margin of detection, which follows the number of candidate pairs.

/// Number of pairs for each vertex above which a list is too long: a solver evaluates all of it at
/// every trial position.
const CROWDED: f64 = 6.0;

/// Number of pairs for each vertex below which a list may be longer.
const SPARSE: f64 = 2.0;

/// Factor of a change of the margin.
const CHANGE: f64 = 1.5;

/// Largest margin over the length of an edge. Beyond, neighbours in a panel are candidates.
const MOST: f64 = 0.5;

/// Margin of detection that adapts to the number of pairs.
///
/// A wide one lets vertices drift far before pairs are detected again, and a narrow one keeps the
/// list short. A square metre of 2600 particles on a cube is detected a third as often as with a
/// margin of its activation distance, and a band that is twisted a tenth as often, in half of the
/// time; a stack of sheets keeps the narrow one. The forces do not depend on it; the displacements
/// that the step filter leaves to single vertices may, for it takes farther pairs into account.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct AdaptiveMargin {
    least: f64,
    most: f64,
    value: f64,
}

impl AdaptiveMargin {
    /// Makes a margin that begins at the activation distance, for edges of a length, both in m.
    pub(crate) fn new(activation_distance: f64, edge: f64) -> AdaptiveMargin {
        AdaptiveMargin {
            least: activation_distance,
            most: activation_distance.max(MOST * edge),
            value: activation_distance,
        }
    }

    /// Margin of the next detection, in m.
    pub(crate) fn value(self) -> f64 {
        self.value
    }

    /// Sets the margin of the next detection to one that is told, in m, within its limits.
    pub(crate) fn set(&mut self, value: f64) {
        self.value = value.clamp(self.least, self.most);
    }

    /// Adapts to a detection that found so many pairs of so many vertices.
    pub(crate) fn adapt(&mut self, pairs: usize, vertices: usize) {
        let crowd = pairs as f64 / vertices as f64;
        if crowd > CROWDED {
            self.value = (self.value / CHANGE).max(self.least);
        } else if crowd < SPARSE {
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
