//! Rim of a panel: traction and shear of the triangles between the full cells and the outline, and
//! between cells of two sizes, and bending where no triple of a grid has its middle.
//!
//! ```text
//!    ┌───┬───┬──╱        ┌┐  full cells: `kernel`
//!    │   │   │ ╱ ╲       ╱╲  triangles of the rim: traction along warp and weft, and shear
//!    ├───┼───●────╲
//!    │   │   │╲    ╲      ●  a node that is the middle of a triple along one yarn only:
//!    ├───┼───┼─╲───╱         bending along the other by a stencil of the 9 to 14 nearest nodes
//! ```
//!
//! A triangle's deformation gradient takes the warp to `$p = \sum_i r_i x_i$` and the weft to
//! `$q = \sum_i s_i x_i$`. The measures are `$|p| - 1$`, `$|q| - 1$` and `$\hat p\cdot\hat q$`. A
//! stencil's second difference is `$b = \sum_i b_i x_i$`, the second derivative of the quadratic
//! that fits its nodes best. The rim has the laws, memories and rules of a step of the grid:
//!
//! ```math
//! f_i = -W\,T\,\frac{\partial s}{\partial x_i}
//! ```
//!
//! `neighbourhood` chooses the nodes of a fit, `quadratic_fit` computes weights, and `fits` applies
//! both to a panel. `triangles` and `stencils` are the connectors in batches, with their measures.
//! `connectors` is a panel's rim. `forces`, `energy` and `stiffness` are the kernels, and
//! `memories` what they write. `reference::{triangle, stencil}` compute the same one by one; they
//! share only the weights of the fits.

pub(crate) mod connectors;
pub(crate) mod energy;
pub(crate) mod fits;
pub(crate) mod forces;
pub(crate) mod memories;
pub(crate) mod neighbourhood;
pub(crate) mod quadratic_fit;
pub(crate) mod stencils;
pub(crate) mod stiffness;
pub(crate) mod triangles;
