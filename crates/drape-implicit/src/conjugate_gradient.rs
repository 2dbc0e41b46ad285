//! Conjugate gradients with the incomplete factor as preconditioner.

use crate::BlockMatrix;
use crate::incomplete::Incomplete;
use crate::vector::{descend, dot, norm};

/// How conjugate gradients ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Ending {
    /// The residual is below the target.
    Converged,
    /// Out of iterations: the result is a descent direction all the same.
    Truncated,
    /// A direction along which the matrix is not positive was met.
    Indefinite,
}

/// Work space of the iteration.
#[derive(Debug)]
pub(crate) struct ConjugateGradient {
    residual: Vec<f64>,
    preconditioned: Vec<f64>,
    direction: Vec<f64>,
    product: Vec<f64>,
}

impl ConjugateGradient {
    pub(crate) fn new(length: usize) -> Self {
        let zeros = || vec![0.0; length];
        Self { residual: zeros(), preconditioned: zeros(), direction: zeros(), product: zeros() }
    }

    /// Solves `A x = b` from `x = 0` until `‖b − A x‖₂ ≤ target`, in at least one iteration. `x` holds `b ≠ 0` on
    /// entry. Returns the iterations made and how they ended.
    pub(crate) fn solve(
        &mut self,
        (matrix, preconditioner): (&BlockMatrix, &mut Incomplete),
        x: &mut [f64],
        target: f64,
        limit: usize,
    ) -> (usize, Ending) {
        let Self { residual, preconditioned, direction, product } = self;
        residual.copy_from_slice(x);
        x.fill(0.0);
        preconditioner.solve(residual, preconditioned, norm(residual));
        direction.copy_from_slice(preconditioned);
        let mut weight = dot(residual, preconditioned);
        for iteration in 1..=limit {
            matrix.multiply(direction, product);
            let curvature = dot(direction, product);
            // Written so that a NaN takes this way too.
            let positive = curvature > 0.0 && weight > 0.0;
            if !positive {
                return (iteration, Ending::Indefinite);
            }
            let step = weight / curvature;
            let length = descend(step, (&mut *x, direction), (residual, product));
            if length <= target {
                return (iteration, Ending::Converged);
            }
            preconditioner.solve(residual, preconditioned, length);
            let next = dot(residual, preconditioned);
            let turn = next / weight;
            weight = next;
            for (d, z) in direction.iter_mut().zip(preconditioned.iter()) {
                *d = z + turn * *d;
            }
        }
        (limit, Ending::Truncated)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Pattern;
    use crate::vector::add_scaled;

    /// The Laplacian of an n × n grid, shifted: its incomplete factor is not exact.
    fn grid(n: usize, shift: f64) -> BlockMatrix {
        let cells = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
        let pairs: Vec<(usize, usize)> = cells
            .flat_map(|(i, j)| [(i, j, i, j + 1), (i, j, i + 1, j)])
            .filter(|&(.., i, j)| i < n && j < n)
            .map(|(a, b, c, d)| (a * n + b, c * n + d))
            .collect();
        let mut matrix = BlockMatrix::zeros(Pattern::from_pairs(n * n, pairs.clone()).unwrap());
        let scaled = |s: f64| [s, 0.0, 0.0, 0.0, s, 0.0, 0.0, 0.0, s];
        for i in 0..n * n {
            matrix.add(i, i, &scaled(4.0 + shift));
        }
        for (i, j) in pairs {
            matrix.add(i, j, &scaled(-1.0));
        }
        matrix
    }

    fn solve(matrix: &BlockMatrix, limit: usize) -> (f64, usize, Ending) {
        let size = 3 * matrix.pattern().particles();
        let b: Vec<f64> = (0..size).map(|k| (k as f64 * 0.37).sin()).collect();
        let mut incomplete = Incomplete::new(matrix.pattern());
        incomplete.factorise(matrix).unwrap();
        let mut x = b.clone();
        let mut back = vec![0.0; size];
        let target = 1e-10 * norm(&b);
        let mut gradient = ConjugateGradient::new(size);
        let (iterations, ending) = gradient.solve((matrix, &mut incomplete), &mut x, target, limit);
        matrix.multiply(&x, &mut back);
        add_scaled(&mut back, -1.0, &b);
        assert!(ending == Ending::Indefinite || dot(&x, &b) > 0.0, "not a descent direction");
        (norm(&back) / norm(&b), iterations, ending)
    }

    #[test]
    fn a_definite_system_is_solved_to_the_target() {
        let (residual, iterations, ending) = solve(&grid(20, 1e-3), 200);
        assert_eq!(ending, Ending::Converged);
        // The recurrence's residual drifts from the true one by rounding only.
        assert!(residual < 1.1e-10, "{residual:e}");
        assert!(iterations < 40, "{iterations} iterations");
    }

    #[test]
    fn negative_curvature_and_a_short_limit_are_told_apart() {
        let (_, _, indefinite) = solve(&grid(20, -1.0), 200);
        assert_eq!(indefinite, Ending::Indefinite);
        let (residual, iterations, truncated) = solve(&grid(20, 1e-3), 5);
        assert_eq!((iterations, truncated), (5, Ending::Truncated));
        assert!(residual > 1e-10, "{residual:e}");
    }
}
