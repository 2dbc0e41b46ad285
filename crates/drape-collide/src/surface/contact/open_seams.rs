//! Open seams, whose two sides are two cloths. The sides keep less distance as they come nearer.

use super::active_pairs::ActivePair;
use crate::surface::contact_surface::Surface;
use crate::surface::geometry::Separations;

/// Smallest gap at which the sides of a seam are two cloths, in m. Nearer sides are one point.
///
/// The gap is some thousand times the rounding of coordinates of 1 m.
pub(super) const LEAST: f64 = 1e-12;

/// Open seams of a surface, with the largest gap that contact assumes between the sides of each.
///
/// The gap is limited where the sides start nearer to each other than the seam is wide.
#[derive(Debug, Default, Clone)]
pub(super) struct OpenSeams {
    /// Widest gap of each class of vertices, in m, empty if no seam is open.
    widest: Vec<f64>,
    /// Gap of each class in the last step, in m.
    gaps: Vec<f64>,
}

impl OpenSeams {
    /// Opens the seams of `surface` without limits.
    pub(super) fn open(&mut self, surface: &Surface) {
        self.widest.clear();
        self.widest.resize(surface.vertex_count(), f64::INFINITY);
    }

    /// Closes all seams.
    pub(super) fn close(&mut self) {
        self.widest.clear();
    }

    /// Returns whether `gaps` may be gaps of the classes, in m. They are empty if all seams are
    /// closed.
    pub(super) fn may_have(&self, gaps: &[f64]) -> bool {
        gaps.len() == self.widest.len() && gaps.iter().all(|gap| *gap >= 0.0)
    }

    /// Limits the gaps to the distances between the sides of seams in the `active` pairs, so that
    /// no side repels the other.
    pub(super) fn limit<'a>(
        &mut self,
        surface: &Surface,
        active: impl Iterator<Item = &'a ActivePair>,
    ) {
        let seams = &surface.primitives().seams;
        for ActivePair { pair, gap } in active {
            let classes = pair.vertices.map(|vertex| seams.class(vertex));
            let (first, second) = classes.split_at(pair.first_vertex_count());
            let widest = Separations::widest_seam_gap(gap.distance()).max(LEAST);
            for class in seams.joints(first, second) {
                let limit = &mut self.widest[class as usize];
                *limit = limit.min(widest);
            }
        }
    }

    /// Returns the gap of each class from the `gaps` at the free vertices, in m. The result is
    /// empty if all seams are closed.
    pub(super) fn gaps_of_classes(&mut self, surface: &Surface, gaps: &[f64]) -> &[f64] {
        let Self { widest, gaps: class_gaps } = self;
        class_gaps.clear();
        class_gaps.resize(widest.len(), f64::INFINITY);
        if widest.is_empty() {
            return class_gaps;
        }
        let seams = &surface.primitives().seams;
        for (vertex, &gap) in gaps.iter().enumerate() {
            let class = seams.class(vertex as u32) as usize;
            let gap = if gap < LEAST { 0.0 } else { gap.min(widest[class]) };
            class_gaps[class] = class_gaps[class].min(gap);
        }
        class_gaps
    }
}
