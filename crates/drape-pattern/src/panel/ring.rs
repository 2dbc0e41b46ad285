//! Closed polyline of edges in a row: of an outline or of the hole of a dart.

use crate::edge::Edge;
use crate::polygon::{contains, meeting, meeting_point, self_intersection};

/// Closed polyline of edges in a row.
pub(crate) struct Ring {
    /// Corners, each where a side starts.
    corners: Vec<[f64; 2]>,
    /// Number of the edge that each side belongs to.
    edges: Vec<usize>,
}

/// Two edges, by their numbers, that have a point in common.
pub(crate) struct Meeting {
    pub(crate) edges: [usize; 2],
    /// Approximate point, in m.
    pub(crate) at: [f64; 2],
}

impl Ring {
    /// Returns the ring of `edges`, which are in a row.
    pub(crate) fn new(edges: &[Edge]) -> Self {
        let mut ring = Self { corners: Vec::new(), edges: Vec::new() };
        for (number, edge) in edges.iter().enumerate() {
            let points = edge.polyline();
            ring.edges.extend(std::iter::repeat_n(number, points.len()));
            ring.corners.extend(points);
        }
        ring
    }

    /// Returns where the ring crosses or touches itself.
    pub(crate) fn crossing(&self) -> Option<Meeting> {
        let sides = self_intersection(&self.corners)?;
        let [first, second] = sides.map(|side| self.side(side));
        let at = meeting_point(first, second);
        Some(Meeting { edges: sides.map(|side| self.edges[side]), at })
    }

    /// Returns where the ring crosses or touches `other`, whose edge comes second.
    pub(crate) fn meeting(&self, other: &Self) -> Option<Meeting> {
        let [first, second] = meeting(&self.corners, &other.corners)?;
        let at = meeting_point(self.side(first), other.side(second));
        Some(Meeting { edges: [self.edges[first], other.edges[second]], at })
    }

    /// Returns whether `other`, which this ring does not meet, lies inside.
    pub(crate) fn contains(&self, other: &Self) -> bool {
        other.corners.first().is_some_and(|corner| contains(&self.corners, *corner))
    }

    /// Returns the ends of the side with the number `number`.
    fn side(&self, number: usize) -> [[f64; 2]; 2] {
        [number, number + 1].map(|corner| self.corners[corner % self.corners.len()])
    }
}
