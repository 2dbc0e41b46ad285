use std::path::{Path, PathBuf};

use drape_fabric::Fabric;
use drape_fit::{LoopModel, Settings};
use drape_input::{Diagnostic, Diagnostics, Document};
use drape_kes::Sheet;

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
    /// The identification, if the file was a sheet of measurements.
    pub fit: Option<drape_fit::Fit>,
}

impl Material {
    /// A fabric that is in memory.
    pub(crate) fn from_document(name: &str, document: &Document) -> Result<Self, Diagnostics> {
        let fabric = Fabric::from_document(document)?;
        Ok(Self { name: name.to_owned(), file: document.path().to_owned(), fabric, fit: None })
    }

    /// Reads a `fabric.toml`, or a `sheet.toml` (or its folder), which is fitted on the way with the loads that a model has:
    /// Breen's are fitted to the first branches of the curves.
    pub(crate) fn read((name, path): (&str, &Path), model: Model) -> Result<Self, Diagnostics> {
        let file = if path.is_dir() { path.join("sheet.toml") } else { path.to_owned() };
        let document = Document::read(&file)?;
        let (fabric, fit) = if is_fabric(&document) {
            (Fabric::from_document(&document)?, None)
        } else {
            let sheet = Sheet::read(&file).map_err(|error| located(&file, error))?;
            let loads = (model == Model::Breen1994).then_some(LoopModel::Piecewise);
            let settings = Settings { bending: loads, shear: loads, ..Settings::default() };
            let fit = drape_fit::identify_with(&sheet, &settings)
                .map_err(|error| Diagnostics::from(Diagnostic::new(&file, error.to_string())))?;
            (fit.fabric.clone(), Some(fit))
        };
        Ok(Self { name: name.to_owned(), file, fabric, fit })
    }
}

/// A fabric has laws along the warp; a sheet has values there.
fn is_fabric(document: &Document) -> bool {
    let table: Result<toml::Table, _> = document.decode();
    table.is_ok_and(|t| t.contains_key("density") || t.contains_key("shear"))
}

fn located(file: &Path, error: drape_kes::Error) -> Diagnostics {
    match error {
        drape_kes::Error::Input(diagnostics) => diagnostics,
        other => Diagnostic::new(file, other.to_string()).into(),
    }
}
