//! The step of a linear least squares problem within a radius.

use nalgebra::linalg::QR;
use nalgebra::{DMatrix, DVector, Dyn};

/// How near the length of a step must come to the radius.
///
/// The radius itself is only a guess within a factor of two, so a tenth is plenty [Moré 1978].
const NEAR: f64 = 0.1;
/// Newton's iterations for the damping: it gains a factor each, and two or three are usual.
const SEARCHES: usize = 60;
/// Steps of the singular value decomposition's own iteration, far more than it needs.
const ROTATIONS: usize = 10_000;

/// A linear model `$\|A z + r\|$` of the residuals in scaled parameters, decomposed once and solved for any
/// radius.
///
/// ```math
/// z(\lambda) = -V\,\mathrm{diag}\!\left(\frac{\sigma}{\sigma^2 + \lambda}\right) U^T r
/// ```
///
/// with `$A = U\Sigma V^T$`: the condition number is not squared, a loss of rank does no harm, and another
/// damping `$\lambda$` costs a product with `$V$`.
pub(super) struct Region {
    /// The matrix is decomposed in two steps: the triangle of this is what has the singular vectors.
    qr: QR<f64, Dyn, Dyn>,
    u: DMatrix<f64>,
    singular: DVector<f64>,
    v_t: DMatrix<f64>,
}

impl Region {
    /// Decomposes a matrix of at least as many rows as columns; nothing where that does not converge.
    pub fn new(matrix: DMatrix<f64>) -> Option<Self> {
        let qr = matrix.qr();
        let svd = qr.r().try_svd(true, true, f64::EPSILON, ROTATIONS)?;
        Some(Self { qr, u: svd.u?, singular: svd.singular_values, v_t: svd.v_t? })
    }

    /// The residuals in the basis of the singular vectors.
    pub fn project(&self, residuals: &DVector<f64>) -> DVector<f64> {
        let mut rotated = residuals.clone();
        self.qr.q_tr_mul(&mut rotated);
        self.u.tr_mul(&rotated.rows(0, self.u.nrows()))
    }

    /// Damping with which the step is as long as the radius, or zero where the undamped step is shorter.
    pub fn damping(&self, projected: &DVector<f64>, radius: f64) -> f64 {
        let floor = self.floor();
        let terms = || {
            let pairs = self.singular.iter().zip(projected.iter());
            pairs.filter(move |(s, _)| **s > floor)
        };
        let mut damping = 0.0;
        for _ in 0..SEARCHES {
            let (mut length, mut slope) = (0.0, 0.0);
            for (s, g) in terms() {
                let term = s * s + damping;
                length += (s * g / term).powi(2);
                slope += (s * g / term).powi(2) / term;
            }
            let length = length.sqrt();
            if !(length > radius * (1.0 + NEAR)) {
                break;
            }
            // Newton's step for 1/length, which is nearly straight: it comes from below and never overshoots.
            damping += length * length / slope * (length - radius) / radius;
        }
        damping
    }

    /// The step for a damping.
    pub fn step(&self, projected: &DVector<f64>, damping: f64) -> DVector<f64> {
        let floor = self.floor();
        let mut turned = projected.clone();
        for (g, s) in turned.iter_mut().zip(self.singular.iter()) {
            *g = if *s > floor { -*g * s / (s * s + damping) } else { 0.0 };
        }
        self.v_t.tr_mul(&turned)
    }

    /// Singular value below which rounding has made all of it.
    fn floor(&self) -> f64 {
        self.singular.max() * f64::EPSILON
    }
}
