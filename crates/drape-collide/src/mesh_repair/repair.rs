//! Repair of a triangulation, step by step, with a note on each step.

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

/// Limits of a repair, all lengths in m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RepairSettings {
    /// Distance below which vertices are merged. 1 µm is far below what cloth feels, and far above
    /// the precision of files.
    pub merge_distance: f64,
    /// Length of the longest hole that is closed. Longer ones are openings, such as a neck.
    pub hole_length: f64,
    /// Distance by which thinning may move the surface. 0 keeps all triangles.
    pub thinning_distance: f64,
    /// Length of the longest edge that thinning creates.
    pub edge_length: f64,
}

impl RepairSettings {
    /// Returns the settings for cloth with `spacing`, in m. Holes up to twelve spacings long are
    /// closed. Thinning moves the surface by up to a fiftieth of `spacing` and creates no edge
    /// longer than `spacing`.
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

/// Note on a change that a repair made, or on a hole that it left open.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum RepairNote {
    /// Vertices were merged with others at their position.
    Merged {
        /// Number of merged vertices.
        vertices: usize,
    },
    /// Triangles that had no area or occurred twice were left out.
    Dropped {
        /// Number of triangles that were left out.
        triangles: usize,
    },
    /// Triangles were turned, so that all face outwards.
    Turned {
        /// Number of turned triangles.
        triangles: usize,
    },
    /// A hole was closed.
    Closed {
        /// Number of edges around the hole.
        edges: usize,
        /// Length of these edges together, in m.
        length: f64,
        /// Middle of the hole, in m.
        place: [f64; 3],
    },
    /// A hole was left open: it is too long, or triangles cannot close it.
    Left {
        /// Number of edges around the hole.
        edges: usize,
        /// Length of these edges together, in m.
        length: f64,
        /// Middle of the hole, in m.
        place: [f64; 3],
    },
    /// Triangles were merged into fewer ones.
    Thinned {
        /// Number of triangles before.
        from: usize,
        /// Number of triangles after.
        to: usize,
        /// Largest distance of an earlier vertex from the new surface, in m.
        distance: f64,
    },
}

impl fmt::Display for RepairNote {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Each note is one sentence for a report.
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
                    place_text(*place)
                )
            }
            Self::Left { edges, length, place } => write!(
                f,
                "a hole of {edges} edges, {:.1} mm long, at {} is larger than those that are closed, or a lid does not close it",
                1e3 * length,
                place_text(*place)
            ),
            Self::Thinned { from, to, distance } => write!(
                f,
                "{from} triangles were thinned to {to}; the surface moved by up to {:.3} mm",
                1e3 * distance
            ),
        }
    }
}

/// Returns `place`, in m, as text with four decimals.
fn place_text([x, y, z]: Vector) -> String {
    format!("({x:.4}, {y:.4}, {z:.4}) m")
}

/// Result of [`repair`]: the repaired mesh and notes on all changes.
#[derive(Debug, Clone, PartialEq)]
pub struct RepairedMesh {
    /// Repaired mesh.
    pub mesh: Triangulation,
    /// Notes on the changes, in the order in which they were made.
    pub notes: Vec<RepairNote>,
}

/// Fractions of the merge distance that are tried one after the other.
///
/// Vertices that join at a small distance need no large one, at which sheets that nearly touch
/// would be joined as well.
const MERGE_FRACTIONS: [f64; 3] = [0.01, 0.1, 1.0];

/// Repairs `mesh` as far as that is safe: merges vertices, leaves out triangles without area, turns
/// triangles outwards, closes small holes, and thins fine meshes within `settings`.
///
/// Larger holes, edges with more than two triangles, and intersections remain; an inspection of the
/// result shows them. A step that would leave a worse body is undone
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
pub fn repair(mesh: &Triangulation, settings: &RepairSettings) -> RepairedMesh {
    let mut mesh = mesh.clone();
    let mut notes = Vec::new();
    let (vertices_before, triangles_before) = (mesh.vertices.len(), mesh.triangles.len());

    // Merging as `Mesh` does comes first, so that a mesh without faults stays as it is.
    merge_coincident(&mut mesh);
    for fraction in MERGE_FRACTIONS {
        step_or_undo(&mut mesh, |mesh| merge_vertices(mesh, fraction * settings.merge_distance));
    }
    let vertices = vertices_before - mesh.vertices.len();
    if vertices > 0 {
        notes.push(RepairNote::Merged { vertices });
    }

    step_or_undo(&mut mesh, drop_degenerate);
    let dropped = triangles_before - mesh.triangles.len();
    if dropped > 0 {
        notes.push(RepairNote::Dropped { triangles: dropped });
    }
    drop_unused(&mut mesh);

    let turned = step_or_undo(&mut mesh, orient).unwrap_or_default();
    notes.extend(close_holes(&mut mesh, settings.hole_length));
    // A part whose holes are closed has a volume, which decides about its outside.
    let turned = turned.max(step_or_undo(&mut mesh, orient).unwrap_or_default());
    if turned > 0 {
        notes.push(RepairNote::Turned { triangles: turned });
    }

    notes.extend(step_or_undo(&mut mesh, |mesh| thin_within(mesh, settings)).flatten());
    RepairedMesh { mesh, notes }
}

/// Closes the holes of `mesh` that are at most `length_max` long, in m. Returns a note on each
/// hole.
fn close_holes(mesh: &mut Triangulation, length_max: f64) -> Vec<RepairNote> {
    let holes = find_holes(mesh, &Edges::new(&mesh.triangles));
    let (short, long): (Vec<&Hole>, Vec<&Hole>) =
        holes.iter().partition(|hole| hole.length <= length_max);
    let mut notes: Vec<RepairNote> = long.into_iter().map(Hole::left_note).collect();

    // If the holes cannot be closed together, each is tried alone.
    let all_closed = step_or_undo(mesh, |mesh| add_lids(mesh, &short)).is_some();
    for hole in short {
        let is_closed = all_closed || step_or_undo(mesh, |mesh| add_lids(mesh, &[hole])).is_some();
        notes.push(if is_closed { hole.closed_note() } else { hole.left_note() });
    }
    notes
}

/// Adds the triangles that close `holes` to `mesh`.
fn add_lids(mesh: &mut Triangulation, holes: &[&Hole]) {
    let lids: Vec<[u32; 3]> = holes.iter().flat_map(|hole| close(mesh, hole)).collect();
    mesh.triangles.extend(lids);
}

impl Hole {
    fn closed_note(&self) -> RepairNote {
        let (edges, length, place) = (self.vertices.len(), self.length, self.place);
        RepairNote::Closed { edges, length, place }
    }

    fn left_note(&self) -> RepairNote {
        let (edges, length, place) = (self.vertices.len(), self.length, self.place);
        RepairNote::Left { edges, length, place }
    }
}

/// Runs `step` on `mesh` and returns its result. Undoes the step and returns `None` if it leaves a
/// worse body.
fn step_or_undo<T>(
    mesh: &mut Triangulation,
    step: impl FnOnce(&mut Triangulation) -> T,
) -> Option<T> {
    let before = mesh.clone();
    let result = step(mesh);
    if *mesh == before {
        return Some(result);
    }
    let is_worse = MeshInspection::new(mesh).is_worse_than(&MeshInspection::new(&before));
    if is_worse {
        *mesh = before;
    }
    (!is_worse).then_some(result)
}

/// Number of attempts to thin a mesh. Each takes half the distance of the attempt before.
const ATTEMPTS: usize = 5;

/// Thins `mesh` within `settings` and returns a note with the distance by which its surface moved.
/// An open mesh stays as it is.
fn thin_within(mesh: &mut Triangulation, settings: &RepairSettings) -> Option<RepairNote> {
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
        // A small saving is not worth another surface.
        if 10 * to > 9 * from {
            return None;
        }

        // The limits hold for mean distances, so the largest one is measured.
        let surface = Mesh::new(&thin_mesh.vertices, &thin_mesh.triangles).ok()?;
        let distance = mesh
            .vertices
            .iter()
            .map(|vertex| surface.signed_distance(*vertex).distance.abs())
            .fold(0.0, f64::max);
        if distance <= settings.thinning_distance {
            *mesh = thin_mesh;
            return Some(RepairNote::Thinned { from, to, distance });
        }
        limits.distance *= 0.5;
    }
    None
}
