//! Fabrics and laws as data of serde, for JSON and other formats that describe themselves: the keys
//! of the TOML file, with the same checks.

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::check::Problem;
use crate::fabric::Fabric;
use crate::file::FabricFile;
use crate::file::bending::BendingFile;
use crate::file::report::Report;
use crate::file::shear::ShearFile;
use crate::file::traction::TractionFile;
use crate::laws::bending::BendingLaw;
use crate::laws::shear::ShearLaw;
use crate::laws::traction::TractionLaw;

/// Returns what `read` returns, if neither `read` nor `problems` has a mistake.
fn checked<T, E: Error>(
    read: impl FnOnce(&mut Report<'_>) -> T,
    problems: impl FnOnce(&T) -> Vec<Problem>,
) -> Result<T, E> {
    let mut mistakes = Vec::new();
    let value = read(&mut |key, message, help| mistakes.push(format!("{key}: {message}; {help}")));
    // Numbers of a law that is missing are stand-ins.
    if mistakes.is_empty() {
        let problems = problems(&value).into_iter();
        mistakes.extend(
            problems.map(|Problem { key, message, help, .. }| format!("{key}: {message}; {help}")),
        );
    }
    if mistakes.is_empty() { Ok(value) } else { Err(E::custom(mistakes.join("\n"))) }
}

impl Serialize for Fabric {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        FabricFile::from(self).serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Fabric {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let file = FabricFile::deserialize(deserializer)?;
        checked(|report| file.fabric(report), Self::problems)
    }
}

impl Serialize for TractionLaw {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        TractionFile::from(self).serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for TractionLaw {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let file = TractionFile::deserialize(deserializer)?;
        checked(|report| file.law("traction", report), Self::problems)
    }
}

impl Serialize for BendingLaw {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        BendingFile::from(self).serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for BendingLaw {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let file = BendingFile::deserialize(deserializer)?;
        checked(|report| file.law("bending", report), Self::problems)
    }
}

impl Serialize for ShearLaw {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        ShearFile::from(self).serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for ShearLaw {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let file = ShearFile::deserialize(deserializer)?;
        checked(|report| file.law(report), Self::problems)
    }
}
