//! Fabrics of a scene, read from files of fabrics or fitted to sheets. Fit and simulation do not
//! know each other and meet here.

mod mistake;

use std::path::{Path, PathBuf};

use drape_fabric::Fabric;
use drape_fit::{FitSettings, LoopModel, identify_with};
use drape_input::{Diagnostic, Diagnostics, Document, Faults, FileAccess};
use drape_kes::Sheet;
use drape_scene::{FabricRequest, Model, Refused, Scene, SceneSpec, Sources, is_fabric};

use crate::file::FileKind;

pub use mistake::{NamedCurve, fit_mistake};

/// Kinds of files that define a fabric.
const FABRICS: [FileKind; 2] = [FileKind::Fabric, FileKind::Sheet];

/// Reads the scene at `path`. Its fabrics are files of fabrics, or sheets of measurements to which
/// fabrics are fitted.
///
/// # Errors
/// Errors of [`Scene::read`], and the mistakes of the sheets.
pub fn read_scene(path: impl AsRef<Path>) -> Result<Scene, drape_scene::Error> {
    FileKind::expect(path.as_ref(), &[FileKind::Scene])?;
    Scene::read_with(path, &scene_fabric)
}

/// Returns the scene of a `document`, as [`read_scene`] does for a file.
///
/// # Errors
/// Errors of [`read_scene`].
pub fn scene_of(document: &Document) -> Result<Scene, drape_scene::Error> {
    FileKind::expect_document(document, &[FileKind::Scene])?;
    Scene::from_document(document, &scene_fabric)
}

/// Spec of a scene that a program made, and where the files are that it names.
#[derive(Debug, Clone)]
pub struct PlacedSpec {
    /// The spec.
    pub spec: SceneSpec,
    /// Mistakes of the keys that the spec was made of.
    pub faults: Faults,
    /// Folder from which names of files are seen.
    pub folder: PathBuf,
    /// Access to the files that the spec names.
    pub access: FileAccess,
}

/// Returns the scene of `placed`, as [`scene_of`] does for a text.
///
/// # Errors
/// Errors of [`read_scene`].
pub fn scene_of_spec(placed: &PlacedSpec) -> Result<Scene, drape_scene::Error> {
    let PlacedSpec { spec, faults, folder, access } = placed;
    let sources = Sources { access, fabrics: &scene_fabric, ..Sources::new(folder) };
    spec.build_or_refused(&sources, faults.clone()).map_err(|refused| refused.error)
}

/// Returns the scene of a `document`, as [`scene_of`] does. A refusal contains the mistakes, and
/// the scene if it could be created, to be shown.
///
/// # Errors
/// The errors of [`read_scene`].
pub fn scene_or_refused(document: &Document) -> Result<Scene, Box<Refused>> {
    Scene::from_documents_or_refused(document, &[], &scene_fabric)
}

/// Reads a `fabric.toml`, or fits a fabric to a `sheet.toml`.
///
/// The laws belong to the model of the scene. The laws of Breen are fitted to the first branches of
/// the curves.
///
/// # Errors
/// The mistakes of the file, or the reason why a sheet gives no fabric.
pub fn scene_fabric(request: FabricRequest<'_>) -> Result<Fabric, Diagnostics> {
    FileKind::expect(request.file, &FABRICS)?;
    fabric_of(&Document::read_with(request.file, request.access)?, request.model)
}

/// Returns the fabric of a `document`: a `fabric.toml`, or a `sheet.toml` to which it is fitted for
/// a `model`.
///
/// # Errors
/// Errors of [`scene_fabric`].
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
