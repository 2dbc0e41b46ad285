//! Mesh with its tree of boxes, at given positions and on a motion.

use super::boxes::{AxisBox, Tree};
use super::leaf::{Leaf, NumberedLeaf};
use crate::error::{Error, check_position};
use crate::vector::{Vector, add, scale};

/// Mesh of triangles, edges and points at given positions, with a tree of boxes.
///
/// The mesh needs no areas, groups or seams, and it may be open, in several pieces, or a point
/// cloud. Vertices that neither a triangle nor an edge names are points, which meet the primitives
/// of other meshes like all others.
///
/// # Examples
///
/// ```
/// use drape_collide::{Primitive, ProximityMesh, mesh_distance};
///
/// // A floor of one triangle, and a cloud of two points over it.
/// let floor = [[-1.0, 0.0, -1.0], [-1.0, 0.0, 1.0], [1.0, 0.0, 0.0]];
/// let floor = ProximityMesh::new(&floor, &[[0, 1, 2]])?;
/// let cloud = ProximityMesh::new(&[[0.0, 0.5, 0.0], [0.1, 0.2, 0.0]], &[])?;
///
/// let nearest = mesh_distance(&cloud, &floor);
/// assert_eq!(nearest.pair.first, Primitive::Vertex(1));
/// assert_eq!(nearest.pair.second, Primitive::Triangle(0));
/// assert!((nearest.distance - 0.2).abs() < 1e-15);
/// # Ok::<(), drape_collide::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct ProximityMesh {
    positions: Vec<Vector>,
    leaves: Vec<Leaf>,
    triangle_count: usize,
    tree: Tree,
    boxes: Vec<AxisBox>,
}

impl ProximityMesh {
    /// Returns the mesh of `triangles` with vertices at `positions`, in m.
    ///
    /// # Errors
    ///
    /// There is no position; a coordinate is not finite or beyond 1000 km; or a triangle names a
    /// vertex twice or a vertex without a position.
    pub fn new(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Result<ProximityMesh, Error> {
        ProximityMesh::with_edges(positions, triangles, &[])
    }

    /// Returns the mesh of `triangles` and of `edges` beside their sides, such as yarns, with
    /// vertices at `positions`, in m.
    ///
    /// # Errors
    ///
    /// As for [`new`](ProximityMesh::new). The errors of triangles hold for edges too.
    pub fn with_edges(
        positions: &[[f64; 3]],
        triangles: &[[u32; 3]],
        edges: &[[u32; 2]],
    ) -> Result<ProximityMesh, Error> {
        check_vertices(positions)?;
        let vertices = positions.len();
        for (triangle, &corners) in triangles.iter().enumerate() {
            if let Some(&index) = corners.iter().find(|corner| **corner as usize >= vertices) {
                return Err(Error::MissingVertex { triangle, index, vertices });
            }
            let [a, b, c] = corners;
            if a == b || b == c || c == a {
                return Err(Error::RepeatedVertex { triangle, corners });
            }
        }
        for (edge, &ends) in edges.iter().enumerate() {
            if ends[0] == ends[1] || ends.iter().any(|end| *end as usize >= vertices) {
                return Err(Error::InvalidEdge { edge, ends, vertices });
            }
        }

        let leaves = Leaf::list(vertices, triangles, edges);
        let middle = |leaf: &Leaf| {
            let [a, b, c] = leaf.corners.map(|corner| positions[corner as usize]);
            scale(add(add(a, b), c), 1.0 / 3.0)
        };
        let centres: Vec<Vector> = leaves.iter().map(middle).collect();
        let mut mesh = ProximityMesh {
            tree: Tree::new(&centres),
            positions: positions.to_vec(),
            leaves,
            triangle_count: triangles.len(),
            boxes: Vec::new(),
        };
        mesh.boxes = mesh.boxes_at(positions);
        Ok(mesh)
    }

    /// Returns the positions of the vertices, in m.
    #[must_use]
    pub fn positions(&self) -> &[[f64; 3]] {
        &self.positions
    }

    /// Moves the vertices to `positions`, in m. The tree keeps its order and fits its boxes anew,
    /// which takes a twentieth of the time of [`new`](ProximityMesh::new). After a large deformation a
    /// new mesh answers faster.
    ///
    /// # Errors
    ///
    /// There is not one position for each vertex, or a coordinate is not finite or beyond 1000 km.
    pub fn move_to(&mut self, positions: &[[f64; 3]]) -> Result<(), Error> {
        self.check_positions(positions)?;
        self.positions.copy_from_slice(positions);
        self.boxes = self.boxes_at(positions);
        Ok(())
    }

    /// Returns the motion in which every vertex moves straight and evenly from its position to its
    /// place in `end`, in m.
    ///
    /// # Errors
    ///
    /// As for [`move_to`](ProximityMesh::move_to).
    pub fn moving_to<'a>(&'a self, end: &'a [[f64; 3]]) -> Result<MeshMotion<'a>, Error> {
        self.check_positions(end)?;
        Ok(MeshMotion { mesh: self, end, end_boxes: self.boxes_at(end) })
    }

    /// Returns the motion in which every vertex keeps its position.
    #[must_use]
    pub fn at_rest(&self) -> MeshMotion<'_> {
        MeshMotion { mesh: self, end: &self.positions, end_boxes: self.boxes.clone() }
    }

    /// Returns the tree.
    pub(super) fn tree(&self) -> &Tree {
        &self.tree
    }

    /// Returns the box of each node of the tree.
    pub(super) fn boxes(&self) -> &[AxisBox] {
        &self.boxes
    }

    /// Returns leaf `number`.
    pub(super) fn leaf(&self, number: u32) -> NumberedLeaf<'_> {
        let (leaf, triangle_count) = (&self.leaves[number as usize], self.triangle_count);
        NumberedLeaf { leaf, number, triangle_count }
    }

    /// Returns the box of each node of the tree with the vertices at `positions`, in m.
    fn boxes_at(&self, positions: &[Vector]) -> Vec<AxisBox> {
        self.tree.fit(|leaf| {
            let corners = self.leaves[leaf as usize].corners;
            AxisBox::around(&corners.map(|corner| positions[corner as usize]))
        })
    }

    /// Checks the number and the range of `positions`, in m.
    fn check_positions(&self, positions: &[Vector]) -> Result<(), Error> {
        let (found, needed) = (positions.len(), self.positions.len());
        if found != needed {
            return Err(Error::WrongLength { what: "positions", found, needed });
        }
        check_vertices(positions)
    }
}

/// Motion of a [`ProximityMesh`]: every vertex moves straight and evenly from its position to an
/// end. [`moving_to`](ProximityMesh::moving_to) and [`at_rest`](ProximityMesh::at_rest) return
/// motions.
#[derive(Debug, Clone)]
pub struct MeshMotion<'a> {
    pub(super) mesh: &'a ProximityMesh,
    pub(super) end: &'a [Vector],
    /// Box of each node of the tree at the end.
    pub(super) end_boxes: Vec<AxisBox>,
}

/// Checks that there are `positions`, and their range.
fn check_vertices(positions: &[Vector]) -> Result<(), Error> {
    if positions.is_empty() {
        return Err(Error::NoVertices);
    }
    for (vertex, &position) in positions.iter().enumerate() {
        check_position(|| format!("vertex {vertex}"), position)?;
    }
    Ok(())
}
