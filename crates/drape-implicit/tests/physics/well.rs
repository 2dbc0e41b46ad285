//! One particle on the x axis in a potential given by functions, moved by nothing else.

use drape_implicit::{BlockMatrix, Sparsity, Stiffness, System};

pub struct Well {
    /// V, V′ and V″ at x.
    pub law: fn(f64) -> [f64; 3],
    /// The system is undefined for steps longer than this, s.
    pub longest_step: f64,
    pub step: f64,
    pub ends: Vec<f64>,
    pub accepted: Vec<f64>,
    pub evaluations: usize,
}

impl Well {
    pub fn new(law: fn(f64) -> [f64; 3]) -> Self {
        Self {
            law,
            longest_step: f64::INFINITY,
            step: 0.0,
            ends: Vec::new(),
            accepted: Vec::new(),
            evaluations: 0,
        }
    }
}

impl System for Well {
    fn particle_count(&self) -> usize {
        1
    }

    fn masses(&self) -> &[f64] {
        &[1.0]
    }

    fn held(&self) -> &[bool] {
        &[false]
    }

    fn begin(&mut self, end_time: f64, dt: f64, _: &[f64], _: &mut [f64]) {
        self.step = dt;
        self.ends.push(end_time);
    }

    fn forces(&mut self, positions: &[f64], forces: &mut [f64]) {
        self.evaluations += 1;
        let force =
            if self.step > self.longest_step { f64::NAN } else { -(self.law)(positions[0])[1] };
        forces.copy_from_slice(&[force, 0.0, 0.0]);
    }

    fn potential(&mut self, positions: &[f64]) -> f64 {
        (self.law)(positions[0])[0]
    }

    fn stiffness(&mut self, positions: &[f64], kind: Stiffness, matrix: &mut BlockMatrix) {
        let curvature = (self.law)(positions[0])[2];
        let curvature = if kind == Stiffness::Definite { curvature.max(0.0) } else { curvature };
        matrix.values_mut()[0] = curvature;
    }

    fn sparsity(&self) -> Sparsity {
        Sparsity::from_pairs(1, []).unwrap()
    }

    fn accept(&mut self, _: &[f64], _: &[f64], dt: f64) {
        self.accepted.push(dt);
    }
}
