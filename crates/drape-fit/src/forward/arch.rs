//! Clamped arch: a strip between parallel clamps that have come closer than its length.
//!
//! Half of it is half a wave of the inextensible elastica \[Eul44\]. With the parameter `$m=k^2$`,
//! the complete integrals `$K(m)$`, `$E(m)$` and the length `$L$` of the strip
//!
//! ```math
//! \frac{\text{span}}{L} = 2\frac{E}{K}-1,\qquad
//! P = \frac{16K^2}{L^2}B,\qquad
//! \theta_{max} = 2\arcsin k
//! ```
//!
//! are the clamp distance, the compressive force per width, and the largest slope angle. The
//! loop-bending fit of `curves` computes the arch of every point once.

use crate::forward::elliptic::CompleteIntegrals;

/// Bisections for the parameter: the bits of a double.
const BISECTIONS: usize = 54;

/// Clamped arch of unit rigidity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Arch {
    /// Compressive force over rigidity `$P/B$`, in 1/m².
    pub(crate) force: f64,
    /// Mean absolute curvature of the strip `$4\theta_{max}/L$`, in 1/m.
    pub(crate) curvature: f64,
    /// Derivative of the total rotation by the shortening, `$4\,d\theta_{max}/d\Delta$`, in 1/m.
    ///
    /// A friction moment per width that acts everywhere in the strip resists the clamps with this
    /// many times itself.
    pub(crate) rotation_rate: f64,
}

impl Arch {
    /// Computes the arch of a strip of the given `length`, in metres, shortened by the fraction
    /// `shortening` between 0 and 1.
    pub(crate) fn new(length: f64, shortening: f64) -> Self {
        let m = parameter(shortening);
        let CompleteIntegrals { k, e } = CompleteIntegrals::new(m);
        let d_e = (e - k) / (2.0 * m);
        let d_k = (e - (1.0 - m) * k) / (2.0 * m * (1.0 - m));
        // d(shortening)/dm = −2 d(E/K)/dm, and dθ/dm = 1/√(m(1 − m)).
        let d_shortening = -2.0 * (d_e * k - e * d_k) / (k * k);
        let d_slope = 1.0 / (m * (1.0 - m)).sqrt();
        Self {
            force: 16.0 * k * k / (length * length),
            curvature: 8.0 * m.sqrt().asin() / length,
            rotation_rate: 4.0 * d_slope / (d_shortening * length),
        }
    }
}

/// Returns the parameter `$m$` at which the clamps have come closer by the fraction `shortening` of
/// the length.
fn parameter(shortening: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        let CompleteIntegrals { k, e } = CompleteIntegrals::new(middle);
        if 2.0 * (1.0 - e / k) < shortening {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    const LENGTH: f64 = 0.08;

    #[test]
    fn a_nearly_straight_strip_buckles_at_eulers_load() {
        let euler = (2.0 * PI / LENGTH).powi(2);
        // The load grows by m/2 beyond Euler's, and m is the shortening to first order.
        let force = Arch::new(LENGTH, 1e-6).force;
        assert!((force / euler - 1.0).abs() < 1e-6, "{force} against {euler}");
    }

    #[test]
    fn the_force_is_the_derivative_of_the_bending_energy() {
        // ½∫κ²ds of the arch, from κ = 2kq·cn(qs) with q = 4K/L.
        let energy = |shortening: f64| {
            let m = parameter(shortening);
            let CompleteIntegrals { k, e } = CompleteIntegrals::new(m);
            32.0 * k * (e - (1.0 - m) * k) / LENGTH
        };
        for shortening in [0.05, 0.2, 0.4, 0.6] {
            let step = 1e-5;
            let slope =
                (energy(shortening + step) - energy(shortening - step)) / (2.0 * step * LENGTH);
            let force = Arch::new(LENGTH, shortening).force;
            // The central difference is good to step² times a third derivative of order ten.
            assert!((slope / force - 1.0).abs() < 1e-7, "at {shortening}: {slope} against {force}");
        }
    }

    #[test]
    fn the_rotation_rate_is_the_derivative_of_the_mean_curvature_times_the_length() {
        for shortening in [0.05, 0.2, 0.4, 0.6] {
            let step = 1e-5;
            let at = |shortening: f64| Arch::new(LENGTH, shortening).curvature;
            let slope = (at(shortening + step) - at(shortening - step)) / (2.0 * step);
            let rotation_rate = Arch::new(LENGTH, shortening).rotation_rate;
            assert!(
                (slope / rotation_rate - 1.0).abs() < 1e-6,
                "at {shortening}: {slope}, {rotation_rate}"
            );
        }
    }
}
