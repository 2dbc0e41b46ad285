//! Orientation of the triangles of a mesh: neighbours agree about the outside, and each part
//! encloses a positive volume.

use crate::mesh_io::Triangulation;

use super::edges::{Edges, volume_six};

/// Turns triangles of `mesh` until neighbours agree and each part has a positive volume. Returns
/// the number of turned triangles.
///
/// The volume decides about open parts too, and about cavities inside another part. A part whose
/// volume is zero keeps the orientation of the majority of its triangles.
pub(crate) fn orient(mesh: &mut Triangulation) -> usize {
    let edges = Edges::new(&mesh.triangles);
    let count = mesh.triangles.len();
    let mut turned: Vec<Option<bool>> = vec![None; count];

    // From each triangle that no part has reached yet, walk over edges to all of its part.
    for seed in 0..count {
        if turned[seed].is_some() {
            continue;
        }
        turned[seed] = Some(false);
        let mut part = vec![seed];
        let mut open = vec![seed];
        while let Some(triangle) = open.pop() {
            let corners = mesh.triangles[triangle];
            for k in 0..3 {
                let sides = edges.sides([corners[k], corners[(k + 1) % 3]]);
                // An edge with more than two triangles has no single neighbour.
                let [first, second] = sides else { continue };
                let (here, neighbour) = if first.triangle as usize == triangle {
                    (first, second)
                } else {
                    (second, first)
                };
                let next = neighbour.triangle as usize;
                if turned[next].is_none() {
                    let agrees = here.rises != neighbour.rises;
                    turned[next] = Some(turned[triangle].unwrap_or(false) == agrees);
                    part.push(next);
                    open.push(next);
                }
            }
        }
        choose_outside(mesh, &part, &mut turned);
    }

    let all: Vec<usize> = (0..count).filter(|&k| turned[k] == Some(true)).collect();
    for &triangle in &all {
        mesh.triangles[triangle].swap(1, 2);
    }
    all.len()
}

/// Chooses between the two orientations of `part`: the one with a positive volume or, at a volume
/// of zero, the one that turns fewer triangles. Writes the choice into `turned`.
fn choose_outside(mesh: &Triangulation, part: &[usize], turned: &mut [Option<bool>]) {
    let origin = mesh.vertices[mesh.triangles[part[0]][0] as usize];
    let volume: f64 = part
        .iter()
        .map(|&triangle| {
            let six = volume_six(mesh, mesh.triangles[triangle], origin);
            if turned[triangle] == Some(true) { -six } else { six }
        })
        .sum();
    let count = part.iter().filter(|&&triangle| turned[triangle] == Some(true)).count();
    let is_wrong = if volume == 0.0 { 2 * count > part.len() } else { volume < 0.0 };
    if is_wrong {
        for &triangle in part {
            turned[triangle] = turned[triangle].map(|turned| !turned);
        }
    }
}
