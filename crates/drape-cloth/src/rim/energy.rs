//! Potential, commit and stored energy of a rim.

use drape_fabric::{BatchLaw, LANES};

use crate::kernel::energy::add_weighted;
use crate::layout::columns::lanes;
use crate::rim::connectors::{Rim, RimShape};
use crate::rim::memories::{RimMemories, RimMemoriesMut};
use crate::rim::stencils::StencilMeasures;
use crate::rim::triangles::TriangleMeasures;

/// Returns the potential of the connectors of `shape`'s rim within a step, in J.
#[inline(always)]
pub(crate) fn potential(shape: &RimShape<'_>, memories: &RimMemories) -> f64 {
    let RimShape { rim: Rim { triangles, stencils, .. }, panel, .. } = *shape;
    let mut sums = [0.0; LANES];
    for start in triangles.batches() {
        let index = triangles.base + start;
        let measures = TriangleMeasures::new(triangles, start, shape.positions);
        let mut works = [0.0; LANES];
        for (direction, yarns) in panel.yarns.iter().enumerate() {
            let memory = memories.traction[direction].batch(index);
            yarns.traction.add_work(&memory, &measures.strains[direction], &mut works);
        }
        panel.shear.add_work(&memories.shear.batch(index), &measures.sines, &mut works);
        add_weighted(&mut sums, &works, lanes(&triangles.areas, start));
    }

    for start in stencils.batches() {
        let measures = StencilMeasures::new(stencils, start, shape.positions, shape.normals);
        for (direction, yarns) in panel.yarns.iter().enumerate() {
            let memory = memories.bending[direction].batch(stencils.base + start);
            let bending = measures.bending(yarns, direction);
            let mut works = bending.energies();
            let curvatures = bending.curvatures().value;
            yarns.bending.add_friction_work(&memory, &curvatures, &mut works);
            add_weighted(&mut sums, &works, bending.areas);
        }
    }
    sums.iter().sum()
}

/// Advances the `memories` of a rim to the accepted positions and normals of `shape`. Returns the
/// energy dissipated, in J.
#[inline(always)]
pub(crate) fn commit(shape: &RimShape<'_>, mut memories: RimMemoriesMut<'_>) -> f64 {
    let RimShape { rim: Rim { triangles, stencils, .. }, panel, .. } = *shape;
    let mut sums = [0.0; LANES];
    for start in triangles.batches() {
        let measures = TriangleMeasures::new(triangles, start, shape.positions);
        let areas = lanes(&triangles.areas, start);
        for (direction, yarns) in panel.yarns.iter().enumerate() {
            let memories_along = &mut memories.traction[direction];
            let lost = yarns.traction.commit(memories_along, start, &measures.strains[direction]);
            add_weighted(&mut sums, &lost, areas);
        }
        let lost = panel.shear.commit(&mut memories.shear, start, &measures.sines);
        add_weighted(&mut sums, &lost, areas);
    }

    for start in stencils.batches() {
        let measures = StencilMeasures::new(stencils, start, shape.positions, shape.normals);
        for (direction, yarns) in panel.yarns.iter().enumerate() {
            let bending = measures.bending(yarns, direction);
            let memories_along = &mut memories.bending[direction];
            let curvatures = bending.curvatures().value;
            let lost = yarns.bending.commit(memories_along, start, &curvatures);
            add_weighted(&mut sums, &lost, bending.areas);
        }
    }
    sums.iter().sum()
}

/// Writes the `memories` of a rim that starts at the positions of `shape` without friction.
pub(crate) fn start(shape: &RimShape<'_>, memories: &mut RimMemories) {
    let RimShape { rim: Rim { triangles, stencils, .. }, panel, .. } = *shape;
    for start in triangles.batches() {
        let index = triangles.base + start;
        let measures = TriangleMeasures::new(triangles, start, shape.positions);
        for (direction, yarns) in panel.yarns.iter().enumerate() {
            let memories_along = &mut memories.traction[direction];
            yarns.traction.start(memories_along, index, &measures.strains[direction]);
        }
        panel.shear.start(&mut memories.shear, index, &measures.sines);
    }
    for start in stencils.batches() {
        let measures = StencilMeasures::new(stencils, start, shape.positions, shape.normals);
        for (direction, yarns) in panel.yarns.iter().enumerate() {
            let curvatures = measures.bending(yarns, direction).curvatures().value;
            let memories_along = &mut memories.bending[direction];
            yarns.bending.start(memories_along, stencils.base + start, &curvatures);
        }
    }
}

/// Returns the energy that the connectors of `shape`'s rim can return, in J.
pub(crate) fn stored(shape: &RimShape<'_>, memories: &RimMemories) -> f64 {
    let RimShape { rim: Rim { triangles, stencils, .. }, panel, .. } = *shape;
    let mut sums = [0.0; LANES];
    for start in triangles.batches() {
        let index = triangles.base + start;
        let mut energies = [0.0; LANES];
        for (direction, yarns) in panel.yarns.iter().enumerate() {
            yarns.traction.add_stored(&memories.traction[direction].batch(index), &mut energies);
        }
        panel.shear.add_stored(&memories.shear.batch(index), &mut energies);
        add_weighted(&mut sums, &energies, lanes(&triangles.areas, start));
    }

    for start in stencils.batches() {
        let measures = StencilMeasures::new(stencils, start, shape.positions, shape.normals);
        for (direction, yarns) in panel.yarns.iter().enumerate() {
            let memory = memories.bending[direction].batch(stencils.base + start);
            let bending = measures.bending(yarns, direction);
            let mut energies = bending.energies();
            yarns.bending.add_friction_stored(&memory, &mut energies);
            add_weighted(&mut sums, &energies, bending.areas);
        }
    }
    sums.iter().sum()
}
