//! Pins.

use drape_input::{Length, Time};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::serde_as;

use crate::scene::pin::HoldUntil;
use crate::spec::motion::MotionSpec;

/// Particles of a panel that are held.
#[serde_as]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(extend("anyOf" = [{ "required": ["points"] }, { "required": ["edge"] }]))]
#[schemars(extend("dependentRequired" = { "rows": ["edge"] }))]
#[serde(deny_unknown_fields)]
pub struct PinSpec {
    /// Name of the panel.
    pub panel: String,
    /// Positions on the panel, width × height from its lower left corner (a disc's middle), whose
    /// nearest particles are held.
    #[serde(default)]
    #[serde_as(as = "Vec<[Length; 2]>")]
    pub points: Vec<[f64; 2]>,
    /// Distance from the points within which particles are held; the nearest to each if missing.
    #[schemars(transform = drape_input::at_least(0.0))]
    #[serde_as(as = "Option<Length>")]
    pub radius: Option<f64>,
    /// Edge that is held: `top`, `bottom`, `left` or `right`; of a panel of a garment one of its
    /// edges, by name; none if missing.
    pub edge: Option<String>,
    /// Rows that an edge holds: all within this number of spacings less a half. Along the yarns
    /// three rows are a clamp, whose line lies midway between the second and the third.
    #[schemars(transform = drape_input::at_least(1.0))]
    #[serde(default = "one_row")]
    pub rows: usize,
    /// Time at which it lets go, in s, before which the run does not end at rest; never if missing.
    #[schemars(transform = drape_input::within(0.0, 1e5))]
    #[serde_as(as = "Option<Time>")]
    pub release: Option<f64>,
    /// Directions in which it holds, by springs of 100 N/mm for each particle; all of them,
    /// rigidly, if missing.
    pub axes: Option<Vec<Axis>>,
    /// Phase until whose end it holds: `end`, of the run; `sewn`, until the garment is sewn;
    /// `rest`, until the cloth has come to rest.
    #[serde(default)]
    pub until: HoldUntil,
    /// Motion of its particles; they stay where they are if missing.
    pub motion: Option<MotionSpec>,
}

/// Returns the number of rows that an edge holds where a pin names none.
fn one_row() -> usize {
    1
}

impl Default for PinSpec {
    fn default() -> Self {
        Self {
            panel: String::new(),
            points: Vec::new(),
            radius: None,
            edge: None,
            rows: one_row(),
            release: None,
            axes: None,
            until: HoldUntil::End,
            motion: None,
        }
    }
}

/// Axis of the world.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Axis {
    /// Along x.
    X,
    /// Along y, which is up.
    Y,
    /// Along z.
    Z,
}
