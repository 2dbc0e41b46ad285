//! Chunks: consecutive runs, about equally many rows each, that threads work on side by side.
//!
//! What is computed for a chunk depends on the chunk alone, and sums over chunks run in their
//! order, so the number of threads changes no bit.

use core::ops::Range;

/// Consecutive runs with their rows, blocks and irregular entries.
#[derive(Clone, Debug)]
pub(crate) struct Chunk {
    pub index: usize,
    pub runs: Range<usize>,
    /// Rows of the runs; of the first and the last chunk with the margins.
    pub rows: Range<usize>,
    /// Off-diagonal blocks.
    pub blocks: Range<usize>,
    pub irregular: Range<usize>,
    /// Rows that the diagonals lead to, its own among them.
    pub window: Range<usize>,
    /// Irregular entries of other chunks whose columns are rows of this one, ascending.
    pub incoming: Vec<u32>,
}

/// Other chunks whose diagonals lead to rows of a chunk, and these rows.
pub(crate) fn leading_to(
    chunks: &[Chunk],
    index: usize,
) -> impl Iterator<Item = (&Chunk, Range<usize>)> {
    let rows = &chunks[index].rows;
    let shared = |other: &Chunk| rows.start.max(other.window.start)..rows.end.min(other.window.end);
    let others = chunks.iter().filter(move |other| other.index != index);
    others.map(move |other| (other, shared(other))).filter(|(_, shared)| !shared.is_empty())
}

/// Output that consecutive chunks write, each its own part.
pub(crate) trait Split: Sized + Send {
    /// Splits the output of some chunks from that of the others, which follow them.
    fn split(self, here: &[Chunk]) -> (Self, Self);
}

/// One value per chunk.
pub(crate) struct PerChunk<'a, T>(pub &'a mut [T]);

/// Columns of one number per row.
pub(crate) struct PerRow<'a, T, const N: usize>(pub [&'a mut [T]; N]);

impl<'a, T, const N: usize> PerRow<'a, T, N> {
    pub(crate) fn of(columns: &'a mut [Vec<T>; N]) -> Self {
        Self(columns.each_mut().map(|column| &mut column[..]))
    }
}

/// One value per off-diagonal block.
pub(crate) struct PerBlock<'a, T>(pub &'a mut [T]);

/// One value per irregular entry.
pub(crate) struct PerIrregularEntry<'a, T>(pub &'a mut [T]);

impl<T: Send> Split for PerChunk<'_, T> {
    fn split(self, here: &[Chunk]) -> (Self, Self) {
        let (own, rest) = self.0.split_at_mut(here.len());
        (Self(own), Self(rest))
    }
}

impl<T: Send, const N: usize> Split for PerRow<'_, T, N> {
    fn split(self, here: &[Chunk]) -> (Self, Self) {
        let rows = here.iter().map(|chunk| chunk.rows.len()).sum();
        let mut rest = self.0;
        let own = core::array::from_fn(|axis| rest[axis].split_off_mut(..rows).unwrap_or_default());
        (Self(own), Self(rest))
    }
}

impl<T: Send> Split for PerBlock<'_, T> {
    fn split(self, here: &[Chunk]) -> (Self, Self) {
        let (own, rest) = self.0.split_at_mut(here.iter().map(|chunk| chunk.blocks.len()).sum());
        (Self(own), Self(rest))
    }
}

impl<T: Send> Split for PerIrregularEntry<'_, T> {
    fn split(self, here: &[Chunk]) -> (Self, Self) {
        let (own, rest) = self.0.split_at_mut(here.iter().map(|chunk| chunk.irregular.len()).sum());
        (Self(own), Self(rest))
    }
}

impl<A: Split, B: Split> Split for (A, B) {
    fn split(self, here: &[Chunk]) -> (Self, Self) {
        let (a, more_a) = self.0.split(here);
        let (b, more_b) = self.1.split(here);
        ((a, b), (more_a, more_b))
    }
}

impl<A: Split, B: Split, C: Split> Split for (A, B, C) {
    fn split(self, here: &[Chunk]) -> (Self, Self) {
        let (a, more_a) = self.0.split(here);
        let (rest, more) = (self.1, self.2).split(here);
        ((a, rest.0, rest.1), (more_a, more.0, more.1))
    }
}

/// Most rows that one thread works on where each costs little: handing over takes longer.
pub(crate) const LIGHT: usize = 4_096;

/// Works on chunks, each with its own part of the output, on several threads if they have more than
/// `grain` rows. Threads that have done their chunks take over others'.
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
            let (here, there) = chunks.split_at(chunks.len().div_ceil(2));
            let (own, rest) = output.split(here);
            let both = (|| for_each(here, grain, own, work), || for_each(there, grain, rest, work));
            if rows > grain {
                rayon::join(both.0, both.1);
            } else {
                both.0();
                both.1();
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
        assert_eq!(incoming, expected.sum());
        assert!(incoming > 0);
        let led = |chunk: &Chunk| leading_to(&layout.chunks, chunk.index).next().is_some();
        assert!(layout.chunks.iter().filter(|chunk| led(chunk)).count() > 3);
    }
}
