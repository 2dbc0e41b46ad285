//! A ball that falls on a floor without thickness. A step filter keeps the ball above the floor in
//! every iteration.
//!
//! The floor pushes by the barrier of incremental potential contact (Li et al. 2020), up to a
//! height of a millimetre. In a step of 10 ms the ball falls 60 mm. Without a filter it would pass
//! the floor.

use drape_implicit::{
    AllowedStep, BlockMatrix, Error, Integrator, IntegratorState, Settings, Sparsity, StepFilter,
    Stepper, Stiffness, System, TrialStep,
};

/// Mass, in kg, and weight, in N.
const MASS: f64 = 0.5;
const WEIGHT: f64 = MASS * 9.81;
/// Activation distance of the floor, in m.
const ACTIVATION_DISTANCE: f64 = 1e-3;
/// Stiffness of the barrier, in N/m.
const STIFFNESS: f64 = 1e5;

struct Ball;

/// Barrier `-k (d - d̂)² ln(d/d̂)` at a height above the floor, with its first two derivatives.
fn barrier(height: f64) -> [f64; 3] {
    if height >= ACTIVATION_DISTANCE {
        return [0.0; 3];
    }
    let depth = height - ACTIVATION_DISTANCE;
    // Below the floor the barrier is NaN, and the solver never accepts such a position.
    let logarithm = (height / ACTIVATION_DISTANCE).ln();
    let ratio = depth / height;
    [
        -STIFFNESS * depth * depth * logarithm,
        -STIFFNESS * depth * (2.0 * logarithm + ratio),
        -STIFFNESS * (2.0 * logarithm + 4.0 * ratio - ratio * ratio),
    ]
}

impl System for Ball {
    fn particle_count(&self) -> usize {
        1
    }

    fn masses(&self) -> &[f64] {
        &[MASS]
    }

    fn held(&self) -> &[bool] {
        &[false]
    }

    fn begin(&mut self, _end_time: f64, _dt: f64, _start: &[f64], _target: &mut [f64]) {}

    fn forces(&mut self, x: &[f64], forces: &mut [f64]) {
        forces.copy_from_slice(&[0.0, -WEIGHT - barrier(x[1])[1], 0.0]);
    }

    fn potential(&mut self, x: &[f64]) -> f64 {
        WEIGHT * x[1] + barrier(x[1])[0]
    }

    fn stiffness(&mut self, x: &[f64], _kind: Stiffness, matrix: &mut BlockMatrix) {
        // The stiffness is positive at every height, so the exact one is definite.
        matrix.add(0, 0, &[0.0, 0.0, 0.0, 0.0, barrier(x[1])[2], 0.0, 0.0, 0.0, 0.0]);
    }

    fn sparsity(&self) -> Sparsity {
        Sparsity::from_pairs(1, []).expect("no pairs, no mistake")
    }

    fn accept(&mut self, _positions: &[f64], _velocities: &[f64], _dt: f64) {}
}

impl StepFilter for Ball {
    fn limit_step(&mut self, step: TrialStep<'_>) -> AllowedStep {
        // A step leaves at least a tenth of the height, so that no step ends on the floor.
        let (fall, room) = (-step.displacements[1], 0.9 * step.start[1]);
        if fall <= room {
            return AllowedStep::Whole;
        }
        let fraction = room / fall;
        step.displacements.iter_mut().for_each(|d| *d *= fraction);
        AllowedStep::Shortened { obstacle_advance: fraction * step.obstacle_advance }
    }

    fn set_obstacle_time(&mut self, _time: f64) {
        // The floor does not move.
    }

    fn is_intersection_free(&mut self, positions: &[f64]) -> bool {
        positions[1] > 0.0
    }
}

#[expect(clippy::print_stdout, reason = "an example shows its result")]
fn main() -> Result<(), Error> {
    let settings = Settings { integrator: Integrator::BackwardEuler, ..Settings::default() };
    let mut stepper = Stepper::new(&Ball, settings)?;
    let mut state = IntegratorState::at_rest(vec![0.0, 2.0, 0.0]);
    let mut fastest: f64 = 0.0;
    for _ in 0..300 {
        stepper.advance_filtered(&mut Ball, &mut state, 0.01)?;
        fastest = fastest.max(-state.velocities[1]);
        assert!(state.positions[1] > 0.0, "the ball is below the floor");
    }
    let height = state.positions[1];
    println!(
        "the ball hit the floor at {fastest:.2} m/s and rests {:.4} mm above it",
        1e3 * height
    );
    assert!((barrier(height)[1] + WEIGHT).abs() < 1e-3 * WEIGHT, "the floor carries its weight");
    Ok(())
}
