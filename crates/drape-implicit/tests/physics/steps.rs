//! Sub-steps, held particles, and the state between steps.

use drape_implicit::{
    BlockMatrix, Integrator, IntegratorState, Method, Settings, Sparsity, Stepper, Stiffness,
    System, check_system,
};

use crate::springs::Springs;
use crate::well::Well;

fn spring_law(x: f64) -> [f64; 3] {
    [50.0 * x * x, 100.0 * x, 100.0]
}

#[test]
fn a_step_that_fails_is_made_in_halves_and_ends_on_time() {
    for integrator in [Integrator::BackwardEuler, Integrator::Bdf2] {
        let settings = Settings { integrator, ..Settings::default() };
        let mut system = Well { longest_step: 0.003, ..Well::new(spring_law) };
        let mut stepper = Stepper::new(&system, settings.clone()).unwrap();
        let mut halved = IntegratorState::at_rest(vec![1.0, 0.0, 0.0]);
        let report = stepper.advance(&mut system, &mut halved, 0.01).unwrap();
        assert_eq!(system.accepted, [0.0025; 4]);
        assert_eq!(report.sub_steps, 4);
        assert_eq!(halved.time, 0.01);

        let mut plain = Well::new(spring_law);
        let mut quarters = IntegratorState::at_rest(vec![1.0, 0.0, 0.0]);
        for _ in 0..4 {
            stepper.advance(&mut plain, &mut quarters, 0.0025).unwrap();
        }
        assert_eq!(halved.positions, quarters.positions, "{integrator:?}");
        assert_eq!(halved.velocities, quarters.velocities, "{integrator:?}");
    }
}

#[test]
fn a_longer_second_order_step_is_built_up_to_by_doubling() {
    let mut system = Well::new(spring_law);
    let mut stepper = Stepper::new(&system, Settings::default()).unwrap();
    let mut state = IntegratorState::at_rest(vec![1.0, 0.0, 0.0]);
    stepper.advance(&mut system, &mut state, 0.001).unwrap();
    stepper.advance(&mut system, &mut state, 0.008).unwrap();
    assert_eq!(system.accepted, [0.001, 0.002, 0.002, 0.004]);
    assert!((state.time - 0.009).abs() < 1e-17, "{}", state.time);
    // After a restart there is nothing to build up from.
    state.restart();
    stepper.advance(&mut system, &mut state, 0.032).unwrap();
    assert_eq!(system.accepted.last(), Some(&0.032));
}

#[test]
fn repeated_runs_and_fresh_steppers_give_the_same_bits() {
    let n = 10;
    let run = |fresh: bool| {
        let mut system = Springs::sheet(n, 5000.0);
        let mut state = IntegratorState::at_rest(Springs::flat(n));
        let mut stepper = Stepper::new(&system, Settings::default()).unwrap();
        for _ in 0..40 {
            if fresh {
                stepper = Stepper::new(&system, Settings::default()).unwrap();
            }
            stepper.advance(&mut system, &mut state, 5e-3).unwrap();
        }
        state
    };
    let bits = |state: &IntegratorState| -> Vec<u64> {
        state.positions.iter().chain(&state.velocities).map(|x| x.to_bits()).collect()
    };
    let first = bits(&run(false));
    assert!(first == bits(&run(false)), "two runs differ");
    assert!(first == bits(&run(true)), "a stepper remembers");
}

/// A weight on a spring whose upper end is carried upwards at constant speed.
struct Lift {
    springs: Springs,
    speed: f64,
}

impl System for Lift {
    fn particle_count(&self) -> usize {
        self.springs.particle_count()
    }
    fn masses(&self) -> &[f64] {
        self.springs.masses()
    }
    fn held(&self) -> &[bool] {
        self.springs.held()
    }
    fn begin(&mut self, end_time: f64, _: f64, _: &[f64], target: &mut [f64]) {
        target[1] = self.speed * end_time;
        // The target of a free particle must not matter.
        target[3] = f64::NAN;
    }
    fn forces(&mut self, positions: &[f64], forces: &mut [f64]) {
        self.springs.forces(positions, forces);
    }
    fn potential(&mut self, positions: &[f64]) -> f64 {
        self.springs.potential(positions)
    }
    fn stiffness(&mut self, positions: &[f64], kind: Stiffness, matrix: &mut BlockMatrix) {
        self.springs.stiffness(positions, kind, matrix);
    }
    fn sparsity(&self) -> Sparsity {
        self.springs.sparsity()
    }
    fn accept(&mut self, positions: &[f64], velocities: &[f64], dt: f64) {
        self.springs.accept(positions, velocities, dt);
    }
}

#[test]
fn work_on_a_held_particle_lifts_the_weight_and_nothing_is_unaccounted() {
    let (mass, speed) = (0.5, 0.2);
    let mut springs = Springs::chain(1, 1.0, mass, 200.0);
    springs.held[0] = true;
    let mut system = Lift { springs, speed };
    let settings = Settings { tolerance: 1e-10, energy_balance: true, ..Settings::default() };
    let mut stepper = Stepper::new(&system, settings).unwrap();
    let hanging = -1.0 - mass * 9.81 / 200.0;
    let moving = vec![0.0, speed, 0.0, 0.0, speed, 0.0];
    let mut state = IntegratorState::new(vec![0.0, 0.0, 0.0, 0.0, hanging, 0.0], moving);
    let (mut work, mut lost) = (0.0, 0.0);
    for step in 0..100 {
        state.time = f64::from(step) * 0.01;
        let energy = stepper.advance(&mut system, &mut state, 0.01).unwrap().energy.unwrap();
        work += energy.work;
        lost += energy.numerical_dissipation;
    }
    // Both weights rise by 0.2 m at constant speed.
    let expected = 2.0 * mass * 9.81 * 0.2;
    assert!((state.positions[1] - 0.2).abs() < 1e-15);
    assert!((state.positions[4] - hanging - 0.2).abs() < 1e-9, "{}", state.positions[4]);
    assert!((work - expected).abs() < 1e-8, "{work} J against {expected} J");
    assert!(lost.abs() < 1e-8, "{lost} J lost");
}

#[test]
fn systems_of_no_free_particles_are_advanced_without_complaint() {
    let mut empty = Springs::chain(1, 1.0, 1.0, 1.0);
    empty.masses.clear();
    empty.held.clear();
    empty.springs.clear();
    for linear_solver in
        [drape_implicit::LinearSolver::ConjugateGradient, drape_implicit::LinearSolver::Cholesky]
    {
        let settings = Settings { linear_solver, ..Settings::default() };
        let mut state = IntegratorState::at_rest(vec![]);
        let mut stepper = Stepper::new(&empty, settings.clone()).unwrap();
        stepper.advance(&mut empty, &mut state, 0.1).unwrap();
        assert_eq!(state.time, 0.1);

        let mut held = Springs::chain(1, 1.0, 1.0, 1.0);
        held.held.fill(true);
        let mut state = IntegratorState::at_rest(vec![0.0, 0.0, 0.0, 2.0, 0.0, 0.0]);
        let mut stepper = Stepper::new(&held, settings).unwrap();
        let report = stepper.advance(&mut held, &mut state, 0.1).unwrap();
        assert_eq!(state.positions, [0.0, 0.0, 0.0, 2.0, 0.0, 0.0]);
        assert_eq!(report.iterations, 0);
    }
}

/// A net that grows a spring: the sparsity changes while the stepper lives.
#[test]
fn a_new_sparsity_is_taken_up_when_its_version_changes() {
    struct Growing(Springs, u64);
    impl System for Growing {
        fn particle_count(&self) -> usize {
            self.0.particle_count()
        }
        fn masses(&self) -> &[f64] {
            self.0.masses()
        }
        fn held(&self) -> &[bool] {
            self.0.held()
        }
        fn begin(&mut self, _: f64, _: f64, _: &[f64], _: &mut [f64]) {}
        fn forces(&mut self, positions: &[f64], forces: &mut [f64]) {
            self.0.forces(positions, forces);
        }
        fn potential(&mut self, positions: &[f64]) -> f64 {
            self.0.potential(positions)
        }
        fn stiffness(&mut self, positions: &[f64], kind: Stiffness, matrix: &mut BlockMatrix) {
            self.0.stiffness(positions, kind, matrix);
        }
        fn sparsity(&self) -> Sparsity {
            self.0.sparsity()
        }
        fn sparsity_version(&self) -> u64 {
            self.1
        }
        fn accept(&mut self, _: &[f64], _: &[f64], _: f64) {}
    }
    let mut system = Growing(Springs::chain(3, 1.0, 0.1, 100.0), 0);
    let settings = Settings { method: Method::Newton, ..Settings::default() };
    let mut stepper = Stepper::new(&system, settings).unwrap();
    let start: Vec<f64> = (0..4).flat_map(|i| [f64::from(i) / 2.0, 0.0, 0.0]).collect();
    let mut state = IntegratorState::at_rest(start);
    let new = crate::springs::Spring { ends: [0, 3], stiffness: 50.0, length: 0.5 };
    system.0.springs.push(new);
    let error = stepper.advance(&mut system, &mut state, 0.01).unwrap_err();
    assert_eq!(error, drape_implicit::Error::OutsideSparsity { row: 0, column: 3 });
    assert_eq!(state.time, 0.0);
    system.1 = 1;
    stepper.advance(&mut system, &mut state, 0.01).unwrap();
}

#[test]
fn the_checker_passes_springs_and_finds_a_wrong_factor() {
    let n = 5;
    let mut system = Springs::sheet(n, 700.0);
    let start = Springs::flat(n);
    let trial: Vec<f64> =
        start.iter().enumerate().map(|(k, x)| x + 0.05 * (k as f64 * 2.3).sin()).collect();
    let check = check_system(&mut system, &start, &trial, 1e-3).unwrap();
    assert!(check.force_error < 1e-9, "{check:?}");
    assert!(check.stiffness_error < 1e-8, "{check:?}");
    assert!(check.definite_shift < 1e-12, "{check:?}");

    struct Wrong(Well, f64, f64);
    impl System for Wrong {
        fn particle_count(&self) -> usize {
            1
        }
        fn masses(&self) -> &[f64] {
            &[1.0]
        }
        fn held(&self) -> &[bool] {
            &[false]
        }
        fn begin(&mut self, _: f64, _: f64, _: &[f64], _: &mut [f64]) {}
        fn forces(&mut self, positions: &[f64], forces: &mut [f64]) {
            self.0.forces(positions, forces);
            forces[0] *= self.1;
        }
        fn potential(&mut self, positions: &[f64]) -> f64 {
            self.0.potential(positions)
        }
        fn stiffness(&mut self, _: &[f64], _: Stiffness, matrix: &mut BlockMatrix) {
            matrix.values_mut()[0] = self.2;
        }
        fn sparsity(&self) -> Sparsity {
            self.0.sparsity()
        }
        fn accept(&mut self, _: &[f64], _: &[f64], _: f64) {}
    }
    let at = [0.3, 0.0, 0.0];
    for (force, stiffness) in [(1.01, 101.0), (1.0, -100.0)] {
        let mut wrong = Wrong(Well::new(spring_law), force, stiffness);
        let check = check_system(&mut wrong, &at, &at, 1e-3).unwrap();
        if force == 1.0 {
            assert!(check.force_error < 1e-9 && check.stiffness_error > 1.0, "{check:?}");
            assert!(check.definite_shift.is_infinite(), "{check:?}");
        } else {
            assert!((check.force_error - 0.01 / 1.01).abs() < 1e-6, "{check:?}");
            assert!(check.stiffness_error < 1e-8, "{check:?}");
        }
    }
}
