//! Triangular solves with a finished factor, part by part.
//!
//! Only separators couple the parts, so the parts are solved side by side:
//!
//! 1. Forward substitution for each part. The amounts that a part subtracts from the separators are
//!    collected in the window of the part.
//! 2. Forward and backward substitution for the separators, after the addition of all windows in
//!    the order of the parts.
//! 3. Backward substitution for each part.

use core::ops::Range;

use pulp::{Arch, Simd, WithSimd};

use super::factor::Factor;
use crate::linear::lane_block::{SymmetricBlocks, product, symmetric_product, transposed_product};
use crate::linear::lanes::{Columns, Double, LANES, Single, narrowed, widened};
use crate::linear::level_schedule::layout::BatchLayout;
use crate::linear::level_schedule::part::MatrixPart;
use crate::threads;

/// Work space of the triangular solves.
#[derive(Debug)]
pub(crate) struct TriangularSolve {
    /// Numbers in the window of each part: the rows of the separators coupled to the part.
    windows: Vec<Columns<f32>>,
}

/// Consecutive rows of a vector.
struct Rows<'a> {
    first: usize,
    columns: [&'a mut [f32]; 3],
}

impl<'a> Rows<'a> {
    /// Returns `columns` as rows from `first` on.
    fn new(first: usize, columns: &'a mut Columns<f32>) -> Self {
        Self { first, columns: columns.0.each_mut().map(|column| &mut column[..]) }
    }

    /// Splits the rows into the rows before `row`, and `row` with the rows after it.
    fn split_before(self, row: usize) -> (Self, Self) {
        let Self { first, mut columns } = self;
        let earlier = columns
            .each_mut()
            .map(|column| column.split_off_mut(..row - first).unwrap_or_default());
        (Self { first, columns: earlier }, Self { first: row, columns })
    }

    /// Returns whether `row` is one of the rows.
    fn contains(&self, row: usize) -> bool {
        row.wrapping_sub(self.first) < self.columns[0].len()
    }

    /// Returns the numbers of the batch that begins at `row`.
    #[inline(always)]
    fn load(&self, row: usize) -> [Single; 3] {
        let [x, y, z] = &self.columns;
        let at = row - self.first;
        [Single::load(x, at), Single::load(y, at), Single::load(z, at)]
    }

    /// Writes `lanes` into the batch that begins at `row`.
    #[inline(always)]
    fn store(&mut self, row: usize, lanes: [Single; 3]) {
        for (column, lanes) in self.columns.iter_mut().zip(lanes) {
            lanes.store(column, row - self.first);
        }
    }

    /// Subtracts `[a, b, c]` from the numbers of the batch that begins at `row`.
    #[inline(always)]
    fn subtract_batch(&mut self, row: usize, [a, b, c]: [Single; 3]) {
        let [x, y, z] = self.load(row);
        self.store(row, [x - a, y - b, z - c]);
    }

    /// Returns the numbers of `row`.
    #[inline(always)]
    fn at(&self, row: usize) -> [f32; 3] {
        let [x, y, z] = &self.columns;
        let at = row - self.first;
        [x[at], y[at], z[at]]
    }

    /// Subtracts `numbers` from the numbers of `row`.
    #[inline(always)]
    fn subtract(&mut self, row: usize, numbers: [f32; 3]) {
        for (column, number) in self.columns.iter_mut().zip(numbers) {
            column[row - self.first] -= number;
        }
    }
}

impl TriangularSolve {
    pub(crate) fn new(layout: &BatchLayout) -> Self {
        Self { windows: layout.parts.iter().map(|part| Columns::new(part.window.len())).collect() }
    }

    /// Turns `image = r` into `(Uᵀ D U)⁻¹ r` with `factor`.
    pub(crate) fn apply(
        &mut self,
        arch: Arch,
        layout: &BatchLayout,
        factor: &Factor,
        image: &mut Columns<f32>,
    ) {
        let solver = FactorSolver { arch, layout, factor };
        let BatchLayout { parts, separators, .. } = layout;
        if factor.is_diagonal {
            return solver.sweep(Direction::Diagonal, 0..layout.runs.len(), image);
        }

        solver.sweep_parts(Direction::Forward, parts, &mut self.windows, Rows::new(0, image));

        for (part, window) in parts.iter().zip(&self.windows) {
            part.add_separators(window, image);
        }
        for separator in separators {
            solver.sweep(Direction::Forward, separator.runs.clone(), image);
        }
        for separator in separators.iter().rev() {
            solver.sweep(Direction::Backward, separator.runs.clone(), image);
        }
        for (part, window) in parts.iter().zip(&mut self.windows) {
            part.copy_separators(image, window);
        }

        solver.sweep_parts(Direction::Backward, parts, &mut self.windows, Rows::new(0, image));
    }
}

impl MatrixPart {
    /// Returns the `rows` of a separator, counted within the window.
    fn window_range(&self, rows: &Range<usize>) -> Range<usize> {
        rows.start - self.window.start..rows.end - self.window.start
    }

    /// Adds the numbers of separators in `window` to `image`.
    fn add_separators(&self, window: &Columns<f32>, image: &mut Columns<f32>) {
        for rows in &self.separators {
            for (column, window) in image.0.iter_mut().zip(&window.0) {
                let sums = column[rows.clone()].iter_mut();
                sums.zip(&window[self.window_range(rows)]).for_each(|(sum, term)| *sum += term);
            }
        }
    }

    /// Copies the numbers of separators from `image` to `window`.
    fn copy_separators(&self, image: &Columns<f32>, window: &mut Columns<f32>) {
        for rows in &self.separators {
            for (window, column) in window.0.iter_mut().zip(&image.0) {
                window[self.window_range(rows)].copy_from_slice(&column[rows.clone()]);
            }
        }
    }
}

/// Factor with the layout of its rows.
#[derive(Clone, Copy)]
struct FactorSolver<'a> {
    arch: Arch,
    layout: &'a BatchLayout,
    factor: &'a Factor,
}

impl FactorSolver<'_> {
    /// Takes the step `direction` of the solution for `runs` whose diagonals do not lead to
    /// separators of a part.
    fn sweep(self, direction: Direction, runs: Range<usize>, image: &mut Columns<f32>) {
        let Self { arch, layout, factor } = self;
        let separators = Rows { first: 0, columns: [&mut [], &mut [], &mut []] };
        let rows = Rows::new(0, image);
        arch.dispatch(Sweep { layout, factor, direction, runs, rows, separators });
    }

    /// Takes the step `direction` of the solution for `parts`, side by side. `rows` begin at or
    /// before the first part and end before the next part, so that the separator after each part
    /// belongs to the part's rows.
    fn sweep_parts(
        self,
        direction: Direction,
        parts: &[MatrixPart],
        windows: &mut [Columns<f32>],
        rows: Rows<'_>,
    ) {
        if let ([part], [window]) = (parts, &mut *windows) {
            if matches!(direction, Direction::Forward) {
                window.0.iter_mut().for_each(|column| column.fill(0.0));
            }
            let Self { arch, layout, factor } = self;
            let (_, rows) = rows.split_before(part.group.rows.start);
            let (runs, separators) =
                (part.group.runs.clone(), Rows::new(part.window.start, window));
            return arch.dispatch(Sweep { layout, factor, direction, runs, rows, separators });
        }

        let (first_parts, second_parts) = parts.split_at(parts.len() / 2);
        let (first_windows, second_windows) = windows.split_at_mut(first_parts.len());
        let (first_rows, second_rows) = rows.split_before(second_parts[0].group.rows.start);
        threads::join(
            || self.sweep_parts(direction, first_parts, first_windows, first_rows),
            || self.sweep_parts(direction, second_parts, second_windows, second_rows),
        );
    }
}

/// Step of the solution.
#[derive(Clone, Copy)]
enum Direction {
    /// Forward substitution, `D⁻¹ U⁻ᵀ`.
    Forward,
    /// Backward substitution, `U⁻¹`.
    Backward,
    /// Division by the pivots alone, `D⁻¹`.
    Diagonal,
}

/// Step of the solution for `runs`, which changes their `rows` and the rows of `separators`.
struct Sweep<'a> {
    layout: &'a BatchLayout,
    factor: &'a Factor,
    direction: Direction,
    runs: Range<usize>,
    rows: Rows<'a>,
    separators: Rows<'a>,
}

impl WithSimd for Sweep<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, _: S) {
        match self.direction {
            Direction::Forward => self.forward(),
            Direction::Backward => self.backward(),
            Direction::Diagonal => self.divide_by_pivots(),
        }
    }
}

impl Sweep<'_> {
    #[inline(always)]
    fn forward(&mut self) {
        let Self { layout, factor, runs, rows, separators, .. } = self;
        let Factor { upper, irregular, inverse_pivots, .. } = factor;

        for run in &layout.runs[runs.clone()] {
            let (inside, crossing) = layout.diagonals[run.diagonals.clone()].split_at(run.crossing);
            let starts = (run.start..run.end).step_by(LANES);
            for ((batch, row), pivot) in starts.enumerate().zip(&inverse_pivots[run.batches..]) {
                let numbers = rows.load(row);
                let (upper, across) = upper[run.blocks_of(batch)].split_at(run.crossing);
                for (diagonal, block) in inside.iter().zip(upper) {
                    rows.subtract_batch(diagonal.column(row), transposed_product(block, numbers));
                }
                for (diagonal, block) in crossing.iter().zip(across) {
                    let product = transposed_product(block, numbers);
                    separators.subtract_batch(diagonal.column(row), product);
                }

                let entries = layout.irregular_of[run.batches + batch].clone();
                let blocks = &irregular[entries.clone()];
                for (entry, block) in layout.irregular[entries].iter().zip(blocks) {
                    let column = entry.column as usize;
                    let product = transposed_product(block, rows.at(row + entry.lane as usize));
                    if rows.contains(column) {
                        rows.subtract(column, product);
                    } else {
                        separators.subtract(column, product);
                    }
                }
                divide(pivot, rows, row);
            }
        }
    }

    #[inline(always)]
    fn backward(&mut self) {
        let Self { layout, factor, runs, rows, separators, .. } = self;
        let Factor { upper, irregular, .. } = factor;

        for run in layout.runs[runs.clone()].iter().rev() {
            let (inside, crossing) = layout.diagonals[run.diagonals.clone()].split_at(run.crossing);
            for (batch, row) in (run.start..run.end).step_by(LANES).enumerate() {
                let (upper, across) = upper[run.blocks_of(batch)].split_at(run.crossing);
                let mut sum = [Single::ZERO; 3];
                for (diagonal, block) in inside.iter().zip(upper) {
                    add(&mut sum, product(block, rows.load(diagonal.column(row))));
                }
                for (diagonal, block) in crossing.iter().zip(across) {
                    add(&mut sum, product(block, separators.load(diagonal.column(row))));
                }
                rows.subtract_batch(row, sum);

                let entries = layout.irregular_of[run.batches + batch].clone();
                let blocks = &irregular[entries.clone()];
                for (entry, block) in layout.irregular[entries].iter().zip(blocks) {
                    let column = entry.column as usize;
                    let source = if rows.contains(column) { &*rows } else { &*separators };
                    let product = product(block, source.at(column));
                    rows.subtract(row + entry.lane as usize, product);
                }
            }
        }
    }

    #[inline(always)]
    fn divide_by_pivots(&mut self) {
        for run in &self.layout.runs[self.runs.clone()] {
            let pivots = self.factor.inverse_pivots[run.batches..].iter();
            for (row, pivot) in (run.start..run.end).step_by(LANES).zip(pivots) {
                divide(pivot, &mut self.rows, row);
            }
        }
    }
}

#[inline(always)]
fn add(sum: &mut [Single; 3], terms: [Single; 3]) {
    for (sum, term) in sum.iter_mut().zip(terms) {
        *sum = *sum + term;
    }
}

/// Multiplies the batch of `rows` that begins at `row` by the inverse pivots `pivot`, in double
/// precision: stiff and soft directions of a pivot may differ by many orders of magnitude.
#[inline(always)]
fn divide(pivot: &SymmetricBlocks<Double>, rows: &mut Rows<'_>, row: usize) {
    rows.store(row, narrowed(&symmetric_product(pivot, widened(&rows.load(row)))));
}
