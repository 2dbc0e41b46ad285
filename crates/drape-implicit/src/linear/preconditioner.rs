//! Preconditioner of conjugate gradients: the incomplete factor and, for large systems on sheets,
//! the coarse level added to it.

use pulp::Arch;

use crate::linear::block_matrix::{BlockMatrix, NotDefinite};
use crate::linear::coarse_level::CoarseLevel;
use crate::linear::incomplete_cholesky::IncompleteCholesky;
use crate::linear::lanes::Columns;
use crate::linear::level_schedule::LevelSchedule;
use crate::linear::level_schedule::layout::BatchLayout;
use crate::linear::packed_matrix::PackedMatrix;

/// Incomplete factor with the coarse level, if there is one.
///
/// The factor is then stabilised instead of compensated. Compensation gives smooth motions their
/// stiffness, which the coarse level does better, and makes the factor worse for all others: on
/// systems of 40 000 particles 70 iterations without it against 101 with it.
#[derive(Debug)]
pub(crate) struct Preconditioner {
    factor: IncompleteCholesky,
    coarse: Option<CoarseLevel>,
}

/// Residual to be preconditioned, by rows, times a factor.
#[derive(Clone, Copy)]
pub(crate) struct ScaledResidual<'a> {
    pub numbers: &'a Columns<f64>,
    pub factor: f64,
}

impl Preconditioner {
    pub(crate) fn new(layout: &BatchLayout, coarse: Option<CoarseLevel>) -> Self {
        let stabilised = coarse.is_some();
        Self { factor: IncompleteCholesky::new(layout, stabilised), coarse }
    }

    /// Forgets the last matrices, for one that is not like them.
    pub(crate) fn forget(&mut self) {
        self.factor.forget();
        if let Some(coarse) = &mut self.coarse {
            coarse.forget();
        }
    }

    /// Factorises a matrix and its packed copy. Returns the number of attempts that failed.
    pub(crate) fn factorise(
        &mut self,
        arch: Arch,
        schedule: &LevelSchedule,
        matrix: &BlockMatrix,
        packed: &PackedMatrix,
    ) -> Result<usize, NotDefinite> {
        let Self { factor, coarse } = self;
        match coarse {
            Some(coarse) => {
                let factorise = || factor.factorise(arch, schedule, packed);
                rayon::join(factorise, || coarse.update(arch, matrix)).0
            }
            None => factor.factorise(arch, schedule, packed),
        }
    }

    /// Vector that the factor is applied to.
    pub(crate) fn image(&self) -> &Columns<f32> {
        &self.factor.image
    }

    pub(crate) fn image_mut(&mut self) -> &mut Columns<f32> {
        &mut self.factor.image
    }

    /// Applies the preconditioner to the image, which holds the scaled residual.
    pub(crate) fn apply(&mut self, arch: Arch, layout: &BatchLayout, residual: ScaledResidual<'_>) {
        let Self { factor, coarse } = self;
        match coarse {
            Some(coarse) => {
                let ScaledResidual { numbers, factor: scale } = residual;
                let apply = || factor.apply(arch, layout);
                rayon::join(apply, || coarse.solve(arch, numbers, scale));
                coarse.add_correction(arch, layout, &mut factor.image);
            }
            None => factor.apply(arch, layout),
        }
    }
}
