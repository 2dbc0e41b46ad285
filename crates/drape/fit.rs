use std::path::Path;

use drape::input::{Diagnostic, Diagnostics};

/// A sheet's mistakes with their places.
pub(crate) fn input(file: &Path, error: drape::kes::Error) -> Diagnostics {
    match error {
        drape::kes::Error::Input(diagnostics) => diagnostics,
        other => Diagnostic::new(file, other.to_string()).into(),
    }
}
