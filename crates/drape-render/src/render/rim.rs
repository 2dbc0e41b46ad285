//! Rim: a band along the hem of a cloth, so that the cloth has the thickness of a fabric.

use std::collections::HashMap;

use super::scene::Scene;
use super::smooth::Border;
use super::tessellation::{Facet, Part, Tessellation, Vertex};
use super::vector::{self, Vector, cross, dot, scale, subtract, unit};

/// Smallest width of the band over the radius of the scene: about a pixel in the usual pictures. A
/// narrower band would break into dots.
const LEAST: f64 = 1.0 / 420.0;

/// Adds the rims of the cloths of a `scene` to its `tessellation`.
pub(crate) fn add(scene: &Scene, tessellation: &mut Tessellation) {
    let Tessellation { vertices, facets, bounds, .. } = tessellation;
    let mut outwards: HashMap<u32, Vector> = HashMap::new();
    let mut edges = Vec::new();
    for facet in facets.iter() {
        let Part::Cloth(cloth) = facet.part else { continue };
        for k in (0..3).filter(|k| facet.borders[*k] == Border::Hem) {
            let [a, b] = [1, 2].map(|i| facet.corners[(k + i) % 3]);
            let [across, along] = [facet.corners[k], b].map(|corner| {
                subtract(vertices[corner as usize].position, vertices[a as usize].position)
            });
            let normal = vertices[a as usize].normal;
            let out = unit(cross(along, normal));
            let out = if dot(out, across) > 0.0 { scale(out, -1.0) } else { out };
            for end in [a, b] {
                let sum = outwards.entry(end).or_insert([0.0; 3]);
                *sum = vector::add(*sum, out);
            }
            edges.push((cloth, [a, b]));
        }
    }
    // Each end of an edge of the hem has a vertex on both sides of the cloth.
    let mut sides: HashMap<u32, u32> = HashMap::new();
    for (cloth, ends) in edges {
        let width = scene.cloths[cloth].thickness.max(LEAST * bounds.radius);
        let [a, b] = ends.map(|end| {
            *sides.entry(end).or_insert_with(|| {
                let first = vertices.len() as u32;
                let Vertex { position, normal, source, .. } = vertices[end as usize];
                for side in [0.5, -0.5] {
                    vertices.push(Vertex {
                        position: vector::add(position, scale(normal, side * width)),
                        normal: unit(outwards[&end]),
                        part: Part::Rim(cloth),
                        source,
                        border: Border::None,
                    });
                }
                first
            })
        });
        for corners in [[a, a + 1, b + 1], [a, b + 1, b]] {
            let (part, borders) = (Part::Rim(cloth), [Border::None; 3]);
            facets.push(Facet { part, corners, borders });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::scene::Surface;

    #[test]
    fn the_band_faces_away_from_the_cloth() {
        let positions = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 1.0];
        let triangles = [[0, 2, 1], [0, 3, 2]];
        let scene =
            Scene { cloths: vec![Surface::cloth(&positions, &triangles)], ..Scene::default() };
        let mut tessellation = Tessellation::new(&scene);
        add(&scene, &mut tessellation);
        let band = tessellation.vertices.iter().filter(|vertex| vertex.part == Part::Rim(0));
        for Vertex { position, normal, .. } in band.clone() {
            let from_middle = subtract(*position, [0.5, position[1], 0.5]);
            assert!(dot(*normal, from_middle) >= 0.5 - 1e-9, "{normal:?} at {position:?}");
        }
        assert!(band.count() > 100);
    }
}
