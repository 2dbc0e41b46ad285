//! How much farther than they push pairs are looked for.

/// CandidatePairs for each vertex above which a list is too long: a solver goes through all of it at every place that it tries.
const CROWDED: f64 = 6.0;

/// CandidatePairs for each vertex below which a list has room for more.
const SPARSE: f64 = 2.0;

/// Change of the margin at a time.
const CHANGE: f64 = 1.5;

/// Largest margin over the length of an edge. Beyond, neighbours in a panel are near each other.
const MOST: f64 = 0.5;

/// The margin of a detection, in m, which follows how crowded the surfaces are.
///
/// A wide one lets vertices go far before pairs are to be found again, and a narrow one keeps the list short. A square
/// metre of 2600 particles on a cube is detected a third as often as with a margin of its activation_distance, and a band that is twisted
/// a tenth as often, in half of the time; a stack of sheets keeps the narrow one. The forces do not depend on it; how far
/// vertices go that are stopped one by one may, for pairs farther off are then heeded too.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Margin {
    least: f64,
    most: f64,
    value: f64,
}

impl Margin {
    /// A margin that begins at the distance at which surfaces push, for edges of some length, both in m.
    pub(crate) fn new(activation_distance: f64, edge: f64) -> Margin {
        Margin {
            least: activation_distance,
            most: activation_distance.max(MOST * edge),
            value: activation_distance,
        }
    }

    /// The margin of the next detection, in m.
    pub(crate) fn value(self) -> f64 {
        self.value
    }

    /// Learns from a detection that found so many pairs of so many vertices.
    pub(crate) fn follow(&mut self, pairs: usize, vertices: usize) {
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
    fn a_margin_widens_in_the_open_and_narrows_in_a_crowd() {
        let mut margin = Margin::new(1e-3, 0.02);
        assert_eq!(margin.value(), 1e-3);
        (0..20).for_each(|_| margin.follow(100, 1000));
        assert_eq!(margin.value(), 0.01, "half of an edge");
        margin.follow(4000, 1000);
        assert_eq!(margin.value(), 0.01, "neither crowded nor sparse");
        (0..20).for_each(|_| margin.follow(7000, 1000));
        assert_eq!(margin.value(), 1e-3);
        // Edges shorter than the activation_distance: there is nothing to choose.
        let mut narrow = Margin::new(1e-3, 1e-3);
        narrow.follow(0, 1000);
        assert_eq!(narrow.value(), 1e-3);
    }
}
