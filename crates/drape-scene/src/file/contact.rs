//! TOML form of contact.

use drape_input::{Given, Length, PressurePerDistance, Speed, Time};
use serde::Deserialize;

/// Contact of cloth with bodies and with itself.
#[derive(Debug, Default, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct ContactFile {
    /// Activation distance, at which surfaces begin to repel each other.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    pub(crate) offset: Option<Given<Length>>,
    /// Stiffness, in N/m³; of cloth on cloth by its thickness under pressure if missing.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(1.0, 1e12)))]
    pub(crate) stiffness: Option<Given<PressurePerDistance>>,
    /// Speed below which particles stick, in m/s.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(1e-9, 1.0)))]
    pub(crate) slip_speed: Option<Given<Speed>>,
    /// Whether surfaces are kept apart, and not particles out of bodies only; wherever that can be
    /// if missing.
    pub(crate) surfaces: Option<bool>,
    /// Displacement of surfaces that stick, before they slide.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    pub(crate) stick: Option<Given<Length>>,
    /// `error`, `thin` or `release`: treatment of cloth that bodies close on.
    #[cfg_attr(feature = "schema", schemars(extend("enum" = ["error", "thin", "release"])))]
    pub(crate) pinch: Option<String>,
    /// Room for cloth that starts in a body.
    pub(crate) inflate: Option<InflateFile>,
    /// Time over which the distances that surfaces keep grow, in s, for cloth that starts nearer.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    pub(crate) grow: Option<Given<Time>>,
}

/// Bodies that start smaller.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct InflateFile {
    /// Depth by which bodies start smaller, along their normals.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    pub(crate) depth: Given<Length>,
    /// Time until they have their size, in s.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    pub(crate) seconds: Option<Given<Time>>,
}
