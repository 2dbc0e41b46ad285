//! Incomplete Cholesky factorisation without fill, block by block, with its own fallbacks.

use crate::BlockMatrix;
use crate::fill::{Fill, Square};
use crate::lane_block::{
    Blocks, Halves, determinant, half_of_product, half_product, half_times, inverse, lane_of,
    product, sound, transposed_product, transposed_times,
};
use crate::lanes::{Columns, Double, LANES, Number, Single, narrowed, widened};
use crate::packed::Packed;
use crate::remainder::Remainder;
use crate::waves::{Batch, NOWHERE, Run, StrayUpdate, Waves};

/// A pivot whose determinant is below this fraction of its original block's is refused.
///
/// Large steps leave pivots that are positive but almost zero; conjugate gradients then stagnate for thousands
/// of iterations without an error. Measured on cloth at 17 ms: without the rule more than half of the steps
/// were lost, with it none. Much larger values shift matrices that need no shift, and weaken the factor.
const PIVOT_COLLAPSE: f64 = 1e-5;

/// How a factorisation is tried.
#[derive(Clone, Copy, Debug)]
struct Attempt {
    fill: Fill,
    /// Relative shift of the diagonal.
    shift: f64,
}

/// What is tried, one after the other, as pivots collapse, before the block diagonal alone is used, which cannot fail.
///
/// Each shift is four times the one before: coarse, because a factorisation costs as much as several iterations of the
/// solver. With shifts alone after the first, from 0 on, conjugate gradients took more iterations: 37 300 instead of
/// 21 300 on a wool let down from a platform, where four or five attempts failed for most factors and one fails now,
/// 163 000 instead of 112 000 on cloth that settles on a sphere, 25 900 instead of 22 600 on one on a cube.
/// Stabilisation without shifts did as well there, but with the springs of a garment's seams 75 000 instead of 26 000.
const ATTEMPTS: [Attempt; 7] = [
    Attempt { fill: Fill::Compensated(0.97), shift: 0.0 },
    Attempt { fill: Fill::Stabilised(0.05), shift: 0.004 },
    Attempt { fill: Fill::Stabilised(0.2), shift: 0.016 },
    Attempt { fill: Fill::Stabilised(0.8), shift: 0.064 },
    Attempt { fill: Fill::Stabilised(1.0), shift: 0.256 },
    Attempt { fill: Fill::Stabilised(1.0), shift: 1.024 },
    Attempt { fill: Fill::Stabilised(1.0), shift: 4.096 },
];

/// The factor `Uᵀ D U` of a matrix, `U` unit upper triangular on the matrix's own sparsity.
///
/// All but the inverses of pivots is in single precision, which a preconditioner does not need more than: it is bound by
/// memory. Both sweeps use the same `U`, so the product stays symmetric and positive.
#[derive(Debug)]
pub(crate) struct Incomplete {
    remainder: Remainder,
    /// `U` above the diagonal, as the matrix is packed: batches of diagonals, and strays.
    upper: Vec<Blocks<Single>>,
    strays: Vec<Blocks<f32>>,
    /// `D⁻¹`, by batch.
    pivots: Vec<Halves<Double>>,
    making: Making,
    /// The vector to apply the inverse to, by rows.
    pub image: Columns<f32>,
    /// Which of [`ATTEMPTS`] to begin with.
    first: usize,
    diagonal_only: bool,
}

/// A batch of `U` in the making.
#[derive(Debug)]
struct Making {
    /// What its blocks on diagonals take off the pivots, and what with all that there is no room for.
    squares: Vec<Square<Single>>,
    taken: Vec<Halves<Single>>,
    /// What its strays take off the pivots.
    stray_squares: Vec<Square<f32>>,
}

/// A diagonal block is not positive definite: neither is the matrix.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct NotDefinite;

impl Incomplete {
    pub(crate) fn new(waves: &Waves) -> Self {
        Self {
            remainder: Remainder::new(waves),
            upper: vec![[Single::ZERO; 9]; waves.slots.len()],
            strays: vec![[0.0; 9]; waves.strays.len()],
            pivots: vec![[Double::ZERO; 6]; waves.own_slots.len()],
            making: Making {
                squares: Vec::with_capacity(waves.widest),
                taken: Vec::with_capacity(waves.widest),
                stray_squares: Vec::with_capacity(waves.most_strays),
            },
            image: Columns::new(waves.rows),
            first: 0,
            diagonal_only: false,
        }
    }

    /// The next matrix need not be like the one before.
    pub(crate) fn forget(&mut self) {
        self.first = 0;
    }

    /// Packs a matrix and factorises it. Begins with the attempt that held last, or with the one before it if that held at
    /// once, unless it was [forgotten](Self::forget); but the first of all is tried no more after it has failed. Returns the
    /// number of attempts that failed.
    ///
    /// With the one before tried each time, the first was tried in vain for almost every matrix of a cloth on its way to rest,
    /// and for half of those of a swing.
    #[inline(always)]
    pub(crate) fn factorise(
        &mut self,
        waves: &Waves,
        matrix: &BlockMatrix,
        packed: &mut Packed,
    ) -> Result<usize, NotDefinite> {
        packed.pack(waves, matrix);
        let batches = || waves.runs.iter().flat_map(|run| (run.start..run.end).step_by(LANES));
        if !batches().all(|row| sound(&packed.own(row), Double::ZERO)) {
            return Err(NotDefinite);
        }
        let first = self.first;
        for (failed, attempt) in ATTEMPTS[first..].iter().enumerate() {
            if self.eliminate(waves, packed, *attempt) {
                self.diagonal_only = false;
                self.first = if failed == 0 && first > 1 { first - 1 } else { first + failed };
                return Ok(failed);
            }
        }
        self.diagonal_only = true;
        for (pivot, row) in self.pivots.iter_mut().zip(batches()) {
            let own = packed.own(row);
            *pivot = inverse(&own, determinant(&own));
        }
        Ok(ATTEMPTS.len() - first)
    }

    /// Factorises a packed matrix. False if a pivot collapses.
    #[inline(always)]
    fn eliminate(&mut self, waves: &Waves, packed: &Packed, attempt: Attempt) -> bool {
        let factor = 1.0 + attempt.shift;
        let floor = Double::of(PIVOT_COLLAPSE * factor.powi(3));
        let mut loaded = 0;
        for run in &waves.runs {
            while loaded < run.ahead {
                self.remainder.load(waves, &waves.runs[loaded], packed, factor);
                loaded += 1;
            }
            for (batch, row) in (run.start..run.end).step_by(LANES).enumerate() {
                let pivot = widened(&self.remainder.pivots(run, batch));
                if !sound(&pivot, floor * determinant(&packed.own(row))) {
                    return false;
                }
                let inverse = inverse(&pivot, determinant(&pivot));
                self.pivots[run.batches + batch] = inverse;
                let short = narrowed(&inverse);
                self.eliminate_diagonals((waves, run, batch), &short, attempt.fill);
                self.eliminate_strays((waves, run, batch), &short, attempt.fill);
            }
        }
        true
    }

    #[inline(always)]
    fn eliminate_diagonals(
        &mut self,
        (waves, run, batch): (&Waves, &Run, usize),
        inverse: &Halves<Single>,
        fill: Fill,
    ) {
        let Self { remainder, upper, making: Making { squares, taken, .. }, .. } = self;
        let row = run.start + batch * LANES;
        let diagonals = &waves.diagonals[run.diagonals.clone()];
        squares.clear();
        taken.clear();
        let upper = &mut upper[run.blocks_of(batch)];
        for (diagonal, upper) in upper.iter_mut().enumerate() {
            let block = remainder.above(run, (diagonal, batch));
            *upper = half_times(inverse, &block);
            let square = Square::new(half_of_product(&block, upper), fill);
            taken.push(square.blocks);
            squares.push(square);
        }
        for (left, a) in diagonals.iter().enumerate() {
            let block = remainder.above(run, (left, batch));
            let target = &waves.runs[a.run as usize];
            let place = (row + a.offset).wrapping_sub(target.start);
            for update in &waves.updates[a.updates.clone()] {
                let right = update.right as usize;
                if update.target != NOWHERE {
                    let product = transposed_times(&block, &upper[right]);
                    let column = (6 + 9 * update.target as usize) * target.len();
                    let first = (target.work + column).wrapping_add(place);
                    remainder.take_off((first, target.len()), &product);
                    continue;
                }
                let both = [&squares[left], &squares[right]];
                let replaced = fill.in_place_of((&block, &upper[right]), both);
                for (diagonal, replaced) in [left, right].into_iter().zip(&replaced) {
                    for (taken, replaced) in taken[diagonal].iter_mut().zip(replaced) {
                        *taken = *taken + *replaced;
                    }
                }
            }
            // Later diagonals add nothing to it: updates are with later ones only.
            let pivots = (target.work.wrapping_add(place), target.len());
            remainder.take_off(pivots, &taken[left]);
        }
    }

    /// To be called after that for the diagonals.
    #[inline(always)]
    fn eliminate_strays(
        &mut self,
        (waves, run, batch): (&Waves, &Run, usize),
        inverse: &Halves<Single>,
        fill: Fill,
    ) {
        let Self { remainder, upper, strays, making, .. } = self;
        let Making { squares, stray_squares, .. } = making;
        let Batch { strays: own, updates } = &waves.batches[run.batches + batch];
        stray_squares.clear();
        for index in own.clone() {
            let stray = &waves.strays[index];
            let block = remainder.block_at(waves.stray(index));
            let scaled = half_times(&lane_of(inverse, stray.lane), &block);
            let square = Square::new(half_of_product(&block, &scaled), fill);
            remainder.take_off_at(waves.pivots[stray.column as usize], &square.blocks);
            strays[index] = scaled;
            stray_squares.push(square);
        }
        let count = run.diagonals.len();
        let upper = &upper[run.blocks_of(batch)];
        for &StrayUpdate { lane, left, right, target } in &waves.stray_updates[updates.clone()] {
            let [left, right] = [left as usize, right as usize];
            let row = run.start + batch * LANES + lane as usize;
            let place = match left.checked_sub(count) {
                None => run.place(left, row),
                Some(stray) => waves.stray(own.start + stray),
            };
            let block = remainder.block_at(place);
            let scaled = match right.checked_sub(count) {
                None => lane_of(&upper[right], lane),
                Some(stray) => strays[own.start + stray],
            };
            match target {
                Ok(place) => remainder.take_off_at(place, &transposed_times(&block, &scaled)),
                Err(pivots) => {
                    let square = |item: usize| match item.checked_sub(count) {
                        None => squares[item].lane(lane),
                        Some(stray) => stray_squares[stray],
                    };
                    let both = [&square(left), &square(right)];
                    let replaced = fill.in_place_of((&block, &scaled), both);
                    for (pivot, replaced) in pivots.into_iter().zip(&replaced) {
                        remainder.take_off_at(pivot, replaced);
                    }
                }
            }
        }
    }

    /// Turns the image `r` into `(Uᵀ D U)⁻¹ r`.
    #[inline(always)]
    pub(crate) fn apply(&mut self, waves: &Waves) {
        if self.diagonal_only {
            for run in &waves.runs {
                let pivots = self.pivots[run.batches..].iter();
                for (row, pivot) in (run.start..run.end).step_by(LANES).zip(pivots) {
                    divide(pivot, &mut self.image, row);
                }
            }
        } else {
            self.sweep_down(waves);
            self.sweep_up(waves);
        }
    }

    /// `D⁻¹ U⁻ᵀ`.
    #[inline(always)]
    fn sweep_down(&mut self, waves: &Waves) {
        let Self { image, upper, strays, pivots, .. } = self;
        for run in &waves.runs {
            let diagonals = &waves.diagonals[run.diagonals.clone()];
            let starts = (run.start..run.end).step_by(LANES);
            for ((batch, row), pivot) in starts.enumerate().zip(&pivots[run.batches..]) {
                let here = image.load(row);
                let blocks = &upper[run.blocks_of(batch)];
                for (diagonal, block) in diagonals.iter().zip(blocks) {
                    let column = row + diagonal.offset;
                    let [x, y, z] = image.load(column);
                    let [a, b, c] = transposed_product(block, here);
                    image.store(column, [x - a, y - b, z - c]);
                }
                let own = waves.batches[run.batches + batch].strays.clone();
                for (stray, block) in waves.strays[own.clone()].iter().zip(&strays[own]) {
                    let here = image.at(row + stray.lane as usize);
                    image.take_off(stray.column as usize, transposed_product(block, here));
                }
                divide(pivot, image, row);
            }
        }
    }

    /// `U⁻¹`.
    #[inline(always)]
    fn sweep_up(&mut self, waves: &Waves) {
        let Self { image, upper, strays, .. } = self;
        for run in waves.runs.iter().rev() {
            let diagonals = &waves.diagonals[run.diagonals.clone()];
            for (batch, row) in (run.start..run.end).step_by(LANES).enumerate() {
                let blocks = &upper[run.blocks_of(batch)];
                let mut sum = [Single::ZERO; 3];
                for (diagonal, block) in diagonals.iter().zip(blocks) {
                    let more = product(block, image.load(row + diagonal.offset));
                    for (sum, more) in sum.iter_mut().zip(more) {
                        *sum = *sum + more;
                    }
                }
                let [x, y, z] = image.load(row);
                image.store(row, [x - sum[0], y - sum[1], z - sum[2]]);
                let own = waves.batches[run.batches + batch].strays.clone();
                for (stray, block) in waves.strays[own.clone()].iter().zip(&strays[own]) {
                    let there = image.at(stray.column as usize);
                    image.take_off(row + stray.lane as usize, product(block, there));
                }
            }
        }
    }
}

/// Applies inverse pivots, in double precision: stiff and soft directions may be far apart in them.
#[inline(always)]
fn divide(pivot: &Halves<Double>, image: &mut Columns<f32>, row: usize) {
    image.store(row, narrowed(&half_product(pivot, widened(&image.load(row)))));
}

#[cfg(test)]
mod tests {
    use faer::linalg::solvers::DenseSolveCore;

    use super::*;
    use crate::Sparsity;
    use crate::vector::dot;
    use crate::waves::tests::rimmed;

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
        waves: Waves,
        incomplete: Incomplete,
        failed: Result<usize, NotDefinite>,
    }

    fn factorise(matrix: &BlockMatrix) -> Factored {
        let waves = Waves::new(matrix.sparsity());
        let mut incomplete = Incomplete::new(&waves);
        let failed = incomplete.factorise(&waves, matrix, &mut Packed::new(&waves));
        Factored { waves, incomplete, failed }
    }

    /// The inverse of a factor times a vector.
    fn apply(Factored { waves, incomplete, .. }: &mut Factored, b: &[f64]) -> Vec<f64> {
        let image = &mut incomplete.image;
        let numbers = || (0..b.len()).map(|k| (k, k % 3, waves.places[k / 3] as usize));
        for (k, axis, row) in numbers() {
            image.0[axis][row] = b[k] as f32;
        }
        incomplete.apply(waves);
        numbers().map(|(_, axis, row)| incomplete.image.0[axis][row].into()).collect()
    }

    #[test]
    fn on_a_chain_the_factor_is_exact() {
        let matrix = chain(20, 3.0, -1.0);
        let mut factored = factorise(&matrix);
        assert_eq!(factored.failed, Ok(0));
        let b: Vec<f64> = (0..60).map(|k| (k as f64).sin()).collect();
        let mut back = vec![0.0; 60];
        matrix.multiply(&apply(&mut factored, &b), &mut back);
        for (b, back) in b.iter().zip(&back) {
            // Single precision.
            assert!((b - back).abs() < 1e-6, "{back} against {b}");
        }
    }

    #[test]
    fn batches_may_lead_beyond_the_last_row_with_zeros() {
        // Runs of many batches of which one couples to the last particle, another to the first of the last.
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
            matrix.multiply(&apply(&mut factored, &b), &mut back);
            for (b, back) in b.iter().zip(&back) {
                assert!((b - back).abs() < 1e-6, "{back} against {b}: {pairs:?}");
            }
        }
    }

    #[test]
    fn without_compensation_the_factor_is_the_matrix_on_its_pattern() {
        let sparsity = rimmed(7);
        let count = sparsity.particles();
        let mut matrix = BlockMatrix::zeros(sparsity.clone());
        for i in 0..count {
            matrix.add(i, i, &[9.0, 0.3, -0.2, 0.3, 9.5, 0.1, -0.2, 0.1, 8.0]);
            for slot in sparsity.row(i).skip(1) {
                let entry = |k: usize| ((9 * slot + k) as f64 * 0.7).sin();
                matrix.add_block(slot, &core::array::from_fn(entry));
            }
        }
        let waves = Waves::new(&sparsity);
        assert!(!waves.stray_updates.is_empty(), "nothing of this goes astray");
        let mut packed = Packed::new(&waves);
        let mut incomplete = Incomplete::new(&waves);
        packed.pack(&waves, &matrix);
        let attempt = Attempt { fill: Fill::Compensated(0.0), shift: 0.0 };
        assert!(incomplete.eliminate(&waves, &packed, attempt));
        let mut factored = Factored { waves, incomplete, failed: Ok(0) };
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
        let mut beside: f64 = 0.0;
        for (i, j) in (0..count).flat_map(|i| (i..count).map(move |j| (i, j))) {
            for k in 0..9 {
                let entry = factor[(3 * i + k / 3, 3 * j + k % 3)];
                match sparsity.slot(i, j) {
                    Some(slot) => {
                        let expected = matrix.blocks()[slot][k];
                        let error = (entry - expected).abs();
                        assert!(error < 1e-5, "({i}, {j}): {entry} for {expected}");
                    }
                    None => beside = beside.max(entry.abs()),
                }
            }
        }
        assert!(beside > 0.01, "there is room for everything");
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
    fn collapsing_pivots_are_cured_by_a_shift() {
        // Almost singular: the coupling nearly cancels the diagonal, so pivots run to zero along the chain.
        let failed = factorise(&chain(200, 2.0, -0.999)).failed;
        assert!(matches!(failed, Ok(1..6)), "{failed:?}");
    }

    /// Of terms `(n·x_i ± n·x_j)²` between the particles of a square lattice and those beside and across.
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
            let waves = Waves::new(matrix.sparsity());
            let mut packed = Packed::new(&waves);
            let mut incomplete = Incomplete::new(&waves);
            let mut holds = |fill: Fill| {
                packed.pack(&waves, &matrix);
                incomplete.eliminate(&waves, &packed, Attempt { fill, shift: 0.0 })
            };
            assert!(holds(Fill::Stabilised(1.0)), "seed {seed}");
            collapsed += usize::from(!holds(Fill::Stabilised(0.0)));
        }
        assert!(collapsed > 0, "none of these matrices shows the difference");
    }

    #[test]
    fn an_indefinite_matrix_with_a_definite_diagonal_ends_in_a_definite_factor() {
        let mut factored = factorise(&chain(30, 1.0, -30.0));
        assert_eq!(factored.failed, Ok(ATTEMPTS.len()));
        assert!(factored.incomplete.diagonal_only);
        let r: Vec<f64> = (0..90).map(|k| (k as f64).cos()).collect();
        let product = dot(&r, &apply(&mut factored, &r));
        assert!(product > 0.0, "{product}");
    }
}
