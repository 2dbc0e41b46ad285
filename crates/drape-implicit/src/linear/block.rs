//! 3x3 blocks, row-major, and their products with the three numbers of a particle.

/// 3x3 block, row-major.
pub(crate) type Block = [f64; 9];

/// Block of zeros.
pub(crate) const ZERO: Block = [0.0; 9];

/// Returns the transpose of the block `a`.
#[inline(always)]
pub(crate) fn transposed(a: &Block) -> Block {
    [a[0], a[3], a[6], a[1], a[4], a[7], a[2], a[5], a[8]]
}

/// Adds the product `a x` to `y`.
#[inline(always)]
pub(crate) fn add_product(a: &Block, x: &[f64; 3], y: &mut [f64; 3]) {
    y[0] += a[0] * x[0] + a[1] * x[1] + a[2] * x[2];
    y[1] += a[3] * x[0] + a[4] * x[1] + a[5] * x[2];
    y[2] += a[6] * x[0] + a[7] * x[1] + a[8] * x[2];
}

/// Adds the product `aᵀ x` to `y`.
#[inline(always)]
pub(crate) fn add_transposed_product(a: &Block, x: &[f64; 3], y: &mut [f64; 3]) {
    y[0] += a[0] * x[0] + a[3] * x[1] + a[6] * x[2];
    y[1] += a[1] * x[0] + a[4] * x[1] + a[7] * x[2];
    y[2] += a[2] * x[0] + a[5] * x[1] + a[8] * x[2];
}

/// Returns the flat vector `x` as one triple per particle.
#[inline(always)]
pub(crate) fn triples(x: &[f64]) -> &[[f64; 3]] {
    x.as_chunks().0
}

/// Returns the flat vector `x` as one mutable triple per particle.
#[inline(always)]
pub(crate) fn triples_mut(x: &mut [f64]) -> &mut [[f64; 3]] {
    x.as_chunks_mut().0
}
