//! Entries of symmetric 3 × 3 blocks, whose upper half is kept.

/// Row and column of each entry of the upper half: xx, xy, xz, yy, yz, zz.
pub(crate) const HALF: [(usize, usize); 6] = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)];

/// Index in the upper half of each entry of a full block, row by row.
pub(crate) const IN_HALF: [usize; 9] = [0, 1, 2, 1, 3, 4, 2, 4, 5];

/// Index in the transpose of each entry of a full block, row by row.
pub(crate) const TRANSPOSED: [usize; 9] = [0, 3, 6, 1, 4, 7, 2, 5, 8];
