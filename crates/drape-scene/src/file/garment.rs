//! TOML form of garments and their sewing.

use std::collections::BTreeMap;

use drape_input::{Angle, Given, Length, Time};
use drape_pattern::SeamKeys;
use serde::Deserialize;

use crate::file::panel::NoiseFile;

/// Pattern that is cut, placed and sewn.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct GarmentFile {
    /// Name, which its panels have before theirs: `NAME.PANEL`; they keep the names of the pattern
    /// if missing.
    pub(crate) name: Option<String>,
    pub(crate) pattern: String,
    /// Fabric of the panels that name none.
    pub(crate) fabric: String,
    pub(crate) spacing: Option<Given<Length>>,
    /// Shift of all panels.
    #[serde(default)]
    pub(crate) center: [Given<Length>; 3],
    /// Layer in which it is worn; 0 if missing, which is next to the body.
    pub(crate) layer: Option<i64>,
    /// Random heights over the panels.
    pub(crate) noise: Option<NoiseFile>,
    /// Keys of single panels.
    #[serde(default)]
    pub(crate) panel: BTreeMap<String, GarmentPanelFile>,
    /// Seams that the pattern has not, or that take the place of its own of the same name.
    #[serde(default)]
    pub(crate) seam: BTreeMap<String, SeamKeys>,
}

#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct GarmentPanelFile {
    pub(crate) fabric: Option<String>,
    /// Angle from the panel's y axis to its warp, anticlockwise, in degrees; that of the pattern if
    /// missing.
    pub(crate) grain: Option<f64>,
    /// Origin of the panel's frame, and its rotations about x, y and z in degrees; those of the
    /// pattern if both are missing.
    pub(crate) center: Option<[Given<Length>; 3]>,
    pub(crate) turn: Option<[Given<Angle>; 3]>,
    /// Radius of the cylinder that it is bent to; that of the pattern if missing.
    pub(crate) wrap: Option<Given<Length>>,
    /// Layer in which it is worn; that of its garment if missing.
    pub(crate) layer: Option<i64>,
}

#[derive(Debug, Default, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct SewFile {
    /// Time until the seams are to be closed.
    pub(crate) seconds: Option<Given<Time>>,
    /// Bending stiffness of a seam over that of the fabric.
    pub(crate) stiffness: Option<f64>,
    /// Names of seams that are twisted or reversed on purpose.
    #[serde(default)]
    pub(crate) twisted: Vec<String>,
}
