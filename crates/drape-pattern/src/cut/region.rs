//! Region of a panel: closed polygons with the cloth on their left, the outline and then the holes
//! of darts.

use std::ops::Range;

use crate::edge::cross;
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
    /// Returns the region between the polygons `lines`, which are ranges of `corners`.
    pub fn new(corners: Vec<[f64; 2]>, lines: Vec<Range<usize>>) -> Self {
        Self { corners, lines }
    }

    /// Returns the corner after `corner` along its polygon.
    pub fn next(&self, corner: usize) -> usize {
        let line = self.lines.iter().find(|line| line.contains(&corner));
        line.map_or(corner, |line| if corner + 1 < line.end { corner + 1 } else { line.start })
    }

    /// Returns all sides by their corners.
    /// Returns all sides by their corners.
    pub fn sides(&self) -> impl Iterator<Item = [usize; 2]> {
        self.lines.iter().flat_map(|line| {
            let line = line.clone();
            line.clone().map(move |k| [k, if k + 1 < line.end { k + 1 } else { line.start }])
        })
    }

    /// Returns a corner at which a polygon meets itself or another polygon, if there is one.
    pub fn intersection(&self) -> Option<usize> {
        for (number, line) in self.lines.iter().enumerate() {
            let polygon = &self.corners[line.clone()];
            if let Some([first, _]) = self_intersection(polygon) {
                return Some(line.start + first);
            }
            let meeting_corner = self.lines[..number].iter().find_map(|earlier| {
                let [side, _] = meeting(polygon, &self.corners[earlier.clone()])?;
                Some(line.start + side)
            });
            if meeting_corner.is_some() {
                return meeting_corner;
            }
        }
        None
    }

    /// Returns twice the area, positive if the outline runs anticlockwise.
    pub fn twice_area(&self) -> f64 {
        self.sides().map(|[a, b]| cross(self.corners[a], self.corners[b])).sum()
    }
}
