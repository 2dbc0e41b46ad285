//! TOML form of a scene.
//!
//! `SceneFile` mirrors the text of a scene key by key. Nothing here is checked beyond its type;
//! unknown keys are refused. The chapter `check` turns it into a scene. Names of fields are the
//! keys; lengths are in the unit of the file.

pub(crate) mod body;
pub(crate) mod contact;
pub(crate) mod garment;
pub(crate) mod motion;
pub(crate) mod panel;
pub(crate) mod pin;
pub(crate) mod run;
#[cfg(feature = "schema")]
pub(crate) mod schema;

use std::collections::BTreeMap;

use drape_input::{Acceleration, Density, Given, Length};
use serde::Deserialize;

use self::body::ColliderFile;
use self::contact::ContactFile;
use self::garment::{GarmentFile, SewFile};
use self::panel::PanelFile;
use self::pin::PinFile;
use self::run::{
    GradingFile, MotionPhaseFile, OutputFile, RefineFile, SettleFile, SolverFile, TimeFile,
};

/// Units of the lengths of a file, in m.
pub(crate) const UNITS: [(&str, f64); 3] = [("m", 1.0), ("cm", 0.01), ("mm", 0.001)];

/// Scene of drape: cloth, bodies, contact, time.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct SceneFile {
    /// Name of the scene; the name of the file if missing.
    pub(crate) name: Option<String>,
    /// Model of the cloth: `kes`, yarn connectors with the laws of the fabric, or `breen-1994`, the
    /// particles of Breen, House and Wozny, with the first branches of the curves, without
    /// friction, and with repulsion of all particles closer than the spacing.
    #[cfg_attr(feature = "schema", schemars(extend("default" = "kes")))]
    #[cfg_attr(feature = "schema", schemars(extend("enum" = ["kes", "breen-1994"])))]
    pub(crate) model: Option<String>,
    /// Unit of all lengths of the file that stand without one.
    #[cfg_attr(feature = "schema", schemars(extend("default" = "m")))]
    #[cfg_attr(feature = "schema", schemars(extend("enum" = ["m", "cm", "mm"])))]
    pub(crate) length: Option<String>,
    /// Distance between particles; 10 mm if missing.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    pub(crate) spacing: Option<Given<Length>>,
    /// Acceleration of gravity along x, y and z, in m/s².
    #[cfg_attr(feature = "schema", schemars(extend("default" = [0.0, -9.81, 0.0])))]
    pub(crate) gravity: Option<[Given<Acceleration>; 3]>,
    /// Air that the cloth moves in.
    pub(crate) air: Option<AirFile>,
    /// Fabrics by the names that panels and garments use.
    #[serde(default)]
    pub(crate) fabric: BTreeMap<String, FabricFile>,
    /// Pieces of cloth.
    #[serde(default)]
    pub(crate) panel: Vec<PanelFile>,
    /// Patterns that are cut, placed and sewn.
    #[serde(default)]
    pub(crate) garment: Vec<GarmentFile>,
    /// Sewing of the garments.
    #[serde(default)]
    pub(crate) sew: SewFile,
    /// Particles that are held.
    #[serde(default)]
    pub(crate) pin: Vec<PinFile>,
    /// Bodies.
    #[serde(default)]
    pub(crate) collider: ColliderFile,
    /// Contact of cloth with bodies and with itself.
    #[serde(default)]
    pub(crate) contact: ContactFile,
    /// Steps and the end of the run.
    pub(crate) time: TimeFile,
    /// Run to rest, without momentum: the lengths of its steps are no durations, and the run ends
    /// when the cloth is at rest; in time if missing.
    pub(crate) settle: Option<SettleFile>,
    /// Coarser grids, with `[settle]` only: garments are sewn and cloth comes to rest on them
    /// first, one after the other.
    pub(crate) refine: Option<RefineFile>,
    /// Larger distances between particles where the cloth is flat, by the curvature of an earlier
    /// run; none if missing. Coarser grids of `[refine]` are not graded.
    pub(crate) grading: Option<GradingFile>,
    /// Phase that follows when the cloth has come to rest, with `[settle]` only; bodies and pins
    /// move from the start if missing.
    pub(crate) motion: Option<MotionPhaseFile>,
    /// Solver of the steps.
    #[serde(default)]
    pub(crate) solver: SolverFile,
    /// Results.
    #[serde(default)]
    pub(crate) output: OutputFile,
}

/// Air that the cloth moves in.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct AirFile {
    /// Density, in kg/m³; 0 is a vacuum.
    #[cfg_attr(feature = "schema", schemars(extend("default" = 1.2)))]
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(0.0, 100.0)))]
    pub(crate) density: Option<Given<Density>>,
    /// Coefficient of drag of the cloth, as of a plate across the flow.
    #[cfg_attr(feature = "schema", schemars(extend("default" = 1.28)))]
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(0.0, 10.0)))]
    pub(crate) drag: Option<f64>,
}

/// Fabric of a scene.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct FabricFile {
    /// Fabric, sheet, or folder of a sheet, relative to the folder of the scene. A sheet is fitted
    /// first.
    pub(crate) file: String,
    /// Colour of the front of the cloth in pictures, in the viewer and in files for other programs,
    /// as `#RRGGBB` in sRGB; the back is a paler or darker tone. Without a colour, several fabrics
    /// have colours that can be told apart.
    #[serde(alias = "color")]
    pub(crate) colour: Option<String>,
    /// Numbers that replace numbers of the fabric, in SI, by their keys in a `fabric.toml`,
    /// such as `"warp.bending.rigidity"`.
    #[serde(default)]
    pub(crate) set: BTreeMap<String, f64>,
}

impl SceneFile {
    /// Returns the unit of lengths in the file, in m. An unknown unit counts as the metre, which is
    /// the unit of a file that names none.
    pub(crate) fn unit(&self) -> f64 {
        let unit = UNITS.iter().find(|(name, _)| self.length.as_deref() == Some(name));
        unit.map_or(1.0, |(_, unit)| *unit)
    }

    /// Whether surfaces are kept apart: if the scene does not say, wherever steps can be limited.
    /// Explicit steps cannot, and the particles of Breen's model repel each other at a spacing.
    pub(crate) fn keeps_surfaces_apart(&self) -> bool {
        let cannot = self.is_explicit() || self.is_breen();
        self.contact.surfaces.unwrap_or(!cannot)
    }

    /// Returns whether the integrator is explicit.
    pub(crate) fn is_explicit(&self) -> bool {
        self.solver.integrator.as_deref() == Some("explicit")
    }

    /// Returns whether the scene has Breen's model.
    pub(crate) fn is_breen(&self) -> bool {
        self.model.as_deref() == Some("breen-1994")
    }
}
