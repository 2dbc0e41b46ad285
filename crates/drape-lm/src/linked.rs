//! Parameters that are functions of other parameters.
//!
//! [`Linked`] wraps a [`Problem`] and implements the trait itself, so that the minimiser and the
//! statistics accept it like every other problem.

use nalgebra::DMatrix;

use crate::problem::{Parameter, Problem};

/// Function from the values of all parameters to the value of a linked parameter.
type Rule<'a> = Box<dyn Fn(&[f64]) -> f64 + Sync + 'a>;

/// Problem in which some parameters are functions of others.
///
/// The list of parameters keeps its length. The entries of linked parameters are held fixed and
/// ignored. A rule sees all parameters after the earlier links have been applied, so chains of
/// links are allowed. The bounds of a linked parameter have no effect. A rule may return NaN where
/// the parameters are inadmissible.
///
/// ```
/// # use drape_lm::{Linked, Parameter, Problem, MinimiserSettings, minimise};
/// # struct Line;
/// # impl Problem for Line {
/// #     fn residual_count(&self) -> usize { 3 }
/// #     fn residuals(&self, p: &[f64], out: &mut [f64]) {
/// #         for (i, r) in out.iter_mut().enumerate() {
/// #             let x = i as f64;
/// #             *r = p[0] + p[1] * x - (4.0 + 2.0 * x);
/// #         }
/// #     }
/// # }
/// // A line whose intercept is twice its slope.
/// let linked = Linked::new(&Line).scaled(0, 1, 2.0);
/// let start = linked.parameters(&[Parameter::new(0.0), Parameter::new(1.0)]);
/// let report = minimise(&linked, &start, &MinimiserSettings::default());
/// let values = linked.complete(&report.parameters);
/// assert!((values[0] - 4.0).abs() < 1e-12 && (values[1] - 2.0).abs() < 1e-12);
/// ```
pub struct Linked<'a, P: ?Sized> {
    problem: &'a P,
    links: Vec<(usize, Rule<'a>)>,
}

impl<'a, P: Problem + ?Sized> Linked<'a, P> {
    /// Wraps `problem` without any links.
    #[must_use]
    pub fn new(problem: &'a P) -> Self {
        Self { problem, links: Vec::new() }
    }

    /// Adds a link: parameter `target` is the smooth function `rule` of all parameters.
    #[must_use]
    pub fn linked(mut self, target: usize, rule: impl Fn(&[f64]) -> f64 + Sync + 'a) -> Self {
        self.links.push((target, Box::new(rule)));
        self
    }

    /// Adds a link: parameter `target` is `factor` times parameter `source`.
    #[must_use]
    pub fn scaled(self, target: usize, source: usize, factor: f64) -> Self {
        self.linked(target, move |p| p.get(source).map_or(f64::NAN, |value| factor * value))
    }

    /// Returns `parameters` with each linked parameter fixed at the value of its rule.
    #[must_use]
    pub fn parameters(&self, parameters: &[Parameter]) -> Vec<Parameter> {
        let clamped: Vec<f64> = parameters.iter().map(|p| p.clamp(p.start)).collect();
        let starts = self.complete(&clamped);
        let mut parameters = parameters.to_vec();
        for (target, _) in &self.links {
            if let Some(parameter) = parameters.get_mut(*target) {
                // The entry itself is ignored, and must be a number even where the rule has none.
                let value = Some(starts[*target]).filter(|value| value.is_finite());
                *parameter = Parameter::new(value.unwrap_or(0.0)).fixed();
            }
        }
        parameters
    }

    /// Returns `parameters` with the value of each linked parameter computed by its rule.
    #[must_use]
    pub fn complete(&self, parameters: &[f64]) -> Vec<f64> {
        let mut values = parameters.to_vec();
        for (target, rule) in &self.links {
            let value = rule(&values);
            if let Some(entry) = values.get_mut(*target) {
                *entry = value;
            }
        }
        values
    }

    /// Returns the derivatives of the linked parameter `target` by all parameters at `parameters`.
    ///
    /// [`Covariance::propagated_error`](crate::Covariance::propagated_error) takes this gradient.
    #[must_use]
    pub fn gradient(&self, target: usize, parameters: &[f64]) -> Vec<f64> {
        /// Relative step of the differences: the cube root of the rounding unit, the best step for
        /// the central formula.
        const STEP: f64 = 6e-6;

        let mut trial = parameters.to_vec();
        let mut gradient = Vec::with_capacity(parameters.len());
        for (j, &value) in parameters.iter().enumerate() {
            let step = STEP * if value == 0.0 { 1.0 } else { value.abs() };
            let [high, low] = [value + step, value - step].map(|end| {
                trial[j] = end;
                self.complete(&trial).get(target).copied().unwrap_or(f64::NAN)
            });
            trial[j] = value;
            gradient.push((high - low) / (2.0 * step));
        }
        gradient
    }
}

impl<P: Problem + ?Sized> Problem for Linked<'_, P> {
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

        // The chain rule adds the derivative through each link to the columns of the parameters
        // that are not linked.
        let unlinked = out.clone();
        let targets: Vec<usize> = self
            .links
            .iter()
            .map(|(target, _)| *target)
            .filter(|target| *target < unlinked.ncols())
            .collect();
        for &target in &targets {
            let gradient = self.gradient(target, parameters);
            for (j, slope) in gradient.iter().enumerate().filter(|(_, slope)| **slope != 0.0) {
                let through_link = unlinked.column(target) * *slope;
                let mut column = out.column_mut(j);
                column += through_link;
            }
        }

        // The entry of a linked parameter itself is ignored.
        for target in targets {
            out.column_mut(target).fill(0.0);
        }
        true
    }

    fn weights(&self) -> &[f64] {
        self.problem.weights()
    }
}
