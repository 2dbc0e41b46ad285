//! Triangles with the numbers of their vertices, and the test whether two features are joined.
//!
//! `distance` and `verdict` leave out the features that are joined.

/// Vertex of a triangle. Vertices that are sewn together have one number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Vertex {
    pub(crate) number: u32,
    /// Numbers of the two ends of the edge to which the vertex is tied, if it is tied.
    pub(crate) between: Option<[u32; 2]>,
}

/// Triangle of a frame: the positions of its corners, in m, and its vertices.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Triangle {
    pub(crate) corners: [[f64; 3]; 3],
    pub(crate) vertices: [Vertex; 3],
}

impl Triangle {
    /// Returns the index of the corner of `self`, and of the corner of `other`, that is not on the
    /// edge that the two triangles share. Returns `None` if they share no edge, or all vertices.
    pub(crate) fn apexes(&self, other: &Triangle) -> Option<[usize; 2]> {
        Some([self.apex(other)?, other.apex(self)?])
    }

    /// Returns the index of the only corner that is no vertex of `neighbour`.
    fn apex(&self, neighbour: &Triangle) -> Option<usize> {
        let mut unshared =
            (0..3).filter(|&k| !has_number(&neighbour.vertices, self.vertices[k].number));
        unshared.next().filter(|_| unshared.next().is_none())
    }
}

/// Edges of a triangle, by the indices of its corners.
pub(crate) const EDGES: [[usize; 2]; 3] = [[0, 1], [1, 2], [2, 0]];

/// Returns whether two features are joined: they share a vertex, or a vertex of one feature is tied
/// to an edge of the other. `first` and `second` are the vertices of a vertex, edge or triangle.
pub(crate) fn joined(first: &[Vertex], second: &[Vertex]) -> bool {
    first.iter().any(|vertex| is_on(vertex, second))
        || second.iter().any(|vertex| is_on(vertex, first))
}

/// Returns whether `vertex` is one of `vertices`, or is tied to an edge between two of `vertices`.
fn is_on(vertex: &Vertex, vertices: &[Vertex]) -> bool {
    has_number(vertices, vertex.number)
        || vertex.between.is_some_and(|[a, b]| has_number(vertices, a) && has_number(vertices, b))
}

/// Returns whether one of `vertices` has the given `number`.
fn has_number(vertices: &[Vertex], number: u32) -> bool {
    vertices.iter().any(|vertex| vertex.number == number)
}
