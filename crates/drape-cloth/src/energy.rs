use drape_fabric::{BatchLaw, BendingBackbone, LANES, Lanes};

use crate::field::{Vector, dot, lanes, scale, subtract};
use crate::panel::{Panel, Strip};
use crate::scratch::{Scratch, Trial};
use crate::state::PanelState;

/// Potential of a strip's connectors within a step, in J.
#[inline(always)]
pub(crate) fn potential(scratch: &mut Scratch, trial: &Trial<'_>) -> f64 {
    scratch.lay((trial.panel, trial.strip), trial.positions);
    let Trial {
        panel,
        state,
        strip,
        ..
    } = *trial;
    let offset = strip.points.start;
    let mut sums = [0.0; LANES];
    for start in own(panel, strip) {
        for (direction, yarns) in panel.yarns.iter().enumerate() {
            let memory = state.traction[direction].from(offset + start);
            let strains = scratch.strains(yarns, direction, (start, offset));
            let mut works = [0.0; LANES];
            yarns.traction.work(&memory, &strains, &mut works);
            weigh(
                &mut sums,
                &works,
                lanes(&yarns.segment_areas, offset + start),
            );
        }
        for corner in 0..4 {
            let memory = state.shear[corner].from(offset + start);
            let sines = scratch.sines(panel, corner, (start, offset));
            let mut works = [0.0; LANES];
            panel.shear.work(&memory, &sines, &mut works);
            weigh(
                &mut sums,
                &works,
                lanes(&panel.corners[corner], offset + start),
            );
        }
        for (direction, yarns) in panel.yarns.iter().enumerate() {
            let memory = state.bending[direction].from(offset + start);
            let along = scratch.bends(yarns, &state.normals, (start, offset));
            let mut works = bent(scratch, trial, direction, start);
            yarns.bending.slide_work(&memory, &along, &mut works);
            weigh(
                &mut sums,
                &works,
                lanes(&yarns.triple_areas, offset + start),
            );
        }
    }
    sums.iter().sum()
}

/// Moves the memories of a strip on to the trial; returns the energy lost on the way, in J.
#[inline(always)]
pub(crate) fn commit(
    scratch: &mut Scratch,
    (panel, strip): (&Panel, &Strip),
    state: &mut PanelState,
    positions: &[f64],
) -> f64 {
    scratch.lay((panel, strip), positions);
    let offset = strip.points.start;
    let mut sums = [0.0; LANES];
    for start in own(panel, strip) {
        for (direction, yarns) in panel.yarns.iter().enumerate() {
            let strains = scratch.strains(yarns, direction, (start, offset));
            let mut moving = state.traction[direction].moving(offset);
            let lost = yarns.traction.commit(&mut moving, start, &strains);
            weigh(
                &mut sums,
                &lost,
                lanes(&yarns.segment_areas, offset + start),
            );
        }
        for corner in 0..4 {
            let sines = scratch.sines(panel, corner, (start, offset));
            let mut moving = state.shear[corner].moving(offset);
            let lost = panel.shear.commit(&mut moving, start, &sines);
            weigh(
                &mut sums,
                &lost,
                lanes(&panel.corners[corner], offset + start),
            );
        }
        for (direction, yarns) in panel.yarns.iter().enumerate() {
            let along = scratch.bends(yarns, &state.normals, (start, offset));
            let mut moving = state.bending[direction].moving(offset);
            let lost = yarns.bending.commit(&mut moving, start, &along);
            weigh(&mut sums, &lost, lanes(&yarns.triple_areas, offset + start));
        }
    }
    sums.iter().sum()
}

/// Writes the memories of a strip that starts in the given shape without friction.
pub(crate) fn start(
    scratch: &mut Scratch,
    (panel, strip): (&Panel, &Strip),
    state: &mut PanelState,
    positions: &[f64],
) {
    scratch.lay((panel, strip), positions);
    let offset = strip.points.start;
    for start in own(panel, strip) {
        let place = offset + start;
        for (direction, yarns) in panel.yarns.iter().enumerate() {
            let strains = scratch.strains(yarns, direction, (start, offset));
            state.traction[direction].start(&yarns.traction, place, &strains);
            let along = scratch.bends(yarns, &state.normals, (start, offset));
            state.bending[direction].start(&yarns.bending, place, &along);
        }
        for corner in 0..4 {
            let sines = scratch.sines(panel, corner, (start, offset));
            state.shear[corner].start(&panel.shear, place, &sines);
        }
    }
}

/// Energy that a strip's connectors can give back, in J.
pub(crate) fn stored(scratch: &mut Scratch, trial: &Trial<'_>) -> f64 {
    scratch.lay((trial.panel, trial.strip), trial.positions);
    let Trial {
        panel,
        state,
        strip,
        ..
    } = *trial;
    let offset = strip.points.start;
    let mut sums = [0.0; LANES];
    for start in own(panel, strip) {
        for (direction, yarns) in panel.yarns.iter().enumerate() {
            let mut energies = [0.0; LANES];
            let memory = state.traction[direction].from(offset + start);
            yarns.traction.stored(&memory, &mut energies);
            weigh(
                &mut sums,
                &energies,
                lanes(&yarns.segment_areas, offset + start),
            );
        }
        for corner in 0..4 {
            let mut energies = [0.0; LANES];
            let memory = state.shear[corner].from(offset + start);
            panel.shear.stored(&memory, &mut energies);
            weigh(
                &mut sums,
                &energies,
                lanes(&panel.corners[corner], offset + start),
            );
        }
        for (direction, yarns) in panel.yarns.iter().enumerate() {
            let mut energies = bent(scratch, trial, direction, start);
            let memory = state.bending[direction].from(offset + start);
            yarns.bending.slide_stored(&memory, &mut energies);
            weigh(
                &mut sums,
                &energies,
                lanes(&yarns.triple_areas, offset + start),
            );
        }
    }
    sums.iter().sum()
}

/// Places of a strip's own points, batch by batch.
fn own(panel: &Panel, strip: &Strip) -> impl Iterator<Item = usize> {
    (panel.margin..panel.margin + strip.points.len()).step_by(LANES)
}

#[inline(always)]
fn weigh(sums: &mut Lanes, energies: &Lanes, areas: &Lanes) {
    for lane in 0..LANES {
        sums[lane] += energies[lane] * areas[lane];
    }
}

/// Elastic energies of bending per area, in J/m².
#[inline(always)]
fn bent(scratch: &Scratch, trial: &Trial<'_>, direction: usize, start: usize) -> Lanes {
    let yarns = &trial.panel.yarns[direction];
    let rest = yarns.bending.law().rest_curvature;
    let curvatures = scratch.curvatures(yarns, start);
    let normals = trial.state.normals.from(trial.strip.points.start + start);
    let excess = |lane| -> Vector { subtract(curvatures.at(lane), scale(normals.at(lane), rest)) };
    let mut energies = [0.0; LANES];
    match yarns.bending.law().backbone {
        BendingBackbone::Linear { rigidity } => {
            for lane in 0..LANES {
                energies[lane] = 0.5 * rigidity * dot(excess(lane), excess(lane));
            }
        }
        BendingBackbone::Piecewise(piecewise) => {
            for lane in 0..LANES {
                energies[lane] = piecewise.energy(dot(excess(lane), excess(lane)).sqrt());
            }
        }
    }
    energies
}
