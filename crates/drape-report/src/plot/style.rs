//! Placement of figures, and the style that they share.

/// Style of all figures, in colours that a plain SVG reader understands.
pub(crate) const STYLE: &str = include_str!("../../templates/plot/plot.css");

/// Placement of a figure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Placement {
    /// In a separate file, which needs the style and the namespace.
    Standalone,
    /// In a page that holds the style.
    InPage,
}

impl Placement {
    /// Returns the style that a figure must include, [`STYLE`] if it is [`Placement::Standalone`].
    pub(crate) fn style(self) -> Option<&'static str> {
        (self == Self::Standalone).then_some(STYLE)
    }
}
