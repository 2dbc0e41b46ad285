//! TOML form of panels.

use drape_input::{Angle, AngularSpeed, Given, Length, Speed};
use serde::Deserialize;

/// Piece of cloth: a rectangle or a disc.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = drape_input::one_of("rectangle, disc")))]
#[serde(deny_unknown_fields)]
pub(crate) struct PanelFile {
    /// Name, by which pins and measures know it.
    pub(crate) name: String,
    /// Name of its fabric.
    pub(crate) fabric: String,
    /// Width × height of a rectangle: weft × warp where no grain is given.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    pub(crate) rectangle: Option<[Given<Length>; 2]>,
    /// Diameter of a disc. Triangles along its rim follow the circle; the rim is stepped, along the
    /// cells, where the disc has a `hole` or a `grid`, and in Breen's model.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    pub(crate) disc: Option<Given<Length>>,
    /// Diameter of the hole in a disc's middle; no hole if missing.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    pub(crate) hole: Option<Given<Length>>,
    /// Angle from the panel's height to its warp, anticlockwise on its right side, in degrees.
    /// Particles stay on the yarns.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(-180.0, 180.0)))]
    #[serde(default)]
    pub(crate) grain: Given<Angle>,
    /// Offset of one particle from the middle of the panel, weft × warp, from which the lattice
    /// goes on; 0 if missing. A disc with a `grid` has a stepped rim, and its drape takes about
    /// half of the time; without it the rim is round.
    pub(crate) grid: Option<[Given<Length>; 2]>,
    /// Distance between its particles; the spacing of the scene if missing.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    pub(crate) spacing: Option<Given<Length>>,
    /// Position of the middle of the panel.
    #[serde(default)]
    pub(crate) center: [Given<Length>; 3],
    /// Rotations about the x, y and z axes, one after the other, in degrees.
    #[serde(default)]
    pub(crate) turn: [Given<Angle>; 3],
    /// Velocity of its middle at the start, in the unit of the file per second.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(-1e5, 1e5)))]
    #[serde(default)]
    pub(crate) velocity: [Given<Speed>; 3],
    /// Angular velocity about the world's axes through its middle, in degrees/s.
    #[serde(default)]
    pub(crate) spin: [Given<AngularSpeed>; 3],
    /// Waves over the panel at the start.
    pub(crate) ripple: Option<RippleFile>,
    /// Random heights over the panel at the start.
    pub(crate) noise: Option<NoiseFile>,
    /// Copies of this panel, in a row.
    pub(crate) stack: Option<StackFile>,
    /// Lines along which it is folded at rest. They need `settle.residual = 1e-5` or less.
    #[serde(default)]
    pub(crate) fold: Vec<FoldFile>,
}

/// Line along which a panel is folded at rest.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct FoldFile {
    /// One end, a position on the panel as for a pin, which may lie outside.
    pub(crate) from: [Given<Length>; 2],
    /// The other end.
    pub(crate) to: [Given<Length>; 2],
    /// Angle by which the panel is turned towards its right side, in degrees, at most 140 either
    /// way.
    pub(crate) angle: Given<Angle>,
}

/// Panels like another one, in a row.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct StackFile {
    /// Number of panels in all; they are called NAME 2, NAME 3 and so on.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::at_least(1.0)))]
    pub(crate) count: usize,
    /// Vector from the middle of each panel to the middle of the next.
    pub(crate) step: [Given<Length>; 3],
    /// Rotation from each to the next, added to the panel's, in degrees.
    #[serde(default)]
    pub(crate) turn: [Given<Angle>; 3],
}

/// Waves over a panel at the start.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct RippleFile {
    /// Height of the waves, which run across the width.
    pub(crate) amplitude: Given<Length>,
    /// Length of the waves.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    pub(crate) wavelength: Given<Length>,
}

/// Random heights over a panel at the start.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct NoiseFile {
    /// Largest height.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::at_least(0.0)))]
    pub(crate) amplitude: Given<Length>,
    /// Length over which heights change, the same at every spacing; every particle has a height of
    /// its own if missing.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    pub(crate) length: Option<Given<Length>>,
    /// Number that chooses the heights.
    #[serde(default)]
    pub(crate) seed: u64,
}
