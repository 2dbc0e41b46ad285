//! One reference problem: its data file and its residuals.

use std::fs;
use std::path::PathBuf;

use drape_lm::{Parameter, Problem};
use nalgebra::DMatrix;

use crate::model::{MODELS, Model};
use crate::number::Dual;

/// Problem with its certified solution.
pub struct Nist {
    pub name: &'static str,
    /// Starting values, the far and the near ones.
    pub starts: [Vec<f64>; 2],
    /// Certified parameters.
    pub certified: Vec<f64>,
    /// Certified standard deviations of the parameters.
    pub deviations: Vec<f64>,
    /// Certified residual standard deviation.
    pub residual_deviation: f64,
    /// Whether the derivatives are exact instead of by differences.
    pub exact: bool,
    response: Vec<f64>,
    predictors: Vec<Vec<f64>>,
    model: Model,
}

impl Nist {
    /// Reads all problems, in the order of their names.
    pub fn all() -> Vec<Self> {
        MODELS.iter().map(|&(name, model)| Self::read(name, model)).collect()
    }

    fn read(name: &'static str, model: Model) -> Self {
        let path: PathBuf = [env!("CARGO_MANIFEST_DIR"), "tests/nist/data", name].iter().collect();
        let text = fs::read_to_string(path.with_extension("dat")).expect("the file is there");
        let lines: Vec<&str> = text.lines().collect();
        let numbers = |line: &str| -> Vec<f64> {
            line.split_whitespace().filter_map(|word| word.parse().ok()).collect()
        };
        let mut rows: Vec<Vec<f64>> = Vec::new();
        for line in &lines[40..] {
            match line.split_once('=') {
                Some((_, values)) => rows.push(numbers(values)),
                None => break,
            }
        }
        assert!(rows.iter().all(|row| row.len() == 4), "{name}: {rows:?}");
        let column = |k: usize| rows.iter().map(|row| row[k]).collect::<Vec<f64>>();
        let residual_deviation = lines
            .iter()
            .find_map(|line| line.strip_prefix("Residual Standard Deviation:"))
            .and_then(|value| value.trim().parse().ok())
            .expect("a certified residual standard deviation");
        let data: Vec<Vec<f64>> = lines[60..].iter().map(|line| numbers(line)).collect();
        let data: Vec<Vec<f64>> = data.into_iter().filter(|row| !row.is_empty()).collect();
        // Nelson's model is for the logarithm of the response.
        let transform = |y: f64| if name == "Nelson" { y.ln() } else { y };
        Self {
            name,
            starts: [column(0), column(1)],
            certified: column(2),
            deviations: column(3),
            residual_deviation,
            exact: false,
            response: data.iter().map(|row| transform(row[0])).collect(),
            predictors: data.into_iter().map(|row| row[1..].to_vec()).collect(),
            model,
        }
    }

    /// Returns the starting values as parameters without bounds.
    pub fn parameters(&self, start: usize) -> Vec<Parameter> {
        self.starts[start].iter().map(|&value| Parameter::new(value)).collect()
    }
}

impl Problem for Nist {
    fn residual_count(&self) -> usize {
        self.response.len()
    }

    fn residuals(&self, parameters: &[f64], out: &mut [f64]) {
        for ((r, x), y) in out.iter_mut().zip(&self.predictors).zip(&self.response) {
            *r = (self.model.plain)(parameters, x) - y;
        }
    }

    fn jacobian(&self, parameters: &[f64], out: &mut DMatrix<f64>) -> bool {
        if self.exact {
            let parameters = Dual::variables(parameters);
            for (i, x) in self.predictors.iter().enumerate() {
                let value = (self.model.dual)(&parameters, x);
                for j in 0..parameters.len() {
                    out[(i, j)] = value.slope[j];
                }
            }
        }
        self.exact
    }
}
