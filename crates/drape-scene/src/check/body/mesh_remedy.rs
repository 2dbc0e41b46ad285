//! Remedies for the meshes of bodies, and the names of the files of repaired meshes.

use std::path::{Path, PathBuf};

use drape_input::Remedy;

/// End of the name of a file that a repair has written, without the ending of the file.
const REPAIRED: &str = "-repaired";

/// Returns the remedy for a mesh that cannot be read because of `error`, if the remedy is known.
#[must_use]
pub fn mesh_remedy(error: &drape_collide::Error) -> Option<Remedy> {
    match error {
        drape_collide::Error::FileTooLong { times, .. } => {
            Some(Remedy::RaiseLimits { factor: *times })
        }
        _ => None,
    }
}

/// Returns the file that a remedy proposes for the repaired mesh of the file `mesh`.
#[must_use]
pub fn repaired_file(mesh: &Path) -> PathBuf {
    let stem = mesh.file_stem().unwrap_or_default().to_string_lossy();
    mesh.with_file_name(format!("{stem}{REPAIRED}.obj"))
}

/// Returns whether the file `mesh` has the name of a mesh that was repaired.
#[must_use]
pub fn is_repaired(mesh: &Path) -> bool {
    mesh.file_stem().is_some_and(|stem| stem.to_string_lossy().ends_with(REPAIRED))
}
