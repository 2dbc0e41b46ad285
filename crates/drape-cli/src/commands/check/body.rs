//! Meshes of bodies: their description, the faults that contact cannot handle, and their repair.

use std::fmt::Write;
use std::path::Path;

use drape::collide::{
    FaultPlaces, Mesh, MeshInspection, RepairSettings, Triangulation, read_mesh_within, repair,
};
use drape::input::{Diagnostic, Diagnostics, counted};
use drape::scene::{MESH_LIMIT, is_repaired, mesh_remedy, repaired_file};

use crate::failure::Failure;
use crate::input;
use drape::run::file;

/// Smallest and largest height of persons and dress forms, in m. The unit of a file is guessed from
/// these heights.
const HEIGHTS: [f64; 2] = [0.5, 2.5];

/// Units of files, with their lengths in m.
const UNITS: [(&str, f64); 4] =
    [("metres", 1.0), ("centimetres", 0.01), ("millimetres", 0.001), ("inches", 0.0254)];

/// Endings of mesh files.
const ENDINGS: [&str; 3] = ["obj", "stl", "ply"];

/// Returns whether `file` is a mesh, by its ending.
pub(crate) fn is_mesh(file: &Path) -> bool {
    let ending = file.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    ENDINGS.contains(&ending.as_str())
}

/// Scale of a body's file and spacing of the cloth on the body.
#[derive(Clone, Copy)]
pub(crate) struct BodySettings {
    /// Length of a unit of the file, in m. `None` guesses the unit from the size of the mesh.
    pub(crate) scale: Option<f64>,
    /// Spacing of the cloth, in m.
    pub(crate) spacing: f64,
}

/// Mesh of a file, in m.
struct ReadMesh {
    mesh: Triangulation,
    /// Length of a unit of the file, in m.
    scale: f64,
    /// Name of the file's unit, if the unit was guessed.
    guessed: Option<&'static str>,
}

/// Reads the mesh at `path` and scales it to m.
fn read(path: &Path, settings: BodySettings) -> Result<ReadMesh, Diagnostics> {
    let mesh = read_mesh_within(path, MESH_LIMIT.bytes(input::access())).map_err(|error| {
        let mistake = Diagnostic::new(path, error.to_string());
        match mesh_remedy(&error) {
            Some(remedy) => mistake.help(remedy),
            None => mistake,
        }
    })?;
    let is_finite = mesh.vertices.iter().flatten().all(|x| x.abs() < 1e9);
    if mesh.triangles.is_empty() || !is_finite {
        let message = "the mesh has no triangles, or coordinates that are no positions";
        return Err(Diagnostic::new(path, message).into());
    }

    let sizes = (0..3).map(|axis: usize| {
        let values = mesh.vertices.iter().map(|vertex| vertex[axis]);
        values.clone().fold(f64::MIN, f64::max) - values.fold(f64::MAX, f64::min)
    });
    let longest = sizes.fold(0.0, f64::max);
    let (scale, guessed) = match settings.scale {
        Some(scale) => (scale, None),
        None => UNITS
            .into_iter()
            .find(|(_, unit)| (HEIGHTS[0]..=HEIGHTS[1]).contains(&(longest * unit)))
            .map_or((1.0, None), |(name, unit)| (unit, Some(name))),
    };
    Ok(ReadMesh { mesh: mesh.scaled(scale), scale, guessed })
}

/// Description of a body, and the mistakes for which a scene refuses it.
pub(crate) struct BodyDescription {
    pub(crate) text: String,
    pub(crate) mistakes: Vec<Diagnostic>,
}

/// Reads the mesh at `path`, describes it, and checks it as a scene does.
pub(crate) fn describe(
    path: &Path,
    settings: BodySettings,
) -> Result<BodyDescription, Diagnostics> {
    let ReadMesh { mesh, scale, guessed } = read(path, settings)?;
    let inspection = MeshInspection::new(&mesh);
    let mut text = report(&inspection, settings.spacing);

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
        let help = if is_repaired(path) {
            "a scene refuses it as well, and a repair has left these faults: mend them where the body was made, in a \
             modelling program"
                .into()
        } else {
            format!(
                "a scene refuses it as well; `drape check {} --repair {}` mends what is safe",
                path.display(),
                repaired_file(path).display()
            )
        };
        mistakes.push(Diagnostic::new(input::message_path(path), fault).help(help));
    }
    Ok(BodyDescription { text, mistakes })
}

/// Returns the reason for which a scene refuses `mesh`, if there is one.
fn fault(mesh: &Triangulation) -> Option<String> {
    Mesh::new(&mesh.vertices, &mesh.triangles).err().map(|error| error.to_string())
}

/// Repairs the mesh at `path`, writes it as OBJ in the unit of its file, and describes the repair.
/// A repair that leaves more faults than before is not written.
pub(crate) fn repair_file(
    path: &Path,
    settings: BodySettings,
    to: &Path,
) -> Result<String, Failure> {
    let ReadMesh { mesh, scale, .. } = read(path, settings)?;
    let before = MeshInspection::new(&mesh);
    let repaired = repair(&mesh, &RepairSettings::for_spacing(settings.spacing));
    let inspection = MeshInspection::new(&repaired.mesh);

    let [was_refused, is_refused] = [&mesh, &repaired.mesh].map(fault);
    if inspection.is_worse_than(&before) || (was_refused.is_none() && is_refused.is_some()) {
        let message = format!(
            "the repair is not written: it leaves {} faults of the surface and {} edges through it, and the body \
             has {} and {}",
            inspection.fault_count(),
            inspection.intersections.count,
            before.fault_count(),
            before.intersections.count
        );
        let help = "mend it where it was made, in a modelling program";
        return Err(Diagnostics::from(
            Diagnostic::new(input::message_path(path), message).help(help),
        )
        .into());
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
    text.push_str(&report(&inspection, settings.spacing));
    if let Some(fault) = is_refused {
        let _ = writeln!(text, "  note: a scene still refuses it: {fault}");
    }

    file::write(to, obj(&repaired.mesh, scale))?;
    let _ = writeln!(text, "  written to {}", to.display());
    Ok(text)
}

/// Returns `mesh` as OBJ in a unit of `unit` m.
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

/// Describes a mesh: its size, its surface, and its faults with their positions. `spacing` is the
/// spacing of the cloth, in m.
fn report(inspection: &MeshInspection, spacing: f64) -> String {
    let [x, y, z] = inspection.size();
    let lengths = inspection.edge_lengths;
    let closed = match (inspection.is_closed(), inspection.holes.is_empty()) {
        (true, _) => "closed",
        (false, false) => "not closed",
        (false, true) => "no holes, but not one closed surface",
    };

    let mut text = format!(
        "body, {} vertices, {} triangles, {x:.3} × {y:.3} × {z:.3} m, {:.4} m², {:.4} l, {}, \
         {closed}\n  edges: {:.2} to {:.2} mm, half of them below {:.2} mm; the spacing is {} mm\n",
        inspection.vertices,
        inspection.triangles,
        inspection.area,
        1e3 * inspection.volume,
        counted(inspection.parts, "part", "parts"),
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
        let position = position(hole.place);
        let (edges, length) = (hole.vertices.len(), 1e3 * hole.length);
        let _ = writeln!(text, "  hole: {edges} edges, {length:.1} mm long, around {position}");
    }
    if inspection.holes.len() > 5 {
        let hidden_holes = counted(inspection.holes.len() - 5, "hole", "holes");
        let _ = writeln!(text, "  and {hidden_holes} more");
    }

    for (places, fault) in [
        (&inspection.branching_edges, "edges with more than two triangles"),
        (&inspection.opposed_edges, "edges whose triangles disagree about the outside"),
        (&inspection.flat_triangles, "triangles without area"),
        (
            &inspection.intersections,
            "edges that pass through the body's own surface: there, contact cannot keep cloth \
             outside",
        ),
    ] {
        text.push_str(&fault_line(places, fault));
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

/// Returns the line for a kind of `fault` with its `places`, or an empty text if there is none.
fn fault_line(places: &FaultPlaces, fault: &str) -> String {
    match places.first.first() {
        Some(first) => {
            format!("  {} {fault}; the first is at {}\n", places.count, position(*first))
        }
        None => String::new(),
    }
}

fn position([x, y, z]: [f64; 3]) -> String {
    format!("({x:.4}, {y:.4}, {z:.4}) m")
}
