//! Connectors of the triangles between the full cells of a panel and its outline.

mod bow;
mod energy;
mod fit;
mod force;
mod near;
mod stiffness;
mod strain;

use std::ops::Range;

use drape_fabric::LANES;

use crate::connectors::Bending;
use crate::field::{Columns, Vector};
use crate::mesh::twice_area;
use crate::panel::{NO_BLOCK, Panel};
use crate::rim::fit::Fit;
use crate::state::History;
use crate::{Cloth, Lattice, Sparsity, State};

pub(crate) use energy::{Course, commit, potential, start, stored};
pub(crate) use force::add_forces;
pub(crate) use near::Near;
pub(crate) use stiffness::add_stiffness;

/// The rim of a panel: traction and shear of its triangles, and bending where no triple of the lattice has its middle.
///
/// Places count over the rims of the cloth, each filled up to a whole number of batches with connectors of no area.
#[derive(Debug, Clone)]
pub(crate) struct Rim {
    /// Place among the rims of the cloth.
    pub(crate) index: usize,
    /// Panel that it is part of.
    pub(crate) panel: usize,
    /// Particles of the panel, counted over the cloth.
    pub(crate) particles: Range<usize>,
    /// Blocks in the rows of the particles.
    pub(crate) blocks: Range<usize>,
    pub(crate) triangles: Triangles,
    pub(crate) stencils: Stencils,
    /// How the surface lies at the nodes that are not in the middle of a triple along both yarns.
    pub(crate) slopes: Vec<Slopes>,
}

/// The triangles of a rim, side by side.
#[derive(Debug, Clone)]
pub(crate) struct Triangles {
    /// Particles in rising order.
    pub(crate) corners: Vec<[u32; 3]>,
    /// How the derivative along the weft, then along the warp, follows from the ways from the first corner to the second
    /// and to the third, in 1/m.
    gradients: Columns<4>,
    pub(crate) areas: Vec<f64>,
    /// Blocks of the corners 00, 01, 02, 11, 12, 22.
    slots: Vec<[u32; 6]>,
    /// How many there are.
    pub(crate) count: usize,
    /// Place of the first.
    pub(crate) base: usize,
}

/// Fits to the neighbourhoods of nodes, side by side: curvatures along both yarns.
#[derive(Debug, Clone)]
pub(crate) struct Stencils {
    /// Particle whose neighbourhood it is.
    pub(crate) middles: Vec<u32>,
    /// Their parts, one stencil after the other, and where those of each begin.
    parts: Vec<Part>,
    offsets: Vec<usize>,
    /// Areas along the warp and along the weft.
    pub(crate) areas: [Vec<f64>; 2],
    /// What folds add to the rest curvatures along the warp and along the weft, in 1/m; none without folds.
    pub(crate) folds: [Vec<f64>; 2],
    /// Blocks of the parts 00, 01, …, 11, 12, … of one stencil after the other, and where those of each begin.
    slots: Vec<u32>,
    slot_offsets: Vec<usize>,
    /// How many there are.
    pub(crate) count: usize,
    /// Place of the first.
    pub(crate) base: usize,
}

/// Derivatives along the warp and along the weft at a particle.
#[derive(Debug, Clone)]
pub(crate) struct Slopes {
    pub(crate) particle: u32,
    nodes: Vec<u32>,
    weights: [Vec<f64>; 2],
}

/// A node of a fit.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Part {
    pub(crate) node: u32,
    /// Weights in the second derivatives along the warp and along the weft, in 1/m².
    pub(crate) weights: [f64; 2],
}

/// The curvatures of a fit, as connectors have them.
#[derive(Debug, Clone)]
pub(crate) struct Stencil {
    pub(crate) middle: u32,
    /// In rising order of the nodes.
    pub(crate) parts: Vec<Part>,
    /// Along the warp and along the weft, in m².
    pub(crate) areas: [f64; 2],
    /// What folds add to the rest curvatures, likewise, in 1/m.
    pub(crate) folds: [f64; 2],
}

/// The fits of a panel, its particles numbered from nought: stencils with an area, and slopes.
pub(crate) fn fits(
    lattice: &Lattice,
    near: &Near<'_>,
    bending: &[Bending; 2],
) -> (Vec<Stencil>, Vec<Slopes>) {
    let spacing = (lattice.spacing[0] * lattice.spacing[1]).sqrt();
    let (mut stencils, mut slopes) = (Vec::new(), Vec::new());
    for middle in 0..lattice.coordinates.len() as u32 {
        let at = middle as usize;
        if bending.iter().all(|direction| direction.is_middle[at]) {
            continue;
        }
        let mut nodes = near.around(middle);
        let places: Vec<_> = nodes.iter().map(|&node| lattice.coordinates[node as usize]).collect();
        let fit = Fit::new(&places, spacing);
        nodes.truncate(fit.slopes[0].len());
        let areas = [0, 1].map(|direction| bending[direction].at_nodes[at]);
        if areas.iter().any(|&area| area > 0.0) {
            let [weft, warp] = &fit.bends;
            let weights = warp.iter().zip(weft).map(|(&warp, &weft)| [warp, weft]);
            let parts = nodes.iter().zip(weights);
            let mut parts: Vec<Part> =
                parts.map(|(&node, weights)| Part { node, weights }).collect();
            parts.sort_by_key(|part| part.node);
            let folds = [0, 1].map(|direction| {
                let weights = parts
                    .iter()
                    .map(|part| (lattice.coordinates[part.node as usize], part.weights[direction]));
                let along = (direction, lattice.spacing);
                let folds = lattice.folds.iter();
                folds.map(|fold| fold.curvature(weights.clone(), places[0], along)).sum()
            });
            stencils.push(Stencil { middle, parts, areas, folds });
        }
        let [weft, warp] = fit.slopes;
        slopes.push(Slopes { particle: middle, nodes, weights: [warp, weft] });
    }
    (stencils, slopes)
}

impl Rim {
    /// The rim of a panel whose particles are numbered from `first` on; `bases` are the places of its first triangle and
    /// its first stencil.
    pub(crate) fn new(
        (lattice, first): (&Lattice, u32),
        bending: &[Bending; 2],
        near: &Near<'_>,
        [triangles, stencils]: [usize; 2],
    ) -> Self {
        let (fits, mut slopes) = fits(lattice, near, bending);
        for slopes in &mut slopes {
            slopes.particle += first;
            slopes.nodes.iter_mut().for_each(|node| *node += first);
        }
        let particles = first as usize..first as usize + lattice.coordinates.len();
        Self {
            index: 0,
            panel: 0,
            particles,
            blocks: 0..0,
            triangles: Triangles::new(lattice, first, triangles),
            stencils: Stencils::new(&fits, first, stencils),
            slopes,
        }
    }

    /// Places after its last triangle and its last stencil.
    pub(crate) fn end(&self) -> [usize; 2] {
        let Self { triangles, stencils, .. } = self;
        [triangles.base + triangles.areas.len(), stencils.base + stencils.middles.len()]
    }

    /// Looks up the places of its blocks.
    pub(crate) fn connect(&mut self, sparsity: &Sparsity) {
        self.blocks = sparsity.offsets[self.particles.start]..sparsity.offsets[self.particles.end];
        let slot = |row: u32, column: u32| {
            sparsity.block(row, column).map_or(NO_BLOCK, |block| block as u32)
        };
        let three = |&[a, b, c]: &[u32; 3]| {
            [(a, a), (a, b), (a, c), (b, b), (b, c), (c, c)].map(|(row, column)| slot(row, column))
        };
        self.triangles.slots = self.triangles.corners.iter().map(three).collect();
        let mut slots = Vec::new();
        self.stencils.slot_offsets = vec![0];
        for place in 0..self.stencils.count {
            slots.extend(pairs(self.stencils.parts(place)).map(|(row, column)| slot(row, column)));
            self.stencils.slot_offsets.push(slots.len());
        }
        self.stencils.slots = slots;
    }

    /// Pairs of particles that a connector joins, the first of each less than the second.
    pub(crate) fn pairs(&self) -> impl Iterator<Item = (u32, u32)> {
        let sides = |&[a, b, c]: &[u32; 3]| [(a, b), (a, c), (b, c)];
        let triangles = self.triangles.corners.iter().flat_map(sides);
        let stencils = (0..self.stencils.count).map(|place| self.stencils.parts(place));
        triangles.chain(stencils.flat_map(pairs)).filter(|(row, column)| row < column)
    }
}

/// Pairs of a stencil's nodes, each with itself and those after it.
fn pairs(parts: &[Part]) -> impl Iterator<Item = (u32, u32)> {
    let with = |(k, part): (usize, &Part)| {
        let row = part.node;
        parts[k..].iter().map(move |other| (row, other.node))
    };
    parts.iter().enumerate().flat_map(with)
}

impl Triangles {
    fn new(lattice: &Lattice, first: u32, base: usize) -> Self {
        let count = lattice.rim.len();
        let length = count.next_multiple_of(LANES);
        let mut gradients = Columns::new(length);
        let mut corners: Vec<[u32; 3]> = lattice.rim.clone();
        corners.iter_mut().for_each(|triangle| triangle.sort_unstable());
        corners.resize(length, corners.last().copied().unwrap_or_default());
        for (place, triangle) in corners.iter_mut().enumerate() {
            let [a, b, c] = triangle.map(|node| lattice.coordinates[node as usize]);
            let inverse = 1.0 / twice_area([a, b, c]);
            let [b, c] = [b, c].map(|end| [0, 1].map(|k| (end[k] - a[k]) * inverse));
            gradients.set(place, [c[1], -b[1], -c[0], b[0]]);
            *triangle = triangle.map(|node| first + node);
        }
        let mut areas: Vec<f64> = lattice.rim_areas().collect();
        areas.resize(length, 0.0);
        Self { corners, gradients, areas, slots: Vec::new(), count, base }
    }
}

impl Stencils {
    fn new(fits: &[Stencil], first: u32, base: usize) -> Self {
        let count = fits.len();
        let length = count.next_multiple_of(LANES);
        let mut middles: Vec<u32> = fits.iter().map(|fit| first + fit.middle).collect();
        middles.resize(length, first);
        let (mut parts, mut offsets) = (Vec::new(), vec![0]);
        for fit in fits {
            parts.extend(fit.parts.iter().map(|part| Part { node: first + part.node, ..*part }));
            offsets.push(parts.len());
        }
        offsets.resize(length + 1, parts.len());
        let areas = [0, 1].map(|direction| {
            let mut areas: Vec<f64> = fits.iter().map(|fit| fit.areas[direction]).collect();
            areas.resize(length, 0.0);
            areas
        });
        let is_folded = fits.iter().any(|fit| fit.folds != [0.0; 2]);
        let folds = [0, 1].map(|direction| {
            let folds = fits.iter().map(|fit| fit.folds[direction]);
            let mut folds: Vec<f64> = folds.filter(|_| is_folded).collect();
            folds.resize(if is_folded { length } else { 0 }, 0.0);
            folds
        });
        let (slots, slot_offsets) = (Vec::new(), Vec::new());
        Self { middles, parts, offsets, areas, folds, slots, slot_offsets, count, base }
    }

    /// The parts of a stencil.
    #[inline(always)]
    pub(crate) fn parts(&self, place: usize) -> &[Part] {
        &self.parts[self.offsets[place]..self.offsets[place + 1]]
    }
}

impl Slopes {
    /// Derivatives along the warp and along the weft of positions.
    pub(crate) fn at(&self, positions: &[f64]) -> [Vector; 2] {
        self.weights.each_ref().map(|weights| {
            let mut sum = [0.0; 3];
            for (&node, weight) in self.nodes.iter().zip(weights) {
                let position = &positions[3 * node as usize..][..3];
                sum.iter_mut().zip(position).for_each(|(sum, x)| *sum += weight * x);
            }
            sum
        })
    }
}

/// A rim, its state, and the trial that is evaluated.
#[derive(Clone, Copy)]
pub(crate) struct RimTrial<'a> {
    pub(crate) rim: &'a Rim,
    pub(crate) panel: &'a Panel,
    pub(crate) history: &'a History,
    /// Unit normals at the start of the step, three numbers for each particle.
    pub(crate) normals: &'a [f64],
    pub(crate) positions: &'a [f64],
}

impl<'a> RimTrial<'a> {
    pub(crate) fn new(
        cloth: &'a Cloth,
        state: &'a State,
        (rim, positions): (&'a Rim, &'a [f64]),
    ) -> Self {
        let panel = &cloth.panels[rim.panel];
        Self { rim, panel, history: &state.history, normals: &state.normals, positions }
    }
}
