use crate::boundary::{Boundary, SeamNodes};
use crate::note::Note;
use crate::rim::Rim;

/// A panel cut into the full cells of a lattice along its grain and triangles between them and its outline.
///
/// Nodes of the outline come first, anticlockwise, then those of the lattice, row by row; in a rectangle
/// that is all lattice, all nodes are in rows.
#[derive(Debug, Clone, PartialEq)]
pub struct Cut {
    /// Name of the panel.
    pub panel: String,
    /// Distance of the nodes of the lattice along weft and warp, in m.
    pub spacing: [f64; 2],
    /// The nodes in the panel's frame, in m.
    pub positions: Vec<[f64; 2]>,
    /// The nodes in the grain's frame, whose x is the weft and whose y is the warp, in m; the origin is that of
    /// the panel's frame.
    pub yarns: Vec<[f64; 2]>,
    /// Column and row of each node of the lattice.
    pub lattice: Vec<Option<[u32; 2]>>,
    /// Full cells by their nodes, anticlockwise from the lowest along weft and warp.
    pub quads: Vec<[u32; 4]>,
    /// Triangles of the rim by their nodes, anticlockwise.
    pub triangles: Vec<[u32; 3]>,
    /// For each edge of the outline its nodes, in its direction, with both ends. An edge shorter than half a
    /// spacing that was joined with a neighbour has those nearest to its ends, which may be one.
    pub edges: Vec<Vec<u32>>,
    /// The nodes of the outline, anticlockwise.
    pub outline: Vec<u32>,
    /// Which nodes are ends of edges or of pieces of seams.
    pub hard: Vec<bool>,
}

/// A pattern cut at one spacing.
#[derive(Debug, Clone, PartialEq)]
pub struct CutPattern {
    /// The spacing, in m.
    pub spacing: f64,
    /// The cuts of the panels, in their order.
    pub panels: Vec<Cut>,
    /// For each stitch the nodes that are sewn to each other.
    pub seams: Vec<SeamNodes>,
    /// What the user should know about the cut.
    pub notes: Vec<Note>,
}

/// A rotation in the plane.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Turn {
    sine: f64,
    cosine: f64,
}

impl Turn {
    pub fn new(angle: f64) -> Self {
        let (sine, cosine) = angle.sin_cos();
        Self { sine, cosine }
    }

    pub fn forth(self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.cosine * x - self.sine * y, self.sine * x + self.cosine * y]
    }

    pub fn back(self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.cosine * x + self.sine * y, self.cosine * y - self.sine * x]
    }
}

impl Cut {
    /// The cut of a boundary by a rim, which was made in spacings from a place in the grain's frame.
    pub(crate) fn of_rim(
        boundary: Boundary,
        (rim, turn): (&Rim, Turn),
        (start, spacing): ([f64; 2], f64),
    ) -> Self {
        let sides = boundary.nodes.len();
        let nodes: Vec<[usize; 2]> = rim.lattice.nodes().collect();
        let mut number = vec![0_u32; rim.lattice.size[0] * rim.lattice.size[1]];
        let at = |[column, row]: [usize; 2]| row * rim.lattice.size[0] + column;
        for (k, &node) in nodes.iter().enumerate() {
            number[at(node)] = (sides + k) as u32;
        }
        let corners = |[c, r]: [usize; 2]| [[c, r], [c + 1, r], [c + 1, r + 1], [c, r + 1]];
        let quads =
            rim.lattice.cells().into_iter().map(|cell| corners(cell).map(|n| number[at(n)]));
        let inner = nodes.iter().map(|&node| {
            let [x, y] = rim.lattice.place(node);
            [start[0] + spacing * x, start[1] + spacing * y]
        });
        let yarns: Vec<[f64; 2]> =
            boundary.nodes.iter().map(|&p| turn.back(p)).chain(inner).collect();
        let inside = yarns[sides..].iter().map(|&p| turn.forth(p));
        let positions = boundary.nodes.iter().copied().chain(inside).collect();
        let columns = nodes.iter().map(|node| Some(node.map(|k| k as u32)));
        let mut hard = boundary.hard;
        hard.resize(yarns.len(), false);
        Self {
            panel: String::new(),
            spacing: [spacing; 2],
            positions,
            lattice: std::iter::repeat_n(None, sides).chain(columns).collect(),
            quads: quads.collect(),
            triangles: rim.triangles.clone(),
            edges: boundary.edges,
            outline: (0..sides as u32).collect(),
            hard,
            yarns,
        }
    }
}
