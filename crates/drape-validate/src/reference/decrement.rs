//! Logarithmic decrement of a strip whose bending has the friction of a Dahl element \[Dahl68\].

/// Zero of `$\cos k\cosh k = -1$` that belongs to the first mode of a cantilever.
const WAVE: f64 = 1.875_104_068_711_961;

/// Steps of the quadrature along the strip; the curvatures are smooth.
const STEPS: usize = 400;

/// A strip clamped at one end whose bending has a linear rigidity beside one Dahl element.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DahlStrip {
    /// Free length, in m.
    pub length: f64,
    /// Rigidity `$B$` per width, in N·m.
    pub rigidity: f64,
    /// Plateau `$F$` of the friction per width, in N.
    pub plateau: f64,
    /// Length `$\ell$` of the friction, in 1/m.
    pub sliding: f64,
}

/// Deflection of a strip in its first mode, over the deflection of its tip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Deflection {
    /// Deflection over the deflection of the tip, a ratio.
    pub deflection: f64,
    /// Curvature over the deflection of the tip, in 1/m².
    pub curvature: f64,
}

/// Loss of a strip with friction in a cycle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CycleLoss {
    /// Energy per width, in J/m.
    pub energy: f64,
    /// Logarithmic decrement of free swings, a ratio.
    pub decrement: f64,
}

impl DahlStrip {
    /// Returns the angular frequency of the first mode without friction, in rad/s. `density` is the
    /// mass per area, in kg/m².
    #[must_use]
    pub fn frequency(&self, density: f64) -> f64 {
        (WAVE / self.length).powi(2) * (self.rigidity / density).sqrt()
    }

    /// Returns the first mode at `distance` from the clamp, in m.
    #[must_use]
    pub fn mode(&self, distance: f64) -> Deflection {
        // Deflection and curvature at a part of the length, without a common factor.
        fn shape(part: f64) -> [f64; 2] {
            let k = WAVE * part;
            let balance = (WAVE.sinh() - WAVE.sin()) / (WAVE.cosh() + WAVE.cos());
            let deflection = k.cosh() - k.cos() - balance * (k.sinh() - k.sin());
            [deflection, k.cosh() + k.cos() - balance * (k.sinh() + k.sin())]
        }

        let [tip, _] = shape(1.0);
        let [deflection, bend] = shape(distance / self.length);
        Deflection {
            deflection: deflection / tip,
            curvature: bend / tip * (WAVE / self.length).powi(2),
        }
    }

    /// Returns the loss of a cycle in which the tip deflects by `$\pm a$`, and the logarithmic
    /// decrement of free swings with the amplitude `$a$`. `tip` is `$a$`, in m.
    ///
    /// A steady loop between `$\pm\kappa$` has the area `$4F(\kappa - \ell\tanh\frac\kappa\ell)$`.
    /// At the ends of the loop the element holds `$\frac12F\ell\tanh^2\frac\kappa\ell$`. Small
    /// friction does not change the curvatures of the first mode, over which
    ///
    /// ```math
    /// \delta = \frac{W}{a\,\mathrm{d}U/\mathrm{d}a},\qquad
    /// W = \int 4F(\kappa - \ell\tanh\tfrac\kappa\ell)\,\mathrm{d}s,\qquad
    /// U = \int \tfrac12B\kappa^2 + \tfrac12F\ell\tanh^2\tfrac\kappa\ell\,\mathrm{d}s
    /// ```
    #[must_use]
    pub fn decrement(&self, tip: f64) -> CycleLoss {
        let Self { length, rigidity, plateau, sliding } = *self;

        // `growth` is the amplitude times the derivative of the stored energy.
        let (mut lost, mut growth) = (0.0, 0.0);
        for step in 0..=STEPS {
            // Simpson's rule weighs the ends by 1, and the other points by 4 and 2 in turn.
            let is_end = step == 0 || step == STEPS;
            let weight = if is_end {
                1.0
            } else if step % 2 == 1 {
                4.0
            } else {
                2.0
            };
            let weight = weight * length / (3.0 * STEPS as f64);

            let mode = self.mode(length * step as f64 / STEPS as f64);
            let curvature = (tip * mode.curvature).abs();
            let held = (curvature / sliding).tanh();
            lost += weight * 4.0 * plateau * (curvature - sliding * held);
            let friction = plateau * curvature * held * (1.0 - held * held);
            growth += weight * (rigidity * curvature * curvature + friction);
        }
        CycleLoss { energy: lost, decrement: lost / growth }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STRIP: DahlStrip =
        DahlStrip { length: 0.05, rigidity: 1.6e-5, plateau: 3.2e-7, sliding: 1.0 };

    #[test]
    fn the_mode_is_that_of_a_clamped_beam() {
        let Deflection { deflection: at_clamp, curvature: bend } = STRIP.mode(0.0);
        assert!(at_clamp.abs() < 1e-15);
        // The curvature at the clamp is k² times the tip's deflection over the length squared.
        assert!((bend * STRIP.length.powi(2) / WAVE.powi(2) - 1.0).abs() < 1e-12, "{bend}");
        let Deflection { deflection: at_tip, curvature: bend } = STRIP.mode(STRIP.length);
        assert!((at_tip - 1.0).abs() < 1e-15 && bend.abs() * STRIP.length.powi(2) < 1e-12);
        // Its energy is that of the frequency: ∫Bκ² = ω²∫ρy².
        let sums = (0..1000).map(|k| STRIP.mode((f64::from(k) + 0.5) * 1e-3 * STRIP.length));
        let [mass, bend] = sums
            .fold([0.0; 2], |sum, Deflection { deflection: y, curvature: k }| {
                [sum[0] + y * y, sum[1] + k * k]
            });
        let ratio = STRIP.rigidity * bend / (STRIP.frequency(0.2).powi(2) * 0.2 * mass);
        assert!((ratio - 1.0).abs() < 1e-5, "{ratio}");
    }

    #[test]
    fn large_swings_lose_what_coulombs_friction_takes() {
        // Far beyond the sliding length the loop is a parallelogram 2F high.
        let tip = 1e3;
        let CycleLoss { energy: lost, decrement } = STRIP.decrement(tip);
        let bends =
            (0..4000).map(|k| STRIP.mode((f64::from(k) + 0.5) / 4000.0 * STRIP.length).curvature);
        let [mean, square] = bends.fold([0.0; 2], |sum, k| [sum[0] + k, sum[1] + k * k]);
        let [mean, square] = [mean, square].map(|sum| sum / 4000.0);
        let exact = 4.0 * STRIP.plateau * mean * tip * STRIP.length;
        assert!((lost / exact - 1.0).abs() < 1e-3, "{lost} {exact}");
        let exact = 4.0 * STRIP.plateau * mean / (STRIP.rigidity * square * tip);
        assert!((decrement / exact - 1.0).abs() < 1e-3, "{decrement} {exact}");
    }

    #[test]
    fn small_swings_lose_with_the_third_power() {
        let (small, smaller) = (STRIP.decrement(1e-6).energy, STRIP.decrement(5e-7).energy);
        assert!((small / smaller - 8.0).abs() < 1e-3, "{small} {smaller}");
    }
}
