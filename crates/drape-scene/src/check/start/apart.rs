//! Panels that are moved apart at the start. Patterns of other programs have panels that overlap by
//! millimetres at the seams between them, and panels that start a few centimetres inside a body.
//!
//! A panel in a body is moved along its normal until the panel is outside. Two panels of a garment
//! that cross, and are sewn to each other or lie in one plane, are moved away from each other, each
//! by half of the distance. Panels that would have to be moved farther stay where they are, and are
//! a mistake of the scene.

use std::collections::{BTreeMap, BTreeSet};

use crate::scene::Scene;
use crate::scene::contact::DistanceGrowth;
use crate::scene::garment::Garment;
use crate::surfaces::StartSurfaces;

use crate::wearing::is_held;
use crate::wearing::placing::CLEAR;
use crate::wearing::solids::{Solids, moved};

use super::tangle::overlaps;

/// Largest distance by which a panel is moved out of a body, in m.
const LEAVE_MAX: f64 = 0.08;
/// Step of the distances that are tried to leave a body, in m.
const LEAVE_STEP: f64 = 0.0025;

/// Largest fraction of a garment inside a body that is moved out of it. Where more is inside, the
/// place of the garment is wrong.
const INSIDE_MAX: f64 = 0.1;

/// Largest distance of a flat panel from its plane, in m.
const FLAT: f64 = 1e-3;

/// Largest distance by which a panel is moved away from others, in m.
const PART_MAX: f64 = 0.015;
/// Step by which two panels part, in m: far above the distance that is kept between surfaces.
const PART_STEP: f64 = 0.001;

/// Largest number of steps, since panels can push each other to and fro.
const PART_ROUNDS: usize = 60;

/// Moves panels of `scene` out of bodies that they start a few centimetres inside of. Returns a
/// note on each moved panel.
pub(crate) fn leave_bodies(scene: &mut Scene) -> Vec<String> {
    let Some(solids) = Solids::new(scene.bodies.iter().map(|moving| &moving.body)) else {
        return Vec::new();
    };
    let mut shifts: Vec<(usize, [f64; 3])> = Vec::new();
    for garment in scene.garments.iter().filter(|garment| is_movable(scene, garment)) {
        let panels = scene.panels_of(garment);
        let particles = panels.iter().flat_map(|&panel| scene.panels[panel].particles());
        let inside = particles.filter(|&particle| solids.distance(place(scene, particle)) < 0.0);
        let count = inside.count();
        if count > 0 && count as f64 <= INSIDE_MAX * garment.particles.len() as f64 {
            shifts.extend(
                panels.iter().filter_map(|&panel| Some((panel, shift_out(scene, &solids, panel)?))),
            );
        }
    }

    let notes =
        shifts.iter().map(|&(panel, shift)| note(scene, panel, shift, "out of a body")).collect();
    for (panel, shift) in shifts {
        move_panel(scene, panel, shift);
    }
    notes
}

/// Moves panels of `scene` apart that cross at a seam or in one plane. Returns a note on each moved
/// panel.
pub(crate) fn part_panels(scene: &mut Scene, surfaces: &mut StartSurfaces) -> Vec<String> {
    if !crosses(surfaces, &scene.start.positions) {
        return Vec::new();
    }
    let before = scene.start.positions.clone();
    let Some(shifts) = part(scene, surfaces) else {
        scene.start.positions = before;
        return Vec::new();
    };
    let notes = shifts
        .iter()
        .map(|(panel, shift)| note(scene, *panel, *shift, "away from panels beside it"));
    notes.collect()
}

/// Shifts of panels, in m, by the numbers of the panels.
type Shifts = BTreeMap<usize, [f64; 3]>;

/// Moves crossing panels apart along the lines between their middles. Returns their shifts, or
/// `None` if a panel would have to be moved farther than [`PART_MAX`].
fn part(scene: &mut Scene, surfaces: &mut StartSurfaces) -> Option<Shifts> {
    let sewn = sewn_pairs(scene);
    let mut shifts = Shifts::new();
    for _ in 0..PART_ROUNDS {
        let pairs = crossing_pairs(scene, surfaces, &sewn)?;
        if pairs.is_empty() {
            add_half_step(scene, surfaces, &mut shifts);
            return Some(shifts);
        }
        for [one, other] in pairs {
            let along = direction(scene, one, other)?;
            for (panel, sign) in [(one, -0.5), (other, 0.5)] {
                let step = along.map(|x| sign * PART_STEP * x);
                move_panel(scene, panel, step);
                let shift = shifts.entry(panel).or_default();
                *shift = moved(shift, step);
                if length(*shift) > PART_MAX {
                    return None;
                }
            }
        }
    }
    None
}

/// Moves panels farther along `shifts` by half a step, so that they are more than just apart. If
/// that makes others cross, `scene` and `shifts` stay as they are.
fn add_half_step(scene: &mut Scene, surfaces: &mut StartSurfaces, shifts: &mut Shifts) {
    let before = scene.start.positions.clone();
    let longer: Shifts = shifts
        .iter()
        .map(|(&panel, shift)| {
            let factor = 1.0 + 0.5 * PART_STEP / length(*shift).max(PART_STEP);
            (panel, shift.map(|x| factor * x))
        })
        .collect();

    for (panel, shift) in &longer {
        let done = shifts[panel];
        move_panel(scene, *panel, [0, 1, 2].map(|axis| shift[axis] - done[axis]));
    }
    if crosses(surfaces, &scene.start.positions) {
        scene.start.positions = before;
    } else {
        *shifts = longer;
    }
}

/// Returns whether the panels of `garment` may be moved: no pin holds them, and no body grows into
/// them.
fn is_movable(scene: &Scene, garment: &Garment) -> bool {
    scene.contact.inflation.is_none() && !is_held(scene, garment)
}

/// Returns the position of `particle` at the start, in m.
fn place(scene: &Scene, particle: usize) -> [f64; 3] {
    [0, 1, 2].map(|axis| scene.start.positions[3 * particle + axis])
}

/// Returns the length of `vector`.
fn length(vector: [f64; 3]) -> f64 {
    vector.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Moves the panel with the number `panel` by `shift`, in m.
fn move_panel(scene: &mut Scene, panel: usize, shift: [f64; 3]) {
    for particle in scene.panels[panel].particles() {
        for (axis, x) in shift.iter().enumerate() {
            scene.start.positions[3 * particle + axis] += x;
        }
    }
}

/// Describes a panel that was moved by `shift`, in m, with the reason `why`.
fn note(scene: &Scene, panel: usize, shift: [f64; 3], why: &str) -> String {
    let [x, y, z] = shift.map(|x| 1e3 * x + 0.0);
    format!(
        "panel \"{}\" starts {:.1} mm, ({x:.1}, {y:.1}, {z:.1}) mm, from its place in the pattern, {why}",
        scene.panels[panel].name,
        1e3 * length(shift)
    )
}

/// Returns the shortest shift along the normal of a flat panel, in m, that brings the panel out of
/// `solids`. Returns `None` if the panel is outside already, is not flat, or would have to be moved
/// farther than [`LEAVE_MAX`].
fn shift_out(scene: &Scene, solids: &Solids<'_>, panel: usize) -> Option<[f64; 3]> {
    // A limb can lie between the particles of a coarse panel, so the middles of triangles count
    // too.
    let particles = scene.panels[panel].particles();
    let middles = triangles_of(scene, panel)
        .map(|[a, b, c]| [0, 1, 2].map(|axis| (a[axis] + b[axis] + c[axis]) / 3.0));
    let points: Vec<[f64; 3]> =
        particles.map(|particle| place(scene, particle)).chain(middles).collect();
    if is_clear(&points, solids, [0.0; 3]) {
        return None;
    }

    let normal = normal(scene, panel)?;
    let steps = (LEAVE_MAX / LEAVE_STEP).round() as usize;
    let mut distances =
        (1..=steps).flat_map(|k| [1.0, -1.0].map(|sign| sign * k as f64 * LEAVE_STEP));
    let distance =
        distances.find(|distance| is_clear(&points, solids, normal.map(|x| distance * x)))?;
    Some(normal.map(|x| distance * x))
}

/// Returns whether `points` moved by `shift` are clear of `solids`.
fn is_clear(points: &[[f64; 3]], solids: &Solids<'_>, shift: [f64; 3]) -> bool {
    points.iter().all(|point| solids.distance(moved(point, shift)) > CLEAR)
}

/// Returns the corners of the triangles of a panel at the start, in m.
fn triangles_of(scene: &Scene, panel: usize) -> impl Iterator<Item = [[f64; 3]; 3]> {
    let triangles = scene.triangles_of(&scene.panels[panel]).iter();
    triangles.map(|corners| corners.map(|corner| place(scene, corner as usize)))
}

/// Returns the unit normal of a flat panel, or `None` if the panel is not flat.
fn normal(scene: &Scene, panel: usize) -> Option<[f64; 3]> {
    let mut sum = [0.0; 3];
    for [a, b, c] in triangles_of(scene, panel) {
        let (e, f) = ([0, 1, 2].map(|k| b[k] - a[k]), [0, 1, 2].map(|k| c[k] - a[k]));
        for (k, component) in sum.iter_mut().enumerate() {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            *component += e[i] * f[j] - e[j] * f[i];
        }
    }
    let normal = unit(sum)?;

    let heights = scene.panels[panel]
        .particles()
        .map(|particle| place(scene, particle).iter().zip(normal).map(|(x, n)| x * n).sum::<f64>());
    let [low, high] =
        heights.fold([f64::MAX, f64::MIN], |[low, high], x| [low.min(x), high.max(x)]);
    (high - low <= FLAT).then_some(normal)
}

/// Returns whether the panels `one` and `other` are of one garment, are flat, and lie in one plane.
fn in_one_plane(scene: &Scene, [one, other]: [usize; 2]) -> bool {
    let garments = [one, other].map(|panel| scene.garment_of(&scene.panels[panel]));
    if garments[0] != garments[1] {
        return false;
    }
    let Some(normal) = normal(scene, one) else { return false };
    let first = place(scene, scene.panels[one].first);
    garments[0].is_some()
        && scene.panels[other].particles().all(|particle| {
            let point = place(scene, particle);
            let height = (0..3).map(|k| (point[k] - first[k]) * normal[k]).sum::<f64>().abs();
            height <= FLAT
        })
}

/// Returns the unit vector along `vector`, or `None` if `vector` is about zero.
fn unit(vector: [f64; 3]) -> Option<[f64; 3]> {
    let length = length(vector);
    (length > 1e-9).then(|| vector.map(|x| x / length))
}

/// Returns the unit vector from the middle of the panel `one` to the middle of the panel `other`.
fn direction(scene: &Scene, one: usize, other: usize) -> Option<[f64; 3]> {
    let [from, to] = [one, other].map(|panel| middle(scene, panel));
    unit([0, 1, 2].map(|k| to[k] - from[k]))
}

/// Returns the mean position of the particles of a panel, in m.
fn middle(scene: &Scene, panel: usize) -> [f64; 3] {
    let particles = scene.panels[panel].particles();
    let count = particles.len() as f64;
    let positions = particles.map(|particle| place(scene, particle));
    positions.fold([0.0; 3], |sum, point| [0, 1, 2].map(|k| sum[k] + point[k] / count))
}

/// Returns the pairs of panels of `scene` that seams join, the lower number first.
fn sewn_pairs(scene: &Scene) -> BTreeSet<[usize; 2]> {
    let stitches = scene.sewing.iter().flat_map(|sewing| &sewing.pairs.pairs);
    let pairs = stitches.map(|stitch| {
        let [one, other] = stitch.map(|particle| {
            let after = scene.panels.partition_point(|panel| panel.first <= particle as usize);
            after.saturating_sub(1)
        });
        [one.min(other), one.max(other)]
    });
    pairs.filter(|[one, other]| one != other).collect()
}

/// Returns whether `surfaces` at `positions`, in m, cross or touch. Returns `false` if the
/// positions are refused.
fn crosses(surfaces: &mut StartSurfaces, positions: &[f64]) -> bool {
    let crossings = surfaces.contact.intersections(positions).map(|found| found.len());
    match crossings {
        Ok(0) => surfaces
            .contact
            .detect(positions)
            .is_ok_and(|pairs| pairs.summary().min_distance < DistanceGrowth::START_DISTANCE_MIN),
        Ok(_) => true,
        Err(_) => false,
    }
}

/// Returns the pairs of panels that cross or touch, or `None` if two parts cross that must stay
/// where they are. Panels may be moved if `sewn` joins them or they lie in one plane, and no pin
/// holds them.
fn crossing_pairs(
    scene: &Scene,
    surfaces: &mut StartSurfaces,
    sewn: &BTreeSet<[usize; 2]>,
) -> Option<Vec<[usize; 2]>> {
    let positions = &scene.start.positions;
    if !crosses(surfaces, positions) {
        return Some(Vec::new());
    }
    let overlaps = overlaps(&mut surfaces.contact, positions, &surfaces.names);
    let touching = overlaps
        .first
        .iter()
        .filter(|overlap| overlap.distance < DistanceGrowth::START_DISTANCE_MIN);
    let pairs: Option<BTreeSet<[usize; 2]>> = touching
        .map(|overlap| {
            let [one, other] = [0, 1].map(|k| panel_number(scene, &overlap.parts[k]));
            let [one, other] = [one?, other?];
            let pair = [one.min(other), one.max(other)];
            let is_beside = sewn.contains(&pair) || in_one_plane(scene, pair);
            (is_beside && !pair.into_iter().any(|panel| is_pinned(scene, panel))).then_some(pair)
        })
        .collect();
    pairs.filter(|pairs| !pairs.is_empty()).map(|pairs| pairs.into_iter().collect())
}

/// Returns the number of the panel with `name`, or `None` if `name` is a body's.
fn panel_number(scene: &Scene, name: &str) -> Option<usize> {
    scene.panels.iter().position(|panel| panel.name == name)
}

/// Returns whether a pin holds a particle of the panel with the number `panel`.
fn is_pinned(scene: &Scene, panel: usize) -> bool {
    let particles = scene.panels[panel].particles();
    scene.pins.iter().flat_map(|pin| &pin.particles).any(|particle| particles.contains(particle))
}
