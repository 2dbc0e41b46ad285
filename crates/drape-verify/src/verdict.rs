//! Verdict on one frame: tests all pairs of triangles that the grid finds.

use std::path::PathBuf;

use drape_frames::Frame;
use rayon::prelude::*;
use serde::Serialize;

use crate::distance::{point_segment, triangle_distance};
use crate::grid::{Aabb, Grid};
use crate::inside::{EnclosedPiece, enclosed};
use crate::intersection::{folded_flat, has_area, segment_intersects, triangles_intersect};
use crate::joints::{CLOSED, Joints};
use crate::mesh::{Mesh, PartNumber};
use crate::triangle::{EDGES, Triangle, joined};

/// Number of triangles that one thread tests at a time.
const CHUNK: usize = 512;

/// Largest number of pairs that a verdict lists.
const LISTED_MAX: usize = 10;

/// Relative rounding error of a distance that is allowed below the minimum separation.
///
/// Corners have 16 digits, and a separation is a ten-thousandth of a coordinate or more.
const ROUNDING: f64 = 1e-9;

/// Result of testing one frame.
///
/// ```
/// # let folder = tempfile::tempdir()?;
/// # std::fs::write(folder.path().join("surfaces.json"), r#"{ "format": 1, "guarded": true, "panels": [
/// #     { "name": "sheet", "vertices": 3, "triangles": 1 } ], "bodies": [] }
/// # "#)?;
/// # let frame = "v 0 0 0\nv 0 0 1\nv 1 0 0\nvt 0 0\nvt 0 1\nvt 1 0\nf 1 2 3\n";
/// # std::fs::write(folder.path().join("frame-00000.obj"), frame)?;
/// let verdict = drape_verify::Verifier::open(folder.path())?.verify(0)?;
/// assert!(verdict.holds());
/// assert_eq!((verdict.triangles, verdict.pairs, verdict.intersections), (1, 0, 0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Verdict {
    /// Number of the frame.
    pub number: usize,
    /// File of the frame.
    pub file: PathBuf,
    /// Time of the frame where the file gives it, in s.
    pub time: Option<f64>,
    /// Growth fraction of the minimum separation that the file gives, 0 to 1: less than 1 while the
    /// separation still grows.
    #[serde(rename = "grown")]
    pub growth: f64,
    /// Number of triangles of cloth and bodies.
    pub triangles: usize,
    /// Number of pairs whose bounding boxes overlap; all others are disjoint.
    pub pairs: usize,
    /// Number of pairs that intersect where they are not joined. Touching counts, and so do the two sides
    /// of a seam that is open by more than 0.1 mm.
    pub intersections: usize,
    /// Number of exempt pairs that intersect: they are of the two sides of a seam that counts as closed,
    /// within 0.1 mm, before its vertices are one point.
    #[serde(rename = "exempt_intersections")]
    pub exempt: usize,
    /// Widest gap of the seams at these pairs, in m; no side is deeper in the other. 0 without such a
    /// pair.
    pub exempt_depth: f64,
    /// Pieces of cloth that lie wholly inside a body.
    pub enclosed: Vec<EnclosedPiece>,
    /// Number of triangles without an area.
    pub degenerate: usize,
    /// Number of pairs closer than the minimum separation.
    pub too_near: usize,
    /// Smallest distance of a pair within its activation distance, in m; none without such a pair.
    pub min_distance: Option<f64>,
    /// Worst pairs: those that intersect, then those closest relative to their minimum separation.
    pub worst: Vec<ClosePair>,
}

/// Two triangles of a frame that intersect or are within their activation distance.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ClosePair {
    /// Panels or bodies of the two triangles.
    pub parts: [PartNumber; 2],
    /// Numbers of the triangles in their parts, from 0.
    pub triangles: [usize; 2],
    /// Midpoint of the closest points, or mean of all corners of two that intersect, in m.
    #[serde(rename = "place")]
    pub point: [f64; 3],
    /// Distance of the two, in m; 0 if they intersect.
    pub distance: f64,
    /// Minimum separation of the two, in m; 0 where nothing was promised.
    #[serde(rename = "kept")]
    pub min_separation: f64,
}

impl Verdict {
    /// Returns whether no pair intersects or is too close, no triangle is degenerate, and no piece of
    /// cloth is inside a body.
    #[must_use]
    pub fn holds(&self) -> bool {
        let faults = self.intersections + self.degenerate + self.too_near;
        faults == 0 && self.enclosed.is_empty()
    }
}

/// Findings in a part of the pairs.
#[derive(Debug, Default)]
struct Found {
    pairs: usize,
    intersections: usize,
    exempt: usize,
    exempt_depth: f64,
    degenerate: usize,
    too_near: usize,
    min_distance: Option<f64>,
    worst: Vec<ClosePair>,
}

impl Found {
    /// Returns the findings joined with those in later pairs.
    fn with(mut self, other: Found) -> Found {
        self.pairs += other.pairs;
        self.intersections += other.intersections;
        self.exempt += other.exempt;
        self.exempt_depth = self.exempt_depth.max(other.exempt_depth);
        self.degenerate += other.degenerate;
        self.too_near += other.too_near;
        let least = self.min_distance.into_iter().chain(other.min_distance).min_by(f64::total_cmp);
        self.min_distance = least;
        self.worst.extend(other.worst);
        self.sort();
        self
    }

    fn sort(&mut self) {
        let relative = |pair: &ClosePair| match pair.min_separation {
            separation if separation > 0.0 => pair.distance / separation,
            _ => pair.distance,
        };
        // The sort is stable: of equal pairs the first stays first.
        self.worst.sort_by(|a, b| relative(a).total_cmp(&relative(b)));
        self.worst.truncate(LISTED_MAX);
    }
}

/// State to be tested: the mesh and the positions of its vertices, in m.
struct State<'a> {
    mesh: &'a Mesh,
    positions: &'a [[f64; 3]],
    /// Vertices that are one point.
    joints: Joints,
    /// Vertices of closed seams, merged or about to be.
    closed: Joints,
    /// Growth fraction of the minimum separation, 0 to 1.
    growth: f64,
}

/// Distances of a pair, in m.
struct Limits {
    activation_distance: f64,
    min_separation: f64,
}

/// Tests all pairs of triangles of a frame but those of bodies with bodies.
pub(crate) fn verify(mesh: &Mesh, frame: Frame) -> Verdict {
    let Frame { number, file, time, growth, cloth, bodies, .. } = frame;
    let positions = [cloth, bodies].concat();
    let [joints, closed] = [0.0, CLOSED].map(|gap| mesh.sewn.joined_within(gap, &positions));
    let enclosed = enclosed(mesh, &joints, &positions);
    let found = State { mesh, positions: &positions, joints, closed, growth }.search();
    Verdict {
        number,
        file,
        time,
        growth,
        triangles: mesh.triangles(),
        pairs: found.pairs,
        intersections: found.intersections,
        exempt: found.exempt,
        exempt_depth: found.exempt_depth,
        enclosed,
        degenerate: found.degenerate,
        too_near: found.too_near,
        min_distance: found.min_distance,
        worst: found.worst,
    }
}

impl State<'_> {
    fn search(&self) -> Found {
        let mesh = self.mesh;
        let halves = mesh.parts().iter().map(|part| part.half_activation_distance);
        let margin = halves.fold(0.0, f64::max);
        let boxes = (0..mesh.triangles()).map(|t| Aabb::around(self.corners(t), margin));
        let grid = Grid::new(boxes.collect());
        let numbers: Vec<usize> = (0..mesh.triangles()).collect();
        let chunks = numbers.par_chunks(CHUNK).map(|chunk| {
            let mut found = Found::default();
            for &triangle in chunk {
                found.degenerate += usize::from(!has_area(self.corners(triangle)));
                grid.each_following(triangle, |other| self.pair([triangle, other], &mut found));
            }
            found.sort();
            found
        });
        let chunks: Vec<Found> = chunks.collect();
        chunks.into_iter().fold(Found::default(), Found::with)
    }

    fn corners(&self, triangle: usize) -> [[f64; 3]; 3] {
        self.mesh.triangles[triangle].map(|vertex| self.positions[vertex as usize])
    }

    /// Returns two triangles of the frame, with their vertices numbered by given joints.
    fn triangles(&self, pair: [usize; 2], joints: &Joints) -> [Triangle; 2] {
        pair.map(|triangle| Triangle {
            corners: self.corners(triangle),
            vertices: self.mesh.triangles[triangle].map(|vertex| joints.vertex(vertex)),
        })
    }

    /// Tests a pair and adds it to the findings.
    fn pair(&self, pair: [usize; 2], found: &mut Found) {
        if pair.iter().all(|&triangle| self.mesh.is_body(triangle)) {
            return;
        }
        found.pairs += 1;
        let triangles = self.triangles(pair, &self.closed);
        if intersect(triangles) {
            found.intersections += 1;
            let corners = || triangles.iter().flat_map(|triangle| triangle.corners);
            let middle = [0, 1, 2].map(|axis| corners().map(|x| x[axis]).sum::<f64>() / 6.0);
            found.worst.push(self.listed(pair, middle, [0.0; 2]));
        } else {
            let separate = self.triangles(pair, &self.joints);
            let is_closing = separate.map(|own| own.vertices) != triangles.map(|own| own.vertices);
            if is_closing && intersect(separate) {
                found.exempt += 1;
                found.exempt_depth = found.exempt_depth.max(seam_gap(triangles));
            } else {
                self.measure(pair, separate, found);
            }
        }
        if found.worst.len() > 100 * LISTED_MAX {
            found.sort();
        }
    }

    /// Adds a disjoint pair to the findings if it is within its activation distance.
    fn measure(&self, pair: [usize; 2], triangles: [Triangle; 2], found: &mut Found) {
        let [one, other] = triangles;
        let closest = triangle_distance(one, other);
        let distance = closest.distance();
        let parts = pair.map(|triangle| self.mesh.part[triangle] as usize);
        let [a, b] = parts.map(|part| &self.mesh.parts()[part]);
        let mut limits = Limits {
            activation_distance: a.half_activation_distance + b.half_activation_distance,
            min_separation: a.half_min_separation + b.half_min_separation,
        };
        if pair.iter().any(|&triangle| self.mesh.is_body(triangle)) {
            limits.min_separation *= self.mesh.pinch_fraction;
        }
        let sewn = pair.map(|triangle| self.mesh.sewn_vertices(triangle));
        if joined(&sewn[0], &sewn[1]) && !joined(&one.vertices, &other.vertices) {
            // The sides of a seam that closes come as near to each other as it is open.
            limits.min_separation = 0.0;
        }
        if !(distance < limits.activation_distance) {
            return;
        }
        if parts[0] == parts[1] {
            // Two points of one part that are close at rest repel each other only below half of their rest
            // distance, and keep only a quarter of it.
            let [one, other] = [0, 1]
                .map(|k| Triangle { corners: self.mesh.rest_corners(pair[k]), ..triangles[k] });
            let rest = triangle_distance(one, other).distance();
            limits.activation_distance = limits.activation_distance.min(0.5 * rest);
            limits.min_separation = limits.min_separation.min(0.25 * rest);
        }
        limits.min_separation *= self.growth;
        let too_near = distance < limits.min_separation * (1.0 - ROUNDING);
        found.too_near += usize::from(too_near);
        if distance < limits.activation_distance || too_near {
            let least = found.min_distance.map_or(distance, |least| least.min(distance));
            found.min_distance = Some(least);
            let [p, q] = closest.points;
            let middle = [0, 1, 2].map(|axis| 0.5 * (p[axis] + q[axis]));
            found.worst.push(self.listed(pair, middle, [distance, limits.min_separation]));
        }
    }

    fn listed(
        &self,
        pair: [usize; 2],
        point: [f64; 3],
        [distance, min_separation]: [f64; 2],
    ) -> ClosePair {
        let mut located = pair.map(|triangle| self.mesh.locate(triangle));
        located.sort_unstable();
        let parts = located.map(|location| location.part);
        let triangles = located.map(|location| location.triangle);
        ClosePair { parts, triangles, point, distance, min_separation }
    }
}

/// Returns whether two triangles intersect elsewhere than where they are joined.
fn intersect([one, other]: [Triangle; 2]) -> bool {
    if !joined(&one.vertices, &other.vertices) {
        return triangles_intersect(one.corners, other.corners);
    }
    // Two that share an edge do so only if they lie on each other in one plane.
    if let Some([apex, of_other]) = one.apexes(&other) {
        let edge = EDGES[(apex + 1) % 3].map(|k| one.corners[k]);
        return folded_flat(edge, [one.corners[apex], other.corners[of_other]]);
    }
    // Where they are not joined, an edge of one of them intersects the other.
    [(one, other), (other, one)].into_iter().any(|(triangle, of)| {
        EDGES.into_iter().any(|edge| {
            !joined(&edge.map(|k| triangle.vertices[k]), &of.vertices)
                && segment_intersects(edge.map(|k| triangle.corners[k]), of.corners)
        })
    })
}

/// Returns the widest gap of the seams that join two triangles, in m.
fn seam_gap([one, other]: [Triangle; 2]) -> f64 {
    let corner = |of: &Triangle, number: u32| {
        let place = of.vertices.iter().position(|vertex| vertex.number == number);
        place.map(|place| of.corners[place])
    };
    let gaps = [(&one, &other), (&other, &one)].into_iter().flat_map(|(triangle, of)| {
        triangle.corners.into_iter().zip(triangle.vertices).filter_map(move |(point, vertex)| {
            let twin = corner(of, vertex.number).map(|twin| [twin; 2]);
            let edge = || {
                let [a, b] = vertex.between?;
                Some([corner(of, a)?, corner(of, b)?])
            };
            Some(point_segment(point, twin.or_else(edge)?).distance())
        })
    });
    gaps.fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::triangle::Vertex;

    #[test]
    fn vertices_tied_to_an_edge_intersect_its_triangle_only_elsewhere() {
        let plain = |number| Vertex { number, between: None };
        let tied = |number| Vertex { number, between: Some([0, 1]) };
        let edge = [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0]];
        let whole = |apex: [f64; 3]| Triangle {
            corners: [edge[0], edge[1], apex],
            vertices: [0, 1, 2].map(plain),
        };
        let [one, two] = [[1.0, 0.0, 0.0], [2.0, 0.0, 0.0]];
        // With an edge, or with a corner, on an edge of the first.
        let along = Triangle {
            corners: [one, two, [1.5, -1.0, 0.5]],
            vertices: [tied(3), tied(4), plain(5)],
        };
        let hung = |a: [f64; 3], b: [f64; 3]| Triangle {
            corners: [one, a, b],
            vertices: [tied(3), plain(5), plain(6)],
        };
        let flat = whole([1.5, 2.0, 0.0]);
        assert!(!intersect([flat, along]) && !intersect([along, flat]));
        // In one plane and on each other they do not intersect; only the seam is near.
        let above = Triangle { corners: [one, two, [1.5, 1.0, 0.0]], ..along };
        assert!(!intersect([flat, above]) && triangle_distance(flat, above).distance() < 1e-12);
        let apart = hung([0.5, 1.0, 0.2], [1.5, 1.0, 0.2]);
        assert!(!intersect([flat, apart]) && !intersect([apart, flat]));
        let through = hung([1.0, 1.0, 0.2], [1.5, 1.0, -0.2]);
        assert!(intersect([flat, through]) && intersect([through, flat]));
        // An untied triangle at the same position touches.
        let untied = Triangle { vertices: [7, 8, 9].map(plain), ..along };
        assert!(intersect([flat, untied]));
        let own = [tied(3)];
        assert!(joined(&own, &flat.vertices) && !joined(&own, &flat.vertices[1..]));
    }
}
