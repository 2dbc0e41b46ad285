//! Cut of a panel: nodes, cells and triangles.

use std::ops::Range;

use super::rim::Rim;
use super::sampling::SampledPanel;

/// Panel cut into the full cells of a lattice along its grain, and triangles between them and its
/// outline.
///
/// Nodes of the outline come first, anticlockwise, then nodes of holes, then nodes of the lattice,
/// row by row. In a rectangle without a rim all nodes are in rows.
#[derive(Debug, Clone, PartialEq)]
pub struct Cut {
    /// Name of the panel.
    pub panel: String,
    /// Distance of the nodes of the lattice along weft and warp, in m.
    pub spacing: [f64; 2],
    /// Positions of the nodes in the panel's frame, in m.
    pub positions: Vec<[f64; 2]>,
    /// Positions of the nodes in the frame of the grain, in m. Its x axis is the weft, its y axis
    /// is the warp, and its origin is the origin of the panel's frame.
    pub yarns: Vec<[f64; 2]>,
    /// Column and row of each node of the lattice; `None` for nodes of closed lines beside a rim.
    pub lattice: Vec<Option<[u32; 2]>>,
    /// Full cells by their nodes, anticlockwise from the lowest along weft and warp.
    pub quads: Vec<[u32; 4]>,
    /// Triangles of the rim by their nodes, anticlockwise.
    pub triangles: Vec<[u32; 3]>,
    /// Nodes of each edge of the panel, in its direction, with both ends. An edge shorter than half
    /// a spacing that was joined with a neighbour has the nodes nearest to its ends. These may be
    /// one node.
    pub edges: Vec<Vec<u32>>,
    /// Nodes of the outline, anticlockwise.
    pub outline: Vec<u32>,
    /// Nodes of the hole of each closed dart, clockwise.
    pub holes: Vec<Vec<u32>>,
    /// Whether each node is an end of an edge or of a seam piece.
    pub hard: Vec<bool>,
}

/// Frame of the grain: the panel's frame rotated by the angle of its warp.
#[derive(Debug, Clone, Copy)]
pub(crate) struct GrainFrame {
    sine: f64,
    cosine: f64,
}

impl GrainFrame {
    /// Returns the frame of a warp at `angle` to the panel's y axis, anticlockwise, in rad.
    pub fn new(angle: f64) -> Self {
        let (sine, cosine) = angle.sin_cos();
        Self { sine, cosine }
    }

    /// Returns a point of the grain's frame in the panel's frame.
    pub fn to_panel(self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.cosine * x - self.sine * y, self.sine * x + self.cosine * y]
    }

    /// Returns a point of the panel's frame in the grain's frame.
    pub fn to_grain(self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.cosine * x + self.sine * y, self.cosine * y - self.sine * x]
    }
}

/// Origin and unit of the lengths of a rim.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RimUnits {
    /// Origin in the grain's frame, in m.
    pub origin: [f64; 2],
    /// Unit of lengths, in m.
    pub spacing: f64,
}

impl Cut {
    /// Returns the closed lines of the panel by their nodes: the outline, then the holes.
    pub fn lines(&self) -> impl Iterator<Item = &[u32]> {
        std::iter::once(self.outline.as_slice()).chain(self.holes.iter().map(Vec::as_slice))
    }

    /// Returns the position of `node` in the panel's frame, in m.
    pub(crate) fn position(&self, node: u32) -> [f64; 2] {
        self.positions[node as usize]
    }

    /// Returns the cut of the sampled `outline` with `rim`, without the name of the panel. `grain`
    /// is the frame of the grain, `units` are the units of `rim`.
    pub(crate) fn from_rim(
        outline: SampledPanel,
        rim: &Rim,
        grain: GrainFrame,
        units: RimUnits,
    ) -> Self {
        let RimUnits { origin, spacing } = units;
        let lattice = &rim.lattice;
        let columns = lattice.size[0];
        let outline_count = outline.nodes.len();

        // Numbers of the lattice's nodes in the cut, by grid points.
        let nodes: Vec<[usize; 2]> = lattice.nodes().collect();
        let mut number = vec![0_u32; lattice.size[0] * lattice.size[1]];
        for (k, &[column, row]) in nodes.iter().enumerate() {
            number[row * columns + column] = (outline_count + k) as u32;
        }
        let quads = lattice.cells().into_iter().map(|[c, r]| {
            let corners = [[c, r], [c + 1, r], [c + 1, r + 1], [c, r + 1]];
            corners.map(|[column, row]| number[row * columns + column])
        });

        // Nodes of the outline keep the bits of their positions in the panel's frame.
        let inner = nodes.iter().map(|&node| {
            let [x, y] = lattice.position(node);
            [origin[0] + spacing * x, origin[1] + spacing * y]
        });
        let yarns: Vec<[f64; 2]> =
            outline.nodes.iter().map(|&p| grain.to_grain(p)).chain(inner).collect();
        let inner_positions = yarns[outline_count..].iter().map(|&p| grain.to_panel(p));
        let positions = outline.nodes.iter().copied().chain(inner_positions).collect();

        let grid = nodes.iter().map(|node| Some(node.map(|k| k as u32)));
        let mut hard = outline.hard;
        hard.resize(yarns.len(), false);
        Self {
            panel: String::new(),
            spacing: [spacing; 2],
            positions,
            lattice: std::iter::repeat_n(None, outline_count).chain(grid).collect(),
            quads: quads.collect(),
            triangles: rim.triangles.clone(),
            edges: outline.edges,
            outline: numbers(&outline.lines[0]),
            holes: outline.lines[1..].iter().map(numbers).collect(),
            hard,
            yarns,
        }
    }
}

/// Returns the numbers of `nodes` as they stand in a cut.
fn numbers(nodes: &Range<usize>) -> Vec<u32> {
    nodes.clone().map(|node| node as u32).collect()
}
