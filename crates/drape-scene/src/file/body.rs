//! TOML form of bodies.
//!
//! Each kind lists the keys that all kinds have in common again: a part that `serde` flattens into
//! another one costs the refusal of unknown keys, and the lines of mistakes.

use drape_input::{Angle, Given, Length, TextOr, Time};
use serde::Deserialize;

use crate::file::motion::MotionFile;

/// Bodies, by their shapes.
#[derive(Debug, Default, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct ColliderFile {
    /// Spheres.
    #[serde(default)]
    pub(crate) sphere: Vec<SphereFile>,
    /// Boxes.
    #[serde(default, rename = "box")]
    pub(crate) boxes: Vec<BoxFile>,
    /// Cylinders, upright until they are turned.
    #[serde(default)]
    pub(crate) cylinder: Vec<CylinderFile>,
    /// Planes, level until they are turned.
    #[serde(default)]
    pub(crate) plane: Vec<PlaneFile>,
    /// Meshes of files.
    #[serde(default)]
    pub(crate) mesh: Vec<MeshBodyFile>,
}

/// Keys that all kinds of bodies have in common.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CommonFile<'a> {
    pub(crate) name: Option<&'a str>,
    pub(crate) center: [Given<Length>; 3],
    /// Rotations about x, y and z, in degrees.
    pub(crate) turn: [f64; 3],
    pub(crate) friction: Option<f64>,
    pub(crate) motion: Option<&'a MotionFile>,
}

/// Sphere.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct SphereFile {
    /// Name, for messages and measures; its kind and number if missing.
    name: Option<String>,
    /// Radius.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    pub(crate) radius: Given<Length>,
    /// Place of its middle.
    #[serde(default)]
    center: [Given<Length>; 3],
    /// Coefficient of its friction with cloth; the coefficient of the fabric if missing.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(0.0, 10.0)))]
    friction: Option<f64>,
    /// Rigid motion along keys, about its own middle; at rest if missing.
    motion: Option<MotionFile>,
}

/// Box.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct BoxFile {
    /// Name, for messages and measures; its kind and number if missing.
    name: Option<String>,
    /// Lengths of the sides.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    pub(crate) size: [Given<Length>; 3],
    /// Radius of its rounded edges; 0 is sharp.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::at_least(0.0)))]
    #[serde(default)]
    pub(crate) edge_radius: Given<Length>,
    /// Place of its middle.
    #[serde(default)]
    center: [Given<Length>; 3],
    /// Rotations about x, y and z, one after the other, in degrees.
    #[serde(default)]
    turn: [Given<Angle>; 3],
    /// Coefficient of its friction with cloth; the coefficient of the fabric if missing.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(0.0, 10.0)))]
    friction: Option<f64>,
    /// Rigid motion along keys, about its own middle; at rest if missing.
    motion: Option<MotionFile>,
}

/// Cylinder.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct CylinderFile {
    /// Name, for messages and measures; its kind and number if missing.
    name: Option<String>,
    /// Radius.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    pub(crate) radius: Given<Length>,
    /// Height.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    pub(crate) height: Given<Length>,
    /// Radius of its rounded edges; 0 is sharp.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::at_least(0.0)))]
    #[serde(default)]
    pub(crate) edge_radius: Given<Length>,
    /// Place of its middle.
    #[serde(default)]
    center: [Given<Length>; 3],
    /// Rotations about x, y and z, one after the other, in degrees.
    #[serde(default)]
    turn: [Given<Angle>; 3],
    /// Coefficient of its friction with cloth; the coefficient of the fabric if missing.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(0.0, 10.0)))]
    friction: Option<f64>,
    /// Rigid motion along keys, about its own middle; at rest if missing.
    motion: Option<MotionFile>,
}

/// Plane.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct PlaneFile {
    /// Name, for messages and measures; its kind and number if missing.
    name: Option<String>,
    /// Point of the plane.
    #[serde(default)]
    center: [Given<Length>; 3],
    /// Rotations about x, y and z, one after the other, in degrees.
    #[serde(default)]
    turn: [Given<Angle>; 3],
    /// Coefficient of its friction with cloth; the coefficient of the fabric if missing.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(0.0, 10.0)))]
    friction: Option<f64>,
    /// Rigid motion along keys, about its own middle; at rest if missing.
    motion: Option<MotionFile>,
}

/// Body whose surface is in a file.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct MeshBodyFile {
    /// Name, for messages and measures; its kind and number if missing.
    name: Option<String>,
    /// Closed surface of 2 mm to 100 m, OBJ, STL or PLY, relative to the folder of the scene.
    pub(crate) file: String,
    /// Length of a unit of the file, in m; the unit of the scene if missing.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(1e-6, 1e3)))]
    pub(crate) scale: Option<Given<Length>>,
    /// Shift of its vertices.
    #[serde(default)]
    center: [Given<Length>; 3],
    /// Rotations about x, y and z, one after the other, in degrees.
    #[serde(default)]
    turn: [Given<Angle>; 3],
    /// Coefficient of its friction with cloth; the coefficient of the fabric if missing.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(0.0, 10.0)))]
    friction: Option<f64>,
    /// Rigid motion along keys, or a point cache such as `"walk.pc2"` with the position of every
    /// vertex in every frame, which needs `contact.surfaces`; at rest if missing.
    motion: Option<TextOr<MotionFile>>,
    /// Mesh files with the same vertices and triangles, such as `"walk_*.obj"`, with a * for the
    /// number of the frame, in place of a motion; none if missing.
    pub(crate) frames: Option<String>,
    /// Frames per second of a point cache or of mesh files, which need it; none if missing.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(1e-3, 1e5)))]
    pub(crate) rate: Option<f64>,
    /// Time at which the first frame is left, in s.
    #[cfg_attr(feature = "schema", schemars(extend("default" = 0.0)))]
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(0.0, 1e6)))]
    pub(crate) start: Option<Given<Time>>,
}

impl SphereFile {
    pub(crate) fn common(&self) -> CommonFile<'_> {
        let Self { name, center, friction, motion, .. } = self;
        CommonFile {
            name: name.as_deref(),
            center: *center,
            turn: [0.0; 3],
            friction: *friction,
            motion: motion.as_ref(),
        }
    }
}

impl BoxFile {
    pub(crate) fn common(&self) -> CommonFile<'_> {
        let Self { name, center, turn, friction, motion, .. } = self;
        CommonFile {
            name: name.as_deref(),
            center: *center,
            turn: turn.map(Given::value),
            friction: *friction,
            motion: motion.as_ref(),
        }
    }
}

impl CylinderFile {
    pub(crate) fn common(&self) -> CommonFile<'_> {
        let Self { name, center, turn, friction, motion, .. } = self;
        CommonFile {
            name: name.as_deref(),
            center: *center,
            turn: turn.map(Given::value),
            friction: *friction,
            motion: motion.as_ref(),
        }
    }
}

impl PlaneFile {
    pub(crate) fn common(&self) -> CommonFile<'_> {
        let Self { name, center, turn, friction, motion } = self;
        CommonFile {
            name: name.as_deref(),
            center: *center,
            turn: turn.map(Given::value),
            friction: *friction,
            motion: motion.as_ref(),
        }
    }
}

impl MeshBodyFile {
    pub(crate) fn common(&self) -> CommonFile<'_> {
        let Self { name, center, turn, friction, motion, .. } = self;
        let motion = match motion {
            Some(TextOr::Other(motion)) => Some(motion),
            _ => None,
        };
        CommonFile {
            name: name.as_deref(),
            center: *center,
            turn: turn.map(Given::value),
            friction: *friction,
            motion,
        }
    }

    /// Point cache that it moves by, if it does.
    pub(crate) fn point_cache(&self) -> Option<&str> {
        match &self.motion {
            Some(TextOr::Text(file)) => Some(file),
            _ => None,
        }
    }
}
