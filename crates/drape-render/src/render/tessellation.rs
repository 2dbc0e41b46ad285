//! Tessellation: the surfaces of a scene subdivided into facets with smooth normals.

use std::collections::HashMap;

use super::scene::{Scene, Surface};
use super::smooth::{self, Border, Smooth};
use super::vector::{Bounds, Vector, add, at, cross, norm, scale, subtract, unit};

/// Longest edge of a facet, over the radius of the scene.
///
/// The light of the sky is evaluated at corners and interpolated. Large triangles are therefore
/// split until they can resolve the shade at the foot of a body.
const LONGEST_EDGE: f64 = 1.0 / 24.0;

/// Part of the scene to which a facet belongs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Part {
    Cloth(usize),
    /// Band along the hem of a cloth, as wide as the cloth is thick.
    Rim(usize),
    Body(usize),
}

/// Position in a surface: a triangle, and the weights of its first two corners.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Source {
    pub(crate) triangle: u32,
    pub(crate) weights: [f32; 2],
}

impl Source {
    /// Returns the value of a quantity at this position. `at` gives the quantity at each vertex.
    pub(crate) fn value<const N: usize>(
        self,
        triangles: &[[u32; 3]],
        at: impl Fn(usize) -> [f64; N],
    ) -> [f64; N] {
        let [a, b] = self.weights.map(f64::from);
        let corners = triangles[self.triangle as usize].map(|corner| at(corner as usize));
        std::array::from_fn(|k| {
            a * corners[0][k] + b * corners[1][k] + (1.0 - a - b) * corners[2][k]
        })
    }
}

/// Vertex of the facets.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Vertex {
    pub(crate) position: Vector,
    pub(crate) normal: Vector,
    pub(crate) part: Part,
    pub(crate) source: Source,
    /// Border of the cloth on which the vertex lies.
    pub(crate) border: Border,
}

/// Triangle of the tessellation.
#[derive(Debug, Clone)]
pub(crate) struct Facet {
    pub(crate) part: Part,
    /// Numbers of the vertices of the facet.
    pub(crate) corners: [u32; 3],
    /// Border of the cloth along the edge opposite to each corner.
    pub(crate) borders: [Border; 3],
}

/// Scene subdivided into facets.
pub(crate) struct Tessellation {
    pub(crate) vertices: Vec<Vertex>,
    pub(crate) facets: Vec<Facet>,
    /// Bounds of cloths and bodies, in m.
    pub(crate) bounds: Bounds,
    /// Depth bias of bodies, for the camera and for lights, in m.
    pub(crate) body_depth_bias: f64,
}

impl Tessellation {
    /// Subdivides a `scene`.
    pub(crate) fn new(scene: &Scene) -> Tessellation {
        let surfaces = scene.cloths.iter().chain(&scene.bodies);
        let bounds = Bounds::of(surfaces.flat_map(|surface| surface.points()));
        let longest = LONGEST_EDGE * bounds.radius;
        let mut builder = Builder { longest, ..Builder::default() };
        for (k, cloth) in scene.cloths.iter().enumerate() {
            builder.add(cloth, smooth::cloth(cloth), Part::Cloth(k));
        }
        for (k, body) in scene.bodies.iter().enumerate() {
            builder.add(body, smooth::body(body), Part::Body(k));
        }
        let Builder { vertices, facets, .. } = builder;
        Tessellation { vertices, facets, bounds, body_depth_bias: scene.body_depth_bias }
    }

    /// Returns the vertices of a `facet`.
    pub(crate) fn corners(&self, facet: &Facet) -> [&Vertex; 3] {
        facet.corners.map(|corner| &self.vertices[corner as usize])
    }

    /// Returns the vector across a `facet` with a length of twice its area.
    pub(crate) fn area_vector(&self, facet: &Facet) -> Vector {
        let [a, b, c] = self.corners(facet).map(|corner| corner.position);
        cross(subtract(b, a), subtract(c, a))
    }

    /// Returns the depth bias of a `part`, in m.
    pub(crate) fn depth_bias(&self, part: Part) -> f64 {
        match part {
            Part::Body(_) => self.body_depth_bias,
            Part::Cloth(_) | Part::Rim(_) => 0.0,
        }
    }
}

/// Facets under construction.
#[derive(Default)]
struct Builder {
    vertices: Vec<Vertex>,
    facets: Vec<Facet>,
    /// Vertices in the middle of edges that were cut.
    middles: HashMap<[u32; 2], u32>,
    /// Longest edge of a facet, in m.
    longest: f64,
}

/// Piece of a triangle that is subdivided into facets.
#[derive(Clone, Copy)]
struct Piece {
    corners: [u32; 3],
    /// First two of the three barycentric coordinates of each corner in the surface triangle that
    /// is divided.
    weights: [[f32; 2]; 3],
    borders: [Border; 3],
}

impl Builder {
    /// Adds the facets of a `surface`, which is a `part` of the scene.
    ///
    /// Only vertices of triangles with an area are added. Other vertices have no source.
    fn add(&mut self, surface: &Surface, smooth: Smooth, part: Part) {
        let mut numbers = vec![None; smooth.vertices.len()];
        for triangle in &smooth.triangles {
            // Each corner gets its vertex at its first triangle, and its source at its last
            // triangle.
            let weights = [[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]];
            let corners = [0, 1, 2].map(|k| {
                let corner = triangle.corners[k] as usize;
                let (vertex, normal) = smooth.vertices[corner];
                let source = Source { triangle: triangle.number, weights: weights[k] };
                let number = *numbers[corner].get_or_insert(self.vertices.len() as u32);
                match self.vertices.get_mut(number as usize) {
                    Some(known) => known.source = source,
                    None => self.vertices.push(Vertex {
                        position: at(surface.positions, vertex as usize),
                        normal,
                        part,
                        source,
                        border: Border::None,
                    }),
                }
                number
            });

            for k in (0..3).filter(|k| triangle.borders[*k] != Border::None) {
                for end in [corners[(k + 1) % 3], corners[(k + 2) % 3]] {
                    self.vertices[end as usize].border = triangle.borders[k];
                }
            }
            let piece = Piece { corners, weights, borders: triangle.borders };
            self.split(piece, triangle.number, part);
        }
    }

    /// Bisects the longest edge of a `piece` of a `triangle` until no edge is too long.
    ///
    /// An edge is only cut at its midpoint, and its length alone decides, so that neighbours agree.
    fn split(&mut self, piece: Piece, triangle: u32, part: Part) {
        let place = |k: usize| self.vertices[piece.corners[k % 3] as usize].position;
        let lengths = [0, 1, 2].map(|k| norm(subtract(place(k + 1), place(k + 2))));
        let k = (1..3).fold(0, |best, k| if lengths[k] > lengths[best] { k } else { best });
        if lengths[k] <= self.longest {
            let Piece { corners, borders, .. } = piece;
            self.facets.push(Facet { part, corners, borders });
            return;
        }

        let (b, c) = ((k + 1) % 3, (k + 2) % 3);
        let weights = [0, 1].map(|i| 0.5 * (piece.weights[b][i] + piece.weights[c][i]));
        let ends = [b, c].map(|end| piece.corners[end]);
        let [first, second] = ends.map(|end| self.vertices[end as usize]);
        let middle = *self
            .middles
            .entry([ends[0].min(ends[1]), ends[0].max(ends[1])])
            .or_insert(self.vertices.len() as u32);
        if middle as usize == self.vertices.len() {
            self.vertices.push(Vertex {
                position: scale(add(first.position, second.position), 0.5),
                normal: unit(add(first.normal, second.normal)),
                part,
                source: Source { triangle, weights },
                border: piece.borders[k],
            });
        }

        for (replaced, cut) in [(c, b), (b, c)] {
            let mut half = piece;
            half.corners[replaced] = middle;
            half.weights[replaced] = weights;
            // The new edge from the midpoint to corner k is opposite to the corner that was kept.
            half.borders[cut] = Border::None;
            self.split(half, triangle, part);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    /// A square of side 1 and a far larger rectangle beside it.
    #[test]
    fn bisection_keeps_the_area_and_the_hem() {
        let positions = [
            0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 1.0, 4.0, 0.0, 0.0, 4.0, 0.0,
            1.0,
        ];
        let triangles = [[0, 2, 1], [0, 3, 2], [1, 5, 4], [1, 2, 5]];
        let scene =
            Scene { cloths: vec![Surface::cloth(&positions, &triangles)], ..Scene::default() };
        let tessellation = Tessellation::new(&scene);
        let on_cloth: Vec<&Facet> =
            tessellation.facets.iter().filter(|facet| facet.part == Part::Cloth(0)).collect();
        let area: f64 =
            on_cloth.iter().map(|facet| 0.5 * norm(tessellation.area_vector(facet))).sum();
        assert!((area - 4.0).abs() < 1e-12, "area {area}");
        let mut hem = 0.0;
        for facet in on_cloth {
            for k in 0..3 {
                let [a, b] = [1, 2].map(|i| tessellation.corners(facet)[(k + i) % 3].position);
                let length = norm(subtract(a, b));
                assert!(length <= LONGEST_EDGE * tessellation.bounds.radius, "edge {length}");
                if facet.borders[k] == Border::Hem {
                    hem += length;
                }
            }
        }
        assert!((hem - 10.0).abs() < 1e-12, "hem {hem}");
        for vertex in &tessellation.vertices {
            let place = vertex.source.value(&triangles, |corner| at(&positions, corner));
            let off = norm(subtract(place, vertex.position));
            let allowed = if vertex.part == Part::Cloth(0) { 1e-6 } else { 0.01 };
            assert!(off < allowed, "{off} from its source");
        }
    }

    /// A vertex without a triangle had a source beyond the list of triangles.
    #[test]
    fn vertices_without_a_triangle_are_left_out() {
        let positions =
            [[9.0, 9.0, 9.0], [0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [9.0; 3]];
        let positions: Vec<f64> = positions.concat();
        // The second triangle has no area.
        let triangles = [[1, 2, 3], [1, 1, 4]];
        let scene =
            Scene { cloths: vec![Surface::cloth(&positions, &triangles)], ..Scene::default() };
        for vertex in &Tessellation::new(&scene).vertices {
            let place = vertex.source.value(&triangles, |corner| at(&positions, corner));
            assert!(place.iter().all(|x| (0.0..=1.0).contains(x)), "{place:?}");
        }
    }

    /// Neighbours that cut a common edge differently would leave a corner without a partner.
    #[test]
    fn split_neighbours_share_all_corners() {
        let positions = [0.0, 0.0, 0.0, 1.0, 0.3, 0.0, 0.9, 0.0, 1.1, 0.0, 0.2, 0.8, 0.3, 1.5, 0.4];
        let triangles = [[0, 1, 2], [0, 2, 3], [0, 4, 1], [1, 4, 2], [2, 4, 3], [3, 4, 0]];
        let scene =
            Scene { bodies: vec![Surface::body(&positions, &triangles)], ..Scene::default() };
        let tessellation = Tessellation::new(&scene);
        let mut sides = BTreeMap::new();
        for facet in &tessellation.facets {
            let keys = tessellation.corners(facet).map(|c| c.position.map(f64::to_bits));
            for k in 0..3 {
                let (a, b) = (keys[k], keys[(k + 1) % 3]);
                *sides.entry((a.min(b), a.max(b))).or_insert(0) += 1;
            }
        }
        let lonely = sides.values().filter(|count| **count != 2).count();
        let count = tessellation.facets.len();
        assert_eq!(lonely, 0, "edges of {count} facets without a partner");
        assert!(count > 1000, "only {count} facets");
    }
}

/// Scenes of the tests of lights.
#[cfg(test)]
pub(crate) mod samples {
    use super::*;

    /// Scene of vertices and facets with its bounds.
    pub(crate) fn scene(discs: &[Disc], center: Vector, radius: f64) -> Tessellation {
        let (mut vertices, mut facets) = (Vec::new(), Vec::new());
        discs.iter().for_each(|disc| disc.add(&mut vertices, &mut facets));
        let bounds = Bounds { center, radius };
        Tessellation { vertices, facets, bounds, body_depth_bias: 0.0 }
    }

    /// Disc around the y axis, facing up, as a fan of triangles.
    pub(crate) struct Disc {
        pub(crate) radius: f64,
        pub(crate) height: f64,
        pub(crate) pieces: u32,
    }

    impl Disc {
        fn add(&self, vertices: &mut Vec<Vertex>, facets: &mut Vec<Facet>) {
            let first = vertices.len() as u32;
            let vertex = |position: Vector| Vertex {
                position,
                normal: [0.0, 1.0, 0.0],
                part: Part::Body(0),
                source: Source { triangle: 0, weights: [0.0; 2] },
                border: Border::None,
            };
            vertices.push(vertex([0.0, self.height, 0.0]));
            for k in 0..self.pieces {
                let angle = f64::from(k) * std::f64::consts::TAU / f64::from(self.pieces);
                let (sine, cosine) = angle.sin_cos();
                vertices.push(vertex([self.radius * sine, self.height, self.radius * cosine]));
                facets.push(Facet {
                    part: Part::Body(0),
                    corners: [first, first + 1 + k, first + 1 + (k + 1) % self.pieces],
                    borders: [Border::None; 3],
                });
            }
        }
    }
}
