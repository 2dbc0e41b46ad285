//! Broyden's method from a diagonal matrix, as the paper that this crate starts from used it.

use crate::incremental::{Halt, Incremental};
use crate::solver::{ARMIJO, MAX_CUTS, Solver};
use crate::{InitialMatrix, Settings, Stiffness, Stop};

/// Updates are refused only where they would divide by nothing: the initial matrix overestimates soft directions
/// by orders of magnitude, and learning that is the whole point.
const BREAKDOWN: f64 = 1e-12;

impl Solver {
    /// Broyden's method with a line search on the residual, started over when a direction fails.
    pub(crate) fn textbook(
        &mut self,
        problem: &mut Incremental<'_, '_>,
        settings: &Settings,
        initial: InitialMatrix,
    ) -> Result<(), Halt> {
        self.diagonal.clear();
        self.diagonal.extend(problem.inertia.iter().flat_map(|&inertia| [inertia; 3]));
        if initial == InitialMatrix::Diagonal {
            problem.assemble(&self.current, Stiffness::Exact, &mut self.tangent)?;
            let matrix = &self.tangent.matrix;
            for (row, own) in self.diagonal.as_chunks_mut::<3>().0.iter_mut().enumerate() {
                let block = &matrix.blocks()[matrix.sparsity().row(row).start];
                // At least the inertia: a negative stiffness makes no start for a minimisation.
                for k in 0..3 {
                    own[k] = own[k].max(block[4 * k]);
                }
            }
        }
        self.updates.forget();
        self.image_from_diagonal();
        self.descend_from_image();
        while !self.current.solves(problem.limit) {
            self.count(problem, settings)?;
            match self.residual_search(problem) {
                Some(length) => {
                    self.image_from_diagonal();
                    if self.turn(length, BREAKDOWN) {
                        continue;
                    }
                    self.updates.forget();
                }
                None if self.updates.is_empty() => return Err(Halt::Stop(Stop::LineSearch)),
                None => self.updates.forget(),
            }
            self.image_from_diagonal();
            self.descend_from_image();
        }
        Ok(())
    }

    fn image_from_diagonal(&mut self) {
        for ((z, phi), own) in self.image.iter_mut().zip(&self.current.residual).zip(&self.diagonal)
        {
            *z = phi / own;
        }
    }

    fn descend_from_image(&mut self) {
        for (p, z) in self.direction.iter_mut().zip(&self.image) {
            *p = -z;
        }
    }

    fn residual_search(&mut self, problem: &mut Incremental<'_, '_>) -> Option<f64> {
        let mut length = 1.0;
        for _ in 0..=MAX_CUTS {
            self.try_step(problem, length);
            if self.trial.norm <= (1.0 - ARMIJO * length) * self.current.norm {
                return Some(self.accept(length));
            }
            problem.report.backtracks += 1;
            length *= 0.5;
        }
        None
    }
}
