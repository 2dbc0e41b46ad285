//! Places: the folders below which the files lie that a document may name.

use std::fmt;
use std::io;
use std::path::{Component, Path, PathBuf};

use crate::figure::excerpt;

/// Longest name of a file or a folder, and longest path, in bytes: those of common file systems.
const NAME_MAX: usize = 255;
const PATH_MAX: usize = 4095;

/// Largest number of links on the way to a file.
const LINKS_MAX: usize = 40;

/// Folders below which the files lie that a document may name: its own, the working folder, and
/// those that a user allows.
///
/// Paths are compared as they are on the disk, links followed, so that neither `..` nor a link leads
/// out.
///
/// ```
/// use std::path::Path;
/// use drape_input::AllowedFolders;
///
/// let places = AllowedFolders::new(Path::new("src"), &[]);
/// assert!(places.check(Path::new("src/../Cargo.toml")).is_ok());
/// let misplaced = places.check(Path::new("../../../etc/passwd")).unwrap_err();
/// assert!(misplaced.help().contains("--allow-path"));
/// ```
#[derive(Debug, Clone, Default)]
pub struct AllowedFolders {
    folders: Vec<PathBuf>,
}

/// Reason why a path that a document names is not followed.
#[derive(Debug)]
pub enum ForbiddenPath {
    /// It leads out of the folders.
    Outside {
        /// Where it leads.
        place: PathBuf,
        /// Folders below which it could lie.
        folders: Vec<PathBuf>,
    },
    /// It is longer than any file system takes.
    TooLong {
        /// Its beginning.
        path: String,
        /// Its length in bytes.
        bytes: usize,
    },
    /// Its links lead in a circle, or cannot be followed.
    Unresolved {
        /// Path as it is written.
        path: PathBuf,
        /// Reason.
        reason: io::Error,
    },
}

impl AllowedFolders {
    /// Creates the places of a document in a folder; the user allows others, files or folders.
    #[must_use]
    pub fn new(folder: &Path, allowed: &[PathBuf]) -> Self {
        let own = [folder, Path::new("")];
        let folders = own.into_iter().chain(allowed.iter().map(PathBuf::as_path));
        let mut folders: Vec<PathBuf> = folders.filter_map(|path| resolve(path).ok()).collect();
        folders.dedup();
        Self { folders }
    }

    /// Checks that a path, which need not be there yet, leads to a place below one of the folders.
    ///
    /// # Errors
    /// It leads elsewhere, or nowhere.
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
    /// Returns a remedy.
    #[must_use]
    pub fn help(&self) -> String {
        match self {
            Self::Outside { place, .. } => {
                let place = shell(place);
                format!("move it there, or allow it with --allow-path {place} (in Python allow=)")
            }
            Self::TooLong { .. } => {
                format!("a name has up to {NAME_MAX} bytes, a path up to {PATH_MAX}")
            }
            Self::Unresolved { .. } => "name a file itself in place of a link".to_owned(),
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

/// Quotes a path for a shell where it needs that.
fn shell(path: &Path) -> String {
    let text = path.display().to_string();
    let plain = |c: char| c.is_alphanumeric() || "/._-+,".contains(c);
    if text.chars().all(plain) { text } else { format!("'{}'", text.replace('\'', r"'\''")) }
}

fn check_length(path: &Path) -> Result<(), ForbiddenPath> {
    let bytes = path.as_os_str().len();
    let longest = path.components().map(|part| part.as_os_str().len()).max().unwrap_or(0);
    if bytes > PATH_MAX || longest > NAME_MAX {
        let path = excerpt(&path.display().to_string());
        return Err(ForbiddenPath::TooLong { path, bytes });
    }
    Ok(())
}

/// Returns where a path leads, as an absolute path without links and dots. What is not there leads
/// to where it would be.
fn resolve(path: &Path) -> io::Result<PathBuf> {
    let start =
        std::path::absolute(if path.as_os_str().is_empty() { Path::new(".") } else { path });
    let mut rest: Vec<PathBuf> = parts(&start?);
    let mut place = PathBuf::new();
    let mut links = 0;
    while let Some(part) = rest.pop() {
        match part.components().next() {
            Some(Component::ParentDir) => {
                place.pop();
                continue;
            }
            Some(Component::CurDir) | None => continue,
            // Of a link too, whose target begins anew at the root.
            Some(_) => place.push(&part),
        }
        if !std::fs::symlink_metadata(&place).is_ok_and(|found| found.is_symlink()) {
            continue;
        }
        links += 1;
        if links > LINKS_MAX {
            return Err(io::Error::other("its links lead in a circle"));
        }
        let target = std::fs::read_link(&place)?;
        place.pop();
        rest.extend(parts(&target));
    }
    Ok(place)
}

/// Returns the parts of a path, the last one first.
fn parts(path: &Path) -> Vec<PathBuf> {
    path.components().rev().map(|part| PathBuf::from(part.as_os_str())).collect()
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::os::unix::fs::symlink;

    #[test]
    fn neither_dots_nor_links_lead_out() {
        let folder = std::env::temp_dir().join(format!("drape-places-{}", std::process::id()));
        let (own, other) = (folder.join("own"), folder.join("other"));
        std::fs::create_dir_all(own.join("deep")).expect("made");
        std::fs::create_dir_all(&other).expect("made");
        std::fs::write(other.join("a.toml"), "").expect("written");
        symlink(&other, own.join("out")).expect("linked");
        symlink("deep", own.join("in")).expect("linked");
        symlink("round", own.join("round")).expect("linked");
        let places = AllowedFolders::new(&own, &[]);
        let may = |name: &str| places.check(&own.join(name)).is_ok();
        assert!(may("a.toml") && may("deep/../b") && may("in/../c") && may("in/new/file"));
        assert!(!may("../other/a.toml") && !may("out/a.toml") && !may("out") && !may("out/new"));
        assert!(!may("in/../../other") && !may("../own-too") && !may("deep/../../x"));
        assert!(!may("/etc/passwd") && !may("round") && !may("round/x"));
        let allowed = AllowedFolders::new(&own, &[other.join("a.toml")]);
        assert!(allowed.check(&own.join("out/a.toml")).is_ok());
        assert!(allowed.check(&own.join("out/b.toml")).is_err());
        let long = places.check(&own.join("x".repeat(5000))).expect_err("it is too long");
        assert!(long.to_string().len() < 300, "{long}");
        std::fs::remove_dir_all(&folder).expect("removed");
    }

    #[test]
    fn paths_are_quoted_for_a_shell_where_they_need_that() {
        let quoted = ["/a/b-1.toml", "my files/a", "it's"].map(|path| shell(Path::new(path)));
        assert_eq!(quoted, ["/a/b-1.toml", "'my files/a'", r"'it'\''s'"]);
    }
}
