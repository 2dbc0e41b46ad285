//! Flat vectors. The order of a sum depends on the length alone, so every machine computes equal
//! bits.

use crate::linear::lanes::LANES;

/// Returns the dot product `Σ aᵢ bᵢ`.
#[inline(always)]
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (heads, tail) = a.as_chunks::<LANES>();
    let (b_heads, b_tail) = b.as_chunks::<LANES>();
    let mut partial = [0.0; LANES];
    for (x, y) in heads.iter().zip(b_heads) {
        for k in 0..LANES {
            partial[k] += x[k] * y[k];
        }
    }
    let mut rest = 0.0;
    for (x, y) in tail.iter().zip(b_tail) {
        rest += x * y;
    }
    sum(partial) + rest
}

/// Returns the sum of the `partial` sums.
#[inline(always)]
pub(crate) fn sum(mut partial: [f64; LANES]) -> f64 {
    for half in [4, 2, 1] {
        for k in 0..half {
            partial[k] += partial[k + half];
        }
    }
    partial[0]
}

/// Returns the Euclidean norm of `a`, NaN if an entry is NaN.
pub(crate) fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

/// Adds `factor · x` to `y`.
#[inline(always)]
pub(crate) fn add_scaled(y: &mut [f64], factor: f64, x: &[f64]) {
    for (y, x) in y.iter_mut().zip(x) {
        *y += factor * x;
    }
}

/// Returns the particle of the first entry of `x` that is not finite.
pub(crate) fn first_not_finite(x: &[f64]) -> Option<usize> {
    x.iter().position(|x| !x.is_finite()).map(|k| k / 3)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sum_of_squares_of_the_first_integers_is_the_closed_form() {
        for n in [0_u32, 1, 7, 8, 9, 100] {
            let a: Vec<f64> = (1..=n).map(f64::from).collect();
            let closed = f64::from(n) * f64::from(n + 1) * f64::from(2 * n + 1) / 6.0;
            assert_eq!(dot(&a, &a), closed, "n = {n}");
        }
    }
}
