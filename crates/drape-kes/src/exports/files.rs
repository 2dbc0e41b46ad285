//! Files of a draft: those of a folder, of an archive, or one.

use std::io::Read;
use std::path::{Path, PathBuf};

use drape_input::{Diagnostic, Diagnostics, Document};

use crate::tables::file::archive;

/// Endings of files that hold no tables.
const OTHER_FILES: [&str; 26] = [
    "toml", "md", "pdf", "doc", "docx", "rtf", "odt", "ppt", "pptx", "png", "jpg", "jpeg", "gif",
    "bmp", "tif", "tiff", "svg", "html", "htm", "xml", "json", "zip", "gz", "exe", "dll", "lnk",
];
/// Endings of files that hold tables, and of archives.
const TABLE_FILES: [&str; 17] = [
    "xlsx", "xlsm", "xlsb", "xls", "ods", "csv", "tsv", "tab", "txt", "asc", "dat", "prn", "lst",
    "tra", "raw", "log", "zip",
];
/// Deepest folder below the one that is named.
const DEEPEST: usize = 3;
/// Most files of a folder: more are no exports of one fabric.
const MOST_FILES: usize = 500;

/// Files that are drafted together.
pub(crate) struct Files {
    /// Folder from which the names of the files are seen.
    pub(crate) folder: PathBuf,
    /// Name for the fabric.
    pub(crate) name: String,
    /// What the files are, in words.
    pub(crate) title: String,
    /// Path and name of each file.
    pub(crate) files: Vec<(PathBuf, String)>,
}

impl Files {
    /// Finds the files of a folder and of the folders below, of an archive, or one file.
    pub(crate) fn of(path: &Path) -> Result<Self, Diagnostics> {
        let whole = path.canonicalize().unwrap_or_else(|_| path.to_owned());
        let named = |name: Option<&std::ffi::OsStr>| {
            name.map_or("fabric".into(), |name| name.to_string_lossy().into_owned())
        };
        if path.is_dir() {
            let mut paths = Vec::new();
            search(path, DEEPEST, &mut paths)?;
            paths.sort();
            let files =
                paths.into_iter().map(|file| (file.clone(), relative(&file, path))).collect();
            let name = named(whole.file_name());
            let title = format!("the exports in the folder {name}");
            return Ok(Self { folder: path.to_owned(), name, title, files });
        }
        if let Err(error) = std::fs::metadata(path) {
            let finding = Diagnostic::new(path, format!("cannot open the file: {error}"));
            return Err(finding.help("check the path").into());
        }
        let folder = path.parent().unwrap_or(Path::new("")).to_owned();
        let (name, title) = (named(whole.file_stem()), named(path.file_name()));
        let files = if archive::is_archive(path) && path.is_file() {
            let members = archive::members(path).map_err(|reason| {
                Diagnostic::new(path, format!("the archive cannot be read: {reason}"))
                    .help("pack it again as .zip, or name the folder of its files")
            })?;
            members.into_iter().map(|m| (path.join(&m), format!("{title}/{m}"))).collect()
        } else {
            vec![(path.to_owned(), title.clone())]
        };
        Ok(Self { folder, name, title, files })
    }
}

/// Returns whether a file holds tables, or is an archive, by its ending or its first bytes.
pub(crate) fn is_of_tables(path: &Path) -> bool {
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
    match ending.as_deref() {
        Some(ending) if TABLE_FILES.contains(&ending) => !is_sheet(path),
        Some(ending) if OTHER_FILES.contains(&ending) => false,
        _ => begins_as_workbook(path).unwrap_or(false),
    }
}

/// Returns whether a file of text is a sheet: TOML with the name of a fabric.
fn is_sheet(path: &Path) -> bool {
    let document = path.is_file().then(|| Document::read(path).ok()).flatten();
    let table = document.and_then(|document| document.text().parse().ok());
    table.is_some_and(|table: toml::Table| table.contains_key("name"))
}

/// Returns whether a file of any name has the first bytes of a workbook.
fn begins_as_workbook(path: &Path) -> std::io::Result<bool> {
    if !path.is_file() {
        return Ok(false);
    }
    let mut start = [0; 4];
    std::fs::File::open(path)?.read_exact(&mut start)?;
    Ok([*b"PK\x03\x04", [0xd0, 0xcf, 0x11, 0xe0]].contains(&start))
}

/// Returns whether a file of a folder or of an archive holds no tables, by its ending.
pub(crate) fn is_other(path: &Path) -> bool {
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
    ending.is_some_and(|ending| OTHER_FILES.contains(&ending.as_str()))
}

/// Collects the files of a folder and of those below it.
fn search(folder: &Path, depth: usize, paths: &mut Vec<PathBuf>) -> Result<(), Diagnostics> {
    let unreadable = |error: std::io::Error| {
        Diagnostic::new(folder, format!("cannot read the folder: {error}"))
            .help("name the folder of the exported files")
    };
    for entry in std::fs::read_dir(folder).map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        let name = path.file_name().map(|name| name.to_string_lossy().into_owned());
        let name = name.unwrap_or_default();
        // Hidden files, and the locks of spreadsheet programs.
        if name.starts_with('.') || name.starts_with("~$") {
            continue;
        }
        if path.is_dir() && depth > 0 {
            search(&path, depth - 1, paths)?;
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

/// Returns a path as it is written in a sheet of a folder, with slashes.
pub(crate) fn relative(path: &Path, beside: &Path) -> String {
    let whole = |path: &Path| path.canonicalize().unwrap_or_else(|_| path.to_owned());
    // The folder of the sheet may not be there yet.
    let base = if beside.as_os_str().is_empty() {
        whole(Path::new("."))
    } else {
        std::path::absolute(beside).map_or_else(|_| beside.to_owned(), |path| whole(&path))
    };
    let path = if path.as_os_str().is_empty() { whole(Path::new(".")) } else { whole(path) };
    let (mut of_path, mut of_base) = (path.components().peekable(), base.components().peekable());
    while of_path.peek().is_some() && of_path.peek() == of_base.peek() {
        of_path.next();
        of_base.next();
    }
    let up = of_base.map(|_| "..".to_owned());
    let down = of_path.map(|part| part.as_os_str().to_string_lossy().into_owned());
    up.chain(down).collect::<Vec<_>>().join("/")
}
