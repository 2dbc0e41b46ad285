//! Elimination: computes the factor of a packed matrix, batch by batch.

use pulp::{Arch, Simd, WithSimd};

use super::dropped_fill::{DroppedFill, DroppedUpdate, Square};
use super::factor::{Factor, FactorRows};
use super::schur_complement::SchurComplement;
use crate::linear::lane_block::{
    SymmetricBlocks, are_definite, determinant, extract_lane, inverse, symmetric_times,
    transposed_times, upper_half_of_product,
};
use crate::linear::lanes::{Double, LANES, Number, Single, narrowed, widened};
use crate::linear::level_schedule::LevelSchedule;
use crate::linear::level_schedule::layout::BatchLayout;
use crate::linear::level_schedule::part::{Group, MatrixPart};
use crate::linear::level_schedule::row_order::ABSENT;
use crate::linear::level_schedule::run::{IrregularEntry, Run};
use crate::linear::level_schedule::updates::{IrregularUpdate, UpdateTarget};
use crate::linear::packed_matrix::PackedMatrix;
use crate::threads;

/// A pivot collapses if its determinant is below this fraction of the determinant of the original
/// block.
///
/// Large steps lead to pivots that are positive but almost zero. Conjugate gradients then stagnate
/// for thousands of iterations without an error. On cloth at 17 ms more than half of the steps
/// failed without this rule, and none with it. Much larger values shift matrices that need no
/// shift, and weaken the factor.
const PIVOT_COLLAPSE: f64 = 1e-5;

/// Variant of the elimination to try.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Attempt {
    pub fill: DroppedFill,
    /// Relative shift of the main diagonal.
    pub shift: f64,
}

/// Work space of an elimination: one for each part, and one for the separators.
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

/// Matrix to factorise, and the variant of the elimination.
#[derive(Clone, Copy)]
pub(crate) struct Input<'a> {
    pub schedule: &'a LevelSchedule,
    pub packed: &'a PackedMatrix,
    pub attempt: Attempt,
}

/// Consecutive parts, with their work space and their rows of the factor.
struct Parts<'a> {
    parts: &'a [MatrixPart],
    work: &'a mut [GroupWork],
    factor: FactorRows<'a>,
}

/// Elimination of a part or of a separator.
struct GroupElimination<'a, 'f> {
    input: Input<'a>,
    group: &'a Group,
    work: &'a mut GroupWork,
    factor: &'a mut FactorRows<'f>,
    /// First run that is not yet copied to the Schur complement.
    loaded: usize,
}

/// Copies the rows of all separators to their Schur complement.
struct LoadSeparators<'a> {
    input: Input<'a>,
    schur: &'a mut SchurComplement,
}

/// Work space of the elimination of a batch.
#[derive(Debug)]
struct BatchWork {
    /// Blocks that the diagonals of the batch subtract from the pivots of their columns.
    squares: Vec<Square<Single>>,
    /// Sums of `squares` and the replacements of dropped updates.
    subtracted: Vec<SymmetricBlocks<Single>>,
    /// Blocks that the irregular entries of the batch subtract from the pivots of their columns.
    irregular_squares: Vec<Square<f32>>,
}

/// Batch of a run under elimination.
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
    /// Allocates work space for `layout`.
    pub(crate) fn new(layout: &BatchLayout) -> Self {
        let parts = layout.parts.iter();
        let schur_complements = parts.map(|part| SchurComplement::for_part(layout, part));
        Self {
            parts: schur_complements.map(|schur| GroupWork::new(layout, schur)).collect(),
            separators: GroupWork::new(layout, SchurComplement::for_separators(layout)),
        }
    }

    /// Computes the `factor` of the matrix in `input`, the parts side by side. Returns `false` if a
    /// pivot collapses. The factor is then unfinished.
    pub(crate) fn eliminate(&mut self, arch: Arch, input: Input<'_>, factor: &mut Factor) -> bool {
        let Self { parts, separators } = self;
        let layout = &input.schedule.layout;
        factor.is_diagonal = false;
        let parts_of_matrix = Parts { parts: &layout.parts, work: parts, factor: factor.rows() };
        if !parts_of_matrix.eliminate(arch, input) {
            return false;
        }

        // Separators follow after the sums of all parts, in the order of the parts.
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
    /// Eliminates the parts of the matrix in `input` side by side. Returns whether no pivot
    /// collapsed. All parts are eliminated in any case, because the threads decide in which part a
    /// pivot collapses first.
    fn eliminate(self, arch: Arch, input: Input<'_>) -> bool {
        let Self { parts, work, mut factor } = self;
        if let ([part], [work]) = (parts, &mut *work) {
            work.schur.clear_separators();
            let (group, factor, loaded) = (&part.group, &mut factor, part.group.runs.start);
            return arch.dispatch(GroupElimination { input, group, work, factor, loaded });
        }

        let (first_parts, second_parts) = parts.split_at(parts.len() / 2);
        let (first_work, second_work) = work.split_at_mut(first_parts.len());
        let (first_rows, second_rows) = factor.split_before(&second_parts[0].group);
        let first = Self { parts: first_parts, work: first_work, factor: first_rows };
        let second = Self { parts: second_parts, work: second_work, factor: second_rows };
        let (first_success, second_success) =
            threads::join(|| first.eliminate(arch, input), || second.eliminate(arch, input));
        first_success && second_success
    }
}

impl Attempt {
    /// Returns the factor of the main diagonal.
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
        let floor = Double::splat(PIVOT_COLLAPSE * scale.powi(3));

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

impl BatchWork {
    /// Returns the square of the block `number` in `lane`. Blocks are numbered as in
    /// [`IrregularUpdate`], with `count` diagonals.
    #[inline(always)]
    fn square(&self, number: usize, count: usize, lane: u32) -> Square<f32> {
        match number.checked_sub(count) {
            None => self.squares[number].lane(lane),
            Some(entry) => self.irregular_squares[entry],
        }
    }
}

impl GroupWork {
    /// Allocates work space for the group with the Schur complement `schur`.
    fn new(layout: &BatchLayout, schur: SchurComplement) -> Self {
        let batch = BatchWork {
            squares: Vec::with_capacity(layout.max_diagonals),
            subtracted: Vec::with_capacity(layout.max_diagonals),
            irregular_squares: Vec::with_capacity(layout.max_irregular),
        };
        Self { schur, batch }
    }

    /// Computes the blocks of `U` in the rows of `batch` that lie on diagonals, and subtracts their
    /// updates from the Schur complement. `inverse` holds the inverse pivots of the batch.
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
            let square = Square::new(upper_half_of_product(&block, upper), fill);
            subtracted.push(square.blocks);
            squares.push(square);
        }

        // Each pair of diagonals updates a diagonal of the columns' run, or is dropped.
        for (left, diagonal) in diagonals.enumerate() {
            let block = schur.off_diagonal(run, left, index);
            let left_diagonal = &layout.diagonals[diagonal];
            let target = &layout.runs[left_diagonal.run as usize];
            let pivots = schur.index_of(target.numbers);
            let offset = left_diagonal.column(row).wrapping_sub(target.start);
            for update in &updates.regular[updates.regular_of[diagonal].clone()] {
                let right = update.right as usize;
                if update.target != ABSENT {
                    let product = transposed_times(&block, &upper[right]);
                    let column = (6 + 9 * update.target as usize) * target.len();
                    let first = (pivots + column).wrapping_add(offset);
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
            // This diagonal is complete: the updates of later diagonals involve later ones only.
            schur.subtract(pivots.wrapping_add(offset), target.len(), &subtracted[left]);
        }
    }

    /// Computes the irregular entries of `U` in the rows of `batch`, and subtracts the updates of
    /// single lanes from the Schur complement. `inverse` holds the inverse pivots of the batch.
    /// Call this after [`eliminate_diagonals`](Self::eliminate_diagonals).
    #[inline(always)]
    fn eliminate_irregular(
        &mut self,
        batch: Batch<'_>,
        inverse: &SymmetricBlocks<Single>,
        factor: &mut FactorRows<'_>,
    ) {
        let Self { schur, batch: work } = self;
        let Batch { schedule: LevelSchedule { layout, updates }, run, index, fill } = batch;
        let entries = layout.irregular_of[run.batches + index].clone();
        let (upper, irregular) = factor.rows_of(run, index, entries.clone());

        work.irregular_squares.clear();
        for entry in entries.clone() {
            let block = schur.block_at(run.irregular_address(entry));
            let IrregularEntry { lane, column, .. } = layout.irregular[entry];
            let scaled = symmetric_times(&extract_lane(inverse, lane), &block);
            let square = Square::new(upper_half_of_product(&block, &scaled), fill);
            schur.subtract_at(layout.pivots[column as usize], &square.blocks);
            irregular[entry - entries.start] = scaled;
            work.irregular_squares.push(square);
        }

        // Numbers of blocks below `count` are diagonals, the others irregular entries.
        let count = run.diagonals.len();
        let of_batch = updates.irregular_of[run.batches + index].clone();
        for &IrregularUpdate { lane, left, right, target } in &updates.irregular[of_batch] {
            let [left, right] = [left as usize, right as usize];
            let address = match left.checked_sub(count) {
                None => run.address(left, batch.first_row() + lane as usize),
                Some(entry) => run.irregular_address(entries.start + entry),
            };
            let block = schur.block_at(address);
            let scaled = match right.checked_sub(count) {
                None => extract_lane(&upper[right], lane),
                Some(entry) => irregular[entry],
            };
            match target {
                UpdateTarget::Block(address) => {
                    schur.subtract_at(address, &transposed_times(&block, &scaled));
                }
                UpdateTarget::Dropped([left_pivot, right_pivot]) => {
                    let replacement = fill.replacement(&DroppedUpdate {
                        left: &block,
                        right: &scaled,
                        left_square: &work.square(left, count, lane),
                        right_square: &work.square(right, count, lane),
                    });
                    schur.subtract_at(left_pivot, &replacement.left);
                    schur.subtract_at(right_pivot, &replacement.right);
                }
            }
        }
    }
}
