//! TOML form of pins.

use drape_input::{Given, Length, Time};
use serde::Deserialize;

use crate::file::motion::MotionFile;

/// Particles of a panel that are held.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(extend("anyOf" = [{ "required": ["points"] }, { "required": ["edge"] }])))]
#[cfg_attr(feature = "schema", schemars(extend("dependentRequired" = { "rows": ["edge"] })))]
#[serde(deny_unknown_fields)]
pub(crate) struct PinFile {
    /// Name of the panel.
    pub(crate) panel: String,
    /// Positions on the panel, width × height from its lower left corner (a disc's middle), whose
    /// nearest particles are held.
    #[serde(default)]
    pub(crate) points: Vec<[Given<Length>; 2]>,
    /// Distance from the points within which particles are held; the nearest to each if missing.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::at_least(0.0)))]
    pub(crate) radius: Option<Given<Length>>,
    /// Edge that is held: `top`, `bottom`, `left` or `right`; of a panel of a garment one of its
    /// edges, by name; none if missing.
    pub(crate) edge: Option<String>,
    /// Rows that an edge holds: all within this number of spacings less a half. Along the yarns
    /// three rows are a clamp, whose line lies midway between the second and the third.
    #[cfg_attr(feature = "schema", schemars(extend("default" = 1)))]
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::at_least(1.0)))]
    pub(crate) rows: Option<usize>,
    /// Time at which it lets go, in s, before which the run does not end at rest; never if missing.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(0.0, 1e5)))]
    pub(crate) release: Option<Given<Time>>,
    /// Directions in which it holds, by springs of 100 N/mm for each particle; all of them,
    /// rigidly, if missing.
    #[cfg_attr(feature = "schema", schemars(extend("items" = { "enum": ["x", "y", "z"] })))]
    pub(crate) axes: Option<Vec<String>>,
    /// Phase until whose end it holds: `end`, of the run; `sewn`, until the garment is sewn;
    /// `rest`, until the cloth has come to rest.
    #[cfg_attr(feature = "schema", schemars(extend("default" = "end")))]
    #[cfg_attr(feature = "schema", schemars(extend("enum" = ["end", "sewn", "rest"])))]
    pub(crate) until: Option<String>,
    /// Motion of its particles; they stay where they are if missing.
    pub(crate) motion: Option<MotionFile>,
}
