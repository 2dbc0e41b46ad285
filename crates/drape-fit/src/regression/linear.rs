//! Linear least squares for initial guesses. Stiffness, zero and plateaus follow from the load for
//! given friction lengths.
//!
//! `curves` tries a grid of lengths and starts the nonlinear search from the best.

use nalgebra::{DMatrix, DVector};

/// Part of a column that the other columns must leave unexplained. Below this part the coefficients
/// are noise.
const DISTINCT: f64 = 1e-7;

/// Normal equations for columns over the points of a curve, whose linear combinations follow the
/// load.
pub(crate) struct LinearFit {
    /// Products of the columns, each scaled to length one.
    products: DMatrix<f64>,
    /// Products with the load.
    right: DVector<f64>,
    lengths: Vec<f64>,
    /// Sum of the squared loads.
    square: f64,
}

/// Linear combination of some of the columns.
pub(crate) struct Solution {
    /// Coefficients, in the order of the requested columns.
    pub(crate) coefficients: Vec<f64>,
    /// Sum of the squared residuals.
    pub(crate) residual_sum: f64,
}

impl LinearFit {
    /// Returns the normal equations of `columns` for the `load`.
    pub(crate) fn new(columns: &[Vec<f64>], load: &[f64]) -> Self {
        let flat: Vec<f64> = columns.iter().flatten().copied().collect();
        let mut matrix = DMatrix::from_vec(load.len(), columns.len(), flat);
        let lengths: Vec<f64> = matrix.column_iter().map(|column| column.norm()).collect();
        for (mut column, length) in matrix.column_iter_mut().zip(&lengths) {
            if *length > 0.0 {
                column.unscale_mut(*length);
            }
        }

        let load = DVector::from_column_slice(load);
        Self {
            products: matrix.tr_mul(&matrix),
            right: matrix.tr_mul(&load),
            lengths,
            square: load.norm_squared(),
        }
    }

    /// Returns the best combination of the given `columns`; `None` if they are linearly dependent.
    pub(crate) fn solve(&self, columns: &[usize]) -> Option<Solution> {
        let count = columns.len();
        let products =
            DMatrix::from_fn(count, count, |i, j| self.products[(columns[i], columns[j])]);
        let right = DVector::from_fn(count, |i, _| self.right[columns[i]]);
        let factor = products.cholesky()?;
        if factor.l_dirty().diagonal().min() < DISTINCT {
            return None;
        }
        let solution = factor.solve(&right);
        let residual_sum = self.square - solution.dot(&right);
        let scaled = columns.iter().zip(solution.iter());
        let coefficients = scaled.map(|(&j, c)| c / self.lengths[j]).collect();
        Some(Solution { coefficients, residual_sum })
    }
}

/// Returns `N` values between `from` and `to` at equal ratios.
pub(crate) fn geometric_grid<const N: usize>(from: f64, to: f64) -> [f64; N] {
    let step = (to / from).ln() / (N - 1) as f64;
    std::array::from_fn(|i| from * (step * i as f64).exp())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_combination_is_found_again_and_equal_columns_are_refused() {
        let x: Vec<f64> = (0..20).map(f64::from).collect();
        let squares: Vec<f64> = x.iter().map(|x| x * x).collect();
        let load: Vec<f64> = x.iter().map(|x| 3.0 * x - 0.25 * x * x).collect();
        let fit = LinearFit::new(&[x.clone(), squares, x], &load);
        let Solution { coefficients: found, residual_sum: left } = fit.solve(&[0, 1]).unwrap();
        assert!((found[0] - 3.0).abs() < 1e-10, "{found:?}");
        assert!((found[1] + 0.25).abs() < 1e-11, "{found:?}");
        assert!(left.abs() < 1e-9, "{left}");
        assert!(fit.solve(&[0, 1, 2]).is_none());
    }
}
