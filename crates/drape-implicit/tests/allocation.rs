//! In steady state a step allocates nothing.

#![allow(clippy::unwrap_used)]

// Its other test file uses the rest.
#[expect(dead_code)]
#[path = "physics/springs.rs"]
mod springs;

use drape_implicit::{IntegratorState, LinearSolver, Method, Settings, Stepper};
use springs::Springs;

#[test]
fn after_the_first_step_none_allocates() {
    let n = 12;
    for (method, linear_solver) in [
        (Method::Broyden, LinearSolver::ConjugateGradient),
        (Method::Newton, LinearSolver::ConjugateGradient),
        (Method::Broyden, LinearSolver::Cholesky),
    ] {
        let mut system = Springs::sheet(n, 5000.0);
        // The system's own record must not grow either.
        system.accepted.reserve(100);
        let settings =
            Settings { method, linear_solver, energy_balance: true, ..Settings::default() };
        let mut stepper = Stepper::new(&system, settings).unwrap();
        let mut state = IntegratorState::at_rest(Springs::flat(n));
        stepper.advance(&mut system, &mut state, 5e-3).unwrap();
        let info = allocation_counter::measure(|| {
            for _ in 0..50 {
                stepper.advance(&mut system, &mut state, 5e-3).unwrap();
            }
        });
        assert_eq!(
            info.count_total, 0,
            "{method:?}, {linear_solver:?}: {} bytes",
            info.bytes_total
        );
    }
}
