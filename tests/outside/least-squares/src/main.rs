//! Fits Misra1a and MGH17, two exponentials, of the NIST reference problems with `drape-lm`, and
//! holds parameters and standard errors against the certified values.

mod problem;
#[cfg(feature = "rival")]
mod rival;

use std::time::Instant;

use drape_lm::nalgebra::DMatrix;
use drape_lm::{Covariance, Loss, MinimiserSettings, Parameter, Problem, Undetermined, minimise};
use problem::{MGH17, MISRA1A, Reference};

/// Number of fits of each problem. The fastest counts.
const REPETITIONS: usize = 200;

impl Problem for Reference {
    fn residual_count(&self) -> usize {
        self.points.len()
    }

    fn residuals(&self, b: &[f64], out: &mut [f64]) {
        for (residual, [y, x]) in out.iter_mut().zip(self.points) {
            *residual = (self.model)(b, *x) - y;
        }
    }

    fn jacobian(&self, b: &[f64], out: &mut DMatrix<f64>) -> bool {
        let mut gradient = vec![0.0; b.len()];
        for (i, [_, x]) in self.points.iter().enumerate() {
            (self.gradient)(b, *x, &mut gradient);
            gradient.iter().enumerate().for_each(|(j, slope)| out[(i, j)] = *slope);
        }
        true
    }
}

/// Fits `problem` and compares the result with the certified values.
fn fit(problem: &Reference) -> Result<(), Undetermined> {
    let start: Vec<Parameter> = problem.start.iter().map(|b| Parameter::new(*b)).collect();
    let report = minimise(problem, &start, &MinimiserSettings::default());
    assert!(report.stop.converged(), "{report:?}");

    let covariance = Covariance::new(problem, &start, &report, Loss::Squares);
    for (j, [value, error]) in problem.certified.iter().enumerate() {
        let fitted = [report.parameters[j], covariance.standard_error(j)?];
        assert!((fitted[0] / value - 1.0).abs() < 1e-8, "b{} = {}", j + 1, fitted[0]);
        assert!((fitted[1] / error - 1.0).abs() < 1e-6, "error of b{}: {}", j + 1, fitted[1]);
    }
    Ok(())
}

fn main() -> Result<(), Undetermined> {
    let mut best = f64::MAX;
    for _ in 0..REPETITIONS {
        let begin = Instant::now();
        fit(&MISRA1A)?;
        fit(&MGH17)?;
        best = best.min(1e3 * begin.elapsed().as_secs_f64());
    }
    print!("Misra1a and MGH17 have their certified values and errors: {best:.3} ms");

    #[cfg(feature = "rival")]
    print!("; levenberg-marquardt: {:.3} ms", rival::best(REPETITIONS));
    println!();
    Ok(())
}
