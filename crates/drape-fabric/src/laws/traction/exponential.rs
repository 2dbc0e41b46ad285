//! Elastic load of traction whose stiffness grows exponentially within the toe.

use drape_hysteresis::Response;

use crate::laws::traction::toe::toe_end;

/// Least steepness of an exponential toe. A toe of this steepness is a straight line to half a
/// per cent, and the formulas lose four digits there.
pub const STEEPNESS_MIN: f64 = 0.01;

/// Exponential toe that continues as its tangent, beside a line.
///
/// The stiffness of the toe grows exponentially with the strain, up to the end `$\varepsilon_c$` of
/// the toe, as the tension of many biological and textile fibre networks does \[Fung67\]; beyond it
/// the stiffness is constant. With the base stiffness `$k_0$`, the stiffness `$k$` that the toe adds
/// at its end, and the steepness `$b$`,
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
/// The linearity LT of its curve may be anything from 1 (steepness near 0) down to 0. The end of the
/// toe moves with the largest elongation as the end of a priming zone does
/// ([`Primed`](crate::Primed)). The virgin curve rises while `$\varepsilon_1' \le 2\varepsilon_1$`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExponentialToe {
    /// Stiffness `$k_0$` that is there at every strain, in N/m; may be 0.
    pub base_stiffness: f64,
    /// Stiffness `$k$` that the toe has added at its end, in N/m.
    pub stiffness: f64,
    /// Steepness `$b$`: natural logarithm of the growth of the added stiffness over the toe, at least
    /// [`STEEPNESS_MIN`].
    pub steepness: f64,
    /// Strain `$\varepsilon_1$` where the toe of a virgin fabric ends, a ratio.
    pub toe_strain: f64,
    /// Strain `$\varepsilon_1'$` where the toe ends after the fabric has been stretched, a ratio from
    /// `toe_strain` to twice that.
    pub toe_strain_after: f64,
}

impl ExponentialToe {
    /// Returns the strain where the toe ends after the largest elongation `peak`, a ratio.
    #[must_use]
    pub fn toe(&self, peak: f64) -> f64 {
        toe_end(self.toe_strain, self.toe_strain_after, peak)
    }

    /// Stiffness at rest, in N/m.
    #[must_use]
    pub fn rest_stiffness(&self) -> f64 {
        self.base_stiffness + self.stiffness * (-self.steepness).exp()
    }

    /// Deficit `$d$`: the line beyond the toe starts at the strain `$d\,\varepsilon_c$`.
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

    /// Returns load and tangent at a `strain` of at least 0 with the toe ending at `toe`.
    fn fixed(&self, toe: f64, strain: f64) -> Response {
        let Self { base_stiffness, stiffness, steepness, .. } = *self;
        // The argument of both exponentials at zero strain is the same number, so that the load is
        // exactly zero there.
        let below = (steepness * (strain / toe) - steepness).min(0.0).exp_m1();
        let within = stiffness * (toe / steepness) * (below - (-steepness).exp_m1());
        let beyond = stiffness * (strain - toe).max(0.0);
        Response {
            load: base_stiffness * strain + within + beyond,
            tangent: base_stiffness + stiffness * (1.0 + below),
        }
    }

    /// Returns load and tangent at a `strain` beyond every earlier one and beyond the virgin toe.
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

    /// Returns the integral of the load from 0 to a `strain` of at least 0 with the toe ending at
    /// `toe`, in J/m².
    fn fixed_energy(&self, toe: f64, strain: f64) -> f64 {
        let Self { base_stiffness, stiffness, steepness, .. } = *self;
        let (within, scale) = (strain.min(toe), toe / steepness);
        let rest = (-steepness).exp_m1();
        let below = (steepness * (within / toe) - steepness).exp_m1();
        // ∫ scale (e^… − e^{−b}) over the toe, and the line beyond it.
        let toe_part = scale * (scale * (below - rest) - within * (1.0 + rest));
        let beyond = strain - within;
        let line = beyond * (0.5 * (strain + within) - self.deficit() * toe);
        0.5 * base_stiffness * strain * strain + stiffness * (toe_part + line)
    }

    /// Returns the integral of the load from 0 to a `strain` of at least 0 after the largest
    /// elongation `peak`, in J/m².
    pub(crate) fn energy(&self, peak: f64, strain: f64) -> f64 {
        let seen = peak.max(self.toe_strain);
        if strain <= seen {
            return self.fixed_energy(self.toe(peak), strain);
        }
        // Integral of the moving toe: ∫ε_c dε = ε₁'Δε − ε₁(ε_c(end) − ε_c(start)).
        let toes = self.toe_strain_after * (strain - seen)
            - self.toe_strain * (self.toe(strain) - self.toe(seen));
        let line = 0.5 * (strain - seen) * (strain + seen);
        self.fixed_energy(self.toe(seen), seen)
            + self.base_stiffness * line
            + self.stiffness * (line - self.deficit() * toes)
    }
}
