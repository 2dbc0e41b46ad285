//! Files from bytes: read, and used as the program uses them.

use std::fs;
use std::path::{Path, PathBuf};

use drape::fit::identify;
use drape::kes::Sheet;
use tempfile::TempDir;

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
