//! Region of a panel that is to be filled: closed polygons with the cloth on their left, the outline
//! and then the holes of darts.

use std::ops::Range;

use crate::polygon::{meeting, self_intersection};

/// Region between closed polygons.
#[derive(Debug, Clone)]
pub(crate) struct Region {
    /// Corners of all polygons.
    pub corners: Vec<[f64; 2]>,
    /// Corners of each polygon.
    lines: Vec<Range<usize>>,
}

impl Region {
    pub fn new(corners: Vec<[f64; 2]>, lines: Vec<Range<usize>>) -> Self {
        Self { corners, lines }
    }

    /// Returns the corner after a corner.
    pub fn next(&self, corner: usize) -> usize {
        let line = self.lines.iter().find(|line| line.contains(&corner));
        line.map_or(corner, |line| if corner + 1 < line.end { corner + 1 } else { line.start })
    }

    /// Returns all sides by their corners.
    pub fn sides(&self) -> impl Iterator<Item = [usize; 2]> {
        let of_line = |line: &Range<usize>| {
            let line = line.clone();
            line.clone().map(move |k| [k, if k + 1 < line.end { k + 1 } else { line.start }])
        };
        self.lines.iter().flat_map(of_line)
    }

    /// Returns a corner at which a polygon meets itself or another one, if there is one.
    pub fn intersection(&self) -> Option<usize> {
        for (number, line) in self.lines.iter().enumerate() {
            let polygon = &self.corners[line.clone()];
            if let Some([first, _]) = self_intersection(polygon) {
                return Some(line.start + first);
            }
            let others = self.lines[..number].iter().find_map(|other| {
                let [side, _] = meeting(polygon, &self.corners[other.clone()])?;
                Some(line.start + side)
            });
            if others.is_some() {
                return others;
            }
        }
        None
    }

    /// Returns twice the area.
    pub fn twice_area(&self) -> f64 {
        let cross = |[a, b]: [usize; 2]| {
            let (a, b) = (self.corners[a], self.corners[b]);
            a[0] * b[1] - a[1] * b[0]
        };
        self.sides().map(cross).sum()
    }
}
