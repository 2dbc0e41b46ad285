//! Rectangles along the grain, which are all lattice.

use crate::boundary::Boundary;
use crate::cut::{Cut, Turn};

/// How far a node may lie from its place in the grid, in spacings: rounding.
const EXACT: f64 = 1e-9;

/// Columns and rows of the nodes of an outline that is the border of a grid.
struct Border {
    low: [f64; 2],
    spacing: [f64; 2],
    /// Numbers of cells along weft and warp.
    cells: [u32; 2],
    places: Vec<[u32; 2]>,
}

impl Border {
    /// The grid whose border a polygon in the grain's frame is, in m.
    fn of(polygon: &[[f64; 2]], spacing: f64) -> Option<Self> {
        let extent = |k: usize| {
            let all = polygon.iter().map(|p| p[k]);
            (all.clone().fold(f64::MAX, f64::min), all.fold(f64::MIN, f64::max))
        };
        let ((left, right), (bottom, top)) = (extent(0), extent(1));
        let near = EXACT * spacing;
        let below = polygon.iter().filter(|p| (p[1] - bottom).abs() < near).count();
        let beside = polygon.iter().filter(|p| (p[0] - left).abs() < near).count();
        if below < 2 || beside < 2 || 2 * (below + beside) != polygon.len() + 4 {
            return None;
        }
        let cells = [below as u32 - 1, beside as u32 - 1];
        let spacing = [(right - left) / f64::from(cells[0]), (top - bottom) / f64::from(cells[1])];
        let place = |p: &[f64; 2]| {
            let offset = [p[0] - left, p[1] - bottom];
            let steps = [0, 1].map(|k| (offset[k] / spacing[k]).round());
            let exact = (0..2).all(|k| (offset[k] - steps[k] * spacing[k]).abs() < near);
            let place = steps.map(|s| s as u32);
            let on = (0..2).any(|k| place[k] == 0 || place[k] == cells[k]);
            (exact && on).then_some(place)
        };
        let places: Vec<[u32; 2]> = polygon.iter().filter_map(place).collect();
        let mut distinct = places.clone();
        distinct.sort_unstable();
        distinct.dedup();
        (distinct.len() == polygon.len()).then_some(())?;
        Some(Self { low: [left, bottom], spacing, cells, places })
    }

    fn number(&self, [column, row]: [u32; 2]) -> u32 {
        row * (self.cells[0] + 1) + column
    }
}

impl Cut {
    /// The cut of a boundary that is the border of a grid in the grain's frame, if it is one.
    pub(crate) fn of_grid(boundary: &Boundary, turn: Turn, spacing: f64) -> Option<Self> {
        let polygon: Vec<[f64; 2]> = boundary.nodes.iter().map(|&p| turn.back(p)).collect();
        let border = Border::of(&polygon, spacing)?;
        let [columns, rows] = border.cells;
        let all = || (0..=rows).flat_map(|row| (0..=columns).map(move |column| [column, row]));
        let yarns: Vec<[f64; 2]> = all()
            .map(|node| [0, 1].map(|k| border.low[k] + border.spacing[k] * f64::from(node[k])))
            .collect();
        let mut positions: Vec<[f64; 2]> = yarns.iter().map(|&p| turn.forth(p)).collect();
        let mut hard = vec![false; yarns.len()];
        let outline: Vec<u32> = border.places.iter().map(|&p| border.number(p)).collect();
        for (k, &node) in outline.iter().enumerate() {
            positions[node as usize] = boundary.nodes[k];
            hard[node as usize] = boundary.hard[k];
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
            edges: boundary.edges.iter().map(renumbered).collect(),
            hard,
            outline,
            yarns,
        })
    }
}
