//! Panels that are moved apart: patterns of other programs have panels that overlap by millimetres at
//! the seams between them, and panels that start a few centimetres inside a body.
//!
//! A panel in a body is moved along its normal until it is outside. Two panels of a garment that cross,
//! and are sewn to each other or in one plane, are moved away from each other, each by half of the way.
//! What needs a longer way stays where it is, and is a mistake of the scene.

use std::collections::{BTreeMap, BTreeSet};

use crate::scene::Scene;
use crate::scene::contact::DistanceGrowth;
use crate::scene::garment::Garment;
use crate::surfaces::StartSurfaces;

use super::placing::{CLEAR, Solids};
use super::tangle::overlaps;

/// Longest way on which a panel is moved out of a body, in m, and the step of the ways that are tried.
const WAY_MAX: f64 = 0.08;
const WAY_STEP: f64 = 0.0025;

/// Fraction of a garment that may be inside a body: where more is, the place of the garment is wrong.
const INSIDE_MAX: f64 = 0.1;

/// Largest distance of a flat panel from its plane, in m.
const FLAT: f64 = 1e-3;

/// Longest way on which a panel is moved away from others, in m, and the step by which two part, which is
/// far above the distance that is kept between surfaces.
const PART_MAX: f64 = 0.015;
const PART_STEP: f64 = 0.001;

/// Largest number of steps, for panels that push each other to and fro.
const PART_ROUNDS: usize = 60;

/// Moves panels out of the bodies that they are in by little; returns a note on each.
pub(crate) fn leave_bodies(scene: &mut Scene) -> Vec<String> {
    let Some(solids) = Solids::new(scene.bodies.iter().map(|moving| &moving.body)) else {
        return Vec::new();
    };
    let mut ways: Vec<(usize, [f64; 3])> = Vec::new();
    for garment in scene.garments.iter().filter(|garment| is_movable(scene, garment)) {
        let panels = panels_of(scene, garment);
        let inside = panels.iter().flat_map(|&panel| scene.panels[panel].particles());
        let count =
            inside.filter(|&particle| solids.distance(place(scene, particle)) < 0.0).count();
        if count > 0 && count as f64 <= INSIDE_MAX * garment.particles.len() as f64 {
            let out = |&panel: &usize| Some((panel, way_out(scene, &solids, panel)?));
            ways.extend(panels.iter().filter_map(out));
        }
    }
    let note = |&(panel, way): &(usize, [f64; 3])| note(scene, panel, way, "out of a body");
    let notes = ways.iter().map(note).collect();
    ways.into_iter().for_each(|(panel, way)| shift(scene, panel, way));
    notes
}

/// Moves panels apart that cross at a seam or in one plane; returns a note on each.
pub(crate) fn part_panels(scene: &mut Scene, surfaces: &mut StartSurfaces) -> Vec<String> {
    if !crosses(surfaces, &scene.start.positions) {
        return Vec::new();
    }
    let before = scene.start.positions.clone();
    let Some(ways) = part(scene, surfaces) else {
        scene.start.positions = before;
        return Vec::new();
    };
    let note =
        |(panel, way): (&usize, &[f64; 3])| note(scene, *panel, *way, "away from panels beside it");
    ways.iter().map(note).collect()
}

/// Ways of panels by their numbers, in m.
type Ways = BTreeMap<usize, [f64; 3]>;

/// Moves panels apart in the lines of their middles, and returns their ways; or none where they would have
/// to go too far.
fn part(scene: &mut Scene, surfaces: &mut StartSurfaces) -> Option<Ways> {
    let sewn = sewn_pairs(scene);
    let mut ways = Ways::new();
    let mut go = |scene: &mut Scene, panel: usize, way: [f64; 3]| {
        shift(scene, panel, way);
        let all = ways.entry(panel).or_default();
        *all = [0, 1, 2].map(|axis| all[axis] + way[axis]);
        length(*all) <= PART_MAX
    };
    for _ in 0..PART_ROUNDS {
        let pairs = crossing_pairs(scene, surfaces, &sewn)?;
        if pairs.is_empty() {
            go_on(scene, surfaces, &mut ways);
            return Some(ways);
        }
        for [one, other] in pairs {
            let along = line(scene, one, other)?;
            for (panel, sign) in [(one, -0.5), (other, 0.5)] {
                if !go(scene, panel, along.map(|x| sign * PART_STEP * x)) {
                    return None;
                }
            }
        }
    }
    None
}

/// Moves panels on by half of a step, so that they are not only just apart, unless that makes others cross.
fn go_on(scene: &mut Scene, surfaces: &mut StartSurfaces, ways: &mut Ways) {
    let before = scene.start.positions.clone();
    let longer = |way: &[f64; 3]| {
        let factor = 1.0 + 0.5 * PART_STEP / length(*way).max(PART_STEP);
        way.map(|x| factor * x)
    };
    let further: Ways = ways.iter().map(|(&panel, way)| (panel, longer(way))).collect();
    for (panel, way) in &further {
        let all = ways[panel];
        shift(scene, *panel, [0, 1, 2].map(|axis| way[axis] - all[axis]));
    }
    match crosses(surfaces, &scene.start.positions) {
        true => scene.start.positions = before,
        false => *ways = further,
    }
}

/// Returns whether the panels of a garment may be moved: nothing holds them, and bodies do not grow into
/// them.
fn is_movable(scene: &Scene, garment: &Garment) -> bool {
    let held = |particle: &usize| garment.particles.contains(particle);
    scene.contact.inflation.is_none()
        && !scene.pins.iter().any(|pin| pin.particles.iter().any(held))
}

fn panels_of(scene: &Scene, garment: &Garment) -> Vec<usize> {
    let own = |panel: &usize| garment.particles.contains(&scene.panels[*panel].first);
    (0..scene.panels.len()).filter(own).collect()
}

fn place(scene: &Scene, particle: usize) -> [f64; 3] {
    [0, 1, 2].map(|axis| scene.start.positions[3 * particle + axis])
}

fn length(way: [f64; 3]) -> f64 {
    way.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Moves a panel by a way, in m.
fn shift(scene: &mut Scene, panel: usize, way: [f64; 3]) {
    for particle in scene.panels[panel].particles() {
        for (axis, x) in way.iter().enumerate() {
            scene.start.positions[3 * particle + axis] += x;
        }
    }
}

/// Describes a panel that was moved by a way, in m.
fn note(scene: &Scene, panel: usize, way: [f64; 3], why: &str) -> String {
    let [x, y, z] = way.map(|x| 1e3 * x + 0.0);
    format!(
        "panel \"{}\" starts {:.1} mm, ({x:.1}, {y:.1}, {z:.1}) mm, from its place in the pattern, {why}",
        scene.panels[panel].name,
        1e3 * length(way)
    )
}

/// Returns the shortest way along the normal of a flat panel, in m, on which it leaves the bodies that it
/// is in.
fn way_out(scene: &Scene, solids: &Solids<'_>, panel: usize) -> Option<[f64; 3]> {
    let particles = scene.panels[panel].particles();
    let own = scene.cloth.triangles().iter();
    let own = own.filter(|triangle| particles.contains(&(triangle[0] as usize)));
    let middles = own.map(|corners| {
        let [a, b, c] = corners.map(|corner| place(scene, corner as usize));
        [0, 1, 2].map(|axis| (a[axis] + b[axis] + c[axis]) / 3.0)
    });
    let points: Vec<[f64; 3]> =
        particles.clone().map(|particle| place(scene, particle)).chain(middles).collect();
    let is_clear = |way: [f64; 3]| {
        let moved = |point: &[f64; 3]| [0, 1, 2].map(|axis| point[axis] + way[axis]);
        points.iter().all(|point| solids.distance(moved(point)) > CLEAR)
    };
    if is_clear([0.0; 3]) {
        return None;
    }
    let normal = normal(scene, panel)?;
    let steps = (WAY_MAX / WAY_STEP).round() as usize;
    let mut ways = (1..=steps).flat_map(|k| [1.0, -1.0].map(|sign| sign * k as f64 * WAY_STEP));
    let way = ways.find(|way| is_clear(normal.map(|x| way * x)))?;
    Some(normal.map(|x| way * x))
}

/// Returns the unit normal of a flat panel.
fn normal(scene: &Scene, panel: usize) -> Option<[f64; 3]> {
    let particles = scene.panels[panel].particles();
    let own = scene.cloth.triangles().iter();
    let own = own.filter(|triangle| particles.contains(&(triangle[0] as usize)));
    let mut sum = [0.0; 3];
    for corners in own {
        let [a, b, c] = corners.map(|corner| place(scene, corner as usize));
        let (e, f) = ([0, 1, 2].map(|k| b[k] - a[k]), [0, 1, 2].map(|k| c[k] - a[k]));
        for (k, component) in sum.iter_mut().enumerate() {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            *component += e[i] * f[j] - e[j] * f[i];
        }
    }
    let normal = unit(sum)?;
    let height =
        |particle| place(scene, particle).iter().zip(normal).map(|(x, n)| x * n).sum::<f64>();
    let heights = particles.map(height);
    let [low, high] =
        heights.fold([f64::MAX, f64::MIN], |[low, high], x| [low.min(x), high.max(x)]);
    (high - low <= FLAT).then_some(normal)
}

/// Returns whether two panels of a garment are flat and in one plane.
fn in_one_plane(scene: &Scene, [one, other]: [usize; 2]) -> bool {
    let garments = [one, other].map(|panel| scene.garment_of(&scene.panels[panel]));
    let (Some(normal), true) = (normal(scene, one), garments[0] == garments[1]) else {
        return false;
    };
    let first = place(scene, scene.panels[one].first);
    let height = |particle| {
        let arm = place(scene, particle);
        (0..3).map(|k| (arm[k] - first[k]) * normal[k]).sum::<f64>().abs()
    };
    garments[0].is_some() && scene.panels[other].particles().all(|own| height(own) <= FLAT)
}

fn unit(vector: [f64; 3]) -> Option<[f64; 3]> {
    let length = length(vector);
    (length > 1e-9).then(|| vector.map(|x| x / length))
}

/// Returns the direction from the middle of a panel to that of another.
fn line(scene: &Scene, one: usize, other: usize) -> Option<[f64; 3]> {
    let middle = |panel: usize| {
        let particles = scene.panels[panel].particles();
        let count = particles.len() as f64;
        let places = particles.map(|particle| place(scene, particle));
        places.fold([0.0; 3], |sum, own| [0, 1, 2].map(|k| sum[k] + own[k] / count))
    };
    let [from, to] = [one, other].map(middle);
    unit([0, 1, 2].map(|k| to[k] - from[k]))
}

/// Returns the pairs of panels that seams join, the lower number first.
fn sewn_pairs(scene: &Scene) -> BTreeSet<[usize; 2]> {
    let panel = |particle: u32| {
        scene.panels.partition_point(|panel| panel.first <= particle as usize).saturating_sub(1)
    };
    let pairs = scene.sewing.iter().flat_map(|sewing| &sewing.pairs.pairs);
    let pairs = pairs.map(|pair| {
        let [one, other] = pair.map(panel);
        [one.min(other), one.max(other)]
    });
    pairs.filter(|[one, other]| one != other).collect()
}

/// Returns whether surfaces cross or touch.
fn crosses(surfaces: &mut StartSurfaces, positions: &[f64]) -> bool {
    let crossings = surfaces.contact.intersections(positions).map(|found| found.len());
    let touches = |near: f64| near < DistanceGrowth::START_DISTANCE_MIN;
    match crossings {
        Ok(0) => {
            surfaces.contact.summary_at(positions).is_ok_and(|near| touches(near.min_distance))
        }
        Ok(_) => true,
        Err(_) => false,
    }
}

/// Returns the pairs of panels that cross or touch; or none if parts do that are to stay where they are.
fn crossing_pairs(
    scene: &Scene,
    surfaces: &mut StartSurfaces,
    sewn: &BTreeSet<[usize; 2]>,
) -> Option<Vec<[usize; 2]>> {
    let positions = &scene.start.positions;
    if !crosses(surfaces, positions) {
        return Some(Vec::new());
    }
    let is_held = |panel: usize| {
        let particles = scene.panels[panel].particles();
        scene.pins.iter().any(|pin| pin.particles.iter().any(|own| particles.contains(own)))
    };
    let found = overlaps(&mut surfaces.contact, positions, &surfaces.names);
    let touching =
        found.first.iter().filter(|own| own.distance < DistanceGrowth::START_DISTANCE_MIN);
    let number = |name: &String| scene.panels.iter().position(|panel| panel.name == *name);
    let pair = |parts: &[String; 2]| {
        let [one, other] = [number(&parts[0])?, number(&parts[1])?];
        let pair = [one.min(other), one.max(other)];
        let is_beside = sewn.contains(&pair) || in_one_plane(scene, pair);
        (is_beside && !pair.into_iter().any(is_held)).then_some(pair)
    };
    let pairs: Option<BTreeSet<[usize; 2]>> = touching.map(|own| pair(&own.parts)).collect();
    pairs.filter(|pairs| !pairs.is_empty()).map(|pairs| pairs.into_iter().collect())
}
