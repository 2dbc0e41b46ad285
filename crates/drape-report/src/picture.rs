//! Pictures: pixels in sRGB, and what is put on them.
//!
//! [`pixels`] holds the rows of a picture and writes PNG, `animation` writes pictures that follow each
//! other. `colour` converts sRGB and linear light, `scale` has the colours of values; `lettering`
//! writes on a picture, `legend` draws a scale of colours below it, `swatches` colours with their names. The chapter knows nothing of
//! scenes, plots or pages.

mod animation;
mod colour;
mod legend;
mod lettering;
mod pixels;
mod scale;
mod swatches;

pub use animation::Animation;
pub use colour::{Colour, diverging};
pub(crate) use colour::{decode, encode};
pub use legend::Legend;
pub use pixels::Picture;
pub use scale::ColourScale;
pub use swatches::Swatches;
