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

use std::collections::BTreeMap;

use drape_input::{Acceleration, Density, Given, Length};
use serde::Deserialize;

use self::body::ColliderFile;
use self::contact::ContactFile;
use self::garment::{GarmentFile, SewFile};
use self::panel::PanelFile;
use self::pin::PinFile;
use self::run::{MotionPhaseFile, OutputFile, SettleFile, SolverFile, TimeFile};

#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct SceneFile {
    pub(crate) name: Option<String>,
    /// `kes` or `breen-1994`.
    #[cfg_attr(feature = "schema", schemars(extend("enum" = ["kes", "breen-1994"])))]
    pub(crate) model: Option<String>,
    /// Unit of all lengths of the file: `m`, `cm` or `mm`.
    #[cfg_attr(feature = "schema", schemars(extend("enum" = ["m", "cm", "mm"])))]
    pub(crate) length: Option<String>,
    /// Distance between particles.
    pub(crate) spacing: Option<Given<Length>>,
    /// Acceleration of gravity, in m/s².
    pub(crate) gravity: Option<[Given<Acceleration>; 3]>,
    pub(crate) air: Option<AirFile>,
    #[serde(default)]
    pub(crate) fabric: BTreeMap<String, FabricFile>,
    #[serde(default)]
    pub(crate) panel: Vec<PanelFile>,
    #[serde(default)]
    pub(crate) garment: Vec<GarmentFile>,
    #[serde(default)]
    pub(crate) sew: SewFile,
    #[serde(default)]
    pub(crate) pin: Vec<PinFile>,
    #[serde(default)]
    pub(crate) collider: ColliderFile,
    #[serde(default)]
    pub(crate) contact: ContactFile,
    pub(crate) time: TimeFile,
    pub(crate) settle: Option<SettleFile>,
    pub(crate) motion: Option<MotionPhaseFile>,
    #[serde(default)]
    pub(crate) solver: SolverFile,
    #[serde(default)]
    pub(crate) output: OutputFile,
}

#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct AirFile {
    /// Density, in kg/m³.
    pub(crate) density: Option<Given<Density>>,
    pub(crate) drag: Option<f64>,
}

#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct FabricFile {
    pub(crate) file: String,
}

/// Returns the JSON Schema of scenes.
#[cfg(feature = "schema")]
#[must_use]
pub fn scene_schema() -> serde_json::Value {
    drape_input::schema_of::<SceneFile>("Scene of drape")
}

impl SceneFile {
    /// Whether surfaces are kept apart: if the scene does not say, wherever steps can be limited.
    /// Explicit steps cannot, and the particles of Breen's model repel each other at a spacing.
    pub(crate) fn keeps_surfaces_apart(&self) -> bool {
        let is = |key: &Option<String>, word: &str| key.as_deref() == Some(word);
        let cannot = is(&self.solver.integrator, "explicit") || is(&self.model, "breen-1994");
        self.contact.surfaces.unwrap_or(!cannot)
    }
}
