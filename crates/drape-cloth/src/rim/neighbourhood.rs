//! Neighbourhoods of the nodes of a rim: the nodes to which a stencil is fitted.

use crate::panel::lattice::Lattice;
use crate::panel::triangle::twice_area;
use crate::rim::quadratic_fit::NODES;

/// Largest number of rings of neighbours that are searched.
const RINGS: usize = 5;

/// Connections of the nodes of a panel.
pub(crate) struct Neighbourhoods<'a> {
    lattice: &'a Lattice,
    neighbours: Vec<Vec<u32>>,
    sides: Vec<[u32; 2]>,
}

impl<'a> Neighbourhoods<'a> {
    /// Returns the connections of `lattice` if it has a rim or is too narrow for triples, else
    /// `None`, because other panels have no stencils.
    pub(crate) fn new(lattice: &'a Lattice) -> Option<Self> {
        let is_narrow = lattice.yarns().iter().any(|yarns| yarns.iter().all(|yarn| yarn.len() < 3));
        (!lattice.rim.is_empty() || is_narrow).then(|| Self {
            lattice,
            neighbours: lattice.neighbours(),
            sides: lattice.outline().into_iter().collect(),
        })
    }

    fn coordinates(&self, node: u32) -> [f64; 2] {
        self.lattice.coordinates[node as usize]
    }

    fn squared_distance(&self, a: u32, b: u32) -> f64 {
        let ([x, y], [u, v]) = (self.coordinates(a), self.coordinates(b));
        (u - x).powi(2) + (v - y).powi(2)
    }

    /// Returns whether the outline lies between the nodes `from` and `to`, as at a dart.
    fn parted(&self, from: u32, to: u32) -> bool {
        let (a, b) = (self.coordinates(from), self.coordinates(to));
        self.sides.iter().any(|side| {
            let [c, d] = side.map(|node| self.coordinates(node));
            // Bounding boxes that do not overlap settle most sides.
            let apart = [0, 1]
                .into_iter()
                .any(|k: usize| a[k].max(b[k]) < c[k].min(d[k]) || c[k].max(d[k]) < a[k].min(b[k]));
            !apart
                && twice_area([a, b, c]) * twice_area([a, b, d]) < 0.0
                && twice_area([c, d, a]) * twice_area([c, d, b]) < 0.0
        })
    }

    /// Returns `node`, its neighbours, and the nearest nodes around them: at most [`NODES`], fewer
    /// in the smallest panels.
    pub(crate) fn around(&self, node: u32) -> Vec<u32> {
        // Nodes with their ring and their squared distance.
        let mut candidates: Vec<(usize, f64, u32)> =
            vec![(0, self.squared_distance(node, node), node)];
        let mut seen = vec![node];
        let mut front = vec![node];
        for ring in 1..=RINGS {
            let mut next: Vec<u32> =
                front.iter().flat_map(|&node| &self.neighbours[node as usize]).copied().collect();
            next.sort_unstable();
            next.dedup();
            next.retain(|candidate| !seen.contains(candidate));
            seen.extend(&next);
            let visible = next.iter().filter(|&&other| ring == 1 || !self.parted(node, other));
            candidates
                .extend(visible.map(|&other| (ring, self.squared_distance(node, other), other)));

            // The nearest nodes may be one ring farther than the first ring that gives enough.
            if candidates.len() > 2 * NODES || next.is_empty() {
                break;
            }
            front = next;
        }

        // Neighbours come before all other nodes, which are ordered by distance.
        candidates.sort_by(|(ring_a, distance_a, a), (ring_b, distance_b, b)| {
            let by_ring = (*ring_a).min(2).cmp(&(*ring_b).min(2));
            by_ring.then(distance_a.total_cmp(distance_b)).then(a.cmp(b))
        });
        candidates.into_iter().map(|(_, _, node)| node).take(NODES).collect()
    }
}
