//! Against exact solutions and the known errors of the formulas.

use drape_implicit::{Integrator, IntegratorState, Settings, Stepper};

use crate::springs::Springs;
use crate::well::Well;

/// Angular frequency of the oscillator below, 1/s.
const OMEGA: f64 = 10.0;

fn spring_law(x: f64) -> [f64; 3] {
    [0.5 * OMEGA * OMEGA * x * x, OMEGA * OMEGA * x, OMEGA * OMEGA]
}

/// Solves each step to rounding, so that only the formula's error is left.
fn exact(integrator: Integrator) -> Settings {
    Settings { integrator, tolerance: 1e-12, energy_balance: true, ..Settings::default() }
}

fn oscillate(integrator: Integrator, dt: impl Fn(usize) -> f64, steps: usize) -> IntegratorState {
    let mut system = Well::new(spring_law);
    let mut stepper = Stepper::new(&system, exact(integrator)).unwrap();
    let mut state = IntegratorState::at_rest(vec![1.0, 0.0, 0.0]);
    for step in 0..steps {
        stepper.advance(&mut system, &mut state, dt(step)).unwrap();
    }
    state
}

fn error(state: &IntegratorState) -> f64 {
    let phase = OMEGA * state.time;
    let (x, v) = (state.positions[0] - phase.cos(), state.velocities[0] / OMEGA + phase.sin());
    x.hypot(v)
}

#[test]
fn free_fall_is_exact_for_the_backward_euler_formula() {
    let mut system = Springs::chain(1, 1.0, 0.3, 0.0);
    let mut stepper = Stepper::new(&system, exact(Integrator::BackwardEuler)).unwrap();
    let mut state = IntegratorState::new(vec![0.0; 6], vec![1.0, 2.0, 3.0, -1.0, 0.0, 0.5]);
    // No springs, or their force at zero length would be undefined.
    system.springs.clear();
    let (dt, steps) = (0.01, 100.0);
    for _ in 0..100 {
        stepper.advance(&mut system, &mut state, dt).unwrap();
    }
    let time = dt * steps;
    // The sum of the velocities at the ends of the steps falls behind the integral by half a step.
    let fall = 0.5 * system.gravity * time * (time + dt);
    for (found, expected) in [
        (state.positions[0], time),
        (state.positions[1], 2.0 * time - fall),
        (state.positions[4], -fall),
        (state.velocities[1], 2.0 - system.gravity * time),
    ] {
        assert!((found - expected).abs() < 1e-12, "{found} against {expected}");
    }
}

#[test]
fn backward_euler_is_of_first_order_and_bdf2_of_second() {
    for (integrator, order) in [(Integrator::BackwardEuler, 1.0), (Integrator::Bdf2, 2.0)] {
        let errors = [400, 800, 1600]
            .map(|steps| error(&oscillate(integrator, |_| 1.0 / steps as f64, steps)));
        for pair in errors.windows(2) {
            let observed = (pair[0] / pair[1]).log2();
            // Errors of the next order are a few per cent at these steps.
            assert!((observed - order).abs() < 0.06, "{integrator:?}: {observed} from {errors:?}");
        }
    }
}

#[test]
fn bdf2_keeps_its_order_when_the_step_varies() {
    let uneven = |base: f64| {
        move |step: usize| {
            if step.is_multiple_of(3) { base } else { 0.5 * base }
        }
    };
    let errors = [150, 300, 600].map(|rounds| {
        let dt = uneven(0.5 / f64::from(rounds));
        error(&oscillate(Integrator::Bdf2, dt, 3 * rounds as usize))
    });
    for pair in errors.windows(2) {
        let observed = (pair[0] / pair[1]).log2();
        assert!((observed - 2.0).abs() < 0.1, "{observed} from {errors:?}");
    }
}

#[test]
fn backward_euler_damps_by_its_amplification_factor() {
    // The last damps to 2e-6 of the start, still a thousand times what a step may leave unsolved.
    for (dt, steps) in [(0.001, 50), (0.02, 50), (0.5, 8)] {
        let state = oscillate(Integrator::BackwardEuler, |_| dt, steps as usize);
        let amplitude = state.positions[0].hypot(state.velocities[0] / OMEGA);
        let expected = (1.0 + (OMEGA * dt).powi(2)).powf(-0.5 * f64::from(steps));
        let relative = amplitude / expected - 1.0;
        assert!(relative.abs() < 1e-9, "dt = {dt}: {amplitude} against {expected}");
    }
}

#[test]
fn bdf2_damps_a_slow_oscillation_by_the_fourth_power_of_the_step() {
    let dt = 0.01;
    let theta: f64 = OMEGA * dt;
    let amplitude = |steps| {
        let state = oscillate(Integrator::Bdf2, |_| dt, steps);
        state.positions[0].hypot(state.velocities[0] / OMEGA)
    };
    // Whole periods apart, so that the formula's elliptic orbit is met at the same phase.
    let period = (core::f64::consts::TAU / theta).round() as usize;
    let loss = -(amplitude(20 * period) / amplitude(10 * period)).ln() / (10 * period) as f64;
    let expected = theta.powi(4) / 4.0;
    assert!((loss / expected - 1.0).abs() < 0.05, "{loss:e} against {expected:e}");
}

#[test]
fn the_energy_balance_accounts_for_what_the_oscillator_loses() {
    for integrator in [Integrator::BackwardEuler, Integrator::Bdf2] {
        let mut system = Well::new(spring_law);
        let mut stepper = Stepper::new(&system, exact(integrator)).unwrap();
        let mut state = IntegratorState::at_rest(vec![1.0, 0.0, 0.0]);
        let energy = |state: &IntegratorState| {
            0.5 * state.velocities[0].powi(2) + spring_law(state.positions[0])[0]
        };
        let (mut lost, before) = (0.0, energy(&state));
        for _ in 0..100 {
            let report = stepper.advance(&mut system, &mut state, 0.01).unwrap();
            lost += report.energy.unwrap().numerical_dissipation;
        }
        let expected = before - energy(&state);
        assert!((lost - expected).abs() < 1e-12 * before, "{lost} against {expected}");
        assert!(lost > 0.0);
    }
}
