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
        /// The quantity, in words.
        what: String,
        /// Its value as given.
        value: f64,
        /// The values that it may take, in words.
        range: &'static str,
    },

    /// A position has a coordinate that is not finite or too far out.
    #[error(
        "{what}: the coordinates {place:?} are not usable; each must be a finite number of at most \
         {limit:e} m in size (is the unit right?)"
    )]
    InvalidPosition {
        /// Whose position, in words.
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
        /// The quaternion as given, scalar last.
        rotation: [f64; 4],
        /// Its length, which should be 1.
        length: f64,
    },

    /// A mesh file cannot be opened or read.
    #[error("mesh file {}: {reason}; check the path and the permissions", path.display())]
    UnreadableFile {
        /// The file.
        path: PathBuf,
        /// What the operating system answered.
        reason: String,
    },

    /// A mesh file is of no known format.
    #[error("mesh file {}: its name ends in none of .obj, .stl and .ply; export it as one of these", path.display())]
    UnknownMeshFormat {
        /// The file.
        path: PathBuf,
    },

    /// A file is longer than any that is read.
    #[error("{} has {bytes} bytes, and at most {limit} are read; simplify the mesh or shorten the motion, or read it with --raise-limits {times}", path.display())]
    FileTooLong {
        /// The file.
        path: PathBuf,
        /// Its length.
        bytes: u64,
        /// The greatest length.
        limit: u64,
        /// The least number of times the usual greatest length that it fits in.
        times: u64,
    },

    /// A mesh file is not well-formed.
    #[error("mesh file {}: {reason}; export it again", path.display())]
    MalformedFile {
        /// The file.
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

    /// A triangle refers to a vertex that does not exist.
    #[error(
        "triangle {triangle} refers to vertex {index}, but the mesh has {vertices} vertices \
         (numbered from 0)"
    )]
    MissingVertex {
        /// The triangle, from 0.
        triangle: usize,
        /// The vertex that it names.
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
        /// The triangle, from 0.
        triangle: usize,
        /// Its first corner, in m.
        place: [f64; 3],
        /// Twice its area, in m².
        area: f64,
    },

    /// The surface has edges with a triangle on one side only.
    #[error("the mesh is open: {edges} boundary edges, one of them at {place:?}; fill the holes")]
    OpenMesh {
        /// Number of boundary edges.
        edges: usize,
        /// Middle of one of them, in m.
        place: [f64; 3],
    },

    /// The surface has edges with more than two triangles.
    #[error(
        "the mesh is not manifold: {edges} edges have more than two triangles, one of them at \
         {place:?} has {triangles}; remove inner faces and doubled ones"
    )]
    NonManifoldMesh {
        /// Number of such edges.
        edges: usize,
        /// Triangles of one of them.
        triangles: usize,
        /// Its middle, in m.
        place: [f64; 3],
    },

    /// The surface has neighbours that disagree on which side is out.
    #[error(
        "the mesh has {edges} edges whose triangles do not agree on inside and outside, one of \
         them at {place:?}; make its normals consistent"
    )]
    InconsistentOrientation {
        /// Number of such edges.
        edges: usize,
        /// Middle of one of them, in m.
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
        /// The particle, from 0.
        particle: usize,
        /// The area as given, in m².
        area: f64,
    },

    /// A list does not have as many entries as the surface asks for.
    #[error("there are {found} {what}, but the surface needs {needed}")]
    WrongLength {
        /// Content of the list.
        what: &'static str,
        /// Its length.
        found: usize,
        /// The length that it should have.
        needed: usize,
    },

    /// A vertex has a group without distances.
    #[error(
        "vertex {vertex} is of group {group}, but there are distances of {groups} groups (numbered from 0)"
    )]
    MissingGroup {
        /// The vertex, from 0.
        vertex: usize,
        /// Its group.
        group: u32,
        /// Number of distances.
        groups: usize,
    },

    /// A seam refers to a vertex that does not exist.
    #[error("vertex {index} is sewn, but the surface has {vertices} vertices (numbered from 0)")]
    MissingSeamVertex {
        /// The vertex that is named.
        index: u32,
        /// Number of vertices.
        vertices: usize,
    },

    /// A triangle of a surface names a vertex twice.
    #[error("triangle {triangle} has the corners {corners:?}; they must differ")]
    RepeatedVertex {
        /// The triangle, from 0.
        triangle: usize,
        /// Its vertices.
        corners: [u32; 3],
    },

    /// A triangle of a surface joins two groups, or free and prescribed vertices.
    #[error(
        "triangle {triangle} has the corners {corners:?}, which are not all of one group or not \
         all free; sew panels with seam_pairs instead"
    )]
    MixedTriangle {
        /// The triangle, from 0.
        triangle: usize,
        /// Its vertices.
        corners: [u32; 3],
    },

    /// Two primitives of a panel or a body that share no vertex touch at rest.
    #[error(
        "the vertices {vertices:?} of one group are {distance:e} m apart at rest and share no \
         triangle; contact needs at least {least:e} m"
    )]
    ContactAtRest {
        /// The vertices of the two primitives.
        vertices: [u32; 4],
        /// Their distance at rest, in m.
        distance: f64,
        /// The smallest distance that would do, in m.
        least: f64,
    },

    /// More candidate pairs were found than the list may hold.
    #[error(
        "more than {capacity} pairs of primitives are near each other; is the cloth crushed, or \
         the activation distance far larger than the triangles?"
    )]
    TooManyPairs {
        /// Capacity of the list.
        capacity: usize,
    },

    /// A vertex has drifted since detection by more than the candidate pairs allow.
    #[error(
        "vertex {vertex} is {moved:e} m from where its pairs were detected, but they hold for \
         {budget:e} m only; detect again before so large a displacement"
    )]
    DriftBudgetExceeded {
        /// The vertex, from 0.
        vertex: usize,
        /// Drift since detection, in m.
        moved: f64,
        /// Largest drift that the pairs allow, in m.
        budget: f64,
    },
    /// A state of contact that was saved has numbers that no contact has: take an earlier one.
    #[error("the saved state of contact has numbers that no contact has")]
    SavedContact,
}

/// Checks a number against its range.
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

/// Largest coordinate that a body may have, in m.
///
/// At this size neighbouring numbers are 1e-10 m apart, a millionth of a usual contact gap; larger
/// coordinates are a mistake of unit, and boxes of a tree would overflow.
const MAX_COORDINATE: f64 = 1e6;

impl Error {
    /// Returns whether the error is a fault of a surface that [`repair`](crate::repair) may mend.
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

/// Checks that a position is finite and within [`MAX_COORDINATE`].
pub(crate) fn check_position(what: impl FnOnce() -> String, place: [f64; 3]) -> Result<(), Error> {
    // Written so that NaN fails.
    if place.iter().all(|value| value.abs() <= MAX_COORDINATE) {
        return Ok(());
    }
    Err(Error::InvalidPosition { what: what(), place, limit: MAX_COORDINATE })
}

/// Checks flat positions of three numbers each.
pub(crate) fn check_positions(what: &str, positions: &[f64]) -> Result<(), Error> {
    for (k, place) in positions.chunks_exact(3).enumerate() {
        check_position(|| format!("{what} {k}"), [place[0], place[1], place[2]])?;
    }
    Ok(())
}
