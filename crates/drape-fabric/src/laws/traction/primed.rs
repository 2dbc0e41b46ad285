//! Elastic load of traction with a priming zone and a line.

use drape_hysteresis::Response;

use crate::laws::traction::toe::toe_end;

/// Smallest toe ratio. With a toe ratio of one half the fabric would have no stiffness at rest.
pub const TOE_RATIO_MIN: f64 = 0.505;

/// Priming zone (toe) and linear zone of a tensile curve \[NB04, eq. 3\].
///
/// With the stiffness `$k_t$`, the end `$\varepsilon_c$` of the priming zone, the load `$F_1$` at
/// this end, and the toe ratio `$r = F_1/(k_t\varepsilon_c)$`, the load is
///
/// ```math
/// F = k_t\left[(1-r)\,\varepsilon^2/\varepsilon_c + (2r-1)\,\varepsilon\right]
/// \;(\varepsilon \le \varepsilon_c), \qquad
/// F = k_t\left[\varepsilon - (1-r)\,\varepsilon_c\right]\;(\varepsilon > \varepsilon_c)
/// ```
///
/// The load is once differentiable, and monotone for `$\tfrac12 \le r \le 1$`. The end of the toe
/// depends on the largest elongation so far, `$\hat\varepsilon$`:
///
/// ```math
/// \varepsilon_c = \varepsilon_1 + (\varepsilon_1'-\varepsilon_1)
/// \left(1 - e^{-(\hat\varepsilon-\varepsilon_1)/\varepsilon_1}\right),
/// \qquad \hat\varepsilon > \varepsilon_1
/// ```
///
/// with a constant toe ratio. The paper identifies two values of `$\varepsilon_c$` and gives no
/// rule between them. The rule of this law is continuous, and the virgin curve rises as long as
/// `$\varepsilon_1' \le 2\varepsilon_1$`. The rule is bounded, so an extrapolation of a fit is
/// bounded too.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Primed {
    /// Stiffness `$k_t$` of the linear zone, in N/m.
    pub stiffness: f64,
    /// Toe ratio `$r$`, from 0.505 to 1. With 1 the curve is a straight line.
    pub toe_ratio: f64,
    /// Strain `$\varepsilon_1$` at which the priming zone of a virgin fabric ends, a ratio.
    pub toe_strain: f64,
    /// Strain `$\varepsilon_1'$` at which the priming zone of a stretched fabric ends, a ratio from
    /// `toe_strain` to twice `toe_strain`.
    pub toe_strain_after: f64,
}

impl Primed {
    /// Returns the strain at which the priming zone ends after the largest elongation `peak`, a
    /// ratio.
    #[must_use]
    pub fn toe(&self, peak: f64) -> f64 {
        toe_end(self.toe_strain, self.toe_strain_after, peak)
    }

    /// Returns the load `$F_1$` at the end of the virgin priming zone, in N/m.
    #[must_use]
    pub fn toe_load(&self) -> f64 {
        self.toe_ratio * self.stiffness * self.toe_strain
    }

    /// Returns load and tangent at a `strain` of at least 0, with a toe that ends at the strain
    /// `toe`.
    fn fixed(&self, toe: f64, strain: f64) -> Response {
        let Self { stiffness, toe_ratio, .. } = *self;
        if strain <= toe {
            let bend = (1.0 - toe_ratio) * strain / toe;
            Response {
                load: stiffness * strain * (bend + 2.0 * toe_ratio - 1.0),
                tangent: stiffness * (2.0 * bend + 2.0 * toe_ratio - 1.0),
            }
        } else {
            let load = stiffness * (strain - (1.0 - toe_ratio) * toe);
            Response { load, tangent: stiffness }
        }
    }

    /// Returns load and tangent at a `strain` beyond all earlier strains and beyond the virgin toe.
    fn virgin(&self, strain: f64) -> Response {
        let toe = self.toe(strain);
        let growth = (self.toe_strain_after - toe) / self.toe_strain;
        Response {
            load: self.stiffness * (strain - (1.0 - self.toe_ratio) * toe),
            tangent: self.stiffness * (1.0 - (1.0 - self.toe_ratio) * growth),
        }
    }

    /// Returns load and tangent at a `strain` of at least 0 after the largest elongation `peak`.
    pub(crate) fn respond(&self, peak: f64, strain: f64) -> Response {
        if strain > peak.max(self.toe_strain) {
            self.virgin(strain)
        } else {
            self.fixed(self.toe(peak), strain)
        }
    }

    /// Returns the integral of the load from 0 to a `strain` of at least 0, with a toe that ends at
    /// the strain `toe`, in J/m².
    pub(crate) fn fixed_energy(&self, toe: f64, strain: f64) -> f64 {
        let Self { stiffness, toe_ratio, .. } = *self;
        let within = strain.min(toe);
        let square = within * within;
        let toe_part = (1.0 - toe_ratio) * square * within / (3.0 * toe)
            + 0.5 * (2.0 * toe_ratio - 1.0) * square;
        let beyond = strain - within;
        stiffness * (toe_part + beyond * (0.5 * (strain + within) - (1.0 - toe_ratio) * toe))
    }

    /// Returns the integral of the load from 0 to `strain` after the largest elongation `peak`, in
    /// J/m².
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
            + self.stiffness * (line - (1.0 - self.toe_ratio) * toes)
    }
}
