//! Batches of bending connectors: triples of a strip, and stencils of a rim.
//!
//! With the second difference `$b$`, the normal `$n$` at the start of the step and the curvature
//! `$\kappa(b)$` of `measure::turning_angle`, the energy per area is
//!
//! ```math
//! E_e\left(\kappa(|b - b_0 n|)\right) + E_{fr}\left(\kappa(b\cdot n)\right)
//! ```
//!
//! The elastic part also resists bending in the surface, so a yarn cannot zigzag in the plane
//! without load. The friction depends on the signed curvature about the normal. Tests compare this
//! code with its scalar form, `measure::bending`.
#![allow(clippy::needless_range_loop, reason = "a lane indexes several arrays")]

use drape_fabric::{BatchLaw, BendingBackbone, LANES, Lanes, MemoryBatch, Responses};

use crate::kernel::crease::Crease;
use crate::layout::columns::{ColumnBatch, VectorLanes};
use crate::layout::grid::Yarns;
use crate::measure::half::HALF;
use crate::measure::turning_angle::TurningAngle;
use crate::measure::vector::{add, dot, scale, subtract};

/// Curvatures of a batch about the normals, in 1/m, and their derivatives with respect to the
/// component of the second difference along the normal.
#[derive(Default)]
pub(crate) struct Curvatures {
    pub(crate) value: Lanes,
    pub(crate) first: Lanes,
    pub(crate) second: Lanes,
}

/// Batch of bending connectors of one direction. Connectors that do not exist have an area of zero.
pub(crate) struct BendingLanes<'a> {
    pub(crate) yarns: &'a Yarns,
    /// Second differences, in 1/m.
    pub(crate) second_differences: VectorLanes,
    /// Unit normals at the start of the step.
    pub(crate) normals: ColumnBatch<'a, 3>,
    /// Areas, in m².
    pub(crate) areas: &'a Lanes,
    /// Rest curvatures that folds add, in 1/m, if the panel has folds.
    pub(crate) folds: Option<&'a Lanes>,
}

/// Secant stiffness of a backbone at a curvature, and the excess of the tangent stiffness over it,
/// divided by the squared curvature.
#[derive(Clone, Copy)]
struct Stiffness {
    secant: f64,
    excess: f64,
}

impl BendingLanes<'_> {
    /// Returns the [`Curvatures`] about the normals, zero for connectors that do not exist.
    #[inline(always)]
    pub(crate) fn curvatures(&self) -> Curvatures {
        let mut curvatures = Curvatures::default();
        for lane in 0..LANES {
            let along = dot(self.second_differences.vector(lane), self.normals.vector(lane));
            let angle = TurningAngle::new(along * along, self.yarns.length);
            let curvature = angle.curvature(along);
            curvatures.value[lane] = if self.areas[lane] == 0.0 { 0.0 } else { curvature };
            let slopes = angle.curvature_slopes(along);
            (curvatures.first[lane], curvatures.second[lane]) = (slopes.first, slopes.second);
        }
        curvatures
    }

    /// Returns the lanes of connectors at folds, each with its [`Crease`].
    #[inline(always)]
    fn creases(&self) -> impl Iterator<Item = (usize, Crease)> {
        let folds = self.folds.into_iter().flatten().enumerate();
        folds.filter(|(_, fold)| **fold != 0.0).map(|(lane, fold)| {
            let rest = self.yarns.bending.law().rest_curvature + fold;
            let (difference, normal) =
                (self.second_differences.vector(lane), self.normals.vector(lane));
            (lane, Crease::new(difference, normal, self.yarns.length, rest))
        })
    }

    /// Returns the derivatives of the potential with respect to the second differences, times
    /// `factor`.
    #[inline(always)]
    pub(crate) fn moments(&self, memory: &MemoryBatch<'_>, factor: f64) -> VectorLanes {
        match self.yarns.bending.law().backbone {
            BendingBackbone::Linear { rigidity } => self.moments_with(memory, factor, |_| rigidity),
            BendingBackbone::Varying(varying) => {
                self.moments_with(memory, factor, |square| varying.secant(square))
            }
            BendingBackbone::Piecewise(piecewise) => {
                self.moments_with(memory, factor, |square| piecewise.secant(square.sqrt()))
            }
        }
    }

    /// Returns the moments, with `secant` as the secant stiffness at a squared curvature.
    #[inline(always)]
    fn moments_with(
        &self,
        memory: &MemoryBatch<'_>,
        factor: f64,
        secant: impl Fn(f64) -> f64,
    ) -> VectorLanes {
        let yarns = self.yarns;
        let rest = yarns.rest_second_difference;
        let curvatures = self.curvatures();
        let mut friction = Responses::default();
        yarns.bending.add_friction::<false>(memory, &curvatures.value, &mut friction);

        let mut moments = VectorLanes::zero();
        for lane in 0..LANES {
            let normal = self.normals.vector(lane);
            let excess = subtract(self.second_differences.vector(lane), scale(normal, rest));
            let square = dot(excess, excess);
            let angle = TurningAngle::new(square, yarns.length);
            let elastic = scale(excess, secant(square * angle.ratio) * angle.first);
            let friction = friction.load[lane] * curvatures.first[lane];
            let moment = add(elastic, scale(normal, friction));
            moments.set(lane, scale(moment, self.areas[lane] * factor));
        }
        // At folds the curvature is counted differently.
        for (lane, crease) in self.creases() {
            let moment = crease.moment(&yarns.bending.law().backbone, friction.load[lane]);
            moments.set(lane, scale(moment, self.areas[lane] * factor));
        }
        moments
    }

    /// Returns the second derivatives of the potential with respect to the second differences,
    /// times the square of `factor`. With `definite`, the part of the friction that makes them
    /// indefinite is left out.
    #[inline(always)]
    pub(crate) fn blocks(
        &self,
        memory: &MemoryBatch<'_>,
        factor: f64,
        definite: bool,
    ) -> [Lanes; 6] {
        // One loop is compiled for each backbone, so that its stiffness is inlined.
        match self.yarns.bending.law().backbone {
            BendingBackbone::Linear { rigidity } => {
                let constant = Stiffness { secant: rigidity, excess: 0.0 };
                self.blocks_with(memory, factor, definite, |_| constant)
            }
            BendingBackbone::Varying(varying) => {
                self.blocks_with(memory, factor, definite, |square| Stiffness {
                    secant: varying.secant(square),
                    excess: varying.excess(square),
                })
            }
            BendingBackbone::Piecewise(piecewise) => {
                self.blocks_with(memory, factor, definite, |square| {
                    let size = square.sqrt();
                    let secant = piecewise.secant(size);
                    let excess = (piecewise.tangent(size) - secant) / square;
                    Stiffness { secant, excess: if square > 0.0 { excess } else { 0.0 } }
                })
            }
        }
    }

    /// Returns the blocks, with `stiffness` as the stiffness at a squared curvature.
    #[inline(always)]
    fn blocks_with(
        &self,
        memory: &MemoryBatch<'_>,
        factor: f64,
        definite: bool,
        stiffness: impl Fn(f64) -> Stiffness,
    ) -> [Lanes; 6] {
        let yarns = self.yarns;
        let rest = yarns.rest_second_difference;
        let curvatures = self.curvatures();
        let mut friction = Responses::default();
        yarns.bending.add_friction::<true>(memory, &curvatures.value, &mut friction);

        let mut blocks = [[0.0; LANES]; 6];
        for lane in 0..LANES {
            let normal = self.normals.vector(lane);
            let excess = subtract(self.second_differences.vector(lane), scale(normal, rest));
            let square = dot(excess, excess);

            // Elastic part, by the chain rule from the curvature to the second difference.
            let angle = TurningAngle::new(square, yarns.length);
            let Stiffness { secant, excess: tangent_excess } = stiffness(square * angle.ratio);
            let tangent_excess =
                tangent_excess * angle.first * angle.first + 2.0 * secant * angle.second;
            let secant = secant * angle.first;

            // Friction about the normal.
            let first = curvatures.first[lane];
            let tangent = friction.tangent[lane] * first * first
                + friction.load[lane] * curvatures.second[lane];
            let slope = if definite && tangent < 0.0 { 0.0 } else { tangent };

            let size = self.areas[lane] * factor * factor;
            let (secant, tangent_excess, slope) =
                (secant * size, tangent_excess * size, slope * size);
            for (block, (row, column)) in blocks.iter_mut().zip(HALF) {
                let diagonal = if row == column { secant } else { 0.0 };
                block[lane] = slope * (normal[row] * normal[column])
                    + tangent_excess * (excess[row] * excess[column])
                    + diagonal;
            }
        }
        // At folds the curvature is counted differently.
        for (lane, crease) in self.creases() {
            let friction = friction.lane(lane);
            let half = crease.block(&yarns.bending.law().backbone, friction, definite);
            for (block, entry) in blocks.iter_mut().zip(half) {
                block[lane] = self.areas[lane] * factor * factor * entry;
            }
        }
        blocks
    }

    /// Returns the elastic energies per area, in J/m², as [`Lanes`].
    #[inline(always)]
    pub(crate) fn energies(&self) -> Lanes {
        let yarns = self.yarns;
        let mut energies = [0.0; LANES];

        // The match is outside the loops, so that each loop is vectorised for one backbone.
        match yarns.bending.law().backbone {
            BendingBackbone::Linear { rigidity } => {
                for lane in 0..LANES {
                    energies[lane] = 0.5 * rigidity * self.squared_curvature(lane);
                }
            }
            BendingBackbone::Varying(varying) => {
                for lane in 0..LANES {
                    energies[lane] = varying.energy(self.squared_curvature(lane));
                }
            }
            BendingBackbone::Piecewise(piecewise) => {
                for lane in 0..LANES {
                    energies[lane] = piecewise.energy(self.squared_curvature(lane).sqrt());
                }
            }
        }

        // At folds the curvature is counted differently.
        for (lane, crease) in self.creases() {
            energies[lane] = crease.energy(&yarns.bending.law().backbone);
        }
        energies
    }

    /// Returns the squared elastic curvature in `lane`, in 1/m².
    #[inline(always)]
    fn squared_curvature(&self, lane: usize) -> f64 {
        let yarns = self.yarns;
        let rest = yarns.rest_second_difference;
        let excess =
            subtract(self.second_differences.vector(lane), scale(self.normals.vector(lane), rest));
        let square = dot(excess, excess);
        square * TurningAngle::new(square, yarns.length).ratio
    }
}
