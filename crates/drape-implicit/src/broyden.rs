//! Broyden's updates of an inverse, kept as a product of rank-one factors.
//!
//! After a step `s` that changed the residual by `y`, the inverse `H` becomes
//! `H' = (I + w sᵀ) H` with `w = (s − H y)/(sᵀ H y)`, the smallest change of the tangent that maps `s` to `y`
//! ("good Broyden"; Kelley 1995, ch. 7). Only `s` and `w` of each update are stored.

use crate::vector::{add_scaled, dot};

/// The updates made to one initial inverse. Their storage is kept when they are forgotten.
#[derive(Debug, Default)]
pub(crate) struct Updates {
    steps: Vec<Vec<f64>>,
    gains: Vec<Vec<f64>>,
    count: usize,
}

impl Updates {
    /// Room for so many updates; more are made room for when they come.
    pub(crate) fn with_room(updates: usize, length: usize) -> Self {
        let room = vec![vec![0.0; length]; updates];
        Self { steps: room.clone(), gains: room, count: 0 }
    }

    pub(crate) fn forget(&mut self) {
        self.count = 0;
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Turns `H₀ φ` into `H φ`.
    pub(crate) fn apply(&self, z: &mut [f64]) {
        for (step, gain) in self.steps.iter().zip(&self.gains).take(self.count) {
            let along = dot(step, z);
            add_scaled(z, along, gain);
        }
    }

    /// Learns from a step `length · direction`, where `direction = −H φ` before it and `z = H φ` after it.
    ///
    /// Refuses, and returns false, when `sᵀ H y < floor · sᵀ s`: the tangent along the step has fallen to that
    /// fraction of what was expected, and the update would multiply errors by its inverse.
    pub(crate) fn learn(&mut self, direction: &[f64], length: f64, z: &[f64], floor: f64) -> bool {
        let square = length * length * dot(direction, direction);
        let along = length * (dot(direction, z) + dot(direction, direction));
        let sound = along > floor * square;
        if !sound {
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

    /// Applies the last update alone: `z` held `H φ` before it was learnt.
    pub(crate) fn apply_last(&self, z: &mut [f64]) {
        if let Some(last) = self.count.checked_sub(1) {
            let along = dot(&self.steps[last], z);
            add_scaled(z, along, &self.gains[last]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// On a linear problem in n dimensions Broyden's method ends in at most 2n steps (Gay 1979).
    #[test]
    fn a_linear_problem_is_solved_in_twice_its_dimension() {
        let a = [[4.0, 1.0, 0.0], [1.0, 3.0, -1.0], [0.0, -1.0, 2.5]];
        let b = [1.0, -2.0, 0.5];
        let residual =
            |x: &[f64]| -> Vec<f64> { a.iter().zip(b).map(|(row, b)| dot(row, x) - b).collect() };
        let mut updates = Updates::default();
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
