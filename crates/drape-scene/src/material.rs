use std::path::{Path, PathBuf};

use drape_fabric::Fabric;
use drape_input::{Diagnostic, Diagnostics, Document};

use crate::model::Model;

/// A fabric of a scene and where it comes from.
#[derive(Debug, Clone)]
pub struct Material {
    /// Name in the scene.
    pub name: String,
    /// The file that was read.
    pub file: PathBuf,
    /// What the simulation uses.
    pub fabric: Fabric,
}

/// A fabric that a scene asks for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FabricRequest<'a> {
    /// The file that the scene names; `sheet.toml` in it where it names a folder.
    pub file: &'a Path,
    /// The model whose laws it is to have.
    pub model: Model,
}

/// Reads the fabric of a `fabric.toml`.
///
/// # Errors
/// The mistakes of the file; for one without laws, such as a sheet of measurements, how to make a fabric of it.
pub fn read_fabric(request: FabricRequest<'_>) -> Result<Fabric, Diagnostics> {
    let document = Document::read(request.file)?;
    if is_fabric(&document) {
        return Fabric::from_document(&document);
    }
    let help = "a sheet of measurements becomes a fabric by a fit: `drape fit SHEET -o fabric.toml`; then name fabric.toml";
    let message = "there are no laws of a fabric (density, shear)";
    Err(Diagnostic::new(request.file, message).help(help).into())
}

/// Whether a document is a fabric: that has laws along the warp, a sheet has values there.
#[must_use]
pub fn is_fabric(document: &Document) -> bool {
    let table: Result<toml::Table, _> = document.decode();
    table.is_ok_and(|t| t.contains_key("density") || t.contains_key("shear"))
}

impl Material {
    /// A fabric that is in memory.
    pub(crate) fn from_document(name: &str, document: &Document) -> Result<Self, Diagnostics> {
        let fabric = Fabric::from_document(document)?;
        Ok(Self { name: name.to_owned(), file: document.path().to_owned(), fabric })
    }
}
