//! Distance of two meshes with its pair and closest points, by branch and bound.

use super::boxes::divided;
use super::leaf::{LeafPair, NumberedLeaf, for_each_pair};
use super::mesh::ProximityMesh;
use super::primitive::{Primitive, PrimitivePair};
use crate::surface::{PairKind, closest, segment_meets_triangle};
use crate::vector::{Vector, add, cross, dot, scale, subtract};

/// Distance of two meshes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeshDistance {
    /// Distance, in m. It is 0 where the meshes intersect.
    pub distance: f64,
    /// The nearest primitives, or an edge and a triangle that intersect.
    pub pair: PrimitivePair,
    /// Nearest point of the first mesh and of the second, in m, each to the rounding of its
    /// coordinates.
    pub points: [[f64; 3]; 2],
}

/// Returns the distance of the meshes `first` and `second`: the smallest distance of a point of one
/// from a point of the other, on triangles, edges or points.
///
/// A mesh is its surface. A mesh within a closed mesh has a distance from it too. If several pairs
/// are equally near, the pair is one of them, and always the same one. The distance is exact to
/// rounding: branch and bound over both trees leaves out only pairs that are farther apart than the
/// nearest pair. One thread works.
///
/// # Examples
///
/// ```
/// use drape_collide::{ProximityMesh, mesh_distance};
///
/// let triangle = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
/// let first = ProximityMesh::new(&triangle, &[[0, 1, 2]])?;
/// let above = triangle.map(|[x, y, z]| [x + 0.1, y + 0.1, z + 0.25]);
/// let second = ProximityMesh::new(&above, &[[0, 1, 2]])?;
///
/// let nearest = mesh_distance(&first, &second);
/// assert_eq!(nearest.distance, 0.25);
/// assert_eq!(nearest.points[1][2] - nearest.points[0][2], 0.25);
/// # Ok::<(), drape_collide::Error>(())
/// ```
#[must_use]
pub fn mesh_distance(first: &ProximityMesh, second: &ProximityMesh) -> MeshDistance {
    let meshes = [first, second];
    let trees = meshes.map(ProximityMesh::tree);
    let boxes = meshes.map(ProximityMesh::boxes);
    let bound = |[a, b]: [u32; 2]| boxes[0][a as usize].squared_distance(&boxes[1][b as usize]);
    let positions = meshes.map(ProximityMesh::positions);
    let mut nearest = Nearest::new(meshes);

    // The nearer of two pairs of nodes is divided first.
    let mut open = vec![(bound([0, 0]), [0, 0])];
    while let Some((square, nodes)) = open.pop() {
        if square >= nearest.square {
            continue;
        }
        let node_boxes = [0, 1].map(|mesh| &boxes[mesh][nodes[mesh] as usize]);
        match divided(trees, nodes, node_boxes) {
            Some(below) => {
                let [one, two] = below.map(|nodes| (bound(nodes), nodes));
                open.extend(if one.0 <= two.0 { [two, one] } else { [one, two] });
            }
            None => {
                let numbers = [0, 1].map(|mesh| trees[mesh].item(nodes[mesh]));
                if let [Some(a), Some(b)] = numbers {
                    let leaves = [first.leaf(a), second.leaf(b)];
                    if square == 0.0 {
                        nearest.take_intersection(leaves, positions);
                    }
                    for_each_pair(leaves, |pair| nearest.take(pair, positions));
                }
            }
        }
    }
    nearest.answer
}

/// Nearest pair so far.
struct Nearest {
    answer: MeshDistance,
    square: f64,
}

impl Nearest {
    /// Returns the first vertices of `meshes` at an infinite distance. Every pair is nearer.
    fn new(meshes: [&ProximityMesh; 2]) -> Nearest {
        let [first, second] = [Primitive::Vertex(0); 2];
        let answer = MeshDistance {
            distance: f64::INFINITY,
            pair: PrimitivePair { first, second },
            points: meshes.map(|mesh| mesh.positions()[0]),
        };
        Nearest { answer, square: f64::INFINITY }
    }

    /// Takes `pair` of meshes at `positions` if it is nearer.
    fn take(&mut self, pair: LeafPair, positions: [&[Vector]; 2]) {
        let points = pair.points(positions);
        let closest = closest(pair.kind, points);
        let square = dot(closest.offset, closest.offset);
        if square < self.square {
            self.square = square;
            self.answer.distance = square.sqrt();
            self.answer.pair = pair.primitives;
            // Weights of the second primitive are negative.
            let mut ends = [[0.0; 3]; 2];
            for ((mesh, weight), point) in pair.meshes.into_iter().zip(closest.weights).zip(points)
            {
                ends[mesh] = add(ends[mesh], scale(point, weight.abs()));
            }
            self.answer.points = ends;
        }
    }

    /// Takes an edge of one of `leaves` that intersects the triangle of the other, if there is one.
    fn take_intersection(&mut self, leaves: [NumberedLeaf<'_>; 2], positions: [&[Vector]; 2]) {
        if self.square > 0.0
            && let Some((pair, point)) = intersection(leaves, positions, false)
        {
            let (distance, points) = (0.0, [point; 2]);
            self.answer = MeshDistance { distance, pair, points };
            self.square = 0.0;
        }
    }
}

/// Returns the edge of one of `leaves` and the triangle of the other that intersect at `positions`,
/// with a common point, if there are such. With `of_one_mesh`, both leaves are of one mesh, and an
/// edge with a corner of the triangle is left out.
pub(super) fn intersection(
    leaves: [NumberedLeaf<'_>; 2],
    positions: [&[Vector]; 2],
    of_one_mesh: bool,
) -> Option<(PrimitivePair, Vector)> {
    for mesh in 0..2 {
        let face = leaves[1 - mesh];
        let [a, _, c] = face.leaf.corners;
        let is_triangle = matches!(face.primitive(), Primitive::Triangle(_)) && a != c;
        let corners = face.leaf.corners.map(|corner| positions[1 - mesh][corner as usize]);
        for edge in leaves[mesh].leaf.edges().filter(|_| is_triangle) {
            if of_one_mesh && edge.iter().any(|end| face.leaf.corners.contains(end)) {
                continue;
            }
            let ends = edge.map(|end| positions[mesh][end as usize]);
            if segment_meets_triangle(ends, corners) {
                let pair = [Primitive::Edge(edge), face.primitive()];
                let primitives = PrimitivePair { first: pair[mesh], second: pair[1 - mesh] };
                return Some((primitives, crossing(ends, corners)));
            }
        }
    }
    None
}

/// Returns the point at which the segment between `p` and `q` crosses the plane of a triangle, or
/// the nearest point of the segment if all lie in one plane.
fn crossing([p, q]: [Vector; 2], [a, b, c]: [Vector; 3]) -> Vector {
    let normal = cross(subtract(b, a), subtract(c, a));
    let [over_p, over_q] = [p, q].map(|end| dot(normal, subtract(end, a)));
    let fraction = over_p / (over_p - over_q);
    if fraction.is_finite() {
        return add(scale(p, 1.0 - fraction), scale(q, fraction));
    }
    let candidates = [[a, b], [b, c], [c, a]].map(|[from, to]| {
        let closest = closest(PairKind::EdgeEdge, [p, q, from, to]);
        let [s, t, ..] = closest.weights;
        (dot(closest.offset, closest.offset), add(scale(p, s), scale(q, t)))
    });
    candidates.into_iter().fold((f64::INFINITY, p), |a, b| if b.0 < a.0 { b } else { a }).1
}
