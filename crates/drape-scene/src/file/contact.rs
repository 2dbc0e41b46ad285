//! TOML form of contact.

use drape_input::{Given, Length, PressurePerDistance, Speed, Time};
use serde::Deserialize;

/// Contact of cloth with bodies and with itself.
#[derive(Debug, Default, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct ContactFile {
    /// Activation distance, at which surfaces begin to repel each other; 1 mm if missing.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    pub(crate) offset: Option<Given<Length>>,
    /// Stiffness, in N/m³; 2e6, between layers from the thickness of the fabric under pressure and
    /// from the fastest motion of a body or a pin, if missing.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(1.0, 1e12)))]
    pub(crate) stiffness: Option<Given<PressurePerDistance>>,
    /// Speed below which particles on a body stick, in m/s.
    #[cfg_attr(feature = "schema", schemars(extend("default" = 0.001)))]
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(1e-9, 1.0)))]
    pub(crate) slip_speed: Option<Given<Speed>>,
    /// Whether surfaces are kept apart, so that cloth never passes through itself or bodies, and
    /// not particles out of bodies only; `true`, but `false` with explicit steps and in the model
    /// `breen-1994`, if missing.
    pub(crate) surfaces: Option<bool>,
    /// Displacement by which surfaces that stick give way before they slide; 5 µm if missing.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    pub(crate) stick: Option<Given<Length>>,
    /// Treatment of cloth that bodies close on: `error` ends the run, `thin` reduces the distance
    /// that is kept there to a tenth, `release` lets the faster body pass through the cloth.
    #[cfg_attr(feature = "schema", schemars(extend("default" = "error")))]
    #[cfg_attr(feature = "schema", schemars(extend("enum" = ["error", "thin", "release"])))]
    pub(crate) pinch: Option<String>,
    /// Room for cloth that starts in a body: bodies start smaller, and grow.
    pub(crate) inflate: Option<InflateFile>,
    /// Time over which the distances that surfaces keep grow to their values, in s, for cloth that
    /// starts nearer; they have their values at once if missing.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    pub(crate) grow: Option<Given<Time>>,
}

/// Bodies that start smaller.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct InflateFile {
    /// Depth by which bodies start smaller, along their normals, less than half their thickness.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    pub(crate) depth: Given<Length>,
    /// Time until they have their size, in s.
    #[cfg_attr(feature = "schema", schemars(extend("default" = 0.5)))]
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    pub(crate) seconds: Option<Given<Time>>,
}
