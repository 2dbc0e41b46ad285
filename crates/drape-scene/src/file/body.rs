//! TOML form of bodies.
//!
//! Each kind lists the keys that all kinds have in common again: a part that `serde` flattens into
//! another one costs the refusal of unknown keys, and the lines of mistakes.

use serde::Deserialize;

use crate::file::motion::{MeshMotionFile, MotionFile};

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

/// Keys that all kinds of bodies have in common.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CommonFile<'a> {
    pub(crate) name: Option<&'a str>,
    pub(crate) center: [f64; 3],
    pub(crate) turn: [f64; 3],
    pub(crate) friction: Option<f64>,
    pub(crate) motion: Option<&'a MotionFile>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SphereFile {
    name: Option<String>,
    pub(crate) radius: f64,
    #[serde(default)]
    center: [f64; 3],
    friction: Option<f64>,
    motion: Option<MotionFile>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct BoxFile {
    name: Option<String>,
    /// Lengths of the sides.
    pub(crate) size: [f64; 3],
    #[serde(default)]
    pub(crate) edge_radius: f64,
    #[serde(default)]
    center: [f64; 3],
    #[serde(default)]
    turn: [f64; 3],
    friction: Option<f64>,
    motion: Option<MotionFile>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct CylinderFile {
    name: Option<String>,
    pub(crate) radius: f64,
    pub(crate) height: f64,
    #[serde(default)]
    pub(crate) edge_radius: f64,
    #[serde(default)]
    center: [f64; 3],
    #[serde(default)]
    turn: [f64; 3],
    friction: Option<f64>,
    motion: Option<MotionFile>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct PlaneFile {
    name: Option<String>,
    #[serde(default)]
    center: [f64; 3],
    #[serde(default)]
    turn: [f64; 3],
    friction: Option<f64>,
    motion: Option<MotionFile>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct MeshBodyFile {
    name: Option<String>,
    pub(crate) file: String,
    /// Unit of the file's coordinates, in m.
    pub(crate) scale: Option<f64>,
    #[serde(default)]
    center: [f64; 3],
    #[serde(default)]
    turn: [f64; 3],
    friction: Option<f64>,
    motion: Option<MeshMotionFile>,
    /// Mesh files, with a * for the number of the frame.
    pub(crate) frames: Option<String>,
    /// Frames per second.
    pub(crate) rate: Option<f64>,
    /// Time at which the first frame is left, in s.
    pub(crate) start: Option<f64>,
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
            turn: *turn,
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
            turn: *turn,
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
            turn: *turn,
            friction: *friction,
            motion: motion.as_ref(),
        }
    }
}

impl MeshBodyFile {
    pub(crate) fn common(&self) -> CommonFile<'_> {
        let Self { name, center, turn, friction, motion, .. } = self;
        let motion = match motion {
            Some(MeshMotionFile::Keys(motion)) => Some(motion),
            _ => None,
        };
        CommonFile {
            name: name.as_deref(),
            center: *center,
            turn: *turn,
            friction: *friction,
            motion,
        }
    }

    /// Point cache that it moves by, if it does.
    pub(crate) fn point_cache(&self) -> Option<&str> {
        match &self.motion {
            Some(MeshMotionFile::PointCache(file)) => Some(file),
            _ => None,
        }
    }
}
