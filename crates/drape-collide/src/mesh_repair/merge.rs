//! Merging of vertices that coincide or nearly do, and removal of triangles without area.

use std::collections::{BTreeMap, BTreeSet};

use crate::mesh_io::{Triangulation, doubled_area};
use crate::vector::{norm, subtract};

use super::edges::Edges;

/// Merges vertices of `mesh` at exactly one position, and returns their number.
///
/// Triangles that lose a corner by merging, or that name a vertex that does not exist, are left
/// out.
pub(crate) fn merge_coincident(mesh: &mut Triangulation) -> usize {
    let mut at: BTreeMap<[u64; 3], u32> = BTreeMap::new();
    let mut kept = Vec::new();
    let mut numbers = Vec::with_capacity(mesh.vertices.len());
    for &position in &mesh.vertices {
        // Adding zero makes -0 the same position as 0.
        let key = position.map(|value| (value + 0.0).to_bits());
        numbers.push(*at.entry(key).or_insert_with(|| {
            kept.push(position);
            kept.len() as u32 - 1
        }));
    }
    renumber(mesh, kept, &numbers)
}

/// Merges vertices of `mesh` that are closer than `distance`, in m, each with the first vertex near
/// it. Returns the number of merged vertices.
///
/// Two vertices are merged only if both are on open edges, or if an edge joins them. Two sheets
/// that nearly touch, such as lips, therefore stay apart.
pub(crate) fn merge_vertices(mesh: &mut Triangulation, distance: f64) -> usize {
    let cell = distance.max(f64::MIN_POSITIVE);
    let edges = Edges::new(&mesh.triangles);
    let open_edges = edges.iter().filter(|(_, sides)| sides.len() == 1);
    let on_open_edge: BTreeSet<u32> = open_edges.flat_map(|(edge, _)| edge).collect();

    // Numbers of the vertices that are kept, and a grid of their places in that list.
    let mut kept: Vec<u32> = Vec::new();
    let mut grid: BTreeMap<[i64; 3], Vec<u32>> = BTreeMap::new();
    let mut numbers = Vec::with_capacity(mesh.vertices.len());
    for (number, &position) in mesh.vertices.iter().enumerate() {
        let number = number as u32;
        let [x, y, z] = position.map(|value| (value / cell).floor() as i64);

        // Vertices within the distance lie in this cell or in a cell beside it.
        let offsets =
            (-1..=1).flat_map(|i| (-1..=1).flat_map(move |j| (-1..=1).map(move |k| [i, j, k])));
        let near = offsets
            .filter_map(|[i, j, k]| {
                grid.get(&[x.saturating_add(i), y.saturating_add(j), z.saturating_add(k)])
            })
            .flatten()
            .copied()
            .filter(|&candidate| {
                let candidate = kept[candidate as usize];
                let both_open = on_open_edge.contains(&candidate) && on_open_edge.contains(&number);
                norm(subtract(mesh.vertices[candidate as usize], position)) <= distance
                    && (both_open || !edges.sides([candidate, number]).is_empty())
            })
            .min();

        numbers.push(near.unwrap_or_else(|| {
            kept.push(number);
            grid.entry([x, y, z]).or_default().push(kept.len() as u32 - 1);
            kept.len() as u32 - 1
        }));
    }
    let positions = kept.into_iter().map(|number| mesh.vertices[number as usize]).collect();
    renumber(mesh, positions, &numbers)
}

/// Gives `mesh` the vertices `kept`, and drops triangles that lost a corner. `numbers` holds the
/// place in `kept` of each earlier vertex. Returns the number of merged vertices.
fn renumber(mesh: &mut Triangulation, kept: Vec<[f64; 3]>, numbers: &[u32]) -> usize {
    let merged = mesh.vertices.len() - kept.len();
    mesh.vertices = kept;
    let count = numbers.len() as u32;
    mesh.triangles.retain(|triangle| triangle.iter().all(|vertex| *vertex < count));
    for vertex in mesh.triangles.iter_mut().flatten() {
        *vertex = numbers[*vertex as usize];
    }
    mesh.triangles.retain(|&[a, b, c]| a != b && b != c && c != a);
    merged
}

/// Removes triangles that have no area or that occur twice, and returns their number.
pub(crate) fn drop_degenerate(mesh: &mut Triangulation) -> usize {
    let before = mesh.triangles.len();
    let mut seen = BTreeSet::new();
    let mut triangles = std::mem::take(&mut mesh.triangles);
    triangles.retain(|triangle| {
        let mut key = *triangle;
        key.sort_unstable();
        doubled_area(mesh.corners(*triangle)).is_ok() && seen.insert(key)
    });
    mesh.triangles = triangles;
    before - mesh.triangles.len()
}

/// Removes the vertices of `mesh` that no triangle names.
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
