//! Pictures: pixels in sRGB, and legends, letters and animations of pictures.
//! [`pixels`] holds the rows of a picture and writes PNG, `animation` writes successive pictures.
//! `colour` converts sRGB and linear light, `scale` has the colours of values. `lettering` writes
//! on a picture, `legend` draws a scale of colours below it, and `swatches` draws colours with
//! their names below it. The chapter knows nothing of scenes, plots or pages.

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
