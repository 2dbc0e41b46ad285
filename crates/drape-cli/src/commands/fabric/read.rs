//! Fabrics that commands name.

use std::path::Path;

use drape::fabric::Fabric;
use drape::run::file::FileKind;
use drape::scene::Model;

use crate::failure::Failure;
use crate::input;

/// Kinds of files that give a fabric.
const KINDS: [FileKind; 2] = [FileKind::Fabric, FileKind::Sheet];

/// Reads a fabric from its file, or from a sheet or its folder, which it fits.
pub(crate) fn read(path: &Path) -> Result<Fabric, Failure> {
    input::expect(path, &KINDS)?;
    Ok(drape::run::fabric_of(&input::document_of_kind(&input::sheet_file(path), &KINDS)?, Model::Kes)?)
}
