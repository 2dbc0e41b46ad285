use std::path::PathBuf;

use rayon::prelude::*;
use serde::Serialize;

use crate::distance::{Figure, SIDES, joined, triangles_apart};
use crate::grid::{Extent, Grid};
use crate::intersection::{has_area, segment_meets, triangles_meet};
use crate::mesh::{Mesh, PartNumber};

/// Triangles that one thread looks after at a time.
const CHUNK: usize = 512;

/// Places that a verdict names at most.
const PLACES_MAX: usize = 10;

/// Part of a distance that rounding may take from what a run keeps. It keeps the places of corners, which have 16
/// digits; a kept distance is a ten thousandth of a coordinate or more.
const ROUNDING: f64 = 1e-9;

/// What one frame was found to be.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Verdict {
    /// Number of the frame.
    pub number: usize,
    /// Its file.
    pub file: PathBuf,
    /// Its time, in s, where the file says it.
    pub time: Option<f64>,
    /// Part of the distances that the run keeps which it says that it kept by then: less than 1 while what surfaces keep
    /// grows.
    pub grown: f64,
    /// Triangles of cloth and bodies.
    pub triangles: usize,
    /// Pairs of triangles whose boxes come near each other; all others are apart.
    pub pairs: usize,
    /// Pairs that share no vertex and meet, or that share one and meet elsewhere. Touching counts.
    pub intersections: usize,
    /// Triangles of cloth without an area.
    pub degenerate: usize,
    /// Pairs nearer to each other than the run keeps them.
    pub too_near: usize,
    /// Smallest distance of a pair of triangles within the reach of its contact, in m; none if there is no such pair.
    pub min_distance: Option<f64>,
    /// The worst places: those that meet, then the nearest over what they should keep.
    pub worst: Vec<Place>,
}

/// Two triangles of a frame.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Place {
    /// The panels or bodies that they are of.
    pub parts: [PartNumber; 2],
    /// Their numbers there, from 0.
    pub triangles: [usize; 2],
    /// Half way between their nearest points, or the middle of all corners of two that meet, in m.
    pub place: [f64; 3],
    /// Their distance, in m; 0 if they meet.
    pub distance: f64,
    /// The distance that they should keep, in m; 0 where nothing was promised.
    pub kept: f64,
}

impl Verdict {
    /// Whether no surface meets or comes too near another.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.intersections == 0 && self.degenerate == 0 && self.too_near == 0
    }
}

/// What was found in a part of the pairs.
#[derive(Debug, Default)]
struct Found {
    pairs: usize,
    intersections: usize,
    degenerate: usize,
    too_near: usize,
    min_distance: Option<f64>,
    worst: Vec<Place>,
}

impl Found {
    /// Takes in what was found in pairs that come later.
    fn with(mut self, other: Found) -> Found {
        self.pairs += other.pairs;
        self.intersections += other.intersections;
        self.degenerate += other.degenerate;
        self.too_near += other.too_near;
        let least = self.min_distance.into_iter().chain(other.min_distance).min_by(f64::total_cmp);
        self.min_distance = least;
        self.worst.extend(other.worst);
        self.sort();
        self
    }

    fn sort(&mut self) {
        let badness = |place: &Place| match place.kept {
            kept if kept > 0.0 => place.distance / kept,
            _ => place.distance,
        };
        // A stable order: of equal ones the first pair.
        self.worst.sort_by(|a, b| badness(a).total_cmp(&badness(b)));
        self.worst.truncate(PLACES_MAX);
    }
}

/// One frame: a mesh and where its vertices are, in m.
pub(crate) struct Shape<'a> {
    pub(crate) mesh: &'a Mesh,
    pub(crate) places: &'a [[f64; 3]],
    /// Part of the distances that surfaces keep which they kept by then.
    pub(crate) grown: f64,
}

impl Shape<'_> {
    /// Looks at all pairs of triangles but those of bodies with bodies.
    pub(crate) fn verify(&self, (number, file, time): (usize, PathBuf, Option<f64>)) -> Verdict {
        let mesh = self.mesh;
        let reach = mesh.parts().iter().map(|part| part.reach).fold(0.0, f64::max);
        let extents = (0..mesh.triangles()).map(|t| Extent::around(self.corners(t), reach));
        let grid = Grid::new(extents.collect());
        let numbers: Vec<usize> = (0..mesh.triangles()).collect();
        let chunks = numbers.par_chunks(CHUNK).map(|chunk| {
            let mut found = Found::default();
            for &triangle in chunk {
                found.degenerate += usize::from(!has_area(self.corners(triangle)));
                grid.each_behind(triangle, |other| self.pair([triangle, other], &mut found));
            }
            found.sort();
            found
        });
        let chunks: Vec<Found> = chunks.collect();
        let found = chunks.into_iter().fold(Found::default(), Found::with);
        Verdict {
            number,
            file,
            time,
            grown: self.grown,
            triangles: mesh.triangles(),
            pairs: found.pairs,
            intersections: found.intersections,
            degenerate: found.degenerate,
            too_near: found.too_near,
            min_distance: found.min_distance,
            worst: found.worst,
        }
    }

    fn corners(&self, triangle: usize) -> [[f64; 3]; 3] {
        self.mesh.triangles[triangle].map(|vertex| self.places[vertex as usize])
    }

    fn pair(&self, pair: [usize; 2], found: &mut Found) {
        if pair.iter().all(|&triangle| self.mesh.is_body(triangle)) {
            return;
        }
        found.pairs += 1;
        let figures = pair.map(|triangle| Figure {
            corners: self.corners(triangle),
            vertices: self.mesh.vertices(triangle),
        });
        if meet(figures) {
            found.intersections += 1;
            let corners = || figures.iter().flat_map(|figure| figure.corners);
            let middle = [0, 1, 2].map(|axis| corners().map(|x| x[axis]).sum::<f64>() / 6.0);
            found.worst.push(self.place(pair, middle, [0.0; 2]));
        } else {
            self.nearness(pair, figures, found);
        }
        if found.worst.len() > 100 * PLACES_MAX {
            found.sort();
        }
    }

    /// Takes note of a pair that does not meet if it is within the reach of its contact.
    fn nearness(&self, pair: [usize; 2], figures: [Figure; 2], found: &mut Found) {
        let [one, other] = figures;
        let nearest = triangles_apart(one, other);
        let distance = nearest.distance();
        let parts = pair.map(|triangle| self.mesh.part[triangle] as usize);
        let [a, b] = parts.map(|part| &self.mesh.parts()[part]);
        let (mut reach, mut kept) = (a.reach + b.reach, a.separation + b.separation);
        if pair.iter().any(|&triangle| self.mesh.is_body(triangle)) {
            kept *= self.mesh.thinned;
        }
        if !(distance < reach) {
            return;
        }
        if parts[0] == parts[1] {
            // What lies close at rest is kept at a quarter of that distance only, and pushes below half of it.
            let [one, other] =
                [0, 1].map(|k| Figure { corners: self.mesh.at_rest(pair[k]), ..figures[k] });
            let rest = triangles_apart(one, other).distance();
            reach = reach.min(0.5 * rest);
            kept = kept.min(0.25 * rest);
        }
        kept *= self.grown;
        let too_near = distance < kept * (1.0 - ROUNDING);
        found.too_near += usize::from(too_near);
        if distance < reach || too_near {
            let least = found.min_distance.map_or(distance, |least| least.min(distance));
            found.min_distance = Some(least);
            let [p, q] = nearest.points;
            let middle = [0, 1, 2].map(|axis| 0.5 * (p[axis] + q[axis]));
            found.worst.push(self.place(pair, middle, [distance, kept]));
        }
    }

    fn place(&self, pair: [usize; 2], place: [f64; 3], [distance, kept]: [f64; 2]) -> Place {
        let mut located = pair.map(|triangle| self.mesh.locate(triangle));
        located.sort_unstable();
        let (parts, triangles) = (located.map(|l| l.0), located.map(|l| l.1));
        Place { parts, triangles, place, distance, kept }
    }
}

/// Whether two triangles meet elsewhere than where they are joined. Two that share a side can do so only if they lie in a
/// plane; their distance then shows it.
fn meet([one, other]: [Figure; 2]) -> bool {
    if !joined(&one.vertices, &other.vertices) {
        return triangles_meet(one.corners, other.corners);
    }
    // Where they are not joined, one of them has a side that meets the other.
    [(one, other), (other, one)].into_iter().any(|(figure, of)| {
        SIDES.into_iter().any(|side| {
            !joined(&side.map(|k| figure.vertices[k]), &of.vertices)
                && segment_meets(side.map(|k| figure.corners[k]), of.corners)
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::distance::Vertex;

    #[test]
    fn what_is_sewn_to_a_side_meets_it_only_elsewhere() {
        let plain = |number| Vertex { number, between: None };
        let sewn = |number| Vertex { number, between: Some([0, 1]) };
        let side = [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0]];
        let whole = |apex: [f64; 3]| Figure {
            corners: [side[0], side[1], apex],
            vertices: [0, 1, 2].map(plain),
        };
        let [one, two] = [[1.0, 0.0, 0.0], [2.0, 0.0, 0.0]];
        // With a side, or with a corner, on that of the first.
        let along = Figure {
            corners: [one, two, [1.5, -1.0, 0.5]],
            vertices: [sewn(3), sewn(4), plain(5)],
        };
        let hung = |a: [f64; 3], b: [f64; 3]| Figure {
            corners: [one, a, b],
            vertices: [sewn(3), plain(5), plain(6)],
        };
        let flat = whole([1.5, 2.0, 0.0]);
        assert!(!meet([flat, along]) && !meet([along, flat]));
        // In one plane and on each other they do not cross, and are near nothing but the seam.
        let above = Figure { corners: [one, two, [1.5, 1.0, 0.0]], ..along };
        assert!(!meet([flat, above]) && triangles_apart(flat, above).distance() < 1e-12);
        let apart = hung([0.5, 1.0, 0.2], [1.5, 1.0, 0.2]);
        assert!(!meet([flat, apart]) && !meet([apart, flat]));
        let through = hung([1.0, 1.0, 0.2], [1.5, 1.0, -0.2]);
        assert!(meet([flat, through]) && meet([through, flat]));
        // A stranger in the same place touches.
        let stranger = Figure { vertices: [7, 8, 9].map(plain), ..along };
        assert!(meet([flat, stranger]));
        let own = [sewn(3)];
        assert!(joined(&own, &flat.vertices) && !joined(&own, &flat.vertices[1..]));
    }
}
