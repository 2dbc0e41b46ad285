use drape_fabric::{Law, Memory, TractionLaw};
use nalgebra::Matrix3;

use crate::pattern::{Pattern, Slot};
use crate::vector::{Vector, add, at};

/// Yarn segments of one direction: the strain of an edge, `$\varepsilon = |x_b - x_a|/L - 1$`.
#[derive(Debug, Clone)]
pub(crate) struct Traction {
    pub(crate) law: TractionLaw,
    pub(crate) ends: Vec<[u32; 2]>,
    pub(crate) lengths: Vec<f64>,
    pub(crate) areas: Vec<f64>,
    /// Blocks of the pairs aa, bb, ab.
    slots: Vec<[Slot; 3]>,
}

/// Strain of a segment and its direction.
struct Segment {
    strain: f64,
    direction: Vector,
    length: f64,
}

impl Traction {
    pub(crate) fn new(law: TractionLaw, edges: Vec<([u32; 2], f64, f64)>) -> Self {
        let ends = edges.iter().map(|e| e.0).collect();
        let lengths = edges.iter().map(|e| e.1).collect();
        let areas = edges.iter().map(|e| e.2).collect();
        Self {
            law,
            ends,
            lengths,
            areas,
            slots: Vec::new(),
        }
    }

    pub(crate) fn connect(&mut self, pattern: &Pattern) {
        let slots =
            |&[a, b]: &[u32; 2]| [pattern.slot(a, a), pattern.slot(b, b), pattern.slot(a, b)];
        self.slots = self.ends.iter().map(slots).collect();
    }

    fn segment(&self, index: usize, positions: &[f64]) -> Segment {
        let [a, b] = self.ends[index];
        let span = at(positions, b) - at(positions, a);
        let length = span.norm();
        // A segment of no length has no direction; it then carries no force.
        let direction = if length > 0.0 { span / length } else { span };
        Segment {
            strain: length / self.lengths[index] - 1.0,
            direction,
            length,
        }
    }

    pub(crate) fn strain(&self, index: usize, positions: &[f64]) -> f64 {
        self.segment(index, positions).strain
    }

    pub(crate) fn add_forces(&self, memory: &[Memory], positions: &[f64], forces: &mut [f64]) {
        for (index, memory) in memory.iter().enumerate() {
            let segment = self.segment(index, positions);
            let load = self.law.respond(memory, segment.strain).load;
            let pull = segment.direction * (load * self.areas[index] / self.lengths[index]);
            let [a, b] = self.ends[index];
            add(forces, a, pull);
            add(forces, b, -pull);
        }
    }

    pub(crate) fn work(&self, memory: &[Memory], positions: &[f64]) -> f64 {
        let work = |index: usize| {
            self.areas[index] * self.law.work(&memory[index], self.strain(index, positions))
        };
        (0..self.ends.len()).map(work).sum()
    }

    pub(crate) fn add_stiffness(
        &self,
        memory: &[Memory],
        positions: &[f64],
        definite: bool,
        values: &mut [f64],
    ) {
        for (index, memory) in memory.iter().enumerate() {
            let Segment {
                strain,
                direction,
                length,
            } = self.segment(index, positions);
            let response = self.law.respond(memory, strain);
            let rest = self.lengths[index];
            let mut along = response.tangent / (rest * rest);
            let mut across = if length > 0.0 {
                response.load / (rest * length)
            } else {
                0.0
            };
            if definite {
                (along, across) = (along.max(0.0), across.max(0.0));
            }
            let block = Matrix3::from_diagonal_element(across)
                + (along - across) * direction * direction.transpose();
            let block = block * self.areas[index];
            let [aa, bb, ab] = self.slots[index];
            aa.add(values, &block);
            bb.add(values, &block);
            ab.add(values, &-block);
        }
    }

    /// Moves the memory on and returns the energy lost on the way, in J.
    pub(crate) fn commit(&self, memory: &mut [Memory], positions: &[f64]) -> f64 {
        let mut lost = 0.0;
        for (index, memory) in memory.iter_mut().enumerate() {
            let strain = self.strain(index, positions);
            let after = self.law.commit(memory, strain);
            let gained = self.law.stored(&after) - self.law.stored(memory);
            lost += self.areas[index] * (self.law.work(memory, strain) - gained);
            *memory = after;
        }
        lost
    }

    pub(crate) fn stored(&self, memory: &[Memory]) -> f64 {
        memory
            .iter()
            .zip(&self.areas)
            .map(|(m, area)| area * self.law.stored(m))
            .sum()
    }

    /// Memories of a cloth that starts in the given shape without friction.
    pub(crate) fn start(&self, positions: &[f64]) -> Vec<Memory> {
        let memory = |index| {
            let position = self.strain(index, positions);
            Memory {
                position,
                friction: [0.0; 2],
                peak: position.max(0.0),
            }
        };
        (0..self.ends.len()).map(memory).collect()
    }
}
