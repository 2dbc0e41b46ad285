use crate::field::{Vector, add, scale};

/// A 3 × 3 block, row by row.
pub(crate) type Block = [Vector; 3];

pub(crate) fn outer(a: Vector, b: Vector) -> Block {
    a.map(|a| b.map(|b| a * b))
}

pub(crate) fn one() -> Block {
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
}

/// Sum of blocks, each with a factor.
pub(crate) fn sum<const N: usize>(parts: [(f64, Block); N]) -> Block {
    let mut sum = [[0.0; 3]; 3];
    for (factor, block) in parts {
        for (row, part) in sum.iter_mut().zip(block) {
            *row = add(*row, scale(part, factor));
        }
    }
    sum
}

pub(crate) fn transposed(block: Block) -> Block {
    [0, 1, 2].map(|row| [block[0][row], block[1][row], block[2][row]])
}
