//! TOML form of pins.

use drape_input::{Given, Length, Time};
use serde::Deserialize;

use crate::file::motion::MotionFile;

#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct PinFile {
    pub(crate) panel: String,
    /// Positions on the panel, width × height from its lower left corner (a disc's middle).
    #[serde(default)]
    pub(crate) points: Vec<[Given<Length>; 2]>,
    /// Distance from the points within which particles are held; without it, the nearest to each.
    pub(crate) radius: Option<Given<Length>>,
    /// `top`, `bottom`, `left` or `right`; of a panel of a garment, one of its edges.
    pub(crate) edge: Option<String>,
    /// Rows that an edge holds: all within so many spacings less a half.
    pub(crate) rows: Option<usize>,
    /// Time at which it lets go, in s; never if missing.
    pub(crate) release: Option<Given<Time>>,
    /// `x`, `y` and `z`: the directions in which it holds; all of them if missing.
    pub(crate) axes: Option<Vec<String>>,
    /// `sewn`: it lets go when the garment is sewn; `rest`: when the cloth has come to rest.
    #[cfg_attr(feature = "schema", schemars(extend("enum" = ["end", "sewn", "rest"])))]
    pub(crate) until: Option<String>,
    /// Motion of its particles; they stay where they are if missing.
    pub(crate) motion: Option<MotionFile>,
}
