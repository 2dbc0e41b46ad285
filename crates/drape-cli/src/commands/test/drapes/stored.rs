//! Results of drapes in files: `NAME-drape.json`, with its picture and its shadow beside it.

use std::path::{Path, PathBuf};

use drape::input::Diagnostic;
use drape::render::Picture;
use drape::report::ReportedDrape;
use drape::report::plot::shadow_svg;
use drape::run::file;
use drape::run::reports::DrapeResult;

use super::run::Draped;
use crate::commands::sheets;
use crate::console::note;
use crate::failure::Failure;
use crate::pages::picture::SnapshotPictures;

/// End of the name of a result's file.
const RESULT_SUFFIX: &str = "-drape.json";

/// Width and height of the picture, in pixels.
const SIZE: [u32; 2] = [640, 480];

/// Largest file of a result and of a picture that is read, in bytes.
const FILE_MAX: u64 = 64 << 20;

/// Remedy for a file that is no result.
const REMEDY: &str = "write it with drape test FABRIC --drape --report FOLDER";

/// Files of a result.
pub(crate) struct DrapeFiles {
    pub(crate) result: PathBuf,
    pub(crate) picture: PathBuf,
    pub(crate) shadow: PathBuf,
}

/// Draws the picture of `draped`, if one was requested.
pub(crate) fn picture(draped: &Draped) -> Result<Option<Picture>, Failure> {
    let Some(snapshot) = &draped.snapshot else { return Ok(None) };
    SnapshotPictures::new(snapshot)?.draw([None, None], SIZE).map(Some)
}

/// Writes the result of `draped` with its picture and its shadow into `folder`. The names of the
/// files begin with `name`.
pub(crate) fn store(draped: &Draped, folder: &Path, name: &str) -> Result<DrapeFiles, Failure> {
    let [result, png, svg] = [RESULT_SUFFIX, "-drape.png", "-drape-shadow.svg"]
        .map(|end| folder.join(format!("{name}{end}")));
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
    Ok(DrapeFiles { result, picture: png, shadow: svg })
}

/// Result that was read from a file.
pub(crate) struct StoredDrape {
    path: PathBuf,
    pub(crate) result: DrapeResult,
}

/// Reads the results at `paths`, which are files or folders. With `may_be_empty` a missing or empty
/// folder is no mistake.
pub(crate) fn read(paths: &[PathBuf], may_be_empty: bool) -> Result<Vec<StoredDrape>, Failure> {
    let mut stored = Vec::new();
    for path in paths {
        if !path.is_dir() && !path.exists() && may_be_empty {
            continue;
        }
        let files = if path.is_dir() { results_in(path)? } else { vec![path.clone()] };

        if files.is_empty() && !may_be_empty {
            let message = format!("holds no results of drapes (*{RESULT_SUFFIX})");
            return Err(Failure::Input(Diagnostic::new(path, message).help(REMEDY).into()));
        }
        for file in files {
            stored.push(read_result(&file)?);
        }
    }
    Ok(stored)
}

/// Returns the files of results in `folder`, sorted by name.
fn results_in(folder: &Path) -> Result<Vec<PathBuf>, Failure> {
    let mut files = sheets::entries(folder)?;
    files.retain(|path| {
        path.file_name().unwrap_or_default().to_string_lossy().ends_with(RESULT_SUFFIX)
    });
    files.sort();
    Ok(files)
}

fn read_result(path: &Path) -> Result<StoredDrape, Failure> {
    match parse_result(path) {
        Ok(result) => Ok(StoredDrape { path: path.to_owned(), result }),
        Err(message) => Err(Failure::Input(Diagnostic::new(path, message).help(REMEDY).into())),
    }
}

fn parse_result(path: &Path) -> Result<DrapeResult, String> {
    let bytes = read_file(path).map_err(|error| format!("cannot be read: {error}"))?;
    let result: DrapeResult = serde_json::from_slice(&bytes)
        .map_err(|error| format!("is no result of drape test --drape: {error}"))?;
    let reported = result.reported(None).ok_or("has no specimens")?;
    // The page would refuse such a shadow without the name of the file.
    shadow_svg(&reported.shadow).map_err(|error| error.to_string())?;
    Ok(result)
}

/// Reads the file at `path`, or fails if it is larger than [`FILE_MAX`].
fn read_file(path: &Path) -> std::io::Result<Vec<u8>> {
    let size = std::fs::metadata(path)?.len();
    if size > FILE_MAX {
        return Err(std::io::Error::other(format!("it has {size} bytes")));
    }
    std::fs::read(path)
}

impl StoredDrape {
    /// Returns the path of the result's file.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Returns the [`ReportedDrape`] with the picture beside the result. A missing picture gives a
    /// note.
    pub(crate) fn reported(&self) -> Option<ReportedDrape> {
        let name = self.result.picture.as_deref().map(Path::new).and_then(Path::file_name);
        let picture = name.and_then(|name| {
            let path = self.path.with_file_name(name);
            let bytes = read_file(&path).map_err(|error| error.to_string());
            bytes
                .and_then(|bytes| Picture::from_png(&bytes).map_err(|error| error.to_string()))
                .map_err(|error| {
                    note(format_args!("{}: {error}; the report has no picture", path.display()));
                })
                .ok()
        });
        self.result.reported(picture)
    }
}
