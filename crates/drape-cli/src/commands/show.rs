//! Commands that show a run: as a page, or as pictures.

pub(crate) mod look;
pub(crate) mod picture;
pub(crate) mod view;
