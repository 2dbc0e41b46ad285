//! Data layout of a cloth: which particles a connector joins, its area, and the arrays that the
//! kernels read.
//!
//! The connectors of a kind (warp or weft segments, one of four corners, warp or weft triples) form
//! columns with one number per grid point, row by row. Neighbours along a yarn are a fixed step
//! apart, so no index lists are needed. For every kind
//!
//! ```math
//! \sum W = A_{panel}
//! ```
//!
//! `connectors` computes the areas. `columns` holds the arrays and reads them a batch at a time.
//! `grid` is a panel in this form, `strip` a run of its points that is evaluated at once,
//! `sparsity` the blocks of the stiffness matrix, `fingerprint` tells one cloth from another.
//! `Cloth::new` builds all of it once, and `kernel` reads it.

pub(crate) mod columns;
pub(crate) mod connectors;
pub(crate) mod fingerprint;
pub(crate) mod grid;
pub(crate) mod sparsity;
pub(crate) mod strip;
