//! Triangles of a rim, one by one: traction along warp and weft, and shear.

use drape_fabric::{Fabric, Law, Memory, ShearLaw, TractionLaw};

use crate::measure::block::{Matrix, outer, sum, transposed};
use crate::measure::vector::{Vector, add, add_at, dot, scale, subtract, vector_at};
use crate::panel::lattice::Lattice;
use crate::reference::connector::{across, commit_memory};

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
    /// Returns the triangles of a panel in `fabric` whose first particle is `first`.
    pub(crate) fn for_panel(lattice: &Lattice, fabric: &Fabric, first: u32) -> Vec<Self> {
        let triangles = lattice.rim.iter().map(|&corners| {
            let points = corners.map(|corner| lattice.coordinates[corner as usize]);
            let [a, b, c] = [0, 1, 2].map(|k: usize| {
                let (from, to) = (points[(k + 1) % 3], points[(k + 2) % 3]);
                [to[0] - from[0], to[1] - from[1]]
            });
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

    /// Returns the derivatives of the strains and of the sine with respect to `corner`.
    fn derivatives(&self, shape: &Deformation, corner: usize) -> [Vector; 3] {
        let [warp_turn, weft_turn] = [0, 1].map(|k| {
            let along = subtract(shape.units[1 - k], scale(shape.units[k], shape.sine));
            scale(along, self.gradients[k][corner] / shape.lengths[k])
        });
        let [warp, weft] = [0, 1].map(|k| scale(shape.units[k], self.gradients[k][corner]));
        [warp, weft, add(warp_turn, weft_turn)]
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
        let [warp, weft] =
            [0, 1].map(|k| self.laws[k].respond(&self.memories[k], shape.lengths[k] - 1.0).load);
        let loads = [warp, weft, self.shear.respond(&self.shear_memory, shape.sine).load];
        for (k, &corner) in self.corners.iter().enumerate() {
            for (derivative, load) in self.derivatives(&shape, k).into_iter().zip(loads) {
                add_at(forces, corner, scale(derivative, -self.area * load));
            }
        }
    }

    pub(crate) fn potential(&self, positions: &[f64]) -> f64 {
        let shape = self.deformation(positions);
        let [warp, weft] =
            [0, 1].map(|k| self.laws[k].work(&self.memories[k], shape.lengths[k] - 1.0));
        self.area * (warp + weft + self.shear.work(&self.shear_memory, shape.sine))
    }

    pub(crate) fn add_stiffness(
        &self,
        positions: &[f64],
        definite: bool,
        put: &mut impl FnMut([u32; 2], Matrix),
    ) {
        let shape = self.deformation(positions);
        let yarns = [0, 1].map(|k| {
            let response = self.laws[k].respond(&self.memories[k], shape.lengths[k] - 1.0);
            let (load, tangent) = (response.load, response.tangent);
            if definite { (load.max(0.0), tangent.max(0.0)) } else { (load, tangent) }
        });
        let shear = self.shear.respond(&self.shear_memory, shape.sine);
        let shear_tangent = if definite { shear.tangent.max(0.0) } else { shear.tangent };
        let load = if definite { 0.0 } else { shear.load };

        // Second derivatives of the sine with respect to warp and weft, and to both.
        let bent = [0, 1].map(|k| {
            let (unit, length) = (shape.units[k], shape.lengths[k]);
            let gradient =
                scale(subtract(shape.units[1 - k], scale(unit, shape.sine)), 1.0 / length);
            sum([
                (-1.0 / length, outer(gradient, unit)),
                (-1.0 / length, outer(unit, gradient)),
                (-shape.sine / (length * length), across(unit)),
            ])
        });
        let (left, right) = (across(shape.units[0]), across(shape.units[1]));
        let product = [0, 1, 2].map(|i| [0, 1, 2].map(|j| dot(left[i], right[j])));
        let mixed = sum([(1.0 / (shape.lengths[0] * shape.lengths[1]), product)]);

        // By the chain rule, each pair of corners takes them with its material gradients.
        for i in 0..3 {
            for j in (0..3).filter(|&j| self.corners[i] <= self.corners[j]) {
                let (row, column) = (self.derivatives(&shape, i), self.derivatives(&shape, j));
                let [warp, weft] = [0, 1].map(|k| {
                    let factor = self.gradients[k][i] * self.gradients[k][j];
                    let (yarn_load, yarn_tangent) = yarns[k];
                    let rotate = yarn_load / shape.lengths[k] * factor;
                    sum([
                        (yarn_tangent, outer(row[k], column[k])),
                        (rotate, across(shape.units[k])),
                        (load * factor, bent[k]),
                    ])
                });
                let block = sum([
                    (1.0, warp),
                    (1.0, weft),
                    (shear_tangent, outer(row[2], column[2])),
                    (load * (self.gradients[0][i] * self.gradients[1][j]), mixed),
                    (load * (self.gradients[1][i] * self.gradients[0][j]), transposed(mixed)),
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
