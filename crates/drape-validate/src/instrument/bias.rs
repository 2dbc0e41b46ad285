//! Ideal bending curve of a specimen cut at 45° to the yarns.
//!
//! Yarns at 45° to the axis of a cylinder have half of its curvature, so
//! `$M(\kappa) = \tfrac12(M_1(\kappa/2) + M_2(\kappa/2))$` with the moments `$M_1$`, `$M_2$` of the
//! two yarn systems. The cases of bending on the bias call this module.

use std::f64::consts::FRAC_1_SQRT_2;

use drape_fabric::{Fabric, Law, drive};
use drape_kes::{Curve, Direction, Test};

use super::cycle::{path, there_and_back};
use super::ideal::curve;

/// Returns the bending curve that the laws alone give for a specimen cut at 45° to the yarns. The
/// specimen is bent to both sides up to the curvature `largest`, in 1/m, with `points` points in a
/// branch.
///
/// Bent to a cylinder of the curvature `$\kappa$` about an axis at an angle `$\vartheta$` to a yarn
/// system, the yarns are helices, geodesics of the cylinder, with the curvature
/// `$\kappa\sin^2\vartheta$`. So yarns at 45° to the axis bend by `$\kappa/2$`, the energy per area
/// is `$U_1(\kappa/2) + U_2(\kappa/2)$`, and the moment per width its derivative,
///
/// ```math
/// M(\kappa) = \tfrac12\left(M_1(\kappa/2) + M_2(\kappa/2)\right)
/// ```
///
/// friction included, since the friction of each system does its work on the curvature of that
/// system. With linear laws the rigidity is `$B = \tfrac14(B_1 + B_2)$`. An orthotropic plate,
/// `$B_1 c^4 + B_2 s^4 + 2Hc^2s^2$`, is stiffer by `$\tfrac12 H$`. Here yarns twist freely, and
/// `$H = 0$`.
///
/// # Errors
/// As [`ideal`](super::ideal()).
pub fn on_the_bias(
    fabric: &Fabric,
    largest: f64,
    points: usize,
) -> Result<Curve, drape_kes::Error> {
    let path = path(&there_and_back(largest), points);
    let halves: Vec<f64> = path.iter().map(|curvature| 0.5 * curvature).collect();
    let [warp, weft] = yarn_moments(fabric, &halves);
    let load = warp.into_iter().zip(weft).map(|(warp, weft)| 0.5 * (warp + weft)).collect();
    curve(Test::Bending, Direction::Warp, path, load)
}

/// Returns the curve of [`on_the_bias`] for a sheet of square cells with sides of `spacing`, in m,
/// along the yarns. Such a sheet bends only by folds along the diagonals of its cells.
///
/// Rows of particles are `$d = h/\sqrt2$` apart and turn by `$\alpha = \kappa d$`. The yarns turn
/// by `$2\arcsin(\sin\frac\alpha2/\sqrt2)$`, which is `$\kappa h/2$` to the third order. In the two
/// corners of a cell at the ends of its fold, the yarns meet at an angle whose sine is
/// `$\frac12(1 - \cos\alpha)$`, where a sheet has a right angle. So cells also resist with the
/// shear law. With linear laws the moment is larger by
///
/// ```math
/// \frac{\Delta M}{M} = \frac{G\kappa^2h^4}{16(B_1 + B_2)}
/// ```
///
/// which is a fifth at 2.5 cm⁻¹ and 2.4 mm, and of the fourth order in the spacing.
///
/// # Errors
/// As [`ideal`](super::ideal()).
pub fn on_the_bias_in_cells(
    fabric: &Fabric,
    spacing: f64,
    largest: f64,
    points: usize,
) -> Result<Curve, drape_kes::Error> {
    let path = path(&there_and_back(largest), points);

    // Sines of half the turn from row to row, turns of the yarns, and sines of the shear angles.
    let row = spacing * FRAC_1_SQRT_2;
    let half_sines: Vec<f64> = path.iter().map(|curvature| (0.5 * curvature * row).sin()).collect();
    let turns: Vec<f64> =
        half_sines.iter().map(|sin| 2.0 / spacing * (FRAC_1_SQRT_2 * sin).asin()).collect();
    let sines: Vec<f64> = half_sines.iter().map(|sin| sin * sin).collect();

    // The moment is the derivative of the energy by the curvature.
    let [warp, weft] = yarn_moments(fabric, &turns);
    let shear = drive(&fabric.shear, fabric.shear.virgin(), &sines);
    let load = half_sines
        .iter()
        .zip(warp.iter().zip(weft))
        .zip(shear)
        .map(|((sin, (warp, weft)), shear)| {
            let cos = (1.0 - sin * sin).sqrt();
            // Derivatives of the yarns' curvature and of the sine in half of the corners.
            let (turning, leaning) = (0.5 * cos / (1.0 - 0.5 * sin * sin).sqrt(), row * sin * cos);
            (warp + weft) * turning + 0.5 * shear * leaning
        })
        .collect();
    curve(Test::Bending, Direction::Warp, path, load)
}

/// Returns the moments per width, in N, that [`on_the_bias`] gives at `curvatures`, in 1/m. The
/// specimen goes through `curvatures` in order and starts flat.
pub(crate) fn on_the_bias_along(fabric: &Fabric, curvatures: &[f64]) -> Vec<f64> {
    let halves = curvatures.iter().map(|curvature| 0.5 * curvature);
    let halves: Vec<f64> = std::iter::once(0.0).chain(halves).collect();
    let [warp, weft] = yarn_moments(fabric, &halves);
    warp[1..].iter().zip(&weft[1..]).map(|(warp, weft)| 0.5 * (warp + weft)).collect()
}

/// Returns the moments per width of warp and weft, in N, along a `path` of curvatures, in 1/m.
fn yarn_moments(fabric: &Fabric, path: &[f64]) -> [Vec<f64>; 2] {
    [fabric.warp.bending, fabric.weft.bending].map(|law| drive(&law, law.virgin(), path))
}
