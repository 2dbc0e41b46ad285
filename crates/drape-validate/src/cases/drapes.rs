//! Cases of drapes: whole cloths against published experiments.
//!
//! Drape coefficients are compared with measurements on the FRL drapemeter \[Mat15\], and between
//! grids and starts. Cloths on a cube are compared with the observations of a paper on three
//! fabrics \[BHW94\].

mod breen;
mod coefficient;
mod cube;
mod grid;
mod sensitivity;
mod shadows;

pub(crate) use breen::{coarse_cube, cubes};
pub(crate) use coefficient::{cotton, wool};
pub(crate) use grid::{grid_of_cotton, grid_of_wool};
pub(crate) use sensitivity::{sensitivity_of_cotton, sensitivity_of_wool};

use drape_fabric::Fabric;

use crate::drapemeter::{Study, spacing_bound};

/// Starts of a study.
const STARTS: u64 = 10;

/// Returns `part` of the spacing that `fabric` needs on a drapemeter, but at most 5 mm; in m.
fn spacing(fabric: &Fabric, part: f64) -> f64 {
    /// Largest spacing of the particles on a drapemeter, in m.
    const SPACING_MAX: f64 = 0.005;
    (part * spacing_bound(fabric)).min(SPACING_MAX)
}

/// Returns the mean drape coefficient of `study` in points, which are hundredths.
fn points(study: &Study) -> f64 {
    100.0 * study.mean()
}
