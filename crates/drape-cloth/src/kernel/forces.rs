#![allow(clippy::needless_range_loop, reason = "a lane is a place in many arrays")]

use drape_fabric::{BatchLaw, LANES, Lanes, Responses};

use crate::field::{add, dot, lanes, put, scale, set, subtract};
use crate::scratch::{Edges, Scratch, StripTrial};

/// Adds the forces on a strip's particles, three numbers for each.
///
/// All energy but that of bending is a function of the edges as vectors, and the bending's is one of
/// their differences: the derivative `$P_e$` with respect to an edge pulls at its two ends.
#[inline(always)]
pub(crate) fn add_forces(scratch: &mut Scratch, trial: &StripTrial<'_>, forces: &mut [f64]) {
    scratch.lay((trial.panel, trial.strip), trial.positions);
    for direction in 0..2 {
        tensions(scratch, trial, direction);
        moments(scratch, trial, direction);
    }
    for corner in 0..4 {
        corners(scratch, trial, corner);
    }
    for direction in 0..2 {
        pulls(scratch, trial, direction);
    }
    gather(scratch, trial, forces);
}

#[inline(always)]
fn tensions(scratch: &mut Scratch, trial: &StripTrial<'_>, direction: usize) {
    let StripTrial { panel, strip, .. } = *trial;
    let yarns = &panel.yarns[direction];
    let places = panel.margin - panel.stride..panel.margin + strip.points.len();
    for start in places.step_by(LANES) {
        let memory = trial.history.traction[direction].batch(strip.offset + start);
        let strains = scratch.strains(yarns, direction, (start, strip));
        let mut responses = Responses::default();
        yarns.traction.respond::<false>(&memory, &strains, &mut responses);
        let areas = lanes(&yarns.segment_areas, strip.points.start + start);
        let inverse = 1.0 / yarns.length;
        let mut tensions = [0.0; LANES];
        for lane in 0..LANES {
            tensions[lane] = responses.load[lane] * areas[lane] * inverse;
        }
        put(&mut scratch.tensions[direction], start, &tensions);
    }
}

#[inline(always)]
fn corners(scratch: &mut Scratch, trial: &StripTrial<'_>, corner: usize) {
    let StripTrial { panel, strip, .. } = *trial;
    let places = panel.margin - panel.stride - 1..panel.margin + strip.points.len();
    for start in places.step_by(LANES) {
        let memory = trial.history.shear[corner].batch(strip.offset + start);
        let sines = scratch.sines(panel, corner, (start, strip));
        let mut responses = Responses::default();
        panel.shear.respond::<false>(&memory, &sines, &mut responses);
        let areas = lanes(&panel.corners[corner], strip.points.start + start);
        let mut loads = [0.0; LANES];
        for lane in 0..LANES {
            loads[lane] = responses.load[lane] * areas[lane];
        }
        put(&mut scratch.corners[corner], start, &loads);
    }
}

#[inline(always)]
fn moments(scratch: &mut Scratch, trial: &StripTrial<'_>, direction: usize) {
    let StripTrial { panel, strip, .. } = *trial;
    let yarns = &panel.yarns[direction];
    let inverse_square = 1.0 / (yarns.length * yarns.length);
    let places = panel.margin - yarns.step..panel.margin + strip.points.len() + yarns.step;
    for start in places.step_by(LANES) {
        let memory = trial.history.bending[direction].batch(strip.offset + start);
        let bend = scratch.bend(yarns, &trial.history.normals, (start, strip));
        let moments = bend.moments(&memory, inverse_square);
        scratch.moments[direction].put(start, &moments);
    }
}

/// Derivatives with respect to the edges, from tension and from the corners that they are part of.
#[inline(always)]
fn pulls(scratch: &mut Scratch, trial: &StripTrial<'_>, direction: usize) {
    let StripTrial { panel, strip, .. } = *trial;
    let [warp, weft] = &scratch.edges;
    let (edges, other) = if direction == 0 { (warp, weft) } else { (weft, warp) };
    let step = panel.yarns[direction].step;
    let places = panel.margin - step..panel.margin + strip.points.len();
    for start in places.step_by(LANES) {
        let mut across = [[0.0; LANES]; 3];
        for (corner, cell, edge) in panel.around(direction, start) {
            let loads = lanes(&scratch.corners[corner], cell);
            let units = other.unit.from(edge);
            for lane in 0..LANES {
                for axis in 0..3 {
                    across[axis][lane] += loads[lane] * units.0[axis][lane];
                }
            }
        }
        let tensions = lanes(&scratch.tensions[direction], start);
        let pulls = turned(edges, start, tensions, &across);
        scratch.pulls[direction].put(start, &pulls);
    }
}

/// Tension along the edges, and what pulls at them less its part along them over their length.
#[inline(always)]
fn turned(edges: &Edges, start: usize, tensions: &Lanes, across: &[Lanes; 3]) -> [Lanes; 3] {
    let units = edges.unit.from(start);
    let inverse = lanes(&edges.inverse, start);
    let mut pulls = [[0.0; LANES]; 3];
    for lane in 0..LANES {
        let unit = units.at(lane);
        let load = [across[0][lane], across[1][lane], across[2][lane]];
        let turn = scale(subtract(load, scale(unit, dot(load, unit))), inverse[lane]);
        set(&mut pulls, lane, add(scale(unit, tensions[lane]), turn));
    }
    pulls
}

#[inline(always)]
fn gather(scratch: &mut Scratch, trial: &StripTrial<'_>, forces: &mut [f64]) {
    let StripTrial { panel, strip, .. } = *trial;
    let mut forces = forces.chunks_exact_mut(3);
    let occupied = &panel.occupied[strip.points.clone()];
    for (batch, occupied) in occupied.chunks(LANES).enumerate() {
        let start = panel.margin + batch * LANES;
        let mut sums = [[0.0; LANES]; 3];
        for (direction, step) in [(0, panel.stride), (1, 1)] {
            let (pulls, moments) = (&scratch.pulls[direction], &scratch.moments[direction]);
            let [before, here, after] = [start - step, start, start + step];
            let (from, to) = (pulls.from(before), pulls.from(here));
            let (before, here, after) =
                (moments.from(before), moments.from(here), moments.from(after));
            for axis in 0..3 {
                let (from, to) = (from.0[axis], to.0[axis]);
                let (a, c, b) = (before.0[axis], here.0[axis], after.0[axis]);
                for lane in 0..LANES {
                    let bend = a[lane] - 2.0 * c[lane] + b[lane];
                    sums[axis][lane] += to[lane] - from[lane] - bend;
                }
            }
        }
        let places = occupied.iter().enumerate().filter(|(_, occupied)| **occupied);
        for ((lane, _), force) in places.zip(&mut forces) {
            for axis in 0..3 {
                force[axis] += sums[axis][lane];
            }
        }
    }
}
