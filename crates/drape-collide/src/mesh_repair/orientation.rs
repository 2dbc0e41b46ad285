//! Orientation of the triangles of a mesh: neighbours agree about the outside, and the outside is
//! outside.

use crate::mesh_io::Triangulation;

use super::edges::{Edges, volume_six};

/// Turns triangles until neighbours agree, and each part until it has a positive volume; returns the
/// number of triangles that were turned.
///
/// A part keeps the sense that the larger half of its triangles has. Parts that are open, or whose
/// volume is below 0 because they are cavities of another part, are turned by their volume too.
pub(crate) fn orient(mesh: &mut Triangulation) -> usize {
    let edges = Edges::new(&mesh.triangles);
    let count = mesh.triangles.len();
    let mut turned: Vec<Option<bool>> = vec![None; count];
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
                // Across an edge with more triangles there is no one neighbour.
                let [one, other] = sides else { continue };
                let (own, neighbour) =
                    if one.triangle as usize == triangle { (one, other) } else { (other, one) };
                let next = neighbour.triangle as usize;
                if turned[next].is_none() {
                    let agrees = own.rises != neighbour.rises;
                    turned[next] = Some(turned[triangle].unwrap_or(false) == agrees);
                    part.push(next);
                    open.push(next);
                }
            }
        }
        settle(mesh, &part, &mut turned);
    }
    let turn = |(_, turned): &(usize, &Option<bool>)| **turned == Some(true);
    let all: Vec<usize> = turned.iter().enumerate().filter(turn).map(|(k, _)| k).collect();
    for &triangle in &all {
        mesh.triangles[triangle].swap(1, 2);
    }
    all.len()
}

/// Chooses between the two senses of a part: the one in which its volume is above 0, or, where that
/// does not decide, the one that turns fewer triangles.
fn settle(mesh: &Triangulation, part: &[usize], turned: &mut [Option<bool>]) {
    let origin = mesh.vertices[mesh.triangles[part[0]][0] as usize];
    let is_turned = |turned: &[Option<bool>], triangle: usize| turned[triangle] == Some(true);
    let volume: f64 = part
        .iter()
        .map(|&triangle| {
            let six = volume_six(mesh, mesh.triangles[triangle], origin);
            if is_turned(turned, triangle) { -six } else { six }
        })
        .sum();
    let count = part.iter().filter(|&&triangle| is_turned(turned, triangle)).count();
    let wrong = if volume == 0.0 { 2 * count > part.len() } else { volume < 0.0 };
    if wrong {
        for &triangle in part {
            turned[triangle] = turned[triangle].map(|turned| !turned);
        }
    }
}
