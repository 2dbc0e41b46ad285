//! Scenes from specs, and from files.

use std::path::Path;

use drape_input::{Diagnostics, Document, Faults, FileAccess, figure};

use crate::check::check;
use crate::check::documents::Documents;
use crate::error::{Error, Refused};
use crate::scene::Scene;
use crate::scene::material::{FabricReader, read_fabric};
use crate::spacings::REFINE;
use crate::spec::SceneSpec;

/// Where the files that a spec names are found.
#[derive(Clone, Copy)]
pub struct Sources<'a> {
    /// Folder from which names of files are seen.
    pub folder: &'a Path,
    /// Access to the files that the spec names.
    pub access: &'a FileAccess,
    /// Documents that take the place of the files with their paths.
    pub documents: &'a [Document],
    /// Function that makes a fabric of a file, such as a sheet that is fitted.
    pub fabrics: FabricReader<'a>,
}

impl<'a> Sources<'a> {
    /// Returns the sources in `folder`, where fabrics are in files of fabrics.
    #[must_use]
    pub fn new(folder: &'a Path) -> Self {
        Self { folder, access: FileAccess::usual(), documents: &[], fabrics: &read_fabric }
    }
}

impl SceneSpec {
    /// Checks the spec and makes a scene of it. The spec holds everything itself and names no file.
    ///
    /// # Errors
    /// All mistakes that could be found, each with its key, its value and a remedy; with them the
    /// triangles that cross at the start, if some do. A name of a file is a mistake.
    pub fn build(&self) -> Result<Scene, Error> {
        let message = "names a file, and there is no folder to find it in";
        let help = "hold the thing itself, or build with the sources of files";
        let nowhere = Document::new("", "");
        // A name that is empty is a mistake of its own.
        let mut spec = self.clone();
        let files = spec.files_mut().into_iter().filter(|file| !file.name.is_empty());
        let mistakes = files.map(|file| nowhere.at(&file.key, message).help(help)).collect();
        Diagnostics::check(mistakes)?;
        self.build_with(&Sources::new(Path::new("")))
    }

    /// Checks the spec and makes a scene of it. Files that the spec names are read from `sources`.
    ///
    /// # Errors
    /// The errors of [`build`](Self::build), and the mistakes of files.
    pub fn build_with(&self, sources: &Sources<'_>) -> Result<Scene, Error> {
        self.build_or_refused(sources, Faults::default()).map_err(|refused| refused.error)
    }

    /// Makes a scene as [`build_with`](Self::build_with) does. What is refused has the scene beside
    /// its mistakes where it could be made, to be shown. The mistakes contain `faults`, the
    /// mistakes of the document that the spec was read from.
    ///
    /// # Errors
    /// The errors of [`build_with`](Self::build_with).
    pub fn build_or_refused(
        &self,
        sources: &Sources<'_>,
        faults: Faults,
    ) -> Result<Scene, Box<Refused>> {
        /// Name that stands for the file that a spec does not have.
        const NO_FILE: &str = "<scene>";

        let path = sources.folder.join(NO_FILE);
        let text = self.without_held().text();
        let implied = Document::new(&path, text).with_access(sources.access);
        let documents =
            Documents { scene: &implied, others: sources.documents, fabrics: sources.fabrics };
        self.scene(&documents, faults).map_err(|refused| refused.without_file(&path))
    }

    /// Returns the scene of the spec, which the document of `documents` says, with its coarser
    /// grids. The text of the document has `faults`.
    fn scene(&self, documents: &Documents<'_>, faults: Faults) -> Result<Scene, Box<Refused>> {
        let mut scene = check(documents, self, faults)?;
        scene.coarser = self.coarser_scenes(documents)?;
        Ok(scene)
    }

    /// Returns the scenes of the spec, which has been checked, on its coarser grids.
    fn coarser_scenes(&self, documents: &Documents<'_>) -> Result<Vec<Scene>, Error> {
        let Some(refine) = &self.refine else { return Ok(Vec::new()) };
        let finest = self.spacings()[0].value;
        let grids = refine.spacings.iter().enumerate();
        let scenes = grids.map(|(index, spacing)| {
            let coarse = self.coarsened(spacing / finest);
            check(documents, &coarse, Faults::default()).map_err(|refused| {
                let message = format!("a grid of {} mm: {}", figure(1e3 * spacing), refused.error);
                let mistake = documents.scene.at(&format!("{REFINE}[{index}]"), message);
                Diagnostics::from(mistake.help("take a finer one, or leave it out")).into()
            })
        });
        scenes.collect()
    }
}

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
        let (spec, faults) = SceneSpec::with_faults(scene)?;
        spec.scene(&Documents { scene, others, fabrics }, faults)
    }
}
