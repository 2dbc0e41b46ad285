//! Forces of a rim: of its triangles, then of its stencils.
#![allow(clippy::needless_range_loop, reason = "a lane indexes several arrays")]

use drape_fabric::{BatchLaw, LANES, Responses};

use crate::layout::columns::{VectorLanes, lanes};
use crate::measure::vector::{Vector, add, scale, subtract};
use crate::rim::connectors::RimShape;
use crate::rim::memories::RimMemories;
use crate::rim::stencils::StencilMeasures;
use crate::rim::triangles::TriangleMeasures;

/// Adds the forces of a rim on the particles of its panel, three numbers for each, in N.
#[inline(always)]
pub(crate) fn add_forces(shape: &RimShape<'_>, memories: &RimMemories, forces: &mut [f64]) {
    let first = shape.rim.particles.start;
    let mut add_force = |particle: u32, force: Vector| {
        let start = 3 * (particle as usize - first);
        forces[start..start + 3].iter_mut().zip(force).for_each(|(sum, f)| *sum += f);
    };
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
            add_force(a, scale(add(second, third), -1.0));
            add_force(b, second);
            add_force(c, third);
        }
    }
    let stencils = &shape.rim.stencils;
    for start in stencils.batches() {
        let measures = StencilMeasures::of(stencils, start, shape.positions, shape.normals);
        let moments = [0, 1].map(|direction| {
            let yarns = &shape.panel.yarns[direction];
            let memory = memories.bending[direction].batch(stencils.base + start);
            measures.bending(yarns, direction).moments(&memory, 1.0)
        });
        for lane in 0..LANES.min(stencils.count - start) {
            let [warp, weft] = [0, 1].map(|direction| moments[direction].vector(lane));
            for node in stencils.nodes(start + lane) {
                let [v, u] = node.weights;
                add_force(node.node, add(scale(warp, -v), scale(weft, -u)));
            }
        }
    }
}

/// Returns the derivatives of the potential of a batch of triangles with respect to the columns
/// `$p$` and `$q$` of the deformation gradient, in J.
#[inline(always)]
fn gradient_derivatives(
    shape: &RimShape<'_>,
    memories: &RimMemories,
    start: usize,
) -> [VectorLanes; 2] {
    let triangles = &shape.rim.triangles;
    let index = triangles.base + start;
    let measures = TriangleMeasures::of(triangles, start, shape.positions);
    let areas = lanes(&triangles.areas, start);
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
            let (own, other) = (measures.unit(direction, lane), measures.unit(1 - direction, lane));
            let across = subtract(other, scale(own, measures.sines[lane]));
            let rotate = shear.load[lane] * measures.inverse[direction][lane];
            let sum = add(scale(own, tension.load[lane]), scale(across, rotate));
            derivatives[direction].set(lane, scale(sum, areas[lane]));
        }
    }
    derivatives
}
