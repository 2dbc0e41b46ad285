//! Folds of a panel: their check, the rest curvatures of its connectors, and the corners of its
//! cells that stand for shear.

use crate::error::Error;
use crate::panel::fold::{Fold, LineCoordinates, WeightedNode};
use crate::panel::lattice::Lattice;

/// Least product of the components of a line along weft and warp for a slanting line.
const SLANTED: f64 = 0.02;

/// Relative rounding of an angle.
const ROUNDING_ERROR: f64 = 1e-6;

impl Lattice {
    /// Returns the panel with folds in addition to those that it has.
    ///
    /// # Errors
    /// When a fold has no length or a number that is not finite, its angle is beyond
    /// [`Fold::ANGLE_MAX`], or the panel does not lie on both sides of it; and when the folds at a
    /// node add up to more than that angle.
    pub fn with_folds(mut self, folds: &[Fold]) -> Result<Self, Error> {
        for (fold, line) in folds.iter().enumerate() {
            let wrong = |what| Err(Error::Fold { fold, what });
            if !line.ends.iter().flatten().chain([&line.angle]).all(|x| x.is_finite()) {
                return wrong("has a number that is not finite");
            }
            if !(line.length() > 0.0) {
                return wrong("ends where it begins");
            }
            if line.angle.abs() > Fold::ANGLE_MAX {
                return wrong("has an angle beyond 140°");
            }
            let beside = |sign: f64| {
                let mut points = self.coordinates.iter().map(|&point| line.coordinates(point));
                points.any(|LineCoordinates { along, left }| {
                    (0.0..=line.length()).contains(&along) && sign * left > 0.0
                })
            };
            if !(beside(1.0) && beside(-1.0)) {
                return wrong("does not cross the panel");
            }
            self.folds.push(*line);
            let too_sharp = |(direction, yarns): (usize, &Vec<Vec<u32>>)| {
                let spacing = self.spacing[1 - direction];
                let limit = Fold::ANGLE_MAX * (1.0 + ROUNDING_ERROR);
                let curvatures = self.fold_curvatures(yarns, direction);
                curvatures.iter().any(|k| (k * spacing).abs() > limit)
            };
            if self.yarns().iter().enumerate().any(too_sharp) {
                return wrong(
                    "is so near to another that a yarn turns by more than 140° at a node",
                );
            }
        }
        Ok(self)
    }

    /// Returns the rest curvatures that folds add to the triples of one direction, by their middle
    /// particles, in 1/m; empty without folds.
    pub(crate) fn fold_curvatures(&self, yarns: &[Vec<u32>], direction: usize) -> Vec<f64> {
        let nodes = if self.folds.is_empty() { 0 } else { self.coordinates.len() };
        let mut curvatures = vec![0.0; nodes];
        for fold in &self.folds {
            self.add_fold(fold, yarns, direction, &mut curvatures);
        }
        curvatures
    }

    fn add_fold(&self, fold: &Fold, yarns: &[Vec<u32>], direction: usize, curvatures: &mut [f64]) {
        let square = self.spacing[1 - direction] * self.spacing[1 - direction];
        for triple in yarns.iter().flat_map(|yarn| yarn.windows(3)) {
            let coordinates = |k: usize| self.coordinates[triple[k] as usize];
            let nodes = [(coordinates(0), 1.0), (coordinates(1), -2.0), (coordinates(2), 1.0)];
            let nodes = nodes
                .map(|(coordinates, weight)| WeightedNode { coordinates, weight: weight / square });
            let middle = coordinates(1);
            let curvature = fold.rest_curvature(nodes.into_iter(), middle, direction, self.spacing);
            curvatures[triple[1] as usize] += curvature;
        }
    }

    /// Returns the areas of the corners of each cell, for shear, in m².
    ///
    /// Where a slanting fold passes a corner, its two yarns lie on both sides of the fold and meet
    /// at another angle when it is folded, by up to all of the fold's, although the cloth is not
    /// sheared. The two other corners of the cell, whose yarns lie on one side, then stand for the
    /// whole cell.
    pub(crate) fn shear_areas(&self) -> Vec<[f64; 4]> {
        let mut areas: Vec<[f64; 4]> = self.cells.iter().map(|cell| cell.quadrants).collect();
        for fold in &self.folds {
            let [u, v] = fold.direction();
            if (u * v).abs() < SLANTED {
                continue;
            }
            let mut bent = vec![0.0; self.coordinates.len()];
            for (direction, yarns) in self.yarns().iter().enumerate() {
                self.add_fold(fold, yarns, direction, &mut bent);
            }
            let turn_min = ROUNDING_ERROR * fold.angle.abs();
            let spacing = self.spacing[0].max(self.spacing[1]);
            let is_bent = |node: u32| (bent[node as usize] * spacing).abs() > turn_min;
            // The line rises with u from the first corner to the third, or falls from the fourth to
            // the second.
            let (clear, parted) = if u * v > 0.0 { ([1, 3], [0, 2]) } else { ([0, 2], [1, 3]) };
            for (cell, areas) in self.cells.iter().zip(&mut areas) {
                if parted.iter().any(|&corner| is_bent(cell.corners[corner])) {
                    let half = 0.5 * (areas[parted[0]] + areas[parted[1]]);
                    parted.iter().for_each(|&corner| areas[corner] = 0.0);
                    clear.iter().for_each(|&corner| areas[corner] += half);
                }
            }
        }
        areas
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fold_with_the_panel_on_one_side_only_is_refused() {
        let folded = |ends: [[f64; 2]; 2]| {
            let strip = Lattice::rectangle(0.2, 0.05, 0.01).expect("a strip");
            strip.with_folds(&[Fold { ends, angle: 1.0 }]).map(|folded| folded.folds.len())
        };
        let across = |u: f64| [[u, -0.01], [u, 0.06]];
        assert_eq!(folded(across(0.1)), Ok(1));
        // Along either short side, the same in the other sense, and beyond the panel.
        let [low, high] = [0.0, 0.2].map(across);
        for ends in [low, high, [low[1], low[0]], [high[1], high[0]], across(0.3), across(-0.1)] {
            let refused = Err(Error::Fold { fold: 0, what: "does not cross the panel" });
            assert_eq!(folded(ends), refused, "{ends:?}");
        }
    }
}
