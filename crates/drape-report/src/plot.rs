//! Plots as SVG: self-contained, sharp in print.
//!
//! Each `…_svg` function takes plain data in SI, checks it, and returns the text of one SVG file,
//! dark on white. The pages contain these figures in the light or dark colours of the page.
//!
//! `axis` and `scale` map values to pixels. `legend` and `chart` are the parts that all plots over
//! two axes share, which are `loop_plot`, `graph` and `overlay`. `correlation`, `uncertainty`,
//! `strain_map`, `seam_key` and `shadow` have other layouts. `svg` writes path data, `style` holds
//! the style sheet. The templates are in `templates/plot`. Pixel coordinates fill the templates,
//! because plots need fractions of a pixel in print and classes that follow the colours of the
//! page.

mod axis;
mod chart;
mod correlation;
mod graph;
mod legend;
mod loop_plot;
mod overlay;
mod scale;
mod seam_key;
mod shadow;
mod strain_map;
mod style;
mod svg;
mod uncertainty;

pub use axis::Axis;
pub use correlation::{CorrelatedPair, Correlation, correlation_svg};
pub use graph::{GraphPlot, GraphSeries, Look, graph_svg};
pub use loop_plot::{Branch, BranchKind, LoopPlot, Mark, Point, loop_svg};
pub use overlay::{OverlayPlot, Trace, overlay_svg};
pub use seam_key::{SeamKey, seams_svg};
pub use shadow::{ShadowPlot, shadow_svg};
pub use strain_map::{StrainMap, strain_svg};
pub use uncertainty::{UncertaintyPlot, uncertainty_svg};

pub(crate) use correlation::{correlation_figure, correlation_side};
pub(crate) use graph::graph_figure;
pub(crate) use loop_plot::loop_figure;
pub(crate) use overlay::{COLOURS, overlay_figure};
pub(crate) use shadow::shadow_figure;
pub(crate) use style::{Placement, STYLE};
pub(crate) use uncertainty::uncertainty_figure;
