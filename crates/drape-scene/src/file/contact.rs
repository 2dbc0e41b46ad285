//! TOML form of contact.

use serde::Deserialize;

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ContactFile {
    /// Activation distance.
    pub(crate) offset: Option<f64>,
    /// Stiffness, in N/m³.
    pub(crate) stiffness: Option<f64>,
    /// Speed below which particles stick, in m/s.
    pub(crate) slip_speed: Option<f64>,
    /// Whether surfaces are kept apart, and not particles out of bodies only; wherever that can be
    /// if missing.
    pub(crate) surfaces: Option<bool>,
    /// Displacement of surfaces that stick, before they slide.
    pub(crate) stick: Option<f64>,
    /// `error`, `thin` or `release`: treatment of cloth that bodies close on.
    pub(crate) pinch: Option<String>,
    /// Room for cloth that starts in a body.
    pub(crate) inflate: Option<InflateFile>,
    /// Time over which the distances that surfaces keep grow, in s, for cloth that starts nearer.
    pub(crate) grow: Option<f64>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct InflateFile {
    /// Depth by which bodies start smaller, along their normals.
    pub(crate) depth: f64,
    /// Time until they have their size, in s.
    pub(crate) seconds: Option<f64>,
}
