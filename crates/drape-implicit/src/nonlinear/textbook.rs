//! Broyden's method from a diagonal matrix, as in \[NB04\]: a baseline for comparisons.

use super::broyden::BroydenUpdates;
use super::equations::StepEquations;
use super::halt::Halt;
use super::line_search::residual_search;
use super::search::Search;
use crate::linear::system_matrix::SystemMatrix;
use crate::report::Stop;
use crate::settings::{InitialMatrix, Settings};
use crate::system::Stiffness;

/// Floor of the curvature along a step, as a fraction of the matrix's curvature. Updates are
/// refused only where they would divide by zero: the initial matrix overestimates the stiffness of
/// soft directions by orders of magnitude, and the updates correct this.
const CURVATURE_FLOOR: f64 = 1e-12;

/// Textbook Broyden with work space.
#[derive(Debug)]
pub(crate) struct Textbook {
    matrix: SystemMatrix,
    initial: InitialMatrix,
    updates: BroydenUpdates,
    /// Diagonal of the initial matrix, in N/m.
    diagonal: Vec<f64>,
}

impl Textbook {
    pub(crate) fn new(matrix: SystemMatrix, initial: InitialMatrix) -> Self {
        Self { matrix, initial, updates: BroydenUpdates::default(), diagonal: Vec::new() }
    }

    /// Solves `equations` from the current iterate of `search`, with a line search on the residual.
    /// Restarts from the diagonal matrix when a direction fails.
    pub(crate) fn solve(
        &mut self,
        search: &mut Search,
        equations: &mut StepEquations<'_, '_>,
        settings: &Settings,
    ) -> Result<(), Halt> {
        self.set_diagonal(search, equations)?;
        self.updates.forget();
        self.divide_by_diagonal(search);
        search.descend();

        while !search.current.solves(equations.limit) {
            search.count_iteration(equations, settings.max_iterations)?;
            match residual_search(search, equations) {
                Some(length) => {
                    self.divide_by_diagonal(search);
                    if self.updates.next_direction(search, length, CURVATURE_FLOOR) {
                        continue;
                    }
                    self.updates.forget();
                }
                None if self.updates.is_empty() => return Err(Halt::Stop(Stop::LineSearch)),
                None => self.updates.forget(),
            }

            // Restart from the diagonal matrix.
            self.divide_by_diagonal(search);
            search.descend();
        }
        Ok(())
    }

    /// Sets the diagonal of the initial matrix at the current iterate of `search`.
    fn set_diagonal(
        &mut self,
        search: &Search,
        equations: &mut StepEquations<'_, '_>,
    ) -> Result<(), Halt> {
        self.diagonal.clear();
        self.diagonal.extend(equations.inertia.iter().flat_map(|&inertia| [inertia; 3]));
        if self.initial == InitialMatrix::Diagonal {
            equations.assemble(&search.current, Stiffness::Exact, &mut self.matrix)?;
            let matrix = &self.matrix.matrix;
            for (row, entries) in self.diagonal.as_chunks_mut::<3>().0.iter_mut().enumerate() {
                let block = &matrix.blocks()[matrix.sparsity().row(row).start];
                // The inertia is the least entry: a minimisation needs a positive matrix.
                for k in 0..3 {
                    entries[k] = entries[k].max(block[4 * k]);
                }
            }
        }
        Ok(())
    }

    /// Sets the image of `search` to the residual over the diagonal.
    fn divide_by_diagonal(&self, search: &mut Search) {
        let Search { image, current, .. } = search;
        for ((z, phi), entry) in image.iter_mut().zip(&current.residual).zip(&self.diagonal) {
            *z = phi / entry;
        }
    }
}
