//! Forces of a rim: of its triangles, then of its stencils.
#![allow(clippy::needless_range_loop, reason = "a lane indexes several arrays")]

use drape_fabric::{BatchLaw, LANES, Responses};

use crate::layout::columns::{VectorLanes, lanes};
use crate::measure::vector::{Vector, add, scale, subtract};
use crate::rim::connectors::RimShape;
use crate::rim::memories::RimMemories;
use crate::rim::stencils::StencilMeasures;
use crate::rim::triangles::TriangleMeasures;

/// Adds the forces of `shape`'s rim on the particles of its panel to `forces`, in N, three numbers
/// each.
#[inline(always)]
pub(crate) fn add_forces(shape: &RimShape<'_>, memories: &RimMemories, forces: &mut [f64]) {
    add_triangle_forces(shape, memories, forces);
    add_stencil_forces(shape, memories, forces);
}

/// Adds `force` to the force on `particle` in `forces`, which begin at the particle `first`.
#[inline(always)]
fn add_force(forces: &mut [f64], first: usize, particle: u32, force: Vector) {
    let start = 3 * (particle as usize - first);
    forces[start..start + 3].iter_mut().zip(force).for_each(|(sum, f)| *sum += f);
}

/// Adds the forces of the triangles of `shape`'s rim to `forces`.
#[inline(always)]
fn add_triangle_forces(shape: &RimShape<'_>, memories: &RimMemories, forces: &mut [f64]) {
    let first = shape.rim.particles.start;
    let triangles = &shape.rim.triangles;
    for start in triangles.batches() {
        let derivatives = gradient_derivatives(shape, memories, start);
        let gradients = triangles.gradients.batch(start);
        let count = LANES.min(triangles.count - start);
        for (lane, &[a, b, c]) in triangles.corners[start..start + count].iter().enumerate() {
            let [warp, weft] = [0, 1].map(|direction| derivatives[direction].vector(lane));
            let [u1, u2, v1, v2] = gradients.0.map(|column| -column[lane]);
            let second = add(scale(warp, v1), scale(weft, u1));
            let third = add(scale(warp, v2), scale(weft, u2));

            // The gradients of the corners sum to zero, since a translation changes nothing.
            add_force(forces, first, a, scale(add(second, third), -1.0));
            add_force(forces, first, b, second);
            add_force(forces, first, c, third);
        }
    }
}

/// Adds the forces of the stencils of `shape`'s rim to `forces`.
#[inline(always)]
fn add_stencil_forces(shape: &RimShape<'_>, memories: &RimMemories, forces: &mut [f64]) {
    let first = shape.rim.particles.start;
    let stencils = &shape.rim.stencils;
    for start in stencils.batches() {
        let measures = StencilMeasures::new(stencils, start, shape.positions, shape.normals);
        let moments = [0, 1].map(|direction| {
            let yarns = &shape.panel.yarns[direction];
            let memory = memories.bending[direction].batch(stencils.base + start);
            measures.bending(yarns, direction).moments(&memory, 1.0)
        });

        for lane in 0..LANES.min(stencils.count - start) {
            let [warp, weft] = [0, 1].map(|direction| moments[direction].vector(lane));
            for node in stencils.nodes(start + lane) {
                let [v, u] = node.weights;
                add_force(forces, first, node.node, add(scale(warp, -v), scale(weft, -u)));
            }
        }
    }
}

/// Returns the derivatives of the potential of the batch of triangles from `start` on, with respect
/// to the columns `$p$` and `$q$` of the deformation gradient, in J.
#[inline(always)]
fn gradient_derivatives(
    shape: &RimShape<'_>,
    memories: &RimMemories,
    start: usize,
) -> [VectorLanes; 2] {
    let triangles = &shape.rim.triangles;
    let index = triangles.base + start;
    let measures = TriangleMeasures::new(triangles, start, shape.positions);
    let areas = lanes(&triangles.areas, start);

    // Shear turns both columns, tension pulls each along itself.
    let mut shear = Responses::default();
    let memory = memories.shear.batch(index);
    shape.panel.shear.respond::<false>(&memory, &measures.sines, &mut shear);
    let mut derivatives = [VectorLanes::zero(); 2];
    for direction in 0..2 {
        let mut tension = Responses::default();
        let memory = memories.traction[direction].batch(index);
        let yarns = &shape.panel.yarns[direction];
        yarns.traction.respond::<false>(&memory, &measures.strains[direction], &mut tension);
        for lane in 0..LANES {
            let (unit, crossing) =
                (measures.unit(direction, lane), measures.unit(1 - direction, lane));
            let across = subtract(crossing, scale(unit, measures.sines[lane]));
            let rotate = shear.load[lane] * measures.inverse[direction][lane];
            let sum = add(scale(unit, tension.load[lane]), scale(across, rotate));
            derivatives[direction].set(lane, scale(sum, areas[lane]));
        }
    }
    derivatives
}
