//! Triangles with the numbers of their vertices, and whether two of them are joined.
//!
//! `mesh` makes the vertices, `distance` and `verdict` leave out the features that are joined.

/// Vertex of a triangle; vertices that are sewn together have the same number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Vertex {
    pub(crate) number: u32,
    /// Numbers of the two vertices between which it lies, if it is tied to an edge.
    pub(crate) between: Option<[u32; 2]>,
}

/// Triangle of a frame: the positions of its corners, in m, and its vertices.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Triangle {
    pub(crate) corners: [[f64; 3]; 3],
    pub(crate) vertices: [Vertex; 3],
}

impl Triangle {
    /// Returns the corners of two triangles that are not on the edge that they share; `None` if they share
    /// none.
    pub(crate) fn apexes(&self, other: &Triangle) -> Option<[usize; 2]> {
        let shares = |vertex: &Vertex, of: &Triangle| {
            of.vertices.iter().any(|other| other.number == vertex.number)
        };
        let apex = |of: &Triangle, with: &Triangle| {
            let mut alone = (0..3).filter(|&k| !shares(&of.vertices[k], with));
            alone.next().filter(|_| alone.next().is_none())
        };
        Some([apex(self, other)?, apex(other, self)?])
    }
}

/// Edges of a triangle, by the numbers of its corners.
pub(crate) const EDGES: [[usize; 2]; 3] = [[0, 1], [1, 2], [2, 0]];

/// Returns whether two vertices, edges or triangles are joined: they share a vertex, or a vertex of
/// one is tied to an edge of the other.
pub(crate) fn joined(one: &[Vertex], other: &[Vertex]) -> bool {
    let has = |all: &[Vertex], number: u32| all.iter().any(|vertex| vertex.number == number);
    let on = |vertex: &Vertex, all: &[Vertex]| {
        has(all, vertex.number) || vertex.between.is_some_and(|[a, b]| has(all, a) && has(all, b))
    };
    one.iter().any(|vertex| on(vertex, other)) || other.iter().any(|vertex| on(vertex, one))
}
