#![allow(clippy::needless_range_loop, reason = "a lane is a place in many arrays")]

use drape_fabric::{BatchLaw, LANES, Responses};

use crate::field::{Vector, add, lanes, scale, set, subtract};
use crate::rim::RimTrial;
use crate::rim::bow::Bowed;
use crate::rim::strain::{Strain, at};

/// Adds the forces of a rim on the particles of its panel, three numbers for each.
#[inline(always)]
pub(crate) fn add_forces(trial: &RimTrial<'_>, forces: &mut [f64]) {
    let first = trial.rim.particles.start;
    let mut pull = |particle: u32, force: Vector| {
        let place = 3 * (particle as usize - first);
        forces[place..place + 3].iter_mut().zip(force).for_each(|(sum, f)| *sum += f);
    };
    let triangles = &trial.rim.triangles;
    for start in (0..triangles.areas.len()).step_by(LANES) {
        let pulls = pulls(trial, start);
        let gradients = triangles.gradients.from(start);
        let count = LANES.min(triangles.count - start);
        for (lane, &[a, b, c]) in triangles.corners[start..start + count].iter().enumerate() {
            let [warp, weft] = [0, 1].map(|direction| at(&pulls[direction], lane));
            let [u1, u2, v1, v2] = gradients.0.map(|column| -column[lane]);
            let second = add(scale(warp, v1), scale(weft, u1));
            let third = add(scale(warp, v2), scale(weft, u2));
            pull(a, scale(add(second, third), -1.0));
            pull(b, second);
            pull(c, third);
        }
    }
    let stencils = &trial.rim.stencils;
    for start in (0..stencils.middles.len()).step_by(LANES) {
        let bowed = Bowed::of(stencils, start, (trial.positions, trial.normals));
        let moments = [0, 1].map(|direction| {
            let yarns = &trial.panel.yarns[direction];
            let memory = trial.history.rim.bending[direction].batch(stencils.base + start);
            bowed.bend(yarns, (stencils, start, direction)).moments(&memory, 1.0)
        });
        for lane in 0..LANES.min(stencils.count - start) {
            let [warp, weft] = [0, 1].map(|direction| at(&moments[direction], lane));
            for part in stencils.parts(start + lane) {
                let [v, u] = part.weights;
                pull(part.node, add(scale(warp, -v), scale(weft, -u)));
            }
        }
    }
}

/// Derivatives of the potential of a batch of triangles with respect to `$p$` and `$q$`, in J.
#[inline(always)]
fn pulls(trial: &RimTrial<'_>, start: usize) -> [[[f64; LANES]; 3]; 2] {
    let triangles = &trial.rim.triangles;
    let history = &trial.history.rim;
    let place = triangles.base + start;
    let strain = Strain::of(triangles, start, trial.positions);
    let areas = lanes(&triangles.areas, start);
    let mut shear = Responses::default();
    trial.panel.shear.respond::<false>(&history.shear.batch(place), &strain.sines, &mut shear);
    let mut pulls = [[[0.0; LANES]; 3]; 2];
    for direction in 0..2 {
        let mut tension = Responses::default();
        let memory = history.traction[direction].batch(place);
        let yarns = &trial.panel.yarns[direction];
        yarns.traction.respond::<false>(&memory, &strain.strains[direction], &mut tension);
        for lane in 0..LANES {
            let (own, other) = (strain.unit(direction, lane), strain.unit(1 - direction, lane));
            let across = subtract(other, scale(own, strain.sines[lane]));
            let turn = shear.load[lane] * strain.inverse[direction][lane];
            let pull = add(scale(own, tension.load[lane]), scale(across, turn));
            set(&mut pulls[direction], lane, scale(pull, areas[lane]));
        }
    }
    pulls
}
