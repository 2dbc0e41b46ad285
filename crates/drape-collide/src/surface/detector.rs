//! Detector of candidate pairs: the broad phase with its lists.

use super::broad_phase::{CandidatePairs, Detection, Limit, PastDetection, Query, Scan, Sweep};
use super::contact_surface::Surface;
use crate::error::{Error, check};

/// Largest number of pairs of a list, unless another one is given.
///
/// It is a hundred for each of half a million vertices, and 4 GB: more is a mistake of the input.
const CAPACITY: usize = 50_000_000;

/// Detector of candidate pairs.
///
/// It keeps boxes and lists between calls and allocates only when they grow; it may be used for
/// one surface after another.
#[derive(Debug, Clone)]
pub struct Detector {
    scan: Scan,
    pairs: CandidatePairs,
    capacity: usize,
}

impl Default for Detector {
    fn default() -> Detector {
        Detector::with_capacity(CAPACITY)
    }
}

impl Detector {
    /// Makes a detector whose list may hold so many pairs, instead of 50 million.
    #[must_use]
    pub fn with_capacity(capacity: usize) -> Detector {
        Detector { scan: Scan::default(), pairs: CandidatePairs::default(), capacity }
    }

    /// Pairs of the last detection that succeeded.
    #[must_use]
    pub fn pairs(&self) -> &CandidatePairs {
        &self.pairs
    }

    /// Finds every pair whose distance is below its activation distance plus a margin, in m, at
    /// flat positions.
    ///
    /// Pairs that share a vertex, directly or through a seam, and pairs without a free vertex are
    /// left out. On an error the pairs of the detection before stay.
    ///
    /// # Errors
    ///
    /// If there are not three coordinates for each vertex, one is not finite or beyond 1000 km,
    /// the margin is not a positive number, or the list would be too long.
    pub fn detect(
        &mut self,
        surface: &Surface,
        positions: &[f64],
        margin: f64,
    ) -> Result<&CandidatePairs, Error> {
        self.detect_swept(surface, positions, Sweep::Still, margin)
    }

    /// Finds every pair whose distance falls below its activation distance plus a margin, in m,
    /// somewhere on trajectories from flat positions, and some that stay a little farther.
    ///
    /// # Errors
    ///
    /// As of [`detect`](Detector::detect).
    pub fn detect_swept(
        &mut self,
        surface: &Surface,
        positions: &[f64],
        sweep: Sweep<'_>,
        margin: f64,
    ) -> Result<&CandidatePairs, Error> {
        surface.check_positions(positions)?;
        if let Some(displacements) = sweep.displacements() {
            surface.check_positions(displacements)?;
        }
        check("the margin of contact (m)", margin, "above 0", margin > 0.0)?;
        let free = surface.free_count();
        let query = Query {
            primitives: surface.primitives(),
            separations: &surface.separations,
            positions,
            limit: Limit::Margin { margin, sweep },
            mean_displacement: sweep.mean_displacement(free),
        };
        self.scan.run(&query, self.capacity)?;
        self.pairs.replace(self.scan.pairs(), &Detection { positions, sweep, margin, free });
        Ok(&self.pairs)
    }

    /// Moves the reference positions of the pairs along their trajectories to where these come
    /// nearest to flat positions, from where a [`CcdFilter`](crate::CcdFilter) then takes further
    /// steps.
    pub fn follow_trajectories(&mut self, positions: &[f64]) {
        self.pairs.follow_trajectories(positions);
    }

    /// Detects the pairs of an earlier detection again.
    pub(crate) fn repeat(&mut self, surface: &Surface, past: &PastDetection) -> Result<(), Error> {
        self.detect_swept(surface, &past.start, past.sweep(), past.margin)?;
        self.pairs.follow_to(past);
        Ok(())
    }

    /// Drops the pairs, whose distances have changed.
    pub(crate) fn clear(&mut self) {
        self.pairs.clear();
    }
}
