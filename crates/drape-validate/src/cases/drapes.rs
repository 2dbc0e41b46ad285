//! Cases of drapes: whole cloths against published experiments.
//!
//! Drape coefficients are compared with measurements on the FRL drapemeter \[Mat15\], their grids and
//! starts with each other, and cloths on a cube with what a paper says of three fabrics \[BHW94\].

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

/// Starts of an evaluation, and of each row of the table of what matters.
const STARTS: u64 = 10;

/// Largest spacing of the particles on a drapemeter, in m.
const SPACING_MAX: f64 = 0.005;

/// Returns a part of the spacing that a fabric asks for, and [`SPACING_MAX`] at most, in m.
fn spacing(fabric: &Fabric, part: f64) -> f64 {
    (part * spacing_bound(fabric)).min(SPACING_MAX)
}

/// Returns the mean drape coefficient of a study, in points, hundredths.
fn points(study: &Study) -> f64 {
    100.0 * study.mean()
}
