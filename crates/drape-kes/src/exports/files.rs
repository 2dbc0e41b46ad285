//! Files of a draft: the files of a folder or an archive, or a single file.

use std::io::Read;
use std::path::{Path, PathBuf};

use drape_input::{Diagnostic, Diagnostics, Document, FileAccess};

use crate::tables::file::archive;

/// Endings of the names of files that hold no tables.
const OTHER_FILES: [&str; 26] = [
    "toml", "md", "pdf", "doc", "docx", "rtf", "odt", "ppt", "pptx", "png", "jpg", "jpeg", "gif",
    "bmp", "tif", "tiff", "svg", "html", "htm", "xml", "json", "zip", "gz", "exe", "dll", "lnk",
];
/// Endings of the names of files that hold tables, and of archives.
const TABLE_FILES: [&str; 17] = [
    "xlsx", "xlsm", "xlsb", "xls", "ods", "csv", "tsv", "tab", "txt", "asc", "dat", "prn", "lst",
    "tra", "raw", "log", "zip",
];
/// Number of levels of subfolders that are searched.
const DEEPEST: usize = 3;
/// Largest number of files of a folder. More files are no exports of one fabric.
const MOST_FILES: usize = 500;

/// Files that are drafted together.
pub(crate) struct Files {
    /// Folder to which the names of the files are relative.
    pub(crate) folder: PathBuf,
    /// Name for the fabric.
    pub(crate) name: String,
    /// Kind and name of the files, in words.
    pub(crate) title: String,
    /// Path and name of each file.
    pub(crate) files: Vec<(PathBuf, String)>,
    /// Access to the files.
    pub(crate) access: FileAccess,
}

impl Files {
    /// Finds the files at `path`: a folder with its subfolders, an archive, or one file. They are
    /// read with the given `access`.
    pub(crate) fn from_path(path: &Path, access: &FileAccess) -> Result<Self, Diagnostics> {
        let access = access.clone();
        let whole = path.canonicalize().unwrap_or_else(|_| path.to_owned());
        if path.is_dir() {
            let mut paths = Vec::new();
            collect_files(path, DEEPEST, &mut paths)?;
            paths.sort();
            let files =
                paths.into_iter().map(|file| (file.clone(), relative(&file, path))).collect();
            let name = name_or_fabric(whole.file_name());
            let title = format!("the exports in the folder {name}");
            return Ok(Self { folder: path.to_owned(), name, title, files, access });
        }
        if access.held(path).is_none()
            && let Err(error) = std::fs::metadata(path)
        {
            let finding = Diagnostic::new(path, format!("cannot open the file: {error}"));
            return Err(finding.help("check the path").into());
        }

        let folder = path.parent().unwrap_or(Path::new("")).to_owned();
        let (name, title) = (name_or_fabric(whole.file_stem()), name_or_fabric(path.file_name()));
        let files = if archive::is_archive(path) && access.has_file(path) {
            let members = archive::members(path, &access).map_err(|reason| {
                Diagnostic::new(path, format!("the archive cannot be read: {reason}"))
                    .help("pack it again as .zip, or name the folder of its files")
            })?;
            members.into_iter().map(|m| (path.join(&m), format!("{title}/{m}"))).collect()
        } else {
            vec![(path.to_owned(), title.clone())]
        };

        Ok(Self { folder, name, title, files, access })
    }
}

/// Returns the text of the name of a file; "fabric" for a missing name.
fn name_or_fabric(name: Option<&std::ffi::OsStr>) -> String {
    name.map_or("fabric".into(), |name| name.to_string_lossy().into_owned())
}

/// Returns whether the file `path` holds tables, or is an archive, by its ending or its first
/// bytes.
pub(crate) fn holds_tables(path: &Path) -> bool {
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
    match ending.as_deref() {
        Some(ending) if TABLE_FILES.contains(&ending) => !is_sheet(path),
        Some(ending) if OTHER_FILES.contains(&ending) => false,
        _ => begins_as_workbook(path).unwrap_or(false),
    }
}

/// Returns whether the text file `path` is a sheet: TOML with the name of a fabric.
fn is_sheet(path: &Path) -> bool {
    let document = path.is_file().then(|| Document::read(path).ok()).flatten();
    let table = document.and_then(|document| document.text().parse().ok());
    table.is_some_and(|table: toml::Table| table.contains_key("name"))
}

/// Returns whether the file `path` has the first bytes of a workbook.
fn begins_as_workbook(path: &Path) -> std::io::Result<bool> {
    if !path.is_file() {
        return Ok(false);
    }
    let mut start = [0; 4];
    std::fs::File::open(path)?.read_exact(&mut start)?;
    Ok([*b"PK\x03\x04", [0xd0, 0xcf, 0x11, 0xe0]].contains(&start))
}

/// Returns whether the file `path` of a folder or an archive holds no tables, by its ending.
pub(crate) fn holds_no_table(path: &Path) -> bool {
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
    ending.is_some_and(|ending| OTHER_FILES.contains(&ending.as_str()))
}

/// Adds the files of `folder`, and of subfolders to the given `depth`, to `paths`.
fn collect_files(folder: &Path, depth: usize, paths: &mut Vec<PathBuf>) -> Result<(), Diagnostics> {
    for entry in std::fs::read_dir(folder).map_err(|error| unreadable(folder, &error))? {
        let path = entry.map_err(|error| unreadable(folder, &error))?.path();
        let name = path.file_name().map(|name| name.to_string_lossy().into_owned());
        let name = name.unwrap_or_default();
        // Hidden files and the locks of spreadsheet programs hold no exports.
        if name.starts_with('.') || name.starts_with("~$") {
            continue;
        }
        if path.is_dir() && depth > 0 {
            collect_files(&path, depth - 1, paths)?;
        } else if path.is_file() {
            paths.push(path);
        }
        if paths.len() > MOST_FILES {
            let message = format!("the folder holds more than {MOST_FILES} files");
            let help = "name the folder of the exports of one fabric";
            return Err(Diagnostic::new(folder, message).help(help).into());
        }
    }
    Ok(())
}

/// Returns the mistake of a `folder` that cannot be read.
fn unreadable(folder: &Path, error: &std::io::Error) -> Diagnostic {
    Diagnostic::new(folder, format!("cannot read the folder: {error}"))
        .help("name the folder of the exported files")
}

/// Returns `path` relative to the folder `beside`, with slashes, as a sheet in that folder names
/// it.
pub(crate) fn relative(path: &Path, beside: &Path) -> String {
    // The folder of the sheet may not exist yet.
    let [path, base] = [path, beside].map(|path| {
        let path = if path.as_os_str().is_empty() { Path::new(".") } else { path };
        std::path::absolute(path).map_or_else(|_| path.to_owned(), |path| canonical(&path))
    });
    // Paths on different drives have no relative path.
    let relative = pathdiff::diff_paths(&path, base).unwrap_or(path);
    relative.to_string_lossy().replace(std::path::MAIN_SEPARATOR, "/")
}

/// Returns the canonical form of `path`; `path` itself if it does not exist.
fn canonical(path: &Path) -> PathBuf {
    path.canonicalize().unwrap_or_else(|_| path.to_owned())
}
