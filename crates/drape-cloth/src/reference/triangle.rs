//! Triangles of a rim, one by one: traction along warp and weft, and shear.

use drape_fabric::{Fabric, Law, Memory, ShearLaw, TractionLaw};

use crate::measure::block::{Matrix, identity, outer, sum, transposed};
use crate::measure::vector::{Vector, add, add_at, dot, scale, subtract, vector_at};
use crate::panel::lattice::Lattice;
use crate::reference::connector::commit_memory;

/// Traction and shear of a triangle.
#[derive(Debug, Clone)]
pub(crate) struct ReferenceTriangle {
    laws: [TractionLaw; 2],
    shear: ShearLaw,
    corners: [u32; 3],
    /// Material gradients of the corners along the warp and along the weft, in 1/m.
    gradients: [[f64; 3]; 2],
    area: f64,
    memories: [Memory; 2],
    shear_memory: Memory,
}

/// Lengths and directions of the columns of the deformation gradient, and the sine of the shear
/// angle.
struct Deformation {
    lengths: [f64; 2],
    units: [Vector; 2],
    sine: f64,
}

impl ReferenceTriangle {
    /// Returns the triangles of a panel whose first particle is `first`.
    pub(crate) fn of(lattice: &Lattice, fabric: &Fabric, first: u32) -> Vec<Self> {
        let triangles = lattice.rim.iter().map(|&corners| {
            let points = corners.map(|corner| lattice.coordinates[corner as usize]);
            let side = |k: usize| {
                let (from, to) = (points[(k + 1) % 3], points[(k + 2) % 3]);
                [to[0] - from[0], to[1] - from[1]]
            };
            let [a, b, c] = [0, 1, 2].map(side);
            let twice = a[0] * b[1] - a[1] * b[0];
            Self {
                laws: [fabric.warp.traction, fabric.weft.traction],
                shear: fabric.shear,
                corners: corners.map(|corner| first + corner),
                // The gradient of a corner is the opposite side rotated by 90°, over twice the
                // area.
                gradients: [
                    [a, b, c].map(|side| side[0] / twice),
                    [a, b, c].map(|side| -side[1] / twice),
                ],
                area: 0.5 * twice,
                memories: [Memory::default(); 2],
                shear_memory: Memory::default(),
            }
        });
        triangles.collect()
    }

    fn deformation(&self, positions: &[f64]) -> Deformation {
        let images = self.gradients.map(|gradients| {
            let terms = self.corners.iter().zip(gradients);
            terms.fold([0.0; 3], |sum, (&c, factor)| {
                add(sum, scale(vector_at(positions, c), factor))
            })
        });
        let lengths = images.map(|image| dot(image, image).sqrt());
        let units = [0, 1].map(|k| scale(images[k], 1.0 / lengths[k]));
        Deformation { lengths, units, sine: dot(units[0], units[1]) }
    }

    /// Returns the derivatives of the strains and of the sine with respect to a corner.
    fn derivatives(&self, shape: &Deformation, corner: usize) -> [Vector; 3] {
        let across = |k: usize| {
            let along = subtract(shape.units[1 - k], scale(shape.units[k], shape.sine));
            scale(along, self.gradients[k][corner] / shape.lengths[k])
        };
        let [warp, weft] = [0, 1].map(|k| scale(shape.units[k], self.gradients[k][corner]));
        [warp, weft, add(across(0), across(1))]
    }

    pub(crate) fn start(&mut self, positions: &[f64]) {
        let shape = self.deformation(positions);
        for (memory, length) in self.memories.iter_mut().zip(shape.lengths) {
            memory.position = length - 1.0;
            memory.peak = memory.position.max(0.0);
        }
        self.shear_memory.position = shape.sine;
        self.shear_memory.peak = shape.sine.abs();
    }

    pub(crate) fn add_forces(&self, positions: &[f64], forces: &mut [f64]) {
        let shape = self.deformation(positions);
        let load = |k: usize| self.laws[k].respond(&self.memories[k], shape.lengths[k] - 1.0).load;
        let loads = [load(0), load(1), self.shear.respond(&self.shear_memory, shape.sine).load];
        for (k, &corner) in self.corners.iter().enumerate() {
            for (derivative, load) in self.derivatives(&shape, k).into_iter().zip(loads) {
                add_at(forces, corner, scale(derivative, -self.area * load));
            }
        }
    }

    pub(crate) fn potential(&self, positions: &[f64]) -> f64 {
        let shape = self.deformation(positions);
        let work = |k: usize| self.laws[k].work(&self.memories[k], shape.lengths[k] - 1.0);
        self.area * (work(0) + work(1) + self.shear.work(&self.shear_memory, shape.sine))
    }

    pub(crate) fn add_stiffness(
        &self,
        positions: &[f64],
        definite: bool,
        put: &mut impl FnMut([u32; 2], Matrix),
    ) {
        let shape = self.deformation(positions);
        let least = |x: f64| if definite { x.max(0.0) } else { x };
        let yarns = [0, 1].map(|k| self.laws[k].respond(&self.memories[k], shape.lengths[k] - 1.0));
        let shear = self.shear.respond(&self.shear_memory, shape.sine);
        let load = if definite { 0.0 } else { shear.load };
        let across =
            |k: usize| sum([(1.0, identity()), (-1.0, outer(shape.units[k], shape.units[k]))]);
        // Second derivatives of the sine with respect to warp and weft, and to both.
        let bent = |k: usize| {
            let (own, length) = (shape.units[k], shape.lengths[k]);
            let gradient =
                scale(subtract(shape.units[1 - k], scale(own, shape.sine)), 1.0 / length);
            sum([
                (-1.0 / length, outer(gradient, own)),
                (-1.0 / length, outer(own, gradient)),
                (-shape.sine / (length * length), across(k)),
            ])
        };
        let (left, right) = (across(0), across(1));
        let product = [0, 1, 2].map(|i| [0, 1, 2].map(|j| dot(left[i], right[j])));
        let mixed = sum([(1.0 / (shape.lengths[0] * shape.lengths[1]), product)]);
        for i in 0..3 {
            for j in (0..3).filter(|&j| self.corners[i] <= self.corners[j]) {
                let (one, other) = (self.derivatives(&shape, i), self.derivatives(&shape, j));
                let factor = |k: usize, l: usize| self.gradients[k][i] * self.gradients[l][j];
                let yarn = |k: usize| {
                    let rotate = least(yarns[k].load) / shape.lengths[k] * factor(k, k);
                    sum([
                        (least(yarns[k].tangent), outer(one[k], other[k])),
                        (rotate, across(k)),
                        (load * factor(k, k), bent(k)),
                    ])
                };
                let block = sum([
                    (1.0, yarn(0)),
                    (1.0, yarn(1)),
                    (least(shear.tangent), outer(one[2], other[2])),
                    (load * factor(0, 1), mixed),
                    (load * factor(1, 0), transposed(mixed)),
                ]);
                put([self.corners[i], self.corners[j]], sum([(self.area, block)]));
            }
        }
    }

    pub(crate) fn commit(&mut self, positions: &[f64]) -> f64 {
        let shape = self.deformation(positions);
        let yarns = self.laws.iter().zip(&mut self.memories).zip(shape.lengths);
        let lost: f64 = yarns.map(|((law, memory), l)| commit_memory(law, memory, l - 1.0)).sum();
        self.area * (lost + commit_memory(&self.shear, &mut self.shear_memory, shape.sine))
    }
}
