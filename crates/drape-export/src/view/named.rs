//! Run with a name.

use drape_frames::Recording;

/// Run with the name that the page gives it.
#[derive(Debug, Clone, Copy)]
pub struct Named<'a> {
    /// Name.
    pub name: &'a str,
    /// Run.
    pub recording: &'a Recording,
}
