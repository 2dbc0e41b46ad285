//! Formats: one module each, with the function that writes it.

pub(crate) mod glb;
pub(crate) mod mdd;
pub(crate) mod npz;
pub(crate) mod obj;
pub(crate) mod pc2;
pub(crate) mod svg;
pub(crate) mod table;
pub(crate) mod usda;
pub(crate) mod vtk;

use crate::error::Error;

/// Returns `count`, a number of `items` that `format` stores, as a signed number of 32 bits.
fn signed_count(format: &'static str, items: &'static str, count: usize) -> Result<i32, Error> {
    let limit = i32::MAX as usize;
    i32::try_from(count).map_err(|_| Error::TooLarge { format, what: items, found: count, limit })
}
