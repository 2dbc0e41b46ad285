//! Loss of a residual: its square, or a robust loss that limits the influence of outliers.

/// Function of a residual that is summed.
///
/// With `$u = (r/c)^2$` the sum is `$\sum_i c^2\rho(u_i)$`. A residual larger than the size `$c$`
/// has less influence than in least squares. Each residual `$r$` is first multiplied by the root of
/// its weight, so `$c$` is in the unit of the weighted residuals. A good `$c$` is
/// [`Loss::HUBER_TUNING`] or [`Loss::CAUCHY_TUNING`] times the standard deviation of the noise.
/// [`Loss::spread`] estimates this deviation without being misled by outliers.
///
/// ```
/// use drape_lm::Loss;
///
/// let noise = Loss::spread(&[0.1, -0.2, 0.15, -0.1, 40.0]);
/// let loss = Loss::Huber { size: Loss::HUBER_TUNING * noise };
/// assert!(loss.weight(0.1) == 1.0 && loss.weight(40.0) < 0.01);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Loss {
    /// Least squares: `$\rho = u$`. The default.
    #[default]
    Squares,
    /// Huber's loss: `$\rho = u$` for `$u \le 1$`, else `$2\sqrt u - 1$` \[Hub64\].
    ///
    /// The sum has a single minimum wherever the sum of squares has one.
    Huber {
        /// Size `$c$`, in the unit of the weighted residuals.
        size: f64,
    },
    /// Cauchy's loss: `$\rho = \ln(1 + u)$`.
    ///
    /// Outliers lose nearly all influence, but the sum may have false minima.
    Cauchy {
        /// Size `$c$`, in the unit of the weighted residuals.
        size: f64,
    },
}

impl Loss {
    /// Ratio of the size `$c$` of Huber's loss to the deviation of the noise that has an efficiency
    /// of 95 % for normal noise.
    pub const HUBER_TUNING: f64 = 1.345;
    /// Ratio of the size `$c$` of Cauchy's loss to the deviation of the noise that has an
    /// efficiency of 95 % for normal noise.
    pub const CAUCHY_TUNING: f64 = 2.385;

    /// Estimates the standard deviation of the noise from the median magnitude of `residuals`.
    ///
    /// For normal noise the median magnitude is 0.6745 standard deviations. Returns 0 if none of
    /// `residuals` is finite.
    #[must_use]
    pub fn spread(residuals: &[f64]) -> f64 {
        let mut sizes: Vec<f64> = residuals.iter().map(|r| r.abs()).collect();
        sizes.retain(|size| size.is_finite());
        sizes.sort_by(f64::total_cmp);
        let median = sizes.get(sizes.len() / 2).copied().unwrap_or(0.0);
        median / 0.674_489_750_196_081_7
    }

    /// Returns the loss of `residual`, `$c^2\rho$`.
    #[must_use]
    pub fn value(self, residual: f64) -> f64 {
        match self {
            Self::Squares => residual * residual,
            Self::Huber { size } if residual.abs() <= size => residual * residual,
            Self::Huber { size } => size * (2.0 * residual.abs() - size),
            Self::Cauchy { size } => size * size * (residual / size).powi(2).ln_1p(),
        }
    }

    /// Returns the weight `$\rho'(u)$` of the squared `residual` in the least squares problem that
    /// has the gradient of this loss.
    #[must_use]
    pub fn weight(self, residual: f64) -> f64 {
        match self {
            Self::Squares => 1.0,
            Self::Huber { size } if residual.abs() <= size => 1.0,
            Self::Huber { size } => size / residual.abs(),
            Self::Cauchy { size } => 1.0 / (1.0 + (residual / size).powi(2)),
        }
    }

    /// Returns the slope `$\psi'$` of the influence function `$\psi = r\rho'(u)$` at `residual`.
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
    fn the_influence_is_half_the_slope_of_the_loss_and_its_slope_is_the_influence_slope() {
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
