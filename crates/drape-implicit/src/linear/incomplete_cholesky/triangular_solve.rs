//! Triangular solves with a finished factor, part by part.
//!
//! Parts are coupled by separators alone. So they are solved for side by side, down to the separators
//! and up again:
//!
//! 1. each part by forward substitution, with what it takes off the separators in a vector of its own;
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
    /// Vectors of the parts; none where there is one part.
    windows: Vec<Window>,
}

/// Vector of a part: the rows of its window.
#[derive(Debug)]
struct Window {
    first: usize,
    image: Columns<f32>,
}

impl Window {
    fn new(part: &Part) -> Self {
        Self { first: part.window.start, image: Columns::new(part.window.len()) }
    }

    fn local(&self, rows: &Range<usize>) -> Range<usize> {
        rows.start - self.first..rows.end - self.first
    }

    fn clear(&mut self, rows: &Range<usize>) {
        let local = self.local(rows);
        self.image.0.iter_mut().for_each(|column| column[local.clone()].fill(0.0));
    }

    /// Adds rows to those of a vector.
    fn add_to(&self, image: &mut Columns<f32>, rows: &Range<usize>) {
        let local = self.local(rows);
        for (column, own) in image.0.iter_mut().zip(&self.image.0) {
            let sums = column[rows.clone()].iter_mut();
            sums.zip(&own[local.clone()]).for_each(|(sum, own)| *sum += own);
        }
    }

    /// Copies rows of a vector.
    fn copy(&mut self, image: &Columns<f32>, rows: &Range<usize>) {
        let local = self.local(rows);
        for (own, column) in self.image.0.iter_mut().zip(&image.0) {
            own[local.clone()].copy_from_slice(&column[rows.clone()]);
        }
    }
}

impl TriangularSolve {
    pub(crate) fn new(layout: &BatchLayout) -> Self {
        let several = layout.parts.len() > 1;
        Self { windows: layout.parts.iter().filter(|_| several).map(Window::new).collect() }
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
        if factor.is_diagonal {
            return solver.sweep(Direction::Across, 0..layout.runs.len(), image);
        }
        if self.windows.is_empty() {
            for part in &layout.parts {
                solver.sweep(Direction::Forward, part.own.runs.clone(), image);
                solver.sweep(Direction::Backward, part.own.runs.clone(), image);
            }
            return;
        }
        solver.solve_forward(&layout.parts, &mut self.windows, image);
        for (window, part) in self.windows.iter().zip(&layout.parts) {
            part.separators.iter().for_each(|rows| window.add_to(image, rows));
        }
        for separator in &layout.separators {
            solver.sweep(Direction::Forward, separator.runs.clone(), image);
        }
        for separator in layout.separators.iter().rev() {
            solver.sweep(Direction::Backward, separator.runs.clone(), image);
        }
        for (window, part) in self.windows.iter_mut().zip(&layout.parts) {
            part.separators.iter().for_each(|rows| window.copy(image, rows));
        }
        let rows = image.0.each_mut().map(|column| &mut column[..]);
        let solution = Rows { first: 0, rows };
        solver.solve_backward(&layout.parts, &mut self.windows, solution);
    }
}

/// Factor that the parts are solved with.
#[derive(Clone, Copy)]
struct Solver<'a> {
    arch: Arch,
    layout: &'a BatchLayout,
    factor: &'a Factor,
}

/// Consecutive rows of a vector.
struct Rows<'a> {
    first: usize,
    rows: [&'a mut [f32]; 3],
}

impl Rows<'_> {
    /// Splits the rows before a row from the others.
    fn split_before(mut self, row: usize) -> (Self, Self) {
        let count = row - self.first;
        let rows = self.rows.each_mut().map(|rows| rows.split_off_mut(..count).unwrap_or_default());
        (Self { first: self.first, rows }, Self { first: row, rows: self.rows })
    }
}

impl Solver<'_> {
    /// Takes a step of the solution for some runs, on all rows.
    fn sweep(self, direction: Direction, runs: Range<usize>, image: &mut Columns<f32>) {
        let Self { arch, layout, factor } = self;
        arch.dispatch(Sweep { layout, factor, direction, runs, first: 0, image });
    }

    /// Takes a step of the solution for a part, on the rows of its window.
    fn sweep_part(self, direction: Direction, part: &Part, window: &mut Window) {
        let Self { arch, layout, factor } = self;
        let (runs, first, image) = (part.own.runs.clone(), window.first, &mut window.image);
        arch.dispatch(Sweep { layout, factor, direction, runs, first, image });
    }

    /// Solves for parts by forward substitution, side by side.
    fn solve_forward(self, parts: &[Part], windows: &mut [Window], image: &Columns<f32>) {
        if let ([part], [window]) = (parts, &mut *windows) {
            window.copy(image, &part.own.rows);
            part.separators.iter().for_each(|rows| window.clear(rows));
            return self.sweep_part(Direction::Forward, part, window);
        }
        let (here, there) = parts.split_at(parts.len() / 2);
        let (own, others) = windows.split_at_mut(here.len());
        rayon::join(
            || self.solve_forward(here, own, image),
            || self.solve_forward(there, others, image),
        );
    }

    /// Solves for parts by backward substitution, side by side, and writes their rows.
    fn solve_backward(self, parts: &[Part], windows: &mut [Window], solution: Rows<'_>) {
        if let ([part], [window]) = (parts, &mut *windows) {
            self.sweep_part(Direction::Backward, part, window);
            let (_, mut own) = solution.split_before(part.own.rows.start);
            let solved = window.local(&part.own.rows);
            for (rows, column) in own.rows.iter_mut().zip(&window.image.0) {
                rows[..solved.len()].copy_from_slice(&column[solved.clone()]);
            }
            return;
        }
        let (here, there) = parts.split_at(parts.len() / 2);
        let (own, others) = windows.split_at_mut(here.len());
        let (before, after) = solution.split_before(there[0].own.rows.start);
        rayon::join(
            || self.solve_backward(here, own, before),
            || self.solve_backward(there, others, after),
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

/// Step of the solution for some runs, on a vector that begins with a row.
struct Sweep<'a> {
    layout: &'a BatchLayout,
    factor: &'a Factor,
    direction: Direction,
    runs: Range<usize>,
    first: usize,
    image: &'a mut Columns<f32>,
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
        let Self { layout, factor, runs, first, image, .. } = self;
        let Factor { upper, irregular, inverse_pivots, .. } = factor;
        for run in &layout.runs[runs.clone()] {
            let diagonals = &layout.diagonals[run.diagonals.clone()];
            let starts = (run.start..run.end).step_by(LANES);
            for ((batch, row), pivot) in starts.enumerate().zip(&inverse_pivots[run.batches..]) {
                let row = row - *first;
                let here = image.load(row);
                let blocks = &upper[run.blocks_of(batch)];
                for (diagonal, block) in diagonals.iter().zip(blocks) {
                    let column = diagonal.column(row);
                    let [x, y, z] = image.load(column);
                    let [a, b, c] = transposed_product(block, here);
                    image.store(column, [x - a, y - b, z - c]);
                }
                let own = layout.irregular_of[run.batches + batch].clone();
                for (entry, block) in layout.irregular[own.clone()].iter().zip(&irregular[own]) {
                    let here = image.at(row + entry.lane as usize);
                    let column = entry.column as usize - *first;
                    image.subtract(column, transposed_product(block, here));
                }
                divide(pivot, image, row);
            }
        }
    }

    #[inline(always)]
    fn backward(&mut self) {
        let Self { layout, factor, runs, first, image, .. } = self;
        let Factor { upper, irregular, .. } = factor;
        for run in layout.runs[runs.clone()].iter().rev() {
            let diagonals = &layout.diagonals[run.diagonals.clone()];
            for (batch, row) in (run.start..run.end).step_by(LANES).enumerate() {
                let row = row - *first;
                let blocks = &upper[run.blocks_of(batch)];
                let mut sum = [Single::ZERO; 3];
                for (diagonal, block) in diagonals.iter().zip(blocks) {
                    let more = product(block, image.load(diagonal.column(row)));
                    for (sum, more) in sum.iter_mut().zip(more) {
                        *sum = *sum + more;
                    }
                }
                let [x, y, z] = image.load(row);
                image.store(row, [x - sum[0], y - sum[1], z - sum[2]]);
                let own = layout.irregular_of[run.batches + batch].clone();
                for (entry, block) in layout.irregular[own.clone()].iter().zip(&irregular[own]) {
                    let there = image.at(entry.column as usize - *first);
                    image.subtract(row + entry.lane as usize, product(block, there));
                }
            }
        }
    }

    #[inline(always)]
    fn across(&mut self) {
        for run in &self.layout.runs[self.runs.clone()] {
            let pivots = self.factor.inverse_pivots[run.batches..].iter();
            for (row, pivot) in (run.start..run.end).step_by(LANES).zip(pivots) {
                divide(pivot, self.image, row - self.first);
            }
        }
    }
}

/// Applies inverse pivots, in double precision: stiff and soft directions may be far apart in them.
#[inline(always)]
fn divide(pivot: &SymmetricBlocks<Double>, image: &mut Columns<f32>, row: usize) {
    image.store(row, narrowed(&symmetric_product(pivot, widened(&image.load(row)))));
}
