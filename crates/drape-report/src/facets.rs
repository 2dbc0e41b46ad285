use crate::scene::{Scene, Surface};
use crate::shade::decode;
use crate::vector::{Vector, add, at, cross, dot, norm, scale, subtract, surround, unit};
use std::collections::BTreeMap;

/// Longest edge of a facet as a share of the scene's half diagonal.
///
/// The light of the sky is found at corners and interpolated, so large triangles are split until
/// they can carry the shade at the foot of a body.
const FINEST: f64 = 1.0 / 24.0;

/// Cosine of the angle at an edge of a body from which on it is drawn sharp: 40°.
const CREASE: f64 = 0.766;

/// Corners of the floor along each of its sides, less one.
const FLOOR_CELLS: usize = 64;

/// Half of the side of the floor, in half diagonals of the scene.
pub(crate) const FLOOR_REACH: f64 = 2.2;

/// What a facet belongs to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Part {
    Cloth(usize),
    Body(usize),
    Floor,
}

/// A corner of a facet.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Corner {
    pub(crate) position: Vector,
    pub(crate) normal: Vector,
    /// Material coordinates, in m.
    pub(crate) coordinates: [f64; 2],
    /// Linear light of its colour, where the surface has one per vertex.
    pub(crate) tint: Vector,
    /// Whether it lies on a hem of the cloth.
    pub(crate) on_hem: bool,
}

/// A small triangle of the picture.
#[derive(Debug, Clone)]
pub(crate) struct Facet {
    pub(crate) part: Part,
    pub(crate) corners: [Corner; 3],
    /// Whether the edge opposite to each corner is a hem of the cloth.
    pub(crate) hems: [bool; 3],
}

impl Facet {
    /// Twice the area, along the normal.
    pub(crate) fn area(&self) -> Vector {
        let [a, b, c] = self.corners.map(|corner| corner.position);
        cross(subtract(b, a), subtract(c, a))
    }
}

/// A scene cut into facets.
pub(crate) struct Stage {
    pub(crate) facets: Vec<Facet>,
    /// Centre and half diagonal of the box around all that is no floor, in m.
    pub(crate) center: Vector,
    pub(crate) reach: f64,
    /// How far bodies step back behind cloth, for the eye and for the light, in m.
    pub(crate) setback: f64,
}

impl Stage {
    pub(crate) fn new(scene: &Scene, setback: f64) -> Stage {
        let surfaces = scene.cloths.iter().chain(&scene.bodies);
        let (center, reach) = surround(surfaces.flat_map(|surface| surface.points()));
        let longest = FINEST * reach;
        let mut facets = Vec::new();
        for (k, cloth) in scene.cloths.iter().enumerate() {
            add_surface(&mut facets, cloth, (Part::Cloth(k), longest));
        }
        for (k, body) in scene.bodies.iter().enumerate() {
            add_surface(&mut facets, body, (Part::Body(k), longest));
        }
        if let Some(height) = scene.floor {
            add_floor(&mut facets, center, FLOOR_REACH * reach, height);
        }
        Stage { facets, center, reach, setback }
    }

    /// How far a part steps back, in m.
    pub(crate) fn setback(&self, part: Part) -> f64 {
        match part {
            Part::Body(_) => self.setback,
            Part::Cloth(_) | Part::Floor => 0.0,
        }
    }
}

fn add_surface(facets: &mut Vec<Facet>, surface: &Surface, (part, longest): (Part, f64)) {
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
    let is_hem = |edge: &(u32, u32)| is_cloth && sides.get(edge) == Some(&1);
    let mut on_hem = vec![false; around.len()];
    for (a, b) in sides.keys().filter(|edge| is_hem(edge)) {
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
            // Larger neighbours count more; across a sharp edge of a body there is no mean.
            let smooth = around[index]
                .iter()
                .map(|&other| areas[other])
                .filter(|other| is_cloth || dot(own, unit(*other)) > CREASE)
                .fold([0.0; 3], add);
            let coordinates =
                surface.coordinates.map_or([0.0; 2], |c| [c[2 * index], c[2 * index + 1]]);
            Corner {
                position: at(surface.positions, index),
                normal: if norm(smooth) > 0.0 { unit(smooth) } else { own },
                coordinates,
                tint: surface.tints.map_or([0.0; 3], |tints| tints[index].map(decode)),
                on_hem: on_hem[index],
            }
        });
        let hems = [0, 1, 2].map(|k| is_hem(&edge(triangle, k)));
        split(facets, Facet { part, corners, hems }, longest);
    }
}

/// The edge opposite to a corner.
fn edge(triangle: &[u32; 3], corner: usize) -> (u32, u32) {
    let (a, b) = (triangle[(corner + 1) % 3], triangle[(corner + 2) % 3]);
    (a.min(b), a.max(b))
}

/// Halves the longest edge until none is too long.
///
/// An edge is only ever cut in its middle, and its length alone decides, so neighbours agree.
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
    };
    for (replaced, cut) in [(c, b), (b, c)] {
        let mut half = facet.clone();
        half.corners[replaced] = middle;
        // The new edge from the middle to corner k is opposite to the corner that was kept.
        half.hems[cut] = false;
        split(facets, half, longest);
    }
}

fn add_floor(facets: &mut Vec<Facet>, center: Vector, reach: f64, height: f64) {
    let corner = |i: usize, j: usize| {
        let place = |k: usize| reach * (2.0 * k as f64 / FLOOR_CELLS as f64 - 1.0);
        Corner {
            position: [center[0] + place(i), height, center[2] + place(j)],
            normal: [0.0, 1.0, 0.0],
            coordinates: [0.0; 2],
            tint: [0.0; 3],
            on_hem: false,
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

    /// A square of side 1 and a far larger one beside it, to be split.
    #[test]
    fn splitting_keeps_the_area_and_the_hem() {
        let positions = [
            0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 1.0, 4.0, 0.0, 0.0, 4.0, 0.0,
            1.0,
        ];
        let triangles = [[0, 2, 1], [0, 3, 2], [1, 5, 4], [1, 2, 5]];
        let scene =
            Scene { cloths: vec![Surface::cloth(&positions, &triangles)], ..Scene::default() };
        let Stage { facets, reach, .. } = Stage::new(&scene, 0.0);
        let area: f64 = facets.iter().map(|f| 0.5 * norm(f.area())).sum();
        assert!((area - 4.0).abs() < 1e-12, "area {area}");
        let mut hem = 0.0;
        for facet in &facets {
            for k in 0..3 {
                let [a, b] = [1, 2].map(|i| facet.corners[(k + i) % 3]);
                let length = norm(subtract(a.position, b.position));
                assert!(length <= FINEST * reach, "an edge of {length}");
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
        let facets = Stage::new(&scene, 0.0).facets;
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
            let corners = Stage::new(&scene, 0.0).facets.into_iter().flat_map(|f| f.corners);
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
