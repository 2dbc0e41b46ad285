//! Systems made to break the solver: a typed error and an untouched state.

use drape_implicit::{
    BlockMatrix, Error, IntegratorState, LinearSolver, Method, Quantity, Settings, Sparsity,
    Stepper, Stiffness, System,
};

use crate::springs::Springs;
use crate::well::Well;

/// A small generator (Lehmer), so that the random systems are the same everywhere.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 * 2.0_f64.powi(-53)
    }

    /// Between 10^-low and 10^high, evenly in the exponent.
    fn scale(&mut self, low: f64, high: f64) -> f64 {
        10_f64.powf(low + (high - low) * self.next())
    }
}

/// Linear forces with a random dense symmetric matrix, plus whatever `spoil` does to them.
struct Linear {
    masses: Vec<f64>,
    held: Vec<bool>,
    /// Upper blocks of all pairs.
    blocks: Vec<(usize, usize, [f64; 9])>,
    load: Vec<f64>,
    spoil: fn(f64, f64) -> f64,
    shown: Stiffness,
    accepted: usize,
}

impl Linear {
    fn random(random: &mut Random, spread: f64) -> Self {
        let particles = 2 + (random.next() * 8.0) as usize;
        let mut blocks = Vec::new();
        for i in 0..particles {
            for j in i..particles {
                let size = random.scale(-spread, spread) * 100.0;
                let mut block = [0.0; 9].map(|_| size * (2.0 * random.next() - 1.0));
                if i == j {
                    for (r, c) in [(0, 1), (0, 2), (1, 2)] {
                        block[3 * c + r] = block[3 * r + c];
                    }
                }
                blocks.push((i, j, block));
            }
        }
        Self {
            masses: (0..particles).map(|_| random.scale(-spread, spread)).collect(),
            held: (0..particles).map(|_| random.next() < 0.1).collect(),
            blocks,
            load: (0..3 * particles).map(|_| random.scale(-spread, spread)).collect(),
            spoil: |force, _| force,
            shown: Stiffness::Exact,
            accepted: 0,
        }
    }

    fn resist(&self, x: &[f64]) -> Vec<f64> {
        let mut y = vec![0.0; x.len()];
        for (i, j, block) in &self.blocks {
            for r in 0..3 {
                for c in 0..3 {
                    y[3 * i + r] += block[3 * r + c] * x[3 * j + c];
                    if i != j {
                        y[3 * j + c] += block[3 * r + c] * x[3 * i + r];
                    }
                }
            }
        }
        y
    }
}

impl System for Linear {
    fn particle_count(&self) -> usize {
        self.masses.len()
    }
    fn masses(&self) -> &[f64] {
        &self.masses
    }
    fn held(&self) -> &[bool] {
        &self.held
    }
    fn begin(&mut self, _: f64, _: f64, _: &[f64], _: &mut [f64]) {}
    fn forces(&mut self, positions: &[f64], forces: &mut [f64]) {
        let resistance = self.resist(positions);
        for (k, force) in forces.iter_mut().enumerate() {
            *force = (self.spoil)(self.load[k] - resistance[k], positions[k]);
        }
    }
    fn potential(&mut self, positions: &[f64]) -> f64 {
        let resistance = self.resist(positions);
        positions.iter().zip(&resistance).zip(&self.load).map(|((x, r), l)| x * (0.5 * r - l)).sum()
    }
    fn stiffness(&mut self, _: &[f64], kind: Stiffness, matrix: &mut BlockMatrix) {
        // The definite approximation: nothing or, for a liar, a matrix that is not definite.
        if kind == Stiffness::Exact || self.shown == Stiffness::Exact {
            for (i, j, block) in &self.blocks {
                matrix.add(*i, *j, block);
            }
        }
    }
    fn sparsity(&self) -> Sparsity {
        let pairs = self.blocks.iter().map(|(i, j, _)| [*i, *j]);
        Sparsity::from_pairs(self.masses.len(), pairs).unwrap()
    }
    fn accept(&mut self, _: &[f64], _: &[f64], _: f64) {
        self.accepted += 1;
    }
}

/// Advances and checks that the state is finite, and on failure that of the last accepted sub-step.
fn survive(system: &mut Linear, settings: &Settings, dt: f64) -> bool {
    let particles = system.particle_count();
    let start = IntegratorState::at_rest((0..3 * particles).map(|k| (k as f64).sin()).collect());
    let mut state = start.clone();
    let mut stepper = Stepper::new(system, settings.clone()).unwrap();
    let outcome = stepper.advance(system, &mut state, dt);
    assert!(state.positions.iter().chain(&state.velocities).all(|x| x.is_finite()));
    match outcome {
        Ok(report) => {
            assert!(report.residual <= settings.tolerance, "{report:?}");
            assert_eq!(report.sub_steps, system.accepted);
            assert_eq!(state.time, dt);
            true
        }
        Err(Error::NotConverged { .. } | Error::NotFinite { .. }) => {
            if system.accepted == 0 {
                assert_eq!(state, start);
            } else {
                assert!(state.time > 0.0 && state.time < dt, "{}", state.time);
            }
            false
        }
        Err(other) => panic!("{other}"),
    }
}

#[test]
fn random_indefinite_and_badly_scaled_systems_are_solved_or_refused() {
    let mut random = Random(7);
    let (mut solved, mut refused) = (0, 0);
    for trial in 0..300 {
        let spread = [0.0, 1.0, 4.0][trial % 3];
        let mut system = Linear::random(&mut random, spread);
        system.shown = [Stiffness::Exact, Stiffness::Definite][trial % 2];
        let method = [Method::Broyden, Method::Newton][trial / 2 % 2];
        let linear_solver =
            [LinearSolver::ConjugateGradient, LinearSolver::Cholesky][trial / 4 % 2];
        let settings = Settings { method, linear_solver, ..Settings::default() };
        let dt = random.scale(-4.0, 0.0);
        match survive(&mut system, &settings, dt) {
            true => solved += 1,
            false => refused += 1,
        }
    }
    // Both outcomes must have occurred for the test to mean anything.
    assert!(solved > 50 && refused > 20, "{solved} solved, {refused} refused");
}

#[test]
fn systems_that_produce_nan_are_refused_with_the_particle_named() {
    let mut random = Random(11);
    let always: fn(f64, f64) -> f64 = |_, _| f64::NAN;
    let away: fn(f64, f64) -> f64 = |force, x| if x.abs() > 1.5 { f64::INFINITY } else { force };
    for (case, spoil) in [always, away].into_iter().cycle().take(40).enumerate() {
        let mut system = Linear { spoil, ..Linear::random(&mut random, 0.0) };
        system.held.fill(false);
        let survived = survive(&mut system, &Settings::default(), 0.1);
        assert!(!survived || case % 2 == 1, "NaN was accepted");
    }
    let mut system = Linear { spoil: always, ..Linear::random(&mut random, 0.0) };
    system.held.fill(false);
    system.held[0] = true;
    let mut state = IntegratorState::at_rest(vec![0.0; 3 * system.particle_count()]);
    let mut stepper = Stepper::new(&system, Settings::default()).unwrap();
    let error = stepper.advance(&mut system, &mut state, 0.1).unwrap_err();
    match error {
        Error::NotFinite { quantity: Quantity::Force, particle: 1, dt, .. } => {
            assert_eq!(dt, 0.1 / 1024.0);
        }
        other => panic!("{other}"),
    }
}

#[test]
fn a_stiffness_that_is_no_number_is_refused_with_its_particle() {
    let mut system = Well::new(|x| [0.5 * x * x, x, f64::NAN]);
    let mut state = IntegratorState::at_rest(vec![1.0, 0.0, 0.0]);
    let mut stepper = Stepper::new(&system, Settings::default()).unwrap();
    let error = stepper.advance(&mut system, &mut state, 0.1).unwrap_err();
    let is_named =
        matches!(error, Error::NotFinite { quantity: Quantity::Stiffness, particle: 0, .. });
    assert!(is_named && state.positions == [1.0, 0.0, 0.0], "{error}");
}

#[test]
fn impossible_input_is_refused_and_named() {
    let system = Springs::chain(2, 1.0, 0.1, 10.0);
    let positions: Vec<f64> = (0..3).flat_map(|i| [f64::from(i) * 0.5, 0.0, 0.0]).collect();
    let good = IntegratorState::at_rest(positions);
    let advance = |system: &mut Springs, state: &mut IntegratorState, dt| {
        Stepper::new(system, Settings::default())?.advance(system, state, dt)
    };
    for dt in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = advance(&mut system.clone(), &mut good.clone(), dt).unwrap_err();
        assert!(matches!(error, Error::StepLength { .. }), "{error}");
    }
    for mass in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let mut system = system.clone();
        system.masses[2] = mass;
        let error = advance(&mut system, &mut good.clone(), 0.1).unwrap_err();
        assert!(matches!(error, Error::Mass { particle: 2, .. }), "{error}");
    }
    let mut short = good.clone();
    short.velocities.pop();
    let error = advance(&mut system.clone(), &mut short, 0.1).unwrap_err();
    assert_eq!(error, Error::Dimension { name: "velocities", expected: 9, found: 8 });

    let mut odd = system.clone();
    odd.held.pop();
    let error = advance(&mut odd, &mut good.clone(), 0.1).unwrap_err();
    assert_eq!(error, Error::Dimension { name: "held", expected: 3, found: 2 });

    let mut broken = good.clone();
    broken.velocities[4] = f64::NAN;
    let error = advance(&mut system.clone(), &mut broken, 0.1).unwrap_err();
    let named = Error::NotFinite { quantity: Quantity::Velocity, particle: 1, time: 0.0, dt: 0.1 };
    assert_eq!(error, named);

    for (settings, expected) in [
        (Settings { tolerance: 0.0, ..Settings::default() }, "tolerance"),
        (Settings { acceleration: f64::NAN, ..Settings::default() }, "acceleration"),
        (Settings { newton_forcing: 1.0, ..Settings::default() }, "newton_forcing"),
        (Settings { max_iterations: 0, ..Settings::default() }, "max_iterations"),
    ] {
        match Stepper::new(&system, settings) {
            Err(Error::Setting { name, .. }) => assert_eq!(name, expected),
            other => panic!("{expected}: {:?}", other.map(|_| ())),
        }
    }
}
