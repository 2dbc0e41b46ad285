//! Pictures: pixels in sRGB, and what is put on them.
//!
//! [`pixels`] holds the rows of a picture and writes PNG, `colour` converts sRGB and linear light
//! and has the scales of values. The chapter knows nothing of scenes, plots or pages.

mod colour;
mod pixels;

pub use colour::{Colour, diverging};
pub(crate) use colour::{decode, encode};
pub use pixels::Picture;
