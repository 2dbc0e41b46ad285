#![allow(clippy::needless_range_loop, reason = "a lane is a place in many arrays")]

use drape_fabric::{BatchLaw, LANES, Lanes};

use crate::field::{Field, lanes};
use crate::panel::{Panel, Strip};
use crate::scratch::{Scratch, StripTrial};
use crate::state::{History, Moving};

/// Potential of a strip's connectors within a step, in J.
#[inline(always)]
pub(crate) fn potential(scratch: &mut Scratch, trial: &StripTrial<'_>) -> f64 {
    let StripTrial { panel, history, strip, positions } = *trial;
    scratch.lay((panel, strip), positions);
    let mut sums = [0.0; LANES];
    for start in own(panel, strip) {
        let place = strip.offset + start;
        for (direction, yarns) in panel.yarns.iter().enumerate() {
            let memory = history.traction[direction].batch(place);
            let strains = scratch.strains(yarns, direction, (start, strip));
            let mut works = [0.0; LANES];
            yarns.traction.add_work(&memory, &strains, &mut works);
            weigh(&mut sums, &works, (&yarns.segment_areas, strip, start));

            let memory = history.bending[direction].batch(place);
            let bend = scratch.bend(yarns, &history.normals, (start, strip));
            let mut works = bend.energies();
            yarns.bending.add_friction_work(&memory, &bend.bends().curvature, &mut works);
            weigh(&mut sums, &works, (&yarns.triple_areas, strip, start));
        }
        for (corner, areas) in panel.corners.iter().enumerate() {
            let memory = history.shear[corner].batch(place);
            let sines = scratch.sines(panel, corner, (start, strip));
            let mut works = [0.0; LANES];
            panel.shear.add_work(&memory, &sines, &mut works);
            weigh(&mut sums, &works, (areas, strip, start));
        }
    }
    sums.iter().sum()
}

/// Moves the memories of a strip on to the given positions and normals; returns the energy lost on
/// the way, in J.
#[inline(always)]
pub(crate) fn commit(
    scratch: &mut Scratch,
    (panel, strip): (&Panel, &Strip),
    mut moving: Moving<'_>,
    (positions, normals): (&[f64], &Field),
) -> f64 {
    scratch.lay((panel, strip), positions);
    let mut sums = [0.0; LANES];
    for start in own(panel, strip) {
        let place = start - panel.margin;
        for (direction, yarns) in panel.yarns.iter().enumerate() {
            let strains = scratch.strains(yarns, direction, (start, strip));
            let memories = &mut moving.traction[direction];
            let lost = yarns.traction.commit(memories, place, &strains);
            weigh(&mut sums, &lost, (&yarns.segment_areas, strip, start));

            let along = scratch.bend(yarns, normals, (start, strip)).bends().curvature;
            let memories = &mut moving.bending[direction];
            let lost = yarns.bending.commit(memories, place, &along);
            weigh(&mut sums, &lost, (&yarns.triple_areas, strip, start));
        }
        for (corner, areas) in panel.corners.iter().enumerate() {
            let sines = scratch.sines(panel, corner, (start, strip));
            let memories = &mut moving.shear[corner];
            let lost = panel.shear.commit(memories, place, &sines);
            weigh(&mut sums, &lost, (areas, strip, start));
        }
    }
    sums.iter().sum()
}

/// Writes the memories of a strip that starts in the given shape without friction.
pub(crate) fn start(
    scratch: &mut Scratch,
    (panel, strip): (&Panel, &Strip),
    history: &mut History,
    positions: &[f64],
) {
    scratch.lay((panel, strip), positions);
    for start in own(panel, strip) {
        let place = strip.offset + start;
        for (direction, yarns) in panel.yarns.iter().enumerate() {
            let strains = scratch.strains(yarns, direction, (start, strip));
            yarns.traction.start(&mut history.traction[direction], place, &strains);
            let along = scratch.bend(yarns, &history.normals, (start, strip)).bends().curvature;
            yarns.bending.start(&mut history.bending[direction], place, &along);
        }
        for (corner, memories) in history.shear.iter_mut().enumerate() {
            let sines = scratch.sines(panel, corner, (start, strip));
            panel.shear.start(memories, place, &sines);
        }
    }
}

/// Energy that a strip's connectors can give back, in J.
pub(crate) fn stored(scratch: &mut Scratch, trial: &StripTrial<'_>) -> f64 {
    let StripTrial { panel, history, strip, positions } = *trial;
    scratch.lay((panel, strip), positions);
    let mut sums = [0.0; LANES];
    for start in own(panel, strip) {
        let place = strip.offset + start;
        for (direction, yarns) in panel.yarns.iter().enumerate() {
            let mut energies = [0.0; LANES];
            let memory = history.traction[direction].batch(place);
            yarns.traction.add_stored(&memory, &mut energies);
            weigh(&mut sums, &energies, (&yarns.segment_areas, strip, start));

            let mut energies = scratch.bend(yarns, &history.normals, (start, strip)).energies();
            let memory = history.bending[direction].batch(place);
            yarns.bending.add_friction_stored(&memory, &mut energies);
            weigh(&mut sums, &energies, (&yarns.triple_areas, strip, start));
        }
        for (corner, areas) in panel.corners.iter().enumerate() {
            let mut energies = [0.0; LANES];
            let memory = history.shear[corner].batch(place);
            panel.shear.add_stored(&memory, &mut energies);
            weigh(&mut sums, &energies, (areas, strip, start));
        }
    }
    sums.iter().sum()
}

/// Places of a strip's own points, batch by batch.
fn own(panel: &Panel, strip: &Strip) -> impl Iterator<Item = usize> {
    (panel.margin..panel.margin + strip.points.len()).step_by(LANES)
}

/// Adds energies per area times the areas of the connectors from a place on.
#[inline(always)]
fn weigh(sums: &mut Lanes, energies: &Lanes, (areas, strip, start): (&[f64], &Strip, usize)) {
    let areas = lanes(areas, strip.points.start + start);
    for lane in 0..LANES {
        sums[lane] += energies[lane] * areas[lane];
    }
}
