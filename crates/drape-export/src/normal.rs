//! Normals: unit vectors across cloth and bodies at their vertices, for smooth shading.
//!
//! A normal is the sum of the area vectors of the triangles around a vertex, made a unit vector.
//! Vertices that are sewn together share a normal once they are at one position, so that no seam
//! shows as an edge. Bodies have creases, such as the edges of a cube: a vertex on a crease has a
//! normal for each side of it.

use std::collections::HashMap;

use drape_frames::Frame;
use drape_frames::vector::{area_vector, difference, dot, length, sum};

/// Cosine of the angle between two triangles of a body beyond which their edge is a crease: 40°.
/// Facets of a round body differ by less, the faces at an edge of a box by more.
const CREASE: f64 = 0.766;

/// Distance below which vertices that are sewn together are at one position, in m.
const AT_ONE_PLACE: f64 = 1e-6;

/// Unit vector. It points up where no triangle has an area, because some readers refuse vectors of
/// no length.
pub(crate) type Normal = [f32; 3];

/// Returns the normals of the vertices of the cloth in `frame`.
pub(crate) fn cloth_normals(
    frame: &Frame,
    triangles: &[[u32; 3]],
    seam_pairs: &[[u32; 2]],
) -> Vec<Normal> {
    let vectors = area_vectors(&frame.cloth, triangles, triangles, frame.cloth.len());

    // Vertices at one position are united; the root of their set has the sum of their vectors.
    let mut shared = vectors.clone();
    let mut parent: Vec<u32> = (0..vectors.len() as u32).collect();
    for &[a, b] in seam_pairs {
        let [at_a, at_b] = [a, b].map(|vertex| frame.cloth[vertex as usize]);
        let (a, b) = (root_of(&parent, a), root_of(&parent, b));
        if a != b && length(difference(at_a, at_b)) <= AT_ONE_PLACE {
            let vector_b = shared[b as usize];
            shared[a as usize] = sum(shared[a as usize], vector_b);
            parent[b as usize] = a;
        }
    }

    let normals = (0..vectors.len() as u32).map(|vertex| {
        let vector = vectors[vertex as usize];
        let shared = shared[root_of(&parent, vertex) as usize];
        // Panels that are sewn with opposite sides, or pressed open, keep their normals.
        unit(if dot(vector, shared) > 0.0 { shared } else { vector })
    });
    normals.collect()
}

/// Returns the root of the set of `vertex`. Each vertex has a `parent`, and a root is its parent.
fn root_of(parent: &[u32], mut vertex: u32) -> u32 {
    while parent[vertex as usize] != vertex {
        vertex = parent[vertex as usize];
    }
    vertex
}

/// Normals of a body: the vertex of each normal, and the normal of each corner of a triangle.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Creased {
    /// Vertex of each normal, in the order of the vertices. A vertex on a crease comes more than
    /// once.
    pub(crate) vertices: Vec<u32>,
    /// Numbers of the normals of the corners of each triangle.
    pub(crate) corners: Vec<[u32; 3]>,
}

impl Creased {
    /// Returns the creases of the body with `triangles` at `positions`.
    pub(crate) fn new(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Creased {
        let normals: Vec<[f64; 3]> = triangles
            .iter()
            .map(|corners| {
                let area = area_vector(corners.map(|corner| positions[corner as usize]));
                let size = length(area);
                if size > 0.0 { area.map(|part| part / size) } else { area }
            })
            .collect();
        // Triangles beside each edge.
        let mut edges: HashMap<[u32; 2], Vec<usize>> = HashMap::new();
        for (triangle, corners) in triangles.iter().enumerate() {
            for side in 0..3 {
                let [a, b] = [corners[side], corners[(side + 1) % 3]];
                edges.entry([a.min(b), a.max(b)]).or_default().push(triangle);
            }
        }

        // Corners of triangles that share a smooth edge are joined.
        let mut parent: Vec<usize> = (0..3 * triangles.len()).collect();
        for ([a, b], beside) in &edges {
            if let &[first, second] = &beside[..]
                && dot(normals[first], normals[second]) >= CREASE
            {
                for vertex in [*a, *b] {
                    let [first, second] = [first, second]
                        .map(|triangle| find(&mut parent, corner_of(triangles, triangle, vertex)));
                    // The smaller is the root, in whatever order the edges come.
                    parent[first.max(second)] = first.min(second);
                }
            }
        }

        // Each set of joined corners has a normal.
        let roots: Vec<usize> = (0..parent.len()).map(|corner| find(&mut parent, corner)).collect();
        let mut first: Vec<usize> = roots.clone();
        first.sort_unstable_by_key(|root| (vertex_of(triangles, *root), *root));
        first.dedup();
        let number: HashMap<usize, u32> = first.iter().copied().zip(0..).collect();
        Creased {
            vertices: first.into_iter().map(|corner| vertex_of(triangles, corner)).collect(),
            corners: roots
                .as_chunks()
                .0
                .iter()
                .map(|c: &[usize; 3]| c.map(|c| number[&c]))
                .collect(),
        }
    }

    /// Returns the normals of the body with `triangles` at `positions`.
    pub(crate) fn normals(&self, positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Vec<Normal> {
        let sums = area_vectors(positions, triangles, &self.corners, self.vertices.len());
        sums.into_iter().map(unit).collect()
    }
}

/// Returns the number of the corner of `triangle` at `vertex`, which it has.
fn corner_of(triangles: &[[u32; 3]], triangle: usize, vertex: u32) -> usize {
    let corner = triangles[triangle].iter().position(|corner| *corner == vertex);
    3 * triangle + corner.expect("the edge is of the triangle")
}

/// Returns the vertex of the corner with the number `corner`.
fn vertex_of(triangles: &[[u32; 3]], corner: usize) -> u32 {
    triangles[corner / 3][corner % 3]
}

/// Returns the root of the set of `corner`, and shortens the way to it.
fn find(parent: &mut [usize], mut corner: usize) -> usize {
    while parent[corner] != corner {
        parent[corner] = parent[parent[corner]];
        corner = parent[corner];
    }
    corner
}

/// Returns the sums of the area vectors of `triangles` at `positions`. The vector of a triangle is
/// added to its three `targets`, which are below `count`.
fn area_vectors(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    targets: &[[u32; 3]],
    count: usize,
) -> Vec<[f64; 3]> {
    let mut sums = vec![[0.0; 3]; count];
    for (corners, targets) in triangles.iter().zip(targets) {
        let area = area_vector(corners.map(|corner| positions[corner as usize]));
        for &target in targets {
            sums[target as usize] = sum(sums[target as usize], area);
        }
    }
    sums
}

/// Returns the unit vector in the direction of `a`.
fn unit(a: [f64; 3]) -> Normal {
    let size = length(a);
    if size > 0.0 { a.map(|part| (part / size) as f32) } else { [0.0, 1.0, 0.0] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::example;

    #[test]
    fn twins_at_one_place_share_a_normal_and_others_do_not() {
        // Two triangles that meet at a right angle in an edge of the x axis.
        let frame = |gap: f64| {
            let other = [[0.0, 0.0, gap], [1.0, 0.0, gap], [0.0, 1.0, gap]];
            example::frame(
                &[&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]], &other[..]].concat(),
            )
        };
        let triangles = [[0, 2, 1], [3, 4, 5]];
        let apart = cloth_normals(&frame(0.1), &triangles, &[[0, 3], [4, 1]]);
        assert_eq!((apart[0], apart[3]), ([0.0, 1.0, 0.0], [0.0, 0.0, 1.0]));
        let together = cloth_normals(&frame(0.0), &triangles, &[[0, 3], [4, 1]]);
        let diagonal = 0.5_f32.sqrt();
        assert_eq!(together[0], [0.0, diagonal, diagonal]);
        assert_eq!([together[3], together[1], together[4]], [together[0]; 3]);
        assert_eq!((together[2], together[5]), (apart[2], apart[5]));
        // Sewn with opposite sides, each keeps its own.
        let lower = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
        let turned = cloth_normals(
            &example::frame(&[lower, lower].concat()),
            &[[0, 2, 1], [3, 4, 5]],
            &[[0, 3]],
        );
        assert_eq!((turned[0], turned[3]), ([0.0, 1.0, 0.0], [0.0, -1.0, 0.0]));
    }

    #[test]
    fn a_cube_has_three_normals_at_each_corner_and_a_ball_one() {
        let (positions, triangles) = example::cube();
        let cube = Creased::new(&positions, &triangles);
        assert_eq!(cube.vertices.len(), 24);
        let normals = cube.normals(&positions, &triangles);
        for (corners, triangle) in cube.corners.iter().zip(&triangles) {
            let expected = unit(area_vector(triangle.map(|corner| positions[corner as usize])));
            let vertices = corners.map(|corner| cube.vertices[corner as usize]);
            assert_eq!(vertices, *triangle);
            assert_eq!(corners.map(|corner| normals[corner as usize]), [expected; 3]);
        }
        // A flat square has no crease.
        let square = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        assert_eq!(Creased::new(&square, &[[0, 1, 2], [0, 2, 3]]).vertices, [0, 1, 2, 3]);
    }
}
