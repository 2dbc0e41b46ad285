//! TOML form of motions.

use drape_input::{Angle, Given, Length, Time};
use serde::Deserialize;

/// Rigid motion along keys.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct MotionFile {
    /// Times, in s, rising. The motion is linear between them, and at rest outside.
    pub(crate) times: Vec<Given<Time>>,
    /// Displacements, one for each time.
    #[serde(default)]
    pub(crate) shift: Vec<[Given<Length>; 3]>,
    /// Rotations, one for each time, in degrees about x, then y, then z.
    #[serde(default)]
    pub(crate) turn: Vec<[Given<Angle>; 3]>,
    /// Centre of rotation; the middle of what is moved if missing.
    pub(crate) center: Option<[Given<Length>; 3]>,
}
