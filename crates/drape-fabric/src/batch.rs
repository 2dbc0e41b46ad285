//! The laws for many connectors side by side, in loops that are vectorised.
//!
//! A batch is [`LANES`](lanes::LANES) neighbouring connectors of one law; every quantity is an array
//! with one number per lane. All kernels follow one idiom: loops over the lanes of fixed length, in
//! straight arithmetic without branches, marked `#[inline(always)]`, so that they are compiled inside
//! the caller and for the vector instructions that the caller has selected (`drape-cloth` dispatches
//! with `pulp`). No intrinsics are written here, and no fused multiply-add is used, so the numbers do
//! not depend on the instructions.
//!
//! ```math
//! T(s) = T_e(s) + \sum_k \left[F_k(s) + \textstyle\sum_j \Delta F_{kj}(s)\right]
//! ```
//!
//! with the friction elements `$k$` and, for each knot `$j$` of the friction's weight that the path
//! passes, its contribution `$\Delta F_{kj}$`: where a scalar law cuts the path into pieces
//! ([`Law`](crate::Law)), a batch adds contributions.
//!
//! `lanes` holds the arrays, `memories` the connectors' memories in columns, `friction` the prepared
//! elements, `batch_law` the interface, `weighted_law` all that laws with a plateau share, `traction`,
//! `bending` and `shear` the rest. `tests/batch.rs` holds each to its scalar law.

pub(crate) mod batch_law;
pub(crate) mod bending;
pub(crate) mod friction;
pub(crate) mod lanes;
pub(crate) mod memories;
pub(crate) mod shear;
pub(crate) mod traction;
pub(crate) mod weighted_law;
