use crate::error::Error;
use crate::filter::{CHUNK, CLOSED, CcdFilter, Step};
use crate::pair::Pair;
use crate::pairs::CandidatePairs;
use crate::plane::{Planes, Slab};
use rayon::prelude::*;
use std::sync::atomic::{AtomicU64, Ordering};

/// Least share of the room between two primitives that either gets.
const LEAST_SHARE: f64 = 0.05;

/// Share of the room up to which rounding may take a vertex; above [`CLOSED`].
const ROUNDED: f64 = 0.95;

/// What became of a step that was shortened vertex by vertex.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Truncation {
    /// Share of their way that the bodies go, all alike.
    pub body_fraction: f64,
    /// The smallest share of its way that a vertex goes.
    pub least_fraction: f64,
    /// Vertices that do not go all their way.
    pub shortened: usize,
    /// Vertices that the budget holds back: detect again before the next step.
    pub at_drift_budget: usize,
    /// CandidatePairs so near their min_separation that their vertices may not approach.
    pub frozen: usize,
}

impl CcdFilter {
    /// Shortens the way of each vertex by as much as its own pairs ask for, in place.
    ///
    /// Divide and truncate: two parallel planes between the closest points of a pair, as far apart
    /// as the min_separation, divide the room between them by how fast either side approaches. Each
    /// vertex stays on its side of all its planes, so what one does cannot hurt the proof of
    /// another, and the step loses its direction only where something is near. The vertices of
    /// bodies go the same share of their way.
    ///
    /// # Errors
    ///
    /// As of [`scalar`](CcdFilter::common_fraction).
    pub fn truncate(
        &mut self,
        pairs: &CandidatePairs,
        positions: &[f64],
        displacements: &mut [f64],
    ) -> Result<Truncation, Error> {
        let vertices = positions.len() / 3;
        let step = self.begin(pairs, (positions, displacements), false)?;
        self.shares.resize_with(vertices, AtomicU64::default);
        self.planes.resize(pairs.as_slice().len(), Planes::NONE);
        let mut planes = std::mem::take(&mut self.planes);
        let mut exhausted = 0;
        for vertex in 0..vertices {
            let share = self.budget_share(pairs, &step, vertex);
            exhausted += usize::from(share < 1.0);
            self.shares[vertex].store(share.to_bits(), Ordering::Relaxed);
        }
        let chunks = pairs.as_slice().par_chunks(CHUNK).zip(planes.par_chunks_mut(CHUNK));
        let frozen = chunks.map(|(chunk, planes)| {
            let pairs = chunk.iter().zip(planes);
            pairs.map(|(pair, planes)| usize::from(self.divide(pair, &step, planes))).sum::<usize>()
        });
        let frozen = frozen.sum();
        let bodies = self.least(pairs.free..vertices);
        for (vertex, way) in displacements.chunks_exact_mut(3).enumerate() {
            let share = if vertex < pairs.free { self.share(vertex) } else { bodies };
            way.iter_mut().for_each(|component| *component *= share);
            self.shares[vertex].store(share.to_bits(), Ordering::Relaxed);
        }
        self.planes = planes;
        self.take_back(pairs, positions, displacements);
        let shares = (0..vertices).map(|vertex| self.share(vertex));
        Ok(Truncation {
            body_fraction: self.least(pairs.free..vertices),
            least_fraction: self.least(0..vertices),
            shortened: shares.filter(|share| *share < 1.0).count(),
            at_drift_budget: exhausted,
            frozen,
        })
    }

    fn share(&self, vertex: usize) -> f64 {
        f64::from_bits(self.shares[vertex].load(Ordering::Relaxed))
    }

    fn least(&self, vertices: std::ops::Range<usize>) -> f64 {
        vertices.map(|vertex| self.share(vertex)).fold(1.0, f64::min)
    }

    /// Lets a vertex go no more than a share of its way. The least of all does not depend on the
    /// order.
    fn limit(&self, vertex: u32, share: f64) {
        let share = if share > 0.0 { share } else { 0.0 };
        self.shares[vertex as usize].fetch_min(share.to_bits(), Ordering::Relaxed);
    }

    /// Divides the room of a pair, and tells if it is too little.
    fn divide(&self, pair: &Pair, step: &Step<'_>, planes: &mut Planes) -> bool {
        *planes = Planes::NONE;
        if self.stays_apart(pair, step) {
            return false;
        }
        let places = pair.places(step.positions);
        let slab = Slab::new(pair, places);
        let opening = slab.opening(pair.min_separation);
        let approaches = slab.approaches(pair, step.ways(pair));
        let first = pair.first();
        let fastest = |list: &[f64]| list.iter().fold(0.0, |a: f64, b| a.max(*b));
        let [above, below] = [fastest(&approaches[..first]), fastest(&approaches[first..])];
        // The faster gets more.
        let both = above + below;
        let share = if both > 0.0 { below / both } else { 0.5 };
        let share = share.clamp(LEAST_SHARE, 1.0 - LEAST_SHARE);
        let room = [opening * (1.0 - share), opening * share];
        *planes = Planes {
            normal: slab.normal,
            origin: places[0],
            low: slab.low - ROUNDED * room[0],
            high: slab.high + ROUNDED * room[1],
        };
        // Written so that NaN freezes.
        let open =
            opening > step.smallest && Slab::holds(planes.low, planes.high, pair.min_separation);
        if !open {
            self.freeze(pair, &slab, (planes, approaches));
            return true;
        }
        for (k, approach) in approaches.into_iter().enumerate() {
            let slack = if k < first {
                slab.heights[k] - slab.low + CLOSED * room[0]
            } else {
                slab.high - slab.heights[k] + CLOSED * room[1]
            };
            if slack < approach {
                self.limit(pair.vertices[k], slack / approach);
            }
        }
        false
    }

    /// Lets no vertex of a pair approach, and none move if they touch.
    fn freeze(&self, pair: &Pair, slab: &Slab, (planes, approaches): (&mut Planes, [f64; 4])) {
        if !self.guards.freeze {
            *planes = Planes::NONE;
            return;
        }
        (planes.low, planes.high) = (slab.low, slab.high);
        let parted = slab.low > slab.high;
        for (vertex, approach) in pair.vertices.into_iter().zip(approaches) {
            if !(parted && approach <= 0.0) {
                self.limit(vertex, 0.0);
            }
        }
    }

    /// Takes vertices back that are not surely on their side of a plane where they end.
    ///
    /// The planes hold at the start, so going back hurts no other pair.
    fn take_back(&self, pairs: &CandidatePairs, positions: &[f64], displacements: &mut [f64]) {
        let chunks = pairs.as_slice().par_chunks(CHUNK).zip(self.planes.par_chunks(CHUNK));
        chunks.for_each(|(pairs, planes)| {
            for (pair, planes) in pairs.iter().zip(planes).filter(|(_, planes)| !planes.is_none()) {
                let ends = pair.vertices.map(|vertex| {
                    let first = 3 * vertex as usize;
                    std::array::from_fn(|k| positions[first + k] + displacements[first + k])
                });
                for (vertex, kept) in pair.vertices.into_iter().zip(planes.keep(pair, ends)) {
                    if !kept {
                        self.limit(vertex, 0.0);
                    }
                }
            }
        });
        let bodies = self.least(pairs.free..positions.len() / 3);
        for (vertex, way) in displacements.chunks_exact_mut(3).enumerate() {
            let stays = self.share(vertex) == 0.0 || (vertex >= pairs.free && bodies == 0.0);
            if stays {
                way.fill(0.0);
                self.limit(vertex as u32, 0.0);
            }
        }
    }
}
