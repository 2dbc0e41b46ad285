//! Fabrics that commands name.

use std::path::Path;

use drape::fabric::Fabric;
use drape::run::file::FileKind;
use drape::scene::Model;

use crate::failure::Failure;
use crate::input;

/// Kinds of files that hold a fabric.
const KINDS: [FileKind; 2] = [FileKind::Fabric, FileKind::Sheet];

/// Reads the fabric at `path`. A sheet, or the sheet in a folder, is fitted.
pub(crate) fn read(path: &Path) -> Result<Fabric, Failure> {
    input::expect(path, &KINDS)?;
    Ok(drape::run::fabric_of(
        &input::document_of_kind(&input::sheet_file(path), &KINDS)?,
        Model::Kes,
    )?)
}
