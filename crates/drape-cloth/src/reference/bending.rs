use drape_fabric::{BendingLaw, Law, Memory};
use nalgebra::Matrix3;

use crate::pattern::{Pattern, Slot};
use crate::vector::{Vector, add, at};

/// Three consecutive particles of a yarn: the curvature vector
/// `$k = (x_a - 2x_c + x_b)/h^2$` at the middle one.
///
/// For segments of the rest length its size is Breen's `$2\cos(\theta/2)/h$` [Breen, House & Wozny
/// 1994, eq. 5.5] for every inner angle `$\theta$`; it needs no continuation for small angles,
/// because contact, not bending, keeps a folded yarn from closing.
///
/// The elastic moment acts along `$k - \kappa_0 n$`, out of the plane and in it alike, so that a
/// yarn cannot zigzag within the cloth for free; it is a function of a length and exerts no torque
/// on the cloth as a whole. The friction remembers the signed component `$\kappa = k\cdot n$` along
/// the surface normal `$n$` at the start of the step. That the normal turns within the step is
/// neglected in the gradient: the friction's part of the torque is off by the friction times the
/// component of `$k$` across `$n$`.
#[derive(Debug, Clone)]
pub(crate) struct Bending {
    pub(crate) law: BendingLaw,
    /// Before, in the middle, after.
    pub(crate) triples: Vec<[u32; 3]>,
    pub(crate) areas: Vec<f64>,
    /// `$1/h^2$`, in 1/m².
    inverse_square: f64,
    /// Blocks of the pairs aa, cc, bb, ac, cb, ab.
    slots: Vec<[Slot; 6]>,
}

/// Weights of the three particles in the second difference.
const WEIGHTS: [f64; 3] = [1.0, -2.0, 1.0];

impl Bending {
    pub(crate) fn new(law: BendingLaw, spacing: f64, triples: Vec<([u32; 3], f64)>) -> Self {
        let areas = triples.iter().map(|t| t.1).collect();
        let triples = triples.into_iter().map(|t| t.0).collect();
        let inverse_square = 1.0 / (spacing * spacing);
        Self {
            law,
            triples,
            areas,
            inverse_square,
            slots: Vec::new(),
        }
    }

    pub(crate) fn connect(&mut self, pattern: &Pattern) {
        let slots = |&[a, c, b]: &[u32; 3]| {
            [(a, a), (c, c), (b, b), (a, c), (c, b), (a, b)].map(|(i, j)| pattern.slot(i, j))
        };
        self.slots = self.triples.iter().map(slots).collect();
    }

    fn curvature(&self, index: usize, positions: &[f64]) -> Vector {
        let [before, middle, after] = self.triples[index].map(|p| at(positions, p));
        (before - 2.0 * middle + after) * self.inverse_square
    }

    fn normal(&self, index: usize, normals: &[f64]) -> Vector {
        at(normals, self.triples[index][1])
    }

    /// Curvature less the curvature at rest, which is along the normal.
    fn excess(&self, curvature: &Vector, normal: &Vector) -> Vector {
        curvature - self.law.rest_curvature * normal
    }

    /// Friction moment at a signed curvature and its slope.
    fn friction(&self, memory: &Memory, curvature: f64) -> (f64, f64) {
        self.law
            .friction
            .respond(memory.friction, curvature - memory.position)
    }

    pub(crate) fn add_forces(
        &self,
        (memory, normals): (&[Memory], &[f64]),
        positions: &[f64],
        forces: &mut [f64],
    ) {
        for (index, memory) in memory.iter().enumerate() {
            let normal = self.normal(index, normals);
            let curvature = self.curvature(index, positions);
            let excess = self.excess(&curvature, &normal);
            let size = excess.norm();
            let elastic = self.law.backbone.respond(size);
            let secant = if size > 0.0 {
                elastic.load / size
            } else {
                elastic.tangent
            };
            let (friction, _) = self.friction(memory, curvature.dot(&normal));
            let moment = secant * excess + friction * normal;
            let pull = moment * (self.areas[index] * self.inverse_square);
            for (particle, weight) in self.triples[index].into_iter().zip(WEIGHTS) {
                add(forces, particle, -weight * pull);
            }
        }
    }

    pub(crate) fn work(&self, (memory, normals): (&[Memory], &[f64]), positions: &[f64]) -> f64 {
        let work = |index: usize| {
            let normal = self.normal(index, normals);
            let curvature = self.curvature(index, positions);
            let elastic = self
                .law
                .backbone
                .energy(self.excess(&curvature, &normal).norm());
            let memory = &memory[index];
            let slip = curvature.dot(&normal) - memory.position;
            self.areas[index] * (elastic + self.law.friction.work(memory.friction, slip))
        };
        (0..self.triples.len()).map(work).sum()
    }

    pub(crate) fn add_stiffness(
        &self,
        (memory, normals): (&[Memory], &[f64]),
        positions: &[f64],
        definite: bool,
        values: &mut [f64],
    ) {
        for (index, memory) in memory.iter().enumerate() {
            let normal = self.normal(index, normals);
            let curvature = self.curvature(index, positions);
            let excess = self.excess(&curvature, &normal);
            let size = excess.norm();
            let elastic = self.law.backbone.respond(size);
            let (_, mut slope) = self.friction(memory, curvature.dot(&normal));
            if definite {
                slope = slope.max(0.0);
            }
            let mut block = slope * normal * normal.transpose();
            if size > 0.0 {
                let direction = excess / size;
                let secant = elastic.load / size;
                block += Matrix3::from_diagonal_element(secant)
                    + (elastic.tangent - secant) * direction * direction.transpose();
            } else {
                block += Matrix3::from_diagonal_element(elastic.tangent);
            }
            let block = block * (self.areas[index] * self.inverse_square * self.inverse_square);
            // Products of the weights for the pairs aa, cc, bb, ac, cb, ab.
            let factors = [1.0, 4.0, 1.0, -2.0, -2.0, 1.0];
            for (slot, factor) in self.slots[index].iter().zip(factors) {
                slot.add(values, &(block * factor));
            }
        }
    }

    /// Moves the memory on to the curvature along the new normals and returns the energy that the
    /// friction lost on the way, in J.
    pub(crate) fn commit(&self, memory: &mut [Memory], normals: &[f64], positions: &[f64]) -> f64 {
        let mut lost = 0.0;
        for (index, memory) in memory.iter_mut().enumerate() {
            let curvature = self
                .curvature(index, positions)
                .dot(&self.normal(index, normals));
            let slip = curvature - memory.position;
            lost += self.areas[index] * self.law.friction.dissipated(memory.friction, slip);
            *memory = self.law.commit(memory, curvature);
        }
        lost
    }

    /// Energy that the connectors can give back, in J.
    pub(crate) fn stored(&self, (memory, normals): (&[Memory], &[f64]), positions: &[f64]) -> f64 {
        let stored = |index: usize| {
            let curvature = self.curvature(index, positions);
            let excess = self.excess(&curvature, &self.normal(index, normals)).norm();
            let friction = self.law.friction.stored(memory[index].friction);
            self.areas[index] * (self.law.backbone.energy(excess) + friction)
        };
        (0..self.triples.len()).map(stored).sum()
    }

    /// Memories of a cloth that starts in the given shape without friction.
    pub(crate) fn start(&self, normals: &[f64], positions: &[f64]) -> Vec<Memory> {
        let memory = |index| {
            let position = self
                .curvature(index, positions)
                .dot(&self.normal(index, normals));
            Memory {
                position,
                friction: [0.0; 2],
                peak: position.abs(),
            }
        };
        (0..self.triples.len()).map(memory).collect()
    }
}
