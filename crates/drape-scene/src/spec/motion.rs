//! Rigid motions of bodies and pins.

use drape_input::{Angle, Length, Time};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::serde_as;

/// Rigid motion along keys.
#[serde_as]
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MotionSpec {
    /// Times, in s, rising. The motion is linear between them, and at rest outside.
    #[serde_as(as = "Vec<Time>")]
    pub times: Vec<f64>,
    /// Displacements, one for each time.
    #[serde(default)]
    #[serde_as(as = "Vec<[Length; 3]>")]
    pub shift: Vec<[f64; 3]>,
    /// Rotations, one for each time, in degrees about x, then y, then z.
    #[serde(default)]
    #[serde_as(as = "Vec<[Angle; 3]>")]
    pub turn: Vec<[f64; 3]>,
    /// Centre of rotation; the middle of what is moved if missing.
    #[serde_as(as = "Option<[Length; 3]>")]
    pub center: Option<[f64; 3]>,
}
