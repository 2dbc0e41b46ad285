//! A net of springs under gravity, with a linear law between two particles each.

use drape_implicit::{BlockMatrix, Sparsity, Stiffness, System};

pub const GRAVITY: f64 = 9.81;

#[derive(Clone, Debug)]
pub struct Spring {
    pub ends: [usize; 2],
    /// N/m
    pub stiffness: f64,
    /// m
    pub length: f64,
}

#[derive(Clone, Debug)]
pub struct Springs {
    pub masses: Vec<f64>,
    pub held: Vec<bool>,
    pub springs: Vec<Spring>,
    /// m/s², along y
    pub gravity: f64,
    /// Speed of held particles along x, m/s
    pub drawn: f64,
    /// Lengths of the accepted sub-steps, s.
    pub accepted: Vec<f64>,
}

impl Springs {
    /// A chain along the given points with equal masses.
    pub fn chain(links: usize, length: f64, mass: f64, stiffness: f64) -> Self {
        let link = length / links as f64;
        let springs = (0..links).map(|i| Spring { ends: [i, i + 1], stiffness, length: link });
        Self {
            masses: vec![mass; links + 1],
            held: vec![false; links + 1],
            springs: springs.collect(),
            gravity: GRAVITY,
            drawn: 0.0,
            accepted: Vec::new(),
        }
    }

    /// A square sheet of n × n particles, 1 m wide and 0.2 kg, with soft diagonals: a cloth without
    /// bending.
    pub fn sheet(n: usize, stiffness: f64) -> Self {
        let spacing = 1.0 / (n - 1) as f64;
        let at = |i: usize, j: usize| i * n + j;
        let mut springs = Vec::new();
        let mut add = |a, b, factor: f64, length| {
            springs.push(Spring { ends: [a, b], stiffness: factor * stiffness, length });
        };
        for i in 0..n {
            for j in 0..n {
                if j + 1 < n {
                    add(at(i, j), at(i, j + 1), 1.0, spacing);
                }
                if i + 1 < n {
                    add(at(i, j), at(i + 1, j), 1.0, spacing);
                }
                if i + 1 < n && j + 1 < n {
                    let diagonal = spacing * 2.0_f64.sqrt();
                    add(at(i, j), at(i + 1, j + 1), 0.01, diagonal);
                    add(at(i, j + 1), at(i + 1, j), 0.01, diagonal);
                }
            }
        }
        let mut held = vec![false; n * n];
        held[0] = true;
        held[n - 1] = true;
        Self {
            masses: vec![0.2 / (n * n) as f64; n * n],
            held,
            springs,
            gravity: GRAVITY,
            drawn: 0.0,
            accepted: Vec::new(),
        }
    }

    /// Positions of a flat horizontal sheet.
    pub fn flat(n: usize) -> Vec<f64> {
        let spacing = 1.0 / (n - 1) as f64;
        let grid = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
        grid.flat_map(|(i, j)| [j as f64 * spacing, 0.0, i as f64 * spacing]).collect()
    }

    pub fn energy(&mut self, positions: &[f64], velocities: &[f64]) -> f64 {
        let kinetic: f64 = self
            .masses
            .iter()
            .zip(velocities.chunks(3))
            .map(|(m, v)| 0.5 * m * v.iter().map(|v| v * v).sum::<f64>())
            .sum();
        kinetic + self.potential(positions)
    }
}

fn arrow(positions: &[f64], [i, j]: [usize; 2]) -> ([f64; 3], f64) {
    let d = [0, 1, 2].map(|k| positions[3 * j + k] - positions[3 * i + k]);
    (d, d.iter().map(|d| d * d).sum::<f64>().sqrt())
}

impl System for Springs {
    fn particle_count(&self) -> usize {
        self.masses.len()
    }

    fn masses(&self) -> &[f64] {
        &self.masses
    }

    fn held(&self) -> &[bool] {
        &self.held
    }

    fn begin(&mut self, _: f64, dt: f64, start: &[f64], target: &mut [f64]) {
        for particle in (0..self.masses.len()).filter(|&particle| self.held[particle]) {
            target[3 * particle] = start[3 * particle] + self.drawn * dt;
        }
    }

    fn forces(&mut self, positions: &[f64], forces: &mut [f64]) {
        for (force, mass) in forces.chunks_mut(3).zip(&self.masses) {
            force.copy_from_slice(&[0.0, -mass * self.gravity, 0.0]);
        }
        for spring in &self.springs {
            let (d, length) = arrow(positions, spring.ends);
            // Written for a natural length of zero too, where the force is linear.
            let pull = if spring.length == 0.0 { 1.0 } else { 1.0 - spring.length / length };
            for k in 0..3 {
                let force = spring.stiffness * pull * d[k];
                forces[3 * spring.ends[0] + k] += force;
                forces[3 * spring.ends[1] + k] -= force;
            }
        }
    }

    fn potential(&mut self, positions: &[f64]) -> f64 {
        let weight: f64 =
            self.masses.iter().zip(positions.chunks(3)).map(|(m, x)| m * self.gravity * x[1]).sum();
        let elastic = self.springs.iter().map(|spring| {
            let (_, length) = arrow(positions, spring.ends);
            0.5 * spring.stiffness * (length - spring.length).powi(2)
        });
        weight + elastic.sum::<f64>()
    }

    fn stiffness(&mut self, positions: &[f64], kind: Stiffness, matrix: &mut BlockMatrix) {
        for spring in &self.springs {
            let (d, length) = arrow(positions, spring.ends);
            let mut across = if spring.length == 0.0 { 1.0 } else { 1.0 - spring.length / length };
            if kind == Stiffness::Definite {
                across = across.max(0.0);
            }
            let mut block = [0.0; 9];
            for r in 0..3 {
                for c in 0..3 {
                    let along = if length > 0.0 { d[r] * d[c] / (length * length) } else { 0.0 };
                    let unit = if r == c { 1.0 } else { 0.0 };
                    block[3 * r + c] = spring.stiffness * (along + across * (unit - along));
                }
            }
            let [i, j] = spring.ends;
            matrix.add(i, i, &block);
            matrix.add(j, j, &block);
            matrix.add(i, j, &block.map(|value| -value));
        }
    }

    fn sparsity(&self) -> Sparsity {
        let pairs = self.springs.iter().map(|spring| spring.ends);
        Sparsity::from_pairs(self.masses.len(), pairs).unwrap()
    }

    fn accept(&mut self, _: &[f64], _: &[f64], dt: f64) {
        self.accepted.push(dt);
    }
}
