//! Contents of scenes, fabrics and sheets in words and SI units.

use std::borrow::Cow;
use std::fmt::Write;
use std::path::Path;

use drape::collide::{MeshInspection, Shape};
use drape::fabric::{BendingBackbone, Fabric, ShearBackbone, TractionBackbone, TractionFriction};
use drape::input::{Diagnostic, Diagnostics, Document, counted, figure};
use drape::kes::{Curve, Extent, Sheet, SheetDraft, Test};
use drape::pattern::Pattern;
use drape::run::NamedCurve;
use drape::run::describe_needs;
use drape::run::file::FileKind;
use drape::run::reports::{CheckedValue, sheet_values};
use drape::scene::{Error, MovingBody, Scene, is_fabric};
use drape::sweep::{Error as SweepError, Study};

use super::pattern::CheckedPattern;
use super::values;
use crate::commands::sheets::{self, drafted};
use crate::input;
use crate::remedy;

/// Kinds of files that `drape check` describes.
const CHECKED: [FileKind; 7] = [
    FileKind::Scene,
    FileKind::Fabric,
    FileKind::Sheet,
    FileKind::Pattern,
    FileKind::Drawing,
    FileKind::Study,
    FileKind::Body,
];

/// Reads the file at `path` and describes it in SI. A pattern is cut at `spacing`, in m.
pub(crate) fn describe(path: &Path, spacing: f64) -> Result<String, Diagnostics> {
    if sheets::holds_tables(path) {
        return tables(path);
    }
    match input::kind(path).filter(|_| !input::is_standard(path)) {
        Some(FileKind::Study) => return study(path),
        Some(FileKind::Material | FileKind::Picture | FileKind::Page | FileKind::Run) => {
            input::expect(path, &CHECKED)?;
        }
        _ => {}
    }
    if path.is_dir() {
        return sheet(path);
    }
    if let Some(answer) = Pattern::foreign(path) {
        return Err(answer.into());
    }
    if Pattern::is_drawing(path) {
        return Ok(CheckedPattern::read(path, spacing)?.describe());
    }

    // The ending does not tell all kinds of TOML apart, so the keys of the file decide.
    let document = input::document(path)?;
    if Pattern::is_drawing_text(&document) && input::is_standard(path) {
        return Ok(CheckedPattern::read(path, spacing)?.describe());
    }
    let table: toml::Table = document.decode()?;
    if holds_pattern(&table) {
        return Ok(CheckedPattern::read(path, spacing)?.describe());
    }
    if holds_scene(&table) {
        Ok(scene(&read_scene(path)?))
    } else if is_fabric(&document) {
        Ok(fabric(&Fabric::from_document(&document)?))
    } else {
        sheet(path)
    }
}

/// Returns the values of the sheet at `path`, or `None` if the file is no sheet.
pub(crate) fn sheet_values_of(path: &Path) -> Option<Vec<CheckedValue>> {
    let is_sheet = input::kind(path) == Some(FileKind::Sheet);
    let sheet = is_sheet.then(|| sheets::read(path).ok()).flatten()?;
    Some(sheet_values(&sheet))
}

/// Describes the study at `path`: its base, the number of its points, and its axes.
fn study(path: &Path) -> Result<String, Diagnostics> {
    let study = Study::read(path, input::access()).map_err(|error| match error {
        SweepError::Input(mistakes) => mistakes,
        error => Diagnostic::new(path, error.to_string()).into(),
    })?;
    let mut text = format!(
        "study of the {} {}, {}, results in {}\n",
        study.base().key(),
        study.base_file().display(),
        counted(study.point_count(), "point", "points"),
        study.output().display()
    );
    for axis in study.axes() {
        let _ = writeln!(text, "  {}: {}", axis.key, axis.levels.join(", "));
    }
    Ok(text)
}

/// Returns whether `file` is a scene, by its keys.
pub(crate) fn is_scene(file: &Path) -> bool {
    let is_toml = file.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml"));
    let may_be = is_toml || input::is_standard(file);
    let document = may_be.then(|| input::document(file).ok()).flatten();
    let table = document.and_then(|document| document.decode::<toml::Table>().ok());
    table.is_some_and(|table| !holds_pattern(&table) && holds_scene(&table))
}

/// Returns whether `table` is a pattern. The panels of a pattern are tables with names, and the
/// panels of a scene are an array.
fn holds_pattern(table: &toml::Table) -> bool {
    matches!(table.get("panel"), Some(toml::Value::Table(_))) || table.contains_key("from")
}

/// Returns whether `table`, which is no pattern, is a scene.
fn holds_scene(table: &toml::Table) -> bool {
    ["panel", "garment", "time", "collider"].iter().any(|key| table.contains_key(*key))
}

/// Reads the scene at `path`. Every error becomes a [`Diagnostic`].
pub(crate) fn read_scene(path: &Path) -> Result<Scene, Diagnostics> {
    drape::run::scene_of(&input::document(path)?).map_err(|error| match error {
        Error::Input(mistakes) => mistakes,
        Error::Tangled(tangle) => tangle.mistakes,
        error => Diagnostic::new(input::message_path(path), error.to_string()).into(),
    })
}

/// Describes `scene`: its cloth, its seams, its bodies, and the resources that a run needs.
pub(crate) fn scene(scene: &Scene) -> String {
    let mass: f64 = scene.cloth.masses().iter().sum();
    let area: f64 = scene.cloth.areas().iter().sum();
    let mut text = format!(
        "scene \"{}\", {} particles, {area:.4} m², {mass:.4} kg, {} held, {}, \
         steps of {} s to {} s\n",
        scene.name,
        scene.cloth.particle_count(),
        scene.held_particles().iter().filter(|held| **held).count(),
        counted(scene.bodies.len(), "body", "bodies"),
        scene.schedule.clock.step,
        scene.schedule.clock.end
    );

    for grid in &scene.coarser {
        let (particles, spacing) = (grid.cloth.particle_count(), 1e3 * grid.spacing());
        let _ =
            writeln!(text, "  at rest first on a grid of {spacing:.1} mm, {particles} particles");
    }

    for panel in &scene.panels {
        let [across, along] = panel.lattice.spacing();
        let largest = panel.lattice.spacing_max();
        let flat = if largest == panel.lattice.spacing() {
            String::new()
        } else {
            format!(", where it is flat up to {:.5} × {:.5} m", largest[0], largest[1])
        };
        let material = &scene.materials[panel.material];
        let layer = match panel.layer {
            0 => String::new(),
            layer => format!("layer {layer}, "),
        };
        let _ = writeln!(
            text,
            "  panel \"{}\": {layer}{} particles, spacing {across:.5} × {along:.5} m{flat}, of {}",
            panel.name,
            panel.lattice.coordinates().len(),
            material.file.display()
        );
    }

    if let Some(sewing) = &scene.sewing {
        for seam in &sewing.seams {
            let gaps: Vec<f64> = seam.pairs.gaps(&scene.start.positions).collect();
            let _ = writeln!(
                text,
                "  seam \"{}\": {}, open by {:.1} mm, {:.1} mm at most",
                seam.name,
                counted(gaps.len(), "stitch", "stitches"),
                1e3 * gaps.iter().sum::<f64>() / gaps.len().max(1) as f64,
                1e3 * gaps.iter().fold(0.0, |a: f64, b| a.max(*b))
            );
        }
    }

    scene.bodies.iter().for_each(|moving| text += &body(moving));
    let _ = writeln!(text, "  {}", describe_needs(&scene.needs()));
    scene.source.notes.iter().chain(&scene.source.contact_limits).for_each(|note| {
        let note = note.in_words(remedy::in_words);
        let _ = writeln!(text, "  note: {note}");
    });
    scene.materials.iter().for_each(|material| text += &indent(&fabric(&material.fabric)));
    text
}

/// Describes the body `moving` in a line.
fn body(moving: &MovingBody) -> String {
    let name = &moving.body.name;
    let kind = match &moving.body.shape {
        Shape::Sphere { .. } => "sphere",
        Shape::Box { .. } => "box",
        Shape::Cylinder { .. } => "cylinder",
        Shape::Plane => return format!("  body \"{name}\": plane\n"),
        Shape::Mesh(_) => "mesh",
        _ => "body",
    };

    let inspection = match &moving.source {
        Some(source) => Cow::Borrowed(&source.inspection),
        None => {
            let outline = moving.body.triangulate();
            Cow::Owned(outline.map(|outline| MeshInspection::new(&outline)).unwrap_or_default())
        }
    };
    let [x, y, z] = inspection.size();
    let size = format!("{x:.3} × {y:.3} × {z:.3} m, {:.2} l", 1e3 * inspection.volume);
    if moving.source.is_none() {
        return format!("  body \"{name}\": {kind}, {size}\n");
    }

    let parts = counted(inspection.parts, "part", "parts");
    let crossing = match inspection.intersections.count {
        0 => "nowhere through itself".into(),
        1 => "through itself at 1 edge".into(),
        count => format!("through itself at {count} edges"),
    };
    format!(
        "  body \"{name}\": {kind}, {size}, {} triangles with edges of {:.1} mm, closed, {parts}, {crossing}\n",
        inspection.triangles,
        1e3 * inspection.edge_lengths.median
    )
}

/// Describes the laws of `fabric` in SI.
fn fabric(fabric: &Fabric) -> String {
    let mut text = format!(
        "fabric \"{}\": {} kg/m², {} m thick\n",
        fabric.name,
        figure(fabric.density),
        figure(fabric.thickness)
    );
    for (name, direction) in [("warp", &fabric.warp), ("weft", &fabric.weft)] {
        let stretch = match direction.traction.backbone {
            TractionBackbone::Exponential(toe) => {
                let stiffness = toe.base_stiffness + toe.stiffness;
                format!("{stiffness:.4e} N/m after a toe of {:.2} %", 100.0 * toe.toe_strain)
            }
            TractionBackbone::Primed(p) => {
                format!("{:.4e} N/m after a toe of {:.2} %", p.stiffness, 100.0 * p.toe_strain)
            }
            TractionBackbone::Polynomial(p) => {
                format!("{:.4e} ε² + {:.4e} ε⁴ N/m", p.quadratic, p.quartic)
            }
        };

        let friction = match direction.traction.friction {
            TractionFriction::Plateau(friction) => format!("{:.3e} N/m", friction.plateau()),
            TractionFriction::Proportional(friction) => {
                format!("{:.2} of the load and {:.3e} N/m", friction.ratio, friction.plateau)
            }
        };

        let rigidity = match direction.bending.backbone {
            BendingBackbone::Linear { rigidity } => rigidity,
            BendingBackbone::Varying(varying) => varying.initial_stiffness,
            BendingBackbone::Piecewise(piecewise) => piecewise.slope,
        };
        let _ = writeln!(
            text,
            "  {name}: traction {stretch}, friction {friction}; bending {rigidity:.4e} N·m, \
             friction {:.3e} N",
            direction.bending.friction.plateau()
        );
    }

    let stiffness = match fabric.shear.backbone {
        ShearBackbone::Linear { stiffness } => stiffness,
        ShearBackbone::Varying(varying) => varying.initial_stiffness,
        ShearBackbone::Piecewise(piecewise) => piecewise.slope,
    };
    let plateau = fabric.shear.friction.plateau();
    let _ = writeln!(text, "  shear {stiffness:.4e} N/m, friction {plateau:.3e} N/m");
    text
}

/// Describes the sheets that `drape fit` would draft from the tables at `path`.
fn tables(path: &Path) -> Result<String, Diagnostics> {
    let folder = if path.is_dir() { path } else { path.parent().unwrap_or(Path::new("")) };
    let drafts = SheetDraft::of_with(path, folder, input::access())
        .map_err(|error| sheets::to_diagnostics(error, path))?;
    let several = drafts.len() > 1;
    let mut text = String::new();
    for draft in drafts {
        // `drape fit` would write this sheet.
        let file = format!("{}.sheet.toml", drafted::name(path, &draft, several));
        let document = input::with_settings(&folder.join(file), &draft.text)?;
        let sheet = draft
            .read_document(document.clone())
            .map_err(|error| sheets::to_diagnostics(error, path))?;
        let values = counted(draft.values, "value", "values");
        let sections = counted(draft.open, "section", "sections");
        let _ = writeln!(text, "drafted, with {values}, {sections} to complete");
        text += &indent(&describe_sheet(&sheet, &document));
    }
    Ok(text)
}

/// Describes the sheet at `file`, or in the folder `file`.
fn sheet(file: &Path) -> Result<String, Diagnostics> {
    let document = input::document(&input::sheet_file(file))?;
    Ok(describe_sheet(&sheets::read(file)?, &document))
}

/// Describes `sheet`. `document` is the document from which it was read, and names the files of the
/// curves.
fn describe_sheet(sheet: &Sheet, document: &Document) -> String {
    let density = sheet.density().map_or("no".into(), figure);
    let curves = counted(sheet.curves.len(), "curve", "curves");
    let mut text = format!("sheet \"{}\": {density} kg/m², {curves}\n", sheet.name);
    let named = NamedCurve::of(document);
    sheet.curves.iter().for_each(|curve| text += &self::curve(curve, &named));
    text += &values::describe(sheet);
    sheet.readings().iter().for_each(|reading| {
        let _ = writeln!(text, "  read {reading}");
    });
    sheet.warnings().iter().for_each(|warning| {
        let _ = writeln!(text, "  warning: {warning}");
    });
    text
}

/// Describes `curve` in a line: its test, direction and file, with the ranges of deformation and
/// load.
fn curve(curve: &Curve, named: &[NamedCurve]) -> String {
    let file = named.iter().find(|entry| entry.is_called(&curve.name));
    let file = file.map_or(String::new(), |entry| format!(", {}", entry.files.join(", ")));
    let [deformation, load] = match curve.test {
        Test::Tensile => [("strain", ""), ("tension", " N/m")],
        Test::Shear => [("angle", " rad"), ("shear force", " N/m")],
        Test::Bending => [("curvature", " 1/m"), ("moment", " N")],
        Test::LoopBending => [("approach of the clamps", ""), ("force", " N/m")],
    };
    format!(
        "  {} {}{file}: {} points, {}, {}\n",
        curve.test.name(),
        curve.direction.name(),
        curve.deformation().len(),
        range(deformation, curve.deformation_range()),
        range(load, curve.load_range()),
    )
}

/// Returns the range of a quantity, given by its name and unit.
fn range((name, unit): (&str, &str), extent: Extent) -> String {
    format!("{name} {:.4e} to {:.4e}{unit}", extent.low, extent.high)
}

fn indent(text: &str) -> String {
    text.lines().fold(String::new(), |all, line| all + "  " + line + "\n")
}
