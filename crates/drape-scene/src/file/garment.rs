use std::collections::BTreeMap;

use serde::Deserialize;

use super::NoiseFile;

/// A pattern that is cut, placed and sewn.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct GarmentFile {
    /// What it is called, and its panels after it: `NAME.PANEL`; those of the pattern keep their names if missing.
    pub(crate) name: Option<String>,
    pub(crate) pattern: String,
    /// The fabric of the panels that name none.
    pub(crate) fabric: String,
    pub(crate) spacing: Option<f64>,
    /// Shift of all panels.
    #[serde(default)]
    pub(crate) center: [f64; 3],
    /// How far out it is worn; 0 if missing, which is next to the body.
    pub(crate) layer: Option<i64>,
    /// Random heights over the panels.
    pub(crate) noise: Option<NoiseFile>,
    /// What is said of single panels.
    #[serde(default)]
    pub(crate) panel: BTreeMap<String, GarmentPanelFile>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct GarmentPanelFile {
    pub(crate) fabric: Option<String>,
    /// Where the origin of the panel's frame is, and its turns about x, y and z in degrees; those of the pattern if both
    /// are missing.
    pub(crate) center: Option<[f64; 3]>,
    pub(crate) turn: Option<[f64; 3]>,
    /// Radius of the cylinder that it is bent to; that of the pattern if missing.
    pub(crate) wrap: Option<f64>,
    /// How far out it is worn; as far as its garment if missing.
    pub(crate) layer: Option<i64>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SewFile {
    /// How long the sides of the seams are drawn together.
    pub(crate) seconds: Option<f64>,
    /// How many times as stiff as the fabric a seam is.
    pub(crate) stiffness: Option<f64>,
}
