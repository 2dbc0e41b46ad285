//! Outlines of a draped cloth: closed curves, and the folds in them.
//!
//! `shadow` is the area that light from straight above leaves dark. `section` cuts the cloth by a
//! horizontal plane. `harmonics` smooths a curve, and `folds` counts its maxima. Drapemeters read
//! the shadow. The cases of cloth on a cube read the section.

mod folds;
mod harmonics;
mod section;
mod shadow;

pub(crate) use folds::maxima;
pub(crate) use harmonics::Harmonics;
pub(crate) use section::{evenly, length, section};
pub(crate) use shadow::{Shadow, Surface};
