//! Fits Misra1a of the NIST reference problems and compares the result with its certified values.
//!
//! ```math
//! y = b_1\left(1 - e^{-b_2 x}\right)
//! ```

use drape_lm::nalgebra::DMatrix;
use drape_lm::{
    Covariance, Loss, MinimiserSettings, Parameter, Problem, ProfileSettings, Undetermined,
    minimise, profile,
};

/// Pressure and volume of a monomolecular adsorption.
const DATA: [[f64; 2]; 14] = [
    [77.6, 10.07],
    [114.9, 14.73],
    [141.1, 17.94],
    [190.8, 23.93],
    [239.9, 29.61],
    [289.0, 35.18],
    [332.8, 40.02],
    [378.4, 44.82],
    [434.8, 50.76],
    [477.3, 55.05],
    [536.8, 61.01],
    [593.1, 66.40],
    [689.1, 75.47],
    [760.0, 81.78],
];
/// Certified parameters, and their certified standard deviations.
const CERTIFIED: [f64; 2] = [2.389_421_291_8e2, 5.501_564_318_1e-4];
const CERTIFIED_ERRORS: [f64; 2] = [2.707_007_524_1, 7.266_868_843_6e-6];

struct Misra1a;

impl Problem for Misra1a {
    fn residual_count(&self) -> usize {
        DATA.len()
    }

    fn residuals(&self, b: &[f64], out: &mut [f64]) {
        for (residual, [x, y]) in out.iter_mut().zip(DATA) {
            *residual = b[0] * (1.0 - (-b[1] * x).exp()) - y;
        }
    }

    fn jacobian(&self, b: &[f64], out: &mut DMatrix<f64>) -> bool {
        for (i, [x, _]) in DATA.into_iter().enumerate() {
            let decay = (-b[1] * x).exp();
            out[(i, 0)] = 1.0 - decay;
            out[(i, 1)] = b[0] * x * decay;
        }
        true
    }
}

#[allow(clippy::print_stdout, reason = "an example prints its result")]
fn main() -> Result<(), Undetermined> {
    // The first of the two certified starts, which is far from the solution.
    let start = [500.0, 1e-4].map(Parameter::new);
    let report = minimise(&Misra1a, &start, &MinimiserSettings::default());
    let covariance = Covariance::new(&Misra1a, &start, &report, Loss::Squares);
    let intervals = profile(&Misra1a, &start, &report, &ProfileSettings::default());
    assert!(report.stop.converged());
    for j in 0..2 {
        let (value, error) = (report.parameters[j], covariance.standard_error(j)?);
        assert!((value / CERTIFIED[j] - 1.0).abs() < 1e-9, "{value}");
        assert!((error / CERTIFIED_ERRORS[j] - 1.0).abs() < 1e-8, "{error}");
        let interval = intervals[j].as_ref().map_err(Clone::clone)?;
        println!("b{} = {value:.10e} ± {error:.3e}, 95 % interval {interval:?}", j + 1);
    }
    Ok(())
}
