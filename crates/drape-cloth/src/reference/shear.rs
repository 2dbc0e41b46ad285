use drape_fabric::{Law, Memory, ShearLaw};
use nalgebra::Matrix3;

use crate::pattern::{Pattern, Slot};
use crate::vector::{Vector, add, at};

/// Corners of cells: the sine of the shear angle between the warp and the weft edge there,
/// `$s = \pm\hat e_{warp}\cdot\hat e_{weft}$`, signed so that the four corners of a cell agree.
#[derive(Debug, Clone)]
pub(crate) struct Shear {
    pub(crate) law: ShearLaw,
    /// The corner's particle, its neighbour along the warp and its neighbour along the weft.
    pub(crate) corners: Vec<[u32; 3]>,
    signs: Vec<f64>,
    pub(crate) areas: Vec<f64>,
    /// Blocks of the pairs cc, pp, ff, cp, cf, pf (corner, warp, weft).
    slots: Vec<[Slot; 6]>,
}

/// Sine at a corner with the edges it is made of.
struct Corner {
    sine: f64,
    warp: Vector,
    weft: Vector,
    warp_length: f64,
    weft_length: f64,
}

impl Corner {
    /// Gradients of the sine with respect to the neighbours along the warp and the weft.
    fn gradients(&self, sign: f64) -> [Vector; 2] {
        let cosine = sign * self.sine;
        [
            (self.weft - cosine * self.warp) * (sign / self.warp_length),
            (self.warp - cosine * self.weft) * (sign / self.weft_length),
        ]
    }
}

impl Shear {
    pub(crate) fn new(law: ShearLaw, corners: Vec<([u32; 3], f64, f64)>) -> Self {
        let signs = corners.iter().map(|c| c.1).collect();
        let areas = corners.iter().map(|c| c.2).collect();
        let corners = corners.into_iter().map(|c| c.0).collect();
        Self {
            law,
            corners,
            signs,
            areas,
            slots: Vec::new(),
        }
    }

    pub(crate) fn connect(&mut self, pattern: &Pattern) {
        let slots = |&[c, p, f]: &[u32; 3]| {
            [(c, c), (p, p), (f, f), (c, p), (c, f), (p, f)].map(|(a, b)| pattern.slot(a, b))
        };
        self.slots = self.corners.iter().map(slots).collect();
    }

    fn corner(&self, index: usize, positions: &[f64]) -> Corner {
        let [centre, warp, weft] = self.corners[index].map(|particle| at(positions, particle));
        let (warp, weft) = (warp - centre, weft - centre);
        // An edge of no length has no direction: the smallest number stands in for its length.
        let warp_length = warp.norm().max(f64::MIN_POSITIVE);
        let weft_length = weft.norm().max(f64::MIN_POSITIVE);
        let (warp, weft) = (warp / warp_length, weft / weft_length);
        let sine = self.signs[index] * warp.dot(&weft);
        Corner {
            sine,
            warp,
            weft,
            warp_length,
            weft_length,
        }
    }

    pub(crate) fn sine(&self, index: usize, positions: &[f64]) -> f64 {
        self.corner(index, positions).sine
    }

    pub(crate) fn add_forces(&self, memory: &[Memory], positions: &[f64], forces: &mut [f64]) {
        for (index, memory) in memory.iter().enumerate() {
            let corner = self.corner(index, positions);
            let load = self.areas[index] * self.law.respond(memory, corner.sine).load;
            let [warp, weft] = corner.gradients(self.signs[index]);
            let [c, p, f] = self.corners[index];
            add(forces, p, -load * warp);
            add(forces, f, -load * weft);
            add(forces, c, load * (warp + weft));
        }
    }

    pub(crate) fn work(&self, memory: &[Memory], positions: &[f64]) -> f64 {
        let work = |index: usize| {
            self.areas[index] * self.law.work(&memory[index], self.sine(index, positions))
        };
        (0..self.corners.len()).map(work).sum()
    }

    pub(crate) fn add_stiffness(
        &self,
        memory: &[Memory],
        positions: &[f64],
        definite: bool,
        values: &mut [f64],
    ) {
        for (index, memory) in memory.iter().enumerate() {
            let corner = self.corner(index, positions);
            let response = self.law.respond(memory, corner.sine);
            let sign = self.signs[index];
            let [warp, weft] = corner.gradients(sign);
            let area = self.areas[index];
            let tangent = area
                * if definite {
                    response.tangent.max(0.0)
                } else {
                    response.tangent
                };
            let mut pp = tangent * warp * warp.transpose();
            let mut ff = tangent * weft * weft.transpose();
            let mut pf = tangent * warp * weft.transpose();
            if !definite {
                // Second derivatives of the cosine of the angle between two vectors.
                let load = area * response.load;
                let cosine = sign * corner.sine;
                let across = |e: &Vector| Matrix3::identity() - e * e.transpose();
                let turn = |e: &Vector, gradient: &Vector, length: f64| {
                    let mixed = gradient * e.transpose();
                    -(mixed + mixed.transpose()) / length
                        - across(e) * (sign * cosine / (length * length))
                };
                pp += load * turn(&corner.warp, &warp, corner.warp_length);
                ff += load * turn(&corner.weft, &weft, corner.weft_length);
                pf += across(&corner.warp)
                    * across(&corner.weft)
                    * (load * sign / (corner.warp_length * corner.weft_length));
            }
            let cp = -(pp + pf.transpose());
            let cf = -(pf + ff);
            let cc = -(cp + cf);
            let blocks = [cc, pp, ff, cp, cf, pf];
            self.slots[index]
                .iter()
                .zip(&blocks)
                .for_each(|(slot, b)| slot.add(values, b));
        }
    }

    /// Moves the memory on and returns the energy lost on the way, in J.
    pub(crate) fn commit(&self, memory: &mut [Memory], positions: &[f64]) -> f64 {
        let mut lost = 0.0;
        for (index, memory) in memory.iter_mut().enumerate() {
            let sine = self.sine(index, positions);
            let after = self.law.commit(memory, sine);
            let gained = self.law.stored(&after) - self.law.stored(memory);
            lost += self.areas[index] * (self.law.work(memory, sine) - gained);
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
            let position = self.sine(index, positions);
            Memory {
                position,
                friction: [0.0; 2],
                peak: position.abs(),
            }
        };
        (0..self.corners.len()).map(memory).collect()
    }
}
