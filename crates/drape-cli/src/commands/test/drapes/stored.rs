//! Results of drapes in files: `NAME-drape.json` with its picture and its shadow beside it.

use std::path::{Path, PathBuf};

use drape::input::Diagnostic;
use drape::report::plot::shadow_svg;
use drape::report::{Picture, ReportedDrape};
use drape::run::file;
use drape::run::reports::DrapeResult;

use super::run::Draped;
use crate::console::note;
use crate::failure::Failure;
use crate::pages::picture::Pictures;

/// End of the name of the file of a result.
const RESULT: &str = "-drape.json";

/// Width and height of the picture, in pixels.
const SIZE: [u32; 2] = [640, 480];

/// Largest file of a result and of a picture that is read, in bytes.
const FILE_MAX: u64 = 64 << 20;

/// Remedy for what is no result.
const REMEDY: &str = "write it with drape test FABRIC --drape --report FOLDER";

/// Files of a result.
pub(crate) struct Written {
    pub(crate) result: PathBuf,
    pub(crate) picture: PathBuf,
    pub(crate) shadow: PathBuf,
}

/// Draws the picture of a drape.
pub(crate) fn picture(draped: &Draped) -> Result<Option<Picture>, Failure> {
    let Some(snapshot) = &draped.snapshot else { return Ok(None) };
    Pictures::new(snapshot)?.draw([None, None], SIZE).map(Some)
}

/// Writes a result with its picture and its shadow into a folder.
pub(crate) fn store(draped: &Draped, folder: &Path, name: &str) -> Result<Written, Failure> {
    let [result, png, svg] =
        [RESULT, "-drape.png", "-drape-shadow.svg"].map(|end| folder.join(format!("{name}{end}")));
    let mut stored = draped.result.clone();
    if let Some(picture) = picture(draped)? {
        file::write(&png, picture.png().map_err(Failure::from_picture)?)?;
        stored.picture = Some(format!("{name}-drape.png"));
    }
    if let Some(shadow) = stored.shown_shadow() {
        file::write(&svg, shadow_svg(&shadow)?)?;
    }
    let text = serde_json::to_string_pretty(&stored).expect("results always have a JSON form");
    file::write(&result, text)?;
    Ok(Written { result, picture: png, shadow: svg })
}

/// Result that was read, with its file.
pub(crate) struct Stored {
    path: PathBuf,
    pub(crate) result: DrapeResult,
}

/// Reads results: files, or those in folders.
pub(crate) fn read(paths: &[PathBuf], may_be_empty: bool) -> Result<Vec<Stored>, Failure> {
    let mut stored = Vec::new();
    for path in paths {
        if !path.is_dir() && !path.exists() && may_be_empty {
            continue;
        }
        let files = if path.is_dir() { results_in(path)? } else { vec![path.clone()] };
        if files.is_empty() && !may_be_empty {
            let message = format!("holds no results of drapes (*{RESULT})");
            return Err(Failure::Input(Diagnostic::new(path, message).help(REMEDY).into()));
        }
        for file in files {
            stored.push(read_result(&file)?);
        }
    }
    Ok(stored)
}

/// Returns the files of results in a folder, by their names.
fn results_in(folder: &Path) -> Result<Vec<PathBuf>, Failure> {
    let unreadable = |error| Failure::Output(format!("cannot read {}: {error}", folder.display()));
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if name.ends_with(RESULT) {
            files.push(path);
        }
    }
    files.sort();
    Ok(files)
}

fn read_result(path: &Path) -> Result<Stored, Failure> {
    let mistake =
        |message: String| Failure::Input(Diagnostic::new(path, message).help(REMEDY).into());
    let bytes = read_file(path).map_err(|error| mistake(format!("cannot be read: {error}")))?;
    let result: DrapeResult = serde_json::from_slice(&bytes)
        .map_err(|error| mistake(format!("is no result of drape test --drape: {error}")))?;
    let reported = result.reported(None);
    let reported = reported.ok_or_else(|| mistake("has no specimens".into()))?;
    // The checks of the page, with the name of the file.
    shadow_svg(&reported.shadow).map_err(|error| mistake(error.to_string()))?;
    Ok(Stored { path: path.to_owned(), result })
}

/// Reads a file that is not too large.
fn read_file(path: &Path) -> std::io::Result<Vec<u8>> {
    let size = std::fs::metadata(path)?.len();
    if size > FILE_MAX {
        return Err(std::io::Error::other(format!("it has {size} bytes")));
    }
    std::fs::read(path)
}

impl Stored {
    /// Returns the file of the result.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Returns what a report shows, with the picture beside the result; a missing picture is told.
    pub(crate) fn reported(&self) -> Option<ReportedDrape> {
        let name = self.result.picture.as_deref().map(Path::new).and_then(Path::file_name);
        let picture = name.and_then(|name| {
            let path = self.path.with_file_name(name);
            let read = read_file(&path).map_err(|error| error.to_string());
            let picture =
                read.and_then(|bytes| Picture::from_png(&bytes).map_err(|error| error.to_string()));
            picture
                .map_err(|error| {
                    note(format_args!("{}: {error}; the report has no picture", path.display()));
                })
                .ok()
        });
        self.result.reported(picture)
    }
}
