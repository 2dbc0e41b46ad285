//! Chunks: groups of consecutive runs with about equal numbers of rows. Threads process chunks side
//! by side.
//!
//! The result for a chunk depends on the chunk alone, and sums over chunks run in the order of the
//! chunks. The number of threads therefore changes no bit.

use crate::threads;
use core::ops::Range;

/// Consecutive runs with their rows, blocks and irregular entries.
#[derive(Clone, Debug)]
pub(crate) struct Chunk {
    pub index: usize,
    pub runs: Range<usize>,
    /// Rows of the runs. The first and the last chunk include the margins.
    pub rows: Range<usize>,
    /// Off-diagonal blocks.
    pub blocks: Range<usize>,
    pub irregular: Range<usize>,
    /// Range of the rows of this chunk and of the columns of its diagonals.
    pub window: Range<usize>,
    /// Irregular entries of other chunks whose columns are rows of this chunk, ascending.
    pub incoming: Vec<u32>,
}

/// Returns the other chunks whose diagonals lead to rows of the chunk `index`, with these rows.
pub(crate) fn leading_to(
    chunks: &[Chunk],
    index: usize,
) -> impl Iterator<Item = (&Chunk, Range<usize>)> {
    let rows = &chunks[index].rows;
    let others = chunks.iter().filter(move |other| other.index != index);
    others
        .map(|other| (other, rows.start.max(other.window.start)..rows.end.min(other.window.end)))
        .filter(|(_, shared)| !shared.is_empty())
}

/// Output of consecutive chunks. Each chunk writes a separate range of the output.
pub(crate) trait Split: Sized + Send {
    /// Splits the output into the output of the `first` chunks and the output of all later chunks.
    fn split(self, first: &[Chunk]) -> (Self, Self);
}

/// One value per chunk.
pub(crate) struct PerChunk<'a, T>(pub &'a mut [T]);

/// Columns of one number per row.
pub(crate) struct PerRow<'a, T, const N: usize>(pub [&'a mut [T]; N]);

impl<'a, T, const N: usize> PerRow<'a, T, N> {
    pub(crate) fn new(columns: &'a mut [Vec<T>; N]) -> Self {
        Self(columns.each_mut().map(|column| &mut column[..]))
    }
}

/// One value per off-diagonal block.
pub(crate) struct PerBlock<'a, T>(pub &'a mut [T]);

/// One value per irregular entry.
pub(crate) struct PerIrregularEntry<'a, T>(pub &'a mut [T]);

impl<T: Send> Split for PerChunk<'_, T> {
    fn split(self, first: &[Chunk]) -> (Self, Self) {
        let (output, later) = self.0.split_at_mut(first.len());
        (Self(output), Self(later))
    }
}

impl<T: Send, const N: usize> Split for PerRow<'_, T, N> {
    fn split(self, first: &[Chunk]) -> (Self, Self) {
        let rows = first.iter().map(|chunk| chunk.rows.len()).sum();
        let mut later = self.0;
        let output =
            core::array::from_fn(|axis| later[axis].split_off_mut(..rows).unwrap_or_default());
        (Self(output), Self(later))
    }
}

impl<T: Send> Split for PerBlock<'_, T> {
    fn split(self, first: &[Chunk]) -> (Self, Self) {
        let blocks = first.iter().map(|chunk| chunk.blocks.len()).sum();
        let (output, later) = self.0.split_at_mut(blocks);
        (Self(output), Self(later))
    }
}

impl<T: Send> Split for PerIrregularEntry<'_, T> {
    fn split(self, first: &[Chunk]) -> (Self, Self) {
        let entries = first.iter().map(|chunk| chunk.irregular.len()).sum();
        let (output, later) = self.0.split_at_mut(entries);
        (Self(output), Self(later))
    }
}

impl<A: Split, B: Split> Split for (A, B) {
    fn split(self, first: &[Chunk]) -> (Self, Self) {
        let (a, later_a) = self.0.split(first);
        let (b, later_b) = self.1.split(first);
        ((a, b), (later_a, later_b))
    }
}

impl<A: Split, B: Split, C: Split> Split for (A, B, C) {
    fn split(self, first: &[Chunk]) -> (Self, Self) {
        let (a, later_a) = self.0.split(first);
        let ((b, c), (later_b, later_c)) = (self.1, self.2).split(first);
        ((a, b, c), (later_a, later_b, later_c))
    }
}

/// Largest number of rows for one thread in operations that cost little per row. Dividing fewer
/// rows among threads takes longer than the operation.
pub(crate) const LIGHT: usize = 4_096;

/// Calls `work` for each of `chunks` with the chunk's range of `output`. Chunks with more than
/// `grain` rows together are divided among threads. Idle threads take chunks from busy ones.
pub(crate) fn for_each<O: Split>(
    chunks: &[Chunk],
    grain: usize,
    output: O,
    work: &(impl Fn(&Chunk, O) + Sync),
) {
    match chunks {
        [] => {}
        [chunk] => work(chunk, output),
        [first, .., last] => {
            let rows = last.rows.end - first.rows.start;
            let (early, late) = chunks.split_at(chunks.len().div_ceil(2));
            let (early_output, late_output) = output.split(early);
            if rows > grain {
                threads::join(
                    || for_each(early, grain, early_output, work),
                    || for_each(late, grain, late_output, work),
                );
            } else {
                for_each(early, grain, early_output, work);
                for_each(late, grain, late_output, work);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::level_schedule::layout::BatchLayout;
    use crate::linear::level_schedule::sample::{layout, rimmed, weave};

    #[test]
    fn chunks_cover_all_rows_blocks_and_entries_once_and_in_order() {
        let cases = [(weave(20), 1, 1), (weave(100), 1, 7), (rimmed(80), 1, 5), (weave(100), 3, 7)];
        for (sparsity, parts, expected) in cases {
            let layout = layout(&sparsity, parts);
            let chunks = &layout.chunks;
            assert!(chunks.len() >= expected, "{} chunks", chunks.len());
            let mut reached = [0; 4];
            for Chunk { rows, runs, blocks, irregular, .. } in chunks {
                assert_eq!([rows, runs, blocks, irregular].map(|range| range.start), reached);
                reached = [rows, runs, blocks, irregular].map(|range| range.end);
            }
            let BatchLayout { rows, runs, slots, irregular, .. } = &layout;
            assert_eq!(reached, [*rows, runs.len(), slots.len(), irregular.len()]);
        }
    }

    #[test]
    fn every_column_beyond_a_chunk_is_reached_by_its_diagonals_or_comes_in() {
        let layout = layout(&rimmed(80), 1);
        let incoming: usize = layout.chunks.iter().map(|chunk| chunk.incoming.len()).sum();
        let beyond = |chunk: &&Chunk, entry: usize| {
            !chunk.rows.contains(&(layout.irregular[entry].column as usize))
        };
        let expected = layout
            .chunks
            .iter()
            .map(|chunk| chunk.irregular.clone().filter(|&entry| beyond(&chunk, entry)).count());
        assert_eq!(incoming, expected.sum::<usize>());
        assert!(incoming > 0);
        let led = |chunk: &Chunk| leading_to(&layout.chunks, chunk.index).next().is_some();
        assert!(layout.chunks.iter().filter(|chunk| led(chunk)).count() > 3);
    }
}
