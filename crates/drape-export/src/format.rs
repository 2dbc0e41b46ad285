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

/// Returns a count as a signed number of 32 bits.
fn count(format: &'static str, what: &'static str, found: usize) -> Result<i32, Error> {
    let limit = i32::MAX as usize;
    i32::try_from(found).map_err(|_| Error::TooLarge { format, what, found, limit })
}
