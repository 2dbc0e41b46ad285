//! Meshes of bodies: what they are, what contact cannot promise on them, and their repair.

use std::fmt::Write;
use std::path::Path;

use drape::collide::{
    Mesh, MeshInspection, Places, RepairSettings, Triangulation, read_mesh_within, repair,
};
use drape::input::{Diagnostic, Diagnostics};
use drape::scene::MESH_LIMIT;

use crate::failure::Failure;
use crate::input;
use drape::run::file;

/// Heights of persons and dress forms, in m, by which the unit of a file is guessed.
const HEIGHTS: [f64; 2] = [0.5, 2.5];

/// Units of files, with their lengths in m.
const UNITS: [(&str, f64); 4] =
    [("metres", 1.0), ("centimetres", 0.01), ("millimetres", 0.001), ("inches", 0.0254)];

/// Endings of the files of meshes.
const ENDINGS: [&str; 3] = ["obj", "stl", "ply"];

/// Returns whether a file is a mesh, by its ending.
pub(crate) fn is_mesh(file: &Path) -> bool {
    let ending = file.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    ENDINGS.contains(&ending.as_str())
}

/// Length in m of a unit of a file, and the spacing of the cloth, in m.
#[derive(Clone, Copy)]
pub(crate) struct Measure {
    /// Length of a unit of the file, in m; guessed from the size where none is given.
    pub(crate) scale: Option<f64>,
    pub(crate) spacing: f64,
}

/// A mesh as read, in m.
struct ReadMesh {
    mesh: Triangulation,
    scale: f64,
    /// Unit of the file, where it was guessed.
    guessed: Option<&'static str>,
}

fn read(path: &Path, measure: Measure) -> Result<ReadMesh, Diagnostics> {
    let fail = |message: String| Diagnostics::from(Diagnostic::new(path, message));
    let mesh =
        read_mesh_within(path, MESH_LIMIT.bytes()).map_err(|error| fail(error.to_string()))?;
    let finite = |vertex: &[f64; 3]| vertex.iter().all(|x| x.abs() < 1e9);
    if mesh.triangles.is_empty() || !mesh.vertices.iter().all(finite) {
        return Err(fail("the mesh has no triangles, or coordinates that are no positions".into()));
    }
    let size = |axis: usize| {
        let values = mesh.vertices.iter().map(|vertex| vertex[axis]);
        values.clone().fold(f64::MIN, f64::max) - values.fold(f64::MAX, f64::min)
    };
    let longest = (0..3).map(size).fold(0.0, f64::max);
    let fits = |unit: f64| (HEIGHTS[0]..=HEIGHTS[1]).contains(&(longest * unit));
    let (scale, guessed) = match measure.scale {
        Some(scale) => (scale, None),
        None => UNITS
            .into_iter()
            .find(|(_, unit)| fits(*unit))
            .map_or((1.0, None), |(name, unit)| (unit, Some(name))),
    };
    Ok(ReadMesh { mesh: mesh.scaled(scale), scale, guessed })
}

/// Body as it was found: in words, and what a scene refuses of it.
pub(crate) struct Found {
    pub(crate) text: String,
    pub(crate) mistakes: Vec<Diagnostic>,
}

/// Reads a mesh, describes it, and judges it as a scene does.
pub(crate) fn describe(path: &Path, measure: Measure) -> Result<Found, Diagnostics> {
    let ReadMesh { mesh, scale, guessed } = read(path, measure)?;
    let inspection = MeshInspection::new(&mesh);
    let mut text = report(&inspection, measure.spacing);
    if let Some(unit) = guessed {
        let [x, y, z] = inspection.size();
        let _ = writeln!(
            text,
            "  note: the size of a person in {unit}: {x:.3} × {y:.3} × {z:.3} m; in a scene that is \
             scale = {scale}"
        );
    }
    let mut mistakes = Vec::new();
    if let Some(fault) = fault(&mesh) {
        let help = format!(
            "a scene refuses it as well; `drape check {} --repair {}` mends what is safe",
            path.display(),
            repaired_name(path)
        );
        mistakes.push(Diagnostic::new(input::message_path(path), fault).help(help));
    }
    Ok(Found { text, mistakes })
}

/// Returns the reason for which a scene refuses a mesh, in m, if there is one.
fn fault(mesh: &Triangulation) -> Option<String> {
    Mesh::new(&mesh.vertices, &mesh.triangles).err().map(|error| error.to_string())
}

/// Returns the name that is advised for a repaired file.
fn repaired_name(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!("{stem}-repaired.obj")).display().to_string()
}

/// Repairs a mesh, writes it as OBJ in the unit of its file, and describes what was done. A repair that
/// leaves a worse body than it was is not written.
pub(crate) fn mend(path: &Path, measure: Measure, to: &Path) -> Result<String, Failure> {
    let ReadMesh { mesh, scale, .. } = read(path, measure)?;
    let before = MeshInspection::new(&mesh);
    let repaired = repair(&mesh, &RepairSettings::for_spacing(measure.spacing));
    let inspection = MeshInspection::new(&repaired.mesh);
    let [was_refused, is_refused] = [&mesh, &repaired.mesh].map(fault);
    if inspection.is_worse_than(&before) || (was_refused.is_none() && is_refused.is_some()) {
        let message = format!(
            "the repair is not written: it leaves {} faults of the surface and {} edges through it, and the body \
             has {} and {}",
            inspection.faults(),
            inspection.intersections.count,
            before.faults(),
            before.intersections.count
        );
        let help = "mend it where it was made, in a modelling program";
        return Err(
            Diagnostics::from(Diagnostic::new(input::message_path(path), message).help(help)).into()
        );
    }
    let mut text = String::from(match (&was_refused, &is_refused) {
        (_, Some(_)) => "repaired in part\n",
        (None, None) if repaired.notes.is_empty() => "sound\n",
        _ => "repaired\n",
    });
    for note in &repaired.notes {
        let _ = writeln!(text, "  {note}");
    }
    if repaired.notes.is_empty() {
        text.push_str("  nothing was to be done\n");
    }
    text.push_str(&report(&inspection, measure.spacing));
    if let Some(fault) = is_refused {
        let _ = writeln!(text, "  note: a scene still refuses it: {fault}");
    }
    file::write(to, obj(&repaired.mesh, scale))?;
    let _ = writeln!(text, "  written to {}", to.display());
    Ok(text)
}

/// Returns a mesh as OBJ, in a unit of some m.
fn obj(mesh: &Triangulation, unit: f64) -> String {
    let mut text = String::from("# A body repaired by drape\n");
    for [x, y, z] in &mesh.vertices {
        let _ = writeln!(text, "v {} {} {}", x / unit, y / unit, z / unit);
    }
    for [a, b, c] in &mesh.triangles {
        let _ = writeln!(text, "f {} {} {}", a + 1, b + 1, c + 1);
    }
    text
}

/// Describes a mesh: its size, its surface, its faults with their places.
fn report(inspection: &MeshInspection, spacing: f64) -> String {
    let [x, y, z] = inspection.size();
    let lengths = inspection.edge_lengths;
    let closed = match (inspection.is_closed(), inspection.holes.is_empty()) {
        (true, _) => "closed",
        (false, false) => "not closed",
        (false, true) => "no holes, but not one closed surface",
    };
    let mut text = format!(
        "body, {} vertices, {} triangles, {x:.3} × {y:.3} × {z:.3} m, {:.4} m², {:.4} l, {} part{}, \
         {closed}\n  edges: {:.2} to {:.2} mm, half of them below {:.2} mm; the spacing is {} mm\n",
        inspection.vertices,
        inspection.triangles,
        inspection.area,
        1e3 * inspection.volume,
        inspection.parts,
        if inspection.parts == 1 { "" } else { "s" },
        1e3 * lengths.min,
        1e3 * lengths.max,
        1e3 * lengths.median,
        1e3 * spacing,
    );
    if x.max(z) > y {
        text.push_str(
            "  note: it is not longest along y, which is up; a body that lies is turned by turn = \
             [-90, 0, 0] where z is up in its file\n",
        );
    }
    if inspection.is_closed() && inspection.volume < 0.0 {
        text.push_str("  note: it is inside out; a scene turns it\n");
    }
    for hole in inspection.holes.iter().take(5) {
        let place = place(hole.place);
        let (edges, length) = (hole.vertices.len(), 1e3 * hole.length);
        let _ = writeln!(text, "  hole: {edges} edges, {length:.1} mm long, around {place}");
    }
    if inspection.holes.len() > 5 {
        let _ = writeln!(text, "  and {} holes more", inspection.holes.len() - 5);
    }
    for (places, what) in [
        (&inspection.branching_edges, "edges with more than two triangles"),
        (&inspection.opposed_edges, "edges whose triangles disagree about the outside"),
        (&inspection.flat_triangles, "triangles without area"),
        (
            &inspection.intersections,
            "edges that pass through the body's own surface: there, contact cannot keep cloth \
             outside",
        ),
    ] {
        text.push_str(&places_line(places, what));
    }
    if inspection.is_too_fine(spacing) {
        let _ = writeln!(
            text,
            "  note: its triangles are finer than cloth of this spacing can see; --repair thins \
             them to {:.2} mm of the surface",
            1e3 * RepairSettings::for_spacing(spacing).thinning_distance
        );
    }
    if inspection.is_too_coarse(spacing) {
        text.push_str("  note: its triangles are large: cloth will show their edges\n");
    }
    text
}

fn places_line(places: &Places, what: &str) -> String {
    match places.first.first() {
        Some(first) => format!("  {} {what}; the first is at {}\n", places.count, place(*first)),
        None => String::new(),
    }
}

fn place([x, y, z]: [f64; 3]) -> String {
    format!("({x:.4}, {y:.4}, {z:.4}) m")
}
