//! Three-by-three blocks, row-major, and the few products that the solvers need.

/// A 3x3 block, row-major.
pub(crate) type Block = [f64; 9];

/// The block of zeros.
pub(crate) const ZERO: Block = [0.0; 9];

/// Transpose of a block.
#[inline(always)]
pub(crate) fn transposed(a: &Block) -> Block {
    [a[0], a[3], a[6], a[1], a[4], a[7], a[2], a[5], a[8]]
}

/// `y + a x`.
#[inline(always)]
pub(crate) fn add_product(a: &Block, x: &[f64; 3], y: &mut [f64; 3]) {
    y[0] += a[0] * x[0] + a[1] * x[1] + a[2] * x[2];
    y[1] += a[3] * x[0] + a[4] * x[1] + a[5] * x[2];
    y[2] += a[6] * x[0] + a[7] * x[1] + a[8] * x[2];
}

/// `y + aᵀ x`.
#[inline(always)]
pub(crate) fn add_transposed_product(a: &Block, x: &[f64; 3], y: &mut [f64; 3]) {
    y[0] += a[0] * x[0] + a[3] * x[1] + a[6] * x[2];
    y[1] += a[1] * x[0] + a[4] * x[1] + a[7] * x[2];
    y[2] += a[2] * x[0] + a[5] * x[1] + a[8] * x[2];
}

/// A block by rows, each with a fourth entry to fill a register: what it holds is never read as part of the block.
pub(crate) type Rows = [[f64; 4]; 3];

#[inline(always)]
pub(crate) fn by_rows([a, b, c, d, e, f, g, h, i]: &Block) -> Rows {
    [[*a, *b, *c, 0.0], [*d, *e, *f, 0.0], [*g, *h, *i, 0.0]]
}

#[inline(always)]
pub(crate) fn from_rows(rows: &Rows) -> Block {
    let [[a, b, c, _], [d, e, f, _], [g, h, i, _]] = *rows;
    [a, b, c, d, e, f, g, h, i]
}

/// `aᵀ b`.
#[inline(always)]
pub(crate) fn transposed_product(a: &Block, b: &Rows) -> Rows {
    let mut c = [[0.0; 4]; 3];
    for (k, row) in c.iter_mut().enumerate() {
        for (lane, entry) in row.iter_mut().enumerate() {
            *entry = (b[0][lane] * a[k] + b[1][lane] * a[3 + k]) + b[2][lane] * a[6 + k];
        }
    }
    c
}

/// `a − b`.
#[inline(always)]
pub(crate) fn subtract(a: &mut Rows, b: &Rows) {
    for (a, b) in a.iter_mut().zip(b) {
        for (a, b) in a.iter_mut().zip(b) {
            *a -= b;
        }
    }
}

/// `factor (a + aᵀ)/2`.
#[inline(always)]
pub(crate) fn symmetric_part(a: &Block, factor: f64) -> Rows {
    let [b, c, f] = [a[1] + a[3], a[2] + a[6], a[5] + a[7]].map(|sum| 0.5 * factor * sum);
    let [d, e, g] = [a[0], a[4], a[8]].map(|entry| factor * entry);
    by_rows(&[d, b, c, b, e, f, c, f, g])
}

/// Determinant of a symmetric block, from its upper half.
#[inline(always)]
pub(crate) fn determinant(a: &Block) -> f64 {
    let [a00, a01, a02, _, a11, a12, _, _, a22] = *a;
    a00 * (a11 * a22 - a12 * a12) - a01 * (a01 * a22 - a12 * a02) + a02 * (a01 * a12 - a11 * a02)
}

/// Determinant of a symmetric block if it is positive definite (its leading minors are positive).
/// A block with a NaN in it is not.
#[inline(always)]
pub(crate) fn definite_determinant(a: &Block) -> Option<f64> {
    let minor = a[0] * a[4] - a[1] * a[1];
    let det = determinant(a);
    (a[0] > 0.0 && minor > 0.0 && det > 0.0).then_some(det)
}

/// Inverse of a symmetric block of known determinant, from its upper half.
#[inline(always)]
pub(crate) fn symmetric_inverse(a: &Block, det: f64) -> Block {
    let [a00, a01, a02, _, a11, a12, _, _, a22] = *a;
    let s = 1.0 / det;
    let b00 = (a11 * a22 - a12 * a12) * s;
    let b01 = (a02 * a12 - a01 * a22) * s;
    let b02 = (a01 * a12 - a02 * a11) * s;
    let b11 = (a00 * a22 - a02 * a02) * s;
    let b12 = (a01 * a02 - a00 * a12) * s;
    let b22 = (a00 * a11 - a01 * a01) * s;
    [b00, b01, b02, b01, b11, b12, b02, b12, b22]
}

/// Views a flat vector as one triple per particle.
#[inline(always)]
pub(crate) fn triples(x: &[f64]) -> &[[f64; 3]] {
    x.as_chunks().0
}

/// Views a flat vector as one mutable triple per particle.
#[inline(always)]
pub(crate) fn triples_mut(x: &mut [f64]) -> &mut [[f64; 3]] {
    x.as_chunks_mut().0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_symmetric_block_times_its_inverse_is_the_identity() {
        let a = [4.0, 1.0, -0.5, 1.0, 3.0, 0.25, -0.5, 0.25, 2.0];
        let det = definite_determinant(&a).unwrap();
        let product = transposed_product(&a, &by_rows(&symmetric_inverse(&a, det)));
        let identity = from_rows(&product);
        for (k, value) in identity.iter().enumerate() {
            let expected = if k % 4 == 0 { 1.0 } else { 0.0 };
            assert!((value - expected).abs() < 1e-15, "entry {k}: {value}");
        }
    }

    #[test]
    fn indefinite_and_nan_blocks_have_no_definite_determinant() {
        let indefinite = [1.0, 2.0, 0.0, 2.0, 1.0, 0.0, 0.0, 0.0, 1.0];
        assert_eq!(definite_determinant(&indefinite), None);
        // Two negative directions: the determinant alone would let it pass.
        let twice = [-1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 1.0];
        assert_eq!(definite_determinant(&twice), None);
        assert_eq!(definite_determinant(&[f64::NAN; 9]), None);
    }
}
