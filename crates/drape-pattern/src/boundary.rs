//! Outlines sampled at the spacing, with the same number of nodes on both sides of every seam.

use crate::joints::Joints;
use crate::mistake::Mistake;
use crate::note::Note;
use crate::panel::Panel;
use crate::pattern::Pattern;

/// Largest angle between a side and a yarn that counts as along it, in rad.
const ALONG: f64 = 1e-9;

/// Most nodes on the outlines of a pattern.
const NODES_MAX: f64 = 1e6;

/// A sampled outline.
#[derive(Debug, Clone, Default)]
pub(crate) struct Boundary {
    /// Anticlockwise, in m.
    pub nodes: Vec<[f64; 2]>,
    /// Which nodes are ends of edges or of seams.
    pub hard: Vec<bool>,
    /// For each edge its nodes from start to end.
    pub edges: Vec<Vec<u32>>,
    /// Places of the nodes along the outline, in m.
    places: Vec<f64>,
}

/// A node of a cut pattern.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct NodeId {
    /// The panel.
    pub panel: usize,
    /// The node of its cut.
    pub node: u32,
}

/// The nodes of the seam of a stitch.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SeamNodes {
    /// Those that become one, in the order in which the seam runs. Both are the same node at the tip of a dart.
    pub pairs: Vec<[NodeId; 2]>,
    /// Those of the longer side of a gather between them, in the same order.
    pub ties: Vec<Tie>,
}

/// A node of the longer side of a gather that is sewn to a place between two nodes of the shorter one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tie {
    /// The pair that it comes after. On the other side it lies between that and the next.
    pub after: usize,
    /// Its own side.
    pub side: usize,
    /// The node.
    pub node: NodeId,
    /// Part of the way from the pair to the next at which it lies.
    pub share: f64,
}

impl SeamNodes {
    /// All nodes of a side, in the order in which the seam runs.
    pub fn side(&self, side: usize) -> impl Iterator<Item = NodeId> {
        let mut ties = self.ties.iter().filter(move |tie| tie.side == side).peekable();
        self.pairs.iter().enumerate().flat_map(move |(index, pair)| {
            let mut nodes = vec![pair[side]];
            while let Some(tie) = ties.next_if(|tie| tie.after == index) {
                nodes.push(tie.node);
            }
            nodes
        })
    }

    /// The nodes between which a tied one lies.
    pub fn ends(&self, tie: &Tie) -> [NodeId; 2] {
        [tie.after, tie.after + 1].map(|pair| self.pairs[pair][1 - tie.side])
    }

    pub(crate) fn nodes_mut(&mut self) -> impl Iterator<Item = &mut NodeId> {
        let ties = self.ties.iter_mut().map(|tie| &mut tie.node);
        self.pairs.iter_mut().flatten().chain(ties)
    }
}

/// All outlines of a pattern, sampled.
#[derive(Debug)]
pub(crate) struct Sampled {
    pub boundaries: Vec<Boundary>,
    /// For each stitch what is sewn to each other.
    pub seams: Vec<SeamNodes>,
    pub notes: Vec<Note>,
}

impl Sampled {
    pub fn new(pattern: &Pattern, spacing: f64) -> Result<Self, Vec<Mistake>> {
        let too_long = |panel: &Panel| {
            let nodes: f64 = panel.outline().iter().map(|e| e.length()).sum::<f64>() / spacing;
            let panel = panel.name().to_owned();
            (nodes > NODES_MAX).then_some(Mistake::TooMany { panel, nodes, spacing })
        };
        let mistakes: Vec<Mistake> = pattern.panels().iter().filter_map(too_long).collect();
        if !mistakes.is_empty() {
            return Err(mistakes);
        }
        let mut joints = Joints::new(pattern, spacing);
        let (notes, mistakes) = joints.join_short(pattern, spacing);
        if !mistakes.is_empty() {
            return Err(mistakes);
        }
        let counts = joints.counts(pattern, spacing);
        let mut first_node = vec![0; joints.joints.len()];
        let boundaries: Vec<Boundary> = (0..pattern.panels().len())
            .map(|panel| joints.sample(pattern, panel, (&counts, &mut first_node)))
            .collect();
        let few = |(panel, boundary): (&Panel, &Boundary)| {
            let (name, at) = (panel.name().to_owned(), panel.outline()[0].start);
            (boundary.nodes.len() < 3).then_some(Mistake::Narrow { panel: name, at, spacing })
        };
        let mistakes: Vec<Mistake> =
            pattern.panels().iter().zip(&boundaries).filter_map(few).collect();
        if !mistakes.is_empty() {
            return Err(mistakes);
        }
        let seams = joints.seams(pattern, (&counts, &first_node), &boundaries);
        Ok(Self { boundaries, seams, notes })
    }
}

impl Joints {
    /// For each joint the number of arcs to the next.
    fn counts(&self, pattern: &Pattern, spacing: f64) -> Vec<u32> {
        let mut same: Vec<usize> = (0..self.joints.len()).collect();
        for link in self.links.iter().filter(|l| !l.removed) {
            unite(&mut same, Self::foremost(link, 0), Self::foremost(link, 1));
        }
        let sewn = same.clone();
        for (number, panel) in pattern.panels().iter().enumerate() {
            let Some([a, b, c, d]) = self.rectangle(panel, number) else { continue };
            for [one, opposite] in [[a, c], [b, d]] {
                // The other side of a gather keeps the spacing; if that gives another number, there is a rim.
                if [one, opposite].iter().all(|&joint| self.fullness(joint) == 1) {
                    unite(&mut same, one, opposite);
                }
            }
        }
        let counts = self.largest_of(&same, spacing);
        // Through several panels a rectangle may get far more nodes than it needs: then it gets a rim.
        let crowded = (0..self.joints.len()).any(|joint| {
            let arc = self.length_after(joint) / f64::from(counts[joint]);
            !self.joints[joint].removed && arc < spacing / 3.0
        });
        if crowded { self.largest_of(&sewn, spacing) } else { counts }
    }

    /// For each joint the largest number of arcs of those that are to have the same, the longer pieces of gathers
    /// apart: they have that of the shorter ones as often as their fullness tells.
    fn largest_of(&self, same: &[usize], spacing: f64) -> Vec<u32> {
        let mut most = vec![1; same.len()];
        for joint in (0..same.len()).filter(|&j| !self.joints[j].removed) {
            let own = (self.counted_after(joint) / spacing).round().max(1.0) as u32;
            let root = root(same, joint);
            most[root] = own.max(most[root]);
        }
        let times = |joint| if self.gathered(joint) { self.fullness(joint) } else { 1 };
        (0..same.len()).map(|joint| most[root(same, joint)] * times(joint)).collect()
    }

    /// The four joints of a rectangle whose sides follow the yarns.
    fn rectangle(&self, panel: &Panel, number: usize) -> Option<[usize; 4]> {
        let straight = panel.outline().iter().all(|e| e.curve == crate::Curve::Line);
        let mut own = (0..self.joints.len())
            .filter(|&j| self.joints[j].panel == number && !self.joints[j].removed);
        let first = own.next()?;
        let next = |j: usize| self.joints[j].around[1];
        let corners = [first, next(first), next(next(first)), next(next(next(first)))];
        let square = |edge: &crate::Edge| {
            let [[x, y], _] = edge.tangents();
            // The angle of the edge to the yarns, modulo a right angle.
            let angle = (y.atan2(x) - panel.grain()).rem_euclid(std::f64::consts::FRAC_PI_2);
            angle.min(std::f64::consts::FRAC_PI_2 - angle) < ALONG
        };
        (next(corners[3]) == first
            && straight
            && corners.iter().all(|&j| self.joints[j].turn > 1.0)
            && panel.outline().iter().all(square))
        .then_some(corners)
    }

    fn sample(
        &self,
        pattern: &Pattern,
        panel: usize,
        (counts, first_node): (&[u32], &mut [usize]),
    ) -> Boundary {
        let mut boundary = Boundary::default();
        let outline = pattern.panels()[panel].outline();
        let (starts, whole) = (&self.starts[panel], self.whole(panel));
        for joint in self.ring(panel) {
            first_node[joint] = boundary.nodes.len();
            let (start, length) = (self.joints[joint].place, self.length_after(joint));
            for k in 0..counts[joint] {
                let place = start + length * f64::from(k) / f64::from(counts[joint]);
                let place = if place >= whole { place - whole } else { place };
                let edge = starts.partition_point(|&s| s <= place).clamp(1, outline.len()) - 1;
                let share = (place - starts[edge]) / (starts[edge + 1] - starts[edge]);
                boundary.nodes.push(outline[edge].at(share));
                boundary.hard.push(k == 0);
                boundary.places.push(place);
            }
        }
        boundary.edges =
            (0..outline.len()).map(|e| boundary.chain([starts[e], starts[e + 1]], whole)).collect();
        boundary
    }

    fn seams(
        &self,
        pattern: &Pattern,
        (counts, first_node): (&[u32], &[usize]),
        boundaries: &[Boundary],
    ) -> Vec<SeamNodes> {
        let mut seams = vec![SeamNodes::default(); pattern.stitches().len()];
        for link in self.links.iter().filter(|l| !l.removed) {
            let own = [0, 1].map(|side| counts[Self::foremost(link, side)] as usize);
            let count = own[0].min(own[1]);
            // How many arcs of each side there are between two pairs.
            let arcs = own.map(|own| own / count);
            let node = |side: usize, k: usize| {
                let start = link.ends[side][0];
                let panel = self.joints[start].panel;
                let nodes = boundaries[panel].nodes.len();
                let steps = if link.forward[side] { k } else { nodes - k % nodes };
                NodeId { panel, node: ((first_node[start] + steps) % nodes) as u32 }
            };
            let SeamNodes { pairs, ties } = &mut seams[link.stitch];
            for k in 0..=count {
                let pair = [0, 1].map(|side| node(side, k * arcs[side]));
                // A link begins where the one before it ended.
                if pairs.last() != Some(&pair) {
                    pairs.push(pair);
                }
                for side in (0..2).filter(|_| k < count) {
                    ties.extend((1..arcs[side]).map(|step| Tie {
                        after: pairs.len() - 1,
                        side,
                        node: node(side, k * arcs[side] + step),
                        share: step as f64 / arcs[side] as f64,
                    }));
                }
            }
        }
        seams
    }
}

impl Boundary {
    /// The nodes of an edge between two places: from that nearest to its start to that nearest to its end.
    fn chain(&self, [from, to]: [f64; 2], whole: f64) -> Vec<u32> {
        if self.nodes.is_empty() {
            return Vec::new();
        }
        let (first, last) = (self.nearest(from, whole), self.nearest(to, whole));
        let n = self.nodes.len();
        let steps = (last + n - first) % n;
        let steps = if steps == 0 && to - from > 0.5 * whole { n } else { steps };
        (0..=steps).map(|k| ((first + k) % n) as u32).collect()
    }

    fn nearest(&self, place: f64, whole: f64) -> usize {
        let n = self.places.len();
        let after = self.places.partition_point(|&p| p < place);
        let gap = |k: usize| {
            let apart = (self.places[k % n] - place).abs();
            apart.min(whole - apart)
        };
        let (before, after) = ((after + n - 1) % n, after % n);
        if gap(before) < gap(after) { before } else { after }
    }
}

fn root(same: &[usize], mut of: usize) -> usize {
    while same[of] != of {
        of = same[of];
    }
    of
}

fn unite(same: &mut [usize], a: usize, b: usize) {
    let (a, b) = (root(same, a), root(same, b));
    same[a.max(b)] = a.min(b);
}
