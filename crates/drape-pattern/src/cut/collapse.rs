//! Collapse of pieces of outline that are too short for the spacing: their ends become one
//! breakpoint.
//!
//! If a piece is sewn, the piece on the other side of its seam collapses too, and the remaining
//! breakpoints are sewn to each other. The sharper corner of the two ends keeps its position.
//! Called by `simplify` for pieces that cannot be joined with a smooth neighbour.

use super::breakpoint::{Breakpoints, SeamPiece};
use super::merge::Merge;

/// Smallest number of breakpoints of an outline.
const SMALLEST_RING: usize = 3;

impl Breakpoints {
    /// Merges the breakpoints at the ends of the piece after `point`, and the breakpoints on the
    /// other side of its seam. Returns whether that can be done.
    pub fn collapse(&mut self, point: usize) -> bool {
        let Some(number) = self.points[point].pieces[1] else {
            let is_possible = self.can_lose(point, 1);
            if is_possible {
                self.join_with_next(point);
            }
            return is_possible;
        };
        if self.fullness(point) > 1 {
            return false;
        }
        let piece: SeamPiece = self.pieces[number].clone();
        let starts = [0, 1].map(|side| Self::piece_start(&piece, side));
        let [first_ends, second_ends] =
            starts.map(|first| [first, self.points[first].neighbours[1]]);
        // At the tip of a dart both sides have a breakpoint in common.
        if first_ends.iter().any(|end| second_ends.contains(end)) {
            return false;
        }
        let same_line = self.points[starts[0]].line == self.points[starts[1]].line;
        let lost = if same_line { 2 } else { 1 };
        if !starts.iter().all(|&first| self.can_lose(first, lost)) {
            return false;
        }

        self.pieces[number].removed = true;
        for [first, last] in [first_ends, second_ends] {
            self.points[first].pieces[1] = None;
            self.points[last].pieces[0] = None;
        }
        let points = starts.map(|first| self.join_with_next(first));
        self.unite(points[0], points[1]);
        self.merges.push(Merge { seam: piece.seam, points });
        true
    }

    /// Returns whether the outline of `point` can lose `lost` breakpoints.
    fn can_lose(&self, point: usize, lost: usize) -> bool {
        self.ring(self.points[point].line).len() >= SMALLEST_RING + lost
    }

    /// Merges the breakpoint `point` and the next, and returns the remaining breakpoint.
    fn join_with_next(&mut self, point: usize) -> usize {
        let next = self.points[point].neighbours[1];
        let [angle, next_angle] = [point, next].map(|p| self.points[p].corner_angle);
        let (kept, lost) = if angle >= next_angle { (point, next) } else { (next, point) };
        // The neighbour of the lost breakpoint on its far side: after it (1) or before it (0).
        let beyond = usize::from(kept == point);
        let far = self.points[lost].neighbours[beyond];
        self.points[kept].neighbours[beyond] = far;
        self.points[far].neighbours[1 - beyond] = kept;
        self.points[kept].pieces[beyond] = self.points[lost].pieces[beyond];
        self.points[kept].corner_angle = (angle + next_angle).min(std::f64::consts::PI);
        self.unite(kept, lost);
        self.points[lost].removed = true;

        let ends = self.pieces.iter_mut().flat_map(|piece| piece.ends.iter_mut().flatten());
        let merged = self.merges.iter_mut().flat_map(|merge| &mut merge.points);
        ends.chain(merged).filter(|end| **end == lost).for_each(|end| *end = kept);
        kept
    }
}
