//! Fabrics and laws as data of serde, for JSON and other formats that describe themselves. Keys and
//! checks are the same as in the TOML file.

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

/// Returns the value of `read`.
///
/// # Errors
/// All mistakes that `read` reports. If it reports none, all that `problems` finds in the value.
fn checked<T, E: Error>(
    read: impl FnOnce(&mut Report<'_>) -> T,
    problems: impl FnOnce(&T) -> Vec<Problem>,
) -> Result<T, E> {
    let mut mistakes = Vec::new();
    let text = |key: &str, message: &str, help: &str| format!("{key}: {message}; {help}");
    let value = read(&mut |key, message, help| mistakes.push(text(key, message, help)));
    // Where a law is missing, its numbers only stand in for it, and are not checked.
    if mistakes.is_empty() {
        let problems = problems(&value).into_iter();
        mistakes.extend(problems.map(|p| text(&p.key, &p.message, &p.help)));
    }
    if mistakes.is_empty() { Ok(value) } else { Err(E::custom(mistakes.join("\n"))) }
}

/// Implements `Serialize` and `Deserialize` for a type by its form in the file. `$read` makes the
/// type of its form, and reports mistakes in keys.
macro_rules! stored {
    ($type:ty, $file:ty, $read:expr) => {
        impl Serialize for $type {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                <$file>::from(self).serialize(serializer)
            }
        }

        impl<'de> Deserialize<'de> for $type {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                let file = <$file>::deserialize(deserializer)?;
                checked(|report| $read(file, report), Self::problems)
            }
        }
    };
}

stored!(Fabric, FabricFile, |file: FabricFile, report: &mut Report<'_>| file.fabric(report));
stored!(TractionLaw, TractionFile, |file: TractionFile, report: &mut Report<'_>| {
    file.law("traction", report)
});
stored!(BendingLaw, BendingFile, |file: BendingFile, report: &mut Report<'_>| {
    file.law("bending", report)
});
stored!(ShearLaw, ShearFile, |file: ShearFile, report: &mut Report<'_>| file.law(report));
