//! Cloth between two faces of bodies that leave it less room than its thickness.

use super::active_pairs::{ActivePair, ActivePairs};
use super::obstacles::Obstacles;
use super::settings::PinchPolicy;
use crate::surface::contact_surface::Surface;
use crate::surface::exact::{Intersection, encloses};
use crate::surface::geometry::PinchState;
use crate::vector::{Vector, add, at, dot, scale, subtract};

/// Numbers of free vertices that bodies pinch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct PinchedVertices {
    /// Number of vertices that keep a fraction of their minimum separation from bodies.
    pub thinned: usize,
    /// Number of vertices through which a body passes.
    pub released: usize,
}

/// Room between two faces over the sum of their minimum separations, below which they pinch cloth.
/// At 1 the barriers of both faces would be infinite.
const CLOSED: f64 = 1.25;

/// Cosine of the angle between the directions from two faces to the cloth, below which the cloth is
/// between them: 120°.
const OPPOSED: f64 = -0.5;

/// Distance over the minimum separation above which thinned cloth gets its whole separation back. A
/// usual load keeps cloth nearer, so the returning barrier adds little energy.
const REGAINED: f64 = 2.0;

/// Face of a body near a vertex of cloth.
#[derive(Debug, Clone, Copy)]
struct NearFace {
    group: u32,
    /// Unit direction from the face to the cloth.
    direction: Vector,
    /// Closest point of the face, in m.
    point: Vector,
    /// Displacement of the face towards the cloth in the step, in m.
    approach: f64,
    /// Distance, in m.
    distance: f64,
    /// Minimum separation, in m.
    min_separation: f64,
}

/// Vertex of cloth and a face near it.
#[derive(Debug, Clone, Copy)]
struct VertexWithFace {
    vertex: u32,
    /// Place in the order of the active pairs.
    order: u32,
    face: NearFace,
}

/// Pinch states of the free vertices.
#[derive(Debug)]
pub(super) struct Pinch {
    pub(super) policy: PinchPolicy,
    /// States when the last step was committed, empty if all are free.
    pub(super) committed: Vec<PinchState>,
    /// States in the open step.
    pub(super) next: Vec<PinchState>,
    /// Faces near each vertex, sorted by vertex and order.
    faces: Vec<VertexWithFace>,
    /// Whether each vertex is still at or inside the body that passes through it.
    inside: Vec<bool>,
}

impl Pinch {
    /// Returns the states of free vertices, with `policy` for cloth that will be pinched.
    pub(super) fn new(policy: PinchPolicy) -> Pinch {
        let (committed, next) = (Vec::new(), Vec::new());
        Pinch { policy, committed, next, faces: Vec::new(), inside: Vec::new() }
    }

    /// Returns the numbers of vertices that bodies pinch since the last step, as
    /// [`PinchedVertices`].
    pub(super) fn count(&self) -> PinchedVertices {
        let mut count = PinchedVertices::default();
        for state in &self.committed {
            match state {
                PinchState::Free => {}
                PinchState::Thinned => count.thinned += 1,
                PinchState::Released(_) => count.released += 1,
            }
        }
        count
    }

    /// Returns whether a body has been passing through a vertex since the last step.
    pub(super) fn any_released(&self) -> bool {
        self.committed.iter().any(|state| matches!(state, PinchState::Released(_)))
    }

    /// Finds the states of an open step. `active` holds its active pairs, detected without pinches,
    /// and `intersections` those at its start.
    pub(super) fn update(
        &mut self,
        surface: &Surface,
        obstacles: &Obstacles,
        active: &ActivePairs,
        intersections: &[Intersection],
    ) {
        self.find_faces(surface, obstacles, active);

        self.next.clone_from(&self.committed);
        self.next.resize(surface.free_count(), PinchState::Free);
        self.find_inside(surface, &active.positions, intersections);

        for (vertex, state) in self.next.iter_mut().enumerate() {
            let near = faces_of(&self.faces, vertex as u32);
            let stays_released = matches!(*state, PinchState::Released(_)) && self.inside[vertex];
            if stays_released {
                continue;
            }
            let stays_thinned =
                *state == PinchState::Thinned && near.iter().any(|near| near.face.is_close());
            *state = match find_pinching_face(near) {
                Some(face) if self.policy == PinchPolicy::Release => {
                    PinchState::Released(face.group)
                }
                Some(_) => PinchState::Thinned,
                None if stays_thinned => PinchState::Thinned,
                None => PinchState::Free,
            };
        }
    }

    /// Finds the faces of bodies near each vertex of cloth in the pairs of `active`.
    fn find_faces(&mut self, surface: &Surface, obstacles: &Obstacles, active: &ActivePairs) {
        let free = surface.free_count();
        let Obstacles { start, end, .. } = obstacles;
        self.faces.clear();
        for ActivePair { pair, gap } in active.iter() {
            let is_body = pair.vertices.map(|vertex| vertex as usize >= free);
            let Some(corner) = is_body.iter().position(|body| *body) else { continue };

            // Closest point and displacement of the body, with the weights of its vertices.
            let (mut point, mut displacement) = ([0.0; 3], [0.0; 3]);
            for (k, weight) in gap.weights().into_iter().enumerate().filter(|(k, _)| is_body[*k]) {
                let vertex = pair.vertices[k] as usize - free;
                point = add(point, scale(at(start, vertex), weight.abs()));
                let moved = subtract(at(end, vertex), at(start, vertex));
                displacement = add(displacement, scale(moved, weight.abs()));
            }

            // The normal of the gap leads from the second primitive to the first.
            let sign = if is_body[0] { -1.0 } else { 1.0 };
            let direction = scale(gap.normal(), sign);
            let [a, b] = [pair.vertices[0], pair.vertices[3]];
            let face = NearFace {
                group: surface.primitives().group(pair.vertices[corner]),
                direction,
                point,
                approach: dot(direction, displacement),
                distance: gap.distance(),
                min_separation: surface.vertex_distances([a, b]).min_separation,
            };
            for k in (0..4).filter(|&k| !is_body[k]) {
                let order = self.faces.len() as u32;
                self.faces.push(VertexWithFace { vertex: pair.vertices[k], order, face });
            }
        }
        self.faces.sort_unstable_by_key(|near| (near.vertex, near.order));
    }

    /// Finds the vertices that a passing body has not left yet: they are near the body or inside
    /// it, or one of their triangles intersects it.
    fn find_inside(
        &mut self,
        surface: &Surface,
        positions: &[f64],
        intersections: &[Intersection],
    ) {
        let Self { next, faces, inside, .. } = self;
        inside.clear();
        inside.resize(next.len(), false);
        for intersection in intersections {
            let vertices = vertices_of(surface, *intersection);
            for &vertex in &vertices {
                if let Some(PinchState::Released(group)) = next.get(vertex as usize)
                    && vertices.iter().any(|&other| surface.primitives().group(other) == *group)
                {
                    inside[vertex as usize] = true;
                }
            }
        }

        for (vertex, state) in next.iter().enumerate() {
            let PinchState::Released(group) = *state else { continue };
            let near = faces_of(faces, vertex as u32);
            if near.iter().any(|near| near.face.group == group)
                || encloses(surface, group, at(positions, vertex), positions)
            {
                inside[vertex] = true;
            }
        }
    }
}

/// Returns the vertices of the edge and the triangle of `intersection`.
pub(super) fn vertices_of(surface: &Surface, intersection: Intersection) -> [u32; 5] {
    let [a, b] = surface.edges()[intersection.edge as usize];
    let [c, d, e] = surface.triangles()[intersection.triangle as usize];
    [a, b, c, d, e]
}

/// Returns the part of the sorted `faces` that are near `vertex`.
fn faces_of(faces: &[VertexWithFace], vertex: u32) -> &[VertexWithFace] {
    let first = faces.partition_point(|near| near.vertex < vertex);
    let count = faces[first..].partition_point(|near| near.vertex == vertex);
    &faces[first..first + count]
}

impl NearFace {
    /// Returns whether thinned cloth at `distance` stays thinned near the face.
    fn is_close(&self) -> bool {
        !(self.distance > REGAINED * self.min_separation)
    }
}

/// Returns the face of two `faces` that pinch cloth between them which approaches faster, if any
/// two do.
fn find_pinching_face(faces: &[VertexWithFace]) -> Option<NearFace> {
    for (k, VertexWithFace { face: first, .. }) in faces.iter().enumerate() {
        for VertexWithFace { face: second, .. } in &faces[k + 1..] {
            let opposed = dot(first.direction, second.direction) < OPPOSED;
            // The room is negative where the cloth lies around a body, not between two.
            let room = dot(subtract(second.point, first.point), first.direction);
            let remaining = room - first.approach - second.approach;
            let closed = CLOSED * (first.min_separation + second.min_separation);
            if opposed && room > 0.0 && remaining < closed {
                let first_is_faster =
                    (first.approach, first.group) > (second.approach, second.group);
                return Some(if first_is_faster { *first } else { *second });
            }
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn face(height: f64, direction: f64, approach: f64) -> NearFace {
        NearFace {
            group: if direction > 0.0 { 1 } else { 2 },
            direction: [0.0, direction, 0.0],
            point: [0.0, height, 0.0],
            approach,
            distance: height.abs(),
            min_separation: 1e-4,
        }
    }

    fn near(faces: [NearFace; 2]) -> [VertexWithFace; 2] {
        faces.map(|face| VertexWithFace { vertex: 0, order: 0, face })
    }

    #[test]
    fn two_faces_pinch_cloth_between_them_if_they_leave_too_little_room() {
        let (below, above) = (face(-2e-4, 1.0, 0.0), face(2e-4, -1.0, 1e-4));
        assert!(find_pinching_face(&near([below, above])).is_none(), "0.3 mm are left");
        let nearer = face(2e-4, -1.0, 1.6e-4);
        assert_eq!(
            find_pinching_face(&near([below, nearer])).map(|face| face.group),
            Some(2),
            "0.24 mm are left"
        );
        assert_eq!(
            find_pinching_face(&near([nearer, below])).map(|face| face.group),
            Some(2),
            "in any order"
        );
        let beside = NearFace { direction: [1.0, 0.0, 0.0], ..nearer };
        assert!(find_pinching_face(&near([below, beside])).is_none(), "it can give way");
        // The two faces of a plate that cloth lies about.
        let (back, front) = (face(1e-4, 1.0, 0.0), face(-1e-4, -1.0, 0.0));
        assert!(find_pinching_face(&near([back, front])).is_none());
    }
}
