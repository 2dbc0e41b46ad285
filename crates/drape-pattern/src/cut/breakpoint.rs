//! Breakpoints of outlines: the points that become nodes, with the seam pieces between them.
//!
//! A breakpoint is an end of an edge, or a notch: the point on one side of a seam that an end of an
//! edge on the other side is sewn to. Between two breakpoints an outline is sampled at equal arcs;
//! `simplify` removes breakpoints, `sampling` samples the arcs.

use super::merge::Merge;
use crate::edge::Edge;
use crate::pattern::Pattern;
use crate::pattern::seam::{EdgeId, Seam};

/// Difference of two fractions of a seam's length below which they are equal but for rounding.
const SAME: f64 = 1e-9;

/// Ratio of the lengths of two pieces that are sewn together above which they are a gather.
///
/// With as many arcs on both sides, those of the shorter one would be under two thirds of the
/// spacing. The small addition keeps a ratio of 1.5 in a file, which is rounded, from being a
/// gather.
const GATHER: f64 = 1.5 + 1e-6;

/// Point of an outline that becomes a node; the arcs between two of them are sampled.
#[derive(Debug, Clone)]
pub(crate) struct Breakpoint {
    /// Number of the closed line that it lies on, among those of all panels.
    pub line: usize,
    /// Distance along the line from the start of its first edge, in m.
    pub distance: f64,
    /// Angle between the tangents before and after the point, without sign, in rad.
    pub corner_angle: f64,
    /// Number of the edge that begins here, if one does.
    pub edge: Option<usize>,
    /// Number of the class; breakpoints that are sewn to each other have the same class.
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
    /// Breakpoints where it starts and ends, for both sides.
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
    /// Breakpoints that are all of a collapsed piece.
    pub merges: Vec<Merge>,
    /// Closed lines of all panels: of each panel its outline, then the holes of its darts.
    pub lines: Vec<ClosedLine>,
}

/// Closed line of a panel.
#[derive(Debug, Clone)]
pub(crate) struct ClosedLine {
    /// Number of the panel.
    pub panel: usize,
    /// Number of its first edge among those of the panel.
    pub first_edge: usize,
    /// Distances along the line at which its edges start, and its length, in m.
    pub starts: Vec<f64>,
    /// First breakpoint of the line; the breakpoints at the starts of its edges follow.
    first: usize,
}

impl ClosedLine {
    /// Returns the length, in m.
    pub fn length(&self) -> f64 {
        self.starts.last().copied().unwrap_or(0.0)
    }

    /// Returns the number of edges.
    fn edges(&self) -> usize {
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
    /// Breakpoint that begins the piece after it, for both sides; another one where a chain goes on
    /// in another panel.
    after: [usize; 2],
}

impl Breakpoints {
    /// Returns the breakpoints of a pattern for a spacing in m.
    pub fn new(pattern: &Pattern, spacing: f64) -> Self {
        let mut all = Self::default();
        for (panel, own) in pattern.panels().iter().enumerate() {
            let mut first_edge = 0;
            for edges in own.loops() {
                all.add_line(panel, first_edge, edges);
                first_edge += edges.len();
            }
        }
        for (index, seam) in pattern.seams().iter().enumerate() {
            all.sew(pattern, seam, index, spacing);
        }
        all.connect();
        all
    }

    /// Adds a closed line of a panel with the breakpoints at the starts of its edges.
    fn add_line(&mut self, panel: usize, first_edge: usize, edges: &[Edge]) {
        let (line, first) = (self.lines.len(), self.points.len());
        let mut distance = 0.0;
        let mut starts = vec![distance];
        for (index, edge) in edges.iter().enumerate() {
            let before = &edges[(index + edges.len() - 1) % edges.len()];
            let point = self.insert(line, distance);
            self.points[point].corner_angle = corner_angle(before, edge);
            self.points[point].edge = Some(first_edge + index);
            distance += edge.length();
            starts.push(distance);
        }
        self.lines.push(ClosedLine { panel, first_edge, starts, first });
    }

    /// Returns the number of the closed line of an edge, and the number of the edge there.
    fn place(&self, id: EdgeId) -> [usize; 2] {
        let own = |line: &ClosedLine| {
            let edges = line.first_edge..line.first_edge + line.edges();
            line.panel == id.panel && edges.contains(&id.edge)
        };
        let line = self.lines.iter().position(own).expect("its pattern has the edge");
        [line, id.edge - self.lines[line].first_edge]
    }

    /// Returns the number of the panel of a breakpoint.
    pub fn panel(&self, point: usize) -> usize {
        self.lines[self.points[point].line].panel
    }

    /// Adds a smooth breakpoint that begins no edge.
    fn insert(&mut self, line: usize, distance: f64) -> usize {
        let class = self.points.len();
        self.classes.push(vec![class]);
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

    /// Returns the breakpoints of a closed line that are not removed, along it.
    pub fn ring(&self, line: usize) -> Vec<usize> {
        let own = |p: &usize| self.points[*p].line == line && !self.points[*p].removed;
        let mut ring: Vec<usize> = (0..self.points.len()).filter(own).collect();
        let distance = |p: usize| self.points[p].distance;
        ring.sort_by(|&a, &b| distance(a).total_cmp(&distance(b)).then(a.cmp(&b)));
        ring
    }

    /// Returns the length of the outline from a breakpoint to the next, in m.
    pub fn length_after(&self, point: usize) -> f64 {
        let next = self.points[point].neighbours[1];
        let [here, there] = [point, next].map(|p| self.points[p].distance);
        // Breakpoints at the same distance are in the order of their numbers.
        let onward = here.total_cmp(&there).then(point.cmp(&next)).is_lt();
        let whole = self.lines[self.points[point].line].length();
        if onward { there - here } else { there - here + whole }
    }

    /// Returns the length from which the arcs of the piece after a breakpoint are counted, in m.
    ///
    /// It is the length of the piece, or of the longer of two pieces that are sewn together. In a
    /// gather it is the geometric mean of the shorter piece and of the part of the longer one that
    /// has as many arcs, so that the arcs of both differ from the spacing by the same factor.
    pub fn counted_after(&self, point: usize) -> f64 {
        let Some([short, long]) = self.sewn_lengths(point) else { return self.length_after(point) };
        match fullness([short, long]) {
            1 => long,
            fullness => (short * long / f64::from(fullness)).sqrt(),
        }
    }

    /// Returns the number of arcs that the longer piece of a gather has for each arc of the shorter
    /// one, at the piece after a breakpoint; 1 outside of gathers.
    pub fn fullness(&self, point: usize) -> u32 {
        self.sewn_lengths(point).map_or(1, fullness)
    }

    /// Returns whether the piece after a breakpoint is the longer one of a gather.
    pub fn is_gathered(&self, point: usize) -> bool {
        let own = self.length_after(point);
        self.fullness(point) > 1 && self.sewn_lengths(point).is_some_and(|[short, _]| own > short)
    }

    /// Returns the lengths of the piece after a breakpoint and of the piece that it is sewn to, the
    /// shorter first, in m.
    fn sewn_lengths(&self, point: usize) -> Option<[f64; 2]> {
        let piece = &self.pieces[self.points[point].pieces[1]?];
        let [a, b] = [0, 1].map(|side| self.length_after(Self::foremost(piece, side)));
        Some([a.min(b), a.max(b)])
    }

    /// Returns the breakpoint after which a side of a seam piece lies on the outline.
    pub fn foremost(piece: &SeamPiece, side: usize) -> usize {
        piece.ends[side][usize::from(!piece.forward[side])]
    }

    fn side_edges(pattern: &Pattern, side: &[EdgeId], forward: bool) -> Vec<SideEdge> {
        let whole = pattern.side_length(side);
        let mut begin = 0.0;
        let edge = |&id: &EdgeId| {
            let end = begin + pattern.edge(id).length() / whole;
            let range = [begin, end];
            begin = end;
            SideEdge { id, forward, range }
        };
        let mut edges: Vec<SideEdge> = side.iter().map(edge).collect();
        // The fractions add up to one but for rounding.
        if let Some(last) = edges.last_mut() {
            last.range[1] = 1.0;
        }
        edges
    }

    /// Returns the breakpoints at which an edge starts and ends, in the direction of the seam.
    fn ends_of(&self, edge: &SideEdge) -> [usize; 2] {
        let [line, number] = self.place(edge.id);
        let line = &self.lines[line];
        let ends = [number, (number + 1) % line.edges()].map(|number| line.first + number);
        if edge.forward { ends } else { [ends[1], ends[0]] }
    }

    /// Adds a notch at a fraction of a side and returns it.
    fn notch(&mut self, edges: &[SideEdge], fraction: f64) -> usize {
        let edge = edges.iter().find(|e| fraction < e.range[1]).unwrap_or(&edges[edges.len() - 1]);
        let [begin, end] = edge.range;
        let part = ((fraction - begin) / (end - begin)).clamp(0.0, 1.0);
        let [line, number] = self.place(edge.id);
        let [from, to] = [0, 1].map(|end| self.lines[line].starts[number + end]);
        let part = if edge.forward { part } else { 1.0 - part };
        self.insert(line, from + part * (to - from))
    }

    /// Makes the seam pieces of a seam.
    ///
    /// Points of both sides correspond by the fraction of the length of the side; ends of edges on
    /// both sides that lie less than half a spacing apart correspond to each other.
    fn sew(&mut self, pattern: &Pattern, seam: &Seam, index: usize, spacing: f64) {
        let forward = [true, seam.reversed];
        let sides = [0, 1].map(|side| Self::side_edges(pattern, &seam.sides[side], forward[side]));
        let [one, other] = seam.sides.each_ref().map(|side| pattern.side_length(side));
        let tolerance = 0.5 * spacing / one.min(other);
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

    /// Adds points at the ends of edges between two points with an end on both sides, each given by
    /// the numbers of the edges after it; the other side gets a notch.
    fn notch_between(
        &mut self,
        sides: &Sides,
        [from, to]: [[usize; 2]; 2],
        points: &mut Vec<SeamPoint>,
    ) {
        // Fractions of each side between which it runs here.
        let range = [0, 1].map(|s| [sides[s][from[s]].range[0], sides[s][to[s] - 1].range[1]]);
        let mut ends: Vec<(f64, usize, usize)> = Vec::new();
        for side in 0..2 {
            let [low, high] = range[side];
            let between = from[side]..to[side] - 1;
            ends.extend(between.map(|k| ((sides[side][k].range[1] - low) / (high - low), side, k)));
        }
        ends.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        // Fraction of the range, and for both sides the edge that ends there.
        let mut found: Vec<(f64, [Option<usize>; 2])> = Vec::new();
        for (fraction, side, k) in ends {
            match found.last_mut() {
                Some((at, both)) if fraction - *at < SAME && both[side].is_none() => {
                    both[side] = Some(k)
                }
                _ => {
                    let mut both = [None; 2];
                    both[side] = Some(k);
                    found.push((fraction, both));
                }
            }
        }
        for (fraction, both) in found {
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

    /// Makes one class of the classes of two breakpoints.
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

    /// Sets a seam piece at the breakpoints of its ends.
    pub fn mark(&mut self, piece: usize) {
        let SeamPiece { ends, forward, .. } = self.pieces[piece].clone();
        for side in 0..2 {
            let [start, end] = ends[side];
            self.points[start].pieces[usize::from(forward[side])] = Some(piece);
            self.points[end].pieces[usize::from(!forward[side])] = Some(piece);
        }
    }
}

/// Returns the number of arcs of the longer of two pieces for each arc of the shorter one.
fn fullness([short, long]: [f64; 2]) -> u32 {
    // No more than a pattern may have.
    if long > GATHER * short { (long / short).round().min(100.0) as u32 } else { 1 }
}

/// Returns pairs of ends of edges of both sides that are sewn to each other, as the numbers of the
/// edges after them; the last pair is the end of both sides.
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

/// Returns the angle between the end of an edge and the start of the next, in rad.
fn corner_angle(before: &Edge, after: &Edge) -> f64 {
    let ([_, a], [b, _]) = (before.tangents(), after.tangents());
    (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1]).abs()
}
