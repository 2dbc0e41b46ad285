//! Breakpoints of outlines: the points that become nodes, with the seam pieces between them.
//!
//! A breakpoint is an end of an edge, or a notch: the point on one side of a seam that an end of an
//! edge on the other side is sewn to. Between two breakpoints an outline is sampled at equal arcs.
//! `simplify` removes breakpoints, `sampling` samples the arcs.

use super::merge::Merge;
use crate::edge::{Edge, turning_angle};
use crate::pattern::Pattern;
use crate::pattern::seam::{EdgeId, Seam};

/// Difference of two fractions of a seam's length below which they are equal but for rounding.
const SAME: f64 = 1e-9;

/// Ratio of the lengths of two pieces that are sewn together above which they are a gather.
///
/// With the same number of arcs on both sides, arcs of the shorter piece would be under two thirds
/// of the spacing. The small addition keeps a ratio of 1.5 in a file, which is rounded, from being
/// a gather.
const GATHER: f64 = 1.5 + 1e-6;

/// Point of an outline that becomes a node. The arcs between two of them are sampled.
#[derive(Debug, Clone)]
pub(crate) struct Breakpoint {
    /// Number of the closed line that it lies on, among the closed lines of all panels.
    pub line: usize,
    /// Distance along the line from the start of its first edge, in m.
    pub distance: f64,
    /// Angle between the tangents before and after the point, without sign, in rad.
    pub corner_angle: f64,
    /// Number of the edge that begins at the breakpoint, if an edge does.
    pub edge: Option<usize>,
    /// Number of the class. Breakpoints that are sewn to each other have the same class.
    pub class: usize,
    /// Breakpoints before and after it on the outline.
    pub neighbours: [usize; 2],
    /// Seam pieces on the outline before and after it.
    pub pieces: [Option<usize>; 2],
    pub removed: bool,
}

/// Two pieces of outlines without breakpoints inside that are sewn together.
#[derive(Debug, Clone)]
pub(crate) struct SeamPiece {
    /// Number of the seam.
    pub seam: usize,
    /// Breakpoints at its start and its end, for both sides.
    pub ends: [[usize; 2]; 2],
    /// Whether it runs along the outline, for both sides.
    pub forward: [bool; 2],
    pub removed: bool,
}

/// Breakpoints and seam pieces of a pattern.
#[derive(Debug, Default)]
pub(crate) struct Breakpoints {
    pub points: Vec<Breakpoint>,
    pub pieces: Vec<SeamPiece>,
    /// Breakpoints of each class.
    pub classes: Vec<Vec<usize>>,
    /// Pairs of breakpoints that remain of collapsed pieces.
    pub merges: Vec<Merge>,
    /// Closed lines of all panels: the outline of each panel, then the holes of its darts.
    pub lines: Vec<ClosedLine>,
}

/// Closed line of a panel.
#[derive(Debug, Clone)]
pub(crate) struct ClosedLine {
    /// Number of the panel.
    pub panel: usize,
    /// Number of its first edge among the edges of the panel.
    pub first_edge: usize,
    /// Distances along the line at which its edges start, and its length, in m.
    pub starts: Vec<f64>,
    /// Breakpoints of the line, removed ones included: first those at the starts of its edges, in
    /// their order.
    pub points: Vec<usize>,
}

impl ClosedLine {
    /// Returns the length, in m.
    pub fn length(&self) -> f64 {
        self.starts.last().copied().unwrap_or(0.0)
    }

    /// Returns the number of edges.
    fn edge_count(&self) -> usize {
        self.starts.len() - 1
    }
}

/// Edge on a side of a seam.
struct SideEdge {
    id: EdgeId,
    forward: bool,
    /// Fractions of the length of the side at which it begins and ends.
    range: [f64; 2],
}

/// Edges of both sides of a seam.
type Sides = [Vec<SideEdge>; 2];

/// Point along a seam where both sides have a breakpoint.
#[derive(Clone, Copy)]
struct SeamPoint {
    /// Breakpoint that ends the piece before it, for both sides.
    before: [usize; 2],
    /// Breakpoint that begins the piece after it, for both sides. It is another breakpoint where a
    /// chain goes on in another panel.
    after: [usize; 2],
}

impl Breakpoints {
    /// Returns the breakpoints of `pattern` for a spacing of `spacing`, in m.
    pub fn new(pattern: &Pattern, spacing: f64) -> Self {
        let mut breakpoints = Self::default();
        for (number, panel) in pattern.panels().iter().enumerate() {
            let mut first_edge = 0;
            for edges in panel.loops() {
                breakpoints.add_line(number, first_edge, edges);
                first_edge += edges.len();
            }
        }
        for (index, seam) in pattern.seams().iter().enumerate() {
            breakpoints.sew(pattern, seam, index, spacing);
        }
        breakpoints.connect();
        breakpoints
    }

    /// Adds the closed line `edges` of the panel with the number `panel`, with the breakpoints at
    /// the starts of its edges. `first_edge` is the number of its first edge.
    fn add_line(&mut self, panel: usize, first_edge: usize, edges: &[Edge]) {
        let line = self.lines.len();
        self.lines.push(ClosedLine { panel, first_edge, starts: vec![0.0], points: Vec::new() });
        let mut distance = 0.0;
        for (index, edge) in edges.iter().enumerate() {
            let before = &edges[(index + edges.len() - 1) % edges.len()];
            let point = self.insert(line, distance);
            self.points[point].corner_angle =
                turning_angle(before.tangents()[1], edge.tangents()[0]).abs();
            self.points[point].edge = Some(first_edge + index);
            distance += edge.length();
            self.lines[line].starts.push(distance);
        }
    }

    /// Returns the number of the closed line of the edge `id`, and the number of the edge there.
    fn line_and_edge(&self, id: EdgeId) -> [usize; 2] {
        // The lines are in the order of their panels and edges, and the pattern has the edge.
        let begins = |line: &ClosedLine| (line.panel, line.first_edge) <= (id.panel, id.edge);
        let line = self.lines.partition_point(begins).saturating_sub(1);
        [line, id.edge - self.lines[line].first_edge]
    }

    /// Returns the number of the panel of the breakpoint `point`.
    pub fn panel(&self, point: usize) -> usize {
        self.lines[self.points[point].line].panel
    }

    /// Adds a smooth breakpoint that begins no edge to `line` at `distance`, in m, and returns it.
    fn insert(&mut self, line: usize, distance: f64) -> usize {
        let class = self.points.len();
        self.classes.push(vec![class]);
        self.lines[line].points.push(class);
        self.points.push(Breakpoint {
            line,
            distance,
            corner_angle: 0.0,
            edge: None,
            class,
            neighbours: [0; 2],
            pieces: [None; 2],
            removed: false,
        });
        class
    }

    /// Returns the breakpoints of `line` that are not removed, in the order along it.
    pub fn ring(&self, line: usize) -> Vec<usize> {
        let points = &self.points;
        let mut ring = self.lines[line].points.clone();
        ring.retain(|&point| !points[point].removed);
        ring.sort_by(|&a, &b| points[a].distance.total_cmp(&points[b].distance).then(a.cmp(&b)));
        ring
    }

    /// Returns the length of the outline from the breakpoint `point` to the next, in m.
    pub fn length_after(&self, point: usize) -> f64 {
        let next = self.points[point].neighbours[1];
        let [here, there] = [point, next].map(|p| self.points[p].distance);
        // Breakpoints at one distance are in the order of their numbers.
        let onward = here.total_cmp(&there).then(point.cmp(&next)).is_lt();
        let whole = self.lines[self.points[point].line].length();
        if onward { there - here } else { there - here + whole }
    }

    /// Returns the length that determines the number of arcs of the piece after `point`, in m.
    ///
    /// It is the length of the piece, or of the longer of two pieces that are sewn together. In a
    /// gather it is the geometric mean of the shorter piece and of the part of the longer piece
    /// that has the same number of arcs. The arcs of both then differ from the spacing by the same
    /// factor.
    pub fn counted_after(&self, point: usize) -> f64 {
        let Some([short, long]) = self.sewn_lengths(point) else { return self.length_after(point) };
        match fullness([short, long]) {
            1 => long,
            fullness => (short * long / f64::from(fullness)).sqrt(),
        }
    }

    /// Returns the number of arcs of the longer piece of a gather for each arc of the shorter
    /// piece, at the piece after `point`; 1 outside of gathers.
    pub fn fullness(&self, point: usize) -> u32 {
        self.sewn_lengths(point).map_or(1, fullness)
    }

    /// Returns whether the piece after `point` is the longer piece of a gather.
    pub fn is_gathered(&self, point: usize) -> bool {
        let length = self.length_after(point);
        self.fullness(point) > 1
            && self.sewn_lengths(point).is_some_and(|[short, _]| length > short)
    }

    /// Returns the lengths of the piece after `point` and of the piece that it is sewn to, the
    /// shorter first, in m; `None` if it is not sewn.
    fn sewn_lengths(&self, point: usize) -> Option<[f64; 2]> {
        let piece = &self.pieces[self.points[point].pieces[1]?];
        let [a, b] = [0, 1].map(|side| self.length_after(Self::piece_start(piece, side)));
        Some([a.min(b), a.max(b)])
    }

    /// Returns the breakpoint at which `side` of the seam piece `piece` begins along the outline.
    pub fn piece_start(piece: &SeamPiece, side: usize) -> usize {
        piece.ends[side][usize::from(!piece.forward[side])]
    }

    /// Returns the edges of `side`, a side of a seam that runs along outlines if `forward`.
    fn side_edges(pattern: &Pattern, side: &[EdgeId], forward: bool) -> Vec<SideEdge> {
        let whole = pattern.side_length(side);
        let mut begin = 0.0;
        let mut edges = Vec::new();
        for &id in side {
            let end = begin + pattern.edge(id).length() / whole;
            edges.push(SideEdge { id, forward, range: [begin, end] });
            begin = end;
        }
        // The fractions add up to one but for rounding.
        if let Some(last) = edges.last_mut() {
            last.range[1] = 1.0;
        }
        edges
    }

    /// Returns the breakpoints at which `edge` starts and ends, in the direction of the seam.
    fn ends_of(&self, edge: &SideEdge) -> [usize; 2] {
        let [line, number] = self.line_and_edge(edge.id);
        let line = &self.lines[line];
        let ends = [number, (number + 1) % line.edge_count()].map(|number| line.points[number]);
        if edge.forward { ends } else { [ends[1], ends[0]] }
    }

    /// Adds a notch at `fraction` of the side with the edges `edges`, and returns it.
    fn notch(&mut self, edges: &[SideEdge], fraction: f64) -> usize {
        let after = edges.partition_point(|edge| edge.range[1] <= fraction);
        let edge = &edges[after.min(edges.len() - 1)];
        let [begin, end] = edge.range;
        let part = ((fraction - begin) / (end - begin)).clamp(0.0, 1.0);
        let [line, number] = self.line_and_edge(edge.id);
        let [from, to] = [0, 1].map(|end| self.lines[line].starts[number + end]);
        let part = if edge.forward { part } else { 1.0 - part };
        self.insert(line, from + part * (to - from))
    }

    /// Adds the seam pieces of `seam`, the seam with the number `index`.
    ///
    /// Points of both sides correspond if they are at the same fraction of the length of their
    /// side. Ends of edges on both sides that lie less than half a spacing apart correspond to each
    /// other.
    fn sew(&mut self, pattern: &Pattern, seam: &Seam, index: usize, spacing: f64) {
        let forward = [true, seam.reversed];
        let sides = [0, 1].map(|side| Self::side_edges(pattern, &seam.sides[side], forward[side]));
        let [first_length, second_length] =
            seam.sides.each_ref().map(|side| pattern.side_length(side));
        let tolerance = 0.5 * spacing / first_length.min(second_length);

        // The points along the seam where both sides have a breakpoint.
        let start = [0, 1].map(|side| self.ends_of(&sides[side][0])[0]);
        let mut points = vec![SeamPoint { before: start, after: start }];
        // Numbers of the edges that begin at the last point with an end on both sides.
        let mut from = [0, 0];
        for to in matched_ends(&sides, tolerance) {
            self.notch_between(&sides, [from, to], &mut points);
            let at_end = to[0] == sides[0].len();
            let before = [0, 1].map(|side| self.ends_of(&sides[side][to[side] - 1])[1]);
            let after = [0, 1].map(|side| {
                if at_end { before[side] } else { self.ends_of(&sides[side][to[side]])[0] }
            });
            points.push(SeamPoint { before, after });
            from = to;
        }

        // Both breakpoints of a point become one node, also where a chain goes on elsewhere.
        for SeamPoint { before, after } in &points {
            for point in [after[0], before[1], after[1]] {
                self.unite(before[0], point);
            }
        }

        for pair in points.windows(2) {
            let ends = [0, 1].map(|side| [pair[0].after[side], pair[1].before[side]]);
            self.pieces.push(SeamPiece { seam: index, ends, forward, removed: false });
        }
    }

    /// Adds points at the ends of edges between two points with an end on both sides, which are
    /// given by the numbers `from` and `to` of the edges after them. The side without an end gets a
    /// notch.
    fn notch_between(
        &mut self,
        sides: &Sides,
        [from, to]: [[usize; 2]; 2],
        points: &mut Vec<SeamPoint>,
    ) {
        // Fractions of each side between which the points lie.
        let range = [0, 1].map(|s| [sides[s][from[s]].range[0], sides[s][to[s] - 1].range[1]]);
        let mut ends: Vec<(f64, usize, usize)> = Vec::new();
        for side in 0..2 {
            let [low, high] = range[side];
            let between = from[side]..to[side] - 1;
            ends.extend(between.map(|k| ((sides[side][k].range[1] - low) / (high - low), side, k)));
        }
        ends.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));

        // Ends of both sides at one fraction are one point. Each entry has the fraction of the
        // range, and for both sides the edge that ends there.
        let mut matched: Vec<(f64, [Option<usize>; 2])> = Vec::new();
        for (fraction, side, k) in ends {
            match matched.last_mut() {
                Some((at, both)) if fraction - *at < SAME && both[side].is_none() => {
                    both[side] = Some(k)
                }
                _ => {
                    let mut both = [None; 2];
                    both[side] = Some(k);
                    matched.push((fraction, both));
                }
            }
        }

        for (fraction, both) in matched {
            let around = [0, 1].map(|side| match both[side] {
                Some(k) => [self.ends_of(&sides[side][k])[1], self.ends_of(&sides[side][k + 1])[0]],
                None => {
                    let [low, high] = range[side];
                    [self.notch(&sides[side], low + fraction * (high - low)); 2]
                }
            });
            let [before, after] = [0, 1].map(|k| around.map(|side| side[k]));
            points.push(SeamPoint { before, after });
        }
    }

    /// Merges the classes of the breakpoints `a` and `b`.
    pub fn unite(&mut self, a: usize, b: usize) {
        let (a, b) = (self.points[a].class, self.points[b].class);
        if a != b {
            let moved = std::mem::take(&mut self.classes[a.max(b)]);
            moved.iter().for_each(|&point| self.points[point].class = a.min(b));
            self.classes[a.min(b)].extend(moved);
        }
    }

    /// Sets the neighbours along the outlines, and the seam pieces beside each breakpoint.
    fn connect(&mut self) {
        for line in 0..self.lines.len() {
            let ring = self.ring(line);
            for (k, &point) in ring.iter().enumerate() {
                let after = ring[(k + 1) % ring.len()];
                self.points[point].neighbours[1] = after;
                self.points[after].neighbours[0] = point;
            }
        }
        for piece in 0..self.pieces.len() {
            self.mark(piece);
        }
    }

    /// Records the seam piece `piece` at the breakpoints of its ends.
    pub fn mark(&mut self, piece: usize) {
        let SeamPiece { ends, forward, .. } = self.pieces[piece].clone();
        for side in 0..2 {
            let [start, end] = ends[side];
            self.points[start].pieces[usize::from(forward[side])] = Some(piece);
            self.points[end].pieces[usize::from(!forward[side])] = Some(piece);
        }
    }
}

/// Returns the number of arcs of the longer of two pieces for each arc of the shorter piece.
fn fullness([short, long]: [f64; 2]) -> u32 {
    // No more than a pattern may have.
    if long > GATHER * short { (long / short).round().min(100.0) as u32 } else { 1 }
}

/// Returns the pairs of ends of edges of both sides that are sewn to each other, by the numbers of
/// the edges after them. Ends that differ by less than `tolerance`, a fraction of the side, match.
/// The last pair is the end of both sides.
fn matched_ends(sides: &Sides, tolerance: f64) -> Vec<[usize; 2]> {
    let count = [sides[0].len(), sides[1].len()];
    let mut pairs = Vec::new();
    let (mut a, mut b) = (1, 1);
    while a < count[0] && b < count[1] {
        let difference = sides[0][a].range[0] - sides[1][b].range[0];
        if difference.abs() < tolerance {
            pairs.push([a, b]);
            (a, b) = (a + 1, b + 1);
        } else if difference < 0.0 {
            a += 1;
        } else {
            b += 1;
        }
    }
    pairs.push(count);
    pairs
}
