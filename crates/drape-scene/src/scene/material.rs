//! Fabrics of a scene, and how they are asked for.

use std::path::{Path, PathBuf};

use drape_fabric::Fabric;
use drape_input::{Diagnostic, Diagnostics, Document, FileAccess, Remedy};

use crate::scene::model::Model;

/// Fabric of a scene and its file.
#[derive(Debug, Clone)]
pub struct Material {
    /// Name in the scene.
    pub name: String,
    /// File that was read.
    pub file: PathBuf,
    /// Fabric.
    pub fabric: Fabric,
    /// Colour in sRGB that the scene states for pictures of the fabric.
    pub colour: Option<[u8; 3]>,
}

/// Request of a scene for a fabric.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FabricRequest<'a> {
    /// File that the scene names; `sheet.toml` in it where it names a folder.
    pub file: &'a Path,
    /// Model whose laws the fabric is to have.
    pub model: Model,
    /// Access to the file, and to the files that it names.
    pub access: &'a FileAccess,
}

/// Function that answers a scene's requests for fabrics.
pub type FabricReader<'a> = &'a dyn Fn(FabricRequest<'_>) -> Result<Fabric, Diagnostics>;

/// Reads the fabric of a `fabric.toml`.
///
/// # Errors
/// The mistakes of the file; for one without laws, such as a sheet of measurements, advice how to
/// make a fabric of it.
pub fn read_fabric(request: FabricRequest<'_>) -> Result<Fabric, Diagnostics> {
    let document = Document::read_with(request.file, request.access)?;
    if is_fabric(&document) {
        return Fabric::from_document(&document);
    }
    let message = "the file has no laws of a fabric (density, shear)";
    let remedy = Remedy::FitSheet { sheet: request.file.to_owned() };
    Err(Diagnostic::new(request.file, message).help(remedy).into())
}

/// Returns whether a document is a fabric: it has laws where a sheet has values.
#[must_use]
pub fn is_fabric(document: &Document) -> bool {
    let table: Result<toml::Table, _> = document.decode();
    table.is_ok_and(|t| t.contains_key("density") || t.contains_key("shear"))
}
