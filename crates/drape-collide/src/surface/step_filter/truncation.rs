//! Truncation of a step vertex by vertex, by planes that divide the room of each pair.

use std::sync::atomic::{AtomicU64, Ordering};

use rayon::prelude::*;

use super::safeguards::Safeguards;
use super::separating_planes::{DividingPlanes, SeparatingPlane};
use super::trial::{CHUNK, CLOSED, Drift, Trial};
use crate::surface::broad_phase::CandidatePairs;
use crate::surface::pair::Pair;
use crate::vector::{add, at, at_or_zero};

/// Smallest part of the room between two primitives that either of them has.
const LEAST_PART: f64 = 0.05;

/// Part of the room up to which rounding may take a vertex; above [`CLOSED`].
const ROUNDED: f64 = 0.95;

/// Result of a step that was truncated vertex by vertex.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Truncation {
    /// Common fraction of the displacements of bodies.
    pub body_fraction: f64,
    /// Smallest fraction of a vertex.
    pub least_fraction: f64,
    /// Number of vertices whose displacement is truncated.
    pub shortened: usize,
    /// Number of vertices that the drift budget limits: detect again before the next step.
    pub at_drift_budget: usize,
    /// Number of pairs so near their minimum separation that their vertices may not approach.
    pub frozen: usize,
}

/// Counts of a division of the room.
#[derive(Debug, Clone, Copy)]
pub(super) struct Division {
    at_drift_budget: usize,
    frozen: usize,
}

/// Fractions of vertices and planes of pairs of a truncation.
#[derive(Debug, Default)]
pub(super) struct Truncator {
    /// Fraction of each vertex as bits: those of positive numbers are in order.
    fractions: Vec<AtomicU64>,
    planes: Vec<DividingPlanes>,
}

impl Truncator {
    /// Divides the room of all pairs, and limits the fraction of each vertex by it.
    pub(super) fn divide(
        &mut self,
        pairs: &CandidatePairs,
        step: &Trial<'_>,
        drift: &Drift,
        safeguards: Safeguards,
    ) -> Division {
        let vertices = step.positions.len() / 3;
        self.fractions.resize_with(vertices, AtomicU64::default);
        self.planes.resize(pairs.as_slice().len(), DividingPlanes::NONE);
        let mut planes = std::mem::take(&mut self.planes);
        let mut at_drift_budget = 0;
        for vertex in 0..vertices {
            let limited = safeguards.drift_budget && vertex < drift.vertices();
            let fraction = match limited {
                true => drift.budget_fraction(pairs, step, vertex),
                false => 1.0,
            };
            at_drift_budget += usize::from(fraction < 1.0);
            self.fractions[vertex].store(fraction.to_bits(), Ordering::Relaxed);
        }
        let chunks = pairs.as_slice().par_chunks(CHUNK).zip(planes.par_chunks_mut(CHUNK));
        let frozen = chunks.map(|(chunk, planes)| {
            let mut frozen = 0;
            for (pair, planes) in chunk.iter().zip(planes) {
                *planes = DividingPlanes::NONE;
                if !drift.stays_apart(pair, step) {
                    frozen += usize::from(self.divide_pair(pair, step, planes, safeguards));
                }
            }
            frozen
        });
        let frozen = frozen.sum();
        self.planes = planes;
        Division { at_drift_budget, frozen }
    }

    /// Truncates the displacements, after the division of the room.
    pub(super) fn truncate(
        &self,
        pairs: &CandidatePairs,
        positions: &[f64],
        displacements: &mut [f64],
        division: Division,
    ) -> Truncation {
        let vertices = positions.len() / 3;
        let bodies = self.least_fraction(pairs.free..vertices);
        for (vertex, displacement) in displacements.chunks_exact_mut(3).enumerate() {
            let fraction = if vertex < pairs.free { self.fraction(vertex) } else { bodies };
            displacement.iter_mut().for_each(|component| *component *= fraction);
            self.fractions[vertex].store(fraction.to_bits(), Ordering::Relaxed);
        }
        self.take_back(pairs, positions, displacements);
        let fractions = (0..vertices).map(|vertex| self.fraction(vertex));
        Truncation {
            body_fraction: self.least_fraction(pairs.free..vertices),
            least_fraction: self.least_fraction(0..vertices),
            shortened: fractions.filter(|fraction| *fraction < 1.0).count(),
            at_drift_budget: division.at_drift_budget,
            frozen: division.frozen,
        }
    }

    /// Fraction of a vertex.
    fn fraction(&self, vertex: usize) -> f64 {
        f64::from_bits(self.fractions[vertex].load(Ordering::Relaxed))
    }

    /// Least fraction of some vertices.
    fn least_fraction(&self, vertices: std::ops::Range<usize>) -> f64 {
        vertices.map(|vertex| self.fraction(vertex)).fold(1.0, f64::min)
    }

    /// Limits the fraction of a vertex. The least of all limits does not depend on their order.
    fn limit(&self, vertex: u32, fraction: f64) {
        let fraction = if fraction > 0.0 { fraction } else { 0.0 };
        self.fractions[vertex as usize].fetch_min(fraction.to_bits(), Ordering::Relaxed);
    }

    /// Divides the room of a pair, and returns whether it is frozen for lack of room.
    fn divide_pair(
        &self,
        pair: &Pair,
        step: &Trial<'_>,
        planes: &mut DividingPlanes,
        safeguards: Safeguards,
    ) -> bool {
        let points = pair.points(step.positions);
        let plane = SeparatingPlane::new(pair, points);
        let clearance = plane.clearance(pair.min_separation);
        let approaches = plane.approaches(pair, step.displacements(pair));
        let first = pair.first_vertices();
        let fastest = |list: &[f64]| list.iter().fold(0.0, |a: f64, b| a.max(*b));
        let [above, below] = [fastest(&approaches[..first]), fastest(&approaches[first..])];
        // The faster one has more.
        let both = above + below;
        let part = if both > 0.0 { below / both } else { 0.5 };
        let part = part.clamp(LEAST_PART, 1.0 - LEAST_PART);
        let room = [clearance * (1.0 - part), clearance * part];
        *planes = DividingPlanes {
            normal: plane.normal,
            origin: points[0],
            low: plane.low - ROUNDED * room[0],
            high: plane.high + ROUNDED * room[1],
        };
        // NaN freezes the pair.
        let open = clearance > step.smallest
            && SeparatingPlane::holds(planes.low, planes.high, pair.min_separation);
        if !open {
            if safeguards.freeze {
                (planes.low, planes.high) = (plane.low, plane.high);
                self.freeze(pair, plane.low > plane.high, approaches);
            } else {
                *planes = DividingPlanes::NONE;
            }
            return true;
        }
        for (k, approach) in approaches.into_iter().enumerate() {
            let slack = if k < first {
                plane.heights[k] - plane.low + CLOSED * room[0]
            } else {
                plane.high - plane.heights[k] + CLOSED * room[1]
            };
            if slack < approach {
                self.limit(pair.vertices[k], slack / approach);
            }
        }
        false
    }

    /// Lets no vertex of a pair approach, and none move if the two are not parted.
    fn freeze(&self, pair: &Pair, parted: bool, approaches: [f64; 4]) {
        for (vertex, approach) in pair.vertices.into_iter().zip(approaches) {
            if !(parted && approach <= 0.0) {
                self.limit(vertex, 0.0);
            }
        }
    }

    /// Takes vertices back to their start that are not surely on their side of a plane at their
    /// end.
    ///
    /// The planes hold at the start, so going back voids the proof of no other pair.
    fn take_back(&self, pairs: &CandidatePairs, positions: &[f64], displacements: &mut [f64]) {
        let chunks = pairs.as_slice().par_chunks(CHUNK).zip(self.planes.par_chunks(CHUNK));
        chunks.for_each(|(pairs, planes)| {
            for (pair, planes) in pairs.iter().zip(planes).filter(|(_, planes)| !planes.is_none()) {
                let ends = pair.vertices.map(|vertex| {
                    let vertex = vertex as usize;
                    add(at(positions, vertex), at_or_zero(displacements, vertex))
                });
                for (vertex, on_side) in pair.vertices.into_iter().zip(planes.on_side(pair, ends)) {
                    if !on_side {
                        self.limit(vertex, 0.0);
                    }
                }
            }
        });
        let bodies = self.least_fraction(pairs.free..positions.len() / 3);
        for (vertex, displacement) in displacements.chunks_exact_mut(3).enumerate() {
            let stays = self.fraction(vertex) == 0.0 || (vertex >= pairs.free && bodies == 0.0);
            if stays {
                displacement.fill(0.0);
                self.limit(vertex as u32, 0.0);
            }
        }
    }
}
