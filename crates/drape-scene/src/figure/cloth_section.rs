//! Section of a garment by a horizontal plane, with its length as worn and in the flat pattern.
//!
//! Panels are one surface where seams join them. If a seam ties a particle to a segment between two
//! other particles, the cuts on both sides of the seam end at one place and are joined there. The
//! length in the pattern is the length of the cut before deformation: the piece of each triangle is
//! drawn on the flat panel.

use std::collections::BTreeMap;

use drape_collide::equivalence_classes;
use drape_collide::section::{between, convex_hull, perimeter};

use crate::scene::Scene;

/// Distance within which cuts on both sides of a seam with ties end at the same place, in m.
const TIE_GAP: f64 = 1e-3;

/// Garment as a surface that can be cut.
#[derive(Debug, Clone)]
pub(super) struct Surface {
    triangles: Vec<[u32; 3]>,
    /// Class of each particle: particles that are sewn to each other have one class.
    class: Vec<u32>,
    /// Whether each particle is on a seam.
    is_sewn: Vec<bool>,
}

/// Connected section of a garment.
#[derive(Debug, Clone)]
pub(super) struct ClothSection {
    /// Length along the cloth, in m.
    pub(super) worn: f64,
    /// Length of the cut in the flat pattern, in m.
    pub(super) pattern: f64,
    /// Whether the section is a closed line.
    pub(super) is_closed: bool,
    /// Whether three layers or more meet in the section. The length then is not once round.
    pub(super) is_branched: bool,
    /// Straight pieces of the section, in x and z, in m.
    pub(super) pieces: Vec<[[f64; 2]; 2]>,
}

/// State of the cloth of a scene.
#[derive(Debug, Clone, Copy)]
pub struct ClothPlaces<'a> {
    /// Coordinates of the particles in their flat panels, in m.
    pub coordinates: &'a [[f64; 2]],
    /// Positions of the particles, three numbers each, in m.
    pub positions: &'a [f64],
}

/// Side of a triangle by the classes of its ends, in rising order.
type Side = [u32; 2];

/// Crossing of a side of a triangle by the plane.
struct Crossing {
    side: Side,
    /// Whether both ends of the side are sewn.
    is_sewn: bool,
    /// Place of the crossing in x and z, in m.
    place: [f64; 2],
    /// Place of the crossing in the flat panel, in m.
    flat: [f64; 2],
}

/// Piece of a section across a triangle.
struct Cut {
    sides: [Side; 2],
    /// Whether both ends of each side are sewn.
    is_sewn: [bool; 2],
    places: [[f64; 2]; 2],
    pattern: f64,
}

impl Surface {
    /// Returns the surface of the triangles of `scene` whose corners are in `particles`.
    pub(super) fn new(scene: &Scene, particles: &std::ops::Range<usize>) -> Self {
        let count = scene.cloth.particle_count();
        let mut is_sewn = vec![false; count];
        let none = Vec::new();
        let pairs = scene.sewing.as_ref().map_or(&none, |sewing| &sewing.pairs.pairs);
        pairs.iter().flatten().for_each(|&particle| is_sewn[particle as usize] = true);
        for tie in scene.sewing.iter().flat_map(|sewing| &sewing.pairs.ties) {
            let all = tie.ends.into_iter().chain([tie.particle]);
            all.for_each(|particle| is_sewn[particle as usize] = true);
        }
        let triangles = scene.cloth.triangles().iter();
        let triangles = triangles.filter(|corners| particles.contains(&(corners[0] as usize)));
        Self {
            triangles: triangles.copied().collect(),
            class: equivalence_classes(count, pairs).expect("pairs name particles"),
            is_sewn,
        }
    }

    /// Cuts the surface, as `cloth` is, at `height`, in m. Returns the connected sections.
    pub(super) fn sections(&self, cloth: ClothPlaces<'_>, height: f64) -> Vec<ClothSection> {
        let cuts: Vec<Cut> =
            self.triangles.iter().filter_map(|corners| self.cut(corners, cloth, height)).collect();

        // Ends of cuts on one side of a triangle are joined. Ends at one place of a seam with ties
        // are joined too.
        let mut at_side: BTreeMap<Side, Vec<(u32, usize)>> = BTreeMap::new();
        for (number, cut) in cuts.iter().enumerate() {
            for (end, side) in cut.sides.into_iter().enumerate() {
                at_side.entry(side).or_default().push((number as u32, end));
            }
        }
        let mut pairs: Vec<[u32; 2]> = Vec::new();
        let mut is_branched = vec![false; cuts.len()];
        for ends in at_side.values() {
            pairs.extend(ends.windows(2).map(|pair| [pair[0].0, pair[1].0]));
            if ends.len() > 2 {
                ends.iter().for_each(|&(cut, _)| is_branched[cut as usize] = true);
            }
        }
        let free = at_side.values().filter(|ends| ends.len() == 1).map(|ends| ends[0]);
        let open_ends = tied(&cuts, free.collect(), &mut pairs);

        // Sum up by classes.
        let class = equivalence_classes(cuts.len(), &pairs).expect("pairs name what they join");
        let mut sections: BTreeMap<u32, ClothSection> = BTreeMap::new();
        for ((cut, class), branched) in cuts.iter().zip(&class).zip(is_branched) {
            let section = sections.entry(*class).or_insert_with(ClothSection::empty);
            let [[a, b], [c, d]] = cut.places;
            section.worn += (c - a).hypot(d - b);
            section.pattern += cut.pattern;
            section.is_branched |= branched;
            section.pieces.push(cut.places);
        }
        for (cut, _) in open_ends {
            if let Some(section) = sections.get_mut(&class[cut as usize]) {
                section.is_closed = false;
            }
        }
        sections.into_values().collect()
    }

    /// Returns the cut through the triangle `corners` at `height`, in m, or `None` if the triangle
    /// lies above or below.
    fn cut(&self, corners: &[u32; 3], cloth: ClothPlaces<'_>, height: f64) -> Option<Cut> {
        let place = |particle: u32| {
            let [x, y, z] = [0, 1, 2].map(|axis| cloth.positions[3 * particle as usize + axis]);
            ([x, z], y - height)
        };
        let crossing = |k: usize| {
            let (a, b) = (corners[k], corners[(k + 1) % 3]);
            // The same ends in the same order give the same digits on both sides.
            let (a, b) =
                if self.class[a as usize] <= self.class[b as usize] { (a, b) } else { (b, a) };
            let ((from, low), (to, high)) = (place(a), place(b));
            ((low < 0.0) != (high < 0.0)).then(|| {
                let part = low / (low - high);
                let [flat_a, flat_b] = [a, b].map(|particle| cloth.coordinates[particle as usize]);
                let is_sewn = self.is_sewn[a as usize] && self.is_sewn[b as usize];
                Crossing {
                    side: [a, b].map(|particle| self.class[particle as usize]),
                    is_sewn,
                    place: between(from, to, part),
                    flat: between(flat_a, flat_b, part),
                }
            })
        };
        let crossings: Vec<Crossing> = (0..3).filter_map(crossing).collect();
        let [first, second] = &crossings[..] else { return None };
        let [[a, b], [c, d]] = [first.flat, second.flat];
        Some(Cut {
            sides: [first.side, second.side],
            is_sewn: [first.is_sewn, second.is_sewn],
            places: [first.place, second.place],
            pattern: (c - a).hypot(d - b),
        })
    }
}

impl ClothSection {
    fn empty() -> Self {
        let pieces = Vec::new();
        Self { worn: 0.0, pattern: 0.0, is_closed: true, is_branched: false, pieces }
    }

    /// Returns whether the section goes round the point (`x`, `z`).
    pub(super) fn encloses(&self, [x, z]: [f64; 2]) -> bool {
        let crossed = self.pieces.iter().filter(|[[ax, az], [bx, bz]]| {
            (*az > z) != (*bz > z) && x < ax + (z - az) / (bz - az) * (bx - ax)
        });
        crossed.count() % 2 == 1
    }

    /// Returns the length of the convex hull of the section, in m.
    pub(super) fn hull(&self) -> f64 {
        perimeter(&convex_hull(self.pieces.iter().flatten().copied().collect()))
    }
}

/// Joins `free` ends of `cuts` that lie at one place of a seam, the nearest first, and adds them to
/// `pairs`. Returns the ends that stay free.
fn tied(cuts: &[Cut], free: Vec<(u32, usize)>, pairs: &mut Vec<[u32; 2]>) -> Vec<(u32, usize)> {
    let place = |(cut, end): (u32, usize)| cuts[cut as usize].places[end];
    let is_sewn = |(cut, end): (u32, usize)| cuts[cut as usize].is_sewn[end];
    let (sewn, mut remaining): (Vec<_>, Vec<_>) = free.into_iter().partition(|end| is_sewn(*end));
    let mut near = Vec::new();
    for (k, one) in sewn.iter().enumerate() {
        for (m, other) in sewn.iter().enumerate().skip(k + 1) {
            let ([a, b], [c, d]) = (place(*one), place(*other));
            let distance = (c - a).hypot(d - b);
            if distance <= TIE_GAP {
                near.push((distance, k, m));
            }
        }
    }
    near.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut is_taken = vec![false; sewn.len()];
    for (_, k, m) in near {
        if !is_taken[k] && !is_taken[m] {
            (is_taken[k], is_taken[m]) = (true, true);
            pairs.push([sewn[k].0, sewn[m].0]);
        }
    }
    remaining.extend(sewn.iter().zip(is_taken).filter(|(_, taken)| !taken).map(|(end, _)| *end));
    remaining
}
