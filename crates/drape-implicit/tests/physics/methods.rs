//! The solvers against each other, and against systems that defeat each of them.

use drape_implicit::{
    Error, InitialMatrix, Integrator, IntegratorState, LinearSolver, Method, Report, Settings,
    Stepper, Stop, System,
};

use crate::springs::Springs;
use crate::well::Well;

fn swing(
    n: usize,
    stiffness: f64,
    settings: &Settings,
    dt: f64,
    steps: usize,
) -> (IntegratorState, Vec<Report>) {
    let mut system = Springs::sheet(n, stiffness);
    let mut state = IntegratorState::at_rest(Springs::flat(n));
    let mut stepper = Stepper::new(&system, settings.clone()).unwrap();
    let advance = |_| stepper.advance(&mut system, &mut state, dt).unwrap();
    let reports = (0..steps).map(advance).collect();
    (state, reports)
}

fn distance(a: &IntegratorState, b: &IntegratorState) -> f64 {
    let largest = |m: f64, (a, b): (&f64, &f64)| m.max((a - b).abs());
    a.positions.iter().zip(&b.positions).fold(0.0, largest)
}

#[test]
fn every_method_and_linear_solver_finds_the_same_motion() {
    let tight = Settings { tolerance: 1e-9, ..Settings::default() };
    let (reference, _) =
        swing(8, 500.0, &Settings { method: Method::Newton, ..tight.clone() }, 2e-3, 30);
    for method in [Method::Broyden, Method::Newton] {
        for linear_solver in [LinearSolver::ConjugateGradient, LinearSolver::Cholesky] {
            let settings = Settings { method, linear_solver, ..tight.clone() };
            let (state, reports) = swing(8, 500.0, &settings, 2e-3, 30);
            let apart = distance(&state, &reference);
            // 30 steps with an acceleration error of 1e-8 m/s² each move particles by 1e-11 m,
            // times a growth of errors that a stiff net is far from.
            assert!(apart < 1e-9, "{method:?}, {linear_solver:?}: {apart:e} m apart");
            let inner: usize = reports.iter().map(|report| report.linear_iterations).sum();
            assert_eq!(inner == 0, linear_solver == LinearSolver::Cholesky);
        }
    }
}

#[test]
fn textbook_broyden_solves_a_mild_system_like_newton() {
    let tight = Settings { tolerance: 1e-8, max_halvings: 0, ..Settings::default() };
    let newton = Settings { method: Method::Newton, ..tight.clone() };
    let (reference, _) = swing(6, 1.0, &newton, 2e-3, 20);
    for initial in [InitialMatrix::Mass, InitialMatrix::Diagonal] {
        let settings = Settings { method: Method::Textbook { initial }, ..tight.clone() };
        let (state, reports) = swing(6, 1.0, &settings, 2e-3, 20);
        let apart = distance(&state, &reference);
        assert!(apart < 1e-8, "{initial:?}: {apart:e} m apart");
        assert!(reports.iter().all(|report| report.linear_solves == 0));
    }
}

#[test]
fn textbook_broyden_does_not_converge_on_a_stiff_system_that_the_default_solves() {
    let n = 8;
    for initial in [InitialMatrix::Mass, InitialMatrix::Diagonal] {
        let settings = Settings {
            method: Method::Textbook { initial },
            max_halvings: 0,
            ..Settings::default()
        };
        let mut system = Springs::sheet(n, 1e5);
        let start = IntegratorState::at_rest(Springs::flat(n));
        let mut state = start.clone();
        let mut stepper = Stepper::new(&system, settings.clone()).unwrap();
        let mut outcome = Ok(Report::default());
        for _ in 0..20 {
            outcome = stepper.advance(&mut system, &mut state, 5e-3);
            if outcome.is_err() {
                break;
            }
        }
        match outcome {
            Err(Error::NotConverged { residual, tolerance, .. }) => assert!(residual > tolerance),
            other => panic!("{initial:?}: {other:?}"),
        }
    }
    let settings = Settings { max_halvings: 0, ..Settings::default() };
    swing(n, 1e5, &settings, 5e-3, 20);
}

#[test]
fn broyden_needs_fewer_matrices_than_newton() {
    let count = |method| {
        let (_, reports) = swing(
            12,
            2000.0,
            &Settings { method, tolerance: 1e-8, ..Settings::default() },
            2e-3,
            40,
        );
        reports.iter().map(|report| report.stiffness_assemblies).sum::<usize>()
    };
    let (broyden, newton) = (count(Method::Broyden), count(Method::Newton));
    assert!(broyden < newton, "{broyden} against {newton}");
}

/// Force −F tanh(x/δ): with weak inertia, undamped Newton overshoots further at each iteration.
fn saturating(x: f64) -> [f64; 3] {
    let (force, width) = (100.0, 1e-3);
    let t = (x / width).tanh();
    [force * width * (x / width).cosh().ln(), force * t, force / width * (1.0 - t * t)]
}

#[test]
fn the_line_search_converges_where_undamped_newton_runs_away() {
    let (dt, start) = (0.1, 5e-3);
    let residual = |x: f64| (x - start) / (dt * dt) + saturating(x)[1];
    let mut x: f64 = start;
    for _ in 0..60 {
        x -= residual(x) / (1.0 / (dt * dt) + saturating(x)[2]);
    }
    assert!(residual(x).abs() > 1.0, "undamped Newton converged to {x}");

    for method in [Method::Newton, Method::Broyden] {
        let settings = Settings { method, max_halvings: 0, ..Settings::default() };
        let mut system = Well::new(saturating);
        let mut stepper = Stepper::new(&system, settings).unwrap();
        let mut state = IntegratorState::at_rest(vec![start, 0.0, 0.0]);
        let report = stepper.advance(&mut system, &mut state, dt).unwrap();
        assert!(report.backtracks > 0, "{report:?}");
        let left = residual(state.positions[0]).abs();
        assert!(left <= 1e-4 * 9.81, "{left}");
    }
}

/// A wall at x = 0: −κ ln x, undefined behind it.
fn wall(x: f64) -> [f64; 3] {
    let k = 1e-3;
    if x > 0.0 { [-k * x.ln(), -k / x, k / (x * x)] } else { [f64::INFINITY, f64::NAN, f64::NAN] }
}

#[test]
fn a_particle_thrown_at_a_wall_stops_in_front_of_it() {
    let settings =
        Settings { max_halvings: 0, integrator: Integrator::BackwardEuler, ..Settings::default() };
    let mut system = Well::new(wall);
    let mut stepper = Stepper::new(&system, settings).unwrap();
    // Free flight would carry it 9 m behind the wall within the step.
    let mut state = IntegratorState::new(vec![1.0, 0.0, 0.0], vec![-100.0, 0.0, 0.0]);
    let report = stepper.advance(&mut system, &mut state, 0.1).unwrap();
    let x = state.positions[0];
    let residual = (x + 9.0) / 0.01 + wall(x)[1];
    assert!(x > 0.0 && residual.abs() < 1e-3, "x = {x}, residual {residual}, {report:?}");
    assert!(report.backtracks > 0);
}

/// Two wells with a hill between them: the exact stiffness is negative on the hill.
fn double_well(x: f64) -> [f64; 3] {
    let k = 1e4;
    [k * (x * x - 1.0).powi(2), 4.0 * k * x * (x * x - 1.0), 4.0 * k * (3.0 * x * x - 1.0)]
}

#[test]
fn on_a_hill_the_definite_stiffness_takes_over() {
    for linear_solver in [LinearSolver::ConjugateGradient, LinearSolver::Cholesky] {
        let settings = Settings { linear_solver, max_halvings: 0, ..Settings::default() };
        let mut system = Well::new(double_well);
        let mut stepper = Stepper::new(&system, settings).unwrap();
        let mut state = IntegratorState::at_rest(vec![0.1, 0.0, 0.0]);
        let report = stepper.advance(&mut system, &mut state, 0.1).unwrap();
        assert!(report.negative_curvatures > 0, "{report:?}");
        let x = state.positions[0];
        assert!((x - 1.0).abs() < 0.01, "{linear_solver:?}: came to {x}");
    }
}

#[test]
fn a_stiffness_that_claims_to_be_definite_and_is_not_stops_the_step() {
    fn hilltop(x: f64) -> [f64; 3] {
        [-50.0 * x * x, -100.0 * x, -100.0]
    }
    struct Liar(Well);
    impl System for Liar {
        fn particle_count(&self) -> usize {
            1
        }
        fn masses(&self) -> &[f64] {
            &[1.0]
        }
        fn held(&self) -> &[bool] {
            &[false]
        }
        fn begin(&mut self, end: f64, dt: f64, start: &[f64], target: &mut [f64]) {
            self.0.begin(end, dt, start, target);
        }
        fn forces(&mut self, positions: &[f64], forces: &mut [f64]) {
            self.0.forces(positions, forces);
        }
        fn potential(&mut self, positions: &[f64]) -> f64 {
            self.0.potential(positions)
        }
        fn stiffness(
            &mut self,
            positions: &[f64],
            _: drape_implicit::Stiffness,
            matrix: &mut drape_implicit::BlockMatrix,
        ) {
            self.0.stiffness(positions, drape_implicit::Stiffness::Exact, matrix);
        }
        fn sparsity(&self) -> drape_implicit::Sparsity {
            self.0.sparsity()
        }
        fn accept(&mut self, _: &[f64], _: &[f64], _: f64) {}
    }
    let mut system = Liar(Well::new(hilltop));
    let settings = Settings { max_halvings: 0, ..Settings::default() };
    let mut stepper = Stepper::new(&system, settings).unwrap();
    let mut state = IntegratorState::at_rest(vec![0.1, 0.0, 0.0]);
    match stepper.advance(&mut system, &mut state, 1.0) {
        Err(Error::NotConverged { stop: Stop::Indefinite, .. }) => {}
        other => panic!("{other:?}"),
    }
    // At a hundredth of the step inertia outweighs the hill.
    stepper.advance(&mut system, &mut state, 0.01).unwrap();
}

/// A stiff sheet that falls from rest in every step: its iterations, and how much energy its steps
/// leave to be gained at the most, over their kinetic energy.
fn relax(settings: &Settings) -> (usize, f64) {
    let n = 16;
    let dt = 0.015;
    let mut system = Springs::sheet(n, 5000.0);
    let mut stepper = Stepper::new(&system, settings.clone()).unwrap();
    let exact = Settings { tolerance: 1e-8, energy_tolerance: 0.0, ..settings.clone() };
    let mut exact = Stepper::new(&system, exact).unwrap();
    let mut start = IntegratorState::at_rest(Springs::flat(n));
    let (mut iterations, mut left) = (0, 0.0_f64);
    for _ in 0..40 {
        let mut state = start.clone();
        let report = stepper.advance(&mut system, &mut state, dt).unwrap();
        assert!(report.energy_left <= settings.energy_tolerance, "{report:?}");
        iterations += report.iterations;
        let mut best = start.clone();
        exact.advance(&mut system, &mut best, dt).unwrap();
        let kinetic = |end: &IntegratorState| {
            let moves = end.positions.chunks_exact(3).zip(start.positions.chunks_exact(3));
            let square = |(a, b): (&[f64], &[f64])| -> f64 {
                a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum()
            };
            let energies = moves.zip(&system.masses).map(|(ends, m)| 0.5 * m * square(ends));
            energies.sum::<f64>() / (dt * dt)
        };
        let [moves, best_moves] = [kinetic(&state), kinetic(&best)];
        let [stores, best_stores] = [&state, &best].map(|end| system.potential(&end.positions));
        left = left.max((moves + stores - best_moves - best_stores) / moves);
        start = IntegratorState::at_rest(state.positions);
    }
    (iterations, left)
}

#[test]
fn a_step_may_end_when_little_energy_is_left_to_gain() {
    let settings = Settings {
        integrator: Integrator::BackwardEuler,
        method: Method::Newton,
        tolerance: 1e-3,
        ..Settings::default()
    };
    let (solved, _) = relax(&settings);
    for fraction in [1e-3, 1e-2] {
        let (iterations, left) =
            relax(&Settings { energy_tolerance: fraction, ..settings.clone() });
        println!("{fraction:e}: {iterations} of {solved} iterations, {left:e} left");
        assert!(iterations < solved, "{iterations} of {solved} iterations");
        assert!(left <= fraction, "{left:e} of the kinetic energy is left at {fraction:e}");
    }
    // The decrease that a direction predicts means nothing if it is not solved for.
    let truncated = Settings { max_linear_iterations: 1, max_iterations: 1000, ..settings };
    let patient = Settings { energy_tolerance: 0.5, ..truncated.clone() };
    assert_eq!(relax(&patient).0, relax(&truncated).0);
}

/// Soft on both sides of a stiff middle. From −1 m Newton's method leads to 3 m, where the force is
/// smaller and the energy larger, and from there back again.
fn gully(x: f64) -> [f64; 3] {
    let left = |x: f64| [0.125 * (x + 1.0).powi(2) - (x + 1.0), 0.25 * (x + 1.0) - 1.0, 0.25];
    let middle = |x: f64| {
        let (d, start) = (x + 0.6, left(-0.6));
        [start[0] + start[1] * d + 0.5 * 5.175 * d * d, start[1] + 5.175 * d, 5.175]
    };
    let right = |x: f64| {
        let (d, start) = (x + 0.4, middle(-0.4));
        [start[0] + start[1] * d + 0.5 * 0.225 * d * d, start[1] + 0.225 * d, 0.225]
    };
    if x <= -0.6 {
        left(x)
    } else if x <= -0.4 {
        middle(x)
    } else {
        right(x)
    }
}

#[test]
fn steps_that_gain_residual_and_energy_in_turn_do_not_undo_each_other() {
    assert!(gully(3.0)[1].abs() < gully(-1.0)[1].abs() && gully(3.0)[0] > gully(-1.0)[0]);
    let settings = Settings { method: Method::Newton, max_halvings: 0, ..Settings::default() };
    let mut system = Well::new(gully);
    let mut stepper = Stepper::new(&system, settings).unwrap();
    let mut state = IntegratorState::at_rest(vec![-1.0, 0.0, 0.0]);
    // So long that inertia counts for nothing.
    let report = stepper.advance(&mut system, &mut state, 1e4).unwrap();
    assert!(report.iterations < 10, "{} iterations", report.iterations);
    let bottom = 0.9 / 5.175 - 0.6;
    assert!((state.positions[0] - bottom).abs() < 1e-6, "{}", state.positions[0]);
}
