//! How much a large residual counts.

/// What is summed over the residuals: their squares, or something that grows more slowly for large ones.
///
/// With `$u = (r/c)^2$` the sum is `$\sum_i c^2\rho(u_i)$`, where `$c$` is the size of a residual from which on
/// it counts less. The residuals are those times the roots of their weights, so `$c$` is in that unit. A good
/// `$c$` is [`Loss::HUBER_TUNING`] or [`Loss::CAUCHY_TUNING`] times the standard deviation of the noise, which
/// [`Loss::spread`] estimates without being misled by outliers.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Loss {
    /// `$\rho = u$`: least squares.
    #[default]
    Squares,
    /// `$\rho = u$` for `$u \le 1$`, else `$2\sqrt u - 1$`: least squares within, absolute values beyond
    /// [Huber 1964]. It has one minimum where least squares have one.
    Huber {
        /// The size `$c$`, in the unit of the weighted residuals.
        size: f64,
    },
    /// `$\rho = \ln(1 + u)$`: outliers lose nearly all influence, at the price of possible false minima.
    Cauchy {
        /// The size `$c$`, in the unit of the weighted residuals.
        size: f64,
    },
}

impl Loss {
    /// Size of Huber's loss over the noise at which 5 % of the precision is given up where there are no
    /// outliers.
    pub const HUBER_TUNING: f64 = 1.345;
    /// Size of Cauchy's loss over the noise at which 5 % of the precision is given up where there are no
    /// outliers.
    pub const CAUCHY_TUNING: f64 = 2.385;

    /// Standard deviation of the noise from the median size of the residuals, in their unit.
    ///
    /// For normal noise the median of the sizes is 0.6745 standard deviations. Zero where no residual is
    /// finite.
    #[must_use]
    pub fn spread(residuals: &[f64]) -> f64 {
        let mut sizes: Vec<f64> = residuals.iter().map(|r| r.abs()).collect();
        sizes.retain(|size| size.is_finite());
        sizes.sort_by(f64::total_cmp);
        let median = sizes.get(sizes.len() / 2).copied().unwrap_or(0.0);
        median / 0.674_489_750_196_081_7
    }

    /// What a residual adds to the sum, `$c^2\rho$`.
    #[must_use]
    pub fn value(self, residual: f64) -> f64 {
        match self {
            Self::Squares => residual * residual,
            Self::Huber { size } if residual.abs() <= size => residual * residual,
            Self::Huber { size } => size * (2.0 * residual.abs() - size),
            Self::Cauchy { size } => size * size * (residual / size).powi(2).ln_1p(),
        }
    }

    /// Weight `$\rho'(u)$` of the squared residual in the least squares problem that has the same gradient.
    #[must_use]
    pub fn weight(self, residual: f64) -> f64 {
        match self {
            Self::Squares => 1.0,
            Self::Huber { size } if residual.abs() <= size => 1.0,
            Self::Huber { size } => size / residual.abs(),
            Self::Cauchy { size } => 1.0 / (1.0 + (residual / size).powi(2)),
        }
    }

    /// Slope `$\psi'$` of the influence `$\psi = r\rho'(u)$` of a residual.
    #[must_use]
    pub fn influence_slope(self, residual: f64) -> f64 {
        match self {
            Self::Squares => 1.0,
            Self::Huber { size } => f64::from(residual.abs() <= size),
            Self::Cauchy { size } => {
                let u = (residual / size).powi(2);
                (1.0 - u) / (1.0 + u).powi(2)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LOSSES: [Loss; 3] =
        [Loss::Squares, Loss::Huber { size: 0.7 }, Loss::Cauchy { size: 0.7 }];

    #[test]
    fn the_influence_is_half_the_slope_of_the_loss_and_its_slope_is_its_own() {
        // Central differences of smooth functions: step squared over six, some 1e-10.
        let step = 1e-5;
        for loss in LOSSES {
            for residual in [-3.0, -0.69, -0.2, 0.0, 0.3, 0.71, 5.0] {
                let influence = |r: f64| r * loss.weight(r);
                let slope =
                    (loss.value(residual + step) - loss.value(residual - step)) / step / 4.0;
                let error = slope - influence(residual);
                assert!(error.abs() < 1e-9, "{loss:?} at {residual}: {error:e}");
                let slope = (influence(residual + step) - influence(residual - step)) / step / 2.0;
                let error = slope - loss.influence_slope(residual);
                assert!(error.abs() < 1e-8, "{loss:?} at {residual}: {error:e}");
            }
        }
    }

    #[test]
    fn the_spread_of_normal_quantiles_is_their_deviation_with_one_tenth_of_them_spoilt() {
        // Quantiles of the unit normal distribution at 0.05, 0.15 … 0.95.
        let mut sample =
            [-1.6449, -1.0364, -0.6745, -0.3853, -0.1257, 0.1257, 0.3853, 0.6745, 1.0364, 1.6449];
        sample[0] = -1e6;
        let spread = Loss::spread(&sample);
        assert!((spread - 1.0).abs() < 1e-3, "{spread}");
    }
}
