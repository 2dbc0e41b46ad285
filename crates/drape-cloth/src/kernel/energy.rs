//! Potential, commit and stored energy of a strip. Each connector of the strip's points is counted
//! once: `$E = \sum_c W_c\,w_c(s_c)$` with the work per area `$w$` of its law.
#![allow(clippy::needless_range_loop, reason = "a lane indexes several arrays")]

use drape_fabric::{BatchLaw, LANES, Lanes};

use crate::kernel::buffers::{StripBuffers, StripTrial};
use crate::kernel::memories::{GridMemories, GridMemoriesMut};
use crate::layout::columns::{VectorColumns, is_vacant, lanes};
use crate::layout::grid::GridPanel;
use crate::layout::strip::Strip;

/// A strip at accepted positions, with the normals there, and its memories to write.
pub(crate) struct StripCommit<'a> {
    pub(crate) panel: &'a GridPanel,
    pub(crate) strip: &'a Strip,
    pub(crate) memories: GridMemoriesMut<'a>,
    pub(crate) normals: &'a VectorColumns,
    pub(crate) positions: &'a [f64],
}

/// A strip at given positions.
#[derive(Clone, Copy)]
pub(crate) struct StripShape<'a> {
    pub(crate) panel: &'a GridPanel,
    pub(crate) strip: &'a Strip,
    pub(crate) positions: &'a [f64],
}

/// Returns the potential of the connectors of `trial`'s strip within a step, in J.
#[inline(always)]
pub(crate) fn potential(buffers: &mut StripBuffers, trial: &StripTrial<'_>) -> f64 {
    let StripTrial { panel, memories, strip, positions } = *trial;
    buffers.load(panel, strip, positions);
    let mut sums = [0.0; LANES];
    for start in batches_with_connectors(panel, strip) {
        let at = strip.batch(start);
        for (direction, yarns) in panel.yarns.iter().enumerate() {
            let memory = memories.traction[direction].batch(at.cloth);
            let strains = buffers.strains(yarns, direction, at);
            let mut works = [0.0; LANES];
            yarns.traction.add_work(&memory, &strains, &mut works);
            add_weighted(&mut sums, &works, lanes(&yarns.segment_areas, at.panel));

            let memory = memories.bending[direction].batch(at.cloth);
            let triples = buffers.triples(yarns, &memories.normals, at);
            let mut works = triples.energies();
            let curvatures = triples.curvatures().value;
            yarns.bending.add_friction_work(&memory, &curvatures, &mut works);
            add_weighted(&mut sums, &works, lanes(&yarns.triple_areas, at.panel));
        }
        // Shear at the four corners of each cell.
        for (corner, areas) in panel.corner_areas.iter().enumerate() {
            let memory = memories.shear[corner].batch(at.cloth);
            let sines = buffers.sines(panel, corner, at);
            let mut works = [0.0; LANES];
            panel.shear.add_work(&memory, &sines, &mut works);
            add_weighted(&mut sums, &works, lanes(areas, at.panel));
        }
    }
    sums.iter().sum()
}

/// Advances the memories of a strip to the accepted positions in `commit`. Returns the energy
/// dissipated, in J.
#[inline(always)]
pub(crate) fn commit(buffers: &mut StripBuffers, commit: StripCommit<'_>) -> f64 {
    let StripCommit { panel, strip, mut memories, normals, positions } = commit;
    buffers.load(panel, strip, positions);
    let mut sums = [0.0; LANES];
    for start in batches_with_connectors(panel, strip) {
        let at = strip.batch(start);
        let index = start - panel.margin;
        for (direction, yarns) in panel.yarns.iter().enumerate() {
            let strains = buffers.strains(yarns, direction, at);
            let memories_along = &mut memories.traction[direction];
            let lost = yarns.traction.commit(memories_along, index, &strains);
            add_weighted(&mut sums, &lost, lanes(&yarns.segment_areas, at.panel));

            let curvatures = buffers.triples(yarns, normals, at).curvatures().value;
            let memories_along = &mut memories.bending[direction];
            let lost = yarns.bending.commit(memories_along, index, &curvatures);
            add_weighted(&mut sums, &lost, lanes(&yarns.triple_areas, at.panel));
        }
        // Shear at the four corners of each cell.
        for (corner, areas) in panel.corner_areas.iter().enumerate() {
            let sines = buffers.sines(panel, corner, at);
            let lost = panel.shear.commit(&mut memories.shear[corner], index, &sines);
            add_weighted(&mut sums, &lost, lanes(areas, at.panel));
        }
    }
    sums.iter().sum()
}

/// Writes the `memories` of the strip `shape`, which starts at its positions without friction.
#[inline(always)]
pub(crate) fn start(
    buffers: &mut StripBuffers,
    shape: StripShape<'_>,
    memories: &mut GridMemories,
) {
    let StripShape { panel, strip, positions } = shape;
    buffers.load(panel, strip, positions);
    for start in batches_with_connectors(panel, strip) {
        let at = strip.batch(start);
        for (direction, yarns) in panel.yarns.iter().enumerate() {
            let strains = buffers.strains(yarns, direction, at);
            yarns.traction.start(&mut memories.traction[direction], at.cloth, &strains);
            let curvatures = buffers.triples(yarns, &memories.normals, at).curvatures().value;
            yarns.bending.start(&mut memories.bending[direction], at.cloth, &curvatures);
        }
        for (corner, corner_memories) in memories.shear.iter_mut().enumerate() {
            let sines = buffers.sines(panel, corner, at);
            panel.shear.start(corner_memories, at.cloth, &sines);
        }
    }
}

/// Returns the energy that the connectors of `trial`'s strip can return, in J.
pub(crate) fn stored(buffers: &mut StripBuffers, trial: &StripTrial<'_>) -> f64 {
    let StripTrial { panel, memories, strip, positions } = *trial;
    buffers.load(panel, strip, positions);
    let mut sums = [0.0; LANES];
    for start in batches_with_connectors(panel, strip) {
        let at = strip.batch(start);
        for (direction, yarns) in panel.yarns.iter().enumerate() {
            let mut energies = [0.0; LANES];
            let memory = memories.traction[direction].batch(at.cloth);
            yarns.traction.add_stored(&memory, &mut energies);
            add_weighted(&mut sums, &energies, lanes(&yarns.segment_areas, at.panel));

            let mut energies = buffers.triples(yarns, &memories.normals, at).energies();
            let memory = memories.bending[direction].batch(at.cloth);
            yarns.bending.add_friction_stored(&memory, &mut energies);
            add_weighted(&mut sums, &energies, lanes(&yarns.triple_areas, at.panel));
        }
        // Shear at the four corners of each cell.
        for (corner, areas) in panel.corner_areas.iter().enumerate() {
            let mut energies = [0.0; LANES];
            let memory = memories.shear[corner].batch(at.cloth);
            panel.shear.add_stored(&memory, &mut energies);
            add_weighted(&mut sums, &energies, lanes(areas, at.panel));
        }
    }
    sums.iter().sum()
}

/// Returns the first indices, in the buffers, of the batches of the points of `strip` that have a
/// connector.
fn batches_with_connectors<'a>(
    panel: &'a GridPanel,
    strip: &'a Strip,
) -> impl Iterator<Item = usize> + 'a {
    let batches = (panel.margin..panel.margin + strip.points.len()).step_by(LANES);
    batches.filter(|&start| {
        let along_yarns =
            panel.yarns.iter().flat_map(|yarns| [&yarns.segment_areas, &yarns.triple_areas]);
        let mut areas = along_yarns.chain(&panel.corner_areas);
        areas.any(|column| !is_vacant(lanes(column, strip.batch(start).panel)))
    })
}

/// Adds `energies` per area times `areas` to `sums`.
#[inline(always)]
pub(crate) fn add_weighted(sums: &mut Lanes, energies: &Lanes, areas: &Lanes) {
    for lane in 0..LANES {
        sums[lane] += energies[lane] * areas[lane];
    }
}
