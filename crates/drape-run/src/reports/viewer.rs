//! Viewer: runs as a page that turns, plays and measures them.

use drape_export::{Named, View};
use drape_frames::{Error, Recording};

/// Default of the largest size of a page, in megabytes.
pub const VIEWER_SIZE_MAX: f64 = 20.0;

/// Page of some runs.
pub struct ViewerPage {
    /// The page.
    pub html: String,
    /// Sentences on the runs of which the page shows fewer frames than they have.
    pub thinned: Vec<String>,
}

impl ViewerPage {
    /// Returns the page of the runs `recordings`, of at most `megabytes`.
    ///
    /// # Errors
    /// Frames that cannot be read.
    pub fn new(recordings: &[Recording], megabytes: f64) -> Result<ViewerPage, Error> {
        let names: Vec<String> = recordings.iter().map(name).collect();
        let named = names.iter().zip(recordings).map(|(name, recording)| Named { name, recording });
        let View { html, frames } =
            View::new(&named.collect::<Vec<_>>(), (1e6 * megabytes) as usize)?;
        let counts =
            frames.iter().zip(recordings).map(|(shown, all)| [shown.len(), all.frame_count()]);
        let thinned = counts.zip(&names).filter(|([shown, all], _)| shown < all);
        let thinned = thinned
            .map(|([shown, all], name)| format!("{shown} of the {all} frames of {name} are shown"))
            .collect();
        Ok(ViewerPage { html, thinned })
    }
}

/// Returns the name of the run `recording`, which is the name of its folder.
fn name(recording: &Recording) -> String {
    let Some(folder) = recording.folder() else { return "run".to_owned() };
    let whole = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
    whole.file_name().unwrap_or_default().to_string_lossy().into_owned()
}
