//! Axes: keys of a base, each with the levels that a study gives it.

mod covariance;
mod design;
mod levels;
mod random;
mod range;
mod reader;

use serde_json::Value;

pub(crate) use reader::Reader;

/// Kind of an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AxisKind {
    /// Chosen levels, each of which is used for many points.
    Levels,
    /// Sampled numbers, one for each point of the sample.
    Sample,
    /// Random starts: levels without an order or a meaning.
    Starts,
    /// Dependent numbers, which have a fixed ratio to the numbers of another axis.
    Follower,
}

/// Key of a base with its levels.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Axis {
    /// Name of the column in the table.
    pub name: String,
    /// Key of the base.
    pub key: String,
    /// Levels as TOML values.
    pub levels: Vec<String>,
    /// Kind of the levels.
    pub kind: AxisKind,
}

/// Axes that go in step: their levels with one index belong together.
#[derive(Debug, Clone)]
pub(crate) struct Group {
    /// Name, if the study gives one.
    pub(crate) name: Option<String>,
    pub(crate) axes: Vec<Axis>,
}

impl Group {
    /// Returns the number of levels, which all `axes` of the group share.
    pub(crate) fn level_count(&self) -> usize {
        self.axes.first().map_or(0, |axis| axis.levels.len())
    }
}

/// Returns `level`, a TOML value, as a JSON value.
pub(crate) fn level_value(level: &str) -> Value {
    let table = toml::from_str::<toml::Table>(&format!("value = {level}"));
    let value = table.ok().and_then(|mut table| table.remove("value"));
    value.and_then(|value| serde_json::to_value(value).ok()).unwrap_or_else(|| level.into())
}
