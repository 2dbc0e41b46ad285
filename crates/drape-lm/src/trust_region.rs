//! Step of a linear least squares problem within a trust region.
//!
//! `iterate` builds a [`TrustRegion`] from the scaled Jacobian. The trust region returns the
//! damping and the step.

use nalgebra::linalg::QR;
use nalgebra::{DMatrix, DVector, Dyn};

/// Largest relative excess of the length of a step over the radius.
///
/// The radius is itself only good to a factor of two, so a tenth is enough \[Mor78\].
const LENGTH_TOLERANCE: f64 = 0.1;
/// Limit on the Newton iterations for the damping. Two or three are usual.
const DAMPING_ITERATIONS: usize = 60;
/// Limit on the iterations of the singular value decomposition, far more than it needs.
const SVD_ITERATIONS: usize = 10_000;

/// Linear model `$\|A z + r\|$` of the residuals in scaled parameters, decomposed once and solved
/// for any radius.
///
/// ```math
/// z(\lambda) = -V\,\mathrm{diag}\!\left(\frac{\sigma}{\sigma^2 + \lambda}\right) U^T r
/// ```
///
/// with the singular value decomposition `$A = U\Sigma V^T$`. The condition number is not squared,
/// a loss of rank does no harm, and another damping `$\lambda$` costs one product with `$V$`.
pub(crate) struct TrustRegion {
    /// Decomposition `$A = QR$`.
    qr: QR<f64, Dyn, Dyn>,
    /// Left singular vectors of `$R$`.
    u: DMatrix<f64>,
    /// Singular values of `$A$`, which are also the singular values of `$R$`.
    singular: DVector<f64>,
    /// Right singular vectors of `$A$`, in rows.
    v_t: DMatrix<f64>,
}

impl TrustRegion {
    /// Decomposes `matrix`, which has at least as many rows as columns. Returns `None` if the
    /// singular value decomposition does not converge.
    pub(crate) fn new(matrix: DMatrix<f64>) -> Option<Self> {
        let qr = matrix.qr();
        let svd = qr.r().try_svd(true, true, f64::EPSILON, SVD_ITERATIONS)?;
        Some(Self { qr, u: svd.u?, singular: svd.singular_values, v_t: svd.v_t? })
    }

    /// Returns the components of `residuals` along the left singular vectors.
    pub(crate) fn project(&self, residuals: &DVector<f64>) -> DVector<f64> {
        let mut rotated = residuals.clone();
        self.qr.q_tr_mul(&mut rotated);
        self.u.tr_mul(&rotated.rows(0, self.u.nrows()))
    }

    /// Returns the damping at which the step is as long as `radius`, or 0 if the undamped step is
    /// shorter than `radius`. `projected` are the residuals from [`TrustRegion::project`].
    pub(crate) fn damping(&self, projected: &DVector<f64>, radius: f64) -> f64 {
        let floor = self.floor();
        let mut damping = 0.0;
        for _ in 0..DAMPING_ITERATIONS {
            let (mut length, mut slope) = (0.0, 0.0);
            let pairs = self.singular.iter().zip(projected.iter());
            for (s, g) in pairs.filter(|(s, _)| **s > floor) {
                let term = s * s + damping;
                length += (s * g / term).powi(2);
                slope += (s * g / term).powi(2) / term;
            }
            let length = length.sqrt();
            if !(length > radius * (1.0 + LENGTH_TOLERANCE)) {
                break;
            }

            // Newton's step is taken for 1/length, which is nearly linear in the damping. The
            // damping therefore converges from below without overshooting.
            damping += length * length / slope * (length - radius) / radius;
        }
        damping
    }

    /// Returns the step with the given `damping`. `projected` are the residuals from
    /// [`TrustRegion::project`].
    pub(crate) fn step(&self, projected: &DVector<f64>, damping: f64) -> DVector<f64> {
        let floor = self.floor();
        let mut rotated = projected.clone();
        for (g, s) in rotated.iter_mut().zip(self.singular.iter()) {
            *g = if *s > floor { -*g * s / (s * s + damping) } else { 0.0 };
        }
        self.v_t.tr_mul(&rotated)
    }

    /// Returns the threshold below which a singular value of `$A$` is only rounding.
    fn floor(&self) -> f64 {
        self.singular.max() * f64::EPSILON
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_step_that_is_longer_than_the_radius_is_damped() {
        // The residual 2 with the slope 4 takes the step 8/(16 + λ).
        let region = TrustRegion::new(DMatrix::from_element(1, 1, 4.0)).expect("one column");
        let projected = region.project(&DVector::from_element(1, 2.0));
        for (radius, exact) in [(0.1, 64.0), (0.4, 4.0), (0.5, 0.0), (0.52, 0.0), (3.0, 0.0)] {
            let damping = region.damping(&projected, radius);
            assert!((damping - exact).abs() < 1e-12, "radius {radius}: {damping}");
        }
    }
}
