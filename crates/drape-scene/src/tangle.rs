use std::collections::BTreeSet;
use std::io::{self, Write};
use std::path::PathBuf;

use drape_collide::{PairDistance, PairKind, Surface, SurfaceContact};
use drape_input::Diagnostics;

use crate::growth::Growth;
use crate::reader::Reader;
use crate::scene::Scene;
use crate::surfaces::StartSurfaces;

/// Pairs of triangles that are listed at most.
const PAIRS_MAX: usize = 1000;

/// Pairs that the message tells of.
const OVERLAPS_TOLD: usize = 5;

/// What helps against any such start.
const APART: &str = "move or turn panels and bodies apart";

/// A start at which surfaces cross, or are nearer than they may ever be.
#[derive(Debug, Clone, PartialEq)]
pub struct Tangle {
    /// What is wrong with the scene.
    pub mistakes: Diagnostics,
    /// The folder for results that the scene asks for.
    pub folder: Option<PathBuf>,
    /// The pairs of triangles, of different parts first, up to 1000.
    pub overlaps: Vec<Overlap>,
    /// How many there are.
    pub total: usize,
}

/// Two triangles that cross or are too near.
#[derive(Debug, Clone, PartialEq)]
pub struct Overlap {
    /// The panels or bodies that they are of.
    pub parts: [String; 2],
    /// Where, in m.
    pub place: [f64; 3],
    /// Their distance, in m; 0 if they cross.
    pub distance: f64,
    /// Their numbers among all triangles, which tell them apart.
    pub triangles: [u32; 2],
    /// Their corners, in m.
    pub corners: [[[f64; 3]; 3]; 2],
}

impl Tangle {
    /// Writes each of the triangles once, as a PLY file in m. Those that cross are red, those too near are orange, and
    /// each has the number of its part in the order in which parts are named.
    ///
    /// # Errors
    /// What the writer fails with.
    pub fn write_ply(&self, mut to: impl Write) -> io::Result<()> {
        let mut parts: Vec<&str> = Vec::new();
        let mut seen = BTreeSet::new();
        let mut faces = Vec::new();
        for overlap in &self.overlaps {
            for k in 0..2 {
                let name = overlap.parts[k].as_str();
                let known = parts.iter().position(|part| *part == name);
                let part = known.unwrap_or(parts.len());
                if known.is_none() {
                    parts.push(name);
                }
                if seen.insert(overlap.triangles[k]) {
                    let colour = if overlap.distance == 0.0 { "220 30 30" } else { "240 150 30" };
                    faces.push((overlap.corners[k], colour, part));
                }
            }
        }
        writeln!(to, "ply\nformat ascii 1.0")?;
        for (number, part) in parts.iter().enumerate() {
            writeln!(to, "comment part {number}: {}", part.replace(char::is_control, " "))?;
        }
        writeln!(to, "element vertex {}", 3 * faces.len())?;
        writeln!(to, "property double x\nproperty double y\nproperty double z")?;
        writeln!(to, "element face {}", faces.len())?;
        writeln!(to, "property list uchar int vertex_indices")?;
        writeln!(to, "property uchar red\nproperty uchar green\nproperty uchar blue")?;
        writeln!(to, "property int part\nend_header")?;
        for [x, y, z] in faces.iter().flat_map(|(corners, ..)| corners) {
            writeln!(to, "{x:?} {y:?} {z:?}")?;
        }
        for (number, (_, colour, part)) in faces.iter().enumerate() {
            let first = 3 * number;
            writeln!(to, "3 {first} {} {} {colour} {part}", first + 1, first + 2)?;
        }
        Ok(())
    }
}

impl Reader<'_> {
    /// The start must keep what every step keeps; if not, the pairs that do not, and how many there are.
    pub(crate) fn tangle(
        &mut self,
        surfaces: &mut StartSurfaces,
        scene: &Scene,
    ) -> Option<(Vec<Overlap>, usize)> {
        let positions = &scene.positions[..];
        let mut help = APART;
        let grows = scene.contact.growth.is_some();
        let contact = &mut surfaces.contact;
        let crossings = contact.intersections(positions).map(|found| found.len());
        let fault = match (crossings, contact.summary_at(positions)) {
            (Ok(0), Ok(near)) if grows && near.min_distance >= Growth::NEAREST => {
                let shrunk = contact.shrink_distances(positions);
                return shrunk.err().and_then(|error| {
                    self.fail("panel", error.to_string(), APART);
                    None
                });
            }
            (Ok(0), Ok(near)) if grows => {
                let [distance, least] = [near.min_distance, Growth::NEAREST];
                format!("surfaces start {distance:.3e} m apart, and contact.grow needs {least:e} m")
            }
            (Ok(0), Ok(near)) if near.min_ratio < 1.0 => {
                help = "move or turn panels and bodies apart, or let what is kept grow with contact.grow";
                let [distance, kept] = [near.min_distance, near.min_distance / near.min_ratio];
                format!("surfaces start {distance:.3e} m apart, where {kept:.3e} m is kept")
            }
            (Ok(0), Ok(_)) => return None,
            (Ok(count), _) if count > 0 => format!("surfaces cross in {count} places at the start"),
            (Err(error), _) | (_, Err(error)) => {
                self.fail("panel", error.to_string(), APART);
                return None;
            }
            (Ok(_), Ok(_)) => return None,
        };
        let (overlaps, total) = overlaps(contact, positions, &surfaces.names);
        if overlaps.iter().any(|overlap| scene.is_of_two_garments(overlap)) {
            help = "give the garment that is worn outside a higher layer, or move or turn panels apart";
        }
        let told = overlaps.iter().take(OVERLAPS_TOLD).map(|overlap| {
            let ([a, b], [x, y, z]) = (&overlap.parts, overlap.place);
            format!("\"{a}\" and \"{b}\" near ({x:.4}, {y:.4}, {z:.4}) m")
        });
        let told: Vec<String> = told.collect();
        let more = match total.saturating_sub(told.len()) {
            0 => String::new(),
            more => format!("; and {more} more pairs of triangles"),
        };
        let fault = format!("{fault}: {}{more}", told.join("; "));
        self.fail("panel", fault, help);
        Some((overlaps, total))
    }
}

/// Two primitives by their vertices, with their distance, in m.
type Near = ([Vec<u32>; 2], f64);

/// The pairs of triangles of a surface that cross or are nearer than they keep, with how many there are. Parts are
/// named as the groups are numbered.
pub(crate) fn overlaps(
    contact: &SurfaceContact,
    positions: &[f64],
    names: &[String],
) -> (Vec<Overlap>, usize) {
    let surface = contact.surface();
    let places: Vec<f64> = positions.iter().chain(contact.body_positions()).copied().collect();
    let at = |vertex: u32| {
        let first = 3 * vertex as usize;
        [places[first], places[first + 1], places[first + 2]]
    };
    let found = contact.intersections(positions).unwrap_or_default();
    let crossing = found.iter().map(|crossing| {
        let edge = surface.edges()[crossing.edge as usize].to_vec();
        ([edge, surface.triangles()[crossing.triangle as usize].to_vec()], 0.0)
    });
    let near = contact.pairs_below_min_separation().map(|PairDistance { pair, distance }| {
        let first = if pair.kind == PairKind::VertexFace { 1 } else { 2 };
        let (one, other) = pair.vertices.split_at(first);
        ([one.to_vec(), other.to_vec()], distance)
    });
    let near: Vec<Near> = crossing.chain(near).collect();
    let owners = owners(surface, &near);
    let mut pairs: BTreeSet<[u32; 2]> = BTreeSet::new();
    let mut overlaps = Vec::new();
    for ([one, other], distance) in &near {
        for (a, b) in
            owners(one).iter().flat_map(|a| owners(other).into_iter().map(move |b| (*a, b)))
        {
            if pairs.insert([a.min(b), a.max(b)]) {
                let group = |triangle: u32| {
                    surface.group(surface.triangles()[triangle as usize][0]) as usize
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
    (overlaps, total)
}

/// The triangles that have all of some vertices.
fn owners<'a>(surface: &'a Surface, near: &[Near]) -> impl Fn(&[u32]) -> Vec<u32> + use<'a> {
    let vertices: BTreeSet<u32> = near.iter().flat_map(|(pair, _)| pair.concat()).collect();
    let mut at_vertex = std::collections::BTreeMap::<u32, Vec<u32>>::new();
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

/// Where a segment goes through the plane of a triangle; its middle if it lies in it.
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
