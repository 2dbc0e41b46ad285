//! Explicit steps, and the estimate of a step's error.

use drape_implicit::{
    Error, ErrorEstimate, Explicit, Integrator, IntegratorState, Settings, Stepper,
};

use crate::springs::Springs;
use crate::well::Well;

const OMEGA: f64 = 10.0;

fn spring_law(x: f64) -> [f64; 3] {
    [0.5 * OMEGA * OMEGA * x * x, OMEGA * OMEGA * x, OMEGA * OMEGA]
}

#[test]
fn explicit_steps_are_of_first_order_and_keep_the_energy() {
    let run = |steps: usize| {
        let mut system = Well::new(spring_law);
        let mut explicit = Explicit::new(&system);
        let mut state = IntegratorState::at_rest(vec![1.0, 0.0, 0.0]);
        let (mut lost, mut largest) = (0.0, 0.0_f64);
        for _ in 0..steps {
            let report = explicit.advance(&mut system, &mut state, 1.0 / steps as f64).unwrap();
            lost += report.energy.unwrap().numerical_dissipation;
            largest = largest.max(lost.abs());
        }
        let error = (state.positions[0] - (OMEGA * state.time).cos()).abs();
        (error, largest, lost)
    };
    let [coarse, fine] = [1000, 2000].map(run);
    let order = (coarse.0 / fine.0).log2();
    assert!((order - 1.0).abs() < 0.1, "order {order}: {} and {}", coarse.0, fine.0);
    // The energy swings by half of ω dt of its 50 J and does not drift.
    assert!(coarse.1 < 0.00505 * 50.0, "{}", coarse.1);
    assert!(fine.1 < 0.51 * coarse.1, "{} and {}", fine.1, coarse.1);
}

#[test]
fn a_long_step_is_made_in_as_many_parts_as_stability_asks_for() {
    let mut system = Springs::sheet(6, 5000.0);
    let mut explicit = Explicit::new(&system);
    let mut state = IntegratorState::at_rest(Springs::flat(6));
    let stable = explicit.stable_step(&mut system, &state, 0.01).unwrap();
    let report = explicit.advance(&mut system, &mut state, 0.01).unwrap();
    assert_eq!(report.sub_steps, (0.01 / (0.5 * stable)).ceil() as usize);
    for _ in 0..50 {
        explicit.advance(&mut system, &mut state, 0.01).unwrap();
    }
    let farthest = state.positions.iter().fold(0.0, |far: f64, x| far.max(x.abs()));
    assert!(farthest < 2.0, "it swings within its amplitude: {farthest}");

    // The bound is a bound, and not a loose one: at three times its length the sheet flies apart.
    let mut explicit = Explicit::new(&system).with_fraction(3.0).expect("positive");
    let mut state = IntegratorState::at_rest(Springs::flat(6));
    let blown_up = (0..100).find_map(|_| explicit.advance(&mut system, &mut state, 0.01).err());
    let far = state.positions.iter().any(|x| x.abs() > 1e3);
    assert!(far || matches!(blown_up, Some(Error::NotFinite { .. })), "{blown_up:?}");
}

#[test]
fn the_estimate_is_the_error_of_one_step() {
    for (integrator, tolerance) in [(Integrator::BackwardEuler, 0.05), (Integrator::Bdf2, 0.05)] {
        for ratio in [0.5, 1.0, 2.0] {
            let mut system = Well::new(spring_law);
            let settings = Settings { integrator, tolerance: 1e-12, ..Settings::default() };
            let mut stepper = Stepper::new(&system, settings).unwrap();
            // Two steps of the exact motion, then one of the formula.
            let (before, dt) = (0.001, 0.001 * ratio);
            let exact = |t: f64| {
                (vec![(OMEGA * t).cos(), 0.0, 0.0], vec![-OMEGA * (OMEGA * t).sin(), 0.0, 0.0])
            };
            let start = 0.06;
            let (positions, velocities) = exact(start);
            let mut state = IntegratorState::new(positions, velocities);
            let (positions, velocities) = exact(start - before);
            state.previous =
                Some(drape_implicit::PreviousState { dt: before, positions, velocities });
            let mut estimate = ErrorEstimate::new(1);
            estimate.predict(&state, integrator, dt).expect("the same particles");
            stepper.advance(&mut system, &mut state, dt).unwrap();
            let error = (state.positions[0] - exact(start + dt).0[0]).abs();
            let found = estimate.estimate(&state);
            let miss = (found / error - 1.0).abs();
            assert!(miss < tolerance, "{integrator:?}, ratio {ratio}: {found:e} for {error:e}");
        }
    }
}

#[test]
fn the_work_of_a_drawn_end_is_the_energy_of_its_spring_and_mass() {
    let mut system = Springs::chain(1, 1.0, 0.1, 40.0);
    (system.gravity, system.drawn, system.held[0]) = (0.0, 0.5, true);
    let mut explicit = Explicit::new(&system);
    let mut state = IntegratorState::new(
        vec![0.0, 0.0, 0.0, -1.0, 0.0, 0.0],
        vec![0.5, 0.0, 0.0, 0.0, 0.0, 0.0],
    );
    let [mut work, mut kept, mut lost] = [0.0; 3];
    let dt = 1e-5;
    for _ in 0..10_000 {
        let energy = explicit.advance(&mut system, &mut state, dt).unwrap().energy.unwrap();
        work += energy.work;
        kept += energy.kinetic + energy.potential;
        lost += energy.numerical_dissipation;
    }
    // The spring is stretched by v sin(ω t)/ω, and the power of its drawn end is k v times that.
    let (omega, speed, mass) = (20.0_f64, 0.5, 0.1);
    let exact = mass * speed * speed * (1.0 - (omega * state.time).cos());
    assert!((work / exact - 1.0).abs() < 1e-3, "{work} J for {exact}");
    assert!((work - kept - lost).abs() < 1e-9 * work && lost.abs() < 1e-2 * work, "{kept} {lost}");
}
