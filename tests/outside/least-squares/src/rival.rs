//! The same two problems by the crate `levenberg-marquardt`, which has no standard errors.

use std::time::Instant;

use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::{DMatrix, DVector, Dyn, Owned};

use crate::problem::{MGH17, MISRA1A, Reference};

/// Problem at some parameters.
struct At<'a>(&'a Reference, DVector<f64>);

impl LeastSquaresProblem<f64, Dyn, Dyn> for At<'_> {
    type ParameterStorage = Owned<f64, Dyn>;
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;

    fn set_params(&mut self, b: &DVector<f64>) {
        self.1.copy_from(b);
    }

    fn params(&self) -> DVector<f64> {
        self.1.clone()
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        let Self(problem, b) = self;
        let residual = |[y, x]: &[f64; 2]| (problem.model)(b.as_slice(), *x) - y;
        Some(DVector::from_iterator(problem.points.len(), problem.points.iter().map(residual)))
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        let Self(problem, b) = self;
        let mut out = DMatrix::zeros(problem.points.len(), b.len());
        let mut gradient = vec![0.0; b.len()];
        for (i, [_, x]) in problem.points.iter().enumerate() {
            (problem.gradient)(b.as_slice(), *x, &mut gradient);
            gradient.iter().enumerate().for_each(|(j, slope)| out[(i, j)] = *slope);
        }
        Some(out)
    }
}

/// Returns the shortest time of `repetitions` fits of both problems, in ms.
pub fn best(repetitions: usize) -> f64 {
    let mut best = f64::MAX;
    for _ in 0..repetitions {
        let begin = Instant::now();
        for problem in [&MISRA1A, &MGH17] {
            let start = DVector::from_column_slice(problem.start);
            let (fitted, report) = LevenbergMarquardt::new().minimize(At(problem, start));
            assert!(report.termination.was_successful(), "{report:?}");
            for (b, [value, _]) in fitted.1.iter().zip(problem.certified) {
                assert!((b / value - 1.0).abs() < 1e-6, "{b} is not {value}");
            }
        }
        best = best.min(1e3 * begin.elapsed().as_secs_f64());
    }
    best
}
