//! Which particles the yarns of a lattice join, and how much cloth each connector stands for.

use std::collections::BTreeMap;

use crate::Lattice;
use crate::rim::Near;

/// Segments of the yarns with their area: half of each cell beside them.
pub(crate) fn segments(
    lattice: &Lattice,
    yarns: &[Vec<u32>],
    direction: usize,
) -> Vec<([u32; 2], f64)> {
    let mut halves = BTreeMap::new();
    for cell in &lattice.cells {
        let [a, b, c, d] = cell.corners;
        let q = cell.quadrants;
        let sides = if direction == 0 {
            [([a, d], q[0] + q[3]), ([b, c], q[1] + q[2])]
        } else {
            [([a, b], q[0] + q[1]), ([d, c], q[3] + q[2])]
        };
        for (ends, area) in sides {
            *halves.entry(ends).or_insert(0.0) += area;
        }
    }
    let pairs = yarns.iter().flat_map(|yarn| yarn.windows(2));
    let segment = |pair: &[u32]| {
        let ends = [pair[0], pair[1]];
        halves.get(&ends).map(|&area| (ends, area))
    };
    pairs.filter_map(segment).collect()
}

/// Bending connectors along one direction, and the area that each stands for.
#[derive(Debug, Clone)]
pub(crate) struct Bending {
    pub(crate) triples: Vec<([u32; 3], f64)>,
    /// Area of the stencil about each particle, nought where there is none.
    pub(crate) at_nodes: Vec<f64>,
    /// Whether a particle is in the middle of a triple.
    pub(crate) is_middle: Vec<bool>,
    /// What folds add to the rest curvature of the triple about each particle, in 1/m; none without folds.
    pub(crate) folded: Vec<f64>,
}

impl Bending {
    /// Bending along the warp and along the weft, of a panel whose particles have the given areas.
    ///
    /// In a panel with a rim, a particle that is in the middle of no triple has a stencil. If those on the outline, which
    /// see their surroundings from one side, gave their area to a neighbour inside, as the ends of a yarn do on a grid,
    /// the outline would be limp: the lowest frequencies of a disc of ten cells fell to a half.
    pub(crate) fn of(lattice: &Lattice, areas: &[f64], near: Option<&Near<'_>>) -> [Self; 2] {
        let mut all = lattice.yarns().map(|yarns| {
            let bending = match near {
                None => Self::of_grid(triples(lattice, &yarns, areas), areas.len()),
                Some(_) => Self::of_rim(&yarns, areas),
            };
            (yarns, bending)
        });
        for (direction, (yarns, bending)) in all.iter_mut().enumerate() {
            bending.folded = lattice.folded((yarns, direction));
        }
        all.map(|(_, bending)| bending)
    }

    fn of_grid(triples: Vec<([u32; 3], f64)>, particles: usize) -> Self {
        let mut is_middle = vec![false; particles];
        triples.iter().for_each(|([_, middle, _], _)| is_middle[*middle as usize] = true);
        Self { triples, at_nodes: vec![0.0; particles], is_middle, folded: Vec::new() }
    }

    fn of_rim(yarns: &[Vec<u32>], areas: &[f64]) -> Self {
        let windows = yarns.iter().flat_map(|yarn| yarn.windows(3));
        let triple = |three: &[u32]| ([three[0], three[1], three[2]], areas[three[1] as usize]);
        let mut bending = Self::of_grid(windows.map(triple).collect(), areas.len());
        let rest = bending.is_middle.iter().zip(areas);
        bending.at_nodes =
            rest.map(|(is_middle, area)| if *is_middle { 0.0 } else { *area }).collect();
        bending
    }
}

/// Triples of the yarns with their area: that of the middle particle, and of particles that are in
/// the middle of no triple, which the nearest one takes over.
pub(crate) fn triples(
    lattice: &Lattice,
    yarns: &[Vec<u32>],
    areas: &[f64],
) -> Vec<([u32; 3], f64)> {
    let mut triples: Vec<([u32; 3], f64)> = Vec::new();
    let mut middle_of = vec![None; areas.len()];
    let windows = yarns.iter().flat_map(|yarn| yarn.windows(3));
    for window in windows {
        middle_of[window[1] as usize] = Some(triples.len());
        triples.push(([window[0], window[1], window[2]], areas[window[1] as usize]));
    }
    // First the neighbour on the same yarn, which lies in the direction of the curvature.
    let mut along = vec![None; areas.len()];
    for yarn in yarns {
        let ends = [(yarn[0], yarn[1]), (yarn[yarn.len() - 1], yarn[yarn.len() - 2])];
        for (end, next) in ends {
            along[end as usize] = middle_of[next as usize];
        }
    }
    for (particle, &area) in areas.iter().enumerate() {
        if middle_of[particle].is_some() {
            continue;
        }
        let nearest = || {
            let [u, v] = lattice.coordinates[particle];
            let distance = |triple: &([u32; 3], f64)| {
                let [x, y] = lattice.coordinates[triple.0[1] as usize];
                (x - u).powi(2) + (y - v).powi(2)
            };
            let by_distance =
                |&a: &usize, &b: &usize| distance(&triples[a]).total_cmp(&distance(&triples[b]));
            (0..triples.len()).min_by(by_distance)
        };
        if let Some(taker) = along[particle].or_else(nearest) {
            triples[taker].1 += area;
        }
    }
    triples
}
