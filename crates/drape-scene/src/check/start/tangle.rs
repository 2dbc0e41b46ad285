//! Tangled starts: surfaces are to be apart at the start as they are after every step.

use std::collections::{BTreeMap, BTreeSet};

use drape_collide::{PairDistance, Surface, SurfaceContact, SurfacePairs};
use drape_input::{Subject, counted};

use crate::check::checker::Checker;
use crate::check::start::place_key::place_key;
use crate::scene::Scene;
use crate::scene::contact::DistanceGrowth;
use crate::surfaces::StartSurfaces;
use crate::tangle::Overlap;

/// Largest number of pairs of triangles that are listed.
const PAIRS_MAX: usize = 1000;

/// Number of pairs that the message names.
const OVERLAPS_TOLD: usize = 5;

/// Remedy against any tangled start.
const APART: &str = "move or turn panels and bodies apart";

/// Tangled start.
pub(crate) struct Tangled {
    pub(crate) overlaps: Overlaps,
    /// Index of the mistake about it.
    pub(crate) mistake: usize,
}

/// Checks that surfaces are apart at the start; if not, adds a mistake and returns the pairs that
/// are too near.
pub(crate) fn check_tangle(
    checker: &mut Checker<'_>,
    surfaces: &mut StartSurfaces,
    scene: &Scene,
) -> Option<Tangled> {
    let positions = &scene.start.positions[..];
    let mut help = APART;
    let grows = scene.contact.growth.is_some();
    let contact = &mut surfaces.contact;
    let crossings = contact.intersections(positions).map(|found| found.len());
    let fault = match (crossings, contact.detect(positions).map(SurfacePairs::summary)) {
        (Ok(0), Ok(near)) if grows && near.min_distance >= DistanceGrowth::START_DISTANCE_MIN => {
            let shrunk = contact.setup().and_then(|mut setup| setup.shrink_distances(positions));
            return shrunk.err().and_then(|error| {
                checker.fail("panel", error.to_string(), APART);
                None
            });
        }
        (Ok(0), Ok(near)) if grows => {
            let [distance, least] = [near.min_distance, DistanceGrowth::START_DISTANCE_MIN];
            format!("surfaces start {distance:.3e} m apart, and contact.grow needs {least:e} m")
        }
        (Ok(0), Ok(near)) if near.min_ratio < 1.0 => {
            help =
                "move or turn panels and bodies apart, or let what is kept grow with contact.grow";
            let [distance, kept] = [near.min_distance, near.min_distance / near.min_ratio];
            format!("surfaces start {distance:.3e} m apart, where {kept:.3e} m is kept")
        }
        (Ok(0), Ok(_)) => return None,
        (Ok(count), _) if count > 0 => "surfaces cross at the start".into(),
        (Err(error), _) | (_, Err(error)) => {
            checker.fail("panel", error.to_string(), APART);
            return None;
        }
        (Ok(_), Ok(_)) => return None,
    };
    let overlaps = overlaps(contact, positions, &surfaces.names);
    let total = overlaps.total;
    if overlaps.first.iter().any(|overlap| is_of_two_garments(scene, overlap)) {
        help = "give the garment that is worn outside a higher layer, or move or turn panels apart";
    }
    // One place of each two parts.
    let mut parts = BTreeSet::new();
    let first = overlaps.first.iter().filter(|overlap| parts.insert(&overlap.parts));
    let told = first.take(OVERLAPS_TOLD).map(|overlap| {
        let [a, b] = &overlap.parts;
        // Adding 0 takes the sign of a rounded zero.
        let [x, y, z] = overlap.place.map(|x| (1e4 * x).round() / 1e4 + 0.0);
        format!("\"{a}\" and \"{b}\" near ({x:.4}, {y:.4}, {z:.4}) m")
    });
    let told: Vec<String> = told.collect();
    let pairs = counted(total, "pair", "pairs");
    let fault = format!("{fault}, in {pairs} of triangles: {}", told.join("; "));
    let parts = overlaps.first.iter().flat_map(|overlap| &overlap.parts);
    let panel = |name: &String| scene.panels.iter().find(|panel| panel.name == *name);
    let panel = parts.filter_map(panel).next();
    let key = panel.map_or("panel".into(), |panel| place_key(checker, scene, panel));
    let mistake = checker.fail(&key, fault, help);
    if let Some(panel) = panel {
        checker.about(mistake, Subject::Panel(panel.name.clone()));
    }
    Some(Tangled { overlaps, mistake })
}

/// Returns whether two triangles are of panels of different garments.
fn is_of_two_garments(scene: &Scene, overlap: &Overlap) -> bool {
    let garment =
        |name: &String| scene.garment_of(scene.panels.iter().find(|panel| panel.name == *name)?);
    let [one, other] = &overlap.parts;
    matches!((garment(one), garment(other)), (Some(one), Some(other)) if one != other)
}

/// Two primitives that cross or are too near.
struct Near {
    /// Their vertices.
    vertices: [Vec<u32>; 2],
    /// Distance, in m; 0 if they cross.
    distance: f64,
}

/// Pairs of triangles that cross or are too near.
pub(crate) struct Overlaps {
    /// The first of them.
    pub(crate) first: Vec<Overlap>,
    /// Number of all.
    pub(crate) total: usize,
}

/// Finds the pairs of triangles of a surface that cross or are nearer than their minimum
/// separation, with the names of its groups.
pub(crate) fn overlaps(
    contact: &mut SurfaceContact,
    positions: &[f64],
    names: &[String],
) -> Overlaps {
    let found = contact.intersections(positions).map(<[_]>::to_vec).unwrap_or_default();
    let contact = &*contact;
    let surface = contact.surface();
    let places: Vec<f64> =
        positions.iter().chain(contact.state().body_positions()).copied().collect();
    let at = |vertex: u32| {
        let first = 3 * vertex as usize;
        [places[first], places[first + 1], places[first + 2]]
    };
    let crossing = found.iter().map(|crossing| {
        let edge = surface.edges()[crossing.edge as usize].to_vec();
        let triangle = surface.triangles()[crossing.triangle as usize].to_vec();
        Near { vertices: [edge, triangle], distance: 0.0 }
    });
    let near = contact.pairs().below_min_separation().map(|PairDistance { pair, distance }| {
        let (one, other) = pair.vertices.split_at(pair.first_vertex_count());
        Near { vertices: [one.to_vec(), other.to_vec()], distance }
    });
    let near: Vec<Near> = crossing.chain(near).collect();
    let owners = owners(surface, &near);
    let mut pairs: BTreeSet<[u32; 2]> = BTreeSet::new();
    let mut overlaps = Vec::new();
    for Near { vertices: [one, other], distance } in &near {
        for (a, b) in
            owners(one).iter().flat_map(|a| owners(other).into_iter().map(move |b| (*a, b)))
        {
            if pairs.insert([a.min(b), a.max(b)]) {
                let group = |triangle: u32| {
                    surface
                        .group(surface.triangles()[triangle as usize][0])
                        .map_or(0, |group| group as usize)
                };
                let corners = |triangle: u32| surface.triangles()[triangle as usize].map(at);
                let place = |ends: &[[f64; 3]]| match distance {
                    0.0 => pierced(ends, corners(b)),
                    _ => middle(ends),
                };
                let ends: Vec<[f64; 3]> = one.iter().map(|&vertex| at(vertex)).collect();
                let place = place(&ends);
                let mut triangles = [a, b];
                triangles.sort_by_key(|&triangle| group(triangle));
                overlaps.push(Overlap {
                    parts: triangles.map(|t| names.get(group(t)).cloned().unwrap_or_default()),
                    place,
                    distance: *distance,
                    triangles,
                    corners: triangles.map(corners),
                });
            }
        }
    }
    // One of each two parts first, so that the first few tell of all that is wrong.
    let mut told = BTreeSet::new();
    overlaps.sort_by_key(|overlap| !told.insert(overlap.parts.clone()));
    let total = overlaps.len();
    overlaps.truncate(PAIRS_MAX);
    Overlaps { first: overlaps, total }
}

/// Returns a function that finds the triangles which have all of some vertices.
fn owners<'a>(surface: &'a Surface, near: &[Near]) -> impl Fn(&[u32]) -> Vec<u32> + use<'a> {
    let vertices: BTreeSet<u32> = near.iter().flat_map(|near| near.vertices.concat()).collect();
    let mut at_vertex = BTreeMap::<u32, Vec<u32>>::new();
    for (number, triangle) in surface.triangles().iter().enumerate() {
        for corner in triangle.iter().filter(|corner| vertices.contains(corner)) {
            at_vertex.entry(*corner).or_default().push(number as u32);
        }
    }
    move |vertices| {
        let first = vertices.first().and_then(|first| at_vertex.get(first));
        let all = |t: &&u32| vertices.iter().all(|v| surface.triangles()[**t as usize].contains(v));
        first.into_iter().flatten().filter(all).copied().collect()
    }
}

fn middle(places: &[[f64; 3]]) -> [f64; 3] {
    let sum = |axis: usize| places.iter().map(|place| place[axis]).sum::<f64>();
    [0, 1, 2].map(|axis| sum(axis) / places.len() as f64)
}

/// Returns the point where a segment goes through the plane of a triangle; its middle if it lies in
/// it.
fn pierced(ends: &[[f64; 3]], [a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    let [p, q] = [ends[0], ends[ends.len() - 1]];
    let minus = |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|k| a[k] - b[k]);
    let (e, f) = (minus(b, a), minus(c, a));
    let normal = [0, 1, 2].map(|k: usize| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        e[i] * f[j] - e[j] * f[i]
    });
    let height = |place| minus(place, a).iter().zip(normal).map(|(x, n)| x * n).sum::<f64>();
    let (from, to) = (height(p), height(q));
    let part = from / (from - to);
    let part = if (0.0..=1.0).contains(&part) { part } else { 0.5 };
    [0, 1, 2].map(|axis| p[axis] + part * (q[axis] - p[axis]))
}
