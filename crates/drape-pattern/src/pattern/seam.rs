//! Seams: which edges are sewn together.

use crate::ease::MAX_EASE;

/// Edge of a pattern, by the numbers of its panel and edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct EdgeId {
    /// Number of the panel, from 0.
    pub panel: usize,
    /// Number of the edge in the panel, from 0: edges of the outline come first, then edges of
    /// closed darts.
    pub edge: usize,
}

/// Seam: two chains of edges that are sewn together.
#[derive(Debug, Clone, PartialEq)]
pub struct Seam {
    /// Name, or number where the file gives no name.
    pub name: String,
    /// Edges of both sides, each in the order in which the seam runs. The seam runs along the
    /// outlines of panels on its first side, and against outlines on its second side: right side on
    /// right side. A pattern turns both sides round if they are listed the other way.
    pub sides: [Vec<EdgeId>; 2],
    /// Whether the seam runs along the outlines on its second side too: right side on wrong side.
    pub reversed: bool,
    /// Largest ratio of the lengths of the sides that is intended, from 1 to [`MAX_EASE`].
    pub max_ease: f64,
    /// Angle between the sides of the sewn seam, towards their right sides, in rad: 0 if it is
    /// pressed open.
    pub angle: f64,
    /// Width of the seam allowance, in m: cloth beyond the seam on each side.
    pub allowance: f64,
}

impl Seam {
    /// Returns the seam `name` between the legs `sides` of a dart.
    pub(crate) fn for_dart(name: String, sides: [Vec<EdgeId>; 2]) -> Self {
        Self { name, sides, reversed: false, max_ease: MAX_EASE, angle: 0.0, allowance: 0.0 }
    }
}
