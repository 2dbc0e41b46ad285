//! Parameters that are functions of other parameters.
//!
//! [`Linked`] wraps a [`Problem`] and is one itself, so the minimiser and the statistics take it as
//! any other.

use nalgebra::DMatrix;

use crate::problem::{Parameter, Problem};

/// Relative step of the differences through a link: the cube root of the rounding unit, best for
/// the central formula.
const STEP: f64 = 6e-6;

/// Parameter as a function of all parameters.
type Rule<'a> = Box<dyn Fn(&[f64]) -> f64 + Sync + 'a>;

/// Problem in which some parameters are functions of others.
///
/// The list of parameters keeps its length: the entries of linked parameters are held fixed and
/// ignored. A rule sees all parameters, with the links that were added before it applied, so chains
/// are allowed. The bounds of a linked parameter have no effect; a rule may return not a number
/// where the parameters would be inadmissible.
///
/// ```
/// # use drape_lm::{Linked, Parameter, Problem, MinimiserSettings, minimise};
/// # struct Line;
/// # impl Problem for Line {
/// #     fn residual_count(&self) -> usize { 3 }
/// #     fn residuals(&self, p: &[f64], out: &mut [f64]) {
/// #         for (x, r) in out.iter_mut().enumerate() { *r = p[0] + p[1] * x as f64 - (4.0 + 2.0 * x as f64); }
/// #     }
/// # }
/// // A line whose intercept is twice its slope.
/// let linked = Linked::new(&Line).scaled(0, 1, 2.0);
/// let start = linked.parameters(&[Parameter::new(0.0), Parameter::new(1.0)]);
/// let report = minimise(&linked, &start, &MinimiserSettings::default());
/// let all = linked.complete(&report.parameters);
/// assert!((all[0] - 4.0).abs() < 1e-12 && (all[1] - 2.0).abs() < 1e-12);
/// ```
pub struct Linked<'a, P> {
    problem: &'a P,
    links: Vec<(usize, Rule<'a>)>,
}

impl<'a, P: Problem> Linked<'a, P> {
    /// Wraps a problem, without links yet.
    #[must_use]
    pub fn new(problem: &'a P) -> Self {
        Self { problem, links: Vec::new() }
    }

    /// Adds a link: parameter `target` is a smooth function of all parameters.
    #[must_use]
    pub fn linked(mut self, target: usize, rule: impl Fn(&[f64]) -> f64 + Sync + 'a) -> Self {
        self.links.push((target, Box::new(rule)));
        self
    }

    /// Adds a link: parameter `target` is a multiple of parameter `source`.
    #[must_use]
    pub fn scaled(self, target: usize, source: usize, factor: f64) -> Self {
        self.linked(target, move |p| p.get(source).map_or(f64::NAN, |value| factor * value))
    }

    /// Returns the parameters with the linked ones fixed at the values of their rules.
    #[must_use]
    pub fn parameters(&self, parameters: &[Parameter]) -> Vec<Parameter> {
        let starts: Vec<f64> = parameters.iter().map(|p| p.clamp(p.start)).collect();
        let starts = self.complete(&starts);
        let mut parameters = parameters.to_vec();
        for (target, _) in &self.links {
            if let Some(parameter) = parameters.get_mut(*target) {
                *parameter = Parameter::new(starts[*target]).fixed();
            }
        }
        parameters
    }

    /// Returns all parameters, with the linked ones computed by their rules.
    #[must_use]
    pub fn complete(&self, parameters: &[f64]) -> Vec<f64> {
        let mut all = parameters.to_vec();
        for (target, rule) in &self.links {
            let value = rule(&all);
            if let Some(entry) = all.get_mut(*target) {
                *entry = value;
            }
        }
        all
    }

    /// Returns the derivatives of a linked parameter by all parameters, the gradient that
    /// `Covariance::propagated_error` takes.
    #[must_use]
    pub fn gradient(&self, target: usize, parameters: &[f64]) -> Vec<f64> {
        let value = |at: &[f64]| self.complete(at).get(target).copied().unwrap_or(f64::NAN);
        let mut trial = parameters.to_vec();
        (0..parameters.len())
            .map(|j| {
                let at = parameters[j];
                let step = STEP * if at == 0.0 { 1.0 } else { at.abs() };
                let [high, low] = [at + step, at - step].map(|end| {
                    trial[j] = end;
                    value(&trial)
                });
                trial[j] = at;
                (high - low) / (2.0 * step)
            })
            .collect()
    }
}

impl<P: Problem> Problem for Linked<'_, P> {
    fn residual_count(&self) -> usize {
        self.problem.residual_count()
    }

    fn residuals(&self, parameters: &[f64], out: &mut [f64]) {
        self.problem.residuals(&self.complete(parameters), out);
    }

    fn jacobian(&self, parameters: &[f64], out: &mut DMatrix<f64>) -> bool {
        if !self.problem.jacobian(&self.complete(parameters), out) {
            return false;
        }
        // The chain rule gives the columns of the parameters that are not linked.
        let own = out.clone();
        let targets = || self.links.iter().map(|(target, _)| *target).filter(|j| *j < own.ncols());
        for target in targets() {
            let gradient = self.gradient(target, parameters);
            for (j, slope) in gradient.iter().enumerate().filter(|(_, slope)| **slope != 0.0) {
                let column = own.column(target) * *slope;
                let mut into = out.column_mut(j);
                into += column;
            }
        }
        for target in targets() {
            out.column_mut(target).fill(0.0);
        }
        true
    }

    fn weights(&self) -> &[f64] {
        self.problem.weights()
    }
}
