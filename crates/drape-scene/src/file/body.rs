//! TOML form of bodies.
//!
//! Each kind lists the keys that all kinds have in common again: a part that `serde` flattens into
//! another one costs the refusal of unknown keys, and the lines of mistakes.

use drape_input::{Angle, Given, Length, TextOr, Time};
use serde::Deserialize;

use crate::file::motion::MotionFile;

#[derive(Debug, Default, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
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

#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct SphereFile {
    name: Option<String>,
    pub(crate) radius: Given<Length>,
    #[serde(default)]
    center: [Given<Length>; 3],
    friction: Option<f64>,
    motion: Option<MotionFile>,
}

#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct BoxFile {
    name: Option<String>,
    /// Lengths of the sides.
    pub(crate) size: [Given<Length>; 3],
    #[serde(default)]
    pub(crate) edge_radius: Given<Length>,
    #[serde(default)]
    center: [Given<Length>; 3],
    #[serde(default)]
    turn: [Given<Angle>; 3],
    friction: Option<f64>,
    motion: Option<MotionFile>,
}

#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct CylinderFile {
    name: Option<String>,
    pub(crate) radius: Given<Length>,
    pub(crate) height: Given<Length>,
    #[serde(default)]
    pub(crate) edge_radius: Given<Length>,
    #[serde(default)]
    center: [Given<Length>; 3],
    #[serde(default)]
    turn: [Given<Angle>; 3],
    friction: Option<f64>,
    motion: Option<MotionFile>,
}

#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct PlaneFile {
    name: Option<String>,
    #[serde(default)]
    center: [Given<Length>; 3],
    #[serde(default)]
    turn: [Given<Angle>; 3],
    friction: Option<f64>,
    motion: Option<MotionFile>,
}

#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct MeshBodyFile {
    name: Option<String>,
    pub(crate) file: String,
    /// Unit of the file's coordinates, in m.
    pub(crate) scale: Option<Given<Length>>,
    #[serde(default)]
    center: [Given<Length>; 3],
    #[serde(default)]
    turn: [Given<Angle>; 3],
    friction: Option<f64>,
    motion: Option<TextOr<MotionFile>>,
    /// Mesh files, with a * for the number of the frame.
    pub(crate) frames: Option<String>,
    /// Frames per second.
    pub(crate) rate: Option<f64>,
    /// Time at which the first frame is left, in s.
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
