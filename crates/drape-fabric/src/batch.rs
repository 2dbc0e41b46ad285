//! The laws for many connectors side by side, in vectorised loops.
//!
//! A batch is [`LANES`](lanes::LANES) neighbouring connectors of one law. Every quantity is an
//! array with one number per lane. All kernels follow one idiom: loops of fixed length over the
//! lanes, in arithmetic without branches. Kernels are marked `#[inline(always)]`, so that the
//! compiler builds them inside the caller, for the vector instructions that the caller has selected
//! (`drape-cloth` dispatches with `pulp`). The kernels contain no intrinsics and no fused
//! multiply-add, so the numbers do not depend on the instructions.
//!
//! ```math
//! T(s) = T_e(s) + \sum_k \left[F_k(s) + \textstyle\sum_j \Delta F_{kj}(s)\right]
//! ```
//!
//! with the friction elements `$k$`, and the contribution `$\Delta F_{kj}$` of each knot `$j$` of
//! the friction's weight that the path passes. A scalar law cuts the path into pieces
//! ([`Law`](crate::Law)). A batch adds contributions instead.
//!
//! `lanes` has the arrays, `memories` the memories of connectors in columns, `friction` the
//! prepared elements, `batch_law` the interface, and `weighted_law` the common part of all laws
//! with a plateau. `traction`, `bending` and `shear` are the three laws. `tests/batch.rs` compares
//! each law with its scalar form.

pub(crate) mod batch_law;
pub(crate) mod bending;
pub(crate) mod friction;
pub(crate) mod lanes;
pub(crate) mod memories;
pub(crate) mod shear;
pub(crate) mod traction;
pub(crate) mod weighted_law;
