//! Harmonics of a closed curve: its first terms in a Fourier series.
//!
//! With `$N$` values `$r_k$` at even angles, the parts of harmonic `$n$` are
//!
//! ```math
//! a_n = \frac2N\sum_k r_k\cos\frac{2\pi nk}{N},\qquad b_n = \frac2N\sum_k r_k\sin\frac{2\pi nk}{N}
//! ```
//!
//! and the amplitude of the harmonic is `$\sqrt{a_n^2 + b_n^2}$`. The first harmonics alone are the
//! curve without ripples.

use std::f64::consts::TAU;

/// Closed curve as its mean and its first harmonics.
pub(crate) struct Harmonics {
    mean: f64,
    /// Cosine and sine parts of the harmonics 1, 2, …
    parts: Vec<[f64; 2]>,
}

impl Harmonics {
    /// Returns the first `harmonics` harmonics of `curve`, which has values at even angles.
    pub(crate) fn new(curve: &[f64], harmonics: usize) -> Self {
        let parts = (1..=harmonics).map(|harmonic| harmonic_parts(curve, harmonic)).collect();
        Self { mean: curve.iter().sum::<f64>() / curve.len() as f64, parts }
    }

    /// Returns the amplitudes of the harmonics 1, 2, …, in the unit of the curve.
    pub(crate) fn amplitudes(&self) -> Vec<f64> {
        self.parts.iter().map(|[cos, sin]| cos.hypot(*sin)).collect()
    }

    /// Returns the values of the smooth curve at `count` even angles.
    pub(crate) fn curve(&self, count: usize) -> Vec<f64> {
        (0..count)
            .map(|k| {
                let parts = self.parts.iter().enumerate().map(|(n, part)| {
                    let (sin, cos) = (TAU * ((n + 1) * k) as f64 / count as f64).sin_cos();
                    part[0] * cos + part[1] * sin
                });
                self.mean + parts.sum::<f64>()
            })
            .collect()
    }
}

/// Returns the cosine and the sine part of one `harmonic` of `curve`.
fn harmonic_parts(curve: &[f64], harmonic: usize) -> [f64; 2] {
    let count = curve.len() as f64;
    let mut sums = [0.0; 2];
    for (k, value) in curve.iter().enumerate() {
        let (sin, cos) = (TAU * (harmonic * k) as f64 / count).sin_cos();
        sums = [sums[0] + value * cos, sums[1] + value * sin];
    }
    sums.map(|sum| 2.0 * sum / count)
}
