//! Rings of cloth: what of a garment goes round its body at the start.
//!
//! A ring is an opening, which is a closed row of free edges such as a waist or a hem, or a
//! horizontal cut through panels that are sewn to each other all round. Its girth is its length
//! before deformation.
//!
//! A horizontal cut is a girth only where panels stand upright, as gores do and sleeves on
//! stretched arms do not. A panel stands upright if the mean of the gradient of the height over its
//! cloth has a length near 1: on a cylinder whose axis is tilted by `$\theta$` it is
//! `$\cos\theta$`.

use std::collections::{BTreeMap, BTreeSet};

use drape_collide::equivalence_classes;

use crate::scene::Scene;
use drape_collide::section::{SectionPlane, between};

/// Least mean gradient of the height over a panel that stands upright: its axis is within 30
/// degrees of the vertical.
const UPRIGHT: f64 = 0.86;

/// Closed line of cloth.
#[derive(Debug, Clone)]
pub(crate) struct Ring {
    /// Edges of an opening, or panels of a cut, each once, in order.
    pub(crate) parts: Vec<String>,
    /// Names of the seams that the ring goes across, each once, in order.
    pub(crate) seams: Vec<String>,
    /// Index of a panel that it goes through.
    pub(crate) panel: usize,
    /// Length before deformation, in m.
    pub(crate) girth: f64,
    /// Its points at the start, in m.
    pub(crate) points: Vec<[f64; 3]>,
    pub(crate) plane: SectionPlane,
}

impl Ring {
    /// Returns the ring moved by `shift`, in m.
    pub(crate) fn moved(&self, shift: [f64; 3]) -> Self {
        let moved = |point: &[f64; 3]| [0, 1, 2].map(|axis| point[axis] + shift[axis]);
        let points = self.points.iter().map(moved).collect();
        Self { points, plane: self.plane.shifted(shift), ..self.clone() }
    }
}

/// Cloth of a scene, prepared to be cut.
pub(crate) struct RingFinder<'a> {
    scene: &'a Scene,
    /// Sides of seams that each particle is on.
    seams: Vec<Vec<SeamSide>>,
    /// Triangles of each panel.
    triangles: Vec<Vec<[u32; 3]>>,
    /// Whether each panel stands upright.
    upright: Vec<bool>,
}

/// Side of a seam: the number of the seam, and whether it is the other side.
type SeamSide = (usize, bool);

/// Side of a triangle, by its ends in rising order.
type Side = [u32; 2];

/// Connected cut through a panel.
struct Cut {
    panel: usize,
    length: f64,
    points: Vec<[f64; 3]>,
    /// Sides of triangles at its ends.
    ends: Vec<Side>,
}

impl<'a> RingFinder<'a> {
    /// Prepares the cloth of `scene` to be cut.
    pub(crate) fn new(scene: &'a Scene) -> Self {
        let mut seams = vec![Vec::new(); scene.cloth.particle_count()];
        let all = scene.sewing.iter().flat_map(|sewing| &sewing.seams);
        for (number, seam) in all.enumerate() {
            for [one, other] in &seam.pairs.pairs {
                seams[*one as usize].push((number, false));
                seams[*other as usize].push((number, true));
            }
            // A tied particle is not on the side that it is tied to.
            let others = seam.pairs.pairs.iter().map(|[_, other]| *other);
            let others: BTreeSet<u32> = others.collect();
            for tie in &seam.pairs.ties {
                seams[tie.particle as usize].push((number, !others.contains(&tie.ends[0])));
            }
        }
        let mut triangles = vec![Vec::new(); scene.panels.len()];
        for triangle in scene.cloth.triangles() {
            let panel = scene.panels.partition_point(|panel| panel.first <= triangle[0] as usize);
            triangles[panel.saturating_sub(1)].push(*triangle);
        }
        let upright = triangles.iter().map(|triangles| stands_upright(scene, triangles)).collect();
        Self { scene, seams, triangles, upright }
    }

    /// Returns the rings at `height`, in m, of the `panels` of one garment.
    pub(crate) fn at_height(&self, panels: &[usize], height: f64) -> Vec<Ring> {
        let cuts: Vec<Cut> = panels.iter().flat_map(|&panel| self.cuts(panel, height)).collect();
        // Cuts that end at each seam.
        let mut joints: BTreeMap<usize, Vec<(usize, bool)>> = BTreeMap::new();
        let mut is_open = vec![false; cuts.len()];
        for (number, cut) in cuts.iter().enumerate() {
            for &end in &cut.ends {
                match self.seam_of(end) {
                    Some((seam, side)) => joints.entry(seam).or_default().push((number, side)),
                    None => is_open[number] = true,
                }
            }
        }

        // Two cuts that end at opposite sides of a seam are sewn into one line.
        let mut pairs = Vec::new();
        let mut seams: Vec<(usize, usize)> = Vec::new();
        for (seam, joint) in &joints {
            match joint[..] {
                // Cuts that end on the same side, such as those on both sides of a waist, do not
                // meet.
                [(one, side), (other, other_side)] if side != other_side => {
                    pairs.push([one as u32, other as u32]);
                    seams.push((one, *seam));
                }
                _ => joint.iter().for_each(|&(cut, _)| is_open[cut] = true),
            }
        }

        let class = equivalence_classes(cuts.len(), &pairs).expect("pairs name what they join");
        let mut rings: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
        class
            .iter()
            .enumerate()
            .for_each(|(cut, &class)| rings.entry(class).or_default().push(cut));
        let is_girth = |cut: usize| !is_open[cut] && self.upright[cuts[cut].panel];
        let closed = rings.into_values().filter(|ring| ring.iter().all(|&cut| is_girth(cut)));
        let ring = |ring: Vec<usize>| Ring {
            parts: unique(ring.iter().map(|&cut| self.scene.panels[cuts[cut].panel].name.clone())),
            seams: unique(
                seams
                    .iter()
                    .filter(|(cut, _)| ring.contains(cut))
                    .map(|&(_, seam)| self.seam_name(seam)),
            ),
            panel: cuts[ring[0]].panel,
            girth: ring.iter().map(|&cut| cuts[cut].length).sum(),
            points: ring.iter().flat_map(|&cut| cuts[cut].points.iter().copied()).collect(),
            plane: SectionPlane::horizontal(height),
        };
        closed.map(ring).collect()
    }

    /// Returns the side of a seam on which both ends `a` and `b` of a triangle's side lie.
    fn seam_of(&self, [a, b]: Side) -> Option<SeamSide> {
        let [a, b] = [a, b].map(|particle| &self.seams[particle as usize]);
        a.iter().find(|seam| b.contains(seam)).copied()
    }

    fn seam_name(&self, seam: usize) -> String {
        let mut seams = self.scene.sewing.iter().flat_map(|sewing| &sewing.seams);
        seams.nth(seam).map_or_else(String::new, |seam| seam.name.clone())
    }

    fn place(&self, particle: u32) -> [f64; 3] {
        [0, 1, 2].map(|axis| self.scene.start.positions[3 * particle as usize + axis])
    }

    /// Returns the connected cuts through `panel` at `height`, in m.
    fn cuts(&self, panel: usize, height: f64) -> Vec<Cut> {
        let coordinates = self.scene.cloth.coordinates();
        let depth = |particle: u32| self.place(particle)[1] - height;
        // Each cut of a triangle as the two sides that it is between.
        let mut segments: Vec<[Side; 2]> = Vec::new();
        for triangle in &self.triangles[panel] {
            let sides = [0, 1, 2].map(|k| [triangle[k], triangle[(k + 1) % 3]]);
            let cut = |[a, b]: &Side| (depth(*a) < 0.0) != (depth(*b) < 0.0);
            let found: Vec<Side> =
                sides.into_iter().filter(cut).map(|[a, b]| [a.min(b), a.max(b)]).collect();
            if let [one, other] = found[..] {
                segments.push([one, other]);
            }
        }
        let mut at_side: BTreeMap<Side, Vec<u32>> = BTreeMap::new();
        for (number, side) in segments.iter().flatten().enumerate() {
            at_side.entry(*side).or_default().push(number as u32 / 2);
        }
        let joined =
            at_side.values().filter_map(|segments| <[u32; 2]>::try_from(&segments[..]).ok());
        let class = equivalence_classes(segments.len(), &joined.collect::<Vec<_>>())
            .expect("pairs name what they join");
        let part = |[a, b]: Side| depth(a) / (depth(a) - depth(b));
        let on_cloth = |side: Side| {
            let [a, b] = side.map(|particle| coordinates[particle as usize]);
            between(a, b, part(side))
        };
        let in_space = |side: Side| {
            let [a, b] = side.map(|particle| self.place(particle));
            between(a, b, part(side))
        };
        let mut cuts: BTreeMap<u32, Cut> = BTreeMap::new();
        for (segment, class) in segments.iter().zip(class) {
            let empty = || Cut { panel, length: 0.0, points: Vec::new(), ends: Vec::new() };
            let cut = cuts.entry(class).or_insert_with(empty);
            let [[a, b], [c, d]] = segment.map(on_cloth);
            cut.length += (c - a).hypot(d - b);
            cut.points.extend(segment.map(in_space));
            cut.ends.extend(segment.iter().filter(|side| at_side[*side].len() == 1));
        }
        cuts.into_values().collect()
    }
}

/// Returns whether the panel of `triangles` stands upright.
fn stands_upright(scene: &Scene, triangles: &[[u32; 3]]) -> bool {
    let coordinates = scene.cloth.coordinates();
    let (mut sum, mut areas) = ([0.0; 2], 0.0);
    for triangle in triangles {
        let [[a, b], [c, d], [e, f]] = triangle.map(|corner| coordinates[corner as usize]);
        let [p, q, r] = triangle.map(|corner| scene.start.positions[3 * corner as usize + 1]);
        let twice_area = (c - a) * (f - b) - (e - a) * (d - b);
        // Gradient times twice the area.
        sum[0] += twice_area.signum() * ((q - p) * (f - b) - (r - p) * (d - b));
        sum[1] += twice_area.signum() * ((r - p) * (c - a) - (q - p) * (e - a));
        areas += twice_area.abs();
    }
    sum[0].hypot(sum[1]) > UPRIGHT * areas
}

/// Returns `names` without repetitions, in the order of their first occurrence.
fn unique(names: impl Iterator<Item = String>) -> Vec<String> {
    let mut seen = BTreeSet::new();
    names.filter(|name| seen.insert(name.clone())).collect()
}

/// Free edge of a panel.
struct FreeEdge {
    name: String,
    panel: usize,
    particles: Vec<u32>,
}

/// Returns the openings of the garments of `scene`.
pub(crate) fn openings(scene: &Scene) -> Vec<Ring> {
    let finder = RingFinder::new(scene);
    let none = Vec::new();
    let pairs = scene.sewing.as_ref().map_or(&none, |sewing| &sewing.pairs.pairs);
    let class = equivalence_classes(scene.cloth.particle_count(), pairs)
        .expect("pairs name what they join");
    let ends = |edge: &FreeEdge| {
        [edge.particles[0], edge.particles[edge.particles.len() - 1]].map(|p| class[p as usize])
    };
    let mut remaining = free_edges(scene);
    let mut rings = Vec::new();
    while !remaining.is_empty() {
        let first = remaining.remove(0);
        let [start, mut end] = ends(&first);
        let mut row = vec![first];
        while end != start
            && let Some(next) = remaining.iter().position(|edge| ends(edge).contains(&end))
        {
            let mut edge = remaining.remove(next);
            let [one, other] = ends(&edge);
            if one == end {
                end = other;
            } else {
                end = one;
                edge.particles.reverse();
            }
            row.push(edge);
        }
        if end == start {
            rings.extend(opening(&finder, &row));
        }
    }
    rings
}

/// Returns the ring of `row`, a closed row of edges.
fn opening(finder: &RingFinder<'_>, row: &[FreeEdge]) -> Option<Ring> {
    let scene = finder.scene;
    let ends = row.iter().flat_map(|edge| [edge.particles.first(), edge.particles.last()]);
    let sides = ends.flatten().flat_map(|&particle| &finder.seams[particle as usize]);
    let seams: BTreeSet<usize> = sides.map(|(seam, _)| *seam).collect();
    let coordinates = scene.cloth.coordinates();
    let length = |pair: &[u32]| {
        let [[a, b], [c, d]] = [pair[0], pair[1]].map(|particle| coordinates[particle as usize]);
        (c - a).hypot(d - b)
    };
    let place =
        |&particle: &u32| [0, 1, 2].map(|axis| scene.start.positions[3 * particle as usize + axis]);
    let points: Vec<[f64; 3]> =
        row.iter().flat_map(|edge| edge.particles.iter().map(place)).collect();
    Some(Ring {
        parts: unique(row.iter().map(|edge| edge.name.clone())),
        seams: unique(seams.into_iter().map(|seam| finder.seam_name(seam))),
        panel: row.first()?.panel,
        girth: row.iter().flat_map(|edge| edge.particles.windows(2).map(length)).sum(),
        plane: SectionPlane::through(&points)?,
        points,
    })
}

/// Returns the edges of panels of `scene` whose particles between the ends are not sewn.
fn free_edges(scene: &Scene) -> Vec<FreeEdge> {
    let mut sewn = vec![false; scene.cloth.particle_count()];
    if let Some(sewing) = &scene.sewing {
        sewing.pairs.pairs.iter().flatten().for_each(|&particle| sewn[particle as usize] = true);
        sewing.pairs.ties.iter().for_each(|tie| sewn[tie.particle as usize] = true);
    }
    let edges = scene.panels.iter().enumerate().flat_map(|(number, panel)| {
        panel.edges.iter().map(move |edge| FreeEdge {
            name: format!("{}.{}", panel.name, edge.name),
            panel: number,
            particles: edge.nodes.iter().map(|node| panel.first as u32 + node).collect(),
        })
    });
    let is_free = |edge: &FreeEdge| {
        let count = edge.particles.len();
        count > 2 && edge.particles[1..count - 1].iter().all(|&particle| !sewn[particle as usize])
    };
    edges.filter(is_free).collect()
}

#[cfg(test)]
mod tests {
    use drape_fabric::samples;
    use drape_input::Document;

    use super::*;

    const FABRIC: &str = samples::PLAIN_WEAVE;

    #[test]
    fn a_panel_within_30_degrees_of_the_vertical_stands_upright() {
        for (turn, upright) in [
            ("[0, 0, 40]", true),
            ("[-25, 0, 0]", true),
            ("[155, 60, 0]", true),
            ("[-35, 0, 0]", false),
            ("[35, 20, 0]", false),
            ("[-90, 0, 0]", false),
        ] {
            let text = format!(
                "fabric.plain.file = \"plain.toml\"\n[[panel]]\nname = \"towel\"\nfabric = \"plain\"\n\
                 rectangle = [0.1, 0.1]\nturn = {turn}\n[time]\nstep = 0.004\nend = 0.1\n"
            );
            let documents = [Document::new("plain.toml", FABRIC)];
            let scene = Scene::from_documents(&Document::new("towel.toml", text), &documents);
            let scene = scene.expect("it is right");
            assert_eq!(scene.cloth.particle_count(), 121);
            // Triangles of its own, and large ones of any shape and sense.
            let own = scene.cloth.triangles();
            for triangles in [own, &[[0, 15, 112], [27, 90, 53]], &[[112, 15, 0], [7, 40, 99]]] {
                assert_eq!(stands_upright(&scene, triangles), upright, "{turn}");
            }
        }
    }
}
