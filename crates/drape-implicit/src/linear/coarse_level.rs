//! Coarse level of the preconditioner: solves for smooth motions on a coarse grid.
//!
//! The incomplete factor reduces errors that vary between near neighbours. Errors that are smooth
//! over many particles then need a number of iterations that grows with the number of particles
//! along a side. The coarse level reduces smooth errors directly:
//!
//! ```math
//! B = (U^T D\,U)^{-1} + P\,(P^T A\,P)^{-1} P^T
//! ```
//!
//! with the bilinear [interpolation] `$P$` from a grid over each sheet and the [projection]
//! `$P^T A\,P$` of the matrix on it. This is an additive two-level preconditioner \[SBG96\]. It is
//! positive definite, because the first term is positive definite and the second semi-definite.
//!
//! The coarse matrix is the projection of the first matrix of a step. The stiffness of smooth
//! motions hardly changes within a step.

mod interpolation;
mod projection;

use pulp::{Arch, Simd, WithSimd};

use crate::linear::block_matrix::BlockMatrix;
use crate::linear::cholesky::{Cholesky, Kernel};
use crate::linear::lanes::Columns;
use crate::linear::level_schedule::chunk::{self, PerRow};
use crate::linear::level_schedule::layout::BatchLayout;
use crate::linear::sparsity::Sparsity;
use crate::system::MaterialPoint;
use interpolation::Interpolation;
use projection::Projection;

/// Least number of particles, at the finest spacing, with which the coarse level saves time. With
/// 10 000 particles it saves as much as it costs on one thread, and more on two threads, where it
/// runs beside the incomplete factor. With 4 900 particles it costs a tenth more time than it
/// saves.
const MIN_PARTICLES: f64 = 8_000.0;

/// Relative shift of the main diagonal of the coarse matrix. The coarse matrix may be singular to
/// rounding where nodes share their only particles.
const SHIFT: f64 = 1e-9;

/// Coarse matrix with its factor, and the interpolation from its nodes.
#[derive(Debug)]
pub(crate) struct CoarseLevel {
    interpolation: Interpolation,
    projection: Projection,
    matrix: BlockMatrix,
    cholesky: Cholesky,
    /// Correction at the nodes, three numbers each.
    correction: Vec<f64>,
    /// Whether the coarse matrix belongs to an earlier step.
    is_stale: bool,
    /// Whether the coarse matrix has a factor.
    is_definite: bool,
}

impl CoarseLevel {
    /// Returns whether a coarse level saves time: whether the sheets would have [`MIN_PARTICLES`]
    /// particles at the finest spacing of their points. Without the feature `cholesky` there is no
    /// coarse level.
    pub(crate) fn is_worthwhile(material_points: &[MaterialPoint]) -> bool {
        let finest = material_points.iter().map(|p| p.spacing).fold(f64::INFINITY, f64::min);
        let particles: f64 = material_points.iter().map(|p| (p.spacing / finest).powi(2)).sum();
        cfg!(feature = "cholesky") && particles >= MIN_PARTICLES
    }

    /// Returns a coarse level for the matrices of `sparsity`. `row_of` holds the row of each
    /// particle. Returns `None` without material points, or with too many nodes.
    pub(crate) fn new(
        sparsity: &Sparsity,
        row_of: &[u32],
        material_points: &[MaterialPoint],
    ) -> Option<Self> {
        if material_points.len() != sparsity.particle_count() {
            return None;
        }
        let interpolation = Interpolation::new(row_of, material_points);
        let (projection, coarse) = Projection::new(sparsity, &interpolation).ok()?;
        Some(Self {
            correction: vec![0.0; 3 * coarse.particle_count()],
            cholesky: Cholesky::new(&coarse, Kernel::Scalar).ok()?,
            matrix: BlockMatrix::zeros(coarse),
            interpolation,
            projection,
            is_stale: true,
            is_definite: false,
        })
    }

    /// Marks the coarse matrix as outdated, so that the next [`update`](Self::update) projects
    /// again.
    pub(crate) fn forget(&mut self) {
        self.is_stale = true;
    }

    /// Projects and factorises `matrix`, unless the coarse matrix belongs to this step already. If
    /// the factorisation fails, the coarse level corrects nothing until the next step.
    pub(crate) fn update(&mut self, arch: Arch, matrix: &BlockMatrix) {
        if !self.is_stale {
            return;
        }
        self.is_stale = false;
        let Self { interpolation, projection, matrix: coarse, .. } = self;
        interpolation.hold(matrix);
        coarse.clear();
        arch.dispatch(Project { projection, interpolation, matrix, coarse });
        for node in 0..coarse.sparsity().particle_count() {
            let slot = coarse.sparsity().row(node).start;
            let block = &mut coarse.blocks_mut()[slot];
            for k in [0, 4, 8] {
                // A node without a free particle has an empty row.
                block[k] = if block[k] == 0.0 { 1.0 } else { (1.0 + SHIFT) * block[k] };
            }
        }
        self.is_definite = self.cholesky.factorise(coarse).is_ok();
    }

    /// Solves for the correction at the nodes for `residual` times `factor`.
    pub(crate) fn solve(&mut self, arch: Arch, residual: &Columns<f64>, factor: f64) {
        if !self.is_definite {
            return;
        }
        let Self { interpolation, correction, cholesky, .. } = self;
        arch.dispatch(Restrict { interpolation, residual, sums: correction });
        for number in correction.iter_mut() {
            *number *= factor;
        }
        cholesky.solve(correction);
    }

    /// Adds the interpolated correction to `image` in the rows of the free particles.
    pub(crate) fn add_correction(
        &self,
        arch: Arch,
        layout: &BatchLayout,
        image: &mut Columns<f32>,
    ) {
        if !self.is_definite {
            return;
        }
        let Self { interpolation, correction, .. } = self;
        let rows = PerRow::new(&mut image.0);
        chunk::for_each(&layout.chunks, 0, rows, &|chunk, PerRow(rows)| {
            let first = chunk.rows.start;
            arch.dispatch(Interpolate { interpolation, correction, first, rows });
        });
    }
}

// Calls that `pulp` dispatches to the machine's vector instructions. The called functions are
// inlined.

struct Project<'a> {
    projection: &'a Projection,
    interpolation: &'a Interpolation,
    matrix: &'a BlockMatrix,
    coarse: &'a mut BlockMatrix,
}

impl WithSimd for Project<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        self.projection.project(self.interpolation, self.matrix, self.coarse);
    }
}

struct Restrict<'a> {
    interpolation: &'a Interpolation,
    residual: &'a Columns<f64>,
    sums: &'a mut [f64],
}

impl WithSimd for Restrict<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        self.interpolation.restrict(self.residual, self.sums);
    }
}

struct Interpolate<'a> {
    interpolation: &'a Interpolation,
    correction: &'a [f64],
    first: usize,
    rows: [&'a mut [f32]; 3],
}

impl WithSimd for Interpolate<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        self.interpolation.add(self.correction, self.first, self.rows);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::level_schedule::sample::{layout, rimmed, spring, springs};
    use crate::linear::vector::dot;

    /// Springs on a square with a rim, tied to its place a little, some of it held; two sheets.
    struct Sheets {
        matrix: BlockMatrix,
        points: Vec<MaterialPoint>,
        layout: BatchLayout,
    }

    fn sheets(n: usize) -> Sheets {
        let sparsity = rimmed(n);
        let particles = sparsity.particle_count();
        let layout = layout(&sparsity, 1);
        let mut matrix = springs(sparsity, |slot, _| {
            let own = spring([0.1, 0.2, 0.3].map(|phase| (slot as f64 + phase).sin()));
            core::array::from_fn(|k| own[k] + f64::from(k % 4 == 0))
        });
        let held: Vec<bool> = (0..particles).map(|k| k < n / 2).collect();
        matrix.add_inertia(&vec![1e-3; particles], &held);
        let point = |k: usize| {
            let sheet = u32::from(k % n > n / 2);
            MaterialPoint { sheet, coordinates: [(k % n) as f64, (k / n) as f64], spacing: 1.0 }
        };
        let points = (0..particles).map(point).collect();
        Sheets { matrix, points, layout }
    }

    /// Coarse correction of a residual.
    fn correct(level: &mut CoarseLevel, sheets: &Sheets, residual: &[f64]) -> Vec<f64> {
        let mut columns = Columns::new(sheets.layout.rows);
        let numbers =
            || (0..residual.len()).map(|k| (k, k % 3, sheets.layout.order.row_of[k / 3] as usize));
        for (k, axis, row) in numbers() {
            columns.0[axis][row] = residual[k];
        }
        level.solve(Arch::new(), &columns, 1.0);
        let mut image = Columns::new(sheets.layout.rows);
        level.add_correction(Arch::new(), &sheets.layout, &mut image);
        numbers().map(|(_, axis, row)| image.0[axis][row].into()).collect()
    }

    #[test]
    fn the_residual_that_a_correction_leaves_is_orthogonal_to_all_corrections() {
        let sheets = sheets(40);
        let Sheets { matrix, points, layout } = &sheets;
        let mut level = CoarseLevel::new(matrix.sparsity(), &layout.order.row_of, points).unwrap();
        level.update(Arch::new(), matrix);
        assert!(level.is_definite);
        let size = 3 * matrix.sparsity().particle_count();
        let residual: Vec<f64> = (0..size).map(|k| 1.0 + (k as f64).sin()).collect();
        let correction = correct(&mut level, &sheets, &residual);
        assert!(correction[..60].iter().all(|&x| x == 0.0), "held particles are corrected");
        let mut left = vec![0.0; size];
        matrix.write_product(&correction, &mut left);
        for (left, residual) in left.iter_mut().zip(&residual) {
            *left = residual - *left;
        }
        for phase in [0.3, 0.7, 1.1] {
            let other: Vec<f64> = (0..size).map(|k| (k as f64 * phase).cos()).collect();
            let other = correct(&mut level, &sheets, &other);
            let [before, after] = [&residual, &left].map(|residual| dot(residual, &other));
            assert!(after.abs() < 1e-5 * before.abs(), "{after:e} of {before:e}");
        }
    }

    #[test]
    fn the_correction_is_of_the_first_matrix_of_a_step() {
        let mut sheets = sheets(40);
        let Sheets { matrix, points, layout } = &sheets;
        let mut level = CoarseLevel::new(matrix.sparsity(), &layout.order.row_of, points).unwrap();
        level.update(Arch::new(), matrix);
        let residual = vec![1.0; 3 * matrix.sparsity().particle_count()];
        let first = correct(&mut level, &sheets, &residual);
        sheets.matrix.values_mut().iter_mut().for_each(|entry| *entry *= 2.0);
        level.update(Arch::new(), &sheets.matrix);
        assert!(correct(&mut level, &sheets, &residual) == first);
        level.forget();
        level.update(Arch::new(), &sheets.matrix);
        let second = correct(&mut level, &sheets, &residual);
        let halves = first.iter().zip(&second).all(|(a, b)| (a - 2.0 * b).abs() <= 1e-6 * a.abs());
        assert!(halves);
        sheets.matrix.values_mut().iter_mut().for_each(|entry| *entry *= -1.0);
        level.forget();
        level.update(Arch::new(), &sheets.matrix);
        assert!(correct(&mut level, &sheets, &residual).iter().all(|&x| x == 0.0), "indefinite");
    }
}
