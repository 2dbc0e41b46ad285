use std::path::{Path, PathBuf};

use drape_fabric::Fabric;
use drape_input::{Diagnostic, Diagnostics, Document};

/// A fabric of a scene and where it comes from.
#[derive(Debug, Clone)]
pub struct Material {
    /// Name in the scene.
    pub name: String,
    /// The file that was read.
    pub file: PathBuf,
    /// What the simulation uses.
    pub fabric: Fabric,
    /// The identification, if the file was a sheet of measurements.
    pub fit: Option<()>,
}

impl Material {
    /// Reads a `fabric.toml`, or a `sheet.toml` (or its folder), which is fitted on the way.
    pub(crate) fn read(name: &str, path: &Path) -> Result<Self, Diagnostics> {
        let file = if path.is_dir() {
            path.join("sheet.toml")
        } else {
            path.to_owned()
        };
        let document = Document::read(&file)?;
        let (fabric, fit) = if is_fabric(&document) {
            (Fabric::from_document(&document)?, None)
        } else {
            return Err(Diagnostic::new(&file, "sheets come later").into());
        };
        Ok(Self {
            name: name.to_owned(),
            file,
            fabric,
            fit,
        })
    }
}

/// A fabric has laws along the warp; a sheet has values there.
fn is_fabric(document: &Document) -> bool {
    let table: Result<toml::Table, _> = document.decode();
    table.is_ok_and(|t| t.contains_key("density") || t.contains_key("shear"))
}
