//! Elastic load of traction whose stiffness grows exponentially within the toe.

use drape_hysteresis::Response;

use crate::laws::traction::toe::toe_end;

/// Least steepness of an exponential toe. A toe of this steepness deviates from a straight line by
/// half a per cent, and its formulas lose four digits.
pub const STEEPNESS_MIN: f64 = 0.01;

/// Exponential toe that continues as its tangent, beside a line.
///
/// The stiffness of the toe grows exponentially with the strain up to the end `$\varepsilon_c$` of
/// the toe, like the tension of many biological and textile fibre networks \[Fung67\]. Beyond the
/// toe the stiffness is constant. With the base stiffness `$k_0$`, the stiffness `$k$` that the toe
/// adds at its end, and the steepness `$b$`,
///
/// ```math
/// \frac{\mathrm{d}F}{\mathrm{d}\varepsilon} = k_0 +
/// k\,e^{-b\,(1-\varepsilon/\varepsilon_c)}\;(\varepsilon \le \varepsilon_c), \qquad
/// \frac{\mathrm{d}F}{\mathrm{d}\varepsilon} = k_0 + k\;(\varepsilon > \varepsilon_c)
/// ```
///
/// so that the load is
///
/// ```math
/// F = k_0\,\varepsilon + \frac{k\,\varepsilon_c}{b}
/// \left(e^{-b\,(1-\varepsilon/\varepsilon_c)} - e^{-b}\right), \qquad
/// F = k_0\,\varepsilon + k\,(\varepsilon - d\,\varepsilon_c), \qquad
/// d = 1 - \frac{1-e^{-b}}{b}
/// ```
///
/// The linearity LT of the curve may have any value from 1 (steepness near 0) down to 0. The end of
/// the toe depends on the largest elongation like the end of a priming zone
/// ([`Primed`](crate::Primed)). The virgin curve rises as long as
/// `$\varepsilon_1' \le 2\varepsilon_1$`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExponentialToe {
    /// Stiffness `$k_0$` at every strain, in N/m, at least 0.
    pub base_stiffness: f64,
    /// Stiffness `$k$` that the toe adds at its end, in N/m.
    pub stiffness: f64,
    /// Steepness `$b$`: natural logarithm of the growth of the added stiffness over the toe, at
    /// least [`STEEPNESS_MIN`].
    pub steepness: f64,
    /// Strain `$\varepsilon_1$` at which the toe of a virgin fabric ends, a ratio.
    pub toe_strain: f64,
    /// Strain `$\varepsilon_1'$` at which the toe of a stretched fabric ends, a ratio from
    /// `toe_strain` to twice `toe_strain`.
    pub toe_strain_after: f64,
}

impl ExponentialToe {
    /// Returns the strain at which the toe ends after the largest elongation `peak`, a ratio.
    #[must_use]
    pub fn toe(&self, peak: f64) -> f64 {
        toe_end(self.toe_strain, self.toe_strain_after, peak)
    }

    /// Returns the stiffness of `self` at rest, in N/m.
    #[must_use]
    pub fn rest_stiffness(&self) -> f64 {
        self.base_stiffness + self.stiffness * (-self.steepness).exp()
    }

    /// Returns the deficit `$d$`. The line beyond the toe starts at the strain
    /// `$d\,\varepsilon_c$`.
    #[must_use]
    pub fn deficit(&self) -> f64 {
        1.0 + (-self.steepness).exp_m1() / self.steepness
    }

    /// Returns load and tangent at a `strain` of at least 0 after the largest elongation `peak`.
    pub(crate) fn respond(&self, peak: f64, strain: f64) -> Response {
        if strain > peak.max(self.toe_strain) {
            self.virgin(strain)
        } else {
            self.fixed(self.toe(peak), strain)
        }
    }

    /// Returns load and tangent at a `strain` of at least 0, with a toe that ends at the strain
    /// `toe`.
    fn fixed(&self, toe: f64, strain: f64) -> Response {
        let Self { base_stiffness, stiffness, steepness, .. } = *self;
        // At zero strain both exponentials have one and the same argument, so that the load is
        // exactly zero.
        let below = (steepness * (strain / toe) - steepness).min(0.0).exp_m1();
        let within = stiffness * (toe / steepness) * (below - (-steepness).exp_m1());
        let beyond = stiffness * (strain - toe).max(0.0);
        Response {
            load: base_stiffness * strain + within + beyond,
            tangent: base_stiffness + stiffness * (1.0 + below),
        }
    }

    /// Returns load and tangent at a `strain` beyond all earlier strains and beyond the virgin toe.
    fn virgin(&self, strain: f64) -> Response {
        let Self { base_stiffness, stiffness, .. } = *self;
        let toe = self.toe(strain);
        let growth = (self.toe_strain_after - toe) / self.toe_strain;
        let deficit = self.deficit();
        Response {
            load: base_stiffness * strain + stiffness * (strain - deficit * toe),
            tangent: base_stiffness + stiffness * (1.0 - deficit * growth),
        }
    }

    /// Returns the integral of the load from 0 to a `strain` of at least 0, with a toe that ends at
    /// the strain `toe`, in J/m².
    fn fixed_energy(&self, toe: f64, strain: f64) -> f64 {
        let Self { base_stiffness, stiffness, steepness, .. } = *self;
        let (within, scale) = (strain.min(toe), toe / steepness);
        let at_rest = (-steepness).exp_m1();
        let below = (steepness * (within / toe) - steepness).exp_m1();
        // Integral of `scale` (e^… − e^{−b}) over the toe, and of the line beyond the toe.
        let toe_part = scale * (scale * (below - at_rest) - within * (1.0 + at_rest));
        let beyond = strain - within;
        let line = beyond * (0.5 * (strain + within) - self.deficit() * toe);
        0.5 * base_stiffness * strain * strain + stiffness * (toe_part + line)
    }

    /// Returns the integral of the load from 0 to a `strain` of at least 0 after the largest
    /// elongation `peak`, in J/m².
    pub(crate) fn energy(&self, peak: f64, strain: f64) -> f64 {
        let largest = peak.max(self.toe_strain);
        if strain <= largest {
            return self.fixed_energy(self.toe(peak), strain);
        }
        // Integral of the moving toe: ∫ε_c dε = ε₁'Δε − ε₁(ε_c(end) − ε_c(start)).
        let toes = self.toe_strain_after * (strain - largest)
            - self.toe_strain * (self.toe(strain) - self.toe(largest));
        let line = 0.5 * (strain - largest) * (strain + largest);
        self.fixed_energy(self.toe(largest), largest)
            + self.base_stiffness * line
            + self.stiffness * (line - self.deficit() * toes)
    }
}
