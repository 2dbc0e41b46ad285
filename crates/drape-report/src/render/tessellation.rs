//! Tessellation: the surfaces of a scene subdivided into facets with smooth normals.

use std::collections::BTreeMap;

use super::colour::decode;
use super::scene::{Scene, Surface};
use super::vector::{Bounds, Vector, add, at, cross, dot, norm, scale, subtract, unit};

/// Longest edge of a facet, over the radius of the scene.
///
/// The light of the sky is evaluated at corners and interpolated, so large triangles are split
/// until they can resolve the shade at the foot of a body.
const LONGEST_EDGE: f64 = 1.0 / 24.0;

/// Cosine of the angle between normals above which an edge of a body is smooth: 40°.
const SMOOTH_COSINE: f64 = 0.766;

/// Number of cells of the floor along each side.
const FLOOR_CELLS: usize = 64;

/// Half of the side of the floor, over the radius of the scene.
pub(crate) const FLOOR_HALF_SIDE: f64 = 2.2;

/// Part of the scene to which a facet belongs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Part {
    Cloth(usize),
    Body(usize),
    Floor,
}

/// Corner of a facet.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Corner {
    pub(crate) position: Vector,
    pub(crate) normal: Vector,
    /// Material coordinates, in m.
    pub(crate) coordinates: [f64; 2],
    /// Linear light of its colour, where the surface has one per vertex.
    pub(crate) tint: Vector,
    /// Whether it lies on the boundary of the cloth, the hem.
    pub(crate) on_hem: bool,
    /// Number of its lit point.
    pub(crate) lit_point: u32,
}

/// Place and normal that the light of the sky is computed for, shared by the corners of facets.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LitPoint {
    pub(crate) position: Vector,
    pub(crate) normal: Vector,
}

impl LitPoint {
    /// Returns the bits of its numbers, to find equal points.
    fn bits(&self) -> [[u64; 3]; 2] {
        [self.position, self.normal].map(|vector| vector.map(f64::to_bits))
    }
}

/// Triangle of the tessellation.
#[derive(Debug, Clone)]
pub(crate) struct Facet {
    pub(crate) part: Part,
    pub(crate) corners: [Corner; 3],
    /// Whether the edge opposite to each corner lies on the hem of the cloth.
    pub(crate) hems: [bool; 3],
}

impl Facet {
    /// Returns the normal with a length of twice the area.
    pub(crate) fn area_normal(&self) -> Vector {
        let [a, b, c] = self.corners.map(|corner| corner.position);
        cross(subtract(b, a), subtract(c, a))
    }
}

/// Scene subdivided into facets.
pub(crate) struct Tessellation {
    pub(crate) facets: Vec<Facet>,
    /// Points of the corners, each once.
    pub(crate) lit_points: Vec<LitPoint>,
    /// Bounds of cloths and bodies, in m.
    pub(crate) bounds: Bounds,
    /// Depth bias of bodies, for the camera and for lights, in m.
    pub(crate) body_depth_bias: f64,
}

impl Tessellation {
    /// Subdivides a scene.
    pub(crate) fn new(scene: &Scene) -> Tessellation {
        let surfaces = scene.cloths.iter().chain(&scene.bodies);
        let bounds = Bounds::of(surfaces.flat_map(|surface| surface.points()));
        let longest = LONGEST_EDGE * bounds.radius;
        let mut facets = Vec::new();
        for (k, cloth) in scene.cloths.iter().enumerate() {
            add_surface(&mut facets, cloth, Part::Cloth(k), longest);
        }
        for (k, body) in scene.bodies.iter().enumerate() {
            add_surface(&mut facets, body, Part::Body(k), longest);
        }
        if let Some(height) = scene.floor {
            add_floor(&mut facets, bounds.center, FLOOR_HALF_SIDE * bounds.radius, height);
        }
        let lit_points = number_lit_points(&mut facets);
        Tessellation { facets, lit_points, bounds, body_depth_bias: scene.body_depth_bias }
    }

    /// Returns the depth bias of a part, in m.
    pub(crate) fn depth_bias(&self, part: Part) -> f64 {
        match part {
            Part::Body(_) => self.body_depth_bias,
            Part::Cloth(_) | Part::Floor => 0.0,
        }
    }
}

/// Numbers the lit points of facets and returns them.
fn number_lit_points(facets: &mut [Facet]) -> Vec<LitPoint> {
    let point = |facet: &Facet, corner: usize| {
        let Corner { position, normal, .. } = facet.corners[corner];
        LitPoint { position, normal }
    };
    let mut corners: Vec<[u32; 2]> = (0..facets.len() as u32)
        .flat_map(|facet| [0, 1, 2].map(|corner| [facet, corner]))
        .collect();
    corners.sort_unstable_by_key(|&[facet, corner]| {
        point(&facets[facet as usize], corner as usize).bits()
    });
    let mut points: Vec<LitPoint> = Vec::new();
    for [facet, corner] in corners.into_iter().map(|pair| pair.map(|number| number as usize)) {
        let own = point(&facets[facet], corner);
        if points.last().is_none_or(|last| last.bits() != own.bits()) {
            points.push(own);
        }
        facets[facet].corners[corner].lit_point = points.len() as u32 - 1;
    }
    points
}

/// Adds the facets of a surface, with edges up to a longest length in m.
fn add_surface(facets: &mut Vec<Facet>, surface: &Surface, part: Part, longest: f64) {
    let is_cloth = matches!(part, Part::Cloth(_));
    let area = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(|index| at(surface.positions, index as usize));
        cross(subtract(b, a), subtract(c, a))
    };
    let areas: Vec<Vector> = surface.triangles.iter().map(area).collect();
    let mut around = vec![Vec::new(); surface.positions.len() / 3];
    let mut sides = BTreeMap::new();
    for (t, triangle) in surface.triangles.iter().enumerate() {
        for k in 0..3 {
            around[triangle[k] as usize].push(t);
            *sides.entry(edge(triangle, k)).or_insert(0) += 1;
        }
    }
    let is_hem = |edge: &[u32; 2]| is_cloth && sides.get(edge) == Some(&1);
    let mut on_hem = vec![false; around.len()];
    for [a, b] in sides.keys().filter(|edge| is_hem(edge)) {
        on_hem[*a as usize] = true;
        on_hem[*b as usize] = true;
    }
    for (t, triangle) in surface.triangles.iter().enumerate() {
        if norm(areas[t]) == 0.0 {
            continue;
        }
        let own = unit(areas[t]);
        let corners = triangle.map(|index| {
            let index = index as usize;
            // The mean is weighted by area; a sharp edge of a body is left out of it.
            let smooth = around[index]
                .iter()
                .map(|&other| areas[other])
                .filter(|other| is_cloth || dot(own, unit(*other)) > SMOOTH_COSINE)
                .fold([0.0; 3], add);
            let coordinates =
                surface.coordinates.map_or([0.0; 2], |c| [c[2 * index], c[2 * index + 1]]);
            Corner {
                position: at(surface.positions, index),
                normal: if norm(smooth) > 0.0 { unit(smooth) } else { own },
                coordinates,
                tint: surface.tints.map_or([0.0; 3], |tints| tints[index].map(decode)),
                on_hem: on_hem[index],
                lit_point: 0,
            }
        });
        let hems = [0, 1, 2].map(|k| is_hem(&edge(triangle, k)));
        split(facets, Facet { part, corners, hems }, longest);
    }
}

/// Returns the edge opposite to a corner, by its vertices.
fn edge(triangle: &[u32; 3], corner: usize) -> [u32; 2] {
    let [a, b] = [1, 2].map(|k| triangle[(corner + k) % 3]);
    [a.min(b), a.max(b)]
}

/// Bisects the longest edge of a facet until none is too long.
///
/// An edge is only cut at its midpoint, and its length alone decides, so that neighbours agree.
fn split(facets: &mut Vec<Facet>, facet: Facet, longest: f64) {
    let length = |k: usize| {
        let (a, b) = (facet.corners[(k + 1) % 3], facet.corners[(k + 2) % 3]);
        norm(subtract(a.position, b.position))
    };
    let lengths = [length(0), length(1), length(2)];
    let k = (1..3).fold(0, |best, k| if lengths[k] > lengths[best] { k } else { best });
    if lengths[k] <= longest {
        facets.push(facet);
        return;
    }
    let (b, c) = ((k + 1) % 3, (k + 2) % 3);
    let (one, other) = (facet.corners[b], facet.corners[c]);
    let middle = Corner {
        position: scale(add(one.position, other.position), 0.5),
        normal: unit(add(one.normal, other.normal)),
        coordinates: [0, 1].map(|i| 0.5 * (one.coordinates[i] + other.coordinates[i])),
        tint: scale(add(one.tint, other.tint), 0.5),
        on_hem: facet.hems[k],
        lit_point: 0,
    };
    for (replaced, cut) in [(c, b), (b, c)] {
        let mut half = facet.clone();
        half.corners[replaced] = middle;
        // The new edge from the midpoint to corner k is opposite to the corner that was kept.
        half.hems[cut] = false;
        split(facets, half, longest);
    }
}

/// Adds the facets of a floor at a height, with half of its side in m.
fn add_floor(facets: &mut Vec<Facet>, center: Vector, half_side: f64, height: f64) {
    let corner = |i: usize, j: usize| {
        let offset = |k: usize| half_side * (2.0 * k as f64 / FLOOR_CELLS as f64 - 1.0);
        Corner {
            position: [center[0] + offset(i), height, center[2] + offset(j)],
            normal: [0.0, 1.0, 0.0],
            coordinates: [0.0; 2],
            tint: [0.0; 3],
            on_hem: false,
            lit_point: 0,
        }
    };
    for i in 0..FLOOR_CELLS {
        for j in 0..FLOOR_CELLS {
            let [a, b, c, d] =
                [corner(i, j), corner(i, j + 1), corner(i + 1, j + 1), corner(i + 1, j)];
            for corners in [[a, b, c], [a, c, d]] {
                facets.push(Facet { part: Part::Floor, corners, hems: [false; 3] });
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square of side 1 and a far larger rectangle beside it.
    #[test]
    fn bisection_keeps_the_area_and_the_hem() {
        let positions = [
            0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 1.0, 4.0, 0.0, 0.0, 4.0, 0.0,
            1.0,
        ];
        let triangles = [[0, 2, 1], [0, 3, 2], [1, 5, 4], [1, 2, 5]];
        let scene =
            Scene { cloths: vec![Surface::cloth(&positions, &triangles)], ..Scene::default() };
        let Tessellation { facets, bounds, .. } = Tessellation::new(&scene);
        let area: f64 = facets.iter().map(|f| 0.5 * norm(f.area_normal())).sum();
        assert!((area - 4.0).abs() < 1e-12, "area {area}");
        let mut hem = 0.0;
        for facet in &facets {
            for k in 0..3 {
                let [a, b] = [1, 2].map(|i| facet.corners[(k + i) % 3]);
                let length = norm(subtract(a.position, b.position));
                assert!(length <= LONGEST_EDGE * bounds.radius, "an edge of {length}");
                if facet.hems[k] {
                    hem += length;
                    assert!(a.on_hem && b.on_hem, "a hem between corners off the hem");
                }
            }
        }
        assert!((hem - 10.0).abs() < 1e-12, "hem {hem}");
    }

    /// Neighbours that cut a common edge differently would leave a corner without a partner.
    #[test]
    fn split_neighbours_share_all_corners() {
        let positions = [0.0, 0.0, 0.0, 1.0, 0.3, 0.0, 0.9, 0.0, 1.1, 0.0, 0.2, 0.8, 0.3, 1.5, 0.4];
        let triangles = [[0, 1, 2], [0, 2, 3], [0, 4, 1], [1, 4, 2], [2, 4, 3], [3, 4, 0]];
        let scene =
            Scene { bodies: vec![Surface::body(&positions, &triangles)], ..Scene::default() };
        let facets = Tessellation::new(&scene).facets;
        let mut sides = BTreeMap::new();
        for facet in &facets {
            let keys = facet.corners.map(|c| c.position.map(f64::to_bits));
            for k in 0..3 {
                let (a, b) = (keys[k], keys[(k + 1) % 3]);
                *sides.entry((a.min(b), a.max(b))).or_insert(0) += 1;
            }
        }
        let lonely = sides.values().filter(|count| **count != 2).count();
        assert_eq!(lonely, 0, "edges of {} facets without a partner", facets.len());
        assert!(facets.len() > 1000, "only {} facets", facets.len());
    }

    #[test]
    fn a_cube_keeps_its_edges_and_a_cloth_does_not() {
        let positions = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
        let triangles = [[0, 1, 2], [0, 2, 3]];
        let normal_at_the_fold = |scene: Scene| {
            let corners = Tessellation::new(&scene).facets.into_iter().flat_map(|f| f.corners);
            let mut at_origin = corners.filter(|c| c.position == [0.0; 3]);
            at_origin.next().expect("the first vertex").normal
        };
        let surface = Surface::body(&positions, &triangles);
        let body = normal_at_the_fold(Scene { bodies: vec![surface], ..Scene::default() });
        let cloth = normal_at_the_fold(Scene { cloths: vec![surface], ..Scene::default() });
        assert_eq!(body, [0.0, 0.0, 1.0]);
        let middle = 0.5f64.sqrt();
        let miss = norm(subtract(cloth, [middle, 0.0, middle]));
        assert!(miss < 1e-12, "{cloth:?}");
    }
}

/// Scenes of the tests of lights.
#[cfg(test)]
pub(crate) mod samples {
    use super::*;

    /// Scene of facets with its bounds.
    pub(crate) fn scene(mut facets: Vec<Facet>, center: Vector, radius: f64) -> Tessellation {
        let lit_points = number_lit_points(&mut facets);
        let bounds = Bounds { center, radius };
        Tessellation { facets, lit_points, bounds, body_depth_bias: 0.0 }
    }

    /// Disc around the y axis, facing up, as a fan of triangles.
    pub(crate) fn disc(radius: f64, height: f64, pieces: usize) -> Vec<Facet> {
        let corner = |radius: f64, k: usize| {
            let (sine, cosine) = (k as f64 * std::f64::consts::TAU / pieces as f64).sin_cos();
            Corner {
                position: [radius * sine, height, radius * cosine],
                normal: [0.0, 1.0, 0.0],
                coordinates: [0.0; 2],
                tint: [0.0; 3],
                on_hem: false,
                lit_point: 0,
            }
        };
        let piece = |k| Facet {
            part: Part::Body(0),
            corners: [corner(0.0, 0), corner(radius, k), corner(radius, k + 1)],
            hems: [false; 3],
        };
        (0..pieces).map(piece).collect()
    }
}
