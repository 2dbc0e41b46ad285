//! The connectors of a rim, one by one.

use drape_fabric::{BendingLaw, Fabric, Law, Memory, ShearLaw, TractionLaw};

use super::bend::{bend, curvature, folded};
use super::block::{Block, one, outer, sum, transposed};
use super::{at, move_on, push};
use crate::Lattice;
use crate::connectors::Bending;
use crate::field::{Vector, add, dot, scale, subtract};
use crate::rim::{Near, fits};

/// Traction and shear of a triangle.
#[derive(Debug, Clone)]
pub(super) struct Membrane {
    laws: [TractionLaw; 2],
    shear: ShearLaw,
    corners: [u32; 3],
    /// Material gradients of the corners along the warp and along the weft, in 1/m.
    gradients: [[f64; 3]; 2],
    area: f64,
    memories: [Memory; 2],
    sheared: Memory,
}

/// How a triangle is deformed.
struct Deformed {
    lengths: [f64; 2],
    units: [Vector; 2],
    sine: f64,
}

impl Membrane {
    pub(super) fn of(lattice: &Lattice, fabric: &Fabric, first: u32) -> Vec<Self> {
        let triangles = lattice.rim.iter().map(|&corners| {
            let places = corners.map(|corner| lattice.coordinates[corner as usize]);
            let side = |k: usize| {
                let (from, to) = (places[(k + 1) % 3], places[(k + 2) % 3]);
                [to[0] - from[0], to[1] - from[1]]
            };
            let [a, b, c] = [0, 1, 2].map(side);
            let twice = a[0] * b[1] - a[1] * b[0];
            Self {
                laws: [fabric.warp.traction, fabric.weft.traction],
                shear: fabric.shear,
                corners: corners.map(|corner| first + corner),
                // A corner's gradient is the opposite side turned by a quarter, over twice the area.
                gradients: [
                    [a, b, c].map(|side| side[0] / twice),
                    [a, b, c].map(|side| -side[1] / twice),
                ],
                area: 0.5 * twice,
                memories: [Memory::default(); 2],
                sheared: Memory::default(),
            }
        });
        triangles.collect()
    }

    fn deformed(&self, positions: &[f64]) -> Deformed {
        let ways = self.gradients.map(|gradients| {
            let parts = self.corners.iter().zip(gradients);
            parts.fold([0.0; 3], |way, (&c, factor)| add(way, scale(at(positions, c), factor)))
        });
        let lengths = ways.map(|way| dot(way, way).sqrt());
        let units = [0, 1].map(|k| scale(ways[k], 1.0 / lengths[k]));
        Deformed { lengths, units, sine: dot(units[0], units[1]) }
    }

    /// Derivatives of the strains and of the sine with respect to a corner.
    fn derivatives(&self, shape: &Deformed, corner: usize) -> [Vector; 3] {
        let across = |k: usize| {
            let along = subtract(shape.units[1 - k], scale(shape.units[k], shape.sine));
            scale(along, self.gradients[k][corner] / shape.lengths[k])
        };
        let [warp, weft] = [0, 1].map(|k| scale(shape.units[k], self.gradients[k][corner]));
        [warp, weft, add(across(0), across(1))]
    }

    pub(super) fn start(&mut self, positions: &[f64]) {
        let shape = self.deformed(positions);
        for (memory, length) in self.memories.iter_mut().zip(shape.lengths) {
            memory.position = length - 1.0;
            memory.peak = memory.position.max(0.0);
        }
        self.sheared.position = shape.sine;
        self.sheared.peak = shape.sine.abs();
    }

    pub(super) fn add_forces(&self, positions: &[f64], forces: &mut [f64]) {
        let shape = self.deformed(positions);
        let load = |k: usize| self.laws[k].respond(&self.memories[k], shape.lengths[k] - 1.0).load;
        let loads = [load(0), load(1), self.shear.respond(&self.sheared, shape.sine).load];
        for (k, &corner) in self.corners.iter().enumerate() {
            for (derivative, load) in self.derivatives(&shape, k).into_iter().zip(loads) {
                push(forces, corner, scale(derivative, -self.area * load));
            }
        }
    }

    pub(super) fn potential(&self, positions: &[f64]) -> f64 {
        let shape = self.deformed(positions);
        let work = |k: usize| self.laws[k].work(&self.memories[k], shape.lengths[k] - 1.0);
        self.area * (work(0) + work(1) + self.shear.work(&self.sheared, shape.sine))
    }

    pub(super) fn add_stiffness(
        &self,
        positions: &[f64],
        definite: bool,
        put: &mut impl FnMut([u32; 2], Block),
    ) {
        let shape = self.deformed(positions);
        let least = |x: f64| if definite { x.max(0.0) } else { x };
        let yarns = [0, 1].map(|k| self.laws[k].respond(&self.memories[k], shape.lengths[k] - 1.0));
        let shear = self.shear.respond(&self.sheared, shape.sine);
        let load = if definite { 0.0 } else { shear.load };
        let across = |k: usize| sum([(1.0, one()), (-1.0, outer(shape.units[k], shape.units[k]))]);
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
                    let turn = least(yarns[k].load) / shape.lengths[k] * factor(k, k);
                    sum([
                        (least(yarns[k].tangent), outer(one[k], other[k])),
                        (turn, across(k)),
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

    pub(super) fn commit(&mut self, positions: &[f64]) -> f64 {
        let shape = self.deformed(positions);
        let yarns = self.laws.iter().zip(&mut self.memories).zip(shape.lengths);
        let lost: f64 = yarns.map(|((law, memory), l)| move_on(law, memory, l - 1.0)).sum();
        self.area * (lost + move_on(&self.shear, &mut self.sheared, shape.sine))
    }
}

/// Bending of a neighbourhood along one yarn.
#[derive(Debug, Clone)]
pub(super) struct Fitted {
    law: BendingLaw,
    middle: u32,
    /// Particles with their weights in the bow, in 1/m².
    parts: Vec<(u32, f64)>,
    length: f64,
    area: f64,
    /// What folds add to the rest curvature, in 1/m.
    fold: f64,
    memory: Memory,
}

impl Fitted {
    pub(super) fn of(
        (lattice, near, bending): (&Lattice, &Near<'_>, &[Bending; 2]),
        fabric: &Fabric,
        first: u32,
    ) -> Vec<Self> {
        let [across, along] = lattice.spacing;
        let sides = [(fabric.warp.bending, along), (fabric.weft.bending, across)];
        let mut all = Vec::new();
        for stencil in fits(lattice, near, bending).0 {
            for (direction, (law, length)) in sides.into_iter().enumerate() {
                let parts = stencil.parts.iter();
                let parts =
                    parts.map(|part| (first + part.node, part.weights[direction])).collect();
                all.push(Self {
                    law,
                    middle: first + stencil.middle,
                    parts,
                    length,
                    area: stencil.areas[direction],
                    fold: stencil.folds[direction],
                    memory: Memory::default(),
                });
            }
        }
        all.retain(|fitted| fitted.area > 0.0);
        all
    }

    fn bow(&self, positions: &[f64]) -> Vector {
        let parts = self.parts.iter();
        parts.fold([0.0; 3], |bow, &(node, weight)| add(bow, scale(at(positions, node), weight)))
    }

    fn bend(&self, (positions, normals): (&[f64], &[f64]), definite: bool) -> (Vector, Block, f64) {
        let bow = (self.bow(positions), at(normals, self.middle));
        let law = (&self.law, &self.memory);
        if self.fold != 0.0 {
            return folded(law, bow, (self.length, self.fold), definite);
        }
        bend(law, bow, self.length, definite)
    }

    fn curvature(&self, positions: &[f64], normals: &[f64]) -> f64 {
        curvature(self.bow(positions), at(normals, self.middle), self.length)
    }

    pub(super) fn start(&mut self, positions: &[f64], normals: &[f64]) {
        self.memory.position = self.curvature(positions, normals);
        self.memory.peak = self.memory.position.abs();
    }

    pub(super) fn add_forces(&self, positions: &[f64], normals: &[f64], forces: &mut [f64]) {
        let (moment, ..) = self.bend((positions, normals), false);
        for &(node, weight) in &self.parts {
            push(forces, node, scale(moment, -self.area * weight));
        }
    }

    pub(super) fn potential(&self, positions: &[f64], normals: &[f64]) -> f64 {
        self.area * self.bend((positions, normals), false).2
    }

    pub(super) fn add_stiffness(
        &self,
        shape: (&[f64], &[f64]),
        definite: bool,
        put: &mut impl FnMut([u32; 2], Block),
    ) {
        let (_, block, _) = self.bend(shape, definite);
        for (k, &(node, weight)) in self.parts.iter().enumerate() {
            for &(other, factor) in &self.parts[k..] {
                put([node, other], sum([(self.area * weight * factor, block)]));
            }
        }
    }

    pub(super) fn commit(&mut self, positions: &[f64], normals: &[f64]) -> f64 {
        let curvature = self.curvature(positions, normals);
        self.area * move_on(&self.law, &mut self.memory, curvature)
    }
}
