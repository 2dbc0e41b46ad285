//! Cloth between two faces of bodies that close on it more than it gives way.

use std::collections::{BTreeMap, BTreeSet};

use crate::surface::Surface;
use crate::surface_contact::{SurfaceContact, Touching};
use crate::vector::{Vector, add, at, dot, scale, subtract};

/// What becomes of cloth that bodies pinch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum PinchPolicy {
    /// Nothing: no step leads there.
    #[default]
    Error,
    /// There it keeps [`PinchPolicy::THINNED_FRACTION`] of the distance that it keeps from bodies elsewhere.
    Thin,
    /// There the body that comes passes through it, and touches it again when it has come out.
    Release,
}

/// Numbers of free vertices that bodies pinch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct PinchedVertices {
    /// Vertices that keep a fraction of their distances from bodies.
    pub thinned: usize,
    /// Vertices that have let a body through.
    pub released: usize,
}

/// How a vertex of cloth meets bodies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum Grip {
    /// As all do.
    #[default]
    Whole,
    /// It keeps a part of the distance only.
    Thin,
    /// It does not meet the body of this group.
    Released(u32),
}

/// Room between two faces, over twice the distance that cloth keeps from each, below which they pinch it. At 1 the
/// barriers of both would be infinite.
const CLOSED: f64 = 1.25;

/// Cosine between the directions from two faces to the cloth below which it is between them: 120°.
const OPPOSED: f64 = -0.5;

/// Distance, over the one that is kept, from which cloth that was thinned keeps all of it again: farther than a usual load
/// presses it, so that the barrier which comes back does not kick.
const REGAINED: f64 = 2.0;

/// A face of a body near a vertex of cloth, in m.
#[derive(Debug, Clone, Copy)]
struct Side {
    group: u32,
    /// From the face to the cloth, of length 1.
    direction: Vector,
    /// The point of the face.
    place: Vector,
    /// How far it comes nearer in the step.
    coming: f64,
    distance: f64,
    /// What is kept of that.
    min_separation: f64,
}

impl PinchPolicy {
    /// Part of the distance between cloth and bodies that cloth keeps where it is thinned.
    pub const THINNED_FRACTION: f64 = 0.1;
}

impl Surface {
    /// Part of its min_separation that a pair keeps, if it is kept apart at all.
    pub(crate) fn share(&self, vertices: &[u32]) -> Option<f64> {
        let free = |vertex: u32| (vertex as usize) < self.free_count();
        let body = vertices.iter().copied().find(|&vertex| !free(vertex));
        let (false, Some(body)) = (self.grips.is_empty(), body) else { return Some(1.0) };
        let group = self.group(body);
        let mut share = 1.0;
        for &vertex in vertices.iter().filter(|&&vertex| free(vertex)) {
            match self.grips[vertex as usize] {
                Grip::Thin => share = PinchPolicy::THINNED_FRACTION,
                Grip::Released(other) if other == group => return None,
                Grip::Whole | Grip::Released(_) => {}
            }
        }
        Some(share)
    }
}

impl SurfaceContact {
    /// Part of its distance from bodies that cloth keeps wherever they pinch it.
    pub fn thinned_fraction(&self) -> f64 {
        if self.settings.pinch == PinchPolicy::Thin { PinchPolicy::THINNED_FRACTION } else { 1.0 }
    }

    /// How many vertices of cloth keep less of their distance from bodies since the last step, and how many have let a
    /// body through.
    pub fn pinched_vertices(&self) -> PinchedVertices {
        let thinned = self.grips.iter().filter(|grip| **grip == Grip::Thin).count();
        let whole = self.grips.iter().filter(|grip| **grip == Grip::Whole).count();
        PinchedVertices { thinned, released: self.grips.len() - thinned - whole }
    }

    /// Finds what bodies pinch in the step that is open, and what they no longer do.
    pub(crate) fn grip(&mut self, start: &[f64]) {
        if self.settings.pinch == PinchPolicy::Error {
            return;
        }
        self.hold(Vec::new());
        self.look(start);
        if self.failure.is_some() {
            return;
        }
        let sides = self.sides();
        let mut grips = self.grips.clone();
        grips.resize(self.surface.free_count(), Grip::Whole);
        let caught = self.caught(start, (&grips, &sides));
        for (vertex, grip) in grips.iter_mut().enumerate() {
            let near = sides.get(&(vertex as u32)).map_or(&[][..], |sides| sides);
            *grip = match (*grip, pinching(near), self.settings.pinch) {
                (Grip::Released(group), _, _) if caught.contains(&(vertex as u32)) => {
                    Grip::Released(group)
                }
                (_, Some(side), PinchPolicy::Release) => Grip::Released(side.group),
                (_, Some(_), _) => Grip::Thin,
                (Grip::Thin, None, _) if near.iter().any(Side::is_close) => Grip::Thin,
                _ => Grip::Whole,
            };
        }
        self.hold(grips);
        self.look(start);
    }

    /// Puts other grips in place, for the next detection.
    pub(crate) fn hold(&mut self, mut grips: Vec<Grip>) {
        if grips.iter().all(|grip| *grip == Grip::Whole) {
            grips.clear();
        }
        if self.surface.grips != grips {
            self.surface.grips = grips;
            self.places.clear();
            self.detector.forget();
        }
    }

    /// The faces of bodies near each vertex of cloth.
    fn sides(&self) -> BTreeMap<u32, Vec<Side>> {
        let free = self.surface.free_count();
        let [start, end] = &self.bodies;
        let mut sides: BTreeMap<u32, Vec<Side>> = BTreeMap::new();
        for Touching { pair, gap } in self.touching() {
            let of_body = pair.vertices.map(|vertex| vertex as usize >= free);
            let Some(corner) = of_body.iter().position(|body| *body) else { continue };
            // The normal goes from the second to the first.
            let sign = if of_body[0] { -1.0 } else { 1.0 };
            let (mut place, mut way) = ([0.0; 3], [0.0; 3]);
            for (k, weight) in gap.weights().into_iter().enumerate().filter(|(k, _)| of_body[*k]) {
                let own = pair.vertices[k] as usize - free;
                place = add(place, scale(at(start, own), weight.abs()));
                way = add(way, scale(subtract(at(end, own), at(start, own)), weight.abs()));
            }
            let direction = scale(gap.normal(), sign);
            let group = self.surface.group(pair.vertices[corner]);
            let [a, b] = [pair.vertices[0], pair.vertices[3]];
            let side = Side {
                group,
                direction,
                place,
                coming: dot(direction, way),
                distance: gap.distance(),
                min_separation: self.surface.pair_distances(a, b).min_separation,
            };
            for k in (0..4).filter(|&k| !of_body[k]) {
                sides.entry(pair.vertices[k]).or_default().push(side);
            }
        }
        sides
    }

    /// The vertices that were released from a body and are not yet out of it: they are near it or in it, or a triangle
    /// at them crosses it.
    fn caught(
        &self,
        start: &[f64],
        (grips, sides): (&[Grip], &BTreeMap<u32, Vec<Side>>),
    ) -> BTreeSet<u32> {
        let released = |vertex: u32| match grips.get(vertex as usize) {
            Some(Grip::Released(group)) => Some(*group),
            _ => None,
        };
        let mut caught = BTreeSet::new();
        if !grips.iter().any(|grip| matches!(grip, Grip::Released(_))) {
            return caught;
        }
        for crossing in self.intersections_with_released(start).unwrap_or_default() {
            let vertices = self.vertices_of(crossing);
            let of = |vertex: u32| self.surface.group(vertex);
            let crosses = |group| vertices.iter().any(|&other| of(other) == group);
            caught.extend(vertices.iter().filter(|&&v| released(v).is_some_and(crosses)));
        }
        for vertex in 0..grips.len() as u32 {
            let Some(group) = released(vertex) else { continue };
            let near = sides.get(&vertex).is_some_and(|s| s.iter().any(|side| side.group == group));
            if near || self.surface.encloses(group, at(&self.places, vertex as usize), &self.places)
            {
                caught.insert(vertex);
            }
        }
        caught
    }
}

impl Side {
    fn is_close(&self) -> bool {
        !(self.distance > REGAINED * self.min_separation)
    }
}

/// The face that comes nearest in the step, of two that pinch cloth between them.
fn pinching(sides: &[Side]) -> Option<Side> {
    for (k, one) in sides.iter().enumerate() {
        for other in &sides[k + 1..] {
            let opposed = dot(one.direction, other.direction) < OPPOSED;
            // Less than nothing where the cloth is about a body and not between two.
            let room = dot(subtract(other.place, one.place), one.direction);
            let left = room - one.coming - other.coming;
            if opposed && room > 0.0 && left < CLOSED * (one.min_separation + other.min_separation)
            {
                let first = (one.coming, one.group) > (other.coming, other.group);
                return Some(if first { *one } else { *other });
            }
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn side(height: f64, direction: f64, coming: f64) -> Side {
        Side {
            group: if direction > 0.0 { 1 } else { 2 },
            direction: [0.0, direction, 0.0],
            place: [0.0, height, 0.0],
            coming,
            distance: height.abs(),
            min_separation: 1e-4,
        }
    }

    #[test]
    fn two_faces_pinch_what_is_between_them_if_they_leave_too_little_room() {
        let (below, above) = (side(-2e-4, 1.0, 0.0), side(2e-4, -1.0, 1e-4));
        assert!(pinching(&[below, above]).is_none(), "0.3 mm are left");
        let nearer = side(2e-4, -1.0, 1.6e-4);
        assert_eq!(pinching(&[below, nearer]).map(|side| side.group), Some(2), "0.24 mm are left");
        assert_eq!(pinching(&[nearer, below]).map(|side| side.group), Some(2), "in any order");
        let beside = Side { direction: [1.0, 0.0, 0.0], ..nearer };
        assert!(pinching(&[below, beside]).is_none(), "it can give way");
        // The two faces of a plate that cloth lies about.
        let (back, front) = (side(1e-4, 1.0, 0.0), side(-1e-4, -1.0, 0.0));
        assert!(pinching(&[back, front]).is_none());
    }
}
