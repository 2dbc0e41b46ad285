//! Documents of a scene: its file, and those that it names.

use drape_input::Document;

use crate::scene::material::FabricReader;

/// Documents of a scene: its own, and others that it names by their paths; its fabrics are read by
/// a function.
pub(crate) struct Documents<'a> {
    pub(crate) scene: &'a Document,
    pub(crate) others: &'a [Document],
    pub(crate) fabrics: FabricReader<'a>,
}
