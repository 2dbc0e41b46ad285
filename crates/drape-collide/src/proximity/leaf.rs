//! Leaves of a mesh: triangles, edges and points, with the vertices and edges that belong to each.

use super::primitive::{Primitive, PrimitivePair};
use crate::surface::PairKind;
use crate::vector::Vector;

/// Triangle, edge or point in a leaf of the tree. An edge is a triangle whose last corners are
/// equal, and a point is a triangle whose corners are all equal.
///
/// Vertices and edges that several triangles share belong to the first of them. Every pair of a
/// vertex and a triangle, and every pair of edges, is then found once.
#[derive(Debug, Clone, Copy)]
pub(super) struct Leaf {
    pub(super) corners: [u32; 3],
    /// Whether each corner belongs to this leaf.
    pub(super) has_vertex: [bool; 3],
    /// Whether the edge from each corner to the next belongs to this leaf.
    pub(super) has_edge: [bool; 3],
}

impl Leaf {
    /// Returns the leaves of `triangles`, then of `edges`, then of the vertices that none of both
    /// names. The lists name `vertex_count` vertices at most.
    pub(super) fn list(
        vertex_count: usize,
        triangles: &[[u32; 3]],
        edges: &[[u32; 2]],
    ) -> Vec<Leaf> {
        let corners = triangles.iter().copied().chain(edges.iter().map(|&[a, b]| [a, b, b]));
        let mut leaves: Vec<Leaf> = corners
            .map(|corners| Leaf { corners, has_vertex: [false; 3], has_edge: [false; 3] })
            .collect();

        // A vertex belongs to the first leaf that names it, or to a leaf of its own.
        let mut is_named = vec![false; vertex_count];
        for leaf in &mut leaves {
            for (corner, has_vertex) in leaf.corners.into_iter().zip(&mut leaf.has_vertex) {
                *has_vertex = !std::mem::replace(&mut is_named[corner as usize], true);
            }
        }
        let points = (0..vertex_count as u32).filter(|&vertex| !is_named[vertex as usize]);
        let points = points.map(|vertex| Leaf {
            corners: [vertex; 3],
            has_vertex: [true, false, false],
            has_edge: [false; 3],
        });

        // An edge belongs to the first leaf that has it.
        let mut sides: Vec<([u32; 2], usize)> = Vec::with_capacity(3 * leaves.len());
        for (number, leaf) in leaves.iter().enumerate() {
            let sides_of_leaf = (0..3).map(|side| (leaf.edge(side), 3 * number + side));
            sides.extend(sides_of_leaf.filter(|([a, b], _)| a != b));
        }
        sides.sort_unstable();
        for same in sides.chunk_by(|a, b| a.0 == b.0) {
            leaves[same[0].1 / 3].has_edge[same[0].1 % 3] = true;
        }
        leaves.extend(points);
        leaves
    }

    /// Returns the ends of the edge from the corner number `side` to the next, the lower first.
    pub(super) fn edge(&self, side: usize) -> [u32; 2] {
        let [a, b] = [self.corners[side], self.corners[(side + 1) % 3]];
        [a.min(b), a.max(b)]
    }

    /// Returns the corners that belong to this leaf.
    fn vertices(&self) -> impl Iterator<Item = u32> {
        self.corners
            .into_iter()
            .zip(self.has_vertex)
            .filter(|(_, has)| *has)
            .map(|(vertex, _)| vertex)
    }

    /// Returns the edges that belong to this leaf.
    pub(super) fn edges(&self) -> impl Iterator<Item = [u32; 2]> {
        (0..3).filter(|&side| self.has_edge[side]).map(|side| self.edge(side))
    }

    /// Returns this leaf, which has `number` in a mesh with `triangle_count` triangles, as a
    /// [`Primitive`].
    fn primitive(&self, number: u32, triangle_count: usize) -> Primitive {
        let [a, b, c] = self.corners;
        if (number as usize) < triangle_count {
            Primitive::Triangle(number)
        } else if a == c {
            Primitive::Vertex(a)
        } else {
            Primitive::Edge([a.min(b), a.max(b)])
        }
    }
}

/// Leaf with its number in a mesh.
#[derive(Debug, Clone, Copy)]
pub(super) struct NumberedLeaf<'a> {
    pub(super) leaf: &'a Leaf,
    pub(super) number: u32,
    /// Number of triangles of the mesh.
    pub(super) triangle_count: usize,
}

impl NumberedLeaf<'_> {
    /// Returns the leaf as a [`Primitive`].
    pub(super) fn primitive(&self) -> Primitive {
        self.leaf.primitive(self.number, self.triangle_count)
    }
}

/// Two primitives of two leaves: a vertex and a triangle, or two edges.
#[derive(Debug, Clone, Copy)]
pub(super) struct LeafPair {
    pub(super) kind: PairKind,
    /// Numbers of the vertex and the three corners, or of the ends of both edges.
    pub(super) vertices: [u32; 4],
    /// Which of the two meshes has each of the four vertices, 0 or 1.
    pub(super) meshes: [usize; 4],
    pub(super) primitives: PrimitivePair,
}

impl LeafPair {
    /// Returns the points of the four vertices in the `positions` of both meshes.
    pub(super) fn points(&self, positions: [&[Vector]; 2]) -> [Vector; 4] {
        std::array::from_fn(|k| positions[self.meshes[k]][self.vertices[k] as usize])
    }

    /// Returns the sign of an offset from the second primitive of `kind` to the first: 1 if the
    /// first mesh has the first primitive.
    pub(super) fn orientation(&self) -> f64 {
        if self.meshes[0] == 0 { 1.0 } else { -1.0 }
    }

    /// Returns whether a vertex of the first primitive is a vertex of the second, for primitives of
    /// one mesh.
    pub(super) fn share_vertex(&self) -> bool {
        let (first, second) = self.vertices.split_at(match self.kind {
            PairKind::VertexFace => 1,
            PairKind::EdgeEdge => 2,
        });
        first.iter().any(|vertex| second.contains(vertex))
    }
}

/// Calls `visit` with every pair of primitives that belong to the two `leaves`.
pub(super) fn for_each_pair(leaves: [NumberedLeaf<'_>; 2], mut visit: impl FnMut(LeafPair)) {
    for vertex_mesh in 0..2 {
        let face = leaves[1 - vertex_mesh];
        let [a, b, c] = face.leaf.corners;
        for vertex in leaves[vertex_mesh].leaf.vertices() {
            let pair = [Primitive::Vertex(vertex), face.primitive()];
            let face_mesh = 1 - vertex_mesh;
            visit(LeafPair {
                kind: PairKind::VertexFace,
                vertices: [vertex, a, b, c],
                meshes: [vertex_mesh, face_mesh, face_mesh, face_mesh],
                primitives: PrimitivePair { first: pair[vertex_mesh], second: pair[face_mesh] },
            });
        }
    }
    for [a, b] in leaves[0].leaf.edges() {
        for [c, d] in leaves[1].leaf.edges() {
            visit(LeafPair {
                kind: PairKind::EdgeEdge,
                vertices: [a, b, c, d],
                meshes: [0, 0, 1, 1],
                primitives: PrimitivePair {
                    first: Primitive::Edge([a, b]),
                    second: Primitive::Edge([c, d]),
                },
            });
        }
    }
}
