//! The whole fabric from a sheet, and many fabrics at once.
//!
//! Curves come before values, and values before defaults. A law that is missing in one direction is
//! taken from the other direction, and every default is named in the result.
//! [`identify`](identify::identify) runs the fits of `curves` in parallel, fills the rest from
//! `values`, and checks the fabric.
//!
//! * `laws`: each law from curves or values, with notes.
//! * `keys`, `scatter`, `measured_range`: provenance: standard errors by key, from curves and from
//!   the scatter of values, and the largest measured deformations.
//! * `identify`: one sheet; `batch`: many.

pub(crate) mod batch;

pub(crate) mod identify;
pub(crate) mod keys;
pub(crate) mod laws;
pub(crate) mod measured_range;
pub(crate) mod scatter;
