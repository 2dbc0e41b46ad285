//! Style and script that every page includes.

/// Style of pages.
pub(crate) const PAGE_STYLE: &str = include_str!("../../templates/page/page.css");

/// Script of pages: values under the pointer, and branches switched on and off. Pages are complete
/// without it.
pub(crate) const PAGE_SCRIPT: &str = include_str!("../../templates/page/page.js");
