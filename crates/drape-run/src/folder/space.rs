//! Space: the memory and the disk that a run needs, and whether the disk has enough space.

use std::path::{Path, PathBuf};

use drape_input::size_in_words;
use drape_scene::{Needs, Scene};

use super::Error;

/// Returns the `needs` of a run, in words.
#[must_use]
pub fn describe_needs(needs: &Needs) -> String {
    let up_to = if needs.may_rest { "up to " } else { "" };
    format!(
        "a run takes about {} of memory, and {up_to}{} of disk for {up_to}{} frames",
        size_in_words(needs.memory),
        size_in_words(needs.disk()),
        needs.frames
    )
}

/// Refuses a run of `scene` whose results do not fit on the disk of `folder`.
///
/// # Errors
/// [`Error::Space`].
pub(super) fn check_space(scene: &Scene, folder: &Path) -> Result<(), Error> {
    let Some(free) = free(folder) else { return Ok(()) };
    let needed = scene.needs().disk_min();
    if needed <= free {
        return Ok(());
    }
    Err(Error::Space { folder: folder.to_owned(), needed, free })
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn space_is_that_of_the_folder_above() {
        let folder = std::env::temp_dir();
        let free = [folder.clone(), folder.join("not/there/yet")].map(|path| free(&path));
        assert!(free[0].is_some_and(|free| free > 0) && free[1].is_some());
    }
}
