//! Fabrics of a scene, from files of fabrics or fitted to sheets: here the fit and the simulation
//! meet, which do not know each other.

mod mistake;

use std::path::Path;

use drape_fabric::Fabric;
use drape_fit::{FitSettings, LoopModel, identify_with};
use drape_input::{Diagnostic, Diagnostics, Document};
use drape_kes::Sheet;
use drape_scene::{FabricRequest, Model, Refused, Scene, is_fabric};

use crate::file::FileKind;

pub use mistake::{NamedCurve, fit_mistake};

/// Kinds of files that give a fabric.
const FABRICS: [FileKind; 2] = [FileKind::Fabric, FileKind::Sheet];

/// Reads a scene whose fabrics are files of fabrics, or sheets of measurements, which are fitted.
///
/// # Errors
/// As for [`Scene::read`], with the mistakes of the sheets.
pub fn read_scene(path: impl AsRef<Path>) -> Result<Scene, drape_scene::Error> {
    FileKind::expect(path.as_ref(), &[FileKind::Scene])?;
    Scene::read_with(path, &scene_fabric)
}

/// Makes a scene of a document, as [`read_scene`] does of a file.
///
/// # Errors
/// As for [`read_scene`].
pub fn scene_of(document: &Document) -> Result<Scene, drape_scene::Error> {
    FileKind::expect_document(document, &[FileKind::Scene])?;
    Scene::from_document(document, &scene_fabric)
}

/// Makes a scene of a document, as [`scene_of`] does, whose fabrics, patterns and meshes are taken from
/// other documents where it names their paths.
///
/// # Errors
/// As for [`read_scene`].
pub fn scene_of_documents(
    document: &Document,
    others: &[Document],
) -> Result<Scene, drape_scene::Error> {
    FileKind::expect_document(document, &[FileKind::Scene])?;
    Scene::from_documents_with(document, others, &scene_fabric)
}

/// Makes a scene of a document, as [`scene_of`] does; what is refused has the scene beside its mistakes
/// where it could be made, to be shown.
///
/// # Errors
/// As for [`read_scene`].
pub fn scene_or_refused(document: &Document) -> Result<Scene, Box<Refused>> {
    Scene::from_documents_or_refused(document, &[], &scene_fabric)
}

/// Reads a `fabric.toml`, or fits a fabric to a `sheet.toml`.
///
/// The laws are those of the model of the scene: Breen's are fitted to the first branches of the
/// curves.
///
/// # Errors
/// The mistakes of the file, or the reason why a sheet gives no fabric.
pub fn scene_fabric(request: FabricRequest<'_>) -> Result<Fabric, Diagnostics> {
    FileKind::expect(request.file, &FABRICS)?;
    fabric_of(&Document::read(request.file)?.allowing(request.allowed), request.model)
}

/// Makes the fabric of a document: of a `fabric.toml`, or fitted to a `sheet.toml`.
///
/// # Errors
/// As for [`scene_fabric`].
pub fn fabric_of(document: &Document, model: Model) -> Result<Fabric, Diagnostics> {
    FileKind::expect_document(document, &FABRICS)?;
    if is_fabric(document) {
        return Fabric::from_document(document);
    }
    let file = document.path();
    let sheet = Sheet::from_document(document).map_err(|error| match error {
        drape_kes::Error::Input(mistakes) => mistakes,
        other => Diagnostic::new(file, other.to_string()).into(),
    })?;
    let laws = (model == Model::Breen1994).then_some(LoopModel::Piecewise);
    let settings = FitSettings { bending: laws, shear: laws, ..FitSettings::default() };
    let fit = identify_with(&sheet, &settings);
    let fit = fit.map_err(|error| Diagnostics::from(fit_mistake(document, &error)))?;
    Ok(fit.fabric)
}
