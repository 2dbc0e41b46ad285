//! Connectors of a panel's grid: which particles the yarns join, and the area of each connector.

use std::collections::BTreeMap;

use crate::panel::lattice::Lattice;

/// Segment of a yarn: two neighbouring particles.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Segment {
    pub(crate) ends: [u32; 2],
    /// Area, in m²: half of each cell beside the segment.
    pub(crate) area: f64,
}

/// Triple of a yarn: three consecutive particles.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Triple {
    pub(crate) particles: [u32; 3],
    /// Area, in m².
    pub(crate) area: f64,
}

/// Bending connectors along one direction, with their areas.
#[derive(Debug, Clone)]
pub(crate) struct BendingConnectors {
    pub(crate) triples: Vec<Triple>,
    /// Area of the stencil about each particle, in m², zero where there is none.
    pub(crate) stencil_areas: Vec<f64>,
    /// Whether each particle is the middle of a triple.
    pub(crate) is_middle: Vec<bool>,
    /// Rest curvature that folds add to the triple about each particle, in 1/m, empty without
    /// folds.
    pub(crate) folds: Vec<f64>,
}

/// Returns the segments of `yarns`, the yarns of `lattice` along `direction`.
pub(crate) fn segments(lattice: &Lattice, yarns: &[Vec<u32>], direction: usize) -> Vec<Segment> {
    // Each cell gives the halves beside its two sides along the yarns.
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

    yarns
        .iter()
        .flat_map(|yarn| yarn.windows(2))
        .filter_map(|pair| {
            let ends = [pair[0], pair[1]];
            halves.get(&ends).map(|&area| Segment { ends, area })
        })
        .collect()
}

impl BendingConnectors {
    /// Returns the bending connectors of `lattice` along the warp and along the weft. `areas` holds
    /// the areas of the particles, in m².
    ///
    /// With `stencils`, as in a panel with a rim, a particle that is the middle of no triple has a
    /// stencil. Without, its area goes to a triple inside, as at the ends of a yarn on a grid. With
    /// a rim this would leave the outline too soft, because particles of the outline have
    /// neighbours on one side only: the lowest frequencies of a disc of ten cells fell to a half.
    pub(crate) fn along_yarns(lattice: &Lattice, areas: &[f64], stencils: bool) -> [Self; 2] {
        let mut all = lattice.yarns().map(|yarns| {
            let bending = if stencils {
                Self::with_stencils(&yarns, areas)
            } else {
                Self::from_triples(triples(lattice, &yarns, areas), areas.len())
            };
            (yarns, bending)
        });
        for (direction, (yarns, bending)) in all.iter_mut().enumerate() {
            bending.folds = lattice.fold_curvatures(yarns, direction);
        }
        all.map(|(_, bending)| bending)
    }

    /// Returns the connectors `triples`, without stencils, of a panel with `particle_count`
    /// particles.
    fn from_triples(triples: Vec<Triple>, particle_count: usize) -> Self {
        let mut is_middle = vec![false; particle_count];
        triples.iter().for_each(|triple| is_middle[triple.particles[1] as usize] = true);
        Self { triples, stencil_areas: vec![0.0; particle_count], is_middle, folds: Vec::new() }
    }

    /// Returns the triples of `yarns`, and stencils about all other particles.
    fn with_stencils(yarns: &[Vec<u32>], areas: &[f64]) -> Self {
        let triples = yarns.iter().flat_map(|yarn| yarn.windows(3)).map(|three| Triple {
            particles: [three[0], three[1], three[2]],
            area: areas[three[1] as usize],
        });
        let mut bending = Self::from_triples(triples.collect(), areas.len());
        bending.stencil_areas = bending
            .is_middle
            .iter()
            .zip(areas)
            .map(|(is_middle, area)| if *is_middle { 0.0 } else { *area })
            .collect();
        bending
    }
}

/// Returns the triples of `yarns`, the yarns of `lattice` along one direction. Each triple has the
/// area of its middle particle and of the particles that are the middle of no triple and nearest to
/// it.
pub(crate) fn triples(lattice: &Lattice, yarns: &[Vec<u32>], areas: &[f64]) -> Vec<Triple> {
    let mut triples: Vec<Triple> = Vec::new();
    let mut middle_of = vec![None; areas.len()];
    let windows = yarns.iter().flat_map(|yarn| yarn.windows(3));
    for window in windows {
        middle_of[window[1] as usize] = Some(triples.len());
        let particles = [window[0], window[1], window[2]];
        triples.push(Triple { particles, area: areas[window[1] as usize] });
    }

    // The end of a yarn prefers the triple of its neighbour on the yarn, which lies in the
    // direction of the curvature.
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
            (0..triples.len()).min_by(|&a, &b| {
                let [a, b] = [a, b].map(|index| {
                    let middle = triples[index].particles[1] as usize;
                    squared_distance(lattice.coordinates[middle], lattice.coordinates[particle])
                });
                a.total_cmp(&b)
            })
        };
        if let Some(taker) = along[particle].or_else(nearest) {
            triples[taker].area += area;
        }
    }
    triples
}

/// Returns the squared distance of `a` and `b`, in m².
fn squared_distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2)
}
