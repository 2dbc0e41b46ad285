//! Figure: girths of a body as a tape measures them, and of a garment round it.
//!
//! `trunk` has the section of a body without its arms, `landmark` finds bust, waist and hip by height
//! and girth, `cloth_section` cuts a garment, and `ease` holds the two against each other. The check of a
//! scene and the measures of a run use them. Nothing here reads a file or changes a scene.

pub(crate) mod cloth_section;
pub(crate) mod ease;
pub(crate) mod landmark;
#[cfg(test)]
mod test_bodies;
pub(crate) mod trunk;
