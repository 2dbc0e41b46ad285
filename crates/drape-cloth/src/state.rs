use drape_fabric::{BatchLaw, Memories, Memory};

use crate::field::Field;
use crate::panel::Panel;
use crate::rim::{Course, Rim};

/// Where a cloth is and what its yarns remember: everything that changes in time.
///
/// Vectors are flat: particle `i` has the numbers `3i`, `3i + 1`, `3i + 2`. The memory is written by
/// [`Cloth::commit`](crate::Cloth::commit) alone.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// Positions of the particles, in m.
    pub positions: Vec<f64>,
    /// Velocities of the particles, in m/s.
    pub velocities: Vec<f64>,
    /// Unit normals of the surface at the particles.
    pub(crate) normals: Vec<f64>,
    /// What the yarns remember.
    pub(crate) history: History,
}

/// Memories of the connectors, and the normals that the bending was measured along, in columns: panel
/// after panel, each with its margins.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct History {
    /// Of the segments along the warp and the weft.
    pub(crate) traction: [Memories; 2],
    /// Of the four corners of the cells.
    pub(crate) shear: [Memories; 4],
    /// Of the triples along the warp and the weft.
    pub(crate) bending: [Memories; 2],
    /// Unit normals, as in [`State::normals`].
    pub(crate) normals: Field,
    pub(crate) rim: RimHistory,
}

/// Memories of the rims' connectors, rim after rim, each filled up to a whole number of batches.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct RimHistory {
    /// Of the triangles along the warp and the weft.
    pub(crate) traction: [Memories; 2],
    /// Of the triangles.
    pub(crate) shear: Memories,
    /// Of the stencils along the warp and the weft.
    pub(crate) bending: [Memories; 2],
}

/// The memories of some strips, to be moved on.
pub(crate) struct Moving<'a> {
    pub(crate) traction: [drape_fabric::MemoriesMut<'a>; 2],
    pub(crate) shear: [drape_fabric::MemoriesMut<'a>; 4],
    pub(crate) bending: [drape_fabric::MemoriesMut<'a>; 2],
}

impl History {
    /// Memories of virgin panels.
    pub(crate) fn new(panels: &[Panel], rims: &[Rim]) -> Self {
        let mut history = Self {
            traction: Default::default(),
            shear: Default::default(),
            bending: Default::default(),
            normals: Field::new(panels.iter().map(Panel::length).sum()),
            rim: RimHistory::default(),
        };
        for panel in panels {
            let length = panel.length();
            for (direction, yarns) in panel.yarns.iter().enumerate() {
                yarns.traction.append_memories(&mut history.traction[direction], length);
                yarns.bending.append_memories(&mut history.bending[direction], length);
            }
            for memories in &mut history.shear {
                panel.shear.append_memories(memories, length);
            }
        }
        for rim in rims {
            let panel = &panels[rim.panel];
            let (triangles, stencils) = (rim.triangles.areas.len(), rim.stencils.middles.len());
            for (direction, yarns) in panel.yarns.iter().enumerate() {
                yarns.traction.append_memories(&mut history.rim.traction[direction], triangles);
                yarns.bending.append_memories(&mut history.rim.bending[direction], stencils);
            }
            panel.shear.append_memories(&mut history.rim.shear, triangles);
        }
        history
    }

    /// All memories from a place on, to be moved on, and the normals.
    pub(crate) fn moving(&mut self, start: usize) -> (Moving<'_>, &Field) {
        let moving = Moving {
            traction: self.traction.each_mut().map(|m| m.from_mut(start)),
            shear: self.shear.each_mut().map(|m| m.from_mut(start)),
            bending: self.bending.each_mut().map(|m| m.from_mut(start)),
        };
        (moving, &self.normals)
    }
}

impl RimHistory {
    /// All memories, to be moved on.
    pub(crate) fn course(&mut self) -> Course<'_> {
        Course {
            traction: self.traction.each_mut().map(|m| m.from_mut(0)),
            shear: self.shear.from_mut(0),
            bending: self.bending.each_mut().map(|m| m.from_mut(0)),
        }
    }
}

impl Moving<'_> {
    /// The first `count` places and the others.
    pub(crate) fn split(self, count: usize) -> (Self, Self) {
        let ([a, b], [c, d, e, f], [g, h]) = (self.traction, self.shear, self.bending);
        let [a, b, c, d, e, f, g, h] = [a, b, c, d, e, f, g, h].map(|m| m.split(count));
        let head = Self { traction: [a.0, b.0], shear: [c.0, d.0, e.0, f.0], bending: [g.0, h.0] };
        let tail = Self { traction: [a.1, b.1], shear: [c.1, d.1, e.1, f.1], bending: [g.1, h.1] };
        (head, tail)
    }
}

impl State {
    /// Unit normals of the surface at the particles, along `$u \times v$`.
    #[must_use]
    pub fn normals(&self) -> &[f64] {
        &self.normals
    }

    /// All memories, for hashing and comparing, in a fixed order; those of rims come last. Where there is no connector, as at
    /// the end of a row, the memory is that of a virgin one.
    pub fn memories(&self) -> impl Iterator<Item = Memory> {
        let History { traction, shear, bending, rim, .. } = &self.history;
        let sets = traction.iter().chain(shear).chain(bending);
        let sets = sets.chain(&rim.traction).chain([&rim.shear]).chain(&rim.bending);
        sets.flat_map(Memories::iter)
    }
}
