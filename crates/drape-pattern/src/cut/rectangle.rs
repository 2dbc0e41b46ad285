//! Cut of a rectangle along the grain, which consists of full cells and has no rim.

use super::panel_cut::{Cut, GrainFrame};
use super::sampling::SampledPanel;
use crate::polygon::range;

/// Largest distance of a node from its grid point that is rounding, in spacings.
const EXACT: f64 = 1e-9;

/// Outline whose nodes are the border of a grid.
struct Border {
    /// Lowest corner in the grain's frame, in m.
    low: [f64; 2],
    /// Spacing along weft and warp, in m.
    spacing: [f64; 2],
    /// Numbers of cells along weft and warp.
    cells: [u32; 2],
    /// Column and row of each node of the outline.
    nodes: Vec<[u32; 2]>,
}

impl Border {
    /// Returns the border of a grid that `polygon` is, at about `spacing`; `None` if it is no such
    /// border. Points are in the grain's frame, in m.
    fn from_polygon(polygon: &[[f64; 2]], spacing: f64) -> Option<Self> {
        let [[left, right], [bottom, top]] =
            [0, 1].map(|axis| range(polygon.iter().map(|p| p[axis])));
        let tolerance = EXACT * spacing;

        // The lowest row and the leftmost column give the numbers of cells.
        let below = polygon.iter().filter(|p| (p[1] - bottom).abs() < tolerance).count();
        let beside = polygon.iter().filter(|p| (p[0] - left).abs() < tolerance).count();
        if below < 2 || beside < 2 || 2 * (below + beside) != polygon.len() + 4 {
            return None;
        }
        let cells = [below as u32 - 1, beside as u32 - 1];
        let spacing = [(right - left) / f64::from(cells[0]), (top - bottom) / f64::from(cells[1])];

        // Each point must be a grid point on the border, and each grid point one point.
        let mut nodes: Vec<[u32; 2]> = Vec::new();
        for p in polygon {
            let offset = [p[0] - left, p[1] - bottom];
            let steps = [0, 1].map(|k| (offset[k] / spacing[k]).round());
            let is_exact = (0..2).all(|k| (offset[k] - steps[k] * spacing[k]).abs() < tolerance);
            let node = steps.map(|s| s as u32);
            let is_on_border = (0..2).any(|k| node[k] == 0 || node[k] == cells[k]);
            if is_exact && is_on_border {
                nodes.push(node);
            }
        }
        let mut distinct = nodes.clone();
        distinct.sort_unstable();
        distinct.dedup();
        (distinct.len() == polygon.len()).then_some(Self {
            low: [left, bottom],
            spacing,
            cells,
            nodes,
        })
    }

    /// Returns the number of the node at a column and a row of the grid.
    fn number(&self, [column, row]: [u32; 2]) -> u32 {
        row * (self.cells[0] + 1) + column
    }
}

impl Cut {
    /// Returns the cut of the panel `sampled` without a rim, without the name of the panel; `None`
    /// if its outline is not the border of a grid in the frame `grain`.
    pub(crate) fn from_rectangle(
        sampled: &SampledPanel,
        grain: GrainFrame,
        spacing: f64,
    ) -> Option<Self> {
        if sampled.lines.len() > 1 {
            return None;
        }
        let polygon: Vec<[f64; 2]> = sampled.nodes.iter().map(|&p| grain.to_grain(p)).collect();
        let border = Border::from_polygon(&polygon, spacing)?;
        let [columns, rows] = border.cells;

        let grid: Vec<[u32; 2]> =
            (0..=rows).flat_map(|row| (0..=columns).map(move |column| [column, row])).collect();
        let yarns: Vec<[f64; 2]> = grid
            .iter()
            .map(|node| [0, 1].map(|k| border.low[k] + border.spacing[k] * f64::from(node[k])))
            .collect();
        let mut positions: Vec<[f64; 2]> = yarns.iter().map(|&p| grain.to_panel(p)).collect();
        let mut hard = vec![false; yarns.len()];

        // Nodes of the outline keep the bits of their sampled positions.
        let outline: Vec<u32> = border.nodes.iter().map(|&p| border.number(p)).collect();
        for (k, &node) in outline.iter().enumerate() {
            positions[node as usize] = sampled.nodes[k];
            hard[node as usize] = sampled.hard[k];
        }

        let cells = (0..rows).flat_map(|row| (0..columns).map(move |column| [column, row]));
        let quads = cells.map(|[c, r]| {
            [[c, r], [c + 1, r], [c + 1, r + 1], [c, r + 1]].map(|node| border.number(node))
        });
        let edges = sampled.edges.iter();
        Some(Self {
            panel: String::new(),
            spacing: border.spacing,
            positions,
            lattice: grid.iter().copied().map(Some).collect(),
            quads: quads.collect(),
            triangles: Vec::new(),
            edges: edges.map(|edge| edge.iter().map(|&k| outline[k as usize]).collect()).collect(),
            hard,
            outline,
            holes: Vec::new(),
            yarns,
        })
    }
}
