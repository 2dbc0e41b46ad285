//! Sparsities of cloth, for tests.

use crate::linear::block::Block;
use crate::linear::block_matrix::BlockMatrix;
use crate::linear::level_schedule::layout::BatchLayout;
use crate::linear::level_schedule::partition::Partition;
use crate::linear::sparsity::Sparsity;

/// Returns the layout of `sparsity` in a number of `parts`.
pub(crate) fn layout(sparsity: &Sparsity, parts: usize) -> BatchLayout {
    BatchLayout::new(sparsity, &Partition::into_parts(sparsity, parts))
}

/// Returns the couplings of woven cloth of `n` by `n` particles: neighbours, second neighbours
/// along the yarns, and diagonals of the cells.
pub(crate) fn weave(n: usize) -> Sparsity {
    let steps = [(0, 1), (0, 2), (1, -1), (1, 0), (1, 1), (2, 0)];
    let cells = (0..n as i64).flat_map(|i| (0..n as i64).map(move |j| (i, j)));
    let inside =
        |&((_, _), (i, j)): &((i64, i64), (i64, i64))| i < n as i64 && (0..n as i64).contains(&j);
    let pairs = cells
        .flat_map(|(i, j)| steps.map(|(down, right)| ((i, j), (i + down, j + right))))
        .filter(inside)
        .map(|ends| <[_; 2]>::from(ends).map(|(i, j)| i as usize * n + j as usize));
    Sparsity::from_pairs(n * n, pairs).unwrap()
}

/// Returns the couplings of a square of `n` by `n` particles with a chain around it. The chain has
/// the last numbers, and each link is tied to the nearest particles of the square.
pub(crate) fn rimmed(n: usize) -> Sparsity {
    let inside = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
    let steps = [(0, 1), (1, 0), (1, 1)];
    let lattice = inside
        .flat_map(|(i, j)| steps.map(|(down, right)| ((i, j), (i + down, j + right))))
        .filter(|&(_, (i, j))| i < n && j < n)
        .map(|((i, j), (k, l))| [i * n + j, k * n + l]);

    let edge: Vec<usize> = (0..4)
        .flat_map(|side| {
            (0..n - 1).map(move |along| match side {
                0 => along,
                1 => along * n + n - 1,
                2 => n * n - 1 - along,
                _ => (n - 1 - along) * n,
            })
        })
        .collect();
    let first = n * n;
    let links = (0..edge.len()).flat_map(|k| {
        let next = (k + 1) % edge.len();
        [[first + k, first + next], [first + k, edge[k]], [first + k, edge[next]]]
    });
    Sparsity::from_pairs(first + edge.len(), lattice.chain(links)).unwrap()
}

/// Returns the stiffness of a spring along `[x, y, z]`.
pub(crate) fn spring([x, y, z]: [f64; 3]) -> Block {
    [x * x, x * y, x * z, x * y, y * y, y * z, x * z, y * z, z * z]
}

/// Returns the stiffness of springs between all coupled particles. `stiffness` returns the
/// stiffness of the spring with the given slot and particles.
pub(crate) fn springs(
    sparsity: Sparsity,
    stiffness: impl Fn(usize, [usize; 2]) -> Block,
) -> BlockMatrix {
    let mut matrix = BlockMatrix::zeros(sparsity.clone());
    for i in 0..sparsity.particle_count() {
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
