use nalgebra::Matrix3;

/// Which pairs of particles a cloth couples: the upper half of a symmetric matrix of 3 × 3 blocks.
///
/// Row `i` has the columns `columns[offsets[i]..offsets[i + 1]]` in rising order; the first is `i`
/// itself. Block `k` has the nine numbers `9k..9k + 9`, row by row.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Pattern {
    /// Where each row starts; one more than there are particles.
    pub offsets: Vec<usize>,
    /// Column of each block.
    pub columns: Vec<usize>,
}

/// Place of a pair's block, and whether the pair is named column first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Slot {
    block: u32,
    transposed: bool,
}

impl Slot {
    /// Adds a block whose rows belong to the first particle of the pair.
    pub(crate) fn add(self, values: &mut [f64], block: &Matrix3<f64>) {
        let start = 9 * self.block as usize;
        let place = &mut values[start..start + 9];
        if self.transposed {
            // nalgebra stores by column: its order is the transposed block by row.
            place
                .iter_mut()
                .zip(block.as_slice())
                .for_each(|(v, b)| *v += b);
        } else {
            for row in 0..3 {
                for column in 0..3 {
                    place[3 * row + column] += block[(row, column)];
                }
            }
        }
    }
}

impl Pattern {
    /// The pattern of all pairs within the given groups of particles.
    pub(crate) fn new<'a>(particles: usize, groups: impl Iterator<Item = &'a [u32]>) -> Self {
        let mut rows: Vec<Vec<usize>> = (0..particles).map(|i| vec![i]).collect();
        for group in groups {
            for &a in group {
                for &b in group {
                    if a < b {
                        rows[a as usize].push(b as usize);
                    }
                }
            }
        }
        let mut pattern = Self {
            offsets: vec![0],
            columns: Vec::new(),
        };
        for mut row in rows {
            row.sort_unstable();
            row.dedup();
            pattern.columns.extend(row);
            pattern.offsets.push(pattern.columns.len());
        }
        pattern
    }

    pub(crate) fn slot(&self, first: u32, second: u32) -> Slot {
        let (row, column) = (first.min(second) as usize, first.max(second) as usize);
        let columns = &self.columns[self.offsets[row]..self.offsets[row + 1]];
        let place = columns
            .binary_search(&column)
            .expect("every connector's particles were among the groups of the pattern");
        Slot {
            block: (self.offsets[row] + place) as u32,
            transposed: first > second,
        }
    }

    /// Number of blocks.
    #[must_use]
    pub fn blocks(&self) -> usize {
        self.columns.len()
    }
}
