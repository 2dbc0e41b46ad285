//! Quality of a cut: edge lengths, angles, errors of area and outline, and thin parts.

use std::collections::BTreeMap;

use super::panel_cut::Cut;
use super::rim::angles;
use crate::edge::{difference, distance};
use crate::note::PatternNote;
use crate::panel::Panel;

/// Number of points at which the outline is compared with each chord.
const SAMPLES: usize = 16;

/// Width below which a part of a panel is thin, in spacings: fewer than three particles across.
const THIN: f64 = 1.5;

/// Quality of the cut of a panel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quality {
    /// Number of nodes.
    pub nodes: usize,
    /// Number of full cells of the lattice.
    pub quads: usize,
    /// Number of triangles of the rim.
    pub triangles: usize,
    /// Length of the shortest edge of a triangle or cell, in spacings.
    pub shortest_edge: f64,
    /// Length of the longest edge of a triangle or cell, in spacings.
    pub longest_edge: f64,
    /// Smallest angle of the triangles, in rad; a right angle where there are none.
    pub smallest_angle: f64,
    /// Relative error of the area of cells and triangles together, positive if it is too large.
    pub area_error: f64,
    /// Largest distance of the outline from the chords between its nodes, in m.
    pub deviation: f64,
    /// Fraction of the area of the cut that is in cells, 0 to 1.
    pub cell_fraction: f64,
}

impl Quality {
    /// Measures the cut of a panel at a spacing in m.
    #[must_use]
    pub fn new(panel: &Panel, cut: &Cut, spacing: f64) -> Self {
        let at = |node: u32| cut.positions[node as usize];
        let sides = cut.sides().map(|[a, b]| distance(at(a), at(b)) / spacing);
        let (shortest_edge, longest_edge) =
            sides.fold((f64::MAX, 0.0), |(low, high), l| (l.min(low), l.max(high)));
        let sharp = cut.triangles.iter().flat_map(|t| angles(t.map(at)));
        let area = |corners: &[u32]| {
            let points: Vec<[f64; 2]> =
                corners.iter().map(|&n| difference(at(n), at(corners[0]))).collect();
            points.windows(2).map(|p| 0.5 * (p[0][0] * p[1][1] - p[0][1] * p[1][0])).sum::<f64>()
        };
        // The sum of no terms is minus zero.
        let in_cells: f64 = 0.0 + cut.quads.iter().map(|q| area(q)).sum::<f64>();
        let whole = in_cells + cut.triangles.iter().map(|t| area(t)).sum::<f64>();
        Self {
            nodes: cut.positions.len(),
            quads: cut.quads.len(),
            triangles: cut.triangles.len(),
            shortest_edge,
            longest_edge,
            smallest_angle: sharp.fold(std::f64::consts::FRAC_PI_2, f64::min),
            area_error: whole / panel.area() - 1.0,
            deviation: deviation(panel, cut),
            cell_fraction: in_cells / whole,
        }
    }
}

impl Cut {
    /// Returns the sides of all cells and triangles; those between two of them twice.
    fn sides(&self) -> impl Iterator<Item = [u32; 2]> + '_ {
        let quads = self.quads.iter().flat_map(|q| (0..4).map(|k| [q[k], q[(k + 1) % 4]]));
        let triangles = self.triangles.iter().flat_map(|t| (0..3).map(|k| [t[k], t[(k + 1) % 3]]));
        quads.chain(triangles)
    }

    /// Returns a note on the narrowest part of the panel if it is thin: the shortest distance
    /// between nodes of the outline that are far apart along it and joined by one edge, or by two
    /// through one node.
    pub(crate) fn thin_part(&self, spacing: f64) -> Option<PatternNote> {
        // Number of the closed line of each node on one, place along the line, and length of the line.
        let mut along = vec![None; self.positions.len()];
        for (number, line) in self.lines().enumerate() {
            for (k, &node) in line.iter().enumerate() {
                along[node as usize] = Some((number, k, line.len()));
            }
        }
        let mut beside: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        for [a, b] in self.sides().flat_map(|[a, b]| [[a, b], [b, a]]) {
            if along[b as usize].is_some() {
                beside.entry(a).or_default().push(b);
            }
        }
        let at = |node: u32| self.positions[node as usize];
        let width = |a: u32, b: u32| {
            let ((line, one, count), (other_line, other, _)) =
                (along[a as usize]?, along[b as usize]?);
            let steps = one.abs_diff(other);
            let width = distance(at(a), at(b));
            // Closer along a line it is the side of a corner.
            let is_across = line != other_line || steps.min(count - steps) > 3;
            (is_across && width < THIN * spacing).then_some((width, a))
        };
        let direct = beside.iter().flat_map(|(&a, all)| all.iter().map(move |&b| (a, b)));
        let inner = beside.iter().filter(|(a, _)| along[**a as usize].is_none());
        let through = inner
            .flat_map(|(_, all)| all.iter().flat_map(move |&a| all.iter().map(move |&b| (a, b))));
        let widths = direct.chain(through).filter_map(|(a, b)| width(a, b));
        let (width, node) = widths.min_by(|a, b| a.0.total_cmp(&b.0))?;
        Some(PatternNote::Thin { panel: self.panel.clone(), width, at: at(node), spacing })
    }
}

/// Returns the largest distance between points of the outline and the chords of the cut, in m.
fn deviation(panel: &Panel, cut: &Cut) -> f64 {
    let lines: Vec<&[u32]> = cut.lines().collect();
    let mut along = vec![(0, 0); cut.positions.len()];
    for (number, line) in lines.iter().enumerate() {
        line.iter().enumerate().for_each(|(k, &node)| along[node as usize] = (number, k));
    }
    let mut most: f64 = 0.0;
    for (edge, nodes) in panel.edges().zip(&cut.edges) {
        let (number, start) = along[nodes[0] as usize];
        let line = lines[number];
        let at = |k: usize| cut.positions[line[k % line.len()] as usize];
        // One chord more at both ends: the ends may be no nodes.
        let first = start + line.len() - 1;
        let chords = nodes.len() + 1;
        let samples = SAMPLES * chords;
        for k in 0..=samples {
            let point = edge.at(k as f64 / samples as f64);
            // The chord at the same fraction of the edge, and its neighbours, since the ends may be
            // no nodes.
            let close =
                (k * chords / samples).saturating_sub(2)..(k * chords / samples + 3).min(chords);
            let apart = close.map(|c| from_segment(point, at(first + c), at(first + c + 1)));
            most = most.max(apart.fold(f64::MAX, f64::min));
        }
    }
    most
}

/// Returns the distance of a point from a segment.
fn from_segment(point: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let (side, arm) = (difference(b, a), difference(point, a));
    let square = side[0] * side[0] + side[1] * side[1];
    let along = ((arm[0] * side[0] + arm[1] * side[1]) / square).clamp(0.0, 1.0);
    (arm[0] - along * side[0]).hypot(arm[1] - along * side[1])
}
