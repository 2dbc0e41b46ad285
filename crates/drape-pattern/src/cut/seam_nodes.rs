//! Nodes of the seams of a cut pattern: pairs that become one node, and ties in gathers.

/// Node of a cut pattern.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct NodeId {
    /// Number of the panel, from 0.
    pub panel: usize,
    /// Index of the node among the nodes of the panel's [`Cut`](crate::Cut), from 0.
    pub node: u32,
}

/// Nodes of a seam.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SeamNodes {
    /// Pairs of nodes that become one, in the order in which the seam runs. At the tip of a dart
    /// both are one node.
    pub pairs: Vec<[NodeId; 2]>,
    /// Nodes of the longer side of a gather between the pairs, in the order in which the seam runs.
    pub ties: Vec<Tie>,
    /// Numbers of the pairs, from 0, after which the seam goes on elsewhere, as over the mouth of a
    /// dart or in another panel: the next pair is no neighbour on the outlines.
    pub breaks: Vec<usize>,
}

/// Node of the longer side of a gather that is tied to a point between two nodes of the shorter
/// side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tie {
    /// Number of the pair before it. On the other side of the seam it lies between that pair and
    /// the next pair.
    pub after: usize,
    /// Side of the seam to which it belongs, 0 or 1.
    pub side: usize,
    /// The node.
    pub node: NodeId,
    /// Fraction of the arc from that pair to the next at which it lies, 0 to 1.
    pub fraction: f64,
}

impl SeamNodes {
    /// Returns all nodes of `side`, 0 or 1, in the order in which the seam runs.
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

    /// Returns the two nodes between which the node of `tie` lies.
    #[must_use]
    pub fn ends(&self, tie: &Tie) -> [NodeId; 2] {
        [tie.after, tie.after + 1].map(|pair| self.pairs[pair][1 - tie.side])
    }

    /// Adds `pair`, the first pair of a piece. It is the last pair of the piece before, or the seam
    /// goes on elsewhere.
    pub(crate) fn begin_piece(&mut self, pair: [NodeId; 2]) {
        match self.pairs.last() {
            Some(last) if *last == pair => return,
            Some(_) => self.breaks.push(self.pairs.len() - 1),
            None => {}
        }
        self.pairs.push(pair);
    }

    /// Returns all nodes, so that they can be renumbered.
    pub(crate) fn nodes_mut(&mut self) -> impl Iterator<Item = &mut NodeId> {
        let ties = self.ties.iter_mut().map(|tie| &mut tie.node);
        self.pairs.iter_mut().flatten().chain(ties)
    }
}
