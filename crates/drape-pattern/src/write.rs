//! Writing of patterns: the project's TOML (`toml_text`), and drawings in SVG at true scale for a
//! plotter (`svg`) or on pages of paper (`pages`). Drawings of cuts (`figure`), and of sketches
//! with their mistakes (`sketch_figure`). `marks` draws grain, notches and names on a panel,
//! `number` formats numbers.

mod figure;
mod layout;
mod marks;
mod number;
mod pages;
mod sketch_figure;
mod svg;
mod text_anchor;
mod toml_text;

pub use figure::{figure, seam_colour};
pub(crate) use number::as_written;
pub use pages::{Page, Paper};
