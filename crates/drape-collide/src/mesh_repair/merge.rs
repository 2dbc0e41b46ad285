//! Merging of vertices at one position or close to each other, and removal of triangles without area.

use std::collections::{BTreeMap, BTreeSet};

use crate::mesh_io::{Triangulation, doubled_area};
use crate::vector::{norm, subtract};

use super::edges::Edges;

/// Merges vertices at the very same position, as a body is made, leaves out triangles that lose a
/// corner by it or name a vertex that is not there, and returns the number of vertices that were merged.
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

/// Merges vertices closer than a distance, in m, each with the first one near it, where that joins
/// what is torn: two vertices at open edges, or the two ends of an edge. Returns the number of those
/// that were merged.
///
/// Two sheets that nearly touch, such as lips, stay apart.
pub(crate) fn merge_vertices(mesh: &mut Triangulation, distance: f64) -> usize {
    let cell = distance.max(f64::MIN_POSITIVE);
    let key = |position: [f64; 3]| position.map(|value| (value / cell).floor() as i64);
    let edges = Edges::new(&mesh.triangles);
    let torn = edges.iter().filter(|(_, sides)| sides.len() == 1);
    let at_tear: BTreeSet<u32> = torn.flat_map(|(edge, _)| edge).collect();
    let joins = |one: u32, other: u32| {
        (at_tear.contains(&one) && at_tear.contains(&other))
            || !edges.sides([one, other]).is_empty()
    };
    // Vertices that are kept, by their numbers before and after.
    let mut kept: Vec<u32> = Vec::new();
    let mut at: BTreeMap<[i64; 3], Vec<u32>> = BTreeMap::new();
    let mut numbers = Vec::with_capacity(mesh.vertices.len());
    for (number, &position) in mesh.vertices.iter().enumerate() {
        let [x, y, z] = key(position);
        let around =
            (-1..=1).flat_map(|i| (-1..=1).flat_map(move |j| (-1..=1).map(move |k| [i, j, k])));
        let near = around
            .filter_map(|[i, j, k]| {
                at.get(&[x.saturating_add(i), y.saturating_add(j), z.saturating_add(k)])
            })
            .flatten()
            .copied()
            .filter(|&other| {
                let other = kept[other as usize];
                norm(subtract(mesh.vertices[other as usize], position)) <= distance
                    && joins(other, number as u32)
            })
            .min();
        numbers.push(near.unwrap_or_else(|| {
            kept.push(number as u32);
            at.entry([x, y, z]).or_default().push(kept.len() as u32 - 1);
            kept.len() as u32 - 1
        }));
    }
    let kept = kept.into_iter().map(|number| mesh.vertices[number as usize]).collect();
    renumber(mesh, kept, &numbers)
}

/// Gives a mesh the vertices that were kept, by the number of each among them, without triangles that
/// lost a corner; returns the number of vertices that were merged.
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

/// Removes triangles that have no area, or that are there twice, and returns their number.
pub(crate) fn drop_degenerate(mesh: &mut Triangulation) -> usize {
    let before = mesh.triangles.len();
    let point = |vertex: u32| mesh.vertices[vertex as usize];
    let has_area = |triangle: &[u32; 3]| doubled_area(triangle.map(point)).is_ok();
    let mut seen = BTreeSet::new();
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
