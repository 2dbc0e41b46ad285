//! Outlines of a draped cloth: closed curves, and the folds in them.
//!
//! `shadow` is what light from straight above leaves dark; `section` cuts the cloth by a horizontal
//! plane. `harmonics` smooths either curve, and `folds` counts its maxima. Drapemeters read the
//! shadow, the cases of cloth on a cube the section.

mod folds;
mod harmonics;
mod section;
mod shadow;

pub(crate) use folds::maxima;
pub(crate) use harmonics::Harmonics;
pub(crate) use section::{evenly, length, section};
pub(crate) use shadow::{Shadow, Surface};
