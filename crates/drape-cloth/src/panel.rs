//! Panels before deformation: a grid of particles along the yarns, cut to an outline.
//!
//! Material coordinates are `u` along the weft and `v` along the warp. A panel's particles are the
//! nodes of a grid along its yarns. Every cell has the exact area of the panel within it,
//!
//! ```math
//! A = \sum_{\text{cells}}\sum_{k=1}^{4} A_k + \sum_{\text{rim}} A_t
//! ```
//!
//! Masses and connector areas follow from these areas. `lattice` is the panel. `cut` makes
//! rectangles, discs and rings. `mesh` takes panels that were cut elsewhere (`drape-pattern`), with
//! a rim of triangles. `graded` joins cells of a panel to larger ones, each size on its `grid`, by
//! a `numbering`. `grain` relates the yarns to the panel's frame. `fold` and `folded` bend a panel
//! at rest along lines. `interpolation` relates two grids of a panel. `allowance` adds mass along
//! an outline. `clip` and `triangle` are plane geometry.
//!
//! Readers of scenes make panels and pass them to `Cloth::new`. Panels do not move and have no
//! laws.

pub(crate) mod allowance;
pub(crate) mod clip;
pub(crate) mod cut;
pub(crate) mod fold;
pub(crate) mod folded;
pub(crate) mod graded;
pub(crate) mod grain;
pub(crate) mod grid;
pub(crate) mod interpolation;
pub(crate) mod lattice;
pub(crate) mod mesh;
pub(crate) mod numbering;
pub(crate) mod triangle;
