//! Figure: girths of a body as a tape measures them, and of a garment round it.
//!
//! `trunk` has the section of a body without its arms, `landmark` finds bust, waist and hip,
//! `cloth_section` cuts a garment, and `ease` compares the girths of body and garment. The check of
//! a scene and the measures of a run use this chapter. Nothing here reads a file or changes a
//! scene.

pub(crate) mod cloth_section;
pub(crate) mod ease;
pub(crate) mod landmark;
#[cfg(test)]
mod test_bodies;
pub(crate) mod trunk;
