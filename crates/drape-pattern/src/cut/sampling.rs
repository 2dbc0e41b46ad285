//! Outlines sampled at the spacing, with the same number of nodes on both sides of every seam.
//!
//! `cutter` calls [`SampledPattern::new`], which finds the breakpoints, simplifies the outlines,
//! counts the arcs and places the nodes; each [`SampledOutline`] becomes a cut panel.

use super::breakpoint::{Breakpoints, SeamPiece};
use super::seam_nodes::{NodeId, SeamNodes, Tie};
use super::simplify::Simplifier;
use crate::edge::{Curve, Edge};
use crate::mistake::Mistake;
use crate::note::Note;
use crate::panel::Panel;
use crate::partition::Partition;
use crate::pattern::Pattern;

/// Largest angle between an edge and a yarn that counts as parallel, in rad.
const PARALLEL: f64 = 1e-9;

/// Largest number of nodes on an outline.
const NODES_MAX: f64 = 1e6;

/// Sampled outline of a panel.
#[derive(Debug, Clone, Default)]
pub(crate) struct SampledOutline {
    /// Positions of the nodes, anticlockwise, in m.
    pub nodes: Vec<[f64; 2]>,
    /// Whether each node is an end of an edge or of a seam piece.
    pub hard: Vec<bool>,
    /// Nodes of each edge from its start to its end.
    pub edges: Vec<Vec<u32>>,
    /// Distances of the nodes along the outline, in m, ascending: nodes past the start of the first edge have
    /// the perimeter added.
    distances: Vec<f64>,
}

/// Sampled outlines of a pattern.
#[derive(Debug)]
pub(crate) struct SampledPattern {
    pub outlines: Vec<SampledOutline>,
    /// Nodes of each seam.
    pub seams: Vec<SeamNodes>,
    pub notes: Vec<Note>,
}

impl SampledPattern {
    /// Samples the outlines of a pattern at a spacing in m, or returns all mistakes.
    pub fn new(pattern: &Pattern, spacing: f64) -> Result<Self, Vec<Mistake>> {
        let too_long = |panel: &Panel| {
            let nodes: f64 = panel.outline().iter().map(Edge::length).sum::<f64>() / spacing;
            let panel = panel.name().to_owned();
            (nodes > NODES_MAX).then_some(Mistake::TooMany { panel, nodes, spacing })
        };
        let mistakes: Vec<Mistake> = pattern.panels().iter().filter_map(too_long).collect();
        if !mistakes.is_empty() {
            return Err(mistakes);
        }
        let mut breakpoints = Breakpoints::new(pattern, spacing);
        let simplified = Simplifier { breakpoints: &mut breakpoints, pattern, spacing }.run();
        if !simplified.mistakes.is_empty() {
            return Err(simplified.mistakes);
        }
        let mut sampler = Sampler::new(&breakpoints, pattern, spacing);
        let panels = 0..pattern.panels().len();
        let outlines: Vec<SampledOutline> = panels.map(|panel| sampler.outline(panel)).collect();
        let few = |(panel, outline): (&Panel, &SampledOutline)| {
            let (name, at) = (panel.name().to_owned(), panel.outline()[0].start);
            (outline.nodes.len() < 3).then_some(Mistake::Narrow { panel: name, at, spacing })
        };
        let mistakes: Vec<Mistake> =
            pattern.panels().iter().zip(&outlines).filter_map(few).collect();
        if !mistakes.is_empty() {
            return Err(mistakes);
        }
        let seams = sampler.seams(&outlines);
        Ok(Self { outlines, seams, notes: simplified.notes })
    }
}

/// Sampler of the arcs between breakpoints.
struct Sampler<'a> {
    breakpoints: &'a Breakpoints,
    pattern: &'a Pattern,
    /// Number of arcs from each breakpoint to the next.
    counts: Vec<u32>,
    /// Node of each breakpoint on its outline, once the outline is sampled.
    first_node: Vec<usize>,
}

impl<'a> Sampler<'a> {
    fn new(breakpoints: &'a Breakpoints, pattern: &'a Pattern, spacing: f64) -> Self {
        let counts = Counter { breakpoints, pattern, spacing }.counts();
        let first_node = vec![0; breakpoints.points.len()];
        Self { breakpoints, pattern, counts, first_node }
    }

    /// Samples the outline of a panel.
    fn outline(&mut self, panel: usize) -> SampledOutline {
        let mut sampled = SampledOutline::default();
        let outline = self.pattern.panels()[panel].outline();
        let perimeter = self.breakpoints.perimeter(panel);
        let starts = &self.breakpoints.starts[panel];
        for point in self.breakpoints.ring(panel) {
            self.first_node[point] = sampled.nodes.len();
            let start = self.breakpoints.points[point].distance;
            let length = self.breakpoints.length_after(point);
            for k in 0..self.counts[point] {
                let distance = start + length * f64::from(k) / f64::from(self.counts[point]);
                sampled.distances.push(distance);
                let distance = if distance >= perimeter { distance - perimeter } else { distance };
                let edge = starts.partition_point(|&s| s <= distance).clamp(1, outline.len()) - 1;
                let fraction = (distance - starts[edge]) / (starts[edge + 1] - starts[edge]);
                sampled.nodes.push(outline[edge].at(fraction));
                sampled.hard.push(k == 0);
            }
        }
        let edge = |e: usize| sampled.chain([starts[e], starts[e + 1]], perimeter);
        sampled.edges = (0..outline.len()).map(edge).collect();
        sampled
    }

    /// Returns the nodes of all seams.
    fn seams(&self, outlines: &[SampledOutline]) -> Vec<SeamNodes> {
        let mut seams = vec![SeamNodes::default(); self.pattern.seams().len()];
        for piece in self.breakpoints.pieces.iter().filter(|p| !p.removed) {
            self.sew(piece, outlines, &mut seams[piece.seam]);
        }
        for merge in &self.breakpoints.merges {
            let node = |point: usize| NodeId {
                panel: self.breakpoints.points[point].panel,
                node: self.first_node[point] as u32,
            };
            let pair = merge.points.map(node);
            if !seams[merge.seam].pairs.contains(&pair) {
                seams[merge.seam].pairs.push(pair);
            }
        }
        seams
    }

    /// Adds the nodes of a seam piece to its seam.
    fn sew(&self, piece: &SeamPiece, outlines: &[SampledOutline], seam: &mut SeamNodes) {
        let own = [0, 1].map(|side| self.counts[Breakpoints::foremost(piece, side)] as usize);
        let count = own[0].min(own[1]);
        // Number of arcs of each side between two pairs.
        let arcs = own.map(|own| own / count);
        let node = |side: usize, k: usize| {
            let start = piece.ends[side][0];
            let panel = self.breakpoints.points[start].panel;
            let nodes = outlines[panel].nodes.len();
            let steps = if piece.forward[side] { k } else { nodes - k % nodes };
            NodeId { panel, node: ((self.first_node[start] + steps) % nodes) as u32 }
        };
        let SeamNodes { pairs, ties } = seam;
        for k in 0..=count {
            let pair = [0, 1].map(|side| node(side, k * arcs[side]));
            // A piece begins where the one before it ended.
            if pairs.last() != Some(&pair) {
                pairs.push(pair);
            }
            for side in (0..2).filter(|_| k < count) {
                ties.extend((1..arcs[side]).map(|step| Tie {
                    after: pairs.len() - 1,
                    side,
                    node: node(side, k * arcs[side] + step),
                    fraction: step as f64 / arcs[side] as f64,
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
        let mut same = Partition::new(points.len());
        for piece in pieces.iter().filter(|p| !p.removed) {
            same.unite(Breakpoints::foremost(piece, 0), Breakpoints::foremost(piece, 1));
        }
        let sewn = same.clone();
        for (number, panel) in self.pattern.panels().iter().enumerate() {
            let Some([a, b, c, d]) = self.rectangle(panel, number) else { continue };
            for [one, opposite] in [[a, c], [b, d]] {
                // The other side of a gather keeps the spacing; if that gives another number, there
                // is a rim.
                if [one, opposite].iter().all(|&point| self.breakpoints.fullness(point) == 1) {
                    same.unite(one, opposite);
                }
            }
        }
        let counts = self.largest_of(&same);
        // Through several panels a rectangle may get far more nodes than it needs: then it gets a
        // rim.
        let crowded = (0..points.len()).any(|point| {
            let arc = self.breakpoints.length_after(point) / f64::from(counts[point]);
            !points[point].removed && arc < self.spacing / 3.0
        });
        if crowded { self.largest_of(&sewn) } else { counts }
    }

    /// Returns for each breakpoint the largest number of arcs in its part of a partition; the
    /// longer pieces of gathers have that of the shorter ones times their fullness.
    fn largest_of(&self, same: &Partition) -> Vec<u32> {
        let points = &self.breakpoints.points;
        let mut most = vec![1; points.len()];
        for point in (0..points.len()).filter(|&p| !points[p].removed) {
            let own =
                (self.breakpoints.counted_after(point) / self.spacing).round().max(1.0) as u32;
            let root = same.root(point);
            most[root] = own.max(most[root]);
        }
        let times = |point| match self.breakpoints.is_gathered(point) {
            true => self.breakpoints.fullness(point),
            false => 1,
        };
        (0..points.len()).map(|point| most[same.root(point)] * times(point)).collect()
    }

    /// Returns the four breakpoints of a panel that is a rectangle along the yarns.
    fn rectangle(&self, panel: &Panel, number: usize) -> Option<[usize; 4]> {
        let points = &self.breakpoints.points;
        let straight = panel.outline().iter().all(|e| e.curve == Curve::Line);
        let mut own =
            (0..points.len()).filter(|&p| points[p].panel == number && !points[p].removed);
        let first = own.next()?;
        let next = |p: usize| points[p].neighbours[1];
        let corners = [first, next(first), next(next(first)), next(next(next(first)))];
        let parallel = |edge: &Edge| {
            let [[x, y], _] = edge.tangents();
            // The angle of the edge to the yarns, modulo a right angle.
            let angle = (y.atan2(x) - panel.grain()).rem_euclid(std::f64::consts::FRAC_PI_2);
            angle.min(std::f64::consts::FRAC_PI_2 - angle) < PARALLEL
        };
        (next(corners[3]) == first
            && straight
            && corners.iter().all(|&p| points[p].corner_angle > 1.0)
            && panel.outline().iter().all(parallel))
        .then_some(corners)
    }
}

impl SampledOutline {
    /// Returns the nodes of an edge between two distances along the outline: from the node nearest
    /// to its start to that nearest to its end.
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

    /// Returns the node nearest to a distance along the outline.
    fn nearest(&self, distance: f64, perimeter: f64) -> usize {
        let n = self.distances.len();
        let before_first = self.distances.first().is_some_and(|&first| distance < first);
        let distance = if before_first { distance + perimeter } else { distance };
        let after = self.distances.partition_point(|&d| d < distance);
        let gap = |k: usize| {
            let apart = (self.distances[k] - distance).abs();
            apart.min((perimeter - apart).abs())
        };
        let (before, after) = ((after + n - 1) % n, after % n);
        if gap(before) < gap(after) { before } else { after }
    }
}
