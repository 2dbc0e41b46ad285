use super::integrate::{march, root};

/// Steps of the integration along the strip: the error of the fourth order is then below 1e-10 of the length.
const STEPS: usize = 4000;

/// Shape of a bent strip's end, from the clamp, over the strip's length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tip {
    /// How far the tip hangs below the clamp, a ratio.
    pub drop: f64,
    /// How far the tip reaches from the clamp, a ratio.
    pub reach: f64,
}

/// A strip clamped level, bent by its own weight and by a weight at its tip.
///
/// With the slope `$\theta$` below the level and the arc length `$\sigma$` from the tip, both over the
/// length,
///
/// ```math
/// \theta'' = -(\lambda\sigma + \mu)\cos\theta,\qquad \theta'(0) = 0,\qquad \theta(1) = 0
/// ```
///
/// for `$\lambda = wL^3/B$` and `$\mu = PL^2/B$`: the heavy elastica [Bickley 1934] where `$\mu = 0$`, the
/// end-loaded cantilever [Bisshopp & Drucker 1945] where `$\lambda = 0$`. Solved by shooting from the tip.
pub fn cantilever(weight: f64, load: f64) -> Tip {
    let shape = |tip: f64| {
        let slope = |s: f64, [theta, bend, ..]: [f64; 4]| {
            let pull = -(weight * s + load) * theta.cos();
            [bend, pull, theta.sin(), theta.cos()]
        };
        march(slope, [tip, 0.0, 0.0, 0.0], 1.0, STEPS)
    };
    // The slope at the clamp rises with that at the tip from below nought to above.
    let tip = root(|tip| shape(tip)[0], 0.0, std::f64::consts::FRAC_PI_2);
    let [_, _, drop, reach] = shape(tip);
    Tip { drop, reach }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stiff_strip_sags_as_a_beam() {
        // wL⁴/8B and PL³/3B; the next term is of the third order.
        let small = 1e-3;
        let (own, end) = (cantilever(small, 0.0), cantilever(0.0, small));
        assert!((own.drop / (small / 8.0) - 1.0).abs() < 1e-6, "{own:?}");
        assert!((end.drop / (small / 3.0) - 1.0).abs() < 1e-6, "{end:?}");
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
    fn the_tip_of_peirces_test_is_where_he_says() {
        // At 41.5° between clamp and tip the bending length is half the overhang: wL³/B = 8.0042.
        let tip = cantilever(8.0042, 0.0);
        let angle = (tip.drop / tip.reach).atan().to_degrees();
        assert!((angle - 41.5).abs() < 1e-3, "{angle}");
    }
}
