//! Scene as a person or a program describes it.
//!
//! [`SceneSpec`] follows the text of a scene key by key: it has the same names and the same
//! nesting. Numbers are in SI, and angles in degrees, in which a quarter turn is exact. Nothing
//! here is checked beyond its type. The chapter `check` turns a spec into a
//! [`Scene`](crate::Scene).
//!
//! Each field declares its key: the sentence is the comment of the field, the unit stands in
//! `serde_as`, the range in a `transform` of `schemars`, and the value of a missing key in
//! `Default` or in `serde(default)`. The schema, the check of ranges, its messages and the page of
//! the guide read these declarations.

pub(crate) mod body;
pub(crate) mod contact;
pub(crate) mod file_or;
pub(crate) mod garment;
pub(crate) mod motion;
pub(crate) mod panel;
pub(crate) mod pin;
pub(crate) mod run;
pub(crate) mod schema;
pub(crate) mod text;

use std::collections::BTreeMap;

use drape_fabric::Fabric;
use drape_input::{Acceleration, Density, Length};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::serde_as;

use crate::scene::model::Model;

use self::body::ColliderSpec;
use self::contact::ContactSpec;
use self::file_or::FileOr;
use self::garment::{GarmentSpec, SewSpec};
use self::panel::PanelSpec;
use self::pin::PinSpec;
use self::run::{
    GradingSpec, MotionPhaseSpec, OutputSpec, RefineSpec, SettleSpec, SolverSpec, TimeSpec,
};

/// Unit of the lengths of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum LengthUnit {
    /// Metres.
    #[default]
    M,
    /// Centimetres.
    Cm,
    /// Millimetres.
    Mm,
}

impl LengthUnit {
    /// Returns the unit, in m.
    #[must_use]
    pub fn metres(self) -> f64 {
        match self {
            Self::M => 1.0,
            Self::Cm => 0.01,
            Self::Mm => 0.001,
        }
    }
}

/// Scene of drape: cloth, bodies, contact, time.
///
/// A spec is edited and built as often as one likes: [`build`](SceneSpec::build) leaves it as it
/// is. Panels, fabrics and pins refer to each other by name.
///
/// Numbers of a spec and of its parts are in SI, also where a field names no unit: lengths in m,
/// times in s, masses in kg. Angles are in degrees. [`from_document`](SceneSpec::from_document)
/// resolves the unit of a file, and `length` then counts for meshes only.
///
/// A spec that is not filled in has a spacing of 1 cm, a gravity of 9.81 m/s² along −y, air of 1.2
/// kg/m³ with a drag coefficient of 1.28, steps of 5 ms that end after 1 s, frames every 40 ms,
/// bodies that repel cloth below 1 mm, and neither cloth nor bodies in it.
#[serde_as]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SceneSpec {
    /// Name of the scene; the name of the file if missing.
    pub name: Option<String>,
    /// Model of the cloth: `kes`, yarn connectors with the laws of the fabric, or `breen-1994`, the
    /// particles of Breen, House and Wozny, with the first branches of the curves, without
    /// friction, and with repulsion of all particles closer than the spacing.
    #[serde(default)]
    pub model: Model,
    /// Unit of all lengths of the file that stand without one, and of meshes without a `scale`.
    #[serde(default)]
    pub length: LengthUnit,
    /// Distance between particles.
    #[schemars(transform = drape_input::between(1e-6, 1e2))]
    #[serde_as(as = "Length")]
    #[serde(default = "spacing")]
    pub spacing: f64,
    /// Acceleration of gravity along x, y and z, in m/s².
    #[serde_as(as = "[Acceleration; 3]")]
    #[serde(default = "gravity")]
    pub gravity: [f64; 3],
    /// Air that the cloth moves in.
    #[serde(default)]
    pub air: AirSpec,
    /// Fabrics by the names that panels and garments use.
    #[serde(default)]
    pub fabric: BTreeMap<String, FabricSpec>,
    /// Pieces of cloth.
    #[serde(default)]
    pub panel: Vec<PanelSpec>,
    /// Patterns that are cut, placed and sewn.
    #[serde(default)]
    pub garment: Vec<GarmentSpec>,
    /// Sewing of the garments.
    #[serde(default)]
    pub sew: SewSpec,
    /// Particles that are held.
    #[serde(default)]
    pub pin: Vec<PinSpec>,
    /// Bodies.
    #[serde(default)]
    pub collider: ColliderSpec,
    /// Contact of cloth with bodies and with itself.
    #[serde(default)]
    pub contact: ContactSpec,
    /// Steps and the end of the run.
    pub time: TimeSpec,
    /// Run to rest, without momentum: the lengths of its steps are no durations, and the run ends
    /// when the cloth is at rest; in time if missing.
    pub settle: Option<SettleSpec>,
    /// Coarser grids, with `[settle]` only: garments are sewn and cloth comes to rest on them
    /// first, one after the other.
    pub refine: Option<RefineSpec>,
    /// Larger distances between particles where the cloth is flat, by the curvature of an earlier
    /// run; none if missing. Coarser grids of `[refine]` are not graded.
    pub grading: Option<GradingSpec>,
    /// Phase that follows when the cloth has come to rest, with `[settle]` only; bodies and pins
    /// move from the start if missing.
    pub motion: Option<MotionPhaseSpec>,
    /// Solver of the steps.
    #[serde(default)]
    pub solver: SolverSpec,
    /// Results.
    #[serde(default)]
    pub output: OutputSpec,
}

/// Returns the distance between particles where a scene names none, in m.
fn spacing() -> f64 {
    0.01
}

/// Returns the acceleration of gravity where a scene names none, in m/s².
fn gravity() -> [f64; 3] {
    [0.0, -9.81, 0.0]
}

impl Default for SceneSpec {
    fn default() -> Self {
        Self {
            name: None,
            model: Model::Kes,
            length: LengthUnit::M,
            spacing: spacing(),
            gravity: gravity(),
            air: AirSpec::default(),
            fabric: BTreeMap::new(),
            panel: Vec::new(),
            garment: Vec::new(),
            sew: SewSpec::default(),
            pin: Vec::new(),
            collider: ColliderSpec::default(),
            contact: ContactSpec::default(),
            time: TimeSpec::default(),
            settle: None,
            refine: None,
            grading: None,
            motion: None,
            solver: SolverSpec::default(),
            output: OutputSpec::default(),
        }
    }
}

/// Air that the cloth moves in.
#[serde_as]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct AirSpec {
    /// Density, in kg/m³; 0 is a vacuum.
    #[schemars(transform = drape_input::within(0.0, 100.0))]
    #[serde_as(as = "Density")]
    pub density: f64,
    /// Coefficient of drag of the cloth, as of a plate across the flow.
    #[schemars(transform = drape_input::within(0.0, 10.0))]
    pub drag: f64,
}

impl Default for AirSpec {
    /// Air at 20 °C and sea level, and the drag of a flat plate.
    fn default() -> Self {
        Self { density: 1.2, drag: 1.28 }
    }
}

/// Fabric of a scene.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FabricSpec {
    /// Fabric, sheet, or folder of a sheet, relative to the folder of the scene. A sheet is fitted
    /// first.
    pub file: FileOr<Fabric>,
    /// Colour of the front of the cloth in pictures, in the viewer and in files for other programs,
    /// as `#RRGGBB` in sRGB; the back is a paler or darker tone. Without a colour, several fabrics
    /// have colours that can be told apart.
    #[serde(alias = "color")]
    pub colour: Option<String>,
    /// Numbers that replace numbers of the fabric, in SI, by their keys in a `fabric.toml`,
    /// such as `"warp.bending.rigidity"`.
    #[serde(default)]
    pub set: BTreeMap<String, f64>,
}

impl SceneSpec {
    /// Returns whether surfaces are kept apart: if the scene does not say, unless it has Breen's
    /// model, whose particles repel each other at a spacing.
    pub(crate) fn keeps_surfaces_apart(&self) -> bool {
        self.contact.surfaces.unwrap_or(!self.is_breen())
    }

    /// Returns whether the scene has Breen's model.
    pub(crate) fn is_breen(&self) -> bool {
        self.model == Model::Breen1994
    }
}
