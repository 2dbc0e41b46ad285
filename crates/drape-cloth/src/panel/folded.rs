//! Folds of a panel: their checks, the rest curvatures of its connectors, and the corners of its
//! cells that stand for shear.

use crate::error::Error;
use crate::panel::fold::{Fold, LineCoordinates, WeightedPoint};
use crate::panel::lattice::Lattice;

/// Least product of the components of a line's direction along weft and warp for a slanting line.
const SLANTED: f64 = 0.02;

/// Relative rounding error of an angle.
const ROUNDING_ERROR: f64 = 1e-6;

impl Lattice {
    /// Returns the panel with `folds` in addition to its present folds.
    ///
    /// # Errors
    /// A fold has no length or a number that is not finite; its angle is beyond
    /// [`Fold::ANGLE_MAX`]; the panel does not lie on both sides of it; or the folds at a node add
    /// up to more than that angle.
    pub fn with_folds(mut self, folds: &[Fold]) -> Result<Self, Error> {
        for (fold, line) in folds.iter().enumerate() {
            if let Err(what) = self.check_fold(line) {
                return Err(Error::Fold { fold, what });
            }
            self.folds.push(*line);
            if self.has_sharp_node() {
                let what = "is so near to another that a yarn turns by more than 140° at a node";
                return Err(Error::Fold { fold, what });
            }
        }
        Ok(self)
    }

    /// Checks the numbers of `line` and that it crosses the panel. The error is a part of a
    /// sentence.
    fn check_fold(&self, line: &Fold) -> Result<(), &'static str> {
        if !line.ends.iter().flatten().chain([&line.angle]).all(|x| x.is_finite()) {
            return Err("has a number that is not finite");
        }
        if !(line.length() > 0.0) {
            return Err("ends where it begins");
        }
        if line.angle.abs() > Fold::ANGLE_MAX {
            return Err("has an angle beyond 140°");
        }

        // Particles beside the line, on both of its sides.
        let mut lefts = self
            .coordinates
            .iter()
            .map(|&point| line.coordinates(point))
            .filter(|point| (0.0..=line.length()).contains(&point.along))
            .map(|LineCoordinates { left, .. }| left);
        let crosses = lefts.clone().any(|left| left > 0.0) && lefts.any(|left| left < 0.0);
        if crosses { Ok(()) } else { Err("does not cross the panel") }
    }

    /// Returns whether the folds turn a yarn at a node by more than [`Fold::ANGLE_MAX`].
    fn has_sharp_node(&self) -> bool {
        let limit = Fold::ANGLE_MAX * (1.0 + ROUNDING_ERROR);
        self.yarns().iter().enumerate().any(|(direction, yarns)| {
            let spacing = self.spacing[1 - direction];
            let curvatures = self.fold_curvatures(yarns, direction);
            curvatures.iter().any(|k| (k * spacing).abs() > limit)
        })
    }

    /// Returns the rest curvatures that folds add to the triples of `yarns`, the yarns along
    /// `direction`, by their middle particles, in 1/m. The result is empty without folds.
    pub(crate) fn fold_curvatures(&self, yarns: &[Vec<u32>], direction: usize) -> Vec<f64> {
        let nodes = if self.folds.is_empty() { 0 } else { self.coordinates.len() };
        let mut curvatures = vec![0.0; nodes];
        for fold in &self.folds {
            self.add_fold(fold, yarns, direction, &mut curvatures);
        }
        curvatures
    }

    /// Adds the rest curvatures of `fold` to `curvatures`, in 1/m, by the middle particles of the
    /// triples of `yarns`.
    fn add_fold(&self, fold: &Fold, yarns: &[Vec<u32>], direction: usize, curvatures: &mut [f64]) {
        let square = self.spacing[1 - direction] * self.spacing[1 - direction];
        for triple in yarns.iter().flat_map(|yarn| yarn.windows(3)) {
            let points = [triple[0], triple[1], triple[2]]
                .map(|particle| self.coordinates[particle as usize]);
            let nodes = points.into_iter().zip([1.0, -2.0, 1.0]);
            let nodes = nodes.map(|(coordinates, weight)| WeightedPoint {
                coordinates,
                weight: weight / square,
            });
            let curvature = fold.rest_curvature(nodes, points[1], direction, self.spacing);
            curvatures[triple[1] as usize] += curvature;
        }
    }

    /// Returns the areas for shear of the corners of each of `cells`, in m².
    ///
    /// Where a slanting fold passes a corner, the two yarns of the corner lie on both sides of the
    /// fold. When it is folded they meet at another angle, by up to the whole angle of the fold,
    /// although the cloth is not sheared. The two other corners of the cell, whose yarns lie on one
    /// side, then stand for the whole cell.
    pub(crate) fn shear_areas(&self) -> Vec<[f64; 4]> {
        let mut areas: Vec<[f64; 4]> = self.cells.iter().map(|cell| cell.quadrants).collect();
        for fold in &self.folds {
            let [u, v] = fold.direction();
            if (u * v).abs() < SLANTED {
                continue;
            }
            // Turn of the yarns at each particle by this fold alone.
            let mut bent = vec![0.0; self.coordinates.len()];
            for (direction, yarns) in self.yarns().iter().enumerate() {
                self.add_fold(fold, yarns, direction, &mut bent);
            }
            // The line rises with u from the first corner to the third, or falls from the fourth to
            // the second.
            let turn_min = ROUNDING_ERROR * fold.angle.abs();
            let spacing = self.spacing[0].max(self.spacing[1]);
            let (clear, parted) = if u * v > 0.0 { ([1, 3], [0, 2]) } else { ([0, 2], [1, 3]) };
            for (cell, areas) in self.cells.iter().zip(&mut areas) {
                let is_parted = parted
                    .iter()
                    .map(|&corner| bent[cell.corners[corner] as usize])
                    .any(|turn: f64| (turn * spacing).abs() > turn_min);
                if is_parted {
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
