//! Open seams: their two sides are two cloths, which keep less from each other the nearer they come.

use super::active_pairs::ActivePair;
use crate::surface::contact_surface::Surface;
use crate::surface::geometry::Separations;

/// Least gap at which the sides of a seam are two cloths, in m: nearer ones are one point.
///
/// It is some thousand times the rounding of coordinates of 1 m.
pub(super) const LEAST: f64 = 1e-12;

/// Open seams of a surface, with the largest gap that contact assumes between the sides of each.
///
/// It is limited where the sides lie nearer to each other at the start than the gap is wide.
#[derive(Debug, Default, Clone)]
pub(super) struct OpenSeams {
    /// Widest gap of each class of vertices, in m; empty if no seam is open.
    widest: Vec<f64>,
    /// Gaps of the classes in the last step, in m.
    gaps: Vec<f64>,
}

impl OpenSeams {
    /// Opens the seams of a surface without limits.
    pub(super) fn open(&mut self, surface: &Surface) {
        self.widest.clear();
        self.widest.resize(surface.vertex_count(), f64::INFINITY);
    }

    /// Closes all seams.
    pub(super) fn close(&mut self) {
        self.widest.clear();
    }

    /// Returns whether these may be gaps of the classes, in m: none if all seams are closed.
    pub(super) fn may_have(&self, gaps: &[f64]) -> bool {
        gaps.len() == self.widest.len() && gaps.iter().all(|gap| *gap >= 0.0)
    }

    /// Limits the gaps to what the sides of the seams are apart, so that none repels the other.
    pub(super) fn limit<'a>(
        &mut self,
        surface: &Surface,
        active: impl Iterator<Item = &'a ActivePair>,
    ) {
        let seams = &surface.primitives().seams;
        for ActivePair { pair, gap } in active {
            let classes = pair.vertices.map(|vertex| seams.class(vertex));
            let (one, other) = classes.split_at(pair.first_vertices());
            let widest = Separations::widest_seam_gap(gap.distance()).max(LEAST);
            for class in seams.joints(one, other) {
                let own = &mut self.widest[class as usize];
                *own = own.min(widest);
            }
        }
    }

    /// Returns the gap of each class from those at the free vertices, in m; none if all seams are
    /// closed.
    pub(super) fn gaps_of_classes(&mut self, surface: &Surface, gaps: &[f64]) -> &[f64] {
        let Self { widest, gaps: of_classes } = self;
        of_classes.clear();
        of_classes.resize(widest.len(), f64::INFINITY);
        if widest.is_empty() {
            return of_classes;
        }
        let seams = &surface.primitives().seams;
        for (vertex, &gap) in gaps.iter().enumerate() {
            let class = seams.class(vertex as u32) as usize;
            let gap = if gap < LEAST { 0.0 } else { gap.min(widest[class]) };
            of_classes[class] = of_classes[class].min(gap);
        }
        of_classes
    }
}
