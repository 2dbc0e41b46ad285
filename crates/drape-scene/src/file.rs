//! The TOML form of a scene. `SceneFile` mirrors the text; nothing here is checked beyond its type.

mod garment;

use std::collections::BTreeMap;
use std::fmt;

use serde::de::value::MapAccessDeserializer;
use serde::de::{MapAccess, Visitor};
use serde::{Deserialize, Deserializer};

use crate::contact::ContactFile;

pub(crate) use garment::{GarmentFile, GarmentPanelFile, SewFile};

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SceneFile {
    pub(crate) name: Option<String>,
    /// `kes` or `breen-1994`.
    pub(crate) model: Option<String>,
    /// Unit of all lengths of the file: `m`, `cm` or `mm`.
    pub(crate) length: Option<String>,
    /// Distance between particles.
    pub(crate) spacing: Option<f64>,
    /// In m/s².
    pub(crate) gravity: Option<[f64; 3]>,
    pub(crate) air: Option<AirFile>,
    #[serde(default)]
    pub(crate) fabric: BTreeMap<String, FabricFile>,
    #[serde(default)]
    pub(crate) panel: Vec<PanelFile>,
    #[serde(default)]
    pub(crate) garment: Vec<GarmentFile>,
    #[serde(default)]
    pub(crate) sew: SewFile,
    #[serde(default)]
    pub(crate) pin: Vec<PinFile>,
    #[serde(default)]
    pub(crate) collider: ColliderFile,
    #[serde(default)]
    pub(crate) contact: ContactFile,
    pub(crate) time: TimeFile,
    pub(crate) settle: Option<SettleFile>,
    pub(crate) motion: Option<MotionPhaseFile>,
    #[serde(default)]
    pub(crate) solver: SolverFile,
    #[serde(default)]
    pub(crate) output: OutputFile,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct AirFile {
    /// In kg/m³.
    pub(crate) density: Option<f64>,
    pub(crate) drag: Option<f64>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct FabricFile {
    pub(crate) file: String,
}

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
    /// Place of a particle from the middle, weft × warp; a particle is in the middle if missing.
    pub(crate) grid: Option<[f64; 2]>,
    pub(crate) spacing: Option<f64>,
    /// Where the middle of the panel is.
    #[serde(default)]
    pub(crate) center: [f64; 3],
    /// Turns about the x, y and z axes, one after the other, in degrees.
    #[serde(default)]
    pub(crate) turn: [f64; 3],
    /// Velocity of its middle at the start, and spin about the world's axes through it in degrees/s.
    #[serde(default)]
    pub(crate) velocity: [f64; 3],
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
    /// Its ends, places on the panel as for a pin.
    pub(crate) from: [f64; 2],
    pub(crate) to: [f64; 2],
    /// Angle by which the panel is turned towards its right side, in degrees.
    pub(crate) angle: f64,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct StackFile {
    /// How many there are in all; they are called NAME 2, NAME 3 and so on.
    pub(crate) count: usize,
    /// From the middle of each to that of the next.
    pub(crate) step: [f64; 3],
    /// Turn from each to the next, added to the panel's, in degrees.
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

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct PinFile {
    pub(crate) panel: String,
    /// Places on the panel, width × height from its lower left corner (a disc's middle).
    #[serde(default)]
    pub(crate) points: Vec<[f64; 2]>,
    /// How far from the places particles are held; without it, the nearest to each.
    pub(crate) radius: Option<f64>,
    /// `top`, `bottom`, `left` or `right`; of a panel of a garment, one of its edges.
    pub(crate) edge: Option<String>,
    /// Rows that an edge holds: all within so many spacings less a half.
    pub(crate) rows: Option<usize>,
    /// When it lets go, in s; never if missing.
    pub(crate) release: Option<f64>,
    /// `x`, `y` and `z`: the directions in which it holds; all of them if missing.
    pub(crate) axes: Option<Vec<String>>,
    /// `sewn`: it lets go when the garment is sewn; `rest`: when the cloth has come to rest.
    pub(crate) until: Option<String>,
    /// How what it holds moves; it stays where it is if missing.
    pub(crate) motion: Option<MotionFile>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct MotionFile {
    /// In s, rising.
    pub(crate) times: Vec<f64>,
    #[serde(default)]
    pub(crate) shift: Vec<[f64; 3]>,
    /// Degrees about x, then y, then z.
    #[serde(default)]
    pub(crate) turn: Vec<[f64; 3]>,
    /// What it turns about; the middle of what is held if missing.
    pub(crate) center: Option<[f64; 3]>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ColliderFile {
    #[serde(default)]
    pub(crate) sphere: Vec<SphereFile>,
    #[serde(default, rename = "box")]
    pub(crate) boxes: Vec<BoxFile>,
    #[serde(default)]
    pub(crate) cylinder: Vec<CylinderFile>,
    #[serde(default)]
    pub(crate) plane: Vec<PlaneFile>,
    #[serde(default)]
    pub(crate) mesh: Vec<MeshBodyFile>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SphereFile {
    pub(crate) name: Option<String>,
    pub(crate) radius: f64,
    #[serde(default)]
    pub(crate) center: [f64; 3],
    pub(crate) friction: Option<f64>,
    pub(crate) motion: Option<MotionFile>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct BoxFile {
    pub(crate) name: Option<String>,
    /// Lengths of the sides.
    pub(crate) size: [f64; 3],
    #[serde(default)]
    pub(crate) edge_radius: f64,
    #[serde(default)]
    pub(crate) center: [f64; 3],
    #[serde(default)]
    pub(crate) turn: [f64; 3],
    pub(crate) friction: Option<f64>,
    pub(crate) motion: Option<MotionFile>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct CylinderFile {
    pub(crate) name: Option<String>,
    pub(crate) radius: f64,
    pub(crate) height: f64,
    #[serde(default)]
    pub(crate) edge_radius: f64,
    #[serde(default)]
    pub(crate) center: [f64; 3],
    #[serde(default)]
    pub(crate) turn: [f64; 3],
    pub(crate) friction: Option<f64>,
    pub(crate) motion: Option<MotionFile>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct PlaneFile {
    pub(crate) name: Option<String>,
    #[serde(default)]
    pub(crate) center: [f64; 3],
    #[serde(default)]
    pub(crate) turn: [f64; 3],
    pub(crate) friction: Option<f64>,
    pub(crate) motion: Option<MotionFile>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct MeshBodyFile {
    pub(crate) name: Option<String>,
    pub(crate) file: String,
    /// Unit of the file's coordinates, in m.
    pub(crate) scale: Option<f64>,
    #[serde(default)]
    pub(crate) center: [f64; 3],
    #[serde(default)]
    pub(crate) turn: [f64; 3],
    pub(crate) friction: Option<f64>,
    pub(crate) motion: Option<MeshMotionFile>,
    /// Mesh files, with a * for the number of the frame.
    pub(crate) frames: Option<String>,
    /// Frames per second.
    pub(crate) rate: Option<f64>,
    /// When the first frame is left, in s.
    pub(crate) start: Option<f64>,
}

impl MeshBodyFile {
    /// The point cache that it moves by, if it does.
    pub(crate) fn point_cache(&self) -> Option<&str> {
        match &self.motion {
            Some(MeshMotionFile::PointCache(file)) => Some(file),
            _ => None,
        }
    }
}

/// How a mesh moves: along keys, or as a file says.
#[derive(Debug)]
pub(crate) enum MeshMotionFile {
    Keys(MotionFile),
    PointCache(String),
}

impl<'de> Deserialize<'de> for MeshMotionFile {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Either;
        impl<'de> Visitor<'de> for Either {
            type Value = MeshMotionFile;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a table of keys, or the name of a point cache")
            }

            fn visit_str<E>(self, file: &str) -> Result<Self::Value, E> {
                Ok(MeshMotionFile::PointCache(file.to_owned()))
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Self::Value, A::Error> {
                let keys = MotionFile::deserialize(MapAccessDeserializer::new(map));
                keys.map(MeshMotionFile::Keys)
            }
        }
        deserializer.deserialize_any(Either)
    }
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct TimeFile {
    /// In s, like all times.
    pub(crate) step: f64,
    pub(crate) step_min: Option<f64>,
    pub(crate) step_max: Option<f64>,
    /// Error of the positions that a step may make.
    pub(crate) error: Option<f64>,
    pub(crate) end: f64,
    /// How long gravity takes to grow to its value.
    pub(crate) ramp: Option<f64>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SettleFile {
    /// In m/s.
    pub(crate) speed: Option<f64>,
    /// Acceleration that is left, over g.
    pub(crate) residual: Option<f64>,
    /// How far a particle may move in one step.
    pub(crate) stride: Option<f64>,
    pub(crate) inertia: Option<bool>,
}

/// What follows when the cloth has come to rest.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct MotionPhaseFile {
    /// How long bodies and pins then move, from the times 0 of their motions.
    pub(crate) seconds: f64,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SolverFile {
    /// `bdf2`, `backward-euler` or `explicit`.
    pub(crate) integrator: Option<String>,
    /// `broyden`, `newton`, `textbook-mass` or `textbook-diagonal`.
    pub(crate) method: Option<String>,
    /// `conjugate-gradient` or `cholesky`.
    pub(crate) linear: Option<String>,
    pub(crate) tolerance: Option<f64>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct OutputFile {
    pub(crate) folder: Option<String>,
    /// Seconds between frames.
    pub(crate) every: Option<f64>,
    /// Whether the energies are accounted for.
    pub(crate) energy: Option<bool>,
    /// From where the picture is taken, in degrees.
    pub(crate) azimuth: Option<f64>,
    pub(crate) elevation: Option<f64>,
}
