//! Elimination: turns a packed matrix into a factor, batch by batch.

use pulp::{Arch, Simd, WithSimd};

use super::dropped_fill::{DroppedFill, DroppedUpdate, Square};
use super::factor::{Factor, FactorRows};
use super::schur_complement::SchurComplement;
use crate::linear::lane_block::{
    SymmetricBlocks, are_definite, determinant, inverse, lane_of, symmetric_of_product,
    symmetric_times, transposed_times,
};
use crate::linear::lanes::{Double, LANES, Number, Single, narrowed, widened};
use crate::linear::level_schedule::LevelSchedule;
use crate::linear::level_schedule::layout::BatchLayout;
use crate::linear::level_schedule::part::{Group, Part};
use crate::linear::level_schedule::row_order::ABSENT;
use crate::linear::level_schedule::run::{IrregularEntry, Run};
use crate::linear::level_schedule::updates::{IrregularUpdate, UpdateTarget};
use crate::linear::packed_matrix::PackedMatrix;

/// Fraction of the determinant of its original block below which that of a pivot is refused.
///
/// Large steps leave pivots that are positive but almost zero; conjugate gradients then stagnate
/// for thousands of iterations without an error. Measured on cloth at 17 ms: without the rule more
/// than half of the steps were lost, with it none. Much larger values shift matrices that need no
/// shift, and weaken the factor.
const PIVOT_COLLAPSE: f64 = 1e-5;

/// Variant of the elimination to try.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Attempt {
    pub fill: DroppedFill,
    /// Relative shift of the main diagonal.
    pub shift: f64,
}

/// Work spaces of an elimination: one for each part, and one for the separators.
#[derive(Debug)]
pub(crate) struct Elimination {
    parts: Vec<GroupWork>,
    separators: GroupWork,
}

/// Schur complement and work space of a part or of the separators.
#[derive(Debug)]
struct GroupWork {
    schur: SchurComplement,
    batch: BatchWork,
}

/// Matrix to factorise, and how.
#[derive(Clone, Copy)]
pub(crate) struct Input<'a> {
    pub schedule: &'a LevelSchedule,
    pub packed: &'a PackedMatrix,
    pub attempt: Attempt,
}

/// Consecutive parts, with their work space and their rows of the factor.
struct Parts<'a> {
    parts: &'a [Part],
    work: &'a mut [GroupWork],
    factor: FactorRows<'a>,
}

/// Elimination of a part or of a separator.
struct GroupElimination<'a, 'f> {
    input: Input<'a>,
    group: &'a Group,
    work: &'a mut GroupWork,
    factor: &'a mut FactorRows<'f>,
    /// First run that is not copied to the Schur complement yet.
    loaded: usize,
}

/// Copies all separators to their Schur complement.
struct LoadSeparators<'a> {
    input: Input<'a>,
    schur: &'a mut SchurComplement,
}

/// Work space of the batch that is being eliminated.
#[derive(Debug)]
struct BatchWork {
    /// Blocks that its diagonals subtract from the pivots of their columns.
    squares: Vec<Square<Single>>,
    /// The same blocks, with the replacements of dropped updates.
    subtracted: Vec<SymmetricBlocks<Single>>,
    /// Blocks that its irregular entries subtract from the pivots of their columns.
    irregular_squares: Vec<Square<f32>>,
}

/// Batch of a run that is being eliminated.
#[derive(Clone, Copy)]
struct Batch<'a> {
    schedule: &'a LevelSchedule,
    run: &'a Run,
    /// Number of the batch within its run.
    index: usize,
    fill: DroppedFill,
}

impl Batch<'_> {
    #[inline(always)]
    fn first_row(&self) -> usize {
        self.run.start + self.index * LANES
    }
}

impl Elimination {
    pub(crate) fn new(layout: &BatchLayout) -> Self {
        let part = |part| GroupWork::new(layout, SchurComplement::of_part(layout, part));
        Self {
            parts: layout.parts.iter().map(part).collect(),
            separators: GroupWork::new(layout, SchurComplement::of_separators(layout)),
        }
    }

    /// Factorises a packed matrix, the parts side by side. Returns false if a pivot collapses; the
    /// factor is then unfinished.
    pub(crate) fn eliminate(&mut self, arch: Arch, input: Input<'_>, factor: &mut Factor) -> bool {
        let Self { parts, separators } = self;
        let layout = &input.schedule.layout;
        factor.is_diagonal = false;
        let all = Parts { parts: &layout.parts, work: parts, factor: factor.rows() };
        if !all.eliminate(arch, input) {
            return false;
        }
        arch.dispatch(LoadSeparators { input, schur: &mut separators.schur });
        for part in parts {
            separators.schur.add_part(&part.schur);
        }
        let factor = &mut factor.rows();
        layout.separators.iter().all(|group| {
            let (work, loaded) = (&mut *separators, group.runs.end);
            arch.dispatch(GroupElimination { input, group, work, factor, loaded })
        })
    }
}

impl Parts<'_> {
    /// Eliminates the parts side by side; all of them, because it depends on the threads in which
    /// of them a pivot collapses first.
    fn eliminate(self, arch: Arch, input: Input<'_>) -> bool {
        let Self { parts, work, mut factor } = self;
        if let ([part], [work]) = (parts, &mut *work) {
            work.schur.clear_separators();
            let (group, factor, loaded) = (&part.own, &mut factor, part.own.runs.start);
            return arch.dispatch(GroupElimination { input, group, work, factor, loaded });
        }
        let (here, there) = parts.split_at(parts.len() / 2);
        let (own, others) = work.split_at_mut(here.len());
        let (factor, more) = factor.split_before(&there[0].own);
        let here = Self { parts: here, work: own, factor };
        let there = Self { parts: there, work: others, factor: more };
        let (a, b) = rayon::join(|| here.eliminate(arch, input), || there.eliminate(arch, input));
        a && b
    }
}

impl Attempt {
    /// Factor of the main diagonal.
    fn scale(&self) -> f64 {
        1.0 + self.shift
    }
}

impl WithSimd for LoadSeparators<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { input: Input { schedule, packed, attempt }, schur } = self;
        let layout = &schedule.layout;
        for separator in &layout.separators {
            for run in &layout.runs[separator.runs.clone()] {
                schur.load(layout, run, packed, attempt.scale());
            }
        }
    }
}

impl WithSimd for GroupElimination<'_, '_> {
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> bool {
        let Self { input: Input { schedule, packed, attempt }, .. } = self;
        let Self { group, work, factor, mut loaded, .. } = self;
        let layout = &schedule.layout;
        let scale = attempt.scale();
        let floor = Double::of(PIVOT_COLLAPSE * scale.powi(3));
        for run in &layout.runs[group.runs.clone()] {
            while loaded < run.look_ahead {
                work.schur.load(layout, &layout.runs[loaded], packed, scale);
                loaded += 1;
            }
            for (index, row) in (run.start..run.end).step_by(LANES).enumerate() {
                let pivot = widened(&work.schur.pivots(run, index));
                if !are_definite(&pivot, floor * determinant(&packed.main_diagonal(row))) {
                    return false;
                }
                let inverse = inverse(&pivot, determinant(&pivot));
                *factor.inverse_pivot_of(run, index) = inverse;
                let short = narrowed(&inverse);
                let batch = Batch { schedule, run, index, fill: attempt.fill };
                work.eliminate_diagonals(batch, &short, factor);
                work.eliminate_irregular(batch, &short, factor);
            }
        }
        true
    }
}

impl GroupWork {
    fn new(layout: &BatchLayout, schur: SchurComplement) -> Self {
        let batch = BatchWork {
            squares: Vec::with_capacity(layout.max_diagonals),
            subtracted: Vec::with_capacity(layout.max_diagonals),
            irregular_squares: Vec::with_capacity(layout.max_irregular),
        };
        Self { schur, batch }
    }

    /// Computes the rows of `U` of a batch that lie on diagonals, and subtracts their updates.
    #[inline(always)]
    fn eliminate_diagonals(
        &mut self,
        batch: Batch<'_>,
        inverse: &SymmetricBlocks<Single>,
        factor: &mut FactorRows<'_>,
    ) {
        let Self { schur, batch: BatchWork { squares, subtracted, .. } } = self;
        let Batch { schedule: LevelSchedule { layout, updates }, run, index, fill } = batch;
        let row = batch.first_row();
        let diagonals = run.diagonals.clone();
        squares.clear();
        subtracted.clear();
        let upper = factor.upper_of(run, index);
        for (diagonal, upper) in upper.iter_mut().enumerate() {
            let block = schur.off_diagonal(run, diagonal, index);
            *upper = symmetric_times(inverse, &block);
            let square = Square::new(symmetric_of_product(&block, upper), fill);
            subtracted.push(square.blocks);
            squares.push(square);
        }
        for (left, diagonal) in diagonals.enumerate() {
            let block = schur.off_diagonal(run, left, index);
            let a = &layout.diagonals[diagonal];
            let target = &layout.runs[a.run as usize];
            let pivots = schur.place(target.numbers);
            let place = a.column(row).wrapping_sub(target.start);
            for update in &updates.regular[updates.regular_of[diagonal].clone()] {
                let right = update.right as usize;
                if update.target != ABSENT {
                    let product = transposed_times(&block, &upper[right]);
                    let column = (6 + 9 * update.target as usize) * target.len();
                    let first = (pivots + column).wrapping_add(place);
                    schur.subtract(first, target.len(), &product);
                    continue;
                }
                let replacement = fill.replacement(&DroppedUpdate {
                    left: &block,
                    right: &upper[right],
                    left_square: &squares[left],
                    right_square: &squares[right],
                });
                for (diagonal, blocks) in [(left, &replacement.left), (right, &replacement.right)] {
                    for (subtracted, entry) in subtracted[diagonal].iter_mut().zip(blocks) {
                        *subtracted = *subtracted + *entry;
                    }
                }
            }
            // Later diagonals add nothing to it: updates are with later ones only.
            schur.subtract(pivots.wrapping_add(place), target.len(), &subtracted[left]);
        }
    }

    /// Computes the irregular entries of the rows of `U` of a batch, and subtracts the updates of
    /// its single lanes. Comes after the diagonals.
    #[inline(always)]
    fn eliminate_irregular(
        &mut self,
        batch: Batch<'_>,
        inverse: &SymmetricBlocks<Single>,
        factor: &mut FactorRows<'_>,
    ) {
        let Self { schur, batch: BatchWork { squares, irregular_squares, .. } } = self;
        let Batch { schedule: LevelSchedule { layout, updates }, run, index, fill } = batch;
        let own = layout.irregular_of[run.batches + index].clone();
        let (upper, irregular) = factor.rows_of(run, index, own.clone());
        irregular_squares.clear();
        for entry in own.clone() {
            let block = schur.block_at(run.irregular_address(entry));
            let IrregularEntry { lane, column, .. } = layout.irregular[entry];
            let scaled = symmetric_times(&lane_of(inverse, lane), &block);
            let square = Square::new(symmetric_of_product(&block, &scaled), fill);
            schur.subtract_at(layout.pivots[column as usize], &square.blocks);
            irregular[entry - own.start] = scaled;
            irregular_squares.push(square);
        }
        let count = run.diagonals.len();
        let of_batch = updates.irregular_of[run.batches + index].clone();
        for &IrregularUpdate { lane, left, right, target } in &updates.irregular[of_batch] {
            let [left, right] = [left as usize, right as usize];
            let address = match left.checked_sub(count) {
                None => run.address(left, batch.first_row() + lane as usize),
                Some(entry) => run.irregular_address(own.start + entry),
            };
            let block = schur.block_at(address);
            let scaled = match right.checked_sub(count) {
                None => lane_of(&upper[right], lane),
                Some(entry) => irregular[entry],
            };
            match target {
                UpdateTarget::Block(address) => {
                    schur.subtract_at(address, &transposed_times(&block, &scaled));
                }
                UpdateTarget::Dropped([left_pivot, right_pivot]) => {
                    let square = |number: usize| match number.checked_sub(count) {
                        None => squares[number].lane(lane),
                        Some(entry) => irregular_squares[entry],
                    };
                    let replacement = fill.replacement(&DroppedUpdate {
                        left: &block,
                        right: &scaled,
                        left_square: &square(left),
                        right_square: &square(right),
                    });
                    schur.subtract_at(left_pivot, &replacement.left);
                    schur.subtract_at(right_pivot, &replacement.right);
                }
            }
        }
    }
}
