//! Forces of a strip.
//!
//! ```text
//!   loads of segments, corners, triples  →  edge gradients P, moments M  →  forces of points
//! ```
#![allow(clippy::needless_range_loop, reason = "a lane indexes several arrays")]

use drape_fabric::{BatchLaw, LANES, Lanes, Responses};

use crate::kernel::buffers::{Edges, StripBuffers, StripTrial};
use crate::layout::columns::{VectorLanes, is_vacant, lanes, put};
use crate::layout::grid::CornerAtEdge;
use crate::measure::vector::{add, dot, scale, subtract};

/// Adds the forces on the particles of `trial`'s strip to `forces`, in N, three numbers each.
///
/// All energy except bending is a function of the edges as vectors, and bending is a function of a
/// difference of two edges. The derivative `$P_e$` with respect to an edge acts on both of its
/// ends.
#[inline(always)]
pub(crate) fn add_forces(buffers: &mut StripBuffers, trial: &StripTrial<'_>, forces: &mut [f64]) {
    buffers.load(trial.panel, trial.strip, trial.positions);
    for direction in 0..2 {
        compute_tensions(buffers, trial, direction);
        compute_moments(buffers, trial, direction);
    }
    for corner in 0..4 {
        compute_corner_loads(buffers, trial, corner);
    }
    for direction in 0..2 {
        compute_edge_gradients(buffers, trial, direction);
    }
    sum_forces(buffers, trial, forces);
}

/// Computes the tensions of the segments along `direction`, times area over length, in N.
#[inline(always)]
fn compute_tensions(buffers: &mut StripBuffers, trial: &StripTrial<'_>, direction: usize) {
    let StripTrial { panel, strip, .. } = *trial;
    let yarns = &panel.yarns[direction];
    let indices = panel.margin - panel.stride..panel.margin + strip.points.len();
    for start in indices.step_by(LANES) {
        let at = strip.batch(start);
        let areas = lanes(&yarns.segment_areas, at.panel);
        if is_vacant(areas) {
            put(&mut buffers.tensions[direction], start, &[0.0; LANES]);
            continue;
        }
        // Load of the law in each lane.
        let memory = trial.memories.traction[direction].batch(at.cloth);
        let strains = buffers.strains(yarns, direction, at);
        let mut responses = Responses::default();
        yarns.traction.respond::<false>(&memory, &strains, &mut responses);
        let inverse = 1.0 / yarns.length;
        let mut tensions = [0.0; LANES];
        for lane in 0..LANES {
            tensions[lane] = responses.load[lane] * areas[lane] * inverse;
        }
        put(&mut buffers.tensions[direction], start, &tensions);
    }
}

/// Computes the shear loads at `corner`, one of the four corners of the cells, times their areas.
#[inline(always)]
fn compute_corner_loads(buffers: &mut StripBuffers, trial: &StripTrial<'_>, corner: usize) {
    let StripTrial { panel, strip, .. } = *trial;
    let indices = panel.margin - panel.stride - 1..panel.margin + strip.points.len();
    for start in indices.step_by(LANES) {
        let at = strip.batch(start);
        let areas = lanes(&panel.corner_areas[corner], at.panel);
        if is_vacant(areas) {
            put(&mut buffers.corner_loads[corner], start, &[0.0; LANES]);
            continue;
        }
        // Load of the law in each lane.
        let memory = trial.memories.shear[corner].batch(at.cloth);
        let sines = buffers.sines(panel, corner, at);
        let mut responses = Responses::default();
        panel.shear.respond::<false>(&memory, &sines, &mut responses);
        let mut loads = [0.0; LANES];
        for lane in 0..LANES {
            loads[lane] = responses.load[lane] * areas[lane];
        }
        put(&mut buffers.corner_loads[corner], start, &loads);
    }
}

/// Computes the derivatives of the potential with respect to the second differences along
/// `direction`, over `$h^2$`.
#[inline(always)]
fn compute_moments(buffers: &mut StripBuffers, trial: &StripTrial<'_>, direction: usize) {
    let StripTrial { panel, strip, .. } = *trial;
    let yarns = &panel.yarns[direction];
    let inverse_square = 1.0 / (yarns.length * yarns.length);
    let indices = panel.margin - yarns.step..panel.margin + strip.points.len() + yarns.step;
    for start in indices.step_by(LANES) {
        let at = strip.batch(start);
        if is_vacant(lanes(&yarns.triple_areas, at.panel)) {
            buffers.moments[direction].put(start, &VectorLanes::zero().0);
            continue;
        }
        let memory = trial.memories.bending[direction].batch(at.cloth);
        let triples = buffers.triples(yarns, &trial.memories.normals, at);
        let moments = triples.moments(&memory, inverse_square);
        buffers.moments[direction].put(start, &moments.0);
    }
}

/// Computes the derivatives of the potential with respect to the edges along `direction`, from
/// their tensions and from the corners to which they belong.
#[inline(always)]
fn compute_edge_gradients(buffers: &mut StripBuffers, trial: &StripTrial<'_>, direction: usize) {
    let StripTrial { panel, strip, .. } = *trial;
    let [warp, weft] = &buffers.edges;
    let (edges, crossing) = if direction == 0 { (warp, weft) } else { (weft, warp) };
    let step = panel.yarns[direction].step;
    let indices = panel.margin - step..panel.margin + strip.points.len();
    for start in indices.step_by(LANES) {
        // Sum of the corner loads times the directions of the crossing edges.
        let mut shear = [[0.0; LANES]; 3];
        for CornerAtEdge { corner, cell, other_edge } in panel.corners_at_edge(direction, start) {
            let loads = lanes(&buffers.corner_loads[corner], cell);
            let units = crossing.unit.batch(other_edge);
            for lane in 0..LANES {
                for axis in 0..3 {
                    shear[axis][lane] += loads[lane] * units.0[axis][lane];
                }
            }
        }
        let tensions = lanes(&buffers.tensions[direction], start);
        let gradients = edge_gradients(edges, start, tensions, &shear);
        buffers.edge_gradients[direction].put(start, &gradients.0);
    }
}

/// Returns `$P_e = T\hat e + (1 - \hat e\hat e^T)\,q/|e|$` with the tension `$T$` in `tensions` and
/// the sum `$q$` in `shear` of the corner loads times the directions of their crossing edges.
#[inline(always)]
fn edge_gradients(
    edges: &Edges,
    start: usize,
    tensions: &Lanes,
    shear: &[Lanes; 3],
) -> VectorLanes {
    let units = edges.unit.batch(start);
    let inverse = lanes(&edges.inverse, start);
    let mut gradients = VectorLanes::zero();
    for lane in 0..LANES {
        let unit = units.vector(lane);
        let load = [shear[0][lane], shear[1][lane], shear[2][lane]];
        let across = scale(subtract(load, scale(unit, dot(load, unit))), inverse[lane]);
        gradients.set(lane, add(scale(unit, tensions[lane]), across));
    }
    gradients
}

/// Adds the forces of the connectors to `forces`: for each particle the loads of the edges that end
/// at it, and the second differences of the bending moments along its yarns.
#[inline(always)]
fn sum_forces(buffers: &mut StripBuffers, trial: &StripTrial<'_>, forces: &mut [f64]) {
    let StripTrial { panel, strip, .. } = *trial;
    let mut forces = forces.chunks_exact_mut(3);
    let occupied = &panel.occupied[strip.points.clone()];
    for (batch, occupied) in occupied.chunks(LANES).enumerate() {
        let start = panel.margin + batch * LANES;
        // Along each yarn: the next edge less the edge before, less the bending.
        let mut sums = [[0.0; LANES]; 3];
        for (direction, step) in [(0, panel.stride), (1, 1)] {
            let gradients = &buffers.edge_gradients[direction];
            let moments = &buffers.moments[direction];
            let [before, here, after] = [start - step, start, start + step];
            let (from, to) = (gradients.batch(before), gradients.batch(here));
            let (before, here, after) =
                (moments.batch(before), moments.batch(here), moments.batch(after));
            for axis in 0..3 {
                let (from, to) = (from.0[axis], to.0[axis]);
                let (a, c, b) = (before.0[axis], here.0[axis], after.0[axis]);
                for lane in 0..LANES {
                    let bend = a[lane] - 2.0 * c[lane] + b[lane];
                    sums[axis][lane] += to[lane] - from[lane] - bend;
                }
            }
        }
        // Only points with a particle have forces.
        let particles = occupied.iter().enumerate().filter(|(_, occupied)| **occupied);
        for ((lane, _), force) in particles.zip(&mut forces) {
            for axis in 0..3 {
                force[axis] += sums[axis][lane];
            }
        }
    }
}
