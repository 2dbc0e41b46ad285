//! Files of a run in its folder, which are found from its list of frames.

use std::fs;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use crate::error::Error;

/// Name of the file of the summary. A folder with this file holds results.
pub(crate) const SUMMARY: &str = "summary.json";

/// Name of the file of the topology.
pub(crate) const SURFACES: &str = "surfaces.json";

/// Name of the list of frames.
pub(crate) const FRAMES: &str = "frames.csv";

/// Names of the arrays of the topology.
pub(crate) const ARRAYS: [&str; 3] = ["material.npy", "triangles.npy", "body-triangles.npy"];

/// Name of the table of the energy balance at each frame.
pub(crate) const ENERGY: &str = "energy.csv";

/// Kinds of arrays that frames have. The names of their files begin with the kind.
const KINDS: [&str; 3] = ["frame", "bodies", "pressure"];

/// Files of which a run has at most one, including files of older versions and of the command line.
const SINGLE: [&str; 12] = [
    "run.json",
    "status.json",
    SUMMARY,
    SURFACES,
    FRAMES,
    ENERGY,
    "pressure.npy",
    "last.obj",
    "picture.png",
    "place.png",
    "strain.svg",
    "view.html",
];

/// Longest list of frames that is read, in bytes.
const LIST_MAX: u64 = 1 << 26;

/// Returns the files of a run in `folder`: single files, and the files of the listed frames and of
/// the frame that was being written. Other files do not belong to the run, whatever their names.
pub(crate) fn files(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let single = SINGLE.into_iter().chain(ARRAYS).map(str::to_owned);
    let numbered = frame_numbers(folder)?
        .into_iter()
        .flat_map(|number| KINDS.into_iter().map(move |kind| format!("{kind}-{number:05}.npy")));
    let paths = single.chain(numbered).map(|name| folder.join(name));
    Ok(paths.filter(|path| fs::symlink_metadata(path).is_ok()).collect())
}

/// Returns the files of the frames of the run in `folder` from the number `first` on.
pub(crate) fn frames_from(folder: &Path, first: u64) -> io::Result<Vec<PathBuf>> {
    let frame_numbers = frame_numbers(folder)?.into_iter().filter(|number| *number >= first);
    // The last frames may have been written but not listed.
    let frame_numbers = frame_numbers.chain([first, first.saturating_add(1)]);
    let names = frame_numbers
        .flat_map(|number| KINDS.map(|kind| folder.join(format!("{kind}-{number:05}.npy"))));
    let mut paths: Vec<PathBuf> = names.filter(|path| fs::symlink_metadata(path).is_ok()).collect();
    paths.sort();
    paths.dedup();
    Ok(paths)
}

/// Removes `files`. For a symbolic link, the link is removed and not its target.
///
/// # Errors
/// [`Error::Write`] for the first file that cannot be removed.
pub(crate) fn remove(files: &[PathBuf]) -> Result<(), Error> {
    // The list is removed last, because the remaining files are found from it.
    let (list, others): (Vec<_>, Vec<_>) =
        files.iter().partition(|path| path.file_name().is_some_and(|name| name == FRAMES));
    let mut all = others.into_iter().chain(list);
    all.try_for_each(|path| fs::remove_file(path).map_err(|error| Error::unwritable(path, &error)))
}

/// Returns the numbers of the frames in `folder`, and the number after them.
fn frame_numbers(folder: &Path) -> io::Result<Vec<u64>> {
    let path = folder.join(FRAMES);
    // A link or a pipe in place of the list is removed, not read.
    if !fs::symlink_metadata(&path).is_ok_and(|found| found.is_file()) {
        return Ok(Vec::new());
    }
    let mut text = Vec::new();
    fs::File::open(&path)?.take(LIST_MAX).read_to_end(&mut text)?;
    let text = String::from_utf8_lossy(&text);
    let listed = text.lines().filter_map(|line| line.split(',').next()?.parse().ok());
    let mut numbers: Vec<u64> = listed.collect();
    numbers.push(numbers.last().map_or(0, |last| last.saturating_add(1)));
    Ok(numbers)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_files_of_the_run_are_removed() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let at = |name: &str| folder.path().join(name);
        let written = ["frames.csv", "frame-00000.npy", "bodies-00000.npy", "frame-00001.npy"];
        let others = ["frame-mine.npy", "frame-00007.npy", "notes.txt", "pressure-a.npy"];
        for name in written.into_iter().chain(others) {
            fs::write(at(name), "").expect("written");
        }
        fs::write(at("frames.csv"), "number,time\n0,0.0\n").expect("written");
        remove(&files(folder.path()).expect("listed")).expect("removed");
        for (names, there) in [(&written, false), (&others, true)] {
            for name in names {
                assert_eq!(at(name).exists(), there, "{name}");
            }
        }
    }

    #[cfg(unix)]
    #[test]
    fn of_a_link_the_link_is_removed() {
        let folders = [(); 2].map(|()| tempfile::tempdir().expect("a temporary folder"));
        let kept = folders[1].path().join("kept.csv");
        fs::write(&kept, "0,0\n").expect("written");
        let link = folders[0].path().join("frames.csv");
        std::os::unix::fs::symlink(&kept, &link).expect("linked");
        remove(&files(folders[0].path()).expect("listed")).expect("removed");
        assert!(kept.exists() && fs::symlink_metadata(&link).is_err());
    }
}
