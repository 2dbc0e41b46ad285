//! Files from bytes: read, and used as the program uses them.

use std::fs;
use std::path::{Path, PathBuf};

use drape::fit::identify;
use drape::kes::{Sheet, SheetDraft};
use tempfile::TempDir;

use crate::mutation::{Random, mutated};
use crate::readers;

/// Writes bytes to a file in a folder of its own.
fn written(name: &str, bytes: &[u8]) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join(name);
    fs::write(&path, bytes).expect("written");
    (folder, path)
}

pub fn scene(bytes: &[u8]) {
    readers::scene(&String::from_utf8_lossy(bytes), readers::FABRIC);
}

pub fn fabric(bytes: &[u8]) {
    readers::fabric(&String::from_utf8_lossy(bytes));
}

/// A table of a curve, beside the sheet that names it; what is accepted is fitted.
pub fn table(bytes: &[u8]) {
    let (folder, _) = written("bending.csv", bytes);
    let path = folder.path().join("sheet.toml");
    fs::write(&path, readers::SHEET).expect("written");
    if let Ok(sheet) = Sheet::read(&path)
        && let Ok(fitted) = identify(&sheet)
    {
        let text = fitted.fabric.to_toml();
        assert!(readers::fabric(&text), "a fitted fabric cannot be read:\n{text}");
    }
}

/// A sheet of values and one curve, which is fitted if it is accepted.
pub fn sheet(bytes: &[u8]) {
    let (folder, path) = written("sheet.toml", bytes);
    fs::write(folder.path().join("bending.csv"), readers::CURVE).expect("written");
    if let Ok(sheet) = Sheet::read(&path) {
        let _ = identify(&sheet);
    }
}

/// A table or a workbook, which is drafted as sheets; sheets that are accepted are fitted.
pub fn draft(name: &str, bytes: &[u8]) {
    let Ok(drafts) = SheetDraft::from_bytes(name, bytes) else { return };
    for draft in drafts.iter().take(3) {
        if let Ok(sheet) = draft.read(Path::new("")) {
            let _ = identify(&sheet);
        }
    }
}

/// Names of the files of a run.
const RUN_FILES: [&str; 9] = [
    "bodies-00000.npy",
    "body-triangles.npy",
    "energy.csv",
    "frame-00000.npy",
    "frame-00001.npy",
    "frames.csv",
    "material.npy",
    "surfaces.json",
    "triangles.npy",
];

/// Returns the number of a file of a run, and its mutated bytes.
pub fn damaged_run(seed: u64) -> Vec<u8> {
    let number = Random(seed).below(RUN_FILES.len());
    let run = Path::new(env!("CARGO_MANIFEST_DIR")).join("run");
    let bytes = fs::read(run.join(RUN_FILES[number])).expect("a file of the run");
    [vec![number as u8], mutated(&bytes, seed)].concat()
}

/// Frames of a run, the file of which that the first byte names has the other bytes.
pub fn run(bytes: &[u8]) {
    let Some((number, bytes)) = bytes.split_first() else { return };
    frames(RUN_FILES[usize::from(*number) % RUN_FILES.len()], bytes);
}

pub fn pattern(name: &str, bytes: &[u8]) {
    let (_folder, path) = written(name, bytes);
    readers::pattern(&path);
}

pub fn mesh(name: &str, bytes: &[u8]) {
    let (_folder, path) = written(name, bytes);
    readers::mesh(&path);
}

pub fn point_cache(bytes: &[u8]) {
    let (_folder, path) = written("cache.pc2", bytes);
    readers::point_cache(&path);
}

/// Frames of a run, one file of which is replaced.
pub fn frames(name: &str, bytes: &[u8]) {
    let run = Path::new(env!("CARGO_MANIFEST_DIR")).join("run");
    let (folder, _) = written(name, bytes);
    for entry in fs::read_dir(run).expect("a run").flatten() {
        if entry.file_name() != name {
            fs::copy(entry.path(), folder.path().join(entry.file_name())).expect("copied");
        }
    }
    readers::frames(folder.path());
}
