//! Panels that a scene describes itself.

use drape_input::{Angle, AngularSpeed, Length, Velocity};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::serde_as;

/// Piece of cloth: a rectangle or a disc.
#[serde_as]
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[schemars(transform = drape_input::one_of("rectangle, disc"))]
#[serde(deny_unknown_fields)]
pub struct PanelSpec {
    /// Name, by which pins and measures know it.
    pub name: String,
    /// Name of its fabric.
    pub fabric: String,
    /// Width × height of a rectangle: weft × warp where no grain is given.
    #[schemars(transform = drape_input::between(1e-4, 1e3))]
    #[serde_as(as = "Option<[Length; 2]>")]
    pub rectangle: Option<[f64; 2]>,
    /// Diameter of a disc. Triangles along its rim follow the circle; the rim is stepped, along the
    /// cells, where the disc has a `hole` or a `grid`, and in Breen's model.
    #[schemars(transform = drape_input::between(1e-4, 1e3))]
    #[serde_as(as = "Option<Length>")]
    pub disc: Option<f64>,
    /// Diameter of the hole in a disc's middle; no hole if missing.
    #[schemars(transform = drape_input::positive)]
    #[serde_as(as = "Option<Length>")]
    pub hole: Option<f64>,
    /// Angle from the panel's height to its warp, anticlockwise on its right side, in degrees.
    /// Particles stay on the yarns.
    #[schemars(transform = drape_input::within(-180.0, 180.0))]
    #[serde(default)]
    #[serde_as(as = "Angle")]
    pub grain: f64,
    /// Offset of one particle from the middle of the panel, weft × warp, from which the lattice
    /// goes on; 0 if missing. A disc with a `grid` has a stepped rim, and its drape takes about
    /// half of the time; without it the rim is round.
    #[serde_as(as = "Option<[Length; 2]>")]
    pub grid: Option<[f64; 2]>,
    /// Distance between its particles; the spacing of the scene if missing.
    #[schemars(transform = drape_input::positive)]
    #[serde_as(as = "Option<Length>")]
    pub spacing: Option<f64>,
    /// Position of the middle of the panel.
    #[serde(default)]
    #[serde_as(as = "[Length; 3]")]
    pub center: [f64; 3],
    /// Rotations about the x, y and z axes, one after the other, in degrees.
    #[serde(default)]
    #[serde_as(as = "[Angle; 3]")]
    pub turn: [f64; 3],
    /// Velocity of its middle at the start, in the unit of the file per second.
    #[schemars(transform = drape_input::within(-1e5, 1e5))]
    #[serde(default)]
    #[serde_as(as = "[Velocity; 3]")]
    pub velocity: [f64; 3],
    /// Angular velocity about the world's axes through its middle, in degrees/s.
    #[serde(default)]
    #[serde_as(as = "[AngularSpeed; 3]")]
    pub spin: [f64; 3],
    /// Waves over the panel at the start.
    pub ripple: Option<RippleSpec>,
    /// Random heights over the panel at the start.
    pub noise: Option<NoiseSpec>,
    /// Copies of this panel, in a row.
    pub stack: Option<StackSpec>,
    /// Lines along which it is folded at rest. They need `settle.residual = 1e-5` or less.
    #[serde(default)]
    pub fold: Vec<FoldSpec>,
}

/// Line along which a panel is folded at rest.
#[serde_as]
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FoldSpec {
    /// One end, a position on the panel as for a pin, which may lie outside.
    #[serde_as(as = "[Length; 2]")]
    pub from: [f64; 2],
    /// The other end.
    #[serde_as(as = "[Length; 2]")]
    pub to: [f64; 2],
    /// Angle by which the panel is turned towards its right side, in degrees, at most 140 either
    /// way.
    #[serde_as(as = "Angle")]
    pub angle: f64,
}

/// Panels like another one, in a row.
#[serde_as]
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StackSpec {
    /// Number of panels in all; they are called NAME 2, NAME 3 and so on. 1 is the panel alone.
    #[schemars(transform = drape_input::at_least(1.0))]
    pub count: usize,
    /// Vector from the middle of each panel to the middle of the next.
    #[serde_as(as = "[Length; 3]")]
    pub step: [f64; 3],
    /// Rotation from each to the next, added to the panel's, in degrees.
    #[serde(default)]
    #[serde_as(as = "[Angle; 3]")]
    pub turn: [f64; 3],
}

/// Waves over a panel at the start.
#[serde_as]
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RippleSpec {
    /// Height of the waves, which run across the width.
    #[serde_as(as = "Length")]
    pub amplitude: f64,
    /// Length of the waves.
    #[schemars(transform = drape_input::positive)]
    #[serde_as(as = "Length")]
    pub wavelength: f64,
}

/// Random heights over a panel at the start.
#[serde_as]
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NoiseSpec {
    /// Largest height.
    #[schemars(transform = drape_input::at_least(0.0))]
    #[serde_as(as = "Length")]
    pub amplitude: f64,
    /// Length over which heights change, the same at every spacing; every particle has a height of
    /// its own if missing.
    #[schemars(transform = drape_input::positive)]
    #[serde_as(as = "Option<Length>")]
    pub length: Option<f64>,
    /// Number that chooses the heights.
    #[serde(default)]
    pub seed: u64,
}
