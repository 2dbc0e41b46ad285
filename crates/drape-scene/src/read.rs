//! Reading of scenes, from files or from memory.

use std::path::Path;

use drape_input::{Diagnostics, Document, Setting, figure};

use crate::check::check;
use crate::check::documents::Documents;
use crate::error::{Error, Refused};
use crate::file::SceneFile;
use crate::scene::Scene;
use crate::scene::material::{FabricReader, read_fabric};
use crate::spacings::{REFINE, Spacing, spacings};

impl Scene {
    /// Reads a scene and everything it names. Its fabrics are in files of fabrics.
    ///
    /// # Errors
    /// All mistakes that could be found, each with file, line, value and remedy; with them the
    /// triangles that cross at the start, if some do.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Error> {
        Self::read_with(path, &read_fabric)
    }

    /// Reads a scene and everything it names, with a function that makes its fabrics, of files of
    /// any kind.
    ///
    /// # Errors
    /// As for [`Scene::read`].
    pub fn read_with(path: impl AsRef<Path>, fabrics: FabricReader<'_>) -> Result<Self, Error> {
        Self::from_document(&Document::read(path)?, fabrics)
    }

    /// Makes a scene of a document; the files that it names are seen from the folder of its path,
    /// and a function makes its fabrics of them.
    ///
    /// # Errors
    /// As for [`Scene::read`].
    pub fn from_document(scene: &Document, fabrics: FabricReader<'_>) -> Result<Self, Error> {
        Self::from_documents_with(scene, &[], fabrics)
    }

    /// Makes a scene of a document in memory. A fabric, a pattern or a mesh is taken from the
    /// document in `others` that has its path, seen from the folder of `scene`.
    ///
    /// # Errors
    /// As for [`Scene::read`].
    pub fn from_documents(scene: &Document, others: &[Document]) -> Result<Self, Error> {
        Self::from_documents_with(scene, others, &read_fabric)
    }

    /// Makes a scene of documents in memory, as [`Scene::from_documents`] does, with a function
    /// that makes the fabrics of the files that it names beside them.
    ///
    /// # Errors
    /// As for [`Scene::read`].
    pub fn from_documents_with(
        scene: &Document,
        others: &[Document],
        fabrics: FabricReader<'_>,
    ) -> Result<Self, Error> {
        Self::from_documents_or_refused(scene, others, fabrics).map_err(|refused| refused.error)
    }

    /// Makes a scene of documents in memory, as [`Scene::from_documents_with`] does; what is
    /// refused has the scene beside its mistakes where it could be made, to be shown.
    ///
    /// # Errors
    /// As for [`Scene::read`].
    pub fn from_documents_or_refused(
        scene: &Document,
        others: &[Document],
        fabrics: FabricReader<'_>,
    ) -> Result<Self, Box<Refused>> {
        let (file, faults) = scene.decode_with_faults::<SceneFile>()?;
        let documents = Documents { scene, others, fabrics };
        let mut checked = check(&documents, &file, faults)?;
        checked.coarser = coarser_scenes(&documents, &file)?;
        Ok(checked)
    }
}

/// Returns the scene of a file, which has been checked, on its coarser grids.
///
/// # Errors
/// What keeps it from being simulated there.
fn coarser_scenes(documents: &Documents<'_>, file: &SceneFile) -> Result<Vec<Scene>, Error> {
    let Some(refine) = &file.refine else { return Ok(Vec::new()) };
    let spacings = spacings(documents.scene)?;
    let grids = refine.spacings.iter().enumerate();
    grids
        .map(|(index, spacing)| on_grid(documents, &spacings, (index, *spacing * file.unit())))
        .collect()
}

/// Returns the scene on the grid of a number and a spacing, in m.
fn on_grid(
    documents: &Documents<'_>,
    spacings: &[Spacing],
    (index, spacing): (usize, f64),
) -> Result<Scene, Error> {
    let settings: Vec<Setting> =
        spacings.iter().map(|part| part.scaled(spacing / spacings[0].value)).collect();
    let scene = documents.scene.clone().with_settings(&settings)?;
    let (mut file, faults) = scene.decode_with_faults::<SceneFile>()?;
    file.refine = None;
    file.grading = None;
    let documents = Documents { scene: &scene, ..*documents };
    check(&documents, &file, faults).map_err(|refused| {
        let message = format!("a grid of {} mm: {}", figure(1e3 * spacing), refused.error);
        let mistake = documents.scene.at(&format!("{REFINE}[{index}]"), message);
        Diagnostics::from(mistake.help("take a finer one, or leave it out")).into()
    })
}
