//! Cut of a rectangle along the grain, which consists of full cells and has no rim.

use super::panel_cut::{Cut, GrainFrame};
use super::sampling::SampledPanel;

/// Largest distance of a node from its grid point, in spacings: rounding.
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
    /// Returns the border that a polygon in the grain's frame, in m, is; `None` if it is no border
    /// of a grid.
    fn of(polygon: &[[f64; 2]], spacing: f64) -> Option<Self> {
        let extent = |k: usize| {
            let all = polygon.iter().map(|p| p[k]);
            (all.clone().fold(f64::MAX, f64::min), all.fold(f64::MIN, f64::max))
        };
        let ((left, right), (bottom, top)) = (extent(0), extent(1));
        let tolerance = EXACT * spacing;
        let below = polygon.iter().filter(|p| (p[1] - bottom).abs() < tolerance).count();
        let beside = polygon.iter().filter(|p| (p[0] - left).abs() < tolerance).count();
        if below < 2 || beside < 2 || 2 * (below + beside) != polygon.len() + 4 {
            return None;
        }
        let cells = [below as u32 - 1, beside as u32 - 1];
        let spacing = [(right - left) / f64::from(cells[0]), (top - bottom) / f64::from(cells[1])];
        let node = |p: &[f64; 2]| {
            let offset = [p[0] - left, p[1] - bottom];
            let steps = [0, 1].map(|k| (offset[k] / spacing[k]).round());
            let exact = (0..2).all(|k| (offset[k] - steps[k] * spacing[k]).abs() < tolerance);
            let node = steps.map(|s| s as u32);
            let on = (0..2).any(|k| node[k] == 0 || node[k] == cells[k]);
            (exact && on).then_some(node)
        };
        let nodes: Vec<[u32; 2]> = polygon.iter().filter_map(node).collect();
        let mut distinct = nodes.clone();
        distinct.sort_unstable();
        distinct.dedup();
        (distinct.len() == polygon.len()).then_some(())?;
        Some(Self { low: [left, bottom], spacing, cells, nodes })
    }

    /// Returns the number of a node of the grid.
    fn number(&self, [column, row]: [u32; 2]) -> u32 {
        row * (self.cells[0] + 1) + column
    }
}

impl Cut {
    /// Returns the cut of a sampled outline that is the border of a grid in the grain's frame;
    /// `None` if it is none.
    pub(crate) fn of_rectangle(
        sampled: &SampledPanel,
        grain: GrainFrame,
        spacing: f64,
    ) -> Option<Self> {
        if sampled.lines.len() > 1 {
            return None;
        }
        let polygon: Vec<[f64; 2]> = sampled.nodes.iter().map(|&p| grain.to_grain(p)).collect();
        let border = Border::of(&polygon, spacing)?;
        let [columns, rows] = border.cells;
        let all = || (0..=rows).flat_map(|row| (0..=columns).map(move |column| [column, row]));
        let yarns: Vec<[f64; 2]> = all()
            .map(|node| [0, 1].map(|k| border.low[k] + border.spacing[k] * f64::from(node[k])))
            .collect();
        let mut positions: Vec<[f64; 2]> = yarns.iter().map(|&p| grain.to_panel(p)).collect();
        let mut hard = vec![false; yarns.len()];
        let outline: Vec<u32> = border.nodes.iter().map(|&p| border.number(p)).collect();
        for (k, &node) in outline.iter().enumerate() {
            positions[node as usize] = sampled.nodes[k];
            hard[node as usize] = sampled.hard[k];
        }
        let cell = |[c, r]: [u32; 2]| {
            [[c, r], [c + 1, r], [c + 1, r + 1], [c, r + 1]].map(|node| border.number(node))
        };
        let cells = (0..rows).flat_map(|row| (0..columns).map(move |column| [column, row]));
        let renumbered =
            |edge: &Vec<u32>| edge.iter().map(|&k| outline[k as usize]).collect::<Vec<u32>>();
        Some(Self {
            panel: String::new(),
            spacing: border.spacing,
            positions,
            lattice: all().map(Some).collect(),
            quads: cells.map(cell).collect(),
            triangles: Vec::new(),
            edges: sampled.edges.iter().map(renumbered).collect(),
            hard,
            outline,
            holes: Vec::new(),
            yarns,
        })
    }
}
