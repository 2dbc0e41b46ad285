//! Bodies.
//!
//! Each kind lists the keys that all kinds have in common again: a part that `serde` flattens into
//! another one costs the refusal of unknown keys, and the lines of mistakes.

use std::borrow::Cow;
use std::sync::Arc;

use drape_collide::Triangulation;
use drape_input::{Angle, Length, Metres, TextOr, Time};
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::{Deserialize, Deserializer, Serialize, Serializer, ser::Error};
use serde_with::serde_as;

use crate::spec::file_or::FileOr;
use crate::spec::motion::MotionSpec;

/// Bodies, by their shapes.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ColliderSpec {
    /// Spheres.
    pub sphere: Vec<SphereSpec>,
    /// Boxes.
    #[serde(rename = "box")]
    pub boxes: Vec<BoxSpec>,
    /// Cylinders, upright until they are turned.
    pub cylinder: Vec<CylinderSpec>,
    /// Planes, level until they are turned.
    pub plane: Vec<PlaneSpec>,
    /// Meshes of files.
    pub mesh: Vec<MeshSpec>,
}

/// Sphere.
#[serde_as]
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SphereSpec {
    /// Name, for messages and measures; its kind and number if missing.
    pub name: Option<String>,
    /// Radius.
    #[schemars(transform = drape_input::between(1e-4, 1e4))]
    #[serde_as(as = "Length")]
    pub radius: f64,
    /// Place of its middle.
    #[serde(default)]
    #[serde_as(as = "[Length; 3]")]
    pub center: [f64; 3],
    /// Coefficient of its friction with cloth; the coefficient of the fabric if missing.
    #[schemars(transform = drape_input::within(0.0, 10.0))]
    pub friction: Option<f64>,
    /// Rigid motion along keys, about its own middle; at rest if missing.
    pub motion: Option<MotionSpec>,
}

/// Box.
#[serde_as]
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BoxSpec {
    /// Name, for messages and measures; its kind and number if missing.
    pub name: Option<String>,
    /// Lengths of the sides.
    #[schemars(transform = drape_input::between(1e-4, 1e4))]
    #[serde_as(as = "[Length; 3]")]
    pub size: [f64; 3],
    /// Radius of its rounded edges; 0 is sharp.
    #[schemars(transform = drape_input::at_least(0.0))]
    #[serde(default)]
    #[serde_as(as = "Length")]
    pub edge_radius: f64,
    /// Place of its middle.
    #[serde(default)]
    #[serde_as(as = "[Length; 3]")]
    pub center: [f64; 3],
    /// Rotations about x, y and z, one after the other, in degrees.
    #[serde(default)]
    #[serde_as(as = "[Angle; 3]")]
    pub turn: [f64; 3],
    /// Coefficient of its friction with cloth; the coefficient of the fabric if missing.
    #[schemars(transform = drape_input::within(0.0, 10.0))]
    pub friction: Option<f64>,
    /// Rigid motion along keys, about its own middle; at rest if missing.
    pub motion: Option<MotionSpec>,
}

/// Cylinder.
#[serde_as]
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CylinderSpec {
    /// Name, for messages and measures; its kind and number if missing.
    pub name: Option<String>,
    /// Radius.
    #[schemars(transform = drape_input::between(1e-4, 1e4))]
    #[serde_as(as = "Length")]
    pub radius: f64,
    /// Height.
    #[schemars(transform = drape_input::between(1e-4, 1e4))]
    #[serde_as(as = "Length")]
    pub height: f64,
    /// Radius of its rounded edges; 0 is sharp.
    #[schemars(transform = drape_input::at_least(0.0))]
    #[serde(default)]
    #[serde_as(as = "Length")]
    pub edge_radius: f64,
    /// Place of its middle.
    #[serde(default)]
    #[serde_as(as = "[Length; 3]")]
    pub center: [f64; 3],
    /// Rotations about x, y and z, one after the other, in degrees.
    #[serde(default)]
    #[serde_as(as = "[Angle; 3]")]
    pub turn: [f64; 3],
    /// Coefficient of its friction with cloth; the coefficient of the fabric if missing.
    #[schemars(transform = drape_input::within(0.0, 10.0))]
    pub friction: Option<f64>,
    /// Rigid motion along keys, about its own middle; at rest if missing.
    pub motion: Option<MotionSpec>,
}

/// Plane.
#[serde_as]
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PlaneSpec {
    /// Name, for messages and measures; its kind and number if missing.
    pub name: Option<String>,
    /// Point of the plane.
    #[serde(default)]
    #[serde_as(as = "[Length; 3]")]
    pub center: [f64; 3],
    /// Rotations about x, y and z, one after the other, in degrees.
    #[serde(default)]
    #[serde_as(as = "[Angle; 3]")]
    pub turn: [f64; 3],
    /// Coefficient of its friction with cloth; the coefficient of the fabric if missing.
    #[schemars(transform = drape_input::within(0.0, 10.0))]
    pub friction: Option<f64>,
    /// Rigid motion along keys, about its own middle; at rest if missing.
    pub motion: Option<MotionSpec>,
}

/// Body whose surface is in a file.
#[serde_as]
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MeshSpec {
    /// Name, for messages and measures; its kind and number if missing.
    pub name: Option<String>,
    /// Closed surface of 2 mm to 100 m, OBJ, STL or PLY, relative to the folder of the scene.
    pub file: FileOr<Triangulation>,
    /// Length of a unit of the file, in m; the unit of the scene if missing.
    #[schemars(transform = drape_input::between(1e-6, 1e3))]
    #[serde_as(as = "Option<Metres>")]
    pub scale: Option<f64>,
    /// Shift of its vertices.
    #[serde(default)]
    #[serde_as(as = "[Length; 3]")]
    pub center: [f64; 3],
    /// Rotations about x, y and z, one after the other, in degrees.
    #[serde(default)]
    #[serde_as(as = "[Angle; 3]")]
    pub turn: [f64; 3],
    /// Coefficient of its friction with cloth; the coefficient of the fabric if missing.
    #[schemars(transform = drape_input::within(0.0, 10.0))]
    pub friction: Option<f64>,
    /// Rigid motion along keys, or a point cache such as `"walk.pc2"` with the position of every
    /// vertex in every frame, which needs `contact.surfaces`; at rest if missing.
    pub motion: Option<MeshMotion>,
    /// Mesh files with the same vertices and triangles, such as `"walk_*.obj"`, with a * for the
    /// number of the frame, in place of a motion; none if missing.
    pub frames: Option<String>,
    /// Frames per second of a point cache or of mesh files, which need it; none if missing.
    #[schemars(transform = drape_input::within(1e-3, 1e5))]
    pub rate: Option<f64>,
    /// Time at which the first frame is left, in s.
    #[schemars(transform = drape_input::within(0.0, 1e6))]
    #[serde_as(as = "Time")]
    #[serde(default)]
    pub start: f64,
}

/// Motion of a mesh.
#[derive(Debug, Clone, PartialEq)]
pub enum MeshMotion {
    /// Rigid motion along keys.
    Keys(MotionSpec),
    /// Name of a point cache, such as `walk.pc2`, relative to the folder of the scene.
    File(String),
    /// Positions of every vertex of the mesh in every frame, in the unit of the mesh.
    Frames(Arc<Vec<Vec<[f64; 3]>>>),
}

impl Serialize for MeshMotion {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Keys(keys) => keys.serialize(serializer),
            Self::File(name) => serializer.serialize_str(name),
            Self::Frames(_) => Err(S::Error::custom("it is in memory and has no file")),
        }
    }
}

impl<'de> Deserialize<'de> for MeshMotion {
    fn deserialize<S: Deserializer<'de>>(deserializer: S) -> Result<Self, S::Error> {
        Ok(match TextOr::deserialize(deserializer)? {
            TextOr::Text(name) => Self::File(name),
            TextOr::Other(keys) => Self::Keys(keys),
        })
    }
}

impl JsonSchema for MeshMotion {
    fn schema_name() -> Cow<'static, str> {
        TextOr::<MotionSpec>::schema_name()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        TextOr::<MotionSpec>::json_schema(generator)
    }
}

/// Keys that all kinds of bodies have in common.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CommonKeys<'a> {
    pub(crate) name: Option<&'a str>,
    /// Place, in m.
    pub(crate) center: [f64; 3],
    /// Rotations about x, y and z, in degrees.
    pub(crate) turn: [f64; 3],
    pub(crate) friction: Option<f64>,
    pub(crate) motion: Option<&'a MotionSpec>,
}

impl SphereSpec {
    pub(crate) fn common(&self) -> CommonKeys<'_> {
        let Self { name, center, friction, motion, .. } = self;
        let name = name.as_deref();
        CommonKeys {
            name,
            center: *center,
            turn: [0.0; 3],
            friction: *friction,
            motion: motion.as_ref(),
        }
    }
}

/// Implements the function that returns the common keys of a body that can be turned.
macro_rules! common_keys {
    ($($spec:ident),*) => {
        $(
            impl $spec {
                pub(crate) fn common(&self) -> CommonKeys<'_> {
                    let Self { name, center, turn, friction, motion, .. } = self;
                    CommonKeys {
                        name: name.as_deref(),
                        center: *center,
                        turn: *turn,
                        friction: *friction,
                        motion: motion.as_ref(),
                    }
                }
            }
        )*
    };
}

common_keys!(BoxSpec, CylinderSpec, PlaneSpec);

impl MeshSpec {
    pub(crate) fn common(&self) -> CommonKeys<'_> {
        let Self { name, center, turn, friction, motion, .. } = self;
        let motion = match motion {
            Some(MeshMotion::Keys(motion)) => Some(motion),
            _ => None,
        };
        CommonKeys {
            name: name.as_deref(),
            center: *center,
            turn: *turn,
            friction: *friction,
            motion,
        }
    }

    /// Returns whether the mesh changes its shape.
    pub(crate) fn changes_shape(&self) -> bool {
        let is_sampled = matches!(self.motion, Some(MeshMotion::File(_) | MeshMotion::Frames(_)));
        is_sampled || self.frames.is_some()
    }
}
