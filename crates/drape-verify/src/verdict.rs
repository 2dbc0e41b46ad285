//! Verdict on one frame: tests all pairs of triangles that the grid finds.

use std::path::PathBuf;

use drape_frames::Frame;
use rayon::prelude::*;
use serde::Serialize;

use crate::distance::{penetration, triangle_distance};
use crate::grid::{Aabb, Grid};
use crate::inside::{EnclosedPiece, enclosed};
use crate::intersection::{folded_flat, has_area, segment_intersects, triangles_intersect};
use crate::joints::Joints;
use crate::mesh::{Mesh, PartNumber};
use crate::triangle::{EDGES, Triangle, joined};

/// Largest number of pairs that a verdict lists.
const LISTED_MAX: usize = 10;

/// Result of testing one frame.
///
/// ```
/// # let folder = tempfile::tempdir()?;
/// # let corners = [[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]];
/// # drape_frames::samples::SampleRun::triangle(corners).write(folder.path())?;
/// let verdict = drape_verify::Verifier::open(folder.path())?.verify(0)?;
/// assert!(verdict.holds());
/// assert_eq!((verdict.triangles, verdict.pairs, verdict.intersections), (1, 0, 0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Verdict {
    /// Number of the frame.
    pub number: usize,
    /// File of the frame, or `None` for a frame in memory.
    pub file: Option<PathBuf>,
    /// Time of the frame, in s.
    pub time: f64,
    /// Growth fraction of the minimum separation in the frame, 0 to 1. The fraction is less
    /// than 1 while the separation still grows.
    #[serde(rename = "grown")]
    pub growth: f64,
    /// Number of triangles of cloth and bodies.
    pub triangles: usize,
    /// Number of pairs whose bounding boxes overlap. All other pairs are disjoint.
    pub pairs: usize,
    /// Number of pairs that intersect outside their joints. Pairs that touch count, and so do pairs
    /// from the two sides of a seam whose gap is wider than
    /// [`closed_gap`](drape_frames::Manifest::closed_gap).
    pub intersections: usize,
    /// Number of exempt pairs that intersect. Such a pair is from the two sides of a seam that is
    /// closed, within [`closed_gap`](drape_frames::Manifest::closed_gap), but whose vertices are
    /// not one point yet.
    #[serde(rename = "exempt_intersections")]
    pub exempt: usize,
    /// Largest depth of an exempt intersection, in m: the shortest distance by which an edge of one
    /// triangle would have to move to leave the other. It is at most the gap of a closed seam, and
    /// 0 if there is no exempt pair.
    pub exempt_penetration: f64,
    /// Pieces of cloth that lie wholly inside a body.
    pub enclosed: Vec<EnclosedPiece>,
    /// Number of triangles without an area.
    pub degenerate: usize,
    /// Number of pairs that are closer than the minimum separation.
    pub too_near: usize,
    /// Smallest distance of a pair within its activation distance, in m, or `None` if there is no
    /// such pair.
    pub min_distance: Option<f64>,
    /// At most ten pairs, first the pairs that intersect, then the pairs that are closest in
    /// relation to their minimum separation.
    pub worst: Vec<ClosePair>,
}

/// Two triangles of a frame that intersect or are within their activation distance.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ClosePair {
    /// Panels or bodies of the two triangles.
    pub parts: [PartNumber; 2],
    /// Numbers of the triangles in their parts, from 0.
    pub triangles: [usize; 2],
    /// Midpoint of the closest points, or mean of all corners of triangles that intersect, in m.
    #[serde(rename = "place")]
    pub point: [f64; 3],
    /// Distance of the two triangles, in m. 0 if they intersect.
    pub distance: f64,
    /// Minimum separation of the two triangles, in m. 0 if no distance was promised.
    #[serde(rename = "kept")]
    pub min_separation: f64,
}

impl Verdict {
    /// Returns `true` if no pair intersects or is too close, no triangle is degenerate, and no
    /// piece of cloth is inside a body.
    #[must_use]
    pub fn holds(&self) -> bool {
        let faults = self.intersections + self.degenerate + self.too_near;
        faults == 0 && self.enclosed.is_empty()
    }
}

/// Faults among a part of the pairs. The fields are explained at [`Verdict`].
#[derive(Debug, Default)]
struct Findings {
    pairs: usize,
    intersections: usize,
    exempt: usize,
    exempt_penetration: f64,
    degenerate: usize,
    too_near: usize,
    min_distance: Option<f64>,
    worst: Vec<ClosePair>,
}

impl Findings {
    /// Returns `self` with `other`, the findings among later pairs.
    fn merge(mut self, other: Findings) -> Findings {
        self.pairs += other.pairs;
        self.intersections += other.intersections;
        self.exempt += other.exempt;
        self.exempt_penetration = self.exempt_penetration.max(other.exempt_penetration);
        self.degenerate += other.degenerate;
        self.too_near += other.too_near;
        self.min_distance =
            self.min_distance.into_iter().chain(other.min_distance).min_by(f64::total_cmp);
        self.worst.extend(other.worst);
        self.keep_worst();
        self
    }

    /// Sorts `worst` and removes all but the first [`LISTED_MAX`] pairs.
    fn keep_worst(&mut self) {
        // The sort is stable, so that equal pairs keep their order.
        self.worst.sort_by(|a, b| a.relative_distance().total_cmp(&b.relative_distance()));
        self.worst.truncate(LISTED_MAX);
    }
}

impl ClosePair {
    /// Returns the distance over the minimum separation. Disjoint triangles without a promise come
    /// after the pairs that break theirs.
    fn relative_distance(&self) -> f64 {
        match (self.min_separation > 0.0, self.distance > 0.0) {
            (true, _) => self.distance / self.min_separation,
            (false, true) => 1.0 + self.distance,
            (false, false) => 0.0,
        }
    }
}

/// Frame whose pairs are tested.
struct TestedFrame<'a> {
    mesh: &'a Mesh,
    /// Positions of the vertices of cloth and bodies, in m.
    positions: &'a [[f64; 3]],
    /// Joints of the vertices that are one point.
    joints: Joints,
    /// Joints of the seams that are closed, whose vertices are merged or will be.
    closed: Joints,
    /// Growth fraction of the minimum separation, 0 to 1.
    growth: f64,
}

/// Distances that a run promises for a pair, in m.
struct PromisedDistances {
    activation_distance: f64,
    min_separation: f64,
}

/// Tests all pairs of triangles of `frame`, except pairs of two bodies.
pub(crate) fn verify(mesh: &Mesh, frame: Frame) -> Verdict {
    let Frame { number, file, time, growth_fraction: growth, cloth, bodies, .. } = frame;
    let positions = [cloth, bodies].concat();
    let [joints, closed] =
        [0.0, mesh.sewn.closed_gap].map(|gap| mesh.sewn.joined_within(gap, &positions));
    let enclosed = enclosed(mesh, &joints, &positions);
    let findings = TestedFrame { mesh, positions: &positions, joints, closed, growth }.search();

    Verdict {
        number,
        file,
        time,
        growth,
        triangles: mesh.triangle_count(),
        pairs: findings.pairs,
        intersections: findings.intersections,
        exempt: findings.exempt,
        exempt_penetration: findings.exempt_penetration,
        enclosed,
        degenerate: findings.degenerate,
        too_near: findings.too_near,
        min_distance: findings.min_distance,
        worst: findings.worst,
    }
}

impl TestedFrame<'_> {
    /// Tests all pairs whose bounding boxes overlap. The result does not depend on the number of
    /// threads.
    fn search(&self) -> Findings {
        /// Number of triangles that one thread tests at a time.
        const CHUNK: usize = 512;

        // Two boxes that are enlarged by half the largest activation distance overlap if the
        // triangles are within it.
        let mesh = self.mesh;
        let halves = mesh.parts().iter().map(|part| part.half_activation_distance);
        let margin = halves.fold(0.0, f64::max);
        let boxes = (0..mesh.triangle_count()).map(|t| Aabb::around(self.corners(t), margin));
        let grid = Grid::new(boxes.collect());

        // The findings are merged in the order of the triangles.
        let numbers: Vec<usize> = (0..mesh.triangle_count()).collect();
        let chunks: Vec<Findings> = numbers
            .par_chunks(CHUNK)
            .map(|chunk| {
                let mut findings = Findings::default();
                for &triangle in chunk {
                    findings.degenerate += usize::from(!has_area(self.corners(triangle)));
                    grid.visit_following(triangle, |other| {
                        self.test([triangle, other], &mut findings);
                    });
                }
                findings.keep_worst();
                findings
            })
            .collect();
        chunks.into_iter().fold(Findings::default(), Findings::merge)
    }

    /// Returns the corners of triangle `triangle`, in m.
    fn corners(&self, triangle: usize) -> [[f64; 3]; 3] {
        self.mesh.triangles[triangle].map(|vertex| self.positions[vertex as usize])
    }

    /// Returns the triangles `pair`, with their vertices numbered by `joints`.
    fn triangles(&self, pair: [usize; 2], joints: &Joints) -> [Triangle; 2] {
        pair.map(|triangle| Triangle {
            corners: self.corners(triangle),
            vertices: self.mesh.triangles[triangle].map(|vertex| joints.vertex(vertex)),
        })
    }

    /// Tests the triangles `pair` and adds the result to `findings`.
    fn test(&self, pair: [usize; 2], findings: &mut Findings) {
        if pair.iter().all(|&triangle| self.mesh.is_body(triangle)) {
            return;
        }
        findings.pairs += 1;

        // The sides of a closed seam are first taken as joined. A pair that intersects only if they
        // are separate is exempt, and the run keeps no distance between features that are joined.
        let triangles = self.triangles(pair, &self.closed);
        if intersect(triangles) {
            findings.intersections += 1;
            let corners = triangles.iter().flat_map(|triangle| triangle.corners);
            let middle = [0, 1, 2].map(|axis| corners.clone().map(|x| x[axis]).sum::<f64>() / 6.0);
            findings.worst.push(self.close_pair(pair, middle, [0.0; 2]));
        } else {
            let separate = self.triangles(pair, &self.joints);
            let is_closing = separate.map(|triangle| triangle.vertices)
                != triangles.map(|triangle| triangle.vertices);
            if is_closing && intersect(separate) {
                let depth = depth_of_intersection(separate);
                findings.exempt += 1;
                findings.exempt_penetration = findings.exempt_penetration.max(depth);
            } else {
                self.measure(pair, triangles, findings);
            }
        }

        // The list is shortened now and then, so that a frame of many faults needs little memory.
        if findings.worst.len() > 100 * LISTED_MAX {
            findings.keep_worst();
        }
    }

    /// Adds the disjoint triangles `pair` to `findings` if they are within their activation
    /// distance.
    fn measure(&self, pair: [usize; 2], triangles: [Triangle; 2], findings: &mut Findings) {
        /// Relative rounding error of a distance that is allowed below the minimum separation.
        ///
        /// Corners have 16 digits, and a separation is at least a ten-thousandth of a coordinate.
        const ROUNDING: f64 = 1e-9;

        let [first, second] = triangles;
        let closest = triangle_distance(first, second);
        let parts = pair.map(|triangle| self.mesh.part[triangle] as usize);
        let [a, b] = parts.map(|part| &self.mesh.parts()[part]);
        let mut promised = PromisedDistances {
            activation_distance: a.half_activation_distance + b.half_activation_distance,
            min_separation: a.half_min_separation + b.half_min_separation,
        };
        if !(closest.distance() < promised.activation_distance) {
            return;
        }
        if pair.iter().any(|&triangle| self.mesh.is_body(triangle)) {
            promised.min_separation *= self.mesh.pinch_fraction;
        }

        if parts[0] == parts[1] {
            // Two points of one part that are close at rest repel each other only below half of
            // their distance at rest, and the run promises only a quarter of this distance.
            let [first_at_rest, second_at_rest] = [0, 1]
                .map(|k| Triangle { corners: self.mesh.rest_corners(pair[k]), ..triangles[k] });
            let rest_distance = triangle_distance(first_at_rest, second_at_rest).distance();
            promised.activation_distance = promised.activation_distance.min(0.5 * rest_distance);
            promised.min_separation = promised.min_separation.min(0.25 * rest_distance);
        }
        promised.min_separation *= self.growth;

        // The sides of an open seam approach each other until the seam is closed. The promise holds
        // for the features that the seam does not join.
        let [first_sewn, second_sewn] = [0, 1].map(|k| Triangle {
            vertices: self.mesh.sewn_vertices(pair[k]),
            corners: triangles[k].corners,
        });
        let are_closed =
            [first.vertices, second.vertices] == [first_sewn.vertices, second_sewn.vertices];
        let kept = if are_closed { closest } else { triangle_distance(first_sewn, second_sewn) };
        let too_near = kept.distance() < promised.min_separation * (1.0 - ROUNDING);
        let (closest, min_separation) = if too_near || kept.distance() <= closest.distance() {
            (kept, promised.min_separation)
        } else {
            (closest, 0.0)
        };

        let distance = closest.distance();
        findings.too_near += usize::from(too_near);
        if distance < promised.activation_distance || too_near {
            let least = findings.min_distance.map_or(distance, |least| least.min(distance));
            findings.min_distance = Some(least);
            let [p, q] = closest.points;
            let middle = [0, 1, 2].map(|axis| 0.5 * (p[axis] + q[axis]));
            findings.worst.push(self.close_pair(pair, middle, [distance, min_separation]));
        }
    }

    /// Returns the triangles `pair` as an entry of the list of a verdict, lower part and number
    /// first.
    fn close_pair(
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

/// Returns whether the triangles `first` and `second` intersect outside their joints.
fn intersect([first, second]: [Triangle; 2]) -> bool {
    if !joined(&first.vertices, &second.vertices) {
        return triangles_intersect(first.corners, second.corners);
    }
    // Triangles that share an edge intersect only if they lie on each other in one plane.
    if let Some([first_apex, second_apex]) = first.apexes(&second) {
        let edge = EDGES[(first_apex + 1) % 3].map(|k| first.corners[k]);
        return folded_flat(edge, [first.corners[first_apex], second.corners[second_apex]]);
    }
    // Other joined triangles intersect if an edge of one, not joined to the second, intersects it.
    any_edge_intersects(&first, &second) || any_edge_intersects(&second, &first)
}

/// Returns whether an edge of `triangle` that is not joined to `other` intersects `other`.
fn any_edge_intersects(triangle: &Triangle, other: &Triangle) -> bool {
    intersecting_edges(triangle, other).next().is_some()
}

/// Returns the edges of `triangle` that intersect `other` and are not joined to it.
fn intersecting_edges<'a>(
    triangle: &'a Triangle,
    other: &'a Triangle,
) -> impl Iterator<Item = [[f64; 3]; 2]> + 'a {
    let free = EDGES.into_iter().filter(|edge| {
        let vertices = edge.map(|k| triangle.vertices[k]);
        !joined(&vertices, &other.vertices)
    });
    let edges = free.map(|edge| edge.map(|k| triangle.corners[k]));
    edges.filter(|&edge| segment_intersects(edge, other.corners))
}

/// Returns the largest depth of an edge of one of two triangles in the other, in m.
fn depth_of_intersection([first, second]: [Triangle; 2]) -> f64 {
    let depths =
        [(&first, &second), (&second, &first)].into_iter().flat_map(|(triangle, other)| {
            intersecting_edges(triangle, other).map(|edge| penetration(edge, other.corners))
        });
    depths.fold(0.0, f64::max)
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
        let vertex = [tied(3)];
        assert!(joined(&vertex, &flat.vertices) && !joined(&vertex, &flat.vertices[1..]));
    }
}
