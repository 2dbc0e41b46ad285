//! Writing of patterns: the project's TOML (`toml_text`), and drawings in SVG at true scale for a
//! plotter (`svg`) or on pages of paper (`pages`), and in DXF for programs of pattern makers
//! (`dxf`, with its texts in `dxf_text`). Drawings of cuts (`figure`), and of sketches with their
//! mistakes (`sketch_figure`). `marks` draws notches and names on a panel, `grain_line` finds room
//! for its grain line, `number` formats numbers.

mod dxf;
mod dxf_text;
mod figure;
mod grain_line;
mod layout;
mod marks;
mod number;
mod pages;
mod sketch_figure;
mod svg;
mod text_anchor;
mod toml_text;

pub use dxf::DxfDrawing;
pub(crate) use dxf_text::decoded;
pub use figure::{figure, seam_colour};
pub(crate) use number::as_written;
pub use pages::{Page, Paper};
