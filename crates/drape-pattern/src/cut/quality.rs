//! Quality of a cut: edge lengths, angles, errors of area and outline, and thin parts.

use std::collections::BTreeMap;

use super::panel_cut::Cut;
use super::rim::angles;
use crate::edge::{cross, difference, distance};
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
    /// Returns the quality of `cut`, the cut of `panel` at a spacing of `spacing`, in m.
    #[must_use]
    pub fn new(panel: &Panel, cut: &Cut, spacing: f64) -> Self {
        let lengths =
            cut.sides().map(|[a, b]| distance(cut.position(a), cut.position(b)) / spacing);
        let (shortest_edge, longest_edge) = lengths
            .fold((f64::MAX, 0.0), |(low, high), length| (length.min(low), length.max(high)));
        let angles = cut.triangles.iter().flat_map(|t| angles(t.map(|node| cut.position(node))));

        // The sum of no terms is minus zero.
        let in_cells: f64 = 0.0 + cut.quads.iter().map(|quad| cut.area(quad)).sum::<f64>();
        let whole = in_cells + cut.triangles.iter().map(|t| cut.area(t)).sum::<f64>();
        Self {
            nodes: cut.positions.len(),
            quads: cut.quads.len(),
            triangles: cut.triangles.len(),
            shortest_edge,
            longest_edge,
            smallest_angle: angles.fold(std::f64::consts::FRAC_PI_2, f64::min),
            area_error: whole / panel.area() - 1.0,
            deviation: deviation(panel, cut),
            cell_fraction: in_cells / whole,
        }
    }
}

impl Cut {
    /// Returns the sides of all cells and triangles. A side between two of them comes twice.
    fn sides(&self) -> impl Iterator<Item = [u32; 2]> + '_ {
        let quads = self.quads.iter().flat_map(|q| (0..4).map(|k| [q[k], q[(k + 1) % 4]]));
        let triangles = self.triangles.iter().flat_map(|t| (0..3).map(|k| [t[k], t[(k + 1) % 3]]));
        quads.chain(triangles)
    }
    /// Returns the area of the convex polygon with the nodes `corners`, in m².
    fn area(&self, corners: &[u32]) -> f64 {
        let points: Vec<[f64; 2]> = corners
            .iter()
            .map(|&node| difference(self.position(node), self.position(corners[0])))
            .collect();
        points.windows(2).map(|pair| 0.5 * cross(pair[0], pair[1])).sum::<f64>()
    }

    /// Returns a note on the narrowest part of the panel if it is thin at `spacing`, in m.
    ///
    /// The width of a part is the shortest distance between nodes of the outline that are far apart
    /// along it and joined by one edge, or by two edges through one node.
    pub(crate) fn thin_part(&self, spacing: f64) -> Option<PatternNote> {
        // For each node on a closed line: number of the line, index on it, and length of the line.
        let mut along = vec![None; self.positions.len()];
        for (number, line) in self.lines().enumerate() {
            for (k, &node) in line.iter().enumerate() {
                along[node as usize] = Some((number, k, line.len()));
            }
        }

        // Neighbours of each node that are on a closed line.
        let mut beside: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        for [a, b] in self.sides().flat_map(|[a, b]| [[a, b], [b, a]]) {
            if along[b as usize].is_some() {
                beside.entry(a).or_default().push(b);
            }
        }
        let direct = beside.iter().flat_map(|(&a, all)| all.iter().map(move |&b| (a, b)));
        let inner = beside.iter().filter(|(a, _)| along[**a as usize].is_none());
        let through = inner
            .flat_map(|(_, all)| all.iter().flat_map(move |&a| all.iter().map(move |&b| (a, b))));

        let widths = direct.chain(through).filter_map(|(a, b)| {
            let (line, index, count) = along[a as usize]?;
            let (other_line, other_index, _) = along[b as usize]?;
            let steps = index.abs_diff(other_index);
            let width = distance(self.position(a), self.position(b));
            // Nodes that are close along a line lie on both sides of a corner.
            let is_across = line != other_line || steps.min(count - steps) > 3;
            (is_across && width < THIN * spacing).then_some((width, a))
        });
        let (width, node) = widths.min_by(|a, b| a.0.total_cmp(&b.0))?;
        let (panel, at) = (self.panel.clone(), self.position(node));
        Some(PatternNote::Thin { panel, width, at, spacing })
    }
}

/// Returns the largest distance of points on the outline of `panel` from the chords of `cut`, in m.
fn deviation(panel: &Panel, cut: &Cut) -> f64 {
    // For each node on a closed line: number of the line, and index on it.
    let lines: Vec<&[u32]> = cut.lines().collect();
    let mut along = vec![(0, 0); cut.positions.len()];
    for (number, line) in lines.iter().enumerate() {
        line.iter().enumerate().for_each(|(k, &node)| along[node as usize] = (number, k));
    }
    let mut most: f64 = 0.0;
    for (edge, nodes) in panel.edges().zip(&cut.edges) {
        let (number, start) = along[nodes[0] as usize];
        let line = lines[number];
        // The ends of the edge may be no nodes: one more chord at both ends.
        let first = start + line.len() - 1;
        let chords = nodes.len() + 1;
        let samples = SAMPLES * chords;
        for k in 0..=samples {
            let point = edge.at(k as f64 / samples as f64);
            // The chord at the same fraction of the edge, and its neighbours, since the ends may be
            // no nodes.
            let close =
                (k * chords / samples).saturating_sub(2)..(k * chords / samples + 3).min(chords);
            let gaps = close.map(|chord| {
                let [a, b] =
                    [first + chord, first + chord + 1].map(|k| cut.position(line[k % line.len()]));
                distance_from_segment(point, a, b)
            });
            most = most.max(gaps.fold(f64::MAX, f64::min));
        }
    }
    most
}

/// Returns the distance of `point` from the segment from `a` to `b`.
fn distance_from_segment(point: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let (side, arm) = (difference(b, a), difference(point, a));
    let square = side[0] * side[0] + side[1] * side[1];
    let along = ((arm[0] * side[0] + arm[1] * side[1]) / square).clamp(0.0, 1.0);
    (arm[0] - along * side[0]).hypot(arm[1] - along * side[1])
}
