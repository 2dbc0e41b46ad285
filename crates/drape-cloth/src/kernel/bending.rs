#![allow(clippy::needless_range_loop, reason = "a lane is a place in many arrays")]

use drape_fabric::{BatchLaw, BendingBackbone, LANES, Lanes, MemoryBatch, Responses};

use crate::angle::Angle;
use crate::field::{Batch, Vector, add, dot, scale, set, subtract};
use crate::fold::Crease;
use crate::panel::Yarns;

/// Upper half of a symmetric block: xx, xy, xz, yy, yz, zz.
pub(crate) const HALF: [(usize, usize); 6] = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)];

/// Bows of a batch, in m⁻¹.
pub(crate) struct Bows(pub(crate) [Lanes; 3]);

impl Bows {
    #[inline(always)]
    pub(crate) fn at(&self, lane: usize) -> Vector {
        [self.0[0][lane], self.0[1][lane], self.0[2][lane]]
    }
}

/// Curvatures of a batch about the normals, in m⁻¹, and their first and second derivatives with respect to the bow.
#[derive(Default)]
pub(crate) struct Bends {
    pub(crate) curvature: Lanes,
    pub(crate) slope: Lanes,
    pub(crate) slope_change: Lanes,
}

/// Bending connectors of one direction side by side: how they bow, the normals at the start of the step, and their
/// areas. Those that do not exist have an area of zero.
pub(crate) struct Bend<'a> {
    pub(crate) yarns: &'a Yarns,
    pub(crate) bows: Bows,
    pub(crate) normals: Batch<'a, 3>,
    pub(crate) areas: &'a Lanes,
    /// What folds add to their rest curvatures, in 1/m, if there are some.
    pub(crate) folds: Option<&'a Lanes>,
}

impl Bend<'_> {
    /// Curvatures about the normals, and how they follow from the bows; of connectors that do not exist, zero.
    #[inline(always)]
    pub(crate) fn bends(&self) -> Bends {
        let mut bends = Bends::default();
        for lane in 0..LANES {
            let bow = dot(self.bows.at(lane), self.normals.at(lane));
            let angle = Angle::of(bow * bow, self.yarns.length);
            let bend = angle.curvature(bow);
            bends.curvature[lane] = if self.areas[lane] == 0.0 { 0.0 } else { bend };
            (bends.slope[lane], bends.slope_change[lane]) = angle.derivatives(bow);
        }
        bends
    }

    /// The lanes of connectors at folds.
    #[inline(always)]
    fn creases(&self) -> impl Iterator<Item = (usize, Crease)> {
        let folded = self.folds.into_iter().flatten().enumerate().filter(|(_, fold)| **fold != 0.0);
        folded.map(|(lane, fold)| {
            let rest = self.yarns.bending.law().rest_curvature + fold;
            let bow = (self.bows.at(lane), self.normals.at(lane));
            (lane, Crease::new(bow, self.yarns.length, rest))
        })
    }

    /// Derivatives of the potential with respect to the bows, times a factor.
    #[inline(always)]
    pub(crate) fn moments(&self, memory: &MemoryBatch<'_>, factor: f64) -> [Lanes; 3] {
        match self.yarns.bending.law().backbone {
            BendingBackbone::Linear { rigidity } => self.moments_of(memory, factor, |_| rigidity),
            BendingBackbone::Piecewise(piecewise) => {
                self.moments_of(memory, factor, |square| piecewise.secant(square.sqrt()))
            }
        }
    }

    /// Moments with the given secant stiffness of a squared curvature.
    #[inline(always)]
    fn moments_of(
        &self,
        memory: &MemoryBatch<'_>,
        factor: f64,
        secant: impl Fn(f64) -> f64,
    ) -> [Lanes; 3] {
        let yarns = self.yarns;
        let rest = yarns.rest_bow;
        let bends = self.bends();
        let mut friction = Responses::default();
        yarns.bending.add_friction::<false>(memory, &bends.curvature, &mut friction);
        let mut moments = [[0.0; LANES]; 3];
        for lane in 0..LANES {
            let normal = self.normals.at(lane);
            let excess = subtract(self.bows.at(lane), scale(normal, rest));
            let square = dot(excess, excess);
            let angle = Angle::of(square, yarns.length);
            let elastic = scale(excess, secant(square * angle.square) * angle.slope);
            let rub = friction.load[lane] * bends.slope[lane];
            let moment = add(elastic, scale(normal, rub));
            set(&mut moments, lane, scale(moment, self.areas[lane] * factor));
        }
        for (lane, crease) in self.creases() {
            let moment = crease.moment(&yarns.bending.law().backbone, friction.load[lane]);
            set(&mut moments, lane, scale(moment, self.areas[lane] * factor));
        }
        moments
    }

    /// Second derivatives of the potential with respect to the bows, times a factor squared.
    #[inline(always)]
    pub(crate) fn blocks(
        &self,
        memory: &MemoryBatch<'_>,
        factor: f64,
        definite: bool,
    ) -> [Lanes; 6] {
        match self.yarns.bending.law().backbone {
            BendingBackbone::Linear { rigidity } => {
                self.blocks_of(memory, (factor, definite), |_| (rigidity, 0.0))
            }
            BendingBackbone::Piecewise(piecewise) => {
                self.blocks_of(memory, (factor, definite), |square| {
                    let size = square.sqrt();
                    let secant = piecewise.secant(size);
                    let more = (piecewise.tangent(size) - secant) / square;
                    (secant, if square > 0.0 { more } else { 0.0 })
                })
            }
        }
    }

    /// Blocks with the secant stiffness of a squared curvature and what the tangent is larger by, over that square.
    #[inline(always)]
    fn blocks_of(
        &self,
        memory: &MemoryBatch<'_>,
        (factor, definite): (f64, bool),
        stiffness: impl Fn(f64) -> (f64, f64),
    ) -> [Lanes; 6] {
        let yarns = self.yarns;
        let rest = yarns.rest_bow;
        let bends = self.bends();
        let mut friction = Responses::default();
        yarns.bending.add_friction::<true>(memory, &bends.curvature, &mut friction);
        let mut blocks = [[0.0; LANES]; 6];
        for lane in 0..LANES {
            let normal = self.normals.at(lane);
            let excess = subtract(self.bows.at(lane), scale(normal, rest));
            let square = dot(excess, excess);
            let angle = Angle::of(square, yarns.length);
            let (secant, more) = stiffness(square * angle.square);
            let more = more * angle.slope * angle.slope + 2.0 * secant * angle.bend;
            let secant = secant * angle.slope;
            let first = bends.slope[lane];
            let tangent = friction.tangent[lane] * first * first
                + friction.load[lane] * bends.slope_change[lane];
            let slope = if definite && tangent < 0.0 { 0.0 } else { tangent };
            let size = self.areas[lane] * factor * factor;
            let (secant, more, slope) = (secant * size, more * size, slope * size);
            for (block, (row, column)) in blocks.iter_mut().zip(HALF) {
                let one = if row == column { secant } else { 0.0 };
                block[lane] = slope * (normal[row] * normal[column])
                    + more * (excess[row] * excess[column])
                    + one;
            }
        }
        for (lane, crease) in self.creases() {
            let rub = [friction.load[lane], friction.tangent[lane]];
            let half = crease.block(&yarns.bending.law().backbone, rub, definite);
            for (block, entry) in blocks.iter_mut().zip(half) {
                block[lane] = self.areas[lane] * factor * factor * entry;
            }
        }
        blocks
    }

    /// Elastic energies per area, in J/m².
    #[inline(always)]
    pub(crate) fn energies(&self) -> Lanes {
        let yarns = self.yarns;
        let rest = yarns.rest_bow;
        let square = |lane| {
            let excess = subtract(self.bows.at(lane), scale(self.normals.at(lane), rest));
            let square = dot(excess, excess);
            square * Angle::of(square, yarns.length).square
        };
        let mut energies = [0.0; LANES];
        match yarns.bending.law().backbone {
            BendingBackbone::Linear { rigidity } => {
                for lane in 0..LANES {
                    energies[lane] = 0.5 * rigidity * square(lane);
                }
            }
            BendingBackbone::Piecewise(piecewise) => {
                for lane in 0..LANES {
                    energies[lane] = piecewise.energy(square(lane).sqrt());
                }
            }
        }
        for (lane, crease) in self.creases() {
            energies[lane] = crease.energy(&yarns.bending.law().backbone);
        }
        energies
    }
}
