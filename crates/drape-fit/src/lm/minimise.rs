//! The iteration: damped Gauss–Newton steps, projected on the bounds.

use nalgebra::{DMatrix, DVector};

use super::jacobian::differences;
use super::{Parameter, Problem};

/// Damping of the first step, relative to the scaled normal matrix.
///
/// Small trusts the linear model at the start, large creeps; the initial values here come from the curve
/// and are close, so little damping is needed.
const FIRST_DAMPING: f64 = 1e-3;
/// Damping beyond which steps have become too short to change any parameter.
const LAST_DAMPING: f64 = 1e20;
/// Least part of the predicted reduction that a step must bring to be taken.
const ACCEPTED_GAIN: f64 = 1e-4;

/// Relative change of a sum of squares that is only rounding, for up to some ten thousand residuals.
const ROUNDING: f64 = 1e-13;

/// When to stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Stop when neither the last step nor the next one predicted reduces the sum of squares by more than
    /// this part.
    pub reduction: f64,
    /// Stop when a step is shorter than this part of the parameters, in the scaled norm.
    pub step: f64,
    /// Stop when the cosine between the residuals and every column of the Jacobian is below this.
    pub gradient: f64,
    /// Stop after this many steps taken or refused.
    pub iterations: usize,
}

impl Default for Settings {
    /// As far as rounding lets it go: the problems here are small, and the last digits cost little.
    fn default() -> Self {
        Self {
            reduction: 1e-14,
            step: 1e-14,
            gradient: 1e-14,
            iterations: 300,
        }
    }
}

/// Why the iteration ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// The sum of squares no longer falls.
    Reduction,
    /// The parameters no longer move.
    Step,
    /// The residuals are orthogonal to every change of the free parameters.
    Gradient,
    /// All residuals are zero.
    Exact,
    /// No step, however short, brought what the linear model promised.
    Stalled,
    /// The limit on iterations was reached.
    Iterations,
    /// The residuals at the starting values are not all finite.
    NotFinite,
    /// There are no parameters or no residuals.
    Empty,
}

impl Stop {
    /// Whether the parameters are a minimum as far as rounding can tell.
    pub fn converged(self) -> bool {
        matches!(
            self,
            Self::Reduction | Self::Step | Self::Gradient | Self::Exact
        )
    }
}

/// Where the iteration ended, and how it got there.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// The best parameters found.
    pub parameters: Vec<f64>,
    /// Root of the weighted mean square residual there, in the unit of the residuals.
    pub rms: f64,
    /// Steps taken or refused.
    pub iterations: usize,
    /// Evaluations of the residuals, those for differences included.
    pub evaluations: usize,
    /// Why it ended.
    pub stop: Stop,
}

/// Minimises the weighted sum of squared residuals within the bounds.
///
/// Each step solves the augmented system
///
/// ```math
/// \min_\delta \left\| \begin{pmatrix} J \\ \sqrt\lambda\,D \end{pmatrix}\delta
///   + \begin{pmatrix} r \\ 0 \end{pmatrix} \right\|
/// ```
///
/// by QR, so that the condition number is not squared. `$D$` holds the largest norm each column of `$J$` has
/// had (Moré 1978), which makes the method independent of the units of the parameters. `$\lambda$` follows
/// the ratio of the reduction found to the one predicted (Nielsen 1999). Parameters at a bound that the
/// gradient pushes outwards are held; the step of the others is cut at the bounds, and the prediction is
/// made for the step as cut.
pub fn minimise(problem: &impl Problem, parameters: &[Parameter], settings: &Settings) -> Report {
    let at: Vec<f64> = parameters.iter().map(|p| p.clamp(p.start)).collect();
    let mut search = Search::new(problem, parameters, at);
    if parameters.is_empty() || search.residuals.is_empty() {
        return search.report(0, Stop::Empty);
    }
    if !search.squares.is_finite() {
        return search.report(0, Stop::NotFinite);
    }
    let mut damping = FIRST_DAMPING;
    let mut growth = 2.0;
    search.linearise();
    for iteration in 0..settings.iterations {
        if search.squares == 0.0 {
            return search.report(iteration, Stop::Exact);
        }
        if search.gradient() <= settings.gradient {
            return search.report(iteration, Stop::Gradient);
        }
        let step = search.step(damping);
        let predicted = search.predicted(&step) / search.squares;
        let trial = search.shifted(&step);
        let (squares, residuals) = search.evaluate(&trial);
        let actual = 1.0 - squares / search.squares;
        let gain = actual / predicted;
        if predicted > 0.0 && gain > ACCEPTED_GAIN {
            let short = search.relative_length(&step) <= settings.step;
            let flat = predicted.max(actual) <= settings.reduction;
            search.accept(trial, squares, residuals);
            if short || flat {
                let stop = if flat { Stop::Reduction } else { Stop::Step };
                search.polish();
                return search.report(iteration + 1, stop);
            }
            search.linearise();
            damping *= (1.0 - (2.0 * gain.min(1.0) - 1.0).powi(3)).max(1.0 / 3.0);
            growth = 2.0;
            continue;
        }
        // Refused. At the bottom the promise is below the rounding of the sum: that is convergence.
        if predicted <= settings.reduction && actual.abs() <= ROUNDING {
            search.polish();
            return search.report(iteration + 1, Stop::Reduction);
        }
        if search.relative_length(&step) <= settings.step {
            return search.report(iteration + 1, Stop::Step);
        }
        damping *= growth;
        growth *= 2.0;
        if damping > LAST_DAMPING {
            return search.report(iteration + 1, Stop::Stalled);
        }
    }
    search.report(settings.iterations, Stop::Iterations)
}

/// The best point so far and the linear model there.
struct Search<'a, P> {
    problem: &'a P,
    parameters: &'a [Parameter],
    at: Vec<f64>,
    /// Residuals times the roots of their weights.
    residuals: DVector<f64>,
    squares: f64,
    roots: Vec<f64>,
    jacobian: DMatrix<f64>,
    /// Moré's scaling: the largest norm of each column so far.
    scale: Vec<f64>,
    /// Parameters that may move in this step.
    free: Vec<usize>,
    /// Triangular factor of the free columns, and the residuals in its basis.
    triangle: DMatrix<f64>,
    rotated: DVector<f64>,
    evaluations: usize,
}

impl<'a, P: Problem> Search<'a, P> {
    fn new(problem: &'a P, parameters: &'a [Parameter], at: Vec<f64>) -> Self {
        let (m, n) = (problem.residual_count(), parameters.len());
        let mut search = Self {
            problem,
            parameters,
            at: Vec::new(),
            residuals: DVector::zeros(m),
            squares: 0.0,
            roots: problem.weights().iter().map(|w| w.sqrt()).collect(),
            jacobian: DMatrix::zeros(m, n),
            scale: vec![0.0; n],
            free: Vec::new(),
            triangle: DMatrix::zeros(0, 0),
            rotated: DVector::zeros(0),
            evaluations: 0,
        };
        let (squares, residuals) = search.evaluate(&at);
        search.accept(at, squares, residuals);
        search
    }

    fn evaluate(&mut self, at: &[f64]) -> (f64, DVector<f64>) {
        let mut residuals = DVector::zeros(self.residuals.len());
        self.problem.residuals(at, residuals.as_mut_slice());
        self.evaluations += 1;
        for (residual, root) in residuals.iter_mut().zip(&self.roots) {
            *residual *= root;
        }
        let squares = residuals.norm_squared();
        // Not a number compares as neither better nor worse: it must count as worse.
        (
            if squares.is_nan() {
                f64::INFINITY
            } else {
                squares
            },
            residuals,
        )
    }

    fn accept(&mut self, at: Vec<f64>, squares: f64, residuals: DVector<f64>) {
        (self.at, self.squares, self.residuals) = (at, squares, residuals);
    }

    /// Jacobian, scaling, free parameters and factor at the present point.
    fn linearise(&mut self) {
        if !self.problem.jacobian(&self.at, &mut self.jacobian) {
            let unweighted: Vec<f64> = match self.roots.is_empty() {
                true => self.residuals.as_slice().to_vec(),
                false => {
                    let mut residuals = vec![0.0; self.residuals.len()];
                    self.problem.residuals(&self.at, &mut residuals);
                    self.evaluations += 1;
                    residuals
                }
            };
            self.evaluations += differences(
                self.problem,
                self.parameters,
                &self.at,
                &unweighted,
                &mut self.jacobian,
            );
        }
        for (i, root) in self.roots.iter().enumerate() {
            self.jacobian.row_mut(i).scale_mut(*root);
        }
        for (j, scale) in self.scale.iter_mut().enumerate() {
            *scale = scale.max(self.jacobian.column(j).norm());
        }
        self.free = (0..self.parameters.len())
            .filter(|&j| self.can_move(j))
            .collect();
        let qr = self.jacobian.select_columns(&self.free).qr();
        let mut rotated = self.residuals.clone();
        qr.q_tr_mul(&mut rotated);
        self.triangle = qr.r();
        self.rotated = rotated.rows(0, self.triangle.nrows()).into_owned();
    }

    /// Whether a parameter has an effect and is not held at a bound by the gradient.
    fn can_move(&self, j: usize) -> bool {
        let column = self.jacobian.column(j);
        let slope = column.dot(&self.residuals);
        let parameter = &self.parameters[j];
        let held = (self.at[j] <= parameter.lower && slope > 0.0)
            || (self.at[j] >= parameter.upper && slope < 0.0);
        !held && column.norm_squared() > 0.0
    }

    /// Largest cosine between the residuals and a free column.
    fn gradient(&self) -> f64 {
        let norm = self.squares.sqrt();
        self.free
            .iter()
            .map(|&j| {
                let column = self.jacobian.column(j);
                column.dot(&self.residuals).abs() / (column.norm() * norm)
            })
            .fold(0.0, f64::max)
    }

    /// The damped step, cut at the bounds; zero for held parameters.
    fn step(&self, damping: f64) -> Vec<f64> {
        let (rows, n) = self.triangle.shape();
        let mut augmented = DMatrix::zeros(rows + n, n);
        augmented.rows_mut(0, rows).copy_from(&self.triangle);
        for (k, &j) in self.free.iter().enumerate() {
            augmented[(rows + k, k)] = damping.sqrt() * self.scale[j];
        }
        let mut right = DVector::zeros(rows + n);
        right.rows_mut(0, rows).copy_from(&(-&self.rotated));
        let qr = augmented.qr();
        qr.q_tr_mul(&mut right);
        let solution = qr
            .r()
            .solve_upper_triangular(&right.rows(0, n).into_owned());
        let mut step = vec![0.0; self.at.len()];
        // A singular triangle would need a zero scale, and columns without effect are not free.
        let Some(solution) = solution else {
            return step;
        };
        for (&j, change) in self.free.iter().zip(solution.iter()) {
            step[j] = self.parameters[j].clamp(self.at[j] + change) - self.at[j];
        }
        step
    }

    /// Reduction of the sum of squares that the linear model promises for a step.
    fn predicted(&self, step: &[f64]) -> f64 {
        let free = DVector::from_iterator(self.free.len(), self.free.iter().map(|&j| step[j]));
        let change = &self.triangle * free;
        -(2.0 * self.rotated.dot(&change) + change.norm_squared())
    }

    fn shifted(&self, step: &[f64]) -> Vec<f64> {
        let moved = self
            .at
            .iter()
            .zip(step)
            .map(|(value, change)| value + change);
        moved
            .zip(self.parameters)
            .map(|(value, parameter)| parameter.clamp(value))
            .collect()
    }

    /// Length of a step over that of the parameters, in the scaled norm.
    fn relative_length(&self, step: &[f64]) -> f64 {
        let norm = |values: &[f64]| {
            values
                .iter()
                .zip(&self.scale)
                .map(|(v, s)| (v * s).powi(2))
                .sum::<f64>()
                .sqrt()
        };
        norm(step) / norm(&self.at).max(f64::MIN_POSITIVE)
    }

    /// One last step without damping.
    ///
    /// The sum of squares is flat at its minimum: it cannot tell parameters apart that differ by the root of
    /// the rounding unit. The linear model still can, so its step is taken on trust unless the sum rises by
    /// more than rounding.
    fn polish(&mut self) {
        self.linearise();
        let step = self.step(f64::EPSILON);
        let trial = self.shifted(&step);
        let (squares, residuals) = self.evaluate(&trial);
        if squares <= self.squares * (1.0 + ROUNDING) {
            self.accept(trial, squares, residuals);
        }
    }

    fn report(&self, iterations: usize, stop: Stop) -> Report {
        let count = self.residuals.len().max(1) as f64;
        Report {
            parameters: self.at.clone(),
            rms: (self.squares / count).sqrt(),
            iterations,
            evaluations: self.evaluations,
            stop,
        }
    }
}
