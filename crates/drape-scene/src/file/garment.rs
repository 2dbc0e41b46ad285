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
    /// Name, which stands before the names of its panels: `NAME.PANEL`; the name of the file of the
    /// pattern, and the panels have their names alone, if missing.
    pub(crate) name: Option<String>,
    /// Pattern, relative to the folder of the scene: TOML, GarmentCode or FreeSewing JSON, SVG or
    /// DXF. It is cut at the spacing, placed and sewn.
    pub(crate) pattern: String,
    /// Fabric of the panels that name none.
    pub(crate) fabric: String,
    /// Distance between its particles; the spacing of the scene if missing.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    pub(crate) spacing: Option<Given<Length>>,
    /// Shift of all panels.
    #[serde(default)]
    pub(crate) center: [Given<Length>; 3],
    /// Layer in which it is worn, from the inside out: for each layer a panel starts 20 mm farther
    /// out.
    #[cfg_attr(feature = "schema", schemars(extend("default" = 0)))]
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::at_least(0.0)))]
    pub(crate) layer: Option<i64>,
    /// Random heights over the panels.
    pub(crate) noise: Option<NoiseFile>,
    /// Heights above y = 0 at which girth and ease are measured, by their names: `waist = 1.08`.
    /// `bust`, `waist` and `hip` are found on the body where they are missing.
    #[serde(default)]
    pub(crate) measure: BTreeMap<String, Given<Length>>,
    /// Keys of single panels, which replace keys of the pattern.
    #[serde(default)]
    pub(crate) panel: BTreeMap<String, GarmentPanelFile>,
    /// Seams that the pattern has not, or that take the place of its own of the same name.
    #[serde(default)]
    pub(crate) seam: BTreeMap<String, SeamKeys>,
}

/// Keys of one panel of a garment.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct GarmentPanelFile {
    /// Fabric; the fabric of the garment if missing.
    pub(crate) fabric: Option<String>,
    /// Angle from the panel's y axis to its warp, anticlockwise, in degrees; the angle of the
    /// pattern if missing.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(-180.0, 180.0)))]
    pub(crate) grain: Option<Given<Angle>>,
    /// Origin of the panel's frame; the origin of the pattern if missing.
    pub(crate) center: Option<[Given<Length>; 3]>,
    /// Rotations about x, y and z, one after the other, in degrees; the rotations of the pattern if
    /// missing.
    pub(crate) turn: Option<[Given<Angle>; 3]>,
    /// Radius of the cylinder that it is bent to; the radius of the pattern if missing.
    pub(crate) wrap: Option<Given<Length>>,
    /// Layer in which it is worn; the layer of its garment if missing.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::at_least(0.0)))]
    pub(crate) layer: Option<i64>,
}

/// Sewing of the garments.
#[derive(Debug, Default, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct SewFile {
    /// Time until the seams are to be closed, in s.
    #[cfg_attr(feature = "schema", schemars(extend("default" = 1.0)))]
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(1e-3, 1e3)))]
    pub(crate) seconds: Option<Given<Time>>,
    /// Bending stiffness of a seam over the bending stiffness of the fabric.
    #[cfg_attr(feature = "schema", schemars(extend("default" = 3.0)))]
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(0.0, 1e3)))]
    pub(crate) stiffness: Option<f64>,
    /// Names of seams that are twisted or reversed on purpose; others are refused, with the order
    /// that fits.
    #[serde(default)]
    pub(crate) twisted: Vec<String>,
}
