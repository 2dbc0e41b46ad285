//! 3x3 blocks, eight side by side: products, determinants and inverses.

use core::ops::{Add, Mul};

use crate::linear::lanes::{Double, LANES, Number, Single};

/// 3x3 blocks, one per lane, row-major.
pub(crate) type Blocks<T> = [T; 9];

/// Symmetric blocks, one per lane, upper half: xx, xy, xz, yy, yz, zz.
pub(crate) type SymmetricBlocks<T> = [T; 6];

/// Rows and columns of the upper half of a block.
const UPPER: [(usize, usize); 6] = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)];

/// Returns the product of the blocks `a` and the vectors `[x, y, z]`.
#[inline(always)]
pub(crate) fn product<T: Copy + Add<Output = T> + Mul<Output = T>>(
    a: &Blocks<T>,
    [x, y, z]: [T; 3],
) -> [T; 3] {
    [
        (a[0] * x + a[1] * y) + a[2] * z,
        (a[3] * x + a[4] * y) + a[5] * z,
        (a[6] * x + a[7] * y) + a[8] * z,
    ]
}

/// Returns the product of the transposed blocks `aᵀ` and the vectors `[x, y, z]`.
#[inline(always)]
pub(crate) fn transposed_product<T: Copy + Add<Output = T> + Mul<Output = T>>(
    a: &Blocks<T>,
    [x, y, z]: [T; 3],
) -> [T; 3] {
    [
        (a[0] * x + a[3] * y) + a[6] * z,
        (a[1] * x + a[4] * y) + a[7] * z,
        (a[2] * x + a[5] * y) + a[8] * z,
    ]
}

/// Returns the product of the symmetric blocks `[a, b, c, d, e, f]` and the vectors `[x, y, z]`.
#[inline(always)]
pub(crate) fn symmetric_product<T: Copy + Add<Output = T> + Mul<Output = T>>(
    [a, b, c, d, e, f]: &SymmetricBlocks<T>,
    [x, y, z]: [T; 3],
) -> [T; 3] {
    [(*a * x + *b * y) + *c * z, (*b * x + *d * y) + *e * z, (*c * x + *e * y) + *f * z]
}

/// Returns the determinants of the symmetric blocks `[a, b, c, d, e, f]`.
#[inline(always)]
pub(crate) fn determinant([a, b, c, d, e, f]: &SymmetricBlocks<Double>) -> Double {
    (*a * (*d * *f - *e * *e) - *b * (*b * *f - *e * *c)) + *c * (*b * *e - *d * *c)
}

/// Returns whether all `blocks` are positive definite, by their leading minors, with determinants
/// of at least `least`. A block with a NaN is not definite.
#[inline(always)]
pub(crate) fn are_definite(blocks: &SymmetricBlocks<Double>, least: Double) -> bool {
    let [a, b, _, d, ..] = blocks;
    let minor = *a * *d - *b * *b;
    let det = determinant(blocks);
    let mut definite = true;
    for lane in 0..LANES {
        definite &= (a.0[lane] > 0.0) & (minor.0[lane] > 0.0);
        definite &= (det.0[lane] > 0.0) & (det.0[lane] >= least.0[lane]);
    }
    definite
}

/// Returns the inverses of the symmetric blocks `[a, b, c, d, e, f]` with the determinants `det`.
#[inline(always)]
pub(crate) fn inverse(
    [a, b, c, d, e, f]: &SymmetricBlocks<Double>,
    det: Double,
) -> SymmetricBlocks<Double> {
    let mut s = Double::ZERO;
    for (s, det) in s.0.iter_mut().zip(det.0) {
        *s = 1.0 / det;
    }
    [
        (*d * *f - *e * *e) * s,
        (*c * *e - *b * *f) * s,
        (*b * *e - *c * *d) * s,
        (*a * *f - *c * *c) * s,
        (*b * *c - *a * *e) * s,
        (*a * *d - *b * *b) * s,
    ]
}

/// Returns the product `p b` of symmetric blocks `p` and blocks `b`.
#[inline(always)]
pub(crate) fn symmetric_times<T: Number>(p: &SymmetricBlocks<T>, b: &Blocks<T>) -> Blocks<T> {
    let x = symmetric_product(p, [b[0], b[3], b[6]]);
    let y = symmetric_product(p, [b[1], b[4], b[7]]);
    let z = symmetric_product(p, [b[2], b[5], b[8]]);
    [x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2]]
}

/// Returns the product `aᵀ b`.
#[inline(always)]
pub(crate) fn transposed_times<T: Number>(a: &Blocks<T>, b: &Blocks<T>) -> Blocks<T> {
    let x = transposed_product(a, [b[0], b[3], b[6]]);
    let y = transposed_product(a, [b[1], b[4], b[7]]);
    let z = transposed_product(a, [b[2], b[5], b[8]]);
    [x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2]]
}

/// Returns the upper half of the product `aᵀ b`, which must be symmetric.
#[inline(always)]
pub(crate) fn upper_half_of_product<T: Number>(a: &Blocks<T>, b: &Blocks<T>) -> SymmetricBlocks<T> {
    let mut half = [a[0]; 6];
    for (half, (row, column)) in half.iter_mut().zip(UPPER) {
        *half = (a[row] * b[column] + a[3 + row] * b[3 + column]) + a[6 + row] * b[6 + column];
    }
    half
}

/// Returns the upper half of the symmetric part of the blocks `a`.
#[inline(always)]
pub(crate) fn symmetric_part<T: Number>(a: &Blocks<T>) -> SymmetricBlocks<T> {
    let half = T::splat(0.5);
    let [a, b, c, d, e, f, g, h, i] = *a;
    [a, half * (b + d), half * (c + g), e, half * (f + h), i]
}

/// Returns the entries of `blocks` in `lane`.
#[inline(always)]
pub(crate) fn extract_lane<const N: usize>(blocks: &[Single; N], lane: u32) -> [f32; N] {
    let mut entries = [0.0; N];
    for (entry, lanes) in entries.iter_mut().zip(blocks) {
        *entry = lanes.0[lane as usize];
    }
    entries
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The same block in all lanes.
    fn halves(a: SymmetricBlocks<f64>) -> SymmetricBlocks<Double> {
        a.map(Double::splat)
    }

    #[test]
    fn a_symmetric_block_times_its_inverse_is_the_identity() {
        let a = halves([4.0, 1.0, -0.5, 3.0, 0.25, 2.0]);
        let inverse = inverse(&a, determinant(&a));
        let [p, q, r, s, t, u] = inverse;
        let product = symmetric_times(&a, &[p, q, r, q, s, t, r, t, u]);
        for (k, value) in product.iter().enumerate() {
            let expected = if k % 4 == 0 { 1.0 } else { 0.0 };
            assert!((value.0[3] - expected).abs() < 1e-15, "entry {k}: {value:?}");
        }
    }

    #[test]
    fn blocks_indefinite_in_one_lane_or_not_a_number_are_not_definite() {
        let mut a = halves([4.0, 1.0, -0.5, 3.0, 0.25, 2.0]);
        assert!(are_definite(&a, Double::ZERO));
        assert!(!are_definite(&a, Double::splat(100.0)), "its determinant is 20.75");
        // Two negative directions: the determinant alone would let it pass.
        let twice = [-1.0, 0.0, 0.0, -1.0, 0.0, 1.0];
        for (entry, value) in a.iter_mut().zip(twice) {
            entry.0[5] = value;
        }
        assert!(!are_definite(&a, Double::ZERO));
        assert!(!are_definite(&halves([f64::NAN; 6]), Double::ZERO));
    }
}
