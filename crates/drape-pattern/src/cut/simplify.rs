//! Simplification of outlines. Pieces shorter than half a spacing are joined with a neighbour where
//! the outline is smooth, and become one node elsewhere.
//!
//! Called on the breakpoints of a pattern before `sampling` counts the arcs between them.

use super::breakpoint::{Breakpoints, SeamPiece};
use crate::mistake::Mistake;
use crate::note::PatternNote;
use crate::pattern::Pattern;

/// Largest corner angle at a breakpoint that may be removed, in rad: 15 degrees. A chord across it
/// cuts off at most a fifteenth of its length.
const SMOOTH: f64 = std::f64::consts::PI / 12.0;

/// Shortest piece of outline between nodes, in spacings.
const SHORTEST: f64 = 0.5;

/// End of a side of a seam piece.
#[derive(Clone, Copy)]
struct PieceEnd {
    piece: usize,
    side: usize,
    end: usize,
}

/// Breakpoint across a seam, and the seam piece that leads to it.
struct Partner {
    piece: usize,
    point: usize,
}

/// Result of a simplification: notes on pieces that were joined, mistakes of pieces that cannot be.
#[derive(Debug, Default)]
pub(crate) struct Simplified {
    pub notes: Vec<PatternNote>,
    pub mistakes: Vec<Mistake>,
}

/// Simplification of the outlines of a pattern.
pub(crate) struct Simplifier<'a> {
    pub breakpoints: &'a mut Breakpoints,
    pub pattern: &'a Pattern,
    /// Spacing of the nodes, in m.
    pub spacing: f64,
}

impl Simplifier<'_> {
    /// Joins short pieces with neighbours, the shortest first. Pieces that cannot be joined are
    /// mistakes.
    pub fn run(mut self) -> Simplified {
        let shortest = SHORTEST * self.spacing * (1.0 - 1e-9);
        let mut notes = self.dissolve_runs(shortest);
        loop {
            // The short pieces of this pass.
            let mut short: Vec<(f64, usize)> = self
                .piece_starts()
                .into_iter()
                .map(|point| (self.breakpoints.counted_after(point), point))
                .filter(|(length, _)| *length < shortest)
                .collect();
            short.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));

            let mut changed = false;
            for &(length, point) in &short {
                // An earlier piece of this pass may have joined it already.
                if self.breakpoints.points[point].removed
                    || self.breakpoints.counted_after(point) != length
                {
                    continue;
                }
                let ends = [point, self.breakpoints.points[point].neighbours[1]];
                let mut classes = ends.map(|p| self.breakpoints.points[p].class).to_vec();
                classes.sort_by(|&a, &b| self.sharpest(a).total_cmp(&self.sharpest(b)));
                if let Some(&class) = classes.iter().find(|&&class| self.is_removable(class)) {
                    notes.extend(self.note(point, class));
                    self.remove(class);
                    changed = true;
                }
            }

            if !changed {
                let merged = self.collapse(&short);
                changed = !merged.is_empty();
                notes.extend(merged);
            }
            if !changed {
                let mistakes = short.iter().map(|&(length, point)| {
                    let EdgeName { panel, edge } = self.edge_after(point);
                    Mistake::ShortEdge { panel, edge, length, spacing: self.spacing }
                });
                return Simplified { mistakes: mistakes.collect(), notes };
            }
        }
    }

    /// Merges the ends of each of the `short` pieces, if possible. A piece is given by its length,
    /// in m, and the breakpoint before it. Returns notes on the pieces that were merged.
    fn collapse(&mut self, short: &[(f64, usize)]) -> Vec<PatternNote> {
        let mut notes = Vec::new();
        for &(length, point) in short {
            // An earlier piece may have changed it.
            if self.breakpoints.points[point].removed
                || self.breakpoints.counted_after(point) != length
            {
                continue;
            }
            let EdgeName { panel, edge } = self.edge_after(point);
            if self.breakpoints.collapse(point) {
                notes.push(PatternNote::Merged { panel, edge, length, spacing: self.spacing });
            }
        }
        notes
    }

    /// Removes the smooth breakpoints inside runs of pieces below `shortest`, in m. Digitised
    /// outlines consist of such runs.
    fn dissolve_runs(&mut self, shortest: f64) -> Vec<PatternNote> {
        let points = 0..self.breakpoints.points.len();
        let short: Vec<bool> =
            points.clone().map(|point| self.breakpoints.counted_after(point) < shortest).collect();
        let inside: Vec<usize> = points
            .filter(|&point| short[point] && short[self.breakpoints.points[point].neighbours[0]])
            .collect();

        let mut lost = vec![0; self.pattern.panels().len()];
        for point in inside {
            let class = self.breakpoints.points[point].class;
            if !self.breakpoints.points[point].removed && self.is_removable(class) {
                self.class(class).for_each(|p| lost[self.breakpoints.panel(p)] += 1);
                self.remove(class);
            }
        }

        let panels = self.pattern.panels().iter().zip(lost).filter(|(_, ends)| *ends > 0);
        panels
            .map(|(panel, ends)| {
                let (panel, spacing) = (panel.name().into(), self.spacing);
                PatternNote::Dissolved { panel, ends, spacing }
            })
            .collect()
    }

    /// Returns for each piece of outline the breakpoint at which it begins. Of two pieces that are
    /// sewn together only the piece on the first side counts.
    fn piece_starts(&self) -> Vec<usize> {
        let Breakpoints { points, pieces, .. } = &*self.breakpoints;
        let starts = (0..points.len()).filter(|&number| {
            let point = &points[number];
            let is_second_side = point.pieces[1]
                .is_some_and(|piece| Breakpoints::piece_start(&pieces[piece], 0) != number);
            !point.removed && !is_second_side
        });
        starts.collect()
    }

    /// Returns the breakpoints of `class` that are not removed.
    fn class(&self, class: usize) -> impl Iterator<Item = usize> + '_ {
        let points = &self.breakpoints.points;
        self.breakpoints.classes[class].iter().copied().filter(|&p| !points[p].removed)
    }

    /// Returns the largest corner angle of `class`, in rad.
    fn sharpest(&self, class: usize) -> f64 {
        self.class(class).map(|p| self.breakpoints.points[p].corner_angle).fold(0.0, f64::max)
    }

    /// Returns the end, at `point`, of the seam piece before it (`beside` 0) or after it (1).
    fn end_at(&self, point: usize, beside: usize) -> Option<PieceEnd> {
        let piece = self.breakpoints.points[point].pieces[beside]?;
        let SeamPiece { ends, forward, .. } = &self.breakpoints.pieces[piece];
        (0..2).find_map(|side| {
            let end = usize::from(forward[side] != (beside == 1));
            (ends[side][end] == point).then_some(PieceEnd { piece, side, end })
        })
    }

    /// Returns the breakpoint to which `point` is sewn by the piece before it (`beside` 0) or after
    /// it (1).
    fn partner(&self, point: usize, beside: usize) -> Option<Partner> {
        let PieceEnd { piece, side, end } = self.end_at(point, beside)?;
        Some(Partner { piece, point: self.breakpoints.pieces[piece].ends[1 - side][end] })
    }

    /// Returns whether all breakpoints of `class` can be removed. The outlines must be smooth
    /// there, and the pieces before and after must be sewn to the same breakpoint in the same
    /// sense.
    fn is_removable(&self, class: usize) -> bool {
        self.sharpest(class) < SMOOTH
            && self.class(class).all(|point| {
                let before = self.breakpoints.points[point].neighbours[0];
                let alike = match (self.partner(point, 0), self.partner(point, 1)) {
                    (None, None) => true,
                    (Some(first), Some(second)) => {
                        first.point == second.point
                            && first.point != point
                            && first.piece != second.piece
                            && self.same_sense(first.piece, second.piece)
                    }
                    _ => false,
                };
                // At least one breakpoint stays on an outline.
                alike && before != point
            })
    }

    /// Returns whether the two sides of the seam piece `first` run in the same sense if and only if
    /// the two sides of `second` do.
    fn same_sense(&self, first: usize, second: usize) -> bool {
        let [first, second] = [first, second].map(|piece| self.breakpoints.pieces[piece].forward);
        (first[0] == first[1]) == (second[0] == second[1])
    }

    /// Removes the breakpoints of `class`.
    fn remove(&mut self, class: usize) {
        let points: Vec<usize> = self.class(class).collect();
        for point in points {
            // The breakpoint on the other side may have joined the pieces already.
            if let (Some(before), Some(after)) = (self.end_at(point, 0), self.end_at(point, 1))
                && before.piece != after.piece
            {
                self.join(before, after);
            }
            let points = &mut self.breakpoints.points;
            let [before, after] = points[point].neighbours;
            points[before].neighbours[1] = after;
            points[after].neighbours[0] = before;
            points[point].removed = true;
        }
    }

    /// Joins two seam pieces whose ends `before` and `after` are at one breakpoint. The longer
    /// piece is extended: it keeps its seam, its sides and its sense.
    fn join(&mut self, before: PieceEnd, after: PieceEnd) {
        let is_after_longer = self.piece_length(after.piece) > self.piece_length(before.piece);
        let (kept, lost) = if is_after_longer { (after, before) } else { (before, after) };
        let pieces = &mut self.breakpoints.pieces;
        for flip in 0..2 {
            // The far end of the lost piece, on the side of the breakpoint (0) and across the seam
            // (1).
            let far = pieces[lost.piece].ends[lost.side ^ flip][1 - lost.end];
            pieces[kept.piece].ends[kept.side ^ flip][kept.end] = far;
        }
        pieces[lost.piece].removed = true;
        self.breakpoints.mark(kept.piece);
    }

    /// Returns the length of the first side of the seam piece `piece`, in m.
    fn piece_length(&self, piece: usize) -> f64 {
        let piece = &self.breakpoints.pieces[piece];
        self.breakpoints.length_after(Breakpoints::piece_start(piece, 0))
    }

    /// Returns a note on the piece after the breakpoint `piece`, which loses a breakpoint of
    /// `class`, if that breakpoint is the end of an edge.
    fn note(&self, piece: usize, class: usize) -> Option<PatternNote> {
        let points = &self.breakpoints.points;
        let after = points[piece].neighbours[1];
        let lost = if points[piece].class == class { piece } else { after };
        points[lost].edge?;
        let EdgeName { panel, edge } = self.edge_after(piece);
        let neighbour = if lost == piece { points[piece].neighbours[0] } else { after };
        let with = self.edge_after(neighbour).edge;
        let length = self.breakpoints.length_after(piece);
        (edge != with).then_some(PatternNote::Joined {
            panel,
            edge,
            with,
            length,
            spacing: self.spacing,
        })
    }

    /// Returns the names of the panel and of the edge in the middle of the piece after `point`.
    fn edge_after(&self, point: usize) -> EdgeName {
        let Breakpoints { points, lines, .. } = &*self.breakpoints;
        let line = &lines[points[point].line];
        let middle = points[point].distance + 0.5 * self.breakpoints.length_after(point);
        let after = line.starts.partition_point(|&s| s <= middle % line.length());
        let number = after.clamp(1, line.starts.len() - 1) - 1;
        let panel = &self.pattern.panels()[line.panel];
        let edge = panel.edges().nth(line.first_edge + number).expect("the panel has the edge");
        EdgeName { panel: panel.name().into(), edge: edge.name.clone() }
    }
}

/// Names of a panel and of one of its edges.
struct EdgeName {
    panel: String,
    edge: String,
}
