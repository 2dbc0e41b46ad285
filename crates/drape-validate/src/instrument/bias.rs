//! Ideal bending curve of a specimen cut at 45° to the yarns.
//!
//! Yarns at 45° to the axis of a cylinder have half of its curvature, so
//! `$M(\kappa) = \tfrac12(M_1(\kappa/2) + M_2(\kappa/2))$` with the moments `$M_1$`, `$M_2$` of the
//! two yarn systems. The cases of bending on the bias call it.

use std::f64::consts::FRAC_1_SQRT_2;

use drape_fabric::{Fabric, Law, drive};
use drape_kes::{Curve, Direction, Test};

use super::cycle::{path, there_and_back};
use super::ideal::curve;

/// The curve of a specimen cut at 45° to the yarns that is bent to both sides up to a curvature, in
/// 1/m: the laws alone.
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
/// system. With linear laws it is `$B = \tfrac14(B_1 + B_2)$`. An orthotropic plate,
/// `$B_1 c^4 + B_2 s^4 + 2Hc^2s^2$`, has `$\tfrac12 H$` more: here yarns twist freely, `$H = 0$`.
///
/// # Panics
/// As [`ideal`](super::ideal()).
#[must_use]
pub fn on_the_bias(fabric: &Fabric, largest: f64, points: usize) -> Curve {
    let path = path(&there_and_back(largest), points);
    let halves: Vec<f64> = path.iter().map(|curvature| 0.5 * curvature).collect();
    let [warp, weft] = bent(fabric, &halves);
    let load = warp.into_iter().zip(weft).map(|(warp, weft)| 0.5 * (warp + weft)).collect();
    curve(Test::Bending, Direction::Warp, path, load).expect("a checked fabric has finite loads")
}

/// The same of a sheet of square cells, `spacing` in m along the yarns, which it can only bend by
/// folding them along their diagonals.
///
/// Rows of particles are `$d = h/\sqrt2$` apart and turn by `$\alpha = \kappa d$`. The yarns turn
/// by `$2\arcsin(\sin\frac\alpha2/\sqrt2)$`, which is `$\kappa h/2$` to the third order; but in the
/// two corners of a cell at the ends of its fold the yarns meet at an angle whose sine is
/// `$\frac12(1 - \cos\alpha)$`, where a sheet has a right angle. So cells resist with the shear law
/// besides: with linear laws the moment is larger by
///
/// ```math
/// \frac{\Delta M}{M} = \frac{G\kappa^2h^4}{16(B_1 + B_2)}
/// ```
///
/// a fifth at 2.5 cm⁻¹ and 2.4 mm, and of the fourth order in the spacing.
///
/// # Panics
/// As [`ideal`](super::ideal()).
#[must_use]
pub fn on_the_bias_in_cells(fabric: &Fabric, spacing: f64, largest: f64, points: usize) -> Curve {
    let path = path(&there_and_back(largest), points);
    let row = spacing * FRAC_1_SQRT_2;
    let half_sines: Vec<f64> = path.iter().map(|curvature| (0.5 * curvature * row).sin()).collect();
    let turns: Vec<f64> =
        half_sines.iter().map(|sin| 2.0 / spacing * (FRAC_1_SQRT_2 * sin).asin()).collect();
    let sines: Vec<f64> = half_sines.iter().map(|sin| sin * sin).collect();
    let [warp, weft] = bent(fabric, &turns);
    let shear = drive(&fabric.shear, fabric.shear.virgin(), &sines);
    let load = half_sines.iter().zip(warp.iter().zip(weft)).zip(shear);
    let load = load.map(|((sin, (warp, weft)), shear)| {
        let cos = (1.0 - sin * sin).sqrt();
        // Derivatives of the yarns' curvature and of the sine in half of the corners.
        let (turning, leaning) = (0.5 * cos / (1.0 - 0.5 * sin * sin).sqrt(), row * sin * cos);
        (warp + weft) * turning + 0.5 * shear * leaning
    });
    let load = load.collect();
    curve(Test::Bending, Direction::Warp, path, load).expect("a checked fabric has finite loads")
}

/// Moments per width, in N, of a specimen cut at 45° to the yarns along curvatures that it comes to
/// from rest, as [`on_the_bias`].
pub(crate) fn on_the_bias_along(fabric: &Fabric, curvatures: &[f64]) -> Vec<f64> {
    let halves = curvatures.iter().map(|curvature| 0.5 * curvature);
    let halves: Vec<f64> = std::iter::once(0.0).chain(halves).collect();
    let [warp, weft] = bent(fabric, &halves);
    warp[1..].iter().zip(&weft[1..]).map(|(warp, weft)| 0.5 * (warp + weft)).collect()
}

/// Moments per width of warp and weft along a path of curvatures.
fn bent(fabric: &Fabric, path: &[f64]) -> [Vec<f64>; 2] {
    [fabric.warp.bending, fabric.weft.bending].map(|law| drive(&law, law.virgin(), path))
}
