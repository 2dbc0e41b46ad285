//! Nonlinear solver of a sub-step: a start point, then one of the methods.

use super::equations::StepEquations;
use super::halt::Halt;
use super::newton::Newton;
use super::search::Search;
use super::start_point::find_start;
use super::textbook::Textbook;
use crate::error::{Error, Quantity};
use crate::linear::system_matrix::SystemMatrix;
use crate::linear::vector::first_not_finite;
use crate::settings::{Method, Settings};

/// Solver of the equations of a sub-step, with work space.
#[derive(Debug)]
pub(crate) struct NonlinearSolver {
    pub search: Search,
    algorithm: Algorithm,
}

#[derive(Debug)]
enum Algorithm {
    Newton(Newton),
    Textbook(Textbook),
}

impl NonlinearSolver {
    /// Returns a solver with the method of `settings`.
    pub(crate) fn new(matrix: SystemMatrix, settings: &Settings) -> Self {
        let length = 3 * matrix.matrix.sparsity().particle_count();
        let algorithm = match settings.method {
            Method::Broyden | Method::Newton => Algorithm::Newton(Newton::new(matrix, settings)),
            Method::Textbook { initial } => Algorithm::Textbook(Textbook::new(matrix, initial)),
        };
        Self { search: Search::new(length), algorithm }
    }

    /// Solves `equations` from the deviations of the current iterate. If the forces there are not
    /// finite, the iteration starts from the deviations of the trial iterate. The solution is the
    /// current iterate.
    pub(crate) fn solve(
        &mut self,
        equations: &mut StepEquations<'_, '_>,
        settings: &Settings,
    ) -> Result<(), Halt> {
        let Self { search, algorithm } = self;
        search.iterations = 0;
        if let Algorithm::Newton(newton) = algorithm {
            newton.reset();
        }

        search.current.obstacle_time = 1.0;
        search.trial.obstacle_time = 1.0;
        if equations.system.is_filtered() {
            find_start(search, equations, settings.begin_at_prediction);
        } else {
            equations.evaluate(&mut search.current);
        }

        // The prediction may be unphysical. The start of the sub-step is the second choice.
        if !search.current.norm.is_finite() {
            core::mem::swap(&mut search.current, &mut search.trial);
            equations.evaluate(&mut search.current);
        }
        if !search.current.norm.is_finite() {
            let particle = first_not_finite(&search.current.residual).unwrap_or(0);
            return Err(Halt::NotFinite { quantity: Quantity::Force, particle });
        }

        match algorithm {
            Algorithm::Newton(newton) => newton.solve(search, equations, settings),
            Algorithm::Textbook(_) if equations.system.is_filtered() => {
                Err(Halt::Fatal(Error::UnfilteredMethod))
            }
            Algorithm::Textbook(textbook) => textbook.solve(search, equations, settings),
        }
    }
}
