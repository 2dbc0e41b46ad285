//! A taut chain of stiff links that vibrates along its length. Its slowest mode is known exactly,
//! and its fastest one is hundreds of times faster than the steps.

use std::time::Instant;

use drape_implicit::{
    BlockMatrix, Error, IntegratorState, Settings, Sparsity, Stepper, Stiffness, System,
};

/// Number of links, between two walls 1 m apart.
const LINKS: usize = 200;
const LINK: f64 = 1.0 / LINKS as f64;

/// Length of a link without load, in m: the chain is stretched by 1 %.
const REST: f64 = LINK / 1.01;

/// Mass of a particle in kg, and stiffness of a link in N/m.
const MASS: f64 = 1e-3;
const STIFFNESS: f64 = 2e5;

/// Displacement in the middle at the start, in m.
const AMPLITUDE: f64 = 1e-3;

struct Chain {
    masses: Vec<f64>,
    held: Vec<bool>,
}

/// Returns the unit vector from the particle `i` to the next one, and the length of the link.
fn link(x: &[f64], i: usize) -> ([f64; 3], f64) {
    let d = [0, 1, 2].map(|k| x[3 * i + 3 + k] - x[3 * i + k]);
    let length = d.iter().map(|d| d * d).sum::<f64>().sqrt();
    (d.map(|d| d / length), length)
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

    fn begin(&mut self, _end_time: f64, _dt: f64, _start: &[f64], _target: &mut [f64]) {}

    fn forces(&mut self, x: &[f64], forces: &mut [f64]) {
        forces.fill(0.0);
        for i in 0..LINKS {
            let (direction, length) = link(x, i);
            for k in 0..3 {
                let tension = STIFFNESS * (length - REST) * direction[k];
                forces[3 * i + k] += tension;
                forces[3 * i + 3 + k] -= tension;
            }
        }
    }

    fn potential(&mut self, x: &[f64]) -> f64 {
        (0..LINKS).map(|i| 0.5 * STIFFNESS * (link(x, i).1 - REST).powi(2)).sum()
    }

    fn stiffness(&mut self, x: &[f64], _kind: Stiffness, matrix: &mut BlockMatrix) {
        for i in 0..LINKS {
            let (n, length) = link(x, i);
            // A slack link would be unstable across its direction.
            let across = (1.0 - REST / length).max(0.0);
            let block: [f64; 9] = std::array::from_fn(|k| {
                let (along, unit) = (n[k / 3] * n[k % 3], f64::from(u8::from(k / 3 == k % 3)));
                STIFFNESS * (along + across * (unit - along))
            });
            matrix.add(i, i, &block);
            matrix.add(i + 1, i + 1, &block);
            matrix.add(i, i + 1, &block.map(|entry| -entry));
        }
    }

    fn sparsity(&self) -> Sparsity {
        let links = (0..LINKS).map(|i| [i, i + 1]);
        Sparsity::from_pairs(LINKS + 1, links).expect("links join particles that exist")
    }

    fn accept(&mut self, _positions: &[f64], _velocities: &[f64], _dt: f64) {}
}

/// Returns the shape of the slowest mode at the particle `i`.
fn mode(i: usize) -> f64 {
    (std::f64::consts::PI * i as f64 / LINKS as f64).sin()
}

/// Integrates one period in `steps` steps. Returns the largest error of a position at the end, as a
/// fraction of the amplitude.
fn error(steps: u32) -> Result<f64, Error> {
    let mut held = vec![false; LINKS + 1];
    (held[0], held[LINKS]) = (true, true);
    let mut chain = Chain { masses: vec![MASS; LINKS + 1], held };
    let place = |i: usize| [LINK * i as f64 + AMPLITUDE * mode(i), 0.0, 0.0];
    let mut state = IntegratorState::at_rest((0..=LINKS).flat_map(place).collect());

    // The tolerance counts in accelerations, and the chain has hundreds of m/s².
    let rate = 2.0 * (STIFFNESS / MASS).sqrt() * (0.5 * std::f64::consts::PI / LINKS as f64).sin();
    let settings =
        Settings { acceleration: rate * rate * AMPLITUDE, tolerance: 1e-9, ..Settings::default() };
    let mut stepper = Stepper::new(&chain, settings)?;
    let dt = std::f64::consts::TAU / rate / f64::from(steps);
    for _ in 0..steps {
        stepper.advance(&mut chain, &mut state, dt)?;
    }

    // After a whole period the chain is back at its start.
    let errors = (0..=LINKS).map(|i| (state.positions[3 * i] - place(i)[0]).abs() / AMPLITUDE);
    Ok(errors.fold(0.0, f64::max))
}

fn main() -> Result<(), Error> {
    let begin = Instant::now();
    let errors = [error(100)?, error(200)?, error(400)?];
    let milliseconds = 1e3 * begin.elapsed().as_secs_f64();

    // BDF2 is of second order: half of the step has a quarter of the error.
    for pair in errors.windows(2) {
        assert!((3.7..4.3).contains(&(pair[0] / pair[1])), "second order: {errors:?}");
    }
    assert!(errors[2] < 2e-3, "{errors:?}");
    println!(
        "a period of a stiff chain, off by {:.4} of its amplitude in 400 steps: {milliseconds:.1} ms",
        errors[2]
    );
    Ok(())
}
