//! Contact of cloth with bodies and with itself.

use drape_collide::{ParticleSettings, PinchPolicy, SurfaceSettings};
use drape_input::{Length, PressurePerDistance, Speed, Time};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::serde_as;

/// Contact of cloth with bodies and with itself.
#[serde_as]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ContactSpec {
    /// Activation distance, at which surfaces begin to repel each other.
    #[schemars(transform = drape_input::between(1e-5, 0.1))]
    #[serde_as(as = "Length")]
    pub offset: f64,
    /// Stiffness, in N/m³; 2e6, between layers from the thickness of the fabric under pressure and
    /// from `top_speed` and the fastest motion of a body or a pin, if missing.
    #[schemars(transform = drape_input::within(1.0, 1e12))]
    #[serde_as(as = "Option<PressurePerDistance>")]
    pub stiffness: Option<f64>,
    /// Top speed at which a program moves bodies and pins between steps, in m/s: contact becomes
    /// stiff enough to stop them. Motions of the scene need no such key.
    #[schemars(transform = drape_input::within(1e-3, 1e3))]
    #[serde_as(as = "Option<Speed>")]
    pub top_speed: Option<f64>,
    /// Speed below which particles on a body stick, in m/s.
    #[schemars(transform = drape_input::within(1e-9, 1.0))]
    #[serde_as(as = "Speed")]
    pub slip_speed: f64,
    /// Whether surfaces are kept apart, so that cloth never passes through itself or bodies, and
    /// not particles out of bodies only; `true`, but `false` in the model `breen-1994`, if missing.
    pub surfaces: Option<bool>,
    /// Displacement by which surfaces that stick give way before they slide.
    #[schemars(transform = drape_input::between(1e-9, 1e-2))]
    #[serde_as(as = "Length")]
    pub stick: f64,
    /// Treatment of cloth that bodies close on: `error` ends the run, `thin` reduces the distance
    /// that is kept there to a tenth, `release` lets the faster body pass through the cloth.
    pub pinch: Pinch,
    /// Room for cloth that starts in a body: bodies start smaller, and grow.
    pub inflate: Option<InflateSpec>,
    /// Time over which the distances that surfaces keep grow to their values, in s, for cloth that
    /// starts nearer; they have their values at once if missing.
    #[schemars(transform = drape_input::positive)]
    #[serde_as(as = "Option<Time>")]
    pub grow: Option<f64>,
}

/// Bodies that start smaller.
#[serde_as]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct InflateSpec {
    /// Depth by which bodies start smaller, along their normals, less than half their thickness.
    #[schemars(transform = drape_input::between(1e-6, 0.1))]
    #[serde_as(as = "Length")]
    pub depth: f64,
    /// Time until they have their size, in s.
    #[schemars(transform = drape_input::positive)]
    #[serde_as(as = "Time")]
    #[serde(default = "growth_seconds")]
    pub seconds: f64,
}

/// Returns the time until bodies have their size where a scene names none, in s.
fn growth_seconds() -> f64 {
    0.5
}

impl Default for ContactSpec {
    fn default() -> Self {
        let particles = ParticleSettings::default();
        Self {
            offset: particles.activation_distance,
            stiffness: None,
            top_speed: None,
            slip_speed: particles.slip_speed,
            surfaces: None,
            stick: SurfaceSettings::STICKING_DISPLACEMENT,
            pinch: Pinch::Error,
            inflate: None,
            grow: None,
        }
    }
}

impl Default for InflateSpec {
    fn default() -> Self {
        Self { depth: 0.01, seconds: growth_seconds() }
    }
}

/// Treatment of cloth that bodies close on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Pinch {
    /// The run ends.
    #[default]
    Error,
    /// The distance that is kept there is reduced to a tenth.
    Thin,
    /// The faster body passes through the cloth.
    Release,
}

impl From<Pinch> for PinchPolicy {
    fn from(pinch: Pinch) -> Self {
        match pinch {
            Pinch::Error => Self::Error,
            Pinch::Thin => Self::Thin,
            Pinch::Release => Self::Release,
        }
    }
}
