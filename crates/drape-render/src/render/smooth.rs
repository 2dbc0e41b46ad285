//! Smooth normals of the vertices of a surface, and the borders among its edges.
//!
//! Cloth is smooth everywhere, across seams too. Vertices of different panels at one position share
//! a normal unless the cloth turns there by more than a right angle. A body is smooth except at its
//! creases, where a vertex has a normal for each side.

use std::collections::{BTreeMap, HashMap};

use super::scene::Surface;
use super::vector::{Vector, add, at, cross, dot, norm, scale, subtract, unit};

/// Cosine of the largest angle between triangles whose common edge is smooth on a body, 50°. A
/// cylinder of eight sides is therefore round and a cube is not.
const CREASE: f64 = 0.643;

/// Border of a cloth along an edge of a triangle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Border {
    /// No border: there is cloth on both sides.
    None,
    /// End of the cloth.
    Hem,
    /// Edge of another panel at the same position.
    Seam,
}

/// Vertices of a surface with their normals.
pub(crate) struct Smooth {
    /// Vertex of the surface and normal. A vertex on a crease has several entries.
    pub(crate) vertices: Vec<(u32, Vector)>,
    /// Triangles that have an area.
    pub(crate) triangles: Vec<SmoothTriangle>,
}

/// Triangle with an area.
pub(crate) struct SmoothTriangle {
    /// Number of the triangle in the surface.
    pub(crate) number: u32,
    /// Indices of the corners in the list of smooth vertices.
    pub(crate) corners: [u32; 3],
    /// Border along the edge opposite to each corner.
    pub(crate) borders: [Border; 3],
}

/// Returns the vectors across the triangles of a `surface`, with a length of twice the area.
fn area_vectors(surface: &Surface) -> Vec<Vector> {
    let area = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(|index| at(surface.positions, index as usize));
        cross(subtract(b, a), subtract(c, a))
    };
    surface.triangles.iter().map(area).collect()
}

/// Returns the edge opposite to a `corner` of a `triangle`, as the numbers of its vertices, the
/// smaller number first.
fn edge(triangle: &[u32; 3], corner: usize) -> [u32; 2] {
    let [a, b] = [1, 2].map(|k| triangle[(corner + k) % 3]);
    [a.min(b), a.max(b)]
}

/// Returns the smooth normals of the cloth `surface`, and its borders.
pub(crate) fn cloth(surface: &Surface) -> Smooth {
    let areas = area_vectors(surface);
    let count = surface.positions.len() / 3;
    let mut sums = vec![[0.0; 3]; count];
    let mut sides: HashMap<[u32; 2], u32> = HashMap::with_capacity(2 * areas.len());
    for (triangle, area) in surface.triangles.iter().zip(&areas) {
        for k in 0..3 {
            let sum = &mut sums[triangle[k] as usize];
            *sum = add(*sum, *area);
            *sides.entry(edge(triangle, k)).or_insert(0) += 1;
        }
    }
    let is_border = |triangle: &[u32; 3], k: usize| sides.get(&edge(triangle, k)) == Some(&1);
    // Vertices on borders at one position are joined, in the order of the triangles.
    let bits = |vertex: u32| at(surface.positions, vertex as usize).map(f64::to_bits);
    let mut places: BTreeMap<[u64; 3], Vec<u32>> = BTreeMap::new();
    let mut edges: HashMap<[[u64; 3]; 2], u32> = HashMap::new();
    let ends = |triangle: &[u32; 3], k: usize| {
        let [a, b] = edge(triangle, k).map(bits);
        [a.min(b), a.max(b)]
    };
    for triangle in surface.triangles {
        for k in (0..3).filter(|k| is_border(triangle, *k)) {
            *edges.entry(ends(triangle, k)).or_insert(0) += 1;
            for vertex in edge(triangle, k) {
                let here = places.entry(bits(vertex)).or_default();
                if !here.contains(&vertex) {
                    here.push(vertex);
                }
            }
        }
    }
    let separate = sums.clone();
    for here in places.values().filter(|here| here.len() > 1) {
        let shared = here.iter().fold([0.0; 3], |sum, vertex| add(sum, separate[*vertex as usize]));
        for vertex in here {
            if dot(shared, separate[*vertex as usize]) > 0.0 {
                sums[*vertex as usize] = shared;
            }
        }
    }

    let border = |triangle: &[u32; 3], k: usize| {
        if !is_border(triangle, k) {
            Border::None
        } else if edges.get(&ends(triangle, k)) == Some(&1) {
            Border::Hem
        } else {
            Border::Seam
        }
    };
    let triangles = surface.triangles.iter().zip(&areas).zip(0..);
    let triangles = triangles.filter(|((_, area), _)| norm(**area) > 0.0);
    Smooth {
        vertices: (0..).zip(sums.into_iter().map(unit)).collect(),
        triangles: triangles
            .map(|((triangle, _), number)| SmoothTriangle {
                number,
                corners: *triangle,
                borders: [0, 1, 2].map(|k| border(triangle, k)),
            })
            .collect(),
    }
}

/// Returns the normals of the body `surface`, smooth except at its creases.
pub(crate) fn body(surface: &Surface) -> Smooth {
    let areas = area_vectors(surface);
    let normals: Vec<Vector> = areas.iter().map(|area| unit(*area)).collect();
    // Corners of triangles that share a smooth edge are joined. The smallest number of a group is
    // its root.
    let mut root: Vec<u32> = (0..3 * areas.len() as u32).collect();
    let mut open: HashMap<[u32; 2], u32> = HashMap::with_capacity(2 * areas.len());
    let place = |triangle: u32, vertex: u32| {
        let corners = surface.triangles[triangle as usize];
        let place = corners.iter().position(|corner| *corner == vertex);
        3 * triangle + place.expect("the edge is of the triangle") as u32
    };
    for (triangle, number) in surface.triangles.iter().zip(0..) {
        for k in 0..3 {
            let ends = edge(triangle, k);
            let Some(other) = open.insert(ends, number) else { continue };
            if dot(normals[number as usize], normals[other as usize]) < CREASE {
                continue;
            }
            for vertex in ends {
                let [a, b] = [number, other].map(|t| find(&mut root, place(t, vertex)));
                root[a.max(b) as usize] = a.min(b);
            }
        }
    }

    // Each group of joined corners becomes a vertex.
    let mut numbers = vec![u32::MAX; root.len()];
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    for ((triangle, area), number) in surface.triangles.iter().zip(&areas).zip(0..) {
        if norm(*area) == 0.0 {
            continue;
        }
        let corners = [0, 1, 2].map(|k| {
            let root = find(&mut root, 3 * number + k as u32) as usize;
            if numbers[root] == u32::MAX {
                numbers[root] = vertices.len() as u32;
                vertices.push((triangle[k], [0.0; 3]));
            }
            let (_, normal) = &mut vertices[numbers[root] as usize];
            *normal = add(*normal, *area);
            numbers[root]
        });
        triangles.push(SmoothTriangle { number, corners, borders: [Border::None; 3] });
    }
    vertices.iter_mut().for_each(|(_, normal)| *normal = unit(*normal));
    Smooth { vertices, triangles }
}

/// Returns the root of the group of a `corner`, and shortens the path to it in `root`.
fn find(root: &mut [u32], mut corner: u32) -> u32 {
    while root[corner as usize] != corner {
        root[corner as usize] = root[root[corner as usize] as usize];
        corner = root[corner as usize];
    }
    corner
}

/// Returns a `point` of a flat triangle moved towards the curved surface that the normals of the
/// `corners` describe: away from the triangle, where the surface bulges \[Han21\].
pub(crate) fn bulged(point: Vector, corners: [(Vector, Vector); 3], weights: [f64; 3]) -> Vector {
    let shift = |sum: Vector, ((corner, normal), weight): ((Vector, Vector), f64)| {
        let below = dot(subtract(point, corner), normal).min(0.0);
        add(sum, scale(normal, -below * weight))
    };
    corners.into_iter().zip(weights).fold(point, shift)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two triangles that meet at a right angle in an edge on the y axis.
    const BENT: [f64; 12] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    const TRIANGLES: [[u32; 3]; 2] = [[0, 1, 2], [0, 2, 3]];

    #[test]
    fn a_cube_keeps_its_edges_and_a_cloth_does_not() {
        let body = body(&Surface::body(&BENT, &TRIANGLES));
        let first = |smooth: &Smooth| smooth.vertices[smooth.triangles[0].corners[0] as usize];
        assert_eq!(first(&body), (0, [0.0, 0.0, 1.0]));
        assert_eq!(body.vertices.len(), 6, "both ends of the edge are there twice");
        let cloth = cloth(&Surface::cloth(&BENT, &TRIANGLES));
        let middle = 0.5f64.sqrt();
        let miss = norm(subtract(first(&cloth).1, [middle, 0.0, middle]));
        assert!(miss < 1e-12, "{:?}", first(&cloth));
        assert_eq!(cloth.triangles[0].borders, [Border::Hem, Border::None, Border::Hem]);
    }

    #[test]
    fn a_round_body_of_few_sides_has_smooth_normals() {
        // A prism of twelve sides, without lids.
        let count = 12;
        let corner = |k: u32| {
            let angle = f64::from(k / 2) / f64::from(count) * std::f64::consts::TAU;
            [angle.sin(), f64::from(k % 2), angle.cos()]
        };
        let positions: Vec<f64> = (0..2 * count).flat_map(corner).collect();
        let side = |k: u32| {
            let [a, b, c, d] = [0, 1, 2, 3].map(|n| (2 * k + n) % (2 * count));
            [[a, c, d], [a, d, b]]
        };
        let triangles: Vec<[u32; 3]> = (0..count).flat_map(side).collect();
        let smooth = body(&Surface::body(&positions, &triangles));
        assert_eq!(smooth.vertices.len(), positions.len() / 3);
        for (vertex, normal) in smooth.vertices {
            let [x, _, z] = at(&positions, vertex as usize);
            // The two sides of a vertex may have one or two triangles there: by a third of the
            // tangent of 15°.
            let miss = dot(normal, [x, 0.0, z]).acos().to_degrees();
            assert!(miss < 5.11, "{miss}° at {vertex}");
        }
    }

    #[test]
    fn panels_that_are_sewn_share_their_normals_and_have_no_hem_there() {
        let bent: Vec<f64> = BENT.iter().chain(&BENT[..3]).chain(&BENT[6..9]).copied().collect();
        let sewn = cloth(&Surface::cloth(&bent, &[[0, 1, 2], [4, 5, 3]]));
        assert_eq!(sewn.vertices[0].1, sewn.vertices[4].1);
        assert_eq!(sewn.triangles[0].borders, [Border::Hem, Border::Seam, Border::Hem]);
        assert_eq!(sewn.triangles[1].borders, [Border::Hem, Border::Hem, Border::Seam]);
    }

    #[test]
    fn a_point_of_a_chord_is_moved_onto_the_circle() {
        // A fan on the unit circle about the y axis, of 0.2 rad.
        let corner = |angle: f64, height: f64| {
            ([angle.sin(), height, angle.cos()], [angle.sin(), 0.0, angle.cos()])
        };
        let corners = [corner(-0.1, 0.0), corner(0.1, 0.0), corner(0.0, 1.0)];
        let point = [0.0, 0.0, 0.1f64.cos()];
        let moved = bulged(point, corners, [0.5, 0.5, 0.0]);
        let rise = norm(moved) - norm(point);
        // The tangents meet above the circle.
        let sagitta = 1.0 - 0.1f64.cos();
        assert!((sagitta..2.1 * sagitta).contains(&rise), "{rise}, and the sagitta is {sagitta}");
    }
}
