//! Primitives by which distances and impacts are named.

/// Primitive of a mesh: a vertex, an edge or a triangle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Primitive {
    /// Number of a vertex in the positions of the mesh.
    Vertex(u32),
    /// Numbers of the two ends of an edge, the lower first.
    Edge([u32; 2]),
    /// Number of a triangle in the triangles of the mesh.
    Triangle(u32),
}

/// Pair of primitives of two meshes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PrimitivePair {
    /// Primitive of the first mesh.
    pub first: Primitive,
    /// Primitive of the second mesh. It is a primitive of the first mesh too, if one mesh meets
    /// itself.
    pub second: Primitive,
}
