//! TOML form of panels.

use drape_input::{Angle, AngularSpeed, Given, Length, Speed};
use serde::Deserialize;

#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct PanelFile {
    pub(crate) name: String,
    pub(crate) fabric: String,
    /// Width × height: weft × warp where no grain is given.
    pub(crate) rectangle: Option<[Given<Length>; 2]>,
    /// Diameter.
    pub(crate) disc: Option<Given<Length>>,
    /// Diameter of the hole in a disc's middle.
    pub(crate) hole: Option<Given<Length>>,
    /// Angle from the panel's height to its warp, anticlockwise, in degrees.
    #[serde(default)]
    pub(crate) grain: Given<Angle>,
    /// Position of a particle from the middle, weft × warp; a particle is in the middle if missing.
    pub(crate) grid: Option<[Given<Length>; 2]>,
    pub(crate) spacing: Option<Given<Length>>,
    /// Position of the middle of the panel.
    #[serde(default)]
    pub(crate) center: [Given<Length>; 3],
    /// Rotations about the x, y and z axes, one after the other, in degrees.
    #[serde(default)]
    pub(crate) turn: [Given<Angle>; 3],
    /// Velocity of its middle at the start, per second.
    #[serde(default)]
    pub(crate) velocity: [Given<Speed>; 3],
    /// Angular velocity about the world's axes through its middle, in degrees/s.
    #[serde(default)]
    pub(crate) spin: [Given<AngularSpeed>; 3],
    pub(crate) ripple: Option<RippleFile>,
    pub(crate) noise: Option<NoiseFile>,
    /// Further panels like this one.
    pub(crate) stack: Option<StackFile>,
    /// Lines along which it is folded at rest.
    #[serde(default)]
    pub(crate) fold: Vec<FoldFile>,
}

#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct FoldFile {
    /// Its ends, positions on the panel as for a pin.
    pub(crate) from: [Given<Length>; 2],
    pub(crate) to: [Given<Length>; 2],
    /// Angle by which the panel is turned towards its right side, in degrees.
    pub(crate) angle: Given<Angle>,
}

#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct StackFile {
    /// Number of panels in all; they are called NAME 2, NAME 3 and so on.
    pub(crate) count: usize,
    /// Vector from the middle of each to that of the next.
    pub(crate) step: [Given<Length>; 3],
    /// Rotation from each to the next, added to the panel's, in degrees.
    #[serde(default)]
    pub(crate) turn: [Given<Angle>; 3],
}

#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct RippleFile {
    pub(crate) amplitude: Given<Length>,
    pub(crate) wavelength: Given<Length>,
}

#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct NoiseFile {
    pub(crate) amplitude: Given<Length>,
    pub(crate) length: Option<Given<Length>>,
    #[serde(default)]
    pub(crate) seed: u64,
}
