//! Which particles the yarns of a lattice join, and how much cloth each connector stands for.

use std::collections::BTreeMap;

use crate::Lattice;

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
