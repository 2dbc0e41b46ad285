use std::fmt::Write;
use std::path::{Path, PathBuf};

use drape::fabric::{BendingBackbone, Fabric, ShearBackbone, TractionBackbone};
use drape::input::{Diagnostic, Diagnostics, Document};
use drape::kes::Sheet;
use drape::scene::{Scene, SceneError};

use crate::command::CheckArguments;
use crate::failure::Failure;
use crate::say::say;
use crate::verify;

/// `drape check`: all files are read, all mistakes reported together; then the frames of runs are looked at.
pub(crate) fn check(arguments: &CheckArguments) -> Result<(), Failure> {
    let (runs, files): (Vec<&PathBuf>, Vec<&PathBuf>) =
        arguments.files.iter().partition(|file| verify::is_run(file));
    if let (true, Some(file)) = (arguments.json, files.first()) {
        let message = format!("--json is for folders of runs, and {} is none", file.display());
        return Err(Failure::Usage(message));
    }
    let mut mistakes = Vec::new();
    for file in files {
        match describe(file) {
            Ok(description) => say(format_args!("{}: {}", file.display(), description.trim_end()))?,
            Err(found) => mistakes.extend(found.0),
        }
    }
    Diagnostics::check(mistakes)?;
    verify::verify(&runs, arguments.json)
}

/// What a file holds, in SI.
fn describe(file: &Path) -> Result<String, Diagnostics> {
    if file.is_dir() {
        return sheet(file);
    }
    let document = Document::read(file)?;
    let table: toml::Table = document.decode()?;
    let has = |keys: &[&str]| keys.iter().any(|key| table.contains_key(*key));
    if has(&["panel", "time", "collider"]) {
        let read = Scene::read(file).map_err(|error| match error {
            SceneError::Input(mistakes) => mistakes,
            SceneError::Tangled(tangle) => tangle.mistakes,
            other => Diagnostic::new(file, other.to_string()).into(),
        });
        Ok(scene(&read?))
    } else if has(&["density", "shear"]) {
        Ok(fabric(&Fabric::from_document(&document)?))
    } else {
        sheet(file)
    }
}

fn scene(scene: &Scene) -> String {
    let mass: f64 = scene.cloth.masses().iter().sum();
    let area: f64 = scene.cloth.areas().iter().sum();
    let mut text = format!(
        "scene \"{}\", {} particles, {area:.4} m², {mass:.4} kg, {} held, {} bodies, \
         steps of {} s to {} s\n",
        scene.name,
        scene.cloth.particles(),
        scene.held.iter().filter(|held| **held).count(),
        scene.contact.bodies().len(),
        scene.clock.step,
        scene.clock.end
    );
    for panel in &scene.panels {
        let [across, along] = panel.lattice.spacing;
        let material = &scene.materials[panel.material];
        let _ = writeln!(
            text,
            "  panel \"{}\": {} particles, spacing {across:.5} × {along:.5} m, of {}",
            panel.name,
            panel.lattice.coordinates.len(),
            material.file.display()
        );
    }
    scene.materials.iter().for_each(|material| text += &indent(&fabric(&material.fabric)));
    text
}

fn fabric(fabric: &Fabric) -> String {
    let mut text = format!(
        "fabric \"{}\": {} kg/m², {} m thick\n",
        fabric.name, fabric.density, fabric.thickness
    );
    for (name, direction) in [("warp", &fabric.warp), ("weft", &fabric.weft)] {
        let stretch = match direction.traction.backbone {
            TractionBackbone::Primed(p) => {
                format!("{:.4e} N/m after a toe of {:.2} %", p.stiffness, 100.0 * p.toe_strain)
            }
            TractionBackbone::Polynomial(p) => {
                format!("{:.4e} ε² + {:.4e} ε⁴ N/m", p.quadratic, p.quartic)
            }
        };
        let rigidity = match direction.bending.backbone {
            BendingBackbone::Linear { rigidity } => rigidity,
            BendingBackbone::Piecewise(piecewise) => piecewise.slope,
        };
        let _ = writeln!(
            text,
            "  {name}: traction {stretch}, friction {:.3e} N/m; bending {rigidity:.4e} N·m, \
             friction {:.3e} N",
            direction.traction.friction.plateau(),
            direction.bending.friction.plateau()
        );
    }
    let stiffness = match fabric.shear.backbone {
        ShearBackbone::Linear { stiffness } => stiffness,
        ShearBackbone::Piecewise(piecewise) => piecewise.slope,
    };
    let plateau = fabric.shear.friction.plateau();
    let _ = writeln!(text, "  shear {stiffness:.4e} N/m, friction {plateau:.3e} N/m");
    text
}

fn sheet(file: &Path) -> Result<String, Diagnostics> {
    let sheet = Sheet::read(file).map_err(|error| crate::fit::input(file, error))?;
    let density = sheet.density().map_or("no".into(), |w| format!("{w}"));
    let mut text =
        format!("sheet \"{}\": {density} kg/m², {} curves\n", sheet.name, sheet.curves.len());
    for curve in &sheet.curves {
        let ((low, high), (least, most)) = (curve.deformation_range(), curve.load_range());
        let _ = writeln!(
            text,
            "  {} {}: {} points, deformation {low:.4e} to {high:.4e}, load {least:.4e} to {most:.4e}",
            curve.test.name(),
            curve.direction.name(),
            curve.deformation().len()
        );
    }
    sheet.warnings().iter().for_each(|warning| {
        let _ = writeln!(text, "  warning: {warning}");
    });
    Ok(text)
}

fn indent(text: &str) -> String {
    text.lines().fold(String::new(), |all, line| all + "  " + line + "\n")
}
