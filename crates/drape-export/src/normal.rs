//! Normals: unit vectors across cloth and bodies at their vertices, for smooth shading.
//!
//! A normal is the sum of the area vectors of the triangles around a vertex, made a unit vector.
//! Vertices that are sewn together share theirs once they are at one place, so that no seam shows
//! as an edge. Bodies have creases, such as the edges of a cube: a vertex on a crease has a normal
//! for each side of it.

use std::collections::HashMap;

use drape_frames::Frame;
use drape_frames::vector::{area_vector, difference, dot, length, sum};

/// Cosine of the angle between two triangles of a body beyond which their edge is a crease: 40°,
/// more than the facets of a round body differ by, and less than the edges of a box.
const CREASE: f64 = 0.766;

/// Distance below which vertices that are sewn together are at one place, in m.
const AT_ONE_PLACE: f64 = 1e-6;

/// Unit vector; up where no triangle has an area, since some readers refuse vectors of no length.
pub(crate) type Normal = [f32; 3];

/// Returns the normals of the vertices of the cloth.
pub(crate) fn of_cloth(
    frame: &Frame,
    triangles: &[[u32; 3]],
    seam_pairs: &[[u32; 2]],
) -> Vec<Normal> {
    let own = area_vectors(&frame.cloth, triangles, triangles, frame.cloth.len());
    let mut shared = own.clone();
    let mut root: Vec<u32> = (0..own.len() as u32).collect();
    let find = |root: &[u32], mut vertex: u32| {
        while root[vertex as usize] != vertex {
            vertex = root[vertex as usize];
        }
        vertex
    };
    for &[a, b] in seam_pairs {
        let [at_a, at_b] = [a, b].map(|vertex| frame.cloth[vertex as usize]);
        let (a, b) = (find(&root, a), find(&root, b));
        if a != b && length(difference(at_a, at_b)) <= AT_ONE_PLACE {
            let of_b = shared[b as usize];
            shared[a as usize] = sum(shared[a as usize], of_b);
            root[b as usize] = a;
        }
    }
    let normal = |vertex: u32| {
        let (own, shared) = (own[vertex as usize], shared[find(&root, vertex) as usize]);
        // Panels that are sewn with opposite sides, or pressed open, keep their own.
        unit(if dot(own, shared) > 0.0 { shared } else { own })
    };
    (0..own.len() as u32).map(normal).collect()
}

/// Normals of a body: which vertex each is of, and which each corner of a triangle has.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Creased {
    /// Vertex of each normal, in the order of the vertices; a vertex on a crease is there more than
    /// once.
    pub(crate) vertices: Vec<u32>,
    /// Numbers of the normals of the corners of each triangle.
    pub(crate) corners: Vec<[u32; 3]>,
}

impl Creased {
    /// Finds the creases of a body.
    pub(crate) fn new(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Creased {
        let normals: Vec<[f64; 3]> = triangles
            .iter()
            .map(|corners| {
                let area = area_vector(positions, corners);
                let size = length(area);
                if size > 0.0 { area.map(|part| part / size) } else { area }
            })
            .collect();
        // Corners of triangles that share a smooth edge are joined.
        let mut root: Vec<usize> = (0..3 * triangles.len()).collect();
        let mut edges: HashMap<[u32; 2], Vec<usize>> = HashMap::new();
        for (triangle, corners) in triangles.iter().enumerate() {
            for side in 0..3 {
                let [a, b] = [corners[side], corners[(side + 1) % 3]];
                edges.entry([a.min(b), a.max(b)]).or_default().push(triangle);
            }
        }
        let corner = |triangle: usize, vertex: u32| {
            let place = triangles[triangle].iter().position(|corner| *corner == vertex);
            3 * triangle + place.expect("the edge is of the triangle")
        };
        for ([a, b], beside) in &edges {
            if let &[one, other] = &beside[..]
                && dot(normals[one], normals[other]) >= CREASE
            {
                for vertex in [*a, *b] {
                    let (one, other) = (
                        find(&mut root, corner(one, vertex)),
                        find(&mut root, corner(other, vertex)),
                    );
                    // The smaller is the root, in whatever order the edges come.
                    root[one.max(other)] = one.min(other);
                }
            }
        }
        let roots: Vec<usize> = (0..root.len()).map(|corner| find(&mut root, corner)).collect();
        let vertex = |corner: usize| triangles[corner / 3][corner % 3];
        let mut first: Vec<usize> = roots.clone();
        first.sort_unstable_by_key(|root| (vertex(*root), *root));
        first.dedup();
        let number: HashMap<usize, u32> = first.iter().copied().zip(0..).collect();
        Creased {
            vertices: first.into_iter().map(vertex).collect(),
            corners: roots
                .as_chunks()
                .0
                .iter()
                .map(|c: &[usize; 3]| c.map(|c| number[&c]))
                .collect(),
        }
    }

    /// Returns the normals of the body at some positions.
    pub(crate) fn normals(&self, positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Vec<Normal> {
        let sums = area_vectors(positions, triangles, &self.corners, self.vertices.len());
        sums.into_iter().map(unit).collect()
    }
}

fn find(root: &mut [usize], mut corner: usize) -> usize {
    while root[corner] != corner {
        root[corner] = root[root[corner]];
        corner = root[corner];
    }
    corner
}

/// Returns the sums of the area vectors of the triangles, over the targets of their corners.
fn area_vectors(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    targets: &[[u32; 3]],
    count: usize,
) -> Vec<[f64; 3]> {
    let mut sums = vec![[0.0; 3]; count];
    for (corners, targets) in triangles.iter().zip(targets) {
        let area = area_vector(positions, corners);
        for &target in targets {
            sums[target as usize] = sum(sums[target as usize], area);
        }
    }
    sums
}

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
        let apart = of_cloth(&frame(0.1), &triangles, &[[0, 3], [4, 1]]);
        assert_eq!((apart[0], apart[3]), ([0.0, 1.0, 0.0], [0.0, 0.0, 1.0]));
        let together = of_cloth(&frame(0.0), &triangles, &[[0, 3], [4, 1]]);
        let diagonal = 0.5_f32.sqrt();
        assert_eq!(together[0], [0.0, diagonal, diagonal]);
        assert_eq!([together[3], together[1], together[4]], [together[0]; 3]);
        assert_eq!((together[2], together[5]), (apart[2], apart[5]));
        // Sewn with opposite sides, each keeps its own.
        let lower = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
        let turned =
            of_cloth(&example::frame(&[lower, lower].concat()), &[[0, 2, 1], [3, 4, 5]], &[[0, 3]]);
        assert_eq!((turned[0], turned[3]), ([0.0, 1.0, 0.0], [0.0, -1.0, 0.0]));
    }

    #[test]
    fn a_cube_has_three_normals_at_each_corner_and_a_ball_one() {
        let (positions, triangles) = example::cube();
        let cube = Creased::new(&positions, &triangles);
        assert_eq!(cube.vertices.len(), 24);
        let normals = cube.normals(&positions, &triangles);
        for (corners, triangle) in cube.corners.iter().zip(&triangles) {
            let expected = unit(area_vector(&positions, triangle));
            let vertices = corners.map(|corner| cube.vertices[corner as usize]);
            assert_eq!(vertices, *triangle);
            assert_eq!(corners.map(|corner| normals[corner as usize]), [expected; 3]);
        }
        // A flat square has no crease.
        let square = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        assert_eq!(Creased::new(&square, &[[0, 1, 2], [0, 2, 3]]).vertices, [0, 1, 2, 3]);
    }
}
