use crate::file::SceneFile;
use crate::reader::Reader;

/// What the cloth of a scene is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Model {
    /// Yarn connectors with the laws of the fabric, friction included.
    #[default]
    Kes,
    /// Interacting particles without friction [Breen, House & Wozny 1994]: see [`drape_cloth::Breen`].
    Breen1994,
}

impl Reader<'_> {
    pub(crate) fn model(&mut self, file: &SceneFile) -> Model {
        let models = [("kes", Model::Kes), ("breen-1994", Model::Breen1994)];
        self.choice("model", file.model.as_deref(), &models)
    }
}
