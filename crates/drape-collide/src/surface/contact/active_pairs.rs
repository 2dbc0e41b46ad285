//! Active pairs: candidates whose distance at the positions of an evaluation is below their
//! activation distance.

use crate::error::Error;
use crate::surface::barrier::{Gap, Gradient};
use crate::surface::broad_phase::Sweep;
use crate::surface::contact_surface::Surface;
use crate::surface::pair::Pair;
use crate::surface::placement::Placement;
use crate::surface::tracked_pairs::TrackedPairs;
use crate::threads::*;

/// Number of candidate pairs in a chunk, for any number of threads.
const CHUNK: usize = 256;

/// Pair within its activation distance.
#[derive(Debug, Clone)]
pub(super) struct ActivePair {
    pub(super) pair: Pair,
    pub(super) gap: Gap,
}

/// Active pairs at given positions.
#[derive(Debug, Default)]
pub(super) struct ActivePairs {
    /// Positions of all vertices, in m.
    pub(super) positions: Placement,
    /// Active pairs in each chunk of the candidates. Lists beyond the candidates are empty.
    chunks: Vec<Vec<ActivePair>>,
    /// Gradients of the energies of the pairs, in N, in the order of the pairs.
    gradients: Vec<Vec<Gradient>>,
    /// Error of the last detection.
    pub(super) failure: Option<Error>,
}

impl ActivePairs {
    /// Returns each [`ActivePair`], in the order of the candidates.
    pub(super) fn iter(&self) -> impl Iterator<Item = &ActivePair> {
        self.chunks.iter().flatten()
    }

    /// Drops the positions, because the distances of pairs have changed.
    pub(super) fn invalidate(&mut self) {
        self.positions.clear();
    }

    /// Finds the active pairs of `surface` at `positions`, and swaps these with the positions of
    /// the previous update.
    pub(super) fn update(
        &mut self,
        surface: &Surface,
        tracked: &mut TrackedPairs,
        positions: &mut Placement,
    ) {
        // NaN is never equal, so positions of NaN are evaluated each time.
        if positions.is_same(&self.positions, surface.free_count()) && self.failure.is_none() {
            return;
        }

        self.failure = None;
        self.chunks.iter_mut().for_each(Vec::clear);
        tracked.follow_trajectories(positions);
        // While no vertex drifts by more than half of the margin, only candidates can be active.
        if !(tracked.measure_drift(positions) <= 0.5 * tracked.pairs().margin()) {
            self.failure = tracked.detect(surface, positions, Sweep::Still).err();
            tracked.drift.fill(0.0);
        }
        std::mem::swap(&mut self.positions, positions);
        if self.failure.is_some() {
            return;
        }

        // Parallel chunks keep the order of the candidates.
        let candidates = tracked.pairs().as_slice().par_chunks(CHUNK);
        if self.chunks.len() < candidates.len() {
            self.chunks.resize_with(candidates.len(), Vec::new);
        }
        let (positions, drift) = (&self.positions, &tracked.drift);
        candidates.zip(self.chunks.par_iter_mut()).for_each(|(pairs, chunk)| {
            chunk.extend(pairs.iter().filter_map(|pair| ActivePair::find(pair, positions, drift)));
        });
    }

    /// Calls `visit` with the vertices of each pair and the gradient of its energy, in N.
    /// `stiffness` is in N/m³.
    pub(super) fn for_each_gradient(
        &mut self,
        stiffness: f64,
        mut visit: impl FnMut(&[u32; 4], &Gradient),
    ) {
        let Self { chunks, gradients, .. } = self;
        gradients.resize_with(chunks.len(), Vec::new);
        let lists = gradients.par_iter_mut();
        chunks.par_iter().zip(lists).for_each(|(chunk, gradients)| {
            gradients.clear();
            gradients.extend(chunk.iter().map(|active| active.gap.gradient(stiffness)));
        });
        for (active, gradient) in self.iter().zip(self.gradients.iter().flatten()) {
            visit(&active.pair.vertices, gradient);
        }
    }

    /// Returns the energy of the barriers for `stiffness`, in N/m³. The energy is in J.
    pub(super) fn energy(&self, stiffness: f64) -> f64 {
        self.iter().map(|active| active.gap.energy(stiffness)).sum()
    }
}

impl ActivePair {
    /// Returns `pair` as an active pair at `positions`, or `None` if it is not active. `drift`
    /// holds the distance of each vertex from its position at detection, in m.
    fn find(pair: &Pair, positions: &[f64], drift: &[f64]) -> Option<ActivePair> {
        // The drift bounds how much nearer the pair has come.
        if pair.distance - pair.largest_sum(drift) >= pair.activation_distance {
            return None;
        }
        let gap = Gap::at(pair, positions);
        // A distance of NaN counts as active.
        (!(gap.distance() >= pair.activation_distance)).then_some(ActivePair { pair: *pair, gap })
    }
}
