//! Keys of a pattern in the project's own format.

use std::collections::BTreeMap;

use serde::Deserialize;

use crate::read::seams::SeamKeys;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct PatternKeys {
    pub(crate) length: Option<String>,
    pub(crate) from: Option<FromKeys>,
    #[serde(default)]
    pub(crate) panel: BTreeMap<String, PanelKeys>,
    #[serde(default)]
    pub(crate) seam: BTreeMap<String, SeamKeys>,
}

/// Pattern of another format that the file adds to.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct FromKeys {
    pub(crate) file: String,
    pub(crate) unit: Option<String>,
    pub(crate) size: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct PanelKeys {
    pub(crate) start: Option<[f64; 2]>,
    pub(crate) outline: Option<Vec<EdgeKeys>>,
    pub(crate) rectangle: Option<[f64; 2]>,
    pub(crate) path: Option<String>,
    pub(crate) edges: Option<Vec<String>>,
    pub(crate) copy_of: Option<String>,
    #[serde(default)]
    pub(crate) mirrored: bool,
    #[serde(default)]
    pub(crate) omit: bool,
    /// Shift of the outline and the folds in the panel's frame.
    pub(crate) shift: Option<[f64; 2]>,
    #[serde(default)]
    pub(crate) split: BTreeMap<String, Vec<f64>>,
    #[serde(default)]
    pub(crate) hems: BTreeMap<String, f64>,
    pub(crate) fabric: Option<String>,
    pub(crate) grain: Option<f64>,
    pub(crate) origin: Option<[f64; 3]>,
    pub(crate) turn: Option<[f64; 3]>,
    pub(crate) wrap: Option<f64>,
    #[serde(default)]
    pub(crate) fold: Vec<FoldKeys>,
}

impl PanelKeys {
    /// Returns whether the panel has a shape of its own here.
    pub(crate) fn has_shape(&self) -> bool {
        self.outline.is_some()
            || self.rectangle.is_some()
            || self.path.is_some()
            || self.start.is_some()
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct FoldKeys {
    pub(crate) from: [f64; 2],
    pub(crate) to: [f64; 2],
    pub(crate) angle: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct EdgeKeys {
    pub(crate) name: Option<String>,
    pub(crate) to: [f64; 2],
    pub(crate) quadratic: Option<[f64; 2]>,
    pub(crate) cubic: Option<[[f64; 2]; 2]>,
    pub(crate) radius: Option<f64>,
    #[serde(default)]
    pub(crate) large: bool,
    #[serde(default)]
    pub(crate) hem: f64,
    #[serde(default)]
    pub(crate) notches: Vec<f64>,
}
