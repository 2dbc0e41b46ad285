//! Friction of traction that grows with the tension of the yarns.
//!
//! The state `$g$` of the friction is the load of a Dahl element with a plateau of one. The
//! friction is `$w(\varepsilon)\,g$`, with a weight that follows the elastic load. The path is cut
//! into pieces on which the weight is the sum of a line and an exponential. On such a piece the
//! work of the friction is a sum of products of exponentials, which `WeightPiece` integrates.
//! `batch::exponential` uses these pieces too.

use drape_hysteresis::{Dahl, exp_m1};

use crate::laws::traction::buckling::Buckling;
use crate::laws::traction::exponential::ExponentialToe;

/// Largest ratio of the friction to the elastic load.
///
/// After unloading by many friction lengths a cloth has the fraction `1 - ratio` of its elastic
/// stiffness: with a ratio of one the cloth would have none. Two per cent of the stiffness change
/// the load of a loop by at most two per cent, at the lower end of the loop.
pub const FRICTION_RATIO_MAX: f64 = 0.98;

/// Friction in proportion to the elastic load, plus a constant part.
///
/// The tension of the yarns presses them on each other, so the friction at the crossings grows with
/// the tension, like the friction of a rope around a drum (Euler and Eytelwein's capstan). With the
/// elastic load `$F_e$` of an [`ExponentialToe`], the ratio `$\mu$` and the plateau `$c$`,
///
/// ```math
/// F = F_e(\varepsilon) + \left[c + \mu F_e(\varepsilon)\right] g, \qquad
/// \frac{\mathrm{d}g}{\mathrm{d}\varepsilon} = \frac{1 - \sigma g}{x_f}, \qquad
/// \sigma = \operatorname{sgn}\dot\varepsilon, \qquad |g| \le 1
/// ```
///
/// The state `$g$` is advanced exactly, as [`Dahl`] friction. The load rises with the strain on
/// every branch, because the weight is never negative and `$\mu < 1$`. In compression the weight of
/// the plateau decays like the elastic stiffness, as `$c\,e^{\varepsilon/\varepsilon_b}$`. The load
/// then rises as long as `$c \le k_r\varepsilon_b$`, with the stiffness `$k_r$` at rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProportionalFriction {
    /// Ratio `$\mu$` of the friction to the elastic load, from 0 to [`FRICTION_RATIO_MAX`].
    pub ratio: f64,
    /// Plateau `$c$` of the friction of yarns without tension, in N/m, not negative.
    pub plateau: f64,
    /// Friction length `$x_f$`, a strain, greater than 0.
    pub length: f64,
}

impl ProportionalFriction {
    /// Returns whether the weight of the friction is zero at every strain.
    pub(crate) fn is_none(&self) -> bool {
        self.ratio == 0.0 && self.plateau == 0.0
    }

    /// Returns the [`Dahl`] element whose load is the state of the friction. Without friction the
    /// state is always zero.
    pub(crate) fn element(&self) -> Dahl {
        if self.is_none() { Dahl::NONE } else { Dahl { plateau: 1.0, length: self.length } }
    }

    /// Returns the strain `$\varepsilon_b$` over which a yarn with this `toe` must buckle so that
    /// its load rises with the strain in compression too. The least value is the strain of
    /// [`Buckling::default`].
    #[must_use]
    pub fn buckling_strain(&self, toe: &ExponentialToe) -> f64 {
        Buckling::default().strain.max(self.plateau / toe.rest_stiffness())
    }
}

/// Piece of the path on which the weight of the friction is the sum of a line and an exponential.
///
/// ```math
/// w(\varepsilon) = A + B\varepsilon + C\,e^{\lambda(\varepsilon - \varepsilon_r)}
/// ```
#[derive(Debug, Clone, Copy)]
pub(crate) struct WeightPiece {
    /// Constant part `$A$`, in N/m.
    pub(crate) constant: f64,
    /// Slope `$B$` of the line, in N/m.
    pub(crate) slope: f64,
    /// Exponential part `$C$` at the reference strain, in N/m.
    pub(crate) amplitude: f64,
    /// Rate `$\lambda$` of the exponential, per strain.
    pub(crate) rate: f64,
    /// Reference strain `$\varepsilon_r$`, such that the exponent is never positive on the piece.
    pub(crate) reference: f64,
}

/// Monotone step along one piece.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WeightedStep {
    /// Strain at the start of the step.
    pub(crate) from: f64,
    /// Strain at the end of the step.
    pub(crate) to: f64,
    /// Direction `$\sigma = \pm 1$`.
    pub(crate) sign: f64,
    /// State `$g$` of the friction at the start of the step.
    pub(crate) state: f64,
}

impl WeightPiece {
    /// Returns the exponential part of the weight at `strain`, in N/m.
    #[inline(always)]
    fn exponential(&self, strain: f64) -> f64 {
        self.amplitude * (1.0 + exp_m1(self.rate * (strain - self.reference)))
    }

    /// Returns the work `$\int w\,g\,\mathrm{d}\varepsilon$` of the friction over a `step`, in
    /// J/m², with the friction length `length`.
    ///
    /// After the path `$s$` the state is `$g = \sigma + (g_0 - \sigma)e^{-s/x_f}$`, so the work is
    /// `$\int w\,\mathrm{d}s + (\sigma g_0 - 1)\int w\,e^{-s/x_f}\mathrm{d}s$`.
    #[inline(always)]
    pub(crate) fn work(&self, step: WeightedStep, length: f64) -> f64 {
        let WeightedStep { from, to, sign, state } = step;
        let path = (to - from).abs();
        let kept = 1.0 + exp_m1(-path / length);
        let lost = 1.0 - kept;

        // Contributions of the line, as a function of the path.
        let (constant, slope) = (self.constant + self.slope * from, sign * self.slope);
        let lag = path - length * lost;
        let line = path * (constant + 0.5 * slope * path);
        let decaying_line = length * (constant * lost + slope * (path * lost - lag));

        // Contributions of the exponential, as a function of the path.
        let (start, end) = (self.exponential(from), self.exponential(to));
        let rate = sign * self.rate;
        let rising = integral_of_exponential(start, end, rate, path);
        let decaying = integral_of_exponential(start, end * kept, rate - 1.0 / length, path);

        line + rising + (sign * state - 1.0) * (decaying_line + decaying)
    }
}

/// Returns the integral of an exponential over a path of length `path`, from the values `start` and
/// `end` at both ends.
///
/// `rate` is the logarithmic derivative along the path: `$e_1 = e_0\,e^{\lambda u}$`. The formula
/// uses only the larger end, so that nothing overflows.
#[inline(always)]
fn integral_of_exponential(start: f64, end: f64, rate: f64, path: f64) -> f64 {
    let larger = if rate > 0.0 { end } else { start };
    let exponent = rate.abs() * path;
    let shrunk = -exp_m1(-exponent) / exponent;
    larger * path * if exponent > 0.0 { shrunk } else { 1.0 }
}

/// Weight of the friction at all strains, in pieces.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Weight<'a> {
    pub(crate) toe: &'a ExponentialToe,
    pub(crate) friction: &'a ProportionalFriction,
    pub(crate) buckling: &'a Buckling,
}

impl Weight<'_> {
    /// Returns the piece of a yarn in compression.
    #[inline(always)]
    pub(crate) fn compressed(&self) -> WeightPiece {
        WeightPiece {
            constant: 0.0,
            slope: 0.0,
            amplitude: self.friction.plateau,
            rate: 1.0 / self.buckling.strain,
            reference: 0.0,
        }
    }

    /// Returns the piece within a toe that ends at the strain `end`.
    #[inline(always)]
    pub(crate) fn within_toe(&self, end: f64) -> WeightPiece {
        let ExponentialToe { base_stiffness, stiffness, steepness, .. } = *self.toe;
        let ProportionalFriction { ratio, plateau, .. } = *self.friction;
        let amplitude = ratio * stiffness * (end / steepness);
        WeightPiece {
            constant: plateau - amplitude * (1.0 + exp_m1(-steepness)),
            slope: ratio * base_stiffness,
            amplitude,
            rate: steepness / end,
            reference: end,
        }
    }

    /// Returns the piece beyond a toe that ends at the strain `end` and does not move.
    #[inline(always)]
    pub(crate) fn beyond_toe(&self, end: f64) -> WeightPiece {
        let ExponentialToe { base_stiffness, stiffness, .. } = *self.toe;
        let ProportionalFriction { ratio, plateau, .. } = *self.friction;
        WeightPiece {
            constant: plateau - ratio * stiffness * self.toe.deficit() * end,
            slope: ratio * (base_stiffness + stiffness),
            amplitude: 0.0,
            rate: 0.0,
            reference: 0.0,
        }
    }

    /// Returns the piece beyond the largest elongation so far, along which the toe moves.
    #[inline(always)]
    pub(crate) fn virgin(&self) -> WeightPiece {
        let ExponentialToe { stiffness, toe_strain, toe_strain_after, .. } = *self.toe;
        let moved = self.friction.ratio * stiffness * self.toe.deficit();
        WeightPiece {
            amplitude: moved * (toe_strain_after - toe_strain),
            rate: -1.0 / toe_strain,
            reference: toe_strain,
            ..self.beyond_toe(toe_strain_after)
        }
    }
}
