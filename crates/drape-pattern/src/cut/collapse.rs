//! Collapse of pieces of outline that are too short for the spacing: their ends become one
//! breakpoint.
//!
//! Where a piece is sewn, the piece on the other side of its seam collapses with it, and both
//! breakpoints are sewn to each other. Of two ends the sharper corner keeps its place. Called by
//! `simplify` for the pieces that cannot be joined with a smooth neighbour.

use super::breakpoint::{Breakpoints, SeamPiece};
use super::merge::Merge;

/// Smallest number of breakpoints of an outline.
const POINTS_MIN: usize = 3;

impl Breakpoints {
    /// Makes one breakpoint of those at the ends of the piece after a breakpoint, and of those on
    /// the other side of its seam; returns whether that can be.
    pub fn collapse(&mut self, point: usize) -> bool {
        let Some(number) = self.points[point].pieces[1] else {
            let can = self.can_lose(point, 1);
            if can {
                self.join_with_next(point);
            }
            return can;
        };
        if self.fullness(point) > 1 {
            return false;
        }
        let piece: SeamPiece = self.pieces[number].clone();
        let both = [0, 1].map(|side| Self::foremost(&piece, side));
        let [one, other] = both.map(|first| [first, self.points[first].neighbours[1]]);
        // At the tip of a dart both sides have a breakpoint in common.
        if one.iter().any(|end| other.contains(end)) {
            return false;
        }
        let same_line = self.points[both[0]].line == self.points[both[1]].line;
        let lost = if same_line { 2 } else { 1 };
        if !both.iter().all(|&first| self.can_lose(first, lost)) {
            return false;
        }
        self.pieces[number].removed = true;
        for [first, last] in [one, other] {
            self.points[first].pieces[1] = None;
            self.points[last].pieces[0] = None;
        }
        let points = both.map(|first| self.join_with_next(first));
        self.unite(points[0], points[1]);
        self.merges.push(Merge { seam: piece.seam, points });
        true
    }

    /// Returns whether the outline of a breakpoint can lose so many.
    fn can_lose(&self, point: usize, lost: usize) -> bool {
        self.ring(self.points[point].line).len() >= POINTS_MIN + lost
    }

    /// Makes one breakpoint of a breakpoint and the next, and returns it.
    fn join_with_next(&mut self, point: usize) -> usize {
        let next = self.points[point].neighbours[1];
        let [angle, next_angle] = [point, next].map(|p| self.points[p].corner_angle);
        let (kept, lost) = if angle >= next_angle { (point, next) } else { (next, point) };
        // What lies beyond the lost one: after it or before it.
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
