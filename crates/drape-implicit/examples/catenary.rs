//! A chain that is released between two nails and comes to rest as a catenary.
//!
//! The links are springs so stiff that an explicit method would need steps below 0.1 ms. The steps
//! of this example are 50 ms. Backward Euler damps the swing.

use drape_implicit::{
    BlockMatrix, Error, Integrator, IntegratorState, Settings, Sparsity, Stepper, Stiffness, System,
};

const LINKS: usize = 60;
/// Length of the chain and distance of the nails, in m.
const LENGTH: f64 = 1.5;
const SPAN: f64 = 1.0;
/// Mass of a particle, in kg.
const MASS: f64 = 0.01;
/// Stiffness of a link, in N/m.
const STIFFNESS: f64 = 1e6;
/// Acceleration of gravity, in m/s².
const GRAVITY: f64 = 9.81;

struct Chain {
    masses: Vec<f64>,
    held: Vec<bool>,
}

struct Link {
    direction: [f64; 3],
    length: f64,
}

/// Link from a particle to the next.
fn link(x: &[f64], i: usize) -> Link {
    let d = [0, 1, 2].map(|k| x[3 * (i + 1) + k] - x[3 * i + k]);
    let length = d.iter().map(|d| d * d).sum::<f64>().sqrt();
    Link { direction: d.map(|d| d / length), length }
}

impl System for Chain {
    fn particle_count(&self) -> usize {
        LINKS + 1
    }

    fn masses(&self) -> &[f64] {
        &self.masses
    }

    fn held(&self) -> &[bool] {
        &self.held
    }

    fn begin(&mut self, _end_time: f64, _dt: f64, _start: &[f64], _target: &mut [f64]) {
        // The nails stay where they are.
    }

    fn forces(&mut self, x: &[f64], forces: &mut [f64]) {
        for force in forces.chunks_exact_mut(3) {
            force.copy_from_slice(&[0.0, -MASS * GRAVITY, 0.0]);
        }
        for i in 0..LINKS {
            let Link { direction, length } = link(x, i);
            for k in 0..3 {
                let tension = STIFFNESS * (length - LENGTH / LINKS as f64) * direction[k];
                forces[3 * i + k] += tension;
                forces[3 * (i + 1) + k] -= tension;
            }
        }
    }

    fn potential(&mut self, x: &[f64]) -> f64 {
        let weight: f64 = x.chunks_exact(3).map(|x| MASS * GRAVITY * x[1]).sum();
        let stretch = |i| link(x, i).length - LENGTH / LINKS as f64;
        weight + (0..LINKS).map(|i| 0.5 * STIFFNESS * stretch(i).powi(2)).sum::<f64>()
    }

    fn stiffness(&mut self, x: &[f64], kind: Stiffness, matrix: &mut BlockMatrix) {
        for i in 0..LINKS {
            let Link { direction: n, length } = link(x, i);
            // A compressed link is unstable across its direction.
            let across = 1.0 - LENGTH / LINKS as f64 / length;
            let across = if kind == Stiffness::Definite { across.max(0.0) } else { across };
            let block: [f64; 9] = core::array::from_fn(|k| {
                let (row, column) = (k / 3, k % 3);
                let along = n[row] * n[column];
                let unit = if row == column { 1.0 } else { 0.0 };
                STIFFNESS * (along + across * (unit - along))
            });
            matrix.add(i, i, &block);
            matrix.add(i + 1, i + 1, &block);
            matrix.add(i, i + 1, &block.map(|entry| -entry));
        }
    }

    fn sparsity(&self) -> Sparsity {
        let neighbours = (0..LINKS).map(|i| [i, i + 1]);
        Sparsity::from_pairs(LINKS + 1, neighbours).expect("links are between particles")
    }

    fn accept(&mut self, _positions: &[f64], _velocities: &[f64], _dt: f64) {}
}

/// Parameter `a` of the catenary `y = a cosh(x/a)` of a length over a span, in m.
fn catenary(length: f64, span: f64) -> f64 {
    let (mut low, mut high) = (0.05 * span, 50.0 * span);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        // The smaller the parameter, the deeper the catenary and the longer the arc.
        if 2.0 * middle * (0.5 * span / middle).sinh() > length {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

#[expect(clippy::print_stdout, reason = "an example shows its result")]
fn main() -> Result<(), Error> {
    let mut held = vec![false; LINKS + 1];
    (held[0], held[LINKS]) = (true, true);
    let mut chain = Chain { masses: vec![MASS; LINKS + 1], held };

    // Two straight halves at the start.
    let drop = (0.25 * (LENGTH * LENGTH - SPAN * SPAN)).sqrt();
    let place = |i: usize| {
        let s = i as f64 / LINKS as f64;
        [SPAN * s, -drop * (1.0 - (2.0 * s - 1.0).abs()), 0.0]
    };
    let mut state = IntegratorState::at_rest((0..=LINKS).flat_map(place).collect());

    let settings = Settings { integrator: Integrator::BackwardEuler, ..Settings::default() };
    let mut stepper = Stepper::new(&chain, settings)?;
    let mut iterations = 0;
    for _ in 0..200 {
        iterations += stepper.advance(&mut chain, &mut state, 0.05)?.iterations;
    }

    let a = catenary(LENGTH, SPAN);
    let expected = a * ((0.5 * SPAN / a).cosh() - 1.0);
    let sag = -state.positions[3 * (LINKS / 2) + 1];
    println!(
        "sag of the chain {sag:.5} m, of the catenary {expected:.5} m; {iterations} iterations"
    );
    assert!((sag / expected - 1.0).abs() < 1e-3);
    Ok(())
}
