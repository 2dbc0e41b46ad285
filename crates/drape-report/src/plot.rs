//! Plots as SVG: small, sharp in print, readable without the page around them.
//!
//! Each function takes plain data and gives the text of one SVG file. The same plots stand in the pages of
//! [`FitPage`](crate::FitPage) and [`ComparePage`](crate::ComparePage), where they follow the page's light
//! or dark colours; alone they are dark on white.

mod axis;
mod correlation;
mod frame;
mod graph;
mod loop_plot;
mod overlay;
mod uncertainty;

pub use axis::Axis;
pub use correlation::{Correlation, correlation_svg};
pub use graph::{GraphPlot, GraphSeries, Look, graph_svg};
pub use loop_plot::{Branch, BranchKind, LoopPlot, Point, loop_svg};
pub use overlay::{OverlayPlot, Trace, overlay_svg};
pub use uncertainty::{UncertaintyPlot, uncertainty_svg};

pub(crate) use correlation::{correlation_figure, correlation_side};
pub(crate) use graph::graph_figure;
pub(crate) use loop_plot::loop_figure;
pub(crate) use overlay::overlay_figure;
pub(crate) use uncertainty::uncertainty_figure;

/// Where a figure will stand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Place {
    /// In a file of its own, which needs its own style and namespace.
    Alone,
    /// In a page that holds the style.
    InPage,
}

impl Place {
    /// The style that a figure must bring along.
    pub(crate) fn style(self) -> Option<&'static str> {
        (self == Self::Alone).then_some(STYLE)
    }
}

/// The style of all figures, in colours that a plain SVG reader understands.
pub(crate) const STYLE: &str = include_str!("../templates/plot.css");
