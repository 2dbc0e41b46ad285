//! Errors of the crate, and the checks that raise them.

use std::path::PathBuf;

/// Error of a body, a mesh, a file or a contact.
///
/// Every variant has one remedy and carries the values that led to it.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A length of a shape, a friction coefficient or a setting is outside its range.
    #[error("{what} is {value}, but it must be {range}")]
    OutOfRange {
        /// Name of the quantity, in words.
        what: String,
        /// Value as given.
        value: f64,
        /// Allowed values, in words.
        range: &'static str,
    },

    /// A position has a coordinate that is not finite or too far out.
    #[error(
        "{what}: the coordinates {place:?} are not usable; each must be a finite number of at most \
         {limit:e} m in size (is the unit right?)"
    )]
    InvalidPosition {
        /// Owner of the position, in words.
        what: String,
        /// The coordinates as given, in m.
        place: [f64; 3],
        /// Largest size that a coordinate may have, in m.
        limit: f64,
    },

    /// A rotation is not a unit quaternion.
    #[error(
        "body `{body}`: the rotation {rotation:?} has length {length}; give a unit quaternion \
         (x, y, z, w) or build the pose with `Pose::rotated`"
    )]
    InvalidRotation {
        /// Name of the body.
        body: String,
        /// Quaternion as given, scalar last.
        rotation: [f64; 4],
        /// Length of the quaternion, which should be 1.
        length: f64,
    },

    /// A number that names a body, a vertex or a group does not exist.
    #[error("there is no {what} {index}; there are {count} (numbered from 0)")]
    MissingIndex {
        /// Kind of the thing, in words.
        what: &'static str,
        /// Number as given.
        index: usize,
        /// Number of things.
        count: usize,
    },

    /// A surface has no free vertex, so nothing in it could have contact.
    #[error(
        "none of the {vertices} vertices of the surface is free, so none has contact: bodies do \
         not meet bodies; declare what may move by `free_vertices`, or ask `earliest_impact` or \
         `mesh_distance` whether bodies meet"
    )]
    NothingFree {
        /// Number of vertices.
        vertices: usize,
    },

    /// A mesh file cannot be opened or read.
    #[error("mesh file {}: {reason}; check the path and the permissions", path.display())]
    UnreadableFile {
        /// Path of the file.
        path: PathBuf,
        /// Answer of the operating system.
        reason: String,
    },

    /// The name of a mesh file ends in no known extension.
    #[error("mesh file {}: its name ends in none of .obj, .stl and .ply; export it as one of these", path.display())]
    UnknownMeshFormat {
        /// Path of the file.
        path: PathBuf,
    },

    /// The crate was built without its feature `mesh-files`.
    #[error("mesh file {}: drape-collide was built without its feature `mesh-files`; add the feature, or give the triangles", path.display())]
    WithoutMeshFiles {
        /// Path of the file.
        path: PathBuf,
    },

    /// A file is longer than the limit.
    #[error("{} has {bytes} bytes, and at most {limit} are read; simplify the mesh or shorten the motion, or read it with {times} times the usual limit", path.display())]
    FileTooLong {
        /// Path of the file.
        path: PathBuf,
        /// Length of the file, in bytes.
        bytes: u64,
        /// Greatest length that is read, in bytes.
        limit: u64,
        /// Smallest whole multiple of the usual limit that the file fits in.
        times: u64,
    },

    /// A mesh file is not well-formed.
    #[error("mesh file {}: {reason}; export it again", path.display())]
    MalformedFile {
        /// Path of the file.
        path: PathBuf,
        /// Message of the parser.
        reason: String,
    },

    /// A mesh has no triangles.
    #[error("the mesh has {vertices} vertices and no triangles; a body needs a closed surface")]
    EmptyMesh {
        /// Number of vertices.
        vertices: usize,
    },

    /// A mesh or a point cloud has no vertices.
    #[error("the mesh has no vertices; give at least one position")]
    NoVertices,

    /// An edge of a mesh names a vertex twice, or a vertex that does not exist.
    #[error(
        "edge {edge} has the ends {ends:?}; they must differ, and the mesh has {vertices} vertices \
         (numbered from 0)"
    )]
    InvalidEdge {
        /// Number of the edge, from 0.
        edge: usize,
        /// Vertex numbers of the edge.
        ends: [u32; 2],
        /// Number of vertices.
        vertices: usize,
    },

    /// A triangle refers to a vertex that does not exist.
    #[error(
        "triangle {triangle} refers to vertex {index}, but the mesh has {vertices} vertices \
         (numbered from 0)"
    )]
    MissingVertex {
        /// Number of the triangle, from 0.
        triangle: usize,
        /// Vertex number that does not exist.
        index: u32,
        /// Number of vertices.
        vertices: usize,
    },

    /// A triangle has no area although its corners differ.
    #[error(
        "triangle {triangle} near {place:?} has no area (twice the area is {area:e} m²); \
         dissolve it in the modeller"
    )]
    FlatTriangle {
        /// Number of the triangle, from 0.
        triangle: usize,
        /// First corner of the triangle, in m.
        place: [f64; 3],
        /// Twice the area of the triangle, in m².
        area: f64,
    },

    /// The surface has edges with a triangle on only one side.
    #[error("the mesh is open: {edges} boundary edges, one of them at {place:?}; fill the holes")]
    OpenMesh {
        /// Number of boundary edges.
        edges: usize,
        /// Middle of one boundary edge, in m.
        place: [f64; 3],
    },

    /// The surface has edges with more than two triangles.
    #[error(
        "the mesh is not manifold: {edges} edges have more than two triangles, one of them at \
         {place:?} has {triangles}; remove inner faces and doubled ones"
    )]
    NonManifoldMesh {
        /// Number of edges with more than two triangles.
        edges: usize,
        /// Number of triangles at one of these edges.
        triangles: usize,
        /// Middle of that edge, in m.
        place: [f64; 3],
    },

    /// Neighbouring triangles disagree about the outside.
    #[error(
        "the mesh has {edges} edges whose triangles do not agree on inside and outside, one of \
         them at {place:?}; make its normals consistent"
    )]
    InconsistentOrientation {
        /// Number of edges between triangles that disagree.
        edges: usize,
        /// Middle of one of these edges, in m.
        place: [f64; 3],
    },

    /// The surface is closed but encloses nothing.
    #[error("the mesh encloses a volume of {volume:e} m³ only; a body needs an inside")]
    NoVolume {
        /// Enclosed volume, in m³.
        volume: f64,
    },

    /// The lumped area of a particle is negative or not finite.
    #[error("the area of particle {particle} is {area}; it must be finite and not negative")]
    InvalidArea {
        /// Number of the particle, from 0.
        particle: usize,
        /// Area as given, in m².
        area: f64,
    },

    /// A list has not the length that the surface needs.
    #[error("there are {found} {what}, but the surface needs {needed}")]
    WrongLength {
        /// Content of the list.
        what: &'static str,
        /// Length of the list.
        found: usize,
        /// Length that the surface needs.
        needed: usize,
    },

    /// A vertex belongs to a group for which no distances are given.
    #[error(
        "vertex {vertex} is of group {group}, but there are distances of {groups} groups (numbered from 0)"
    )]
    MissingGroup {
        /// Number of the vertex, from 0.
        vertex: usize,
        /// Group of the vertex.
        group: u32,
        /// Number of groups with distances.
        groups: usize,
    },

    /// A seam refers to a vertex that does not exist.
    #[error("vertex {index} is sewn, but the surface has {vertices} vertices (numbered from 0)")]
    MissingSeamVertex {
        /// Vertex number that does not exist.
        index: u32,
        /// Number of vertices.
        vertices: usize,
    },

    /// A triangle of a surface names a vertex twice.
    #[error("triangle {triangle} has the corners {corners:?}; they must differ")]
    RepeatedVertex {
        /// Number of the triangle, from 0.
        triangle: usize,
        /// Vertex numbers of the triangle.
        corners: [u32; 3],
    },

    /// A triangle of a surface joins two groups, or free and prescribed vertices.
    #[error(
        "triangle {triangle} has the corners {corners:?}, which are not all of one group or not \
         all free; sew panels with seam_pairs instead"
    )]
    MixedTriangle {
        /// Number of the triangle, from 0.
        triangle: usize,
        /// Vertex numbers of the triangle.
        corners: [u32; 3],
    },

    /// Two primitives of a panel or a body that share no vertex touch at rest.
    #[error(
        "the vertices {vertices:?} of one group are {distance:e} m apart at rest and share no \
         triangle; contact needs at least {least:e} m"
    )]
    ContactAtRest {
        /// Vertex numbers of the two primitives.
        vertices: [u32; 4],
        /// Distance of the primitives at rest, in m.
        distance: f64,
        /// Smallest distance that contact accepts, in m.
        least: f64,
    },

    /// More candidate pairs were detected than the list may hold.
    #[error(
        "more than {capacity} pairs of primitives are near each other; is the cloth crushed, or \
         the activation distance far larger than the triangles?"
    )]
    TooManyPairs {
        /// Capacity of the list.
        capacity: usize,
    },

    /// A vertex has moved since detection by more than the candidate pairs allow.
    #[error(
        "vertex {vertex} is {moved:e} m from where its pairs were detected, but they hold for \
         {budget:e} m only; detect again before so large a displacement"
    )]
    DriftBudgetExceeded {
        /// Number of the vertex, from 0.
        vertex: usize,
        /// Distance of the vertex from its position at detection, in m.
        moved: f64,
        /// Largest distance that the pairs allow, in m.
        budget: f64,
    },

    /// A call of contact needs an open step, and no step is open.
    #[error("no step of the contact is open; open one with `SurfaceContact::begin` first")]
    NoOpenStep,

    /// A call of contact is for the time between two steps, and a step is open.
    #[error(
        "a step of the contact is open; end it with `OpenStep::commit` or `OpenStep::reject` first"
    )]
    StepIsOpen,

    /// A saved state of contact holds numbers that no contact produces. Take an earlier one.
    #[error("the saved state of contact has numbers that no contact has")]
    SavedContact,
}

/// Checks that `value` is finite and that its condition `holds`. The error names `what` and
/// `range`.
pub(crate) fn check(
    what: impl Into<String>,
    value: f64,
    range: &'static str,
    holds: bool,
) -> Result<(), Error> {
    if value.is_finite() && holds {
        return Ok(());
    }
    Err(Error::OutOfRange { what: what.into(), value, range })
}

impl Error {
    /// Returns whether [`repair`](crate::repair) may mend the fault, which is a fault of a surface.
    #[must_use]
    pub fn is_fault_of_surface(&self) -> bool {
        matches!(
            self,
            Self::FlatTriangle { .. }
                | Self::OpenMesh { .. }
                | Self::NonManifoldMesh { .. }
                | Self::InconsistentOrientation { .. }
                | Self::NoVolume { .. }
        )
    }
}

/// Largest coordinate that a body may have, in m.
///
/// At this size neighbouring numbers are 1e-10 m apart, a millionth of a usual contact gap. Larger
/// coordinates are a mistake of unit, and the boxes of a tree would overflow.
const MAX_COORDINATE: f64 = 1e6;

/// Checks that the list of `what` has the length `found` that is `needed`.
pub(crate) fn check_length(what: &'static str, found: usize, needed: usize) -> Result<(), Error> {
    if found == needed { Ok(()) } else { Err(Error::WrongLength { what, found, needed }) }
}

/// Checks that there is number `index` of `count` things. The error names `what`.
pub(crate) fn check_index(what: &'static str, index: usize, count: usize) -> Result<(), Error> {
    if index < count { Ok(()) } else { Err(Error::MissingIndex { what, index, count }) }
}

/// Checks that `place`, in m, is finite and within [`MAX_COORDINATE`]. The error names `what`.
pub(crate) fn check_position(what: impl FnOnce() -> String, place: [f64; 3]) -> Result<(), Error> {
    // The comparison is false for NaN, which fails the check.
    if place.iter().all(|value| value.abs() <= MAX_COORDINATE) {
        return Ok(());
    }
    Err(Error::InvalidPosition { what: what(), place, limit: MAX_COORDINATE })
}

/// Checks the flat `positions` of three coordinates each, in m. Errors name `what` with a number.
pub(crate) fn check_positions(what: &str, positions: &[f64]) -> Result<(), Error> {
    for (k, place) in positions.chunks_exact(3).enumerate() {
        check_position(|| format!("{what} {k}"), [place[0], place[1], place[2]])?;
    }
    Ok(())
}
