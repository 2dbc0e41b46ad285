//! Repair of a triangulation, step by step, with a note on each.

use std::fmt;

use super::edges::Edges;
use super::holes::{Hole, close, find_holes};
use super::inspection::MeshInspection;
use super::merge::{drop_degenerate, drop_unused, merge_coincident, merge_vertices};
use super::orientation::orient;
use super::thinning::{ThinningLimits, thin};
use crate::body::Mesh;
use crate::mesh_io::Triangulation;
use crate::vector::Vector;

/// What a repair may do, in m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RepairSettings {
    /// Distance below which vertices are merged. 1 µm is far below what cloth feels, and far above
    /// the digits that files have.
    pub merge_distance: f64,
    /// Length of the longest hole that is closed: larger ones are openings, such as a neck.
    pub hole_length: f64,
    /// Distance by which the surface may move where it is thinned; 0 keeps all triangles.
    pub thinning_distance: f64,
    /// Length of the longest edge that thinning makes.
    pub edge_length: f64,
}

impl RepairSettings {
    /// Returns the settings for cloth of a spacing, in m: holes up to twelve spacings long are
    /// closed, and thinning moves the surface by up to a fiftieth of a spacing and makes no edge
    /// longer than one.
    #[must_use]
    pub fn for_spacing(spacing: f64) -> RepairSettings {
        RepairSettings {
            merge_distance: 1e-6,
            hole_length: 12.0 * spacing,
            thinning_distance: 0.02 * spacing,
            edge_length: spacing,
        }
    }
}

/// Note on something that a repair did, or left.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum RepairNote {
    /// Vertices were merged with others at the same position.
    Merged {
        /// Number of the vertices.
        vertices: usize,
    },
    /// Triangles without area, or that were there twice, were left out.
    Dropped {
        /// Number of the triangles.
        triangles: usize,
    },
    /// Triangles were turned, so that all have their outside outside.
    Turned {
        /// Number of the triangles.
        triangles: usize,
    },
    /// A hole was closed.
    Closed {
        /// Number of its edges.
        edges: usize,
        /// Their length, in m.
        length: f64,
        /// Its middle, in m.
        place: [f64; 3],
    },
    /// A hole is longer than those that are closed.
    Left {
        /// Number of its edges.
        edges: usize,
        /// Their length, in m.
        length: f64,
        /// Its middle, in m.
        place: [f64; 3],
    },
    /// Triangles were merged into fewer.
    Thinned {
        /// Number before.
        from: usize,
        /// Number after.
        to: usize,
        /// Largest distance of a vertex that was there from the new surface, in m.
        distance: f64,
    },
}

impl fmt::Display for RepairNote {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let at = |[x, y, z]: Vector| format!("({x:.4}, {y:.4}, {z:.4}) m");
        match self {
            Self::Merged { vertices } => {
                write!(f, "{vertices} vertices were merged with others at the same position")
            }
            Self::Dropped { triangles } => {
                write!(f, "{triangles} triangles without area, or there twice, were left out")
            }
            Self::Turned { triangles } => {
                write!(f, "{triangles} triangles were turned, so that the outside is outside")
            }
            Self::Closed { edges, length, place } => {
                write!(
                    f,
                    "a hole of {edges} edges, {:.1} mm long, was closed at {}",
                    1e3 * length,
                    at(*place)
                )
            }
            Self::Left { edges, length, place } => write!(
                f,
                "a hole of {edges} edges, {:.1} mm long, at {} is larger than those that are closed, or a lid does not close it",
                1e3 * length,
                at(*place)
            ),
            Self::Thinned { from, to, distance } => write!(
                f,
                "{from} triangles were thinned to {to}; the surface moved by up to {:.3} mm",
                1e3 * distance
            ),
        }
    }
}

/// Mesh that was repaired.
#[derive(Debug, Clone, PartialEq)]
pub struct Repaired {
    /// The mesh.
    pub mesh: Triangulation,
    /// What was done, in the order in which it was.
    pub notes: Vec<RepairNote>,
}

/// Repairs a mesh as far as that is safe: vertices are merged, triangles without area left out, all
/// turned outside, small holes closed, and fine meshes thinned.
///
/// What it leaves (larger holes, edges with more than two triangles, intersections), an inspection
/// of the result says. A step that would leave a worse body is not taken
/// ([`MeshInspection::is_worse_than`]).
///
/// ```
/// use drape_collide::{Mesh, RepairSettings, Triangulation, repair};
///
/// // A tetrahedron that lacks a face, 1.7 cm around.
/// let vertices = vec![[0.0; 3], [0.005, 0.0, 0.0], [0.0, 0.005, 0.0], [0.0, 0.0, 0.005]];
/// let open = Triangulation { vertices, triangles: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2]] };
/// assert!(Mesh::new(&open.vertices, &open.triangles).is_err());
/// let closed = repair(&open, &RepairSettings::for_spacing(0.01)).mesh;
/// assert!(Mesh::new(&closed.vertices, &closed.triangles).is_ok());
/// ```
#[must_use]
pub fn repair(mesh: &Triangulation, settings: &RepairSettings) -> Repaired {
    let mut mesh = mesh.clone();
    let mut notes = Vec::new();
    let (vertices, triangles) = (mesh.vertices.len(), mesh.triangles.len());
    // First as a body is made, so that what is right already stays as it is.
    merge_coincident(&mut mesh);
    for part in MERGE_PARTS {
        no_worse(&mut mesh, |mesh| merge_vertices(mesh, part * settings.merge_distance));
    }
    let vertices = vertices - mesh.vertices.len();
    if vertices > 0 {
        notes.push(RepairNote::Merged { vertices });
    }
    no_worse(&mut mesh, drop_degenerate);
    let triangles = triangles - mesh.triangles.len();
    if triangles > 0 {
        notes.push(RepairNote::Dropped { triangles });
    }
    drop_unused(&mut mesh);
    let turned = no_worse(&mut mesh, orient).unwrap_or_default();
    notes.extend(close_holes(&mut mesh, settings.hole_length));
    // With its holes closed a part has a volume, which decides about its outside.
    let triangles = turned.max(no_worse(&mut mesh, orient).unwrap_or_default());
    if triangles > 0 {
        notes.push(RepairNote::Turned { triangles });
    }
    notes.extend(no_worse(&mut mesh, |mesh| thinned(mesh, settings)).flatten());
    Repaired { mesh, notes }
}

/// Parts of the distance of merging that are tried one after the other: what joins at a small one needs no
/// large one, at which sheets that nearly touch are joined as well.
const MERGE_PARTS: [f64; 3] = [0.01, 0.1, 1.0];

/// Closes the holes of a mesh up to a length, in m; returns a note on each hole.
fn close_holes(mesh: &mut Triangulation, length_max: f64) -> Vec<RepairNote> {
    let holes = find_holes(mesh, &Edges::new(&mesh.triangles));
    let (short, long): (Vec<&Hole>, Vec<&Hole>) =
        holes.iter().partition(|hole| hole.length <= length_max);
    let close_all = |mesh: &mut Triangulation, holes: &[&Hole]| {
        let lids: Vec<[u32; 3]> = holes.iter().flat_map(|hole| close(mesh, hole)).collect();
        mesh.triangles.extend(lids);
    };
    let all_closed = no_worse(mesh, |mesh| close_all(mesh, &short)).is_some();
    let left = long.into_iter().map(|hole| hole.left());
    let mut notes: Vec<RepairNote> = left.collect();
    for hole in short {
        // Of lids that do not close all together, those are kept that close alone.
        let is_closed = all_closed || no_worse(mesh, |mesh| close_all(mesh, &[hole])).is_some();
        notes.push(if is_closed { hole.closed() } else { hole.left() });
    }
    notes
}

impl Hole {
    fn closed(&self) -> RepairNote {
        let (edges, length, place) = (self.vertices.len(), self.length, self.place);
        RepairNote::Closed { edges, length, place }
    }

    fn left(&self) -> RepairNote {
        let (edges, length, place) = (self.vertices.len(), self.length, self.place);
        RepairNote::Left { edges, length, place }
    }
}

/// Takes a step of a repair and returns its result; or undoes it where it leaves a worse body.
fn no_worse<T>(mesh: &mut Triangulation, step: impl FnOnce(&mut Triangulation) -> T) -> Option<T> {
    let before = mesh.clone();
    let done = step(mesh);
    if *mesh == before {
        return Some(done);
    }
    let is_worse = MeshInspection::new(mesh).is_worse_than(&MeshInspection::new(&before));
    if is_worse {
        *mesh = before;
    }
    (!is_worse).then_some(done)
}

/// Number of attempts to thin a mesh, each with half the distance of the one before.
const ATTEMPTS: usize = 5;

/// Thins a closed mesh, and measures how far its surface moved; a mesh that is open stays as it is.
fn thinned(mesh: &mut Triangulation, settings: &RepairSettings) -> Option<RepairNote> {
    if !(settings.thinning_distance > 0.0) {
        return None;
    }
    Mesh::new(&mesh.vertices, &mesh.triangles).ok()?;
    let from = mesh.triangles.len();
    let mut limits =
        ThinningLimits { distance: settings.thinning_distance, edge_length: settings.edge_length };
    for _ in 0..ATTEMPTS {
        let mut thin_mesh = mesh.clone();
        thin(&mut thin_mesh, limits);
        let to = thin_mesh.triangles.len();
        // A few triangles less are not worth another surface.
        if 10 * to > 9 * from {
            return None;
        }
        let surface = Mesh::new(&thin_mesh.vertices, &thin_mesh.triangles).ok()?;
        let distance = |vertex: &Vector| surface.signed_distance(*vertex).distance.abs();
        let distance = mesh.vertices.iter().map(distance).fold(0.0, f64::max);
        if distance <= settings.thinning_distance {
            *mesh = thin_mesh;
            return Some(RepairNote::Thinned { from, to, distance });
        }
        limits.distance *= 0.5;
    }
    None
}
