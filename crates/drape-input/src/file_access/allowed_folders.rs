//! Allowed folders: the folders that contain the files that a document may name.

use std::fmt;
use std::io;
use std::path::{Component, Path, PathBuf};

use crate::diagnostic::advice::Advice;
use crate::diagnostic::remedy::Remedy;
use crate::figure::excerpt;

/// Longest name of a file or folder in common file systems, in bytes.
const NAME_MAX: usize = 255;

/// Longest path in common file systems, in bytes.
const PATH_MAX: usize = 4095;

/// Folders that contain the files that a document may name: the folder of the document, the working
/// folder, and the folders that a user allows.
///
/// Paths are compared after links have been followed, so that neither `..` nor a link leads out of
/// the folders.
///
/// ```
/// use std::path::Path;
/// use drape_input::{AllowedFolders, Remedy};
///
/// let folders = AllowedFolders::new(Path::new("src"), &[]);
/// assert!(folders.check(Path::new("src/../Cargo.toml")).is_ok());
/// let forbidden = folders.check(Path::new("../../../etc/passwd")).unwrap_err();
/// assert!(matches!(forbidden.help().remedy, Some(Remedy::AllowPath { .. })));
/// ```
#[derive(Debug, Clone, Default)]
pub struct AllowedFolders {
    folders: Vec<PathBuf>,
}

/// Reason why a path that a document names is not followed.
#[derive(Debug)]
pub enum ForbiddenPath {
    /// The path leads out of the allowed folders.
    Outside {
        /// File or folder to which the path leads.
        place: PathBuf,
        /// Allowed folders.
        folders: Vec<PathBuf>,
    },
    /// The path is longer than common file systems allow.
    TooLong {
        /// Beginning of the path.
        path: String,
        /// Length of the path, in bytes.
        bytes: usize,
    },
    /// The links of the path lead in a circle, or cannot be followed.
    Unresolved {
        /// Path as the document writes it.
        path: PathBuf,
        /// Message of the system.
        reason: io::Error,
    },
}

impl AllowedFolders {
    /// Creates the allowed folders of a document in `folder`. The user allows the files and folders
    /// `allowed` as well.
    #[must_use]
    pub fn new(folder: &Path, allowed: &[PathBuf]) -> Self {
        let working_folder = Path::new("");
        let paths =
            [folder, working_folder].into_iter().chain(allowed.iter().map(PathBuf::as_path));
        let mut folders: Vec<PathBuf> = paths.filter_map(|path| resolve(path).ok()).collect();
        folders.dedup();
        Self { folders }
    }

    /// Checks that `path` leads to a file or folder in one of the allowed folders. The file or
    /// folder need not exist.
    ///
    /// # Errors
    /// [`ForbiddenPath`] if `path` leads out of the folders, is too long or cannot be followed.
    pub fn check(&self, path: &Path) -> Result<(), ForbiddenPath> {
        check_length(path)?;
        let place = resolve(path)
            .map_err(|reason| ForbiddenPath::Unresolved { path: path.to_owned(), reason })?;
        if self.folders.iter().any(|folder| place.starts_with(folder)) {
            return Ok(());
        }
        Err(ForbiddenPath::Outside { place, folders: self.folders.clone() })
    }
}

impl ForbiddenPath {
    /// Returns the remedy for the user.
    #[must_use]
    pub fn help(&self) -> Advice {
        match self {
            Self::Outside { place, .. } => Remedy::AllowPath { place: place.clone() }.into(),
            Self::TooLong { .. } => {
                format!("a name has up to {NAME_MAX} bytes, a path up to {PATH_MAX}").into()
            }
            Self::Unresolved { .. } => "name a file itself in place of a link".into(),
        }
    }
}

impl fmt::Display for ForbiddenPath {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Outside { place, folders } => {
                let folders: Vec<String> =
                    folders.iter().map(|folder| folder.display().to_string()).collect();
                let place = place.display();
                write!(f, "the path leads to {place}, which is not below {}", folders.join(" or "))
            }
            Self::TooLong { path, bytes } => {
                write!(f, "the path \"{path}\" has {bytes} bytes")
            }
            Self::Unresolved { path, reason } => {
                write!(f, "the path {} cannot be followed: {reason}", path.display())
            }
        }
    }
}

impl std::error::Error for ForbiddenPath {}

/// Checks that `path` and its longest name are not longer than common file systems allow.
fn check_length(path: &Path) -> Result<(), ForbiddenPath> {
    let bytes = path.as_os_str().len();
    let longest = path.components().map(|part| part.as_os_str().len()).max().unwrap_or(0);
    if bytes > PATH_MAX || longest > NAME_MAX {
        let path = excerpt(&path.display().to_string());
        return Err(ForbiddenPath::TooLong { path, bytes });
    }
    Ok(())
}

/// Returns the absolute path to which `path` leads, without links and dots. The parts of a path
/// that do not exist are taken as names of files and folders.
fn resolve(path: &Path) -> io::Result<PathBuf> {
    /// Largest number of links on the way to a file.
    const LINKS_MAX: usize = 40;

    let relative = if path.as_os_str().is_empty() { Path::new(".") } else { path };
    let mut remaining: Vec<PathBuf> = reversed_parts(&std::path::absolute(relative)?);
    let mut resolved = PathBuf::new();
    let mut links = 0;
    while let Some(part) = remaining.pop() {
        match part.components().next() {
            Some(Component::ParentDir) => {
                resolved.pop();
                continue;
            }
            Some(Component::CurDir) | None => continue,
            // The root of an absolute target of a link replaces the path so far.
            Some(_) => resolved.push(&part),
        }

        let metadata = std::fs::symlink_metadata(&resolved);
        if !metadata.is_ok_and(|metadata| metadata.is_symlink()) {
            continue;
        }
        links += 1;
        if links > LINKS_MAX {
            return Err(io::Error::other("its links lead in a circle"));
        }
        let target = std::fs::read_link(&resolved)?;
        resolved.pop();
        remaining.extend(reversed_parts(&target));
    }
    Ok(resolved)
}

/// Returns the parts of `path`, the last part first.
fn reversed_parts(path: &Path) -> Vec<PathBuf> {
    path.components().rev().map(|part| PathBuf::from(part.as_os_str())).collect()
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::os::unix::fs::symlink;

    #[test]
    fn neither_dots_nor_links_lead_out() {
        let folder = std::env::temp_dir().join(format!("drape-places-{}", std::process::id()));
        let (inner, other) = (folder.join("inner"), folder.join("other"));
        std::fs::create_dir_all(inner.join("deep")).expect("made");
        std::fs::create_dir_all(&other).expect("made");
        std::fs::write(other.join("a.toml"), "").expect("written");
        symlink(&other, inner.join("out")).expect("linked");
        symlink("deep", inner.join("in")).expect("linked");
        symlink("round", inner.join("round")).expect("linked");

        let folders = AllowedFolders::new(&inner, &[]);
        let may = |name: &str| folders.check(&inner.join(name)).is_ok();
        assert!(may("a.toml") && may("deep/../b") && may("in/../c") && may("in/new/file"));
        assert!(!may("../other/a.toml") && !may("out/a.toml") && !may("out") && !may("out/new"));
        assert!(!may("in/../../other") && !may("../inner-too") && !may("deep/../../x"));
        assert!(!may("/etc/passwd") && !may("round") && !may("round/x"));

        let allowed = AllowedFolders::new(&inner, &[other.join("a.toml")]);
        assert!(allowed.check(&inner.join("out/a.toml")).is_ok());
        assert!(allowed.check(&inner.join("out/b.toml")).is_err());
        let long = folders.check(&inner.join("x".repeat(5000))).expect_err("it is too long");
        assert!(long.to_string().len() < 300, "{long}");
        std::fs::remove_dir_all(&folder).expect("removed");
    }
}
