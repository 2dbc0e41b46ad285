//! Cloth between two faces of bodies that close on it by more than its thickness.

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

/// Room between two faces, over the sum of the minimum separations from them, below which they
/// pinch cloth. At 1 the barriers of both would be infinite.
const CLOSED: f64 = 1.25;

/// Cosine of the angle between the directions from two faces to the cloth below which the cloth is
/// between them: 120°.
const OPPOSED: f64 = -0.5;

/// Distance over the minimum separation from which thinned cloth keeps all of it again: a usual
/// load presses it less, so that the barrier which returns adds little energy.
const REGAINED: f64 = 2.0;

/// Face of a body near a vertex of cloth.
#[derive(Debug, Clone, Copy)]
struct NearFace {
    group: u32,
    /// Unit direction from the face to the cloth.
    direction: Vector,
    /// Closest point of the face, in m.
    point: Vector,
    /// Displacement towards the cloth in the step, in m.
    approach: f64,
    /// Distance, in m.
    distance: f64,
    /// Minimum separation, in m.
    min_separation: f64,
}

/// Vertex of cloth with a face near it.
#[derive(Debug, Clone, Copy)]
struct VertexFace {
    vertex: u32,
    /// Place in the order of the active pairs.
    order: u32,
    face: NearFace,
}

/// Pinch states of the free vertices.
#[derive(Debug)]
pub(super) struct Pinch {
    pub(super) policy: PinchPolicy,
    /// States when the last step was committed; empty if all are free.
    pub(super) committed: Vec<PinchState>,
    /// States in the open step.
    pub(super) next: Vec<PinchState>,
    /// Faces near each vertex, sorted by vertex and order.
    faces: Vec<VertexFace>,
    /// Whether each vertex is still at or inside the body that was released.
    inside: Vec<bool>,
}

impl Pinch {
    /// No pinches yet.
    pub(super) fn new(policy: PinchPolicy) -> Pinch {
        let (committed, next) = (Vec::new(), Vec::new());
        Pinch { policy, committed, next, faces: Vec::new(), inside: Vec::new() }
    }

    /// Counts the vertices that bodies pinch since the last step.
    pub(super) fn count(&self) -> PinchedVertices {
        let of = |state| self.committed.iter().filter(|own| **own == state).count();
        let thinned = of(PinchState::Thinned);
        PinchedVertices { thinned, released: self.committed.len() - thinned - of(PinchState::Free) }
    }

    /// Returns whether a body passes through a vertex since the last step.
    pub(super) fn any_released(&self) -> bool {
        self.committed.iter().any(|state| matches!(state, PinchState::Released(_)))
    }

    /// Finds the states of an open step from its active pairs, without pinches, and from the
    /// intersections at its start.
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
            *state = match (*state, pinching(near), self.policy) {
                (PinchState::Released(group), _, _) if self.inside[vertex] => {
                    PinchState::Released(group)
                }
                (_, Some(face), PinchPolicy::Release) => PinchState::Released(face.group),
                (_, Some(_), _) => PinchState::Thinned,
                (PinchState::Thinned, None, _) if near.iter().any(|near| near.face.is_close()) => {
                    PinchState::Thinned
                }
                _ => PinchState::Free,
            };
        }
    }

    /// Finds the faces of bodies near each vertex of cloth.
    fn find_faces(&mut self, surface: &Surface, obstacles: &Obstacles, active: &ActivePairs) {
        let free = surface.free_count();
        let Obstacles { start, end, .. } = obstacles;
        self.faces.clear();
        for ActivePair { pair, gap } in active.iter() {
            let of_body = pair.vertices.map(|vertex| vertex as usize >= free);
            let Some(corner) = of_body.iter().position(|body| *body) else { continue };
            // The normal leads from the second to the first.
            let sign = if of_body[0] { -1.0 } else { 1.0 };
            let (mut point, mut displacement) = ([0.0; 3], [0.0; 3]);
            for (k, weight) in gap.weights().into_iter().enumerate().filter(|(k, _)| of_body[*k]) {
                let own = pair.vertices[k] as usize - free;
                point = add(point, scale(at(start, own), weight.abs()));
                let moved = subtract(at(end, own), at(start, own));
                displacement = add(displacement, scale(moved, weight.abs()));
            }
            let direction = scale(gap.normal(), sign);
            let [a, b] = [pair.vertices[0], pair.vertices[3]];
            let face = NearFace {
                group: surface.group(pair.vertices[corner]),
                direction,
                point,
                approach: dot(direction, displacement),
                distance: gap.distance(),
                min_separation: surface.pair_distances(a, b).min_separation,
            };
            for k in (0..4).filter(|&k| !of_body[k]) {
                let order = self.faces.len() as u32;
                self.faces.push(VertexFace { vertex: pair.vertices[k], order, face });
            }
        }
        self.faces.sort_unstable_by_key(|near| (near.vertex, near.order));
    }

    /// Finds the vertices that a released body has not left: they are near it or inside it, or a
    /// triangle at them intersects it.
    fn find_inside(
        &mut self,
        surface: &Surface,
        positions: &[f64],
        intersections: &[Intersection],
    ) {
        let Self { next, faces, inside, .. } = self;
        let released = |vertex: u32| match next.get(vertex as usize) {
            Some(PinchState::Released(group)) => Some(*group),
            _ => None,
        };
        inside.clear();
        inside.resize(next.len(), false);
        for intersection in intersections {
            let vertices = vertices_of(surface, *intersection);
            let crosses = |group| vertices.iter().any(|&other| surface.group(other) == group);
            for &vertex in vertices.iter().filter(|&&v| released(v).is_some_and(crosses)) {
                inside[vertex as usize] = true;
            }
        }
        for vertex in 0..next.len() as u32 {
            let Some(group) = released(vertex) else { continue };
            let near = faces_of(faces, vertex).iter().any(|near| near.face.group == group);
            let point = || at(positions, vertex as usize);
            if near || encloses(surface, group, point(), positions) {
                inside[vertex as usize] = true;
            }
        }
    }
}

/// Returns the vertices of an edge and a triangle that intersect.
pub(super) fn vertices_of(surface: &Surface, intersection: Intersection) -> [u32; 5] {
    let [a, b] = surface.edges()[intersection.edge as usize];
    let [c, d, e] = surface.triangles()[intersection.triangle as usize];
    [a, b, c, d, e]
}

/// Returns the faces near a vertex.
fn faces_of(faces: &[VertexFace], vertex: u32) -> &[VertexFace] {
    let first = faces.partition_point(|near| near.vertex < vertex);
    let count = faces[first..].partition_point(|near| near.vertex == vertex);
    &faces[first..first + count]
}

impl NearFace {
    /// Returns whether thinned cloth stays thinned near the face.
    fn is_close(&self) -> bool {
        !(self.distance > REGAINED * self.min_separation)
    }
}

/// Returns the face that approaches more in the step, of two that pinch cloth between them.
fn pinching(faces: &[VertexFace]) -> Option<NearFace> {
    for (k, VertexFace { face: one, .. }) in faces.iter().enumerate() {
        for VertexFace { face: other, .. } in &faces[k + 1..] {
            let opposed = dot(one.direction, other.direction) < OPPOSED;
            // Negative where the cloth lies about a body and not between two.
            let room = dot(subtract(other.point, one.point), one.direction);
            let left = room - one.approach - other.approach;
            if opposed && room > 0.0 && left < CLOSED * (one.min_separation + other.min_separation)
            {
                let first = (one.approach, one.group) > (other.approach, other.group);
                return Some(if first { *one } else { *other });
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

    fn near(faces: [NearFace; 2]) -> [VertexFace; 2] {
        faces.map(|face| VertexFace { vertex: 0, order: 0, face })
    }

    #[test]
    fn two_faces_pinch_cloth_between_them_if_they_leave_too_little_room() {
        let (below, above) = (face(-2e-4, 1.0, 0.0), face(2e-4, -1.0, 1e-4));
        assert!(pinching(&near([below, above])).is_none(), "0.3 mm are left");
        let nearer = face(2e-4, -1.0, 1.6e-4);
        assert_eq!(
            pinching(&near([below, nearer])).map(|face| face.group),
            Some(2),
            "0.24 mm are left"
        );
        assert_eq!(
            pinching(&near([nearer, below])).map(|face| face.group),
            Some(2),
            "in any order"
        );
        let beside = NearFace { direction: [1.0, 0.0, 0.0], ..nearer };
        assert!(pinching(&near([below, beside])).is_none(), "it can give way");
        // The two faces of a plate that cloth lies about.
        let (back, front) = (face(1e-4, 1.0, 0.0), face(-1e-4, -1.0, 0.0));
        assert!(pinching(&near([back, front])).is_none());
    }
}
