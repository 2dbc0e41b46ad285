//! TOML form of panels.

use serde::Deserialize;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct PanelFile {
    pub(crate) name: String,
    pub(crate) fabric: String,
    /// Width × height: weft × warp where no grain is given.
    pub(crate) rectangle: Option<[f64; 2]>,
    /// Diameter.
    pub(crate) disc: Option<f64>,
    /// Diameter of the hole in a disc's middle.
    pub(crate) hole: Option<f64>,
    /// Angle from the panel's height to its warp, anticlockwise, in degrees.
    #[serde(default)]
    pub(crate) grain: f64,
    /// Position of a particle from the middle, weft × warp; a particle is in the middle if missing.
    pub(crate) grid: Option<[f64; 2]>,
    pub(crate) spacing: Option<f64>,
    /// Position of the middle of the panel.
    #[serde(default)]
    pub(crate) center: [f64; 3],
    /// Rotations about the x, y and z axes, one after the other, in degrees.
    #[serde(default)]
    pub(crate) turn: [f64; 3],
    /// Velocity of its middle at the start, per second.
    #[serde(default)]
    pub(crate) velocity: [f64; 3],
    /// Angular velocity about the world's axes through its middle, in degrees/s.
    #[serde(default)]
    pub(crate) spin: [f64; 3],
    pub(crate) ripple: Option<RippleFile>,
    pub(crate) noise: Option<NoiseFile>,
    /// Further panels like this one.
    pub(crate) stack: Option<StackFile>,
    /// Lines along which it is folded at rest.
    #[serde(default)]
    pub(crate) fold: Vec<FoldFile>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct FoldFile {
    /// Its ends, positions on the panel as for a pin.
    pub(crate) from: [f64; 2],
    pub(crate) to: [f64; 2],
    /// Angle by which the panel is turned towards its right side, in degrees.
    pub(crate) angle: f64,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct StackFile {
    /// Number of panels in all; they are called NAME 2, NAME 3 and so on.
    pub(crate) count: usize,
    /// Vector from the middle of each to that of the next.
    pub(crate) step: [f64; 3],
    /// Rotation from each to the next, added to the panel's, in degrees.
    #[serde(default)]
    pub(crate) turn: [f64; 3],
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RippleFile {
    pub(crate) amplitude: f64,
    pub(crate) wavelength: f64,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct NoiseFile {
    pub(crate) amplitude: f64,
    pub(crate) length: Option<f64>,
    #[serde(default)]
    pub(crate) seed: u64,
}
