//! Broyden's updates of the inverse of a system matrix, kept as a product of rank-one factors.
//!
//! After a step `$s$` that changed the residual by `$y$`, the inverse `$H$` becomes
//!
//! ```math
//! H' = (I + w\,s^T)\,H, \qquad w = \frac{s - H y}{s^T H y}
//! ```
//!
//! This update corresponds to the smallest change of the matrix that makes the matrix map `$s$` to
//! `$y$` ("good Broyden", \[Bro65\], \[Kel95\] chapter 7). Only `$s$` and `$w$` of each update are
//! stored.

use super::search::Search;
use crate::linear::vector::{add_scaled, dot};

/// Broyden's updates of one initial inverse `H₀`. [`forget`](Self::forget) keeps the storage.
#[derive(Debug, Default)]
pub(crate) struct BroydenUpdates {
    steps: Vec<Vec<f64>>,
    gains: Vec<Vec<f64>>,
    count: usize,
}

impl BroydenUpdates {
    /// Allocates storage for a number of `updates` of vectors with `length` entries. The storage
    /// grows if needed.
    pub(crate) fn with_capacity(updates: usize, length: usize) -> Self {
        let storage = vec![vec![0.0; length]; updates];
        Self { steps: storage.clone(), gains: storage, count: 0 }
    }

    /// Removes all updates, so that the inverse is `H₀` again.
    pub(crate) fn forget(&mut self) {
        self.count = 0;
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Computes the next direction of `search` after a step of `length` along the last direction.
    /// On entry the image is `H₀ φ` at the end of the step.
    ///
    /// Returns `false` and keeps the direction if [`learn`](Self::learn) refuses the update of the
    /// step. `floor` is the least curvature of an update.
    pub(crate) fn next_direction(&mut self, search: &mut Search, length: f64, floor: f64) -> bool {
        self.apply(&mut search.image);
        if !self.learn(&search.direction, length, &search.image, floor) {
            return false;
        }
        self.apply_last(&mut search.image);
        search.descend();
        true
    }

    /// Turns `z = H₀ φ` into `z = H φ`.
    fn apply(&self, z: &mut [f64]) {
        for (step, gain) in self.steps.iter().zip(&self.gains).take(self.count) {
            let along = dot(step, z);
            add_scaled(z, along, gain);
        }
    }

    /// Adds the update of a step `length · direction`, with `direction = −H φ` before the step and
    /// `z = H φ` after the step.
    ///
    /// Refuses the update and returns `false` unless `sᵀ H y > floor · sᵀ s`. Otherwise the
    /// curvature along the step would be less than the fraction `floor` of the curvature of the
    /// matrix, and the update would multiply errors by more than `1/floor`.
    fn learn(&mut self, direction: &[f64], length: f64, z: &[f64], floor: f64) -> bool {
        let square = length * length * dot(direction, direction);
        let along = length * (dot(direction, z) + dot(direction, direction));
        // Written so that a NaN is refused too.
        let accepted = along > floor * square;
        if !accepted {
            return false;
        }

        if self.count == self.steps.len() {
            self.steps.push(vec![0.0; z.len()]);
            self.gains.push(vec![0.0; z.len()]);
        }

        let step = &mut self.steps[self.count];
        let gain = &mut self.gains[self.count];
        for (((s, w), p), z) in step.iter_mut().zip(gain).zip(direction).zip(z) {
            *s = length * p;
            *w = (*s - (z + p)) / along;
        }
        self.count += 1;
        true
    }

    /// Applies the last update alone to `z`, which is `H φ` with the inverse before the last
    /// update.
    fn apply_last(&self, z: &mut [f64]) {
        if let Some(last) = self.count.checked_sub(1) {
            let along = dot(&self.steps[last], z);
            add_scaled(z, along, &self.gains[last]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// On a linear problem in n dimensions Broyden's method ends in at most 2n steps \[Gay79\].
    #[test]
    fn a_linear_problem_is_solved_in_twice_its_dimension() {
        let a = [[4.0, 1.0, 0.0], [1.0, 3.0, -1.0], [0.0, -1.0, 2.5]];
        let b = [1.0, -2.0, 0.5];
        let residual =
            |x: &[f64]| -> Vec<f64> { a.iter().zip(b).map(|(row, b)| dot(row, x) - b).collect() };
        let mut updates = BroydenUpdates::default();
        let mut x = vec![0.0; 3];
        let mut phi = residual(&x);
        let mut direction: Vec<f64> = phi.iter().map(|phi| -phi).collect();
        let mut steps = 0;
        while dot(&phi, &phi).sqrt() > 1e-12 {
            add_scaled(&mut x, 1.0, &direction);
            steps += 1;
            phi = residual(&x);
            let mut z = phi.clone();
            updates.apply(&mut z);
            if !updates.learn(&direction, 1.0, &z, 0.0) {
                break;
            }
            updates.apply_last(&mut z);
            direction = z.iter().map(|z| -z).collect();
        }
        let left = dot(&phi, &phi).sqrt();
        assert!(steps <= 6 && left <= 1e-12, "residual {left:e} after {steps} steps");
    }
}
