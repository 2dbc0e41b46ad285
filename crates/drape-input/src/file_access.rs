//! File access: the files that an input may name, how large files may be, and files in memory.

pub(crate) mod allowed_folders;
pub(crate) mod similar_file;
pub(crate) mod size_limit;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Files that an input may name, how large files may be, and files in memory.
///
/// A [`Document`](crate::Document) carries the access of its reader, so that every file that the
/// document names is read with the same access. A file in memory takes the place of the file at its
/// path, which need not exist. A program without a file system reads all its files in this way.
///
/// ```
/// use drape_input::{Document, FileAccess};
///
/// let access = FileAccess::default().holding("towel.toml", *b"spacing = 0.01");
/// let document = Document::read_with("towel.toml", &access)?;
/// assert_eq!(document.text(), "spacing = 0.01");
/// assert_eq!(document.access(), &access);
/// # Ok::<(), drape_input::Diagnostics>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FileAccess {
    /// Files and folders that an input may name, beside its folder and the working folder.
    pub allowed: Vec<PathBuf>,
    /// Factor by which the limits on the sizes of files are raised. 0 means 1.
    pub size_factor: u32,
    /// Contents of files in memory, by the paths that they stand for.
    pub held: BTreeMap<PathBuf, Arc<[u8]>>,
}

impl FileAccess {
    /// Returns the access without further folders and without files in memory, with the usual
    /// limits on sizes.
    #[must_use]
    pub fn usual() -> &'static Self {
        static USUAL: FileAccess =
            FileAccess { allowed: Vec::new(), size_factor: 1, held: BTreeMap::new() };
        &USUAL
    }

    /// Returns the access with the file `path` in memory, which contains `bytes`.
    #[must_use]
    pub fn holding(mut self, path: impl Into<PathBuf>, bytes: impl Into<Arc<[u8]>>) -> Self {
        self.held.insert(path.into(), bytes.into());
        self
    }

    /// Returns the content of the file `path` if it is in memory.
    #[must_use]
    pub fn held(&self, path: &Path) -> Option<&[u8]> {
        self.held.get(path).map(AsRef::as_ref)
    }

    /// Returns whether the file `path` is in memory or exists.
    #[must_use]
    pub fn has_file(&self, path: &Path) -> bool {
        self.held.contains_key(path) || path.is_file()
    }
}

impl Default for FileAccess {
    fn default() -> Self {
        Self::usual().clone()
    }
}
