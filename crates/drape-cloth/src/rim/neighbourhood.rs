//! Neighbourhoods of the nodes of a rim: the nodes that a stencil is fitted to.

use crate::panel::lattice::Lattice;
use crate::panel::triangle::twice_area;
use crate::rim::quadratic_fit::NODES;

/// Number of rings of neighbours that are searched at most.
const RINGS: usize = 5;

/// Connections of the nodes of a panel.
pub(crate) struct Neighbourhoods<'a> {
    lattice: &'a Lattice,
    neighbours: Vec<Vec<u32>>,
    sides: Vec<[u32; 2]>,
}

impl<'a> Neighbourhoods<'a> {
    /// Returns the connections of a panel with a rim, or of one that is too narrow for triples;
    /// nothing for other panels, which have no stencils.
    pub(crate) fn of(lattice: &'a Lattice) -> Option<Self> {
        let narrow = || lattice.yarns().iter().any(|yarns| yarns.iter().all(|yarn| yarn.len() < 3));
        (!lattice.rim.is_empty() || narrow()).then(|| Self {
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

    /// Returns whether the outline lies between two nodes, as at a dart.
    fn parted(&self, from: u32, to: u32) -> bool {
        let (a, b) = (self.coordinates(from), self.coordinates(to));
        let crosses = |&[from, to]: &[u32; 2]| {
            let (c, d) = (self.coordinates(from), self.coordinates(to));
            let apart =
                |k: usize| a[k].max(b[k]) < c[k].min(d[k]) || c[k].max(d[k]) < a[k].min(b[k]);
            !apart(0)
                && !apart(1)
                && twice_area([a, b, c]) * twice_area([a, b, d]) < 0.0
                && twice_area([c, d, a]) * twice_area([c, d, b]) < 0.0
        };
        self.sides.iter().any(crosses)
    }

    /// Returns a node, its neighbours, and the nearest nodes around them: [`NODES`] at most, fewer
    /// in the smallest panels.
    pub(crate) fn around(&self, node: u32) -> Vec<u32> {
        let mut found: Vec<(usize, u32)> = vec![(0, node)];
        let mut seen = vec![node];
        let mut front = vec![node];
        for ring in 1..=RINGS {
            let mut next: Vec<u32> =
                front.iter().flat_map(|&node| &self.neighbours[node as usize]).copied().collect();
            next.sort_unstable();
            next.dedup();
            next.retain(|other| !seen.contains(other));
            seen.extend(&next);
            found.extend(
                next.iter().filter(|&&o| ring == 1 || !self.parted(node, o)).map(|&o| (ring, o)),
            );
            // The nearest nodes may be one ring farther than the first ring that gives enough.
            if found.len() > 2 * NODES || next.is_empty() {
                break;
            }
            front = next;
        }
        found.sort_by(|&(ring, a), &(other, b)| {
            let key = |ring: usize, of: u32| (ring.min(2), self.squared_distance(node, of));
            let (one, two) = (key(ring, a), key(other, b));
            one.0.cmp(&two.0).then(one.1.total_cmp(&two.1)).then(a.cmp(&b))
        });
        found.into_iter().map(|(_, node)| node).take(NODES).collect()
    }
}
