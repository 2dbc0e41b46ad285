//! Merging of vertices that are close to each other, and removal of triangles without area.

use std::collections::BTreeMap;

use crate::mesh_io::{Triangulation, doubled_area};
use crate::vector::{norm, subtract};

/// Merges vertices closer than a distance, in m, each with the first one near it, and returns the
/// number of those that were merged.
pub(crate) fn merge_vertices(mesh: &mut Triangulation, distance: f64) -> usize {
    let cell = distance.max(f64::MIN_POSITIVE);
    let key = |position: [f64; 3]| position.map(|value| (value / cell).floor() as i64);
    let mut kept: Vec<[f64; 3]> = Vec::new();
    let mut at: BTreeMap<[i64; 3], Vec<u32>> = BTreeMap::new();
    let mut numbers = Vec::with_capacity(mesh.vertices.len());
    for &position in &mesh.vertices {
        let [x, y, z] = key(position);
        let around =
            (-1..=1).flat_map(|i| (-1..=1).flat_map(move |j| (-1..=1).map(move |k| [i, j, k])));
        let near = around
            .filter_map(|[i, j, k]| {
                at.get(&[x.saturating_add(i), y.saturating_add(j), z.saturating_add(k)])
            })
            .flatten()
            .copied()
            .filter(|&other| norm(subtract(kept[other as usize], position)) <= distance)
            .min();
        numbers.push(near.unwrap_or_else(|| {
            kept.push(position);
            at.entry([x, y, z]).or_default().push(kept.len() as u32 - 1);
            kept.len() as u32 - 1
        }));
    }
    let merged = mesh.vertices.len() - kept.len();
    mesh.vertices = kept;
    let count = numbers.len() as u32;
    mesh.triangles.retain(|triangle| triangle.iter().all(|vertex| *vertex < count));
    for vertex in mesh.triangles.iter_mut().flatten() {
        *vertex = numbers[*vertex as usize];
    }
    merged
}

/// Removes triangles that have lost a corner, that have no area, or that are there twice, and
/// returns their number.
pub(crate) fn drop_degenerate(mesh: &mut Triangulation) -> usize {
    let before = mesh.triangles.len();
    let point = |vertex: u32| mesh.vertices[vertex as usize];
    let has_area = |&[a, b, c]: &[u32; 3]| {
        a != b && b != c && c != a && doubled_area([a, b, c].map(point)).is_ok()
    };
    let mut seen = std::collections::BTreeSet::new();
    let mut triangles = std::mem::take(&mut mesh.triangles);
    triangles.retain(|triangle| {
        let mut key = *triangle;
        key.sort_unstable();
        has_area(triangle) && seen.insert(key)
    });
    mesh.triangles = triangles;
    before - mesh.triangles.len()
}

/// Removes the vertices that no triangle names.
pub(crate) fn drop_unused(mesh: &mut Triangulation) {
    let mut numbers: Vec<Option<u32>> = vec![None; mesh.vertices.len()];
    let mut kept = Vec::new();
    for vertex in mesh.triangles.iter_mut().flatten() {
        let old = *vertex as usize;
        *vertex = *numbers[old].get_or_insert_with(|| {
            kept.push(mesh.vertices[old]);
            kept.len() as u32 - 1
        });
    }
    mesh.vertices = kept;
}
