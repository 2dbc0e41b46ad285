//! TOML form of motions.

use std::fmt;

use serde::de::value::MapAccessDeserializer;
use serde::de::{MapAccess, Visitor};
use serde::{Deserialize, Deserializer};

/// Rigid motion along keys.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct MotionFile {
    /// Times, in s, rising.
    pub(crate) times: Vec<f64>,
    /// Displacements.
    #[serde(default)]
    pub(crate) shift: Vec<[f64; 3]>,
    /// Rotations, in degrees about x, then y, then z.
    #[serde(default)]
    pub(crate) turn: Vec<[f64; 3]>,
    /// Centre of rotation; the middle of what is moved if missing.
    pub(crate) center: Option<[f64; 3]>,
}

/// Motion of a mesh: along keys, or by a file.
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
