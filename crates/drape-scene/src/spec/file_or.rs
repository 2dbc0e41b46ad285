//! What a scene names by a file, or holds itself.

use std::borrow::Cow;
use std::sync::Arc;

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::{Deserialize, Deserializer, Serialize, Serializer, ser::Error};

/// Name of a file with a `T`, or the `T` itself, which several specs may share.
///
/// In a text only the name of a file can be written. [`SceneSpec::save`] writes what is held into
/// files beside the text.
///
/// [`SceneSpec::save`]: crate::SceneSpec::save
#[derive(Debug, PartialEq)]
pub enum FileOr<T> {
    /// Name of the file, relative to the folder of the scene.
    File(String),
    /// The thing itself.
    Value(Arc<T>),
}

impl<T> FileOr<T> {
    /// Returns the name of the file, or `None` if the thing itself is held.
    #[must_use]
    pub fn file(&self) -> Option<&str> {
        match self {
            Self::File(name) => Some(name),
            Self::Value(_) => None,
        }
    }

    /// Returns the name of the file, to be changed, or `None` if the thing itself is held.
    pub(crate) fn file_mut(&mut self) -> Option<&mut String> {
        match self {
            Self::File(name) => Some(name),
            Self::Value(_) => None,
        }
    }

    /// Returns the thing, or `None` if only a file with it is named.
    #[must_use]
    pub fn value(&self) -> Option<&Arc<T>> {
        match self {
            Self::File(_) => None,
            Self::Value(value) => Some(value),
        }
    }
}

impl<T> Default for FileOr<T> {
    fn default() -> Self {
        Self::File(String::new())
    }
}

impl<T> Clone for FileOr<T> {
    fn clone(&self) -> Self {
        match self {
            Self::File(name) => Self::File(name.clone()),
            Self::Value(value) => Self::Value(Arc::clone(value)),
        }
    }
}

impl<T> From<&str> for FileOr<T> {
    fn from(name: &str) -> Self {
        Self::File(name.to_owned())
    }
}

impl<T> From<String> for FileOr<T> {
    fn from(name: String) -> Self {
        Self::File(name)
    }
}

impl<T> From<Arc<T>> for FileOr<T> {
    fn from(value: Arc<T>) -> Self {
        Self::Value(value)
    }
}

impl<T> Serialize for FileOr<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::File(name) => serializer.serialize_str(name),
            Self::Value(_) => Err(S::Error::custom("it is in memory and has no file")),
        }
    }
}

impl<'de, T> Deserialize<'de> for FileOr<T> {
    fn deserialize<S: Deserializer<'de>>(deserializer: S) -> Result<Self, S::Error> {
        String::deserialize(deserializer).map(Self::File)
    }
}

impl<T> JsonSchema for FileOr<T> {
    fn schema_name() -> Cow<'static, str> {
        String::schema_name()
    }

    fn inline_schema() -> bool {
        true
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        String::json_schema(generator)
    }
}
