#![allow(clippy::needless_range_loop, reason = "a lane is a place in many arrays")]

use drape_fabric::{BatchLaw, LANES, Lanes, MemoriesMut};

use crate::field::lanes;
use crate::panel::Panel;
use crate::rim::bow::Bowed;
use crate::rim::strain::Strain;
use crate::rim::{Rim, RimTrial};
use crate::state::RimHistory;

/// The memories of some rims, to be moved on.
pub(crate) struct Course<'a> {
    pub(crate) traction: [MemoriesMut<'a>; 2],
    pub(crate) shear: MemoriesMut<'a>,
    pub(crate) bending: [MemoriesMut<'a>; 2],
}

impl Course<'_> {
    /// The memories up to where another rim begins, and those from there on.
    pub(crate) fn split(self, from: &Rim, to: &Rim) -> (Self, Self) {
        let triangles = to.triangles.base - from.triangles.base;
        let stencils = to.stencils.base - from.stencils.base;
        let ([a, b], c, [d, e]) = (self.traction, self.shear, self.bending);
        let [a, b, c] = [a, b, c].map(|moving| moving.split(triangles));
        let [d, e] = [d, e].map(|moving| moving.split(stencils));
        let head = Self { traction: [a.0, b.0], shear: c.0, bending: [d.0, e.0] };
        (head, Self { traction: [a.1, b.1], shear: c.1, bending: [d.1, e.1] })
    }
}

/// Potential of a rim's connectors within a step, in J.
#[inline(always)]
pub(crate) fn potential(trial: &RimTrial<'_>) -> f64 {
    let RimTrial { rim: Rim { triangles, stencils, .. }, panel, history, .. } = *trial;
    let history = &history.rim;
    let mut sums = [0.0; LANES];
    for start in (0..triangles.areas.len()).step_by(LANES) {
        let place = triangles.base + start;
        let strain = Strain::of(triangles, start, trial.positions);
        let mut works = [0.0; LANES];
        for (direction, yarns) in panel.yarns.iter().enumerate() {
            let memory = history.traction[direction].batch(place);
            yarns.traction.add_work(&memory, &strain.strains[direction], &mut works);
        }
        panel.shear.add_work(&history.shear.batch(place), &strain.sines, &mut works);
        weigh(&mut sums, &works, lanes(&triangles.areas, start));
    }
    for start in (0..stencils.middles.len()).step_by(LANES) {
        let bowed = Bowed::of(stencils, start, (trial.positions, trial.normals));
        for (direction, yarns) in panel.yarns.iter().enumerate() {
            let memory = history.bending[direction].batch(stencils.base + start);
            let bend = bowed.bend(yarns, (stencils, start, direction));
            let mut works = bend.energies();
            yarns.bending.add_friction_work(&memory, &bend.bends().curvature, &mut works);
            weigh(&mut sums, &works, bend.areas);
        }
    }
    sums.iter().sum()
}

/// Moves the memories of a rim on to the given positions and normals; returns the energy lost on the way, in J.
#[inline(always)]
pub(crate) fn commit(
    (rim, panel): (&Rim, &Panel),
    mut course: Course<'_>,
    shape: (&[f64], &[f64]),
) -> f64 {
    let Rim { triangles, stencils, .. } = rim;
    let mut sums = [0.0; LANES];
    for start in (0..triangles.areas.len()).step_by(LANES) {
        let strain = Strain::of(triangles, start, shape.0);
        let areas = lanes(&triangles.areas, start);
        for (direction, yarns) in panel.yarns.iter().enumerate() {
            let memories = &mut course.traction[direction];
            let lost = yarns.traction.commit(memories, start, &strain.strains[direction]);
            weigh(&mut sums, &lost, areas);
        }
        let lost = panel.shear.commit(&mut course.shear, start, &strain.sines);
        weigh(&mut sums, &lost, areas);
    }
    for start in (0..stencils.middles.len()).step_by(LANES) {
        let bowed = Bowed::of(stencils, start, shape);
        for (direction, yarns) in panel.yarns.iter().enumerate() {
            let bend = bowed.bend(yarns, (stencils, start, direction));
            let memories = &mut course.bending[direction];
            let lost = yarns.bending.commit(memories, start, &bend.bends().curvature);
            weigh(&mut sums, &lost, bend.areas);
        }
    }
    sums.iter().sum()
}

/// Writes the memories of a rim that starts in the given shape without friction.
pub(crate) fn start(
    (rim, panel): (&Rim, &Panel),
    history: &mut RimHistory,
    shape: (&[f64], &[f64]),
) {
    let Rim { triangles, stencils, .. } = rim;
    for start in (0..triangles.areas.len()).step_by(LANES) {
        let place = triangles.base + start;
        let strain = Strain::of(triangles, start, shape.0);
        for (direction, yarns) in panel.yarns.iter().enumerate() {
            let memories = &mut history.traction[direction];
            yarns.traction.start(memories, place, &strain.strains[direction]);
        }
        panel.shear.start(&mut history.shear, place, &strain.sines);
    }
    for start in (0..stencils.middles.len()).step_by(LANES) {
        let bowed = Bowed::of(stencils, start, shape);
        for (direction, yarns) in panel.yarns.iter().enumerate() {
            let bends = bowed.bend(yarns, (stencils, start, direction)).bends();
            let memories = &mut history.bending[direction];
            yarns.bending.start(memories, stencils.base + start, &bends.curvature);
        }
    }
}

/// Energy that a rim's connectors can give back, in J.
pub(crate) fn stored(trial: &RimTrial<'_>) -> f64 {
    let RimTrial { rim: Rim { triangles, stencils, .. }, panel, history, .. } = *trial;
    let history = &history.rim;
    let mut sums = [0.0; LANES];
    for start in (0..triangles.areas.len()).step_by(LANES) {
        let place = triangles.base + start;
        let mut energies = [0.0; LANES];
        for (direction, yarns) in panel.yarns.iter().enumerate() {
            yarns.traction.add_stored(&history.traction[direction].batch(place), &mut energies);
        }
        panel.shear.add_stored(&history.shear.batch(place), &mut energies);
        weigh(&mut sums, &energies, lanes(&triangles.areas, start));
    }
    for start in (0..stencils.middles.len()).step_by(LANES) {
        let bowed = Bowed::of(stencils, start, (trial.positions, trial.normals));
        for (direction, yarns) in panel.yarns.iter().enumerate() {
            let memory = history.bending[direction].batch(stencils.base + start);
            let bend = bowed.bend(yarns, (stencils, start, direction));
            let mut energies = bend.energies();
            yarns.bending.add_friction_stored(&memory, &mut energies);
            weigh(&mut sums, &energies, bend.areas);
        }
    }
    sums.iter().sum()
}

/// Adds energies per area times areas.
#[inline(always)]
fn weigh(sums: &mut Lanes, energies: &Lanes, areas: &Lanes) {
    for lane in 0..LANES {
        sums[lane] += energies[lane] * areas[lane];
    }
}
