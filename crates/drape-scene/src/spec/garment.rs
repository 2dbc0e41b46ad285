//! Garments and their sewing.

use std::collections::BTreeMap;

use drape_input::{Angle, Given, Length, Time};
use drape_pattern::{MAX_EASE, Pattern, SeamKeys};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::serde_as;

use crate::spec::file_or::FileOr;
use crate::spec::panel::NoiseSpec;

/// Pattern that is cut, placed and sewn.
#[serde_as]
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GarmentSpec {
    /// Name of the garment, the first part of the names of its panels: `NAME.PANEL`. If it is
    /// missing, the garment has the name of the file of the pattern, and the panels have their
    /// names alone.
    pub name: Option<String>,
    /// Pattern, relative to the folder of the scene: TOML, GarmentCode or FreeSewing JSON, SVG or
    /// DXF. It is cut at the spacing, placed and sewn.
    pub pattern: FileOr<Pattern>,
    /// Fabric of the panels that name none.
    pub fabric: String,
    /// Distance between its particles; the spacing of the scene if missing.
    #[schemars(transform = drape_input::positive)]
    #[serde_as(as = "Option<Length>")]
    pub spacing: Option<f64>,
    /// Shift of all panels.
    #[serde(default)]
    #[serde_as(as = "[Length; 3]")]
    pub center: [f64; 3],
    /// Layer in which it is worn: 0 is next to the body, and for each layer a panel starts 20 mm
    /// farther out.
    #[schemars(transform = drape_input::within(0.0, 20.0))]
    #[serde(default)]
    pub layer: i64,
    /// Random heights over the panels.
    pub noise: Option<NoiseSpec>,
    /// Heights above y = 0 at which girth and ease are measured, by their names: `waist = 1.08`.
    /// `bust`, `waist` and `hip` are found on the body where they are missing.
    #[serde(default)]
    #[serde_as(as = "BTreeMap<_, Length>")]
    pub measure: BTreeMap<String, f64>,
    /// Keys of single panels, which replace keys of the pattern.
    #[serde(default)]
    pub panel: BTreeMap<String, GarmentPanelSpec>,
    /// Seams that the pattern has not, or that take the place of its own of the same name.
    #[serde(default)]
    pub seam: BTreeMap<String, SeamSpec>,
}

/// Keys of one panel of a garment.
#[serde_as]
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GarmentPanelSpec {
    /// Fabric; the fabric of the garment if missing.
    pub fabric: Option<String>,
    /// Angle from the panel's y axis to its warp, anticlockwise, in degrees; the angle of the
    /// pattern if missing.
    #[schemars(transform = drape_input::within(-180.0, 180.0))]
    #[serde_as(as = "Option<Angle>")]
    pub grain: Option<f64>,
    /// Origin of the panel's frame; the origin of the pattern if missing.
    #[serde_as(as = "Option<[Length; 3]>")]
    pub center: Option<[f64; 3]>,
    /// Rotations about x, y and z, one after the other, in degrees; the rotations of the pattern if
    /// missing.
    #[serde_as(as = "Option<[Angle; 3]>")]
    pub turn: Option<[f64; 3]>,
    /// Radius of the cylinder that it is bent to; the radius of the pattern if missing.
    #[serde_as(as = "Option<Length>")]
    pub wrap: Option<f64>,
    /// Layer in which it is worn; the layer of its garment if missing.
    #[schemars(transform = drape_input::within(0.0, 20.0))]
    pub layer: Option<i64>,
}

/// Seam between edges of the panels of a garment.
#[serde_as]
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SeamSpec {
    /// Edges of both sides, as `panel.edge`, in the order in which the seam runs.
    pub sides: [Vec<String>; 2],
    /// Whether the seam joins a right side to a wrong side.
    #[serde(default)]
    pub reversed: bool,
    /// Largest ratio of the lengths of the sides that is meant; 1.1 if missing.
    #[schemars(transform = drape_input::within(1.0, MAX_EASE))]
    pub max_ease: Option<f64>,
    /// Angle between the sides of the sewn seam, towards their right sides, in degrees.
    #[schemars(transform = drape_input::within(-140.0, 140.0))]
    #[serde_as(as = "Angle")]
    #[serde(default)]
    pub angle: f64,
    /// Width of the seam allowance on each side.
    #[schemars(transform = drape_input::at_least(0.0))]
    #[serde_as(as = "Length")]
    #[serde(default)]
    pub allowance: f64,
}

impl SeamSpec {
    /// Returns the keys of the seam as a pattern takes them, with lengths in m.
    pub(crate) fn keys(&self) -> SeamKeys {
        SeamKeys {
            sides: self.sides.clone(),
            reversed: self.reversed,
            max_ease: self.max_ease,
            angle: Given::bare(self.angle),
            allowance: Given::bare(self.allowance),
        }
    }
}

/// Sewing of the garments.
#[serde_as]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SewSpec {
    /// Time until the seams are to be closed, in s.
    #[schemars(transform = drape_input::within(1e-3, 1e3))]
    #[serde_as(as = "Time")]
    pub seconds: f64,
    /// Bending stiffness of a seam over the bending stiffness of the fabric.
    #[schemars(transform = drape_input::within(0.0, 1e3))]
    pub stiffness: f64,
    /// Names of seams that are twisted or reversed on purpose; others are refused, with the order
    /// that fits.
    pub twisted: Vec<String>,
}

impl Default for SewSpec {
    fn default() -> Self {
        Self { seconds: 1.0, stiffness: drape_cloth::Seam::STIFFNESS, twisted: Vec::new() }
    }
}
