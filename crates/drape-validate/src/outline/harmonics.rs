//! Harmonics of a closed curve: its first terms in a Fourier series.
//!
//! With `$N$` values `$r_k$` at even angles, the parts of harmonic `$n$` are
//!
//! ```math
//! a_n = \frac2N\sum_k r_k\cos\frac{2\pi nk}{N},\qquad b_n = \frac2N\sum_k r_k\sin\frac{2\pi nk}{N}
//! ```
//!
//! and its amplitude is `$\sqrt{a_n^2 + b_n^2}$`. The first harmonics alone are the curve without
//! ripples.

use std::f64::consts::TAU;

/// Closed curve by its first harmonics.
pub(crate) struct Harmonics {
    mean: f64,
    /// Cosine and sine parts.
    parts: Vec<[f64; 2]>,
}

impl Harmonics {
    pub(crate) fn of(curve: &[f64], harmonics: usize) -> Self {
        let count = curve.len() as f64;
        let part = |harmonic: usize| {
            let mut sums = [0.0; 2];
            for (k, value) in curve.iter().enumerate() {
                let (sin, cos) = (TAU * (harmonic * k) as f64 / count).sin_cos();
                sums = [sums[0] + value * cos, sums[1] + value * sin];
            }
            sums.map(|sum| 2.0 * sum / count)
        };
        let parts = (1..=harmonics).map(part).collect();
        Self { mean: curve.iter().sum::<f64>() / count, parts }
    }

    pub(crate) fn amplitudes(&self) -> Vec<f64> {
        self.parts.iter().map(|[cos, sin]| cos.hypot(*sin)).collect()
    }

    pub(crate) fn curve(&self, count: usize) -> Vec<f64> {
        let at = |k: usize| {
            let parts = self.parts.iter().enumerate().map(|(n, part)| {
                let (sin, cos) = (TAU * ((n + 1) * k) as f64 / count as f64).sin_cos();
                part[0] * cos + part[1] * sin
            });
            self.mean + parts.sum::<f64>()
        };
        (0..count).map(at).collect()
    }
}
