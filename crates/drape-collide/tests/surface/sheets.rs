//! Meshes that the tests fraction.

use crate::support::Dice;
use drape_collide::{ContactDistances, Surface, SurfaceParts};

pub const DISTANCES: ContactDistances =
    ContactDistances { activation_distance: 3e-4, min_separation: 5e-5 };

/// Parts of sheets of `side` × `side` vertices at a spacing, one group each, alike at rest.
pub fn sheets(layers: usize, side: usize, spacing: f64) -> SurfaceParts {
    let mut parts = SurfaceParts {
        rest_positions: Vec::new(),
        triangles: Vec::new(),
        areas: vec![spacing * spacing; layers * side * side],
        groups: Vec::new(),
        distances: vec![DISTANCES; layers],
        free_vertices: layers * side * side,
        seam_pairs: Vec::new(),
        ties: Vec::new(),
    };
    for layer in 0..layers {
        let first = (layer * side * side) as u32;
        for row in 0..side {
            for column in 0..side {
                parts.rest_positions.extend([column as f64 * spacing, row as f64 * spacing, 0.0]);
                parts.groups.push(layer as u32);
            }
        }
        for row in 0..side - 1 {
            for column in 0..side - 1 {
                let a = first + (row * side + column) as u32;
                let (b, c, d) = (a + 1, a + side as u32 + 1, a + side as u32);
                // The diagonals alternate like the squares of a chessboard.
                let halves = if (row + column) % 2 == 0 {
                    [[a, b, c], [a, c, d]]
                } else {
                    [[a, b, d], [b, c, d]]
                };
                parts.triangles.extend(halves);
            }
        }
    }
    parts
}

/// Separate triangles of random shape and place, every fifth of them a body.
pub fn soup(dice: &mut Dice, triangles: usize, size: f64) -> SurfaceParts {
    let bodies = triangles / 5;
    let free = 3 * (triangles - bodies);
    let mut rest = Vec::new();
    for _ in 0..triangles {
        let place = dice.point(1.0);
        for _ in 0..3 {
            let corner = dice.point(size);
            rest.extend((0..3).map(|k| place[k] + corner[k]));
        }
    }
    SurfaceParts {
        rest_positions: rest,
        triangles: (0..triangles as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect(),
        areas: vec![1e-4; 3 * triangles],
        groups: (0..3 * triangles).map(|v| u32::from(v >= free)).collect(),
        distances: vec![DISTANCES; 2],
        free_vertices: free,
        seam_pairs: Vec::new(),
        ties: Vec::new(),
    }
}

pub fn surface(parts: &SurfaceParts) -> Surface {
    Surface::new(parts.clone()).unwrap()
}
