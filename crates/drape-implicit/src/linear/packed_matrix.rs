//! Matrix laid out for vector instructions, in the order of elimination.

use pulp::{Arch, Simd, WithSimd};

use crate::linear::block::{self, Block};
use crate::linear::block_matrix::{BlockMatrix, Coupling};
use crate::linear::lane_block::{
    self, Blocks, SymmetricBlocks, symmetric_part, symmetric_product, transposed_product,
};
use crate::linear::lanes::{Columns, Double, LANES, Single, widened};
use crate::linear::level_schedule::chunk::{
    self, Chunk, LIGHT, PerBlock, PerChunk, PerIrregularEntry, PerRow,
};
use crate::linear::level_schedule::later_blocks::BlockSlot;
use crate::linear::level_schedule::layout::BatchLayout;
use crate::linear::level_schedule::partial_sum::{
    PartialProduct, PartialSum, add_from_other_chunks,
};
use crate::linear::level_schedule::row_order::ABSENT;
use crate::linear::level_schedule::run::IrregularEntry;
use crate::linear::vector::dot;

/// Indices of the upper half of a row-major block.
const UPPER_HALF: [usize; 6] = [0, 1, 2, 4, 5, 8];

/// Diagonal block of a row without a particle.
const IDENTITY: Block = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];

/// Blocks of a matrix in batches.
///
/// The off-diagonal blocks are in single precision, because memory access limits the speed of a
/// product. The symmetric part of a row's rounding errors is added to the main diagonal of the row.
/// Without this correction the soft motions of a stiff system, above all translations, would meet a
/// spurious stiffness. The antisymmetric part of the rounding errors and their moments remain.
/// These are as large as the rounding errors of the forces.
#[derive(Debug)]
pub(crate) struct PackedMatrix {
    /// Off-diagonal blocks by run, batch and diagonal.
    pub off_diagonal: Vec<Blocks<Single>>,
    /// Blocks of the irregular entries.
    pub irregular: Vec<Blocks<f32>>,
    /// Upper halves of the main diagonal, by row. Rows without a particle have the identity.
    main_diagonal: [Vec<f64>; 6],
    /// Contribution of each chunk to the main diagonal.
    parts: Vec<PartialSum<6>>,
    /// Blocks outside the sparsity, with rows of the layout in place of particles.
    couplings: Vec<Coupling>,
}

impl PackedMatrix {
    /// Allocates a matrix of zeros for `layout`.
    pub(crate) fn new(layout: &BatchLayout) -> Self {
        Self {
            off_diagonal: vec![[Single::ZERO; 9]; layout.slots.len()],
            irregular: vec![[0.0; 9]; layout.irregular.len()],
            main_diagonal: core::array::from_fn(|_| vec![0.0; layout.rows]),
            parts: layout.chunks.iter().map(PartialSum::new).collect(),
            couplings: Vec::new(),
        }
    }

    /// Copies `matrix`, which has the sparsity of `layout`.
    pub(crate) fn pack(&mut self, arch: Arch, layout: &BatchLayout, matrix: &BlockMatrix) {
        self.couplings.clear();
        self.couplings.extend(matrix.couplings().iter().map(|coupling| Coupling {
            row: layout.order.row_of[coupling.row as usize],
            column: layout.order.row_of[coupling.column as usize],
            ..*coupling
        }));

        // Each chunk packs its blocks, and sums the diagonal entries of its window.
        let (off_diagonal, irregular) = (&mut self.off_diagonal, &mut self.irregular);
        chunk::for_each(
            &layout.chunks,
            0,
            (PerBlock(off_diagonal), PerIrregularEntry(irregular), PerChunk(&mut self.parts)),
            &|chunk, (PerBlock(off_diagonal), PerIrregularEntry(irregular), PerChunk(parts))| {
                let main_diagonal = &mut parts[0];
                let packed = PackedChunk { off_diagonal, irregular, main_diagonal };
                arch.dispatch(Pack { layout, chunk, blocks: matrix.blocks(), packed });
            },
        );

        // Each chunk collects the diagonal entries of its rows from all chunks in a fixed order.
        let (irregular, parts) = (&self.irregular, &self.parts);
        chunk::for_each(&layout.chunks, LIGHT, PerRow::new(&mut self.main_diagonal), &|chunk,
                                                                                       PerRow(
            mut rows,
        )| {
            let first = chunk.rows.start;
            for (column, part) in rows.iter_mut().zip(&parts[chunk.index].0) {
                column.copy_from_slice(&part[first - chunk.window.start..][..column.len()]);
            }
            add_from_other_chunks(&mut rows, 1.0, (&layout.chunks, chunk), |source| {
                &parts[source.index]
            });
            for &entry in &chunk.incoming {
                let IrregularEntry { column, slot, .. } = layout.irregular[entry as usize];
                let short = &irregular[entry as usize];
                let lost = rounding(&slot.copy(matrix.blocks()), short);
                for (rows, lost) in rows.iter_mut().zip(lost) {
                    rows[column as usize - first] += lost;
                }
            }
        });
    }

    /// Returns the blocks on the main diagonal of the batch that begins at `row`.
    #[inline(always)]
    pub(crate) fn main_diagonal(&self, row: usize) -> SymmetricBlocks<Double> {
        let mut main = [Double::ZERO; 6];
        for (main, column) in main.iter_mut().zip(&self.main_diagonal) {
            *main = Double::load(column, row);
        }
        main
    }

    /// Writes the `products` of all chunks with `x`, which has zeros in the rows without a
    /// particle. Returns `xᵀA x`.
    pub(crate) fn multiply(
        &self,
        arch: Arch,
        layout: &BatchLayout,
        x: &Columns<f64>,
        products: &mut [PartialProduct],
    ) -> f64 {
        chunk::for_each(
            &layout.chunks,
            0,
            PerChunk(&mut *products),
            &|chunk, PerChunk(product)| {
                arch.dispatch(Multiply {
                    layout,
                    matrix: self,
                    chunk,
                    x,
                    product: &mut product[0],
                });
            },
        );
        let mut curvature = products.iter().map(|product| product.curvature).sum();
        for Coupling { row, column, block } in &self.couplings {
            let [row, column] = [*row as usize, *column as usize];
            let (mut row_product, mut column_product) = ([0.0; 3], [0.0; 3]);
            block::add_product(block, &x.at(column), &mut row_product);
            block::add_transposed_product(block, &x.at(row), &mut column_product);
            curvature += 2.0 * dot(&row_product, &x.at(row));
            for (row, numbers) in [(row, row_product), (column, column_product)] {
                let chunk = &layout.chunks[layout.chunk_of(row)];
                products[chunk.index].rows.add(row - chunk.window.start, numbers);
            }
        }
        curvature
    }
}

/// Entries of a packed matrix that one chunk writes.
struct PackedChunk<'a> {
    off_diagonal: &'a mut [Blocks<Single>],
    irregular: &'a mut [Blocks<f32>],
    main_diagonal: &'a mut PartialSum<6>,
}

/// Copies the blocks of a chunk.
struct Pack<'a> {
    layout: &'a BatchLayout,
    chunk: &'a Chunk,
    blocks: &'a [Block],
    packed: PackedChunk<'a>,
}

impl WithSimd for Pack<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { layout, chunk, blocks, packed } = self;
        let PackedChunk { off_diagonal, irregular, main_diagonal } = packed;
        let first = chunk.window.start;
        main_diagonal.clear();

        for run in &layout.runs[chunk.runs.clone()] {
            let diagonals = &layout.diagonals[run.diagonals.clone()];
            for (batch, row) in (run.start..run.end).step_by(LANES).enumerate() {
                let slots = &layout.main_slots[run.batches + batch];
                let mut main = [Double::ZERO; 6];
                for (main, index) in main.iter_mut().zip(UPPER_HALF) {
                    for (entry, &slot) in main.0.iter_mut().zip(slots) {
                        *entry = main_block(blocks, slot)[index];
                    }
                }
                main_diagonal.add_batch(row - first, main);

                // A rounding error of a block concerns the sums of its row and of its column.
                let range = run.blocks_of(batch);
                let slots = &layout.slots[range.clone()];
                let range = range.start - chunk.blocks.start..range.end - chunk.blocks.start;
                let packed = &mut off_diagonal[range];
                for ((diagonal, slots), packed) in diagonals.iter().zip(slots).zip(packed) {
                    let block = gather(blocks, slots);
                    let lost = round(&block, packed);
                    main_diagonal.add_batch(row - first, lost);
                    main_diagonal.add_batch(diagonal.column(row) - first, lost);
                }

                for index in layout.irregular_of[run.batches + batch].clone() {
                    let IrregularEntry { lane, column, slot } = layout.irregular[index];
                    let block = slot.copy(blocks);
                    let short = &mut irregular[index - chunk.irregular.start];
                    for (short, value) in short.iter_mut().zip(&block) {
                        *short = *value as f32;
                    }
                    let lost = rounding(&block, short);
                    main_diagonal.add(row - first + lane as usize, lost);
                    if chunk.rows.contains(&(column as usize)) {
                        main_diagonal.add(column as usize - first, lost);
                    }
                }
            }
        }
    }
}

/// Multiplies the blocks of a chunk with a vector.
struct Multiply<'a> {
    layout: &'a BatchLayout,
    matrix: &'a PackedMatrix,
    chunk: &'a Chunk,
    x: &'a Columns<f64>,
    product: &'a mut PartialProduct,
}

impl WithSimd for Multiply<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { layout, matrix, chunk, x, product } = self;
        let PartialProduct { rows, pushes, curvature } = product;
        let first = chunk.window.start;
        rows.clear();
        *curvature = 0.0;

        for run in &layout.runs[chunk.runs.clone()] {
            let diagonals = &layout.diagonals[run.diagonals.clone()];
            for (batch, row) in (run.start..run.end).step_by(LANES).enumerate() {
                let x_of_rows = x.load(row);
                let mut sum = symmetric_product(&matrix.main_diagonal(row), x_of_rows);
                let blocks = &matrix.off_diagonal[run.blocks_of(batch)];
                for (diagonal, block) in diagonals.iter().zip(blocks) {
                    let column = diagonal.column(row);
                    let wide = widened(block);
                    let product = lane_block::product(&wide, x.load(column));
                    for (sum, product) in sum.iter_mut().zip(product) {
                        *sum = *sum + product;
                    }
                    rows.add_batch(column - first, transposed_product(&wide, x_of_rows));
                }
                rows.add_batch(row - first, sum);

                // The column of an irregular entry may lie outside the window: its chunk adds the
                // push later.
                for index in layout.irregular_of[run.batches + batch].clone() {
                    let IrregularEntry { lane, column, .. } = layout.irregular[index];
                    let mut wide = block::ZERO;
                    for (wide, entry) in wide.iter_mut().zip(&matrix.irregular[index]) {
                        *wide = (*entry).into();
                    }
                    let (row, column) = (row + lane as usize, column as usize);
                    rows.add(row - first, lane_block::product(&wide, x.at(column)));
                    let push = transposed_product(&wide, x.at(row));
                    if chunk.rows.contains(&column) {
                        rows.add(column - first, push);
                    } else {
                        pushes[index - chunk.irregular.start] = push;
                        *curvature += dot(&push, &x.at(column));
                    }
                }
            }
        }

        for (x, sums) in x.0.iter().zip(&rows.0) {
            *curvature += dot(&x[chunk.window.clone()], sums);
        }
    }
}

/// Returns the blocks of a batch on a diagonal, one per lane, from their `slots`.
#[inline(always)]
fn gather(blocks: &[Block], slots: &[BlockSlot; LANES]) -> Blocks<Double> {
    let mut gathered = [Double::ZERO; 9];
    for (lane, slot) in slots.iter().enumerate() {
        for (entry, value) in gathered.iter_mut().zip(slot.stored(blocks, &block::ZERO)) {
            entry.0[lane] = *value;
        }
    }

    // Lanes of transposed blocks exchange their entries across the diagonal.
    for (lane, slot) in slots.iter().enumerate() {
        if slot.is_transposed() {
            for [a, b] in [[1, 3], [2, 6], [5, 7]] {
                let entry = gathered[a].0[lane];
                gathered[a].0[lane] = gathered[b].0[lane];
                gathered[b].0[lane] = entry;
            }
        }
    }
    gathered
}

/// Returns the symmetric part of `block` less its copy `short` in single precision.
#[inline(always)]
fn rounding(block: &Block, short: &Blocks<f32>) -> [f64; 6] {
    let mut lost = block::ZERO;
    for ((lost, short), value) in lost.iter_mut().zip(short).zip(block) {
        *lost = *value - f64::from(*short);
    }
    symmetric_part(&lost)
}

/// Writes `block` in single precision into `short`. Returns the symmetric part of the rounding
/// errors.
#[inline(always)]
fn round(block: &Blocks<Double>, short: &mut Blocks<Single>) -> SymmetricBlocks<Double> {
    let mut lost = [Double::ZERO; 9];
    for ((lost, short), value) in lost.iter_mut().zip(short).zip(block) {
        *short = value.narrow();
        *lost = *value - short.widen();
    }
    symmetric_part(&lost)
}

/// Returns the block of `slot` on the main diagonal, the identity for a row without a particle.
#[inline(always)]
fn main_block(blocks: &[Block], slot: u32) -> &Block {
    if slot == ABSENT { &IDENTITY } else { &blocks[slot as usize] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::level_schedule::sample::{layout, rimmed, spring, springs};
    use crate::linear::vector::add_scaled;

    /// Springs between the points of a lattice with a chain around it, with numbers that single
    /// precision has to round, and no springs to anything else.
    fn lattice(n: usize) -> BlockMatrix {
        let number = |slot: usize, phase: f64| (slot as f64 + phase).sin();
        springs(rimmed(n), |slot, _| spring([0.1, 0.2, 0.3].map(|phase| number(slot, phase))))
    }

    struct Product {
        numbers: Vec<f64>,
        curvature: f64,
    }

    fn multiply(matrix: &BlockMatrix, parts: usize, x: impl Fn(usize) -> f64) -> Product {
        let layout = layout(matrix.sparsity(), parts);
        let mut packed = PackedMatrix::new(&layout);
        packed.pack(Arch::new(), &layout, matrix);
        let mut columns = Columns::new(layout.rows);
        let entries =
            || (0..3 * layout.order.row_of.len()).map(|k| (k, layout.order.row_of[k / 3] as usize));
        for (k, row) in entries() {
            columns.0[k % 3][row] = x(k);
        }
        let mut products: Vec<_> = layout.chunks.iter().map(PartialProduct::new).collect();
        let curvature = packed.multiply(Arch::new(), &layout, &columns, &mut products);
        let mut sum = Columns::new(layout.rows);
        for (chunk, product) in layout.chunks.iter().zip(&products) {
            for (sum, part) in sum.0.iter_mut().zip(&product.rows.0) {
                add_scaled(&mut sum[chunk.window.start..], 1.0, part);
            }
            for &entry in &chunk.incoming {
                let source = &layout.chunks[layout.chunk_of_entry(entry as usize)];
                let push = products[source.index].pushes[entry as usize - source.irregular.start];
                let row = layout.irregular[entry as usize].column as usize;
                sum.0.iter_mut().zip(push).for_each(|(sum, push)| sum[row] += push);
            }
        }
        Product { numbers: entries().map(|(k, row)| sum.0[k % 3][row]).collect(), curvature }
    }

    #[test]
    fn the_product_is_the_matrixs_own_to_single_precision() {
        for (n, coupled, parts) in [(13, 0, 1), (70, 0, 1), (70, 40, 1), (13, 0, 2), (70, 40, 3)] {
            let mut matrix = lattice(n);
            let last = matrix.sparsity().particle_count() - 1;
            for k in 0..coupled {
                let block = core::array::from_fn(|entry| ((9 * k + entry) as f64).cos());
                matrix.add_coupling(100 * k + 1, last - 77 * k, &block);
            }
            assert_eq!(matrix.couplings().len(), coupled);
            let x: Vec<f64> = (0..3 * (last + 1)).map(|k| (k as f64).cos()).collect();
            let mut exact = vec![0.0; x.len()];
            matrix.write_product(&x, &mut exact);
            let Product { numbers, curvature } = multiply(&matrix, parts, |k| x[k]);
            for (k, (product, exact)) in numbers.into_iter().zip(&exact).enumerate() {
                assert!((product - exact).abs() < 1e-6, "entry {k}: {product}, {exact}");
            }
            let exact = dot(&x, &exact);
            assert!((curvature - exact).abs() < 1e-7 * exact.abs(), "{curvature} for {exact}");
        }
    }

    #[test]
    fn rounding_gives_a_translation_no_stiffness() {
        // Rounding alone leaves 6e-8 per entry.
        let largest = |product: Product| -> f64 {
            product.numbers.into_iter().fold(0.0, |a: f64, b| a.max(b.abs()))
        };
        let cases = [(13, 1), (70, 1), (70, 4)];
        for ((n, parts), axis) in
            cases.into_iter().flat_map(|case| [0, 1, 2].map(|axis| (case, axis)))
        {
            let unit = |k: usize| if k % 3 == axis { 1.0 } else { 0.0 };
            let push = largest(multiply(&lattice(n), parts, unit));
            assert!(push < 1e-14, "axis {axis} of {n} in {parts} parts: {push:e}");
        }
    }
}
