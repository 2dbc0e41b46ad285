//! Sparsities of cloth, for tests.

use crate::linear::block::Block;
use crate::linear::block_matrix::BlockMatrix;
use crate::linear::level_schedule::layout::BatchLayout;
use crate::linear::level_schedule::partition::Partition;
use crate::linear::sparsity::Sparsity;

/// Layout in a number of parts.
pub(crate) fn layout(sparsity: &Sparsity, parts: usize) -> BatchLayout {
    BatchLayout::new(sparsity, &Partition::into_parts(sparsity, parts))
}

/// Couplings of woven cloth: neighbours, those beyond them, and those across a cell.
pub(crate) fn weave(n: usize) -> Sparsity {
    let steps = [(0, 1), (0, 2), (1, -1), (1, 0), (1, 1), (2, 0)];
    let cells = (0..n as i64).flat_map(|i| (0..n as i64).map(move |j| (i, j)));
    let inside =
        |&((_, _), (i, j)): &((i64, i64), (i64, i64))| i < n as i64 && (0..n as i64).contains(&j);
    let number = |(i, j): (i64, i64)| i as usize * n + j as usize;
    let pairs = cells
        .flat_map(|(i, j)| steps.map(|(down, right)| ((i, j), (i + down, j + right))))
        .filter(inside)
        .map(|(a, b)| [number(a), number(b)]);
    Sparsity::from_pairs(n * n, pairs).unwrap()
}

/// A square of `n` by `n` with a chain around it, numbered last, each link tied to the nearest of
/// the square.
pub(crate) fn rimmed(n: usize) -> Sparsity {
    let inside = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
    let steps = [(0, 1), (1, 0), (1, 1)];
    let lattice = inside
        .flat_map(|(i, j)| steps.map(|(down, right)| ((i, j), (i + down, j + right))))
        .filter(|&(_, (i, j))| i < n && j < n)
        .map(|((i, j), (k, l))| [i * n + j, k * n + l]);
    let side = |k: usize| {
        (0..n - 1).map(move |along| match k {
            0 => along,
            1 => along * n + n - 1,
            2 => n * n - 1 - along,
            _ => (n - 1 - along) * n,
        })
    };
    let edge: Vec<usize> = (0..4).flat_map(side).collect();
    let first = n * n;
    let links = (0..edge.len()).flat_map(|k| {
        let next = (k + 1) % edge.len();
        [[first + k, first + next], [first + k, edge[k]], [first + k, edge[next]]]
    });
    Sparsity::from_pairs(first + edge.len(), lattice.chain(links)).unwrap()
}

/// Stiffness of a spring along a direction.
pub(crate) fn spring([x, y, z]: [f64; 3]) -> Block {
    [x * x, x * y, x * z, x * y, y * y, y * z, x * z, y * z, z * z]
}

/// Stiffness of springs between all particles that are coupled, and of nothing else. `stiffness` is
/// that of the spring of a slot and its two particles.
pub(crate) fn springs(
    sparsity: Sparsity,
    stiffness: impl Fn(usize, [usize; 2]) -> Block,
) -> BlockMatrix {
    let mut matrix = BlockMatrix::zeros(sparsity.clone());
    for i in 0..sparsity.particles() {
        for slot in sparsity.row(i).skip(1) {
            let j = sparsity.columns()[slot] as usize;
            let spring = stiffness(slot, [i, j]);
            matrix.add(i, i, &spring);
            matrix.add(j, j, &spring);
            matrix.add(i, j, &spring.map(|entry| -entry));
        }
    }
    matrix
}
