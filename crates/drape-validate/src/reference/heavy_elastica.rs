//! Heavy elastica: a clamped strip bent by its weight \[Bic34\] and by a load at its tip \[BD45\].

use super::root;
use super::runge_kutta::{march, trajectory};

/// Steps of the integration along the strip: the error of the fourth order is then below 1e-10 of
/// the length.
const STEPS: usize = 4000;

/// Tip of a bent strip, seen from its clamp, over the length of the strip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tip {
    /// Drop of the tip below the clamp, a ratio.
    pub drop: f64,
    /// Reach of the tip from the clamp, a ratio.
    pub reach: f64,
}

/// Returns the tip of a strip that is clamped level and bends under its own weight and a load at
/// its tip. `weight` is `$\lambda = wL^3/B$` and `load` is `$\mu = PL^2/B$`, both ratios.
///
/// With the slope `$\theta$` below the level and the arc length `$\sigma$` from the tip over the
/// length of the strip,
///
/// ```math
/// \theta'' = -(\lambda\sigma + \mu)\cos\theta,\qquad \theta'(0) = 0,\qquad \theta(1) = 0
/// ```
///
/// This is the heavy elastica \[Bic34\] where `$\mu = 0$`, and the end-loaded cantilever \[BD45\]
/// where `$\lambda = 0$`. The equation is solved by shooting from the tip.
#[must_use]
pub fn cantilever(weight: f64, load: f64) -> Tip {
    let start = [tip_slope(weight, load), 0.0, 0.0, 0.0];
    let [_, _, drop, reach] = march(elastica(weight, load), start, 1.0, STEPS);
    Tip { drop, reach }
}

/// Returns the whole shape of the strip of [`cantilever`], from its clamp at (0, 0): reach and drop
/// over the length, at the ends of `parts` equal parts of the strip.
///
/// # Panics
/// If `parts` is 0.
#[must_use]
pub fn cantilever_shape(weight: f64, load: f64, parts: usize) -> Vec<[f64; 2]> {
    let start = [tip_slope(weight, load), 0.0, 0.0, 0.0];
    let shape: Vec<[f64; 4]> = std::iter::once(start)
        .chain(trajectory(elastica(weight, load), start, 1.0, STEPS))
        .collect();
    let [_, _, drop, reach] = shape[STEPS];
    (0..=parts)
        .map(|k| {
            let [_, _, down, across] = shape[STEPS - k * STEPS / parts];
            [reach - across, drop - down]
        })
        .collect()
}

/// Returns the derivatives of slope, bend, drop and reach along the strip from its tip, for the
/// ratios `weight` and `load`.
fn elastica(weight: f64, load: f64) -> impl Fn(f64, [f64; 4]) -> [f64; 4] {
    move |s, [theta, bend, ..]| {
        let pull = -(weight * s + load) * theta.cos();
        [bend, pull, theta.sin(), theta.cos()]
    }
}

/// Returns the slope at the tip for which the clamp is level, for the ratios `weight` and `load`.
///
/// The slope at the clamp rises with the slope at the tip, from below zero to above.
fn tip_slope(weight: f64, load: f64) -> f64 {
    root(
        |tip| march(elastica(weight, load), [tip, 0.0, 0.0, 0.0], 1.0, STEPS)[0],
        0.0,
        std::f64::consts::FRAC_PI_2,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stiff_strip_sags_as_a_beam() {
        // wL⁴/8B and PL³/3B; the next term is of the third order.
        let small = 1e-3;
        let (heavy, loaded) = (cantilever(small, 0.0), cantilever(0.0, small));
        assert!((heavy.drop / (small / 8.0) - 1.0).abs() < 1e-6, "{heavy:?}");
        assert!((loaded.drop / (small / 3.0) - 1.0).abs() < 1e-6, "{loaded:?}");
    }

    #[test]
    fn an_end_load_bends_as_the_elliptic_integrals_say() {
        // Mattiasson 1981, table I: drop and reach for PL²/B = 1, 2 and 4.
        let table = [(1.0, 0.30172, 0.05643), (2.0, 0.49346, 0.16064), (4.0, 0.66996, 0.32894)];
        for (load, drop, shortening) in table {
            let tip = cantilever(0.0, load);
            assert!((tip.drop - drop).abs() < 1e-5, "{tip:?} for {load}");
            assert!((1.0 - tip.reach - shortening).abs() < 1e-5, "{tip:?} for {load}");
        }
    }

    #[test]
    fn the_shape_goes_from_the_clamp_to_the_tip() {
        let (shape, tip) = (cantilever_shape(10.0, 0.0, 40), cantilever(10.0, 0.0));
        let ([x0, y0], [x1, y1]) = (shape[0], shape[shape.len() - 1]);
        assert!(x0.abs() < 1e-9 && y0.abs() < 1e-9, "it begins at {x0}, {y0}");
        assert!((x1 - tip.reach).abs() < 1e-9 && (y1 - tip.drop).abs() < 1e-9, "{tip:?}");
        let lengths = shape.windows(2).map(|p| (p[1][0] - p[0][0]).hypot(p[1][1] - p[0][1]));
        let length: f64 = lengths.sum();
        assert!(length < 1.0 && length > 0.999, "the chords are {length} long together");
    }

    #[test]
    fn the_tip_of_peirces_test_is_where_he_says() {
        // At 41.5° between clamp and tip the bending length is half the overhang: wL³/B = 8.0042.
        let tip = cantilever(8.0042, 0.0);
        let angle = (tip.drop / tip.reach).atan().to_degrees();
        assert!((angle - 41.5).abs() < 1e-3, "{angle}");
    }
}
