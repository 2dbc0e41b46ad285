//! Which nodes of a panel a node of its rim is fitted to.

use crate::Lattice;
use crate::mesh::twice_area;
use crate::rim::fit::NODES;

/// Steps from neighbour to neighbour after which no more nodes are looked for.
const RINGS: usize = 5;

/// The connections of a panel's nodes.
pub(crate) struct Near<'a> {
    lattice: &'a Lattice,
    neighbours: Vec<Vec<u32>>,
    sides: Vec<[u32; 2]>,
}

impl<'a> Near<'a> {
    /// The connections of a panel with a rim, or one that is too narrow for triples.
    pub(crate) fn of(lattice: &'a Lattice) -> Option<Self> {
        let narrow = || lattice.yarns().iter().any(|yarns| yarns.iter().all(|yarn| yarn.len() < 3));
        (!lattice.rim.is_empty() || narrow()).then(|| Self {
            lattice,
            neighbours: lattice.neighbours(),
            sides: lattice.outline(),
        })
    }

    fn place(&self, node: u32) -> [f64; 2] {
        self.lattice.coordinates[node as usize]
    }

    fn distance(&self, a: u32, b: u32) -> f64 {
        let ([x, y], [u, v]) = (self.place(a), self.place(b));
        (u - x).powi(2) + (v - y).powi(2)
    }

    /// Whether the outline lies between two nodes, as at a dart.
    fn parted(&self, from: u32, to: u32) -> bool {
        let (a, b) = (self.place(from), self.place(to));
        let crosses = |&[from, to]: &[u32; 2]| {
            let (c, d) = (self.place(from), self.place(to));
            let apart =
                |k: usize| a[k].max(b[k]) < c[k].min(d[k]) || c[k].max(d[k]) < a[k].min(b[k]);
            !apart(0)
                && !apart(1)
                && twice_area([a, b, c]) * twice_area([a, b, d]) < 0.0
                && twice_area([c, d, a]) * twice_area([c, d, b]) < 0.0
        };
        self.sides.iter().any(crosses)
    }

    /// A node, its neighbours, and the nearest nodes around them, [`NODES`] at most and fewer in the smallest panels.
    pub(crate) fn around(&self, node: u32) -> Vec<u32> {
        let mut near: Vec<(usize, u32)> = vec![(0, node)];
        let mut seen = vec![node];
        let mut front = vec![node];
        for ring in 1..=RINGS {
            let mut next: Vec<u32> =
                front.iter().flat_map(|&node| &self.neighbours[node as usize]).copied().collect();
            next.sort_unstable();
            next.dedup();
            next.retain(|other| !seen.contains(other));
            seen.extend(&next);
            near.extend(
                next.iter().filter(|&&o| ring == 1 || !self.parted(node, o)).map(|&o| (ring, o)),
            );
            // The nearest may be one ring farther than the first that are enough.
            if near.len() > 2 * NODES || next.is_empty() {
                break;
            }
            front = next;
        }
        near.sort_by(|&(ring, a), &(other, b)| {
            let key = |ring: usize, of: u32| (ring.min(2), self.distance(node, of));
            let (one, two) = (key(ring, a), key(other, b));
            one.0.cmp(&two.0).then(one.1.total_cmp(&two.1)).then(a.cmp(&b))
        });
        near.into_iter().map(|(_, node)| node).take(NODES).collect()
    }
}
