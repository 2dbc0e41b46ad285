//! Space: the memory and the disk that a run needs, and whether the disk has enough space.

use std::path::{Path, PathBuf};

use drape_input::{Diagnostic, Diagnostics};
use drape_scene::{Needs, Scene};

/// Returns the `needs` of a run, in words.
#[must_use]
pub fn describe_needs(needs: &Needs) -> String {
    let up_to = if needs.may_rest { "up to " } else { "" };
    format!(
        "a run takes about {} of memory, and {up_to}{} of disk for {up_to}{} frames",
        in_words(needs.memory),
        in_words(needs.disk()),
        needs.frames
    )
}

/// Refuses a run of `scene` whose results do not fit on the disk of `folder`.
pub(super) fn check_space(scene: &Scene, folder: &Path) -> Result<(), Diagnostics> {
    let Some(free) = free(folder) else { return Ok(()) };
    let needs = scene.needs();
    if needs.disk_min() <= free {
        return Ok(());
    }
    let message = format!(
        "the frames take {} of disk, and {} are free in {}",
        in_words(needs.disk_min()),
        in_words(free),
        folder.display()
    );
    let help = "name another folder with -o, or write fewer frames: a larger output.every or a larger spacing";
    Err(Diagnostic::new(&scene.source.file, message).help(help).into())
}

/// Returns the free space of the disk that has or would have `folder`, in bytes. Returns `None` if
/// the system does not report it.
fn free(folder: &Path) -> Option<u64> {
    let folder = std::path::absolute(folder).ok()?;
    let existing: PathBuf = folder.ancestors().find(|path| path.is_dir())?.to_owned();
    let statistics = rustix::fs::statvfs(&existing).ok()?;
    // Some file systems do not count their blocks.
    (statistics.f_blocks > 0).then(|| statistics.f_bavail.saturating_mul(statistics.f_frsize))
}

/// Returns a size in `bytes` in words.
fn in_words(bytes: u64) -> String {
    let bytes = bytes as f64;
    match bytes {
        ..1e6 => format!("{:.0} kB", (1e-3 * bytes).ceil()),
        ..1e9 => format!("{:.0} MB", 1e-6 * bytes),
        _ => format!("{:.1} GB", 1e-9 * bytes),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn space_is_that_of_the_folder_above() {
        let folder = std::env::temp_dir();
        let free = [folder.clone(), folder.join("not/there/yet")].map(|path| free(&path));
        assert!(free[0].is_some_and(|free| free > 0) && free[1].is_some());
        assert_eq!([999, 2_500_000, 3_200_000_000].map(in_words), ["1 kB", "2 MB", "3.2 GB"]);
    }
}
