//! Lattices of cut panels.

use drape_cloth::{Grain, Lattice, Mesh};
use drape_pattern::Cut;

/// Returns the number of each node of `cut` in its lattice. Nodes of the grid come first, row by
/// row, then nodes of the outline.
pub(crate) fn node_numbers(cut: &Cut) -> Vec<u32> {
    let inner = cut.lattice.iter().flatten().count() as u32;
    let (mut grid, mut outline) = (0..inner, inner..);
    let number = |place: &Option<[u32; 2]>| match place {
        Some(_) => grid.next(),
        None => outline.next(),
    };
    cut.lattice.iter().map(number).map(Option::unwrap_or_default).collect()
}

/// Returns the lattice of a cut, with the numbers of its nodes and its grain.
pub(crate) fn cut_lattice(
    cut: &Cut,
    numbers: &[u32],
    grain: Grain,
) -> Result<Lattice, drape_cloth::Error> {
    let mut coordinates = vec![[0.0; 2]; numbers.len()];
    let mut grid = vec![None; numbers.len()];
    for (node, &number) in numbers.iter().enumerate() {
        coordinates[number as usize] = cut.yarns[node];
        grid[number as usize] = cut.lattice[node];
    }
    let mesh = Mesh {
        spacing: cut.spacing,
        coordinates,
        grid: grid.into_iter().flatten().collect(),
        cells: cut.quads.iter().map(|quad| quad.map(|node| numbers[node as usize])).collect(),
        triangles: cut.triangles.iter().map(|t| t.map(|node| numbers[node as usize])).collect(),
    };
    Lattice::from_mesh(mesh, grain)
}
