//! File access: the files that an input may name, and how large files may be.

pub(crate) mod allowed_folders;

use std::path::PathBuf;

/// Files that an input may name, and how large files may be.
///
/// A [`Document`](crate::Document) carries the access of its reader, so that every file that the
/// document names is read with the same access.
///
/// ```
/// use drape_input::{Document, FileAccess};
///
/// let access = FileAccess { size_factor: 4, ..FileAccess::default() };
/// let document = Document::read_with("Cargo.toml", &access)?;
/// assert_eq!(document.access(), &access);
/// # Ok::<(), drape_input::Diagnostics>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FileAccess {
    /// Files and folders that an input may name, beside its folder and the working folder.
    pub allowed: Vec<PathBuf>,
    /// Factor by which the limits on the sizes of files are raised. 0 means 1.
    pub size_factor: u32,
}

impl FileAccess {
    /// Returns the access without further folders, with the usual limits on sizes.
    #[must_use]
    pub fn usual() -> &'static Self {
        static USUAL: FileAccess = FileAccess { allowed: Vec::new(), size_factor: 1 };
        &USUAL
    }
}

impl Default for FileAccess {
    fn default() -> Self {
        Self::usual().clone()
    }
}
