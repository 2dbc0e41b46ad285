//! Outlines sampled at the spacing, with the same number of arcs on both sides of every seam.
//!
//! `cutter` calls [`SampledPattern::new`], which finds the breakpoints, simplifies the outlines,
//! counts the arcs and places the nodes. Each [`SampledPanel`] becomes a cut panel.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use super::breakpoint::{Breakpoints, SeamPiece};
use super::seam_nodes::{NodeId, SeamNodes, Tie};
use super::simplify::Simplifier;
use crate::edge::{Curve, Edge};
use crate::mistake::Mistake;
use crate::note::PatternNote;
use crate::panel::Panel;
use crate::pattern::Pattern;
use crate::pattern::partition::Partition;

/// Largest angle between an edge and a yarn that counts as parallel, in rad.
const PARALLEL: f64 = 1e-9;

/// Largest number of nodes on an outline.
const MOST_NODES: f64 = 1e6;

/// Sampled closed lines of a panel: its outline, then the holes of its darts.
#[derive(Debug, Clone, Default)]
pub(crate) struct SampledPanel {
    /// Positions of the nodes along the lines, with the cloth on the left, in m.
    pub nodes: Vec<[f64; 2]>,
    /// Whether each node is an end of an edge or of a seam piece.
    pub hard: Vec<bool>,
    /// Nodes of each edge from its start to its end.
    pub edges: Vec<Vec<u32>>,
    /// Nodes of each line.
    pub lines: Vec<Range<usize>>,
}

/// Sampled closed line.
#[derive(Debug, Clone, Default)]
struct SampledLine {
    /// Positions of the nodes, in m.
    nodes: Vec<[f64; 2]>,
    /// Whether each node is an end of an edge or of a seam piece.
    hard: Vec<bool>,
    /// Nodes of each edge from its start to its end.
    edges: Vec<Vec<u32>>,
    /// Distances of the nodes along the line, in m, ascending. Nodes past the start of the first
    /// edge have the length of the line added.
    distances: Vec<f64>,
}

/// Sampled outlines of a pattern.
#[derive(Debug)]
pub(crate) struct SampledPattern {
    pub panels: Vec<SampledPanel>,
    /// Nodes of each seam.
    pub seams: Vec<SeamNodes>,
    pub notes: Vec<PatternNote>,
}

impl SampledPattern {
    /// Samples the outlines of `pattern` at `spacing`, in m.
    ///
    /// # Errors
    /// All mistakes: outlines that are too long or too narrow for `spacing`, and edges too short.
    pub fn new(pattern: &Pattern, spacing: f64) -> Result<Self, Vec<Mistake>> {
        let mut mistakes = Vec::new();
        for panel in pattern.panels() {
            let nodes: f64 = panel.edges().map(Edge::length).sum::<f64>() / spacing;
            if nodes > MOST_NODES {
                let panel = panel.name().to_owned();
                mistakes.push(Mistake::TooMany { panel, nodes, spacing });
            }
        }
        if !mistakes.is_empty() {
            return Err(mistakes);
        }

        let mut breakpoints = Breakpoints::new(pattern, spacing);
        let simplified = Simplifier { breakpoints: &mut breakpoints, pattern, spacing }.run();
        if !simplified.mistakes.is_empty() {
            return Err(simplified.mistakes);
        }

        // The lines of a panel follow each other among its nodes.
        let mut sampler = Sampler::new(&breakpoints, pattern, spacing);
        let mut panels = vec![SampledPanel::default(); pattern.panels().len()];
        for (number, line) in breakpoints.lines.iter().enumerate() {
            let (panel, sampled_panel) = (&pattern.panels()[line.panel], &mut panels[line.panel]);
            let first = sampled_panel.nodes.len();
            sampler.ranges.push(LineNodes { panel: line.panel, first, count: 0 });
            let sampled = sampler.line(number);
            if sampled.nodes.len() < 3 {
                let edge = panel.edges().nth(line.first_edge).expect("a line has edges");
                let (panel, at) = (panel.name().to_owned(), edge.start);
                mistakes.push(Mistake::Narrow { panel, at, spacing });
            }
            sampler.ranges[number].count = sampled.nodes.len();
            sampled_panel.append(sampled);
        }
        if !mistakes.is_empty() {
            return Err(mistakes);
        }
        Ok(Self { panels, seams: sampler.seams(), notes: simplified.notes })
    }
}

impl SampledPanel {
    /// Adds `line` behind the lines of the panel.
    fn append(&mut self, line: SampledLine) {
        let first = self.nodes.len();
        for edge in line.edges {
            self.edges.push(edge.into_iter().map(|node| node + first as u32).collect());
        }
        self.lines.push(first..first + line.nodes.len());
        self.nodes.extend(line.nodes);
        self.hard.extend(line.hard);
    }
}

/// Nodes of a closed line among the nodes of its panel.
struct LineNodes {
    panel: usize,
    /// Number of the first node of the line, among the nodes of the panel.
    first: usize,
    /// Count of the nodes of the line.
    count: usize,
}

/// Sampler of the arcs between breakpoints.
struct Sampler<'a> {
    breakpoints: &'a Breakpoints,
    pattern: &'a Pattern,
    /// Number of arcs from each breakpoint to the next.
    counts: Vec<u32>,
    /// Node of each breakpoint on its line, once the line is sampled.
    first_node: Vec<usize>,
    /// Nodes of the lines that are sampled.
    ranges: Vec<LineNodes>,
}

impl<'a> Sampler<'a> {
    /// Returns the sampler of `pattern` with `breakpoints`, at `spacing`, in m.
    fn new(breakpoints: &'a Breakpoints, pattern: &'a Pattern, spacing: f64) -> Self {
        let counts = Counter { breakpoints, pattern, spacing }.counts();
        let first_node = vec![0; breakpoints.points.len()];
        Self { breakpoints, pattern, counts, first_node, ranges: Vec::new() }
    }

    /// Samples the closed line with the number `number`.
    fn line(&mut self, number: usize) -> SampledLine {
        let mut sampled = SampledLine::default();
        let line = &self.breakpoints.lines[number];
        let panel = &self.pattern.panels()[line.panel];
        let (perimeter, starts) = (line.length(), &line.starts);
        let edges: Vec<&Edge> =
            panel.edges().skip(line.first_edge).take(starts.len() - 1).collect();

        for point in self.breakpoints.ring(number) {
            self.first_node[point] = sampled.nodes.len();
            let start = self.breakpoints.points[point].distance;
            let length = self.breakpoints.length_after(point);
            for k in 0..self.counts[point] {
                let distance = start + length * f64::from(k) / f64::from(self.counts[point]);
                sampled.distances.push(distance);
                // The last piece may run on past the start of the line.
                let distance = if distance >= perimeter { distance - perimeter } else { distance };
                let edge = starts.partition_point(|&s| s <= distance).clamp(1, edges.len()) - 1;
                let fraction = (distance - starts[edge]) / (starts[edge + 1] - starts[edge]);
                sampled.nodes.push(edges[edge].at(fraction));
                sampled.hard.push(k == 0);
            }
        }

        sampled.edges = (0..edges.len())
            .map(|edge| sampled.chain([starts[edge], starts[edge + 1]], perimeter))
            .collect();
        sampled
    }

    /// Returns the nodes of all seams.
    fn seams(&self) -> Vec<SeamNodes> {
        let mut seams = vec![SeamNodes::default(); self.pattern.seams().len()];
        for piece in self.breakpoints.pieces.iter().filter(|p| !p.removed) {
            self.sew(piece, &mut seams[piece.seam]);
        }
        // Pairs of the seams that have merges.
        let mut known: BTreeMap<usize, BTreeSet<[NodeId; 2]>> = BTreeMap::new();
        for merge in &self.breakpoints.merges {
            let seam = &mut seams[merge.seam];
            let pairs = known.entry(merge.seam);
            let pairs = pairs.or_insert_with(|| seam.pairs.iter().copied().collect());
            let pair = merge.points.map(|point| self.node(point, 0));
            if pairs.insert(pair) {
                seam.begin_piece(pair);
            }
        }
        seams
    }

    /// Returns the node `steps` along its line from the breakpoint `point`, or back if negative.
    fn node(&self, point: usize, steps: isize) -> NodeId {
        let LineNodes { panel, first, count } = self.ranges[self.breakpoints.points[point].line];
        let along = (self.first_node[point] as isize + steps).rem_euclid(count as isize);
        NodeId { panel, node: (first + along as usize) as u32 }
    }

    /// Returns the node on `side` of the seam piece `piece`, `k` arcs after its start.
    fn seam_node(&self, piece: &SeamPiece, side: usize, k: usize) -> NodeId {
        let steps = if piece.forward[side] { k as isize } else { -(k as isize) };
        self.node(piece.ends[side][0], steps)
    }

    /// Adds the nodes of the seam piece `piece` to `seam`.
    fn sew(&self, piece: &SeamPiece, seam: &mut SeamNodes) {
        let counts = [0, 1].map(|side| self.counts[Breakpoints::piece_start(piece, side)] as usize);
        let count = counts[0].min(counts[1]);
        // Count of arcs between two nodes, on each side, from one sewn pair to the next.
        let arc_counts = counts.map(|arcs| arcs / count);
        for k in 0..=count {
            let pair = [0, 1].map(|side| self.seam_node(piece, side, k * arc_counts[side]));
            match k {
                0 => seam.begin_piece(pair),
                _ => seam.pairs.push(pair),
            }

            // Nodes of the longer side of a gather, up to the next pair.
            for side in (0..2).filter(|_| k < count) {
                let after = seam.pairs.len() - 1;
                seam.ties.extend((1..arc_counts[side]).map(|step| Tie {
                    after,
                    side,
                    node: self.seam_node(piece, side, k * arc_counts[side] + step),
                    fraction: step as f64 / arc_counts[side] as f64,
                }));
            }
        }
    }
}

/// Counter of the arcs between breakpoints.
struct Counter<'a> {
    breakpoints: &'a Breakpoints,
    pattern: &'a Pattern,
    /// Spacing of the nodes, in m.
    spacing: f64,
}

impl Counter<'_> {
    /// Returns the number of arcs from each breakpoint to the next.
    fn counts(&self) -> Vec<u32> {
        let Breakpoints { points, pieces, .. } = self.breakpoints;

        // Pieces that are sewn together have the same number of arcs.
        let mut same = Partition::new(points.len());
        for piece in pieces.iter().filter(|p| !p.removed) {
            same.unite(Breakpoints::piece_start(piece, 0), Breakpoints::piece_start(piece, 1));
        }
        let sewn = same.clone();

        // Opposite sides of a rectangle too, so that it needs no rim.
        for (number, panel) in self.pattern.panels().iter().enumerate() {
            let Some([a, b, c, d]) = self.rectangle(panel, number) else { continue };
            for [side, opposite] in [[a, c], [b, d]] {
                // The other side of a gather keeps the spacing. If that gives another number, there
                // is a rim.
                if [side, opposite].iter().all(|&point| self.breakpoints.fullness(point) == 1) {
                    same.unite(side, opposite);
                }
            }
        }
        let counts = self.largest_counts(&same);

        // Through several panels a rectangle may get far more nodes than it needs: then it gets a
        // rim.
        let crowded = (0..points.len()).any(|point| {
            let arc = self.breakpoints.length_after(point) / f64::from(counts[point]);
            !points[point].removed && arc < self.spacing / 3.0
        });
        if crowded { self.largest_counts(&sewn) } else { counts }
    }

    /// Returns for each breakpoint the largest number of arcs in its set of `same`. The longer
    /// piece of a gather has the number of the shorter piece times their fullness.
    fn largest_counts(&self, same: &Partition) -> Vec<u32> {
        let points = &self.breakpoints.points;
        let mut largest = vec![1; points.len()];
        for point in (0..points.len()).filter(|&p| !points[p].removed) {
            let count =
                (self.breakpoints.counted_after(point) / self.spacing).round().max(1.0) as u32;
            let root = same.root(point);
            largest[root] = count.max(largest[root]);
        }
        (0..points.len())
            .map(|point| {
                let is_gathered = self.breakpoints.is_gathered(point);
                let factor = if is_gathered { self.breakpoints.fullness(point) } else { 1 };
                largest[same.root(point)] * factor
            })
            .collect()
    }

    /// Returns the four breakpoints of `panel`, the panel with the number `number`, if it is a
    /// rectangle along the yarns.
    fn rectangle(&self, panel: &Panel, number: usize) -> Option<[usize; 4]> {
        let points = &self.breakpoints.points;
        let lines = &self.breakpoints.lines;
        // A panel with holes has a rim.
        let outline = lines.partition_point(|line| line.panel < number);
        let line_after = lines.get(outline + 1);
        if line_after.is_some_and(|line| line.panel == number) {
            return None;
        }

        let on_outline = lines[outline].points.iter().copied();
        let first = on_outline.filter(|&point| !points[point].removed).min()?;
        let mut corners = [first; 4];
        for k in 1..4 {
            corners[k] = points[corners[k - 1]].neighbours[1];
        }
        let is_rectangle = points[corners[3]].neighbours[1] == first
            && panel.edges().all(|edge| edge.curve == Curve::Line)
            && corners.iter().all(|&p| points[p].corner_angle > 1.0)
            && panel.outline().iter().all(|edge| is_along_yarns(edge, panel.grain()));
        is_rectangle.then_some(corners)
    }
}

/// Returns whether `edge` begins along the warp or the weft. `grain` is the angle of the warp to
/// the y axis, in rad.
fn is_along_yarns(edge: &Edge, grain: f64) -> bool {
    let [[x, y], _] = edge.tangents();
    let angle = (y.atan2(x) - grain).rem_euclid(std::f64::consts::FRAC_PI_2);
    angle.min(std::f64::consts::FRAC_PI_2 - angle) < PARALLEL
}

impl SampledLine {
    /// Returns the nodes of an edge between the distances `from` and `to` along the line, in m:
    /// from the node nearest to its start to the node nearest to its end. `perimeter` is the length
    /// of the line, in m.
    fn chain(&self, [from, to]: [f64; 2], perimeter: f64) -> Vec<u32> {
        if self.nodes.is_empty() {
            return Vec::new();
        }
        let (first, last) = (self.nearest(from, perimeter), self.nearest(to, perimeter));
        let n = self.nodes.len();
        let steps = (last + n - first) % n;
        let steps = if steps == 0 && to - from > 0.5 * perimeter { n } else { steps };
        (0..=steps).map(|k| ((first + k) % n) as u32).collect()
    }

    /// Returns the node nearest to `distance` along the line, in m. `perimeter` is the length of
    /// the line, in m.
    fn nearest(&self, distance: f64, perimeter: f64) -> usize {
        let n = self.distances.len();
        let before_first = self.distances.first().is_some_and(|&first| distance < first);
        let distance = if before_first { distance + perimeter } else { distance };
        let after = self.distances.partition_point(|&d| d < distance);
        let candidates = [(after + n - 1) % n, after % n];
        let [gap_before, gap_after] = candidates.map(|k| {
            let apart = (self.distances[k] - distance).abs();
            apart.min((perimeter - apart).abs())
        });
        if gap_before < gap_after { candidates[0] } else { candidates[1] }
    }
}
