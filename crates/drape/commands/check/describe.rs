//! Contents of scenes, fabrics and sheets in words and SI units.

use std::fmt::Write;
use std::path::Path;

use drape::fabric::{BendingBackbone, Fabric, ShearBackbone, TractionBackbone};
use drape::input::{Diagnostic, Diagnostics};
use drape::pattern::Pattern;
use drape::scene::{Error, Scene, is_fabric};

use super::pattern::CutOut;
use crate::commands::sheets;
use crate::input;

/// Reads a file and describes it, in SI; a pattern as it is cut at a spacing, in m.
pub(crate) fn describe(path: &Path, spacing: f64) -> Result<String, Diagnostics> {
    if path.is_dir() {
        return sheet(path);
    }
    if Pattern::is_drawing(path) {
        return Ok(CutOut::read(path, spacing)?.describe());
    }
    let document = input::document(path)?;
    if Pattern::is_drawing_text(&document) && input::is_standard(path) {
        return Ok(CutOut::read(path, spacing)?.describe());
    }
    let table: toml::Table = document.decode()?;
    let has = |keys: &[&str]| keys.iter().any(|key| table.contains_key(*key));
    // The panels of a pattern have names, those of a scene are in a row.
    if matches!(table.get("panel"), Some(toml::Value::Table(_))) || has(&["from"]) {
        return Ok(CutOut::read(path, spacing)?.describe());
    }
    if has(&["panel", "garment", "time", "collider"]) {
        let read = drape::scene_of(&document).map_err(|error| match error {
            Error::Input(mistakes) => mistakes,
            Error::Tangled(tangle) => tangle.mistakes,
            other => Diagnostic::new(document.path(), other.to_string()).into(),
        });
        Ok(scene(&read?))
    } else if is_fabric(&document) {
        Ok(fabric(&Fabric::from_document(&document)?))
    } else {
        sheet(path)
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
        scene.held_particles().iter().filter(|held| **held).count(),
        scene.bodies.len(),
        scene.schedule.clock.step,
        scene.schedule.clock.end
    );
    for panel in &scene.panels {
        let [across, along] = panel.lattice.spacing;
        let material = &scene.materials[panel.material];
        let layer = match panel.layer {
            0 => String::new(),
            layer => format!("layer {layer}, "),
        };
        let _ = writeln!(
            text,
            "  panel \"{}\": {layer}{} particles, spacing {across:.5} × {along:.5} m, of {}",
            panel.name,
            panel.lattice.coordinates.len(),
            material.file.display()
        );
    }
    if let Some(sewing) = &scene.sewing {
        for seam in &sewing.seams {
            let gaps: Vec<f64> = seam.pairs.gaps(&scene.start.positions).collect();
            let _ = writeln!(
                text,
                "  seam \"{}\": {} stitches, open by {:.1} mm, {:.1} mm at most",
                seam.name,
                gaps.len(),
                1e3 * gaps.iter().sum::<f64>() / gaps.len().max(1) as f64,
                1e3 * gaps.iter().fold(0.0, |a: f64, b| a.max(*b))
            );
        }
    }
    scene.source.notes.iter().for_each(|note| {
        let _ = writeln!(text, "  note: {note}");
    });
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
    let sheet = sheets::read(file)?;
    let density = sheet.density().map_or("no".into(), |w| format!("{w}"));
    let mut text =
        format!("sheet \"{}\": {density} kg/m², {} curves\n", sheet.name, sheet.curves.len());
    for curve in &sheet.curves {
        let (deformation, load) = (curve.deformation_range(), curve.load_range());
        let _ = writeln!(
            text,
            "  {} {}: {} points, deformation {:.4e} to {:.4e}, load {:.4e} to {:.4e}",
            curve.test.name(),
            curve.direction.name(),
            curve.deformation().len(),
            deformation.low,
            deformation.high,
            load.low,
            load.high
        );
    }
    sheet.readings().iter().for_each(|reading| {
        let _ = writeln!(text, "  read {reading}");
    });
    sheet.warnings().iter().for_each(|warning| {
        let _ = writeln!(text, "  warning: {warning}");
    });
    Ok(text)
}

fn indent(text: &str) -> String {
    text.lines().fold(String::new(), |all, line| all + "  " + line + "\n")
}
