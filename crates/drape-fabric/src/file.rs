//! The TOML form of a fabric: structs with the keys of the file, and conversions in both
//! directions. Only this chapter knows the keys: `traction`, `bending` and `shear` have the keys of
//! the laws, `friction`, `piecewise` and `varying` the keys of tables that several laws use.
//! `stored` gives fabrics and laws the same keys in other formats of serde.

mod bending;
mod friction;
mod piecewise;
mod report;
mod shear;
mod stored;
mod traction;
mod varying;

use std::path::Path;

use drape_input::{Diagnostics, Document, Given, Length, MassPerArea, toml_string};
use serde::{Deserialize, Serialize};

use crate::assumed;
use crate::check::Problem;
use crate::fabric::{Fabric, Provenance, SURFACE_FRICTION, YarnLaws};
use crate::file::bending::BendingFile;
use crate::file::report::Report;
use crate::file::shear::ShearFile;
use crate::file::traction::TractionFile;

/// Fabric of drape: the laws of a weave, in SI.
#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
struct FabricFile {
    /// Name of the fabric.
    name: String,
    /// Source: who measured it, when, and where.
    #[serde(default)]
    source: String,
    /// Mass per area, in kg/m².
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(0.005, 5.0)))]
    density: Given<MassPerArea>,
    /// Thickness under 49 Pa, in m.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(1e-6, 0.02)))]
    thickness: Given<Length>,
    /// Thickness under 4.9 kPa, in m; 0.7 of the thickness if missing.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(1e-6, 0.02)))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pressed_thickness: Option<Given<Length>>,
    /// Linearity of the compression curve, LC; a straight line, 1, if missing.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(0.02, 1.0)))]
    #[serde(skip_serializing_if = "Option::is_none")]
    compression_linearity: Option<f64>,
    /// Coefficient of friction of its surface, MIU.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(0.0, 5.0)))]
    #[serde(default = "surface_friction")]
    surface_friction: f64,
    /// Laws of the warp.
    warp: YarnFile,
    /// Laws of the weft.
    weft: YarnFile,
    /// Law of shear between warp and weft.
    shear: ShearFile,
    /// Provenance of fitted numbers.
    #[serde(skip_serializing_if = "Option::is_none")]
    provenance: Option<Provenance>,
}

/// Returns the default of `surface_friction`.
fn surface_friction() -> f64 {
    SURFACE_FRICTION
}

/// Laws of a yarn direction.
#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
struct YarnFile {
    /// Law of traction.
    traction: TractionFile,
    /// Law of bending.
    bending: BendingFile,
}

/// Returns the JSON Schema of fabrics.
#[cfg(feature = "schema")]
#[must_use]
pub fn fabric_schema() -> serde_json::Value {
    let about = "Fabric of drape: the laws of a weave. Bare numbers are in SI.";
    drape_input::schema_of::<FabricFile>("Fabric of drape", about, serde_json::Map::new())
}

impl Fabric {
    /// Reads the `fabric.toml` at `path`.
    ///
    /// # Errors
    /// Every mistake of the file, each with its line and a remedy.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Diagnostics> {
        Self::from_document(&Document::read(path)?)
    }

    /// Returns the fabric that the TOML `document` describes.
    ///
    /// # Errors
    /// Every mistake of the document, each with its line and a remedy.
    pub fn from_document(document: &Document) -> Result<Self, Diagnostics> {
        let (file, faults) = document.decode_with_faults::<FabricFile>()?;
        let mut mistakes = Vec::new();
        let fabric = file.fabric(&mut |key, message, help| {
            if !faults.cover(key) {
                mistakes.push(document.at(key, message).help(help));
            }
        });

        // Numbers out of range get the line of their key, and an edit if another unit is likely.
        let problems = fabric.problems();
        for problem in problems.iter().filter(|problem| !faults.cover(&problem.key)) {
            let Problem { key, message, help, meant } = problem;
            let edit = meant.as_ref().and_then(|m| document.edit(key, Some(&toml_string(m))));
            mistakes.push(document.at(key, message.clone()).help(help).with_edits(edit));
        }
        mistakes.extend(faults.into_mistakes());
        Diagnostics::check(mistakes)?;
        Ok(fabric)
    }

    /// Returns the fabric as TOML, which [`Fabric::read`] reads back exactly.
    ///
    /// Assumptions of the `provenance` are comments above their number or law.
    #[must_use]
    pub fn to_toml(&self) -> String {
        let text = toml::to_string_pretty(&FabricFile::from(self))
            .expect("numbers, strings and tables always have a TOML form");
        let assumed = self.provenance.as_ref().map_or(&[][..], |provenance| &provenance.assumed);
        assumed::annotated(&text, assumed)
    }
}

impl FabricFile {
    /// Returns the fabric with the numbers of this file. Mistakes in keys go to `report`.
    fn fabric(self, report: &mut Report<'_>) -> Fabric {
        let warp = self.warp.laws("warp", report);
        let weft = self.weft.laws("weft", report);
        let shear = self.shear.law(report);
        Fabric {
            name: self.name,
            source: self.source,
            density: self.density.value(),
            thickness: self.thickness.value(),
            pressed_thickness: self.pressed_thickness.map(Given::value),
            compression_linearity: self.compression_linearity,
            surface_friction: self.surface_friction,
            warp,
            weft,
            shear,
            provenance: self.provenance,
        }
    }
}

impl YarnFile {
    /// Returns the laws of the direction with the key `key`. Mistakes in keys go to `report`.
    fn laws(self, key: &str, report: &mut Report<'_>) -> YarnLaws {
        let traction = self.traction.law(&format!("{key}.traction"), report);
        let bending = self.bending.law(&format!("{key}.bending"), report);
        YarnLaws { traction, bending }
    }
}

impl From<&Fabric> for FabricFile {
    fn from(fabric: &Fabric) -> Self {
        Self {
            name: fabric.name.clone(),
            source: fabric.source.clone(),
            density: Given::bare(fabric.density),
            thickness: Given::bare(fabric.thickness),
            pressed_thickness: fabric.pressed_thickness.map(Given::bare),
            compression_linearity: fabric.compression_linearity,
            surface_friction: fabric.surface_friction,
            warp: (&fabric.warp).into(),
            weft: (&fabric.weft).into(),
            shear: (&fabric.shear).into(),
            provenance: fabric.provenance.clone(),
        }
    }
}

impl From<&YarnLaws> for YarnFile {
    fn from(laws: &YarnLaws) -> Self {
        Self { traction: (&laws.traction).into(), bending: (&laws.bending).into() }
    }
}
