//! Triangular solves with a finished factor, part by part.
//!
//! Parts are coupled by separators alone. So they are solved for side by side, down to the
//! separators and up again:
//!
//! 1. each part by forward substitution, with what it takes off the separators in a vector of its
//!    own;
//! 2. the separators, from these vectors in the order of the parts, forward and backward;
//! 3. each part by backward substitution.

use core::ops::Range;

use pulp::{Arch, Simd, WithSimd};

use super::factor::Factor;
use crate::linear::lane_block::{SymmetricBlocks, product, symmetric_product, transposed_product};
use crate::linear::lanes::{Columns, Double, LANES, Single, narrowed, widened};
use crate::linear::level_schedule::layout::BatchLayout;
use crate::linear::level_schedule::part::Part;

/// Work space of the triangular solves.
#[derive(Debug)]
pub(crate) struct TriangularSolve {
    /// Numbers of each part in the rows of its window, those of separators.
    windows: Vec<Columns<f32>>,
}

/// Consecutive rows of a vector.
struct Rows<'a> {
    first: usize,
    columns: [&'a mut [f32]; 3],
}

impl<'a> Rows<'a> {
    fn of(first: usize, columns: &'a mut Columns<f32>) -> Self {
        Self { first, columns: columns.0.each_mut().map(|column| &mut column[..]) }
    }

    /// Splits the rows before a row from the others.
    fn split_before(self, row: usize) -> (Self, Self) {
        let Self { first, mut columns } = self;
        let split = |rest: &mut &'a mut [f32]| rest.split_off_mut(..row - first);
        let here = columns.each_mut().map(|rest| split(rest).unwrap_or_default());
        (Self { first, columns: here }, Self { first: row, columns })
    }

    fn contains(&self, row: usize) -> bool {
        row.wrapping_sub(self.first) < self.columns[0].len()
    }

    /// Numbers of a batch of rows.
    #[inline(always)]
    fn load(&self, row: usize) -> [Single; 3] {
        let [x, y, z] = &self.columns;
        let at = row - self.first;
        [Single::load(x, at), Single::load(y, at), Single::load(z, at)]
    }

    #[inline(always)]
    fn store(&mut self, row: usize, lanes: [Single; 3]) {
        for (column, lanes) in self.columns.iter_mut().zip(lanes) {
            lanes.store(column, row - self.first);
        }
    }

    /// Subtracts from the numbers of a batch of rows.
    #[inline(always)]
    fn subtract_batch(&mut self, row: usize, [a, b, c]: [Single; 3]) {
        let [x, y, z] = self.load(row);
        self.store(row, [x - a, y - b, z - c]);
    }

    /// Numbers of a row.
    #[inline(always)]
    fn at(&self, row: usize) -> [f32; 3] {
        let [x, y, z] = &self.columns;
        let at = row - self.first;
        [x[at], y[at], z[at]]
    }

    /// Subtracts from the numbers of a row.
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

    /// Turns the image `r` into `(Uᵀ D U)⁻¹ r`.
    pub(crate) fn apply(
        &mut self,
        arch: Arch,
        layout: &BatchLayout,
        factor: &Factor,
        image: &mut Columns<f32>,
    ) {
        let solver = Solver { arch, layout, factor };
        let BatchLayout { parts, separators, .. } = layout;
        if factor.is_diagonal {
            return solver.sweep(Direction::Across, 0..layout.runs.len(), image);
        }
        solver.sweep_parts(Direction::Forward, parts, &mut self.windows, Rows::of(0, image));
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
        solver.sweep_parts(Direction::Backward, parts, &mut self.windows, Rows::of(0, image));
    }
}

impl Part {
    /// Rows of a separator in the window.
    fn local(&self, rows: &Range<usize>) -> Range<usize> {
        rows.start - self.window.start..rows.end - self.window.start
    }

    /// Adds the numbers of separators to those of a vector.
    fn add_separators(&self, window: &Columns<f32>, image: &mut Columns<f32>) {
        for rows in &self.separators {
            for (column, own) in image.0.iter_mut().zip(&window.0) {
                let sums = column[rows.clone()].iter_mut();
                sums.zip(&own[self.local(rows)]).for_each(|(sum, own)| *sum += own);
            }
        }
    }

    /// Copies the numbers of separators from a vector.
    fn copy_separators(&self, image: &Columns<f32>, window: &mut Columns<f32>) {
        for rows in &self.separators {
            for (own, column) in window.0.iter_mut().zip(&image.0) {
                own[self.local(rows)].copy_from_slice(&column[rows.clone()]);
            }
        }
    }
}

/// Factor that is solved with.
#[derive(Clone, Copy)]
struct Solver<'a> {
    arch: Arch,
    layout: &'a BatchLayout,
    factor: &'a Factor,
}

impl Solver<'_> {
    /// Takes a step of the solution for some runs whose diagonals do not cross.
    fn sweep(self, direction: Direction, runs: Range<usize>, image: &mut Columns<f32>) {
        let Self { arch, layout, factor } = self;
        let separators = Rows { first: 0, columns: [&mut [], &mut [], &mut []] };
        let own = Rows::of(0, image);
        arch.dispatch(Sweep { layout, factor, direction, runs, own, separators });
    }

    /// Takes a step of the solution for parts, side by side. `rows` begin at the first part or
    /// before it and end before the next one, so that the separator after each part is among its
    /// rows.
    fn sweep_parts(
        self,
        direction: Direction,
        parts: &[Part],
        windows: &mut [Columns<f32>],
        rows: Rows<'_>,
    ) {
        if let ([part], [window]) = (parts, &mut *windows) {
            if matches!(direction, Direction::Forward) {
                window.0.iter_mut().for_each(|column| column.fill(0.0));
            }
            let Self { arch, layout, factor } = self;
            let (_, own) = rows.split_before(part.own.rows.start);
            let (runs, separators) = (part.own.runs.clone(), Rows::of(part.window.start, window));
            return arch.dispatch(Sweep { layout, factor, direction, runs, own, separators });
        }
        let (here, there) = parts.split_at(parts.len() / 2);
        let (own, others) = windows.split_at_mut(here.len());
        let (before, after) = rows.split_before(there[0].own.rows.start);
        rayon::join(
            || self.sweep_parts(direction, here, own, before),
            || self.sweep_parts(direction, there, others, after),
        );
    }
}

/// Step of the solution.
#[derive(Clone, Copy)]
enum Direction {
    /// `D⁻¹ U⁻ᵀ`, by forward substitution.
    Forward,
    /// `U⁻¹`, by backward substitution.
    Backward,
    /// `D⁻¹`.
    Across,
}

/// Step of the solution for some runs, on their rows and on those of separators.
struct Sweep<'a> {
    layout: &'a BatchLayout,
    factor: &'a Factor,
    direction: Direction,
    runs: Range<usize>,
    own: Rows<'a>,
    separators: Rows<'a>,
}

impl WithSimd for Sweep<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, _: S) {
        match self.direction {
            Direction::Forward => self.forward(),
            Direction::Backward => self.backward(),
            Direction::Across => self.across(),
        }
    }
}

impl Sweep<'_> {
    #[inline(always)]
    fn forward(&mut self) {
        let Self { layout, factor, runs, own, separators, .. } = self;
        let Factor { upper, irregular, inverse_pivots, .. } = factor;
        for run in &layout.runs[runs.clone()] {
            let (inside, crossing) = layout.diagonals[run.diagonals.clone()].split_at(run.crossing);
            let starts = (run.start..run.end).step_by(LANES);
            for ((batch, row), pivot) in starts.enumerate().zip(&inverse_pivots[run.batches..]) {
                let here = own.load(row);
                let (upper, across) = upper[run.blocks_of(batch)].split_at(run.crossing);
                for (diagonal, block) in inside.iter().zip(upper) {
                    own.subtract_batch(diagonal.column(row), transposed_product(block, here));
                }
                for (diagonal, block) in crossing.iter().zip(across) {
                    let product = transposed_product(block, here);
                    separators.subtract_batch(diagonal.column(row), product);
                }
                let entries = layout.irregular_of[run.batches + batch].clone();
                let blocks = &irregular[entries.clone()];
                for (entry, block) in layout.irregular[entries].iter().zip(blocks) {
                    let column = entry.column as usize;
                    let product = transposed_product(block, own.at(row + entry.lane as usize));
                    if own.contains(column) {
                        own.subtract(column, product);
                    } else {
                        separators.subtract(column, product);
                    }
                }
                divide(pivot, own, row);
            }
        }
    }

    #[inline(always)]
    fn backward(&mut self) {
        let Self { layout, factor, runs, own, separators, .. } = self;
        let Factor { upper, irregular, .. } = factor;
        for run in layout.runs[runs.clone()].iter().rev() {
            let (inside, crossing) = layout.diagonals[run.diagonals.clone()].split_at(run.crossing);
            for (batch, row) in (run.start..run.end).step_by(LANES).enumerate() {
                let (upper, across) = upper[run.blocks_of(batch)].split_at(run.crossing);
                let mut sum = [Single::ZERO; 3];
                for (diagonal, block) in inside.iter().zip(upper) {
                    add(&mut sum, product(block, own.load(diagonal.column(row))));
                }
                for (diagonal, block) in crossing.iter().zip(across) {
                    add(&mut sum, product(block, separators.load(diagonal.column(row))));
                }
                own.subtract_batch(row, sum);
                let entries = layout.irregular_of[run.batches + batch].clone();
                let blocks = &irregular[entries.clone()];
                for (entry, block) in layout.irregular[entries].iter().zip(blocks) {
                    let column = entry.column as usize;
                    let rows = if own.contains(column) { &*own } else { &*separators };
                    let product = product(block, rows.at(column));
                    own.subtract(row + entry.lane as usize, product);
                }
            }
        }
    }

    #[inline(always)]
    fn across(&mut self) {
        for run in &self.layout.runs[self.runs.clone()] {
            let pivots = self.factor.inverse_pivots[run.batches..].iter();
            for (row, pivot) in (run.start..run.end).step_by(LANES).zip(pivots) {
                divide(pivot, &mut self.own, row);
            }
        }
    }
}

#[inline(always)]
fn add(sum: &mut [Single; 3], more: [Single; 3]) {
    for (sum, more) in sum.iter_mut().zip(more) {
        *sum = *sum + more;
    }
}

/// Applies inverse pivots, in double precision: stiff and soft directions may be far apart in them.
#[inline(always)]
fn divide(pivot: &SymmetricBlocks<Double>, rows: &mut Rows<'_>, row: usize) {
    rows.store(row, narrowed(&symmetric_product(pivot, widened(&rows.load(row)))));
}
