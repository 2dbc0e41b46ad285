//! Incomplete Cholesky factor without fill, in 3x3 blocks: the preconditioner of conjugate
//! gradients.
//!
//! In the factor `$U^T D\,U$` the matrix `$U$` is unit upper triangular with the sparsity of the
//! factorised matrix \[MV77\]. Elimination computes the factor row by row in the order of the level
//! schedule:
//!
//! ```math
//! D_i = S_{ii}, \qquad U_{ij} = D_i^{-1} S_{ij}, \qquad
//! S_{jk} \leftarrow S_{jk} - S_{ij}^T\, U_{ik}
//! ```
//!
//! `$S$` is the matrix at first, and later the [Schur complement](schur_complement) of the
//! eliminated rows. Updates outside the sparsity are [dropped](dropped_fill) and compensated on the
//! diagonal. If a pivot collapses nevertheless, the [elimination] is repeated with a larger shift.
//! Two [triangular solves](triangular_solve) apply a finished [factor].

pub(crate) mod dropped_fill;
pub(crate) mod elimination;
pub(crate) mod factor;
pub(crate) mod schur_complement;
pub(crate) mod triangular_solve;

use pulp::{Arch, Simd, WithSimd};

use crate::linear::block_matrix::NotDefinite;
use crate::linear::lane_block::are_definite;
use crate::linear::lanes::{Columns, Double, LANES};
use crate::linear::level_schedule::LevelSchedule;
use crate::linear::level_schedule::layout::BatchLayout;
use crate::linear::packed_matrix::PackedMatrix;
use dropped_fill::DroppedFill;
use elimination::{Attempt, Elimination, Input};
use factor::Factor;
use triangular_solve::TriangularSolve;

/// Variants of the elimination, tried in turn as long as pivots collapse. After the last variant
/// the block diagonal alone is the factor, which cannot fail.
///
/// Each shift is four times the shift before. The growth is coarse because a factorisation costs as
/// much as several iterations of conjugate gradients. With shifts alone after the first attempt,
/// from 0 upwards, conjugate gradients took more iterations: 37 300 instead of 21 300 on a wool let
/// down from a platform, where four or five attempts failed for most factors instead of one, 163
/// 000 instead of 112 000 on cloth that settles on a sphere, and 25 900 instead of 22 600 on cloth
/// on a cube. Stabilisation without shifts was equally good there, but took 75 000 instead of 26
/// 000 iterations with the springs of a garment's seams.
const ATTEMPTS: [Attempt; 7] = [
    Attempt { fill: DroppedFill::Compensated(0.97), shift: 0.0 },
    Attempt { fill: DroppedFill::Stabilised(0.05), shift: 0.004 },
    Attempt { fill: DroppedFill::Stabilised(0.2), shift: 0.016 },
    Attempt { fill: DroppedFill::Stabilised(0.8), shift: 0.064 },
    Attempt { fill: DroppedFill::Stabilised(1.0), shift: 0.256 },
    Attempt { fill: DroppedFill::Stabilised(1.0), shift: 1.024 },
    Attempt { fill: DroppedFill::Stabilised(1.0), shift: 4.096 },
];

/// Incomplete factor of a matrix, and the vector to which it is applied.
#[derive(Debug)]
pub(crate) struct IncompleteCholesky {
    elimination: Elimination,
    factor: Factor,
    triangular_solve: TriangularSolve,
    /// Vector to which the inverse is applied, by rows.
    pub image: Columns<f32>,
    /// Index of the first of [`ATTEMPTS`] for the next matrix.
    first_attempt: usize,
    /// Index of the first of [`ATTEMPTS`] for a matrix that differs from the one before.
    least_attempt: usize,
}

impl IncompleteCholesky {
    /// Allocates a factor for `layout`. The first attempt is compensated, or `stabilised` if this
    /// is set.
    pub(crate) fn new(layout: &BatchLayout, stabilised: bool) -> Self {
        let least_attempt = usize::from(stabilised);
        Self {
            elimination: Elimination::new(layout),
            factor: Factor::new(layout),
            triangular_solve: TriangularSolve::new(layout),
            image: Columns::new(layout.rows),
            first_attempt: least_attempt,
            least_attempt,
        }
    }

    /// Discards the record of the last successful attempt, because the next matrix differs from the
    /// last.
    pub(crate) fn forget(&mut self) {
        self.first_attempt = self.least_attempt;
    }

    /// Factorises the matrix `packed`. Returns the number of failed attempts.
    ///
    /// The first attempt is the one that succeeded last. If it succeeds at once, the next matrix
    /// begins with the second of [`ATTEMPTS`], so that the shift becomes small again. Until
    /// [`forget`](Self::forget) the very first of [`ATTEMPTS`] is not repeated after a failure:
    /// when it was tried for each matrix, it failed for almost every matrix of a cloth that comes
    /// to rest, and for half of the matrices of a swing.
    pub(crate) fn factorise(
        &mut self,
        arch: Arch,
        schedule: &LevelSchedule,
        packed: &PackedMatrix,
    ) -> Result<usize, NotDefinite> {
        let Self { elimination, factor, first_attempt, .. } = self;
        let layout = &schedule.layout;
        if !arch.dispatch(IsDefinite { layout, packed }) {
            return Err(NotDefinite);
        }
        let first = *first_attempt;
        for (failed, &attempt) in ATTEMPTS[first..].iter().enumerate() {
            if elimination.eliminate(arch, Input { schedule, packed, attempt }, factor) {
                *first_attempt = if failed == 0 { first.min(1) } else { first + failed };
                return Ok(failed);
            }
        }
        arch.dispatch(UseDiagonal { factor, layout, packed });
        Ok(ATTEMPTS.len() - first)
    }

    /// Turns the image `r` into `(Uᵀ D U)⁻¹ r`.
    pub(crate) fn apply(&mut self, arch: Arch, layout: &BatchLayout) {
        let Self { factor, triangular_solve, image, .. } = self;
        triangular_solve.apply(arch, layout, factor, image);
    }
}

// Calls that `pulp` dispatches to the machine's vector instructions. The called functions are
// inlined.

/// Computes whether all blocks of the main diagonal are positive definite.
struct IsDefinite<'a> {
    layout: &'a BatchLayout,
    packed: &'a PackedMatrix,
}

impl WithSimd for IsDefinite<'_> {
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> bool {
        let Self { layout, packed } = self;
        let mut batches = layout.runs.iter().flat_map(|run| (run.start..run.end).step_by(LANES));
        batches.all(|row| are_definite(&packed.main_diagonal(row), Double::ZERO))
    }
}

struct UseDiagonal<'a> {
    factor: &'a mut Factor,
    layout: &'a BatchLayout,
    packed: &'a PackedMatrix,
}

impl WithSimd for UseDiagonal<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        self.factor.use_diagonal(self.layout, self.packed);
    }
}

#[cfg(feature = "cholesky")]
#[cfg(test)]
mod tests {
    use faer::linalg::solvers::DenseSolveCore;

    use super::*;
    use crate::linear::block_matrix::BlockMatrix;
    use crate::linear::level_schedule::partition::Partition;
    use crate::linear::level_schedule::sample::{rimmed, weave};
    use crate::linear::sparsity::Sparsity;
    use crate::linear::vector::dot;

    /// A chain: its exact factor has no fill, so the incomplete one is exact.
    fn chain(particles: usize, own: f64, coupling: f64) -> BlockMatrix {
        let pairs = (1..particles).map(|i| [i - 1, i]);
        let mut matrix = BlockMatrix::zeros(Sparsity::from_pairs(particles, pairs).unwrap());
        let symmetric = [own, 0.3, -0.2, 0.3, own, 0.1, -0.2, 0.1, own];
        let skewed = [coupling, 0.1, 0.0, -0.2, coupling, 0.3, 0.0, 0.4, coupling];
        for i in 0..particles {
            matrix.add(i, i, &symmetric);
            if i > 0 {
                matrix.add(i - 1, i, &skewed);
            }
        }
        matrix
    }

    struct Factored {
        schedule: LevelSchedule,
        incomplete: IncompleteCholesky,
        failed: Result<usize, NotDefinite>,
    }

    fn schedule(sparsity: &Sparsity, parts: usize) -> LevelSchedule {
        LevelSchedule::new(sparsity, &Partition::into_parts(sparsity, parts))
    }

    fn factorise(matrix: &BlockMatrix) -> Factored {
        let schedule = schedule(matrix.sparsity(), 1);
        let mut incomplete = IncompleteCholesky::new(&schedule.layout, false);
        let mut packed = PackedMatrix::new(&schedule.layout);
        packed.pack(Arch::new(), &schedule.layout, matrix);
        let failed = incomplete.factorise(Arch::new(), &schedule, &packed);
        Factored { schedule, incomplete, failed }
    }

    /// The inverse of a factor times a vector.
    fn apply(Factored { schedule, incomplete, .. }: &mut Factored, b: &[f64]) -> Vec<f64> {
        let row_of = &schedule.layout.order.row_of;
        let image = &mut incomplete.image;
        let numbers = || (0..b.len()).map(|k| (k, k % 3, row_of[k / 3] as usize));
        for (k, axis, row) in numbers() {
            image.0[axis][row] = b[k] as f32;
        }
        incomplete.apply(Arch::new(), &schedule.layout);
        numbers().map(|(_, axis, row)| incomplete.image.0[axis][row].into()).collect()
    }

    #[test]
    fn on_a_chain_the_factor_is_exact() {
        let matrix = chain(20, 3.0, -1.0);
        let mut factored = factorise(&matrix);
        assert_eq!(factored.failed, Ok(0));
        let b: Vec<f64> = (0..60).map(|k| (k as f64).sin()).collect();
        let mut back = vec![0.0; 60];
        matrix.write_product(&apply(&mut factored, &b), &mut back);
        for (b, back) in b.iter().zip(&back) {
            // Single precision.
            assert!((b - back).abs() < 1e-6, "{back} against {b}");
        }
    }

    #[test]
    fn the_factor_of_a_matrix_in_other_units_is_that_factor_in_these_units() {
        let b: Vec<f64> = (0..60).map(|k| (k as f64).cos()).collect();
        let solution = |unit: f64| {
            let mut matrix = chain(20, 3.0, -1.0);
            matrix.values_mut().iter_mut().for_each(|x| *x *= unit);
            let mut factored = factorise(&matrix);
            assert_eq!(factored.failed, Ok(0), "in units of {unit:e}");
            apply(&mut factored, &b)
        };
        let own = solution(1.0);
        // Powers of two: no digit changes.
        for unit in [2f64.powi(-30), 2f64.powi(30)] {
            let scaled: Vec<f64> = solution(unit).into_iter().map(|x| x * unit).collect();
            assert_eq!(scaled, own, "in units of {unit:e}");
        }
    }

    #[test]
    fn batches_may_lead_beyond_the_last_row_with_zeros() {
        // Runs of many batches of which one couples to the last particle, another to the first of
        // the last.
        for pairs in [
            vec![[0, 40], [1, 41]],
            vec![[6, 40], [7, 41], [3, 40]],
            vec![[0, 40], [1, 41], [33, 42], [34, 43]],
            vec![[0, 40], [33, 41]],
        ] {
            let last = pairs.iter().map(|pair| pair[1]).max().unwrap();
            let mut matrix =
                BlockMatrix::zeros(Sparsity::from_pairs(last + 1, pairs.clone()).unwrap());
            let block = |size: f64| [size, 0.1, 0.0, 0.1, size, 0.0, 0.0, 0.0, size];
            (0..=last).for_each(|own| matrix.add(own, own, &block(3.0)));
            pairs.iter().for_each(|&[a, b]| matrix.add(a, b, &block(-1.0)));
            let mut factored = factorise(&matrix);
            assert_eq!(factored.failed, Ok(0));
            let b: Vec<f64> = (0..3 * (last + 1)).map(|k| (k as f64).sin()).collect();
            let mut back = vec![0.0; b.len()];
            matrix.write_product(&apply(&mut factored, &b), &mut back);
            for (b, back) in b.iter().zip(&back) {
                assert!((b - back).abs() < 1e-6, "{back} against {b}: {pairs:?}");
            }
        }
    }

    /// Largest entries of the product `UᵀD U`, less those of the matrix, on and beside the
    /// sparsity.
    fn differences(matrix: &BlockMatrix, parts: usize) -> [f64; 2] {
        let sparsity = matrix.sparsity();
        let schedule = schedule(sparsity, parts);
        assert!(!schedule.updates.irregular.is_empty(), "nothing of this is irregular");
        let mut packed = PackedMatrix::new(&schedule.layout);
        let mut incomplete = IncompleteCholesky::new(&schedule.layout, false);
        packed.pack(Arch::new(), &schedule.layout, matrix);
        let attempt = Attempt { fill: DroppedFill::Compensated(0.0), shift: 0.0 };
        let IncompleteCholesky { elimination, factor, .. } = &mut incomplete;
        let input = Input { schedule: &schedule, packed: &packed, attempt };
        assert!(elimination.eliminate(Arch::new(), input, factor));
        let mut factored = Factored { schedule, incomplete, failed: Ok(0) };
        let count = sparsity.particle_count();
        let size = 3 * count;
        let mut inverse = faer::Mat::<f64>::zeros(size, size);
        for column in 0..size {
            let mut unit = vec![0.0; size];
            unit[column] = 1.0;
            for (row, entry) in apply(&mut factored, &unit).into_iter().enumerate() {
                inverse[(row, column)] = entry;
            }
        }
        let factor = inverse.partial_piv_lu().inverse();
        let [mut on, mut beside] = [0.0_f64; 2];
        for (i, j) in (0..count).flat_map(|i| (i..count).map(move |j| (i, j))) {
            for k in 0..9 {
                let entry = factor[(3 * i + k / 3, 3 * j + k % 3)];
                match sparsity.slot(i, j) {
                    Some(slot) => on = on.max((entry - matrix.blocks()[slot][k]).abs()),
                    None => beside = beside.max(entry.abs()),
                }
            }
        }
        [on, beside]
    }

    /// Stiff blocks on the main diagonal, others of any kind.
    fn dominant(sparsity: Sparsity) -> BlockMatrix {
        let mut matrix = BlockMatrix::zeros(sparsity.clone());
        for i in 0..sparsity.particle_count() {
            matrix.add(i, i, &[27.0, 0.9, -0.6, 0.9, 28.5, 0.3, -0.6, 0.3, 24.0]);
            for slot in sparsity.row(i).skip(1) {
                let entry = |k: usize| ((9 * slot + k) as f64 * 0.7).sin();
                matrix.add_block(slot, &core::array::from_fn(entry));
            }
        }
        matrix
    }

    #[test]
    fn without_compensation_the_factor_is_the_matrix_on_its_sparsity() {
        let several = [(weave(14), 2), (weave(14), 3), (rimmed(12), 2), (rimmed(7), 5)];
        for (sparsity, parts) in [(rimmed(7), 1)].into_iter().chain(several) {
            let matrix = dominant(sparsity);
            let [on, beside] = differences(&matrix, parts);
            assert!(on < 1e-6 * 27.0, "{on} on the sparsity, in {parts} parts");
            assert!(beside > 0.01, "there is room for everything");
        }
    }

    #[test]
    fn an_indefinite_diagonal_block_is_reported() {
        let mut matrix = chain(3, 3.0, -1.0);
        matrix.add(1, 1, &[-9.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        assert_eq!(factorise(&matrix).failed, Err(NotDefinite));
        matrix.blocks_mut()[0][0] = f64::NAN;
        assert_eq!(factorise(&matrix).failed, Err(NotDefinite));
    }

    #[test]
    fn parts_without_particles_are_passed_over() {
        // All particles but one are of a separator.
        let star = Sparsity::from_pairs(20, (0..19).map(|other| [other, 19])).unwrap();
        let [on, _] = differences(&dominant(star), 4);
        assert!(on < 1e-6 * 27.0, "{on}");
    }

    #[test]
    fn collapsing_pivots_are_cured_by_a_shift() {
        // Almost singular: the coupling nearly cancels the diagonal, so pivots run to zero along
        // the chain.
        let failed = factorise(&chain(200, 2.0, -0.999)).failed;
        assert!(matches!(failed, Ok(1..6)), "{failed:?}");
    }

    /// Of terms `(n·x_i ± n·x_j)²` between the particles of a square lattice and those beside and
    /// across.
    fn rods(across: usize, seed: usize) -> BlockMatrix {
        let cells = (0..across).flat_map(|i| (0..across).map(move |j| (i, j)));
        let steps = [(0, 1), (1, 0), (1, 1)];
        let pairs: Vec<[usize; 2]> = cells
            .flat_map(|(i, j)| steps.map(|(down, right)| (i, j, i + down, j + right)))
            .filter(|&(.., i, j)| i < across && j < across)
            .map(|(a, b, c, d)| [a * across + b, c * across + d])
            .collect();
        let count = across * across;
        let mut matrix = BlockMatrix::zeros(Sparsity::from_pairs(count, pairs.clone()).unwrap());
        let small = [1e-2, 0.0, 0.0, 0.0, 1e-2, 0.0, 0.0, 0.0, 1e-2];
        (0..count).for_each(|own| matrix.add(own, own, &small));
        for (k, [i, j]) in pairs.into_iter().enumerate() {
            let number = |phase: f64| (1e3 * (k as f64 + seed as f64 + phase).sin()).sin();
            let n = [0.1, 0.2, 0.3].map(number);
            let rod: [f64; 9] = core::array::from_fn(|e| n[e / 3] * n[e % 3]);
            matrix.add(i, i, &rod);
            matrix.add(j, j, &rod);
            matrix.add(i, j, &if number(0.4) > 0.0 { rod } else { rod.map(|entry| -entry) });
        }
        matrix
    }

    #[test]
    fn all_pivots_of_a_definite_matrix_hold_when_all_is_stabilised() {
        let mut collapsed = 0;
        for seed in 0..50 {
            let matrix = rods(12, seed);
            let schedule = schedule(matrix.sparsity(), 1 + seed % 3);
            let mut packed = PackedMatrix::new(&schedule.layout);
            let mut incomplete = IncompleteCholesky::new(&schedule.layout, false);
            let mut holds = |fill: DroppedFill| {
                packed.pack(Arch::new(), &schedule.layout, &matrix);
                let IncompleteCholesky { elimination, factor, .. } = &mut incomplete;
                let attempt = Attempt { fill, shift: 0.0 };
                let input = Input { schedule: &schedule, packed: &packed, attempt };
                elimination.eliminate(Arch::new(), input, factor)
            };
            assert!(holds(DroppedFill::Stabilised(1.0)), "seed {seed}");
            collapsed += usize::from(!holds(DroppedFill::Stabilised(0.0)));
        }
        assert!(collapsed > 0, "none of these matrices shows the difference");
    }

    #[test]
    fn an_indefinite_matrix_with_a_definite_diagonal_ends_in_a_definite_factor() {
        let mut factored = factorise(&chain(30, 1.0, -30.0));
        assert_eq!(factored.failed, Ok(ATTEMPTS.len()));
        assert!(factored.incomplete.factor.is_diagonal);
        let r: Vec<f64> = (0..90).map(|k| (k as f64).cos()).collect();
        let product = dot(&r, &apply(&mut factored, &r));
        assert!(product > 0.0, "{product}");
    }
}
