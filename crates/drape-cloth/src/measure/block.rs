//! 3 × 3 blocks of second derivatives, in scalar form.

use crate::measure::vector::{Vector, add, scale};

/// Block of the second derivatives of the energy with respect to two particles, in N/m, row by row.
pub type Block = [f64; 9];

/// 3 × 3 matrix by its rows.
pub(crate) type Matrix = [Vector; 3];

/// Returns the outer product `$ab^T$`.
pub(crate) fn outer(a: Vector, b: Vector) -> Matrix {
    a.map(|a| b.map(|b| a * b))
}

pub(crate) fn identity() -> Matrix {
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
}

/// Returns the sum of the matrices in `terms`, each times its factor.
pub(crate) fn sum<const N: usize>(terms: [(f64, Matrix); N]) -> Matrix {
    let mut sum = [[0.0; 3]; 3];
    for (factor, matrix) in terms {
        for (row, term) in sum.iter_mut().zip(matrix) {
            *row = add(*row, scale(term, factor));
        }
    }
    sum
}

pub(crate) fn transposed(matrix: Matrix) -> Matrix {
    [0, 1, 2].map(|row| [matrix[0][row], matrix[1][row], matrix[2][row]])
}
