//! The points of outlines that become nodes: ends of edges, and the places on one side of a seam that an
//! end on the other side is sewn to.

use crate::edge::Edge;
use crate::pattern::{EdgeId, Pattern, Stitch};

/// Shares of the way along a stitch that differ by less are the same: rounding.
const SAME: f64 = 1e-9;

/// Ratio of the lengths of two pieces that are sewn together above which they are a gather: with as many arcs on
/// both, those of the shorter one would be under two thirds of the spacing. The digits of a file make no gather
/// of a ratio of 1.5.
const GATHER: f64 = 1.5 + 1e-6;

/// A point of an outline between which arcs are sampled.
#[derive(Debug, Clone)]
pub(crate) struct Joint {
    pub panel: usize,
    /// Distance along the outline from the start of its first edge, in m.
    pub place: f64,
    /// Angle that the outline turns through here, without sign, in rad.
    pub turn: f64,
    /// The edge that begins here, where one does.
    pub edge: Option<usize>,
    /// Joints sewn to each other have the same class.
    pub class: usize,
    /// The joints before and after it on the outline.
    pub around: [usize; 2],
    /// The links that cover the outline before and after it.
    pub links: [Option<usize>; 2],
    pub removed: bool,
}

/// Two pieces of outlines without joints inside that are sewn together.
#[derive(Debug, Clone)]
pub(crate) struct Link {
    pub stitch: usize,
    /// For both sides the joints where it starts and ends.
    pub ends: [[usize; 2]; 2],
    /// For both sides whether it runs along the outline.
    pub forward: [bool; 2],
    pub removed: bool,
}

/// All joints and links of a pattern.
#[derive(Debug, Default)]
pub(crate) struct Joints {
    pub joints: Vec<Joint>,
    pub links: Vec<Link>,
    /// The joints of each class.
    pub classes: Vec<Vec<usize>>,
    /// For each panel the places where its edges start, and its whole length, in m.
    pub starts: Vec<Vec<f64>>,
    /// For each panel its first joint; the joints at the starts of its edges follow.
    first: Vec<usize>,
}

/// An edge on a side of a stitch.
struct Piece {
    id: EdgeId,
    forward: bool,
    /// Distances along the side where it begins and ends, as shares of the side.
    share: [f64; 2],
}

/// A place along a stitch where both sides have a joint: for both sides the joint that ends what comes
/// before, and the one that begins what comes after. They differ where a chain leaves a panel.
type Break = [[usize; 2]; 2];

impl Joints {
    pub fn new(pattern: &Pattern, spacing: f64) -> Self {
        let mut all = Self::default();
        for (panel, outline) in pattern.panels().iter().map(|p| p.outline()).enumerate() {
            all.first.push(all.joints.len());
            let mut place = 0.0;
            let mut starts = vec![place];
            for (index, edge) in outline.iter().enumerate() {
                let before = &outline[(index + outline.len() - 1) % outline.len()];
                all.insert(panel, place, turn(before, edge), Some(index));
                place += edge.length();
                starts.push(place);
            }
            all.starts.push(starts);
        }
        for (index, stitch) in pattern.stitches().iter().enumerate() {
            all.sew(pattern, (index, stitch), spacing);
        }
        all.connect();
        all
    }

    fn insert(&mut self, panel: usize, place: f64, turn: f64, edge: Option<usize>) -> usize {
        let class = self.joints.len();
        self.classes.push(vec![class]);
        let (around, links, removed) = ([0; 2], [None; 2], false);
        self.joints.push(Joint { panel, place, turn, edge, class, around, links, removed });
        class
    }

    /// The joints of a panel that were not removed, along its outline.
    pub fn ring(&self, panel: usize) -> Vec<usize> {
        let own = |j: &usize| self.joints[*j].panel == panel && !self.joints[*j].removed;
        let mut ring: Vec<usize> = (0..self.joints.len()).filter(own).collect();
        let place = |j: usize| self.joints[j].place;
        ring.sort_by(|&a, &b| place(a).total_cmp(&place(b)).then(a.cmp(&b)));
        ring
    }

    /// Whole length of a panel's outline, in m.
    pub fn whole(&self, panel: usize) -> f64 {
        self.starts[panel].last().copied().unwrap_or(0.0)
    }

    /// Length of the outline from a joint to the next, in m.
    pub fn length_after(&self, joint: usize) -> f64 {
        let next = self.joints[joint].around[1];
        let [here, there] = [joint, next].map(|j| self.joints[j].place);
        // Joints at the same place lie in the order of their numbers.
        let onward = here.total_cmp(&there).then(joint.cmp(&next)).is_lt();
        if onward { there - here } else { there - here + self.whole(self.joints[joint].panel) }
    }

    /// Length that the arcs of the piece after a joint are counted on, in m: its own, or that of the longer of two
    /// pieces that are sewn together. In a gather it is the geometric mean of the shorter one and of the part of
    /// the longer one that has as many arcs, so that the arcs of both differ alike from the spacing.
    pub fn counted_after(&self, joint: usize) -> f64 {
        let Some([short, long]) = self.sewn_lengths(joint) else { return self.length_after(joint) };
        match fullness([short, long]) {
            1 => long,
            fullness => (short * long / f64::from(fullness)).sqrt(),
        }
    }

    /// How many arcs the longer piece of a gather has for each of the shorter one, at the piece after a joint; 1 if
    /// that is in no gather.
    pub fn fullness(&self, joint: usize) -> u32 {
        self.sewn_lengths(joint).map_or(1, fullness)
    }

    /// Whether the piece after a joint is the longer one of a gather.
    pub fn gathered(&self, joint: usize) -> bool {
        let own = self.length_after(joint);
        self.fullness(joint) > 1 && self.sewn_lengths(joint).is_some_and(|[short, _]| own > short)
    }

    /// Lengths of the piece after a joint and of that it is sewn to, the shorter first, in m.
    fn sewn_lengths(&self, joint: usize) -> Option<[f64; 2]> {
        let link = &self.links[self.joints[joint].links[1]?];
        let [a, b] = [0, 1].map(|side| self.length_after(Self::foremost(link, side)));
        Some([a.min(b), a.max(b)])
    }

    /// The joint from which a side of a link goes on along the outline.
    pub fn foremost(link: &Link, side: usize) -> usize {
        link.ends[side][usize::from(!link.forward[side])]
    }

    fn pieces(&self, pattern: &Pattern, side: &[EdgeId], forward: bool) -> Vec<Piece> {
        let whole = pattern.side_length(side);
        let mut begin = 0.0;
        let piece = |&id: &EdgeId| {
            let end = begin + pattern.edge(id).length() / whole;
            let share = [begin, end];
            begin = end;
            Piece { id, forward, share }
        };
        let mut pieces: Vec<Piece> = side.iter().map(piece).collect();
        // The shares add up to one but for rounding.
        if let Some(last) = pieces.last_mut() {
            last.share[1] = 1.0;
        }
        pieces
    }

    /// The joints where a piece starts and ends.
    fn piece_ends(&self, piece: &Piece) -> [usize; 2] {
        let EdgeId { panel, edge } = piece.id;
        let edges = self.starts[panel].len() - 1;
        let ends = [self.first[panel] + edge, self.first[panel] + (edge + 1) % edges];
        if piece.forward { ends } else { [ends[1], ends[0]] }
    }

    /// The joint at a share of a side, made there.
    fn notch(&mut self, pieces: &[Piece], share: f64) -> usize {
        let piece = pieces.iter().find(|p| share < p.share[1]).unwrap_or(&pieces[pieces.len() - 1]);
        let [begin, end] = piece.share;
        let part = ((share - begin) / (end - begin)).clamp(0.0, 1.0);
        let EdgeId { panel, edge } = piece.id;
        let [from, to] = [self.starts[panel][edge], self.starts[panel][edge + 1]];
        let part = if piece.forward { part } else { 1.0 - part };
        self.insert(panel, from + part * (to - from), 0.0, None)
    }

    /// Links the two sides of a stitch: by the share of their lengths, and end to end where ends of edges
    /// on both sides lie less than half a spacing apart.
    fn sew(&mut self, pattern: &Pattern, (index, stitch): (usize, &Stitch), spacing: f64) {
        let forward = [true, stitch.reversed];
        let sides = [0, 1].map(|side| self.pieces(pattern, &stitch.sides[side], forward[side]));
        let [one, other] = stitch.sides.each_ref().map(|side| pattern.side_length(side));
        let near = 0.5 * spacing / one.min(other);
        let start = [0, 1].map(|side| [self.piece_ends(&sides[side][0])[0]; 2]);
        let mut breaks: Vec<Break> = vec![start];
        // Numbers of the pieces that begin at the last break with an end on both sides.
        let mut from = [0, 0];
        for to in joined(&sides, near) {
            self.break_between(&sides, (from, to), &mut breaks);
            let at_end = to[0] == sides[0].len();
            breaks.push([0, 1].map(|side| {
                let before = self.piece_ends(&sides[side][to[side] - 1])[1];
                let after =
                    if at_end { before } else { self.piece_ends(&sides[side][to[side]])[0] };
                [before, after]
            }));
            from = to;
        }
        for each in &breaks {
            let all = each.as_flattened();
            for &joint in &all[1..] {
                self.join(all[0], joint);
            }
        }
        for pair in breaks.windows(2) {
            let ends = [0, 1].map(|side| [pair[0][side][1], pair[1][side][0]]);
            self.links.push(Link { stitch: index, ends, forward, removed: false });
        }
    }

    /// Breaks at ends of edges between two that both sides have; the other side gets a notch.
    fn break_between(
        &mut self,
        sides: &[Vec<Piece>; 2],
        (from, to): ([usize; 2], [usize; 2]),
        breaks: &mut Vec<Break>,
    ) {
        // From where to where each side runs, as shares of it.
        let range = [0, 1].map(|s| [sides[s][from[s]].share[0], sides[s][to[s] - 1].share[1]]);
        let mut ends: Vec<(f64, usize, usize)> = Vec::new();
        for side in 0..2 {
            let [low, high] = range[side];
            let between = from[side]..to[side] - 1;
            ends.extend(between.map(|k| ((sides[side][k].share[1] - low) / (high - low), side, k)));
        }
        ends.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        // By the share of the way, for both sides the piece that ends there.
        let mut places: Vec<(f64, [Option<usize>; 2])> = Vec::new();
        for (part, side, k) in ends {
            match places.last_mut() {
                Some((at, both)) if part - *at < SAME && both[side].is_none() => {
                    both[side] = Some(k)
                }
                _ => {
                    let mut both = [None; 2];
                    both[side] = Some(k);
                    places.push((part, both));
                }
            }
        }
        for (part, both) in places {
            breaks.push([0, 1].map(|side| match both[side] {
                Some(k) => {
                    [self.piece_ends(&sides[side][k])[1], self.piece_ends(&sides[side][k + 1])[0]]
                }
                None => {
                    let [low, high] = range[side];
                    [self.notch(&sides[side], low + part * (high - low)); 2]
                }
            }));
        }
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.joints[a].class, self.joints[b].class);
        if a != b {
            let moved = std::mem::take(&mut self.classes[a.max(b)]);
            moved.iter().for_each(|&joint| self.joints[joint].class = a.min(b));
            self.classes[a.min(b)].extend(moved);
        }
    }

    /// Orders the joints along the outlines, and notes at each what is sewn beside it.
    fn connect(&mut self) {
        for panel in 0..self.starts.len() {
            let ring = self.ring(panel);
            for (k, &joint) in ring.iter().enumerate() {
                let after = ring[(k + 1) % ring.len()];
                self.joints[joint].around[1] = after;
                self.joints[after].around[0] = joint;
            }
        }
        for link in 0..self.links.len() {
            self.mark(link);
        }
    }

    /// Notes a link at the joints of its ends.
    pub fn mark(&mut self, link: usize) {
        let Link { ends, forward, .. } = self.links[link].clone();
        for side in 0..2 {
            let [start, end] = ends[side];
            self.joints[start].links[usize::from(forward[side])] = Some(link);
            self.joints[end].links[usize::from(!forward[side])] = Some(link);
        }
    }
}

/// How many arcs the longer of two pieces that are sewn together has for each of the shorter one.
fn fullness([short, long]: [f64; 2]) -> u32 {
    // No more than a pattern may have.
    if long > GATHER * short { (long / short).round().min(100.0) as u32 } else { 1 }
}

/// Pairs of ends of pieces of both sides that are sewn to each other, as the numbers of the pieces after them;
/// the last pair is the end of both sides.
fn joined(sides: &[Vec<Piece>; 2], near: f64) -> Vec<[usize; 2]> {
    let count = [sides[0].len(), sides[1].len()];
    let mut pairs = Vec::new();
    let (mut a, mut b) = (1, 1);
    while a < count[0] && b < count[1] {
        let apart = sides[0][a].share[0] - sides[1][b].share[0];
        if apart.abs() < near {
            pairs.push([a, b]);
            (a, b) = (a + 1, b + 1);
        } else if apart < 0.0 {
            a += 1;
        } else {
            b += 1;
        }
    }
    pairs.push(count);
    pairs
}

/// Angle between the end of an edge and the start of the next, in rad.
fn turn(before: &Edge, after: &Edge) -> f64 {
    let ([_, a], [b, _]) = (before.tangents(), after.tangents());
    (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1]).abs()
}
