//! Balance of the energy: it closes with the right forces, and opens with planted wrong ones.

use drape_implicit::{
    BlockMatrix, Explicit, Integrator, IntegratorState, Report, Settings, Sparsity, StepEnergy,
    Stepper, Stiffness, System,
};

/// Mistake in the forces.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Mistake {
    None,
    /// The hardening part pulls the wrong way.
    Sign,
    /// The tangent times the displacement stands for the force.
    Tangent,
    /// A push that no potential knows of.
    Unbooked,
}

/// A particle of 1 kg on a spring that hardens: `V = 50 x² + 250 x⁴`.
struct Hardening(Mistake);

impl Hardening {
    fn law(&self, x: f64) -> [f64; 2] {
        let cube = 1000.0 * x * x * x;
        match self.0 {
            Mistake::None => [100.0 * x + cube, 100.0 + 3.0 * 1000.0 * x * x],
            Mistake::Sign => [100.0 * x - cube, 100.0 - 3.0 * 1000.0 * x * x],
            Mistake::Tangent => [100.0 * x + 3.0 * cube, 100.0 + 9.0 * 1000.0 * x * x],
            Mistake::Unbooked => [100.0 * x + cube + 0.1, 100.0 + 3.0 * 1000.0 * x * x],
        }
    }
}

impl System for Hardening {
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
        forces.copy_from_slice(&[-self.law(positions[0])[0], 0.0, 0.0]);
    }

    fn potential(&mut self, positions: &[f64]) -> f64 {
        50.0 * positions[0].powi(2) + 250.0 * positions[0].powi(4)
    }

    fn stiffness(&mut self, positions: &[f64], _: Stiffness, matrix: &mut BlockMatrix) {
        matrix.values_mut()[0] = self.law(positions[0])[1];
    }

    fn sparsity(&self) -> Sparsity {
        Sparsity::from_pairs(1, []).unwrap()
    }

    fn accept(&mut self, _: &[f64], _: &[f64], _: f64) {}
}

/// Balance of a quarter of a second, and the energy that was exchanged in it.
fn swing(mistake: Mistake, integrator: Option<Integrator>, dt: f64) -> (StepEnergy, f64) {
    let mut system = Hardening(mistake);
    let mut state = IntegratorState::at_rest(vec![0.15, 0.0, 0.0]);
    let settings = |integrator| Settings {
        integrator,
        tolerance: 1e-12,
        energy_balance: true,
        ..Settings::default()
    };
    let mut stepper = integrator.map(|own| Stepper::new(&system, settings(own)).unwrap());
    let mut explicit = Explicit::new(&system);
    let (mut sum, mut exchanged) = (StepEnergy::default(), 0.0);
    for _ in 0..(0.25 / dt) as usize {
        let report: Report = match &mut stepper {
            Some(stepper) => stepper.advance(&mut system, &mut state, dt).unwrap(),
            None => explicit.advance(&mut system, &mut state, dt).unwrap(),
        };
        let energy = report.energy.unwrap();
        exchanged += 0.5 * (energy.kinetic.abs() + energy.potential.abs());
        sum += energy;
    }
    (sum, exchanged)
}

const SCHEMES: [Option<Integrator>; 3] =
    [Some(Integrator::BackwardEuler), Some(Integrator::Bdf2), None];

#[test]
fn the_right_forces_close_the_balance_and_wrong_ones_open_it() {
    for scheme in SCHEMES {
        for mistake in [Mistake::None, Mistake::Sign, Mistake::Tangent, Mistake::Unbooked] {
            let (sum, exchanged) = swing(mistake, scheme, 0.005);
            let open = (sum.open() / exchanged).abs();
            println!("{scheme:?}, {mistake:?}: {open:.1e} of {exchanged:.3} J is open");
            match mistake {
                Mistake::None => assert!(open < 1e-6, "{scheme:?}: {open:e}"),
                wrong => assert!(open > 1e-3, "{scheme:?}, {wrong:?}: {open:e}"),
            }
        }
    }
}

#[test]
fn the_loss_falls_with_the_order_of_the_formula() {
    for (scheme, order) in [(SCHEMES[0], 1.0), (SCHEMES[1], 2.0)] {
        let [long, short] = [0.002, 0.001].map(|dt| {
            let (sum, exchanged) = swing(Mistake::None, scheme, dt);
            assert!((sum.open() / exchanged).abs() < 1e-6, "{scheme:?} at {dt}: {sum:?}");
            sum.numerical_dissipation.abs() / exchanged
        });
        let observed = (long / short).log2();
        println!("{scheme:?}: {long:.2e} and {short:.2e} lost, order {observed:.2}");
        assert!(observed > order - 0.2, "{scheme:?}: {long:e} and {short:e}");
    }
}

#[test]
fn the_loss_of_backward_euler_on_a_spring_is_that_of_differences() {
    // ½ m |Δv|² + ½ k |Δx|² in each step.
    let mut system = Hardening(Mistake::None);
    let settings = Settings {
        integrator: Integrator::BackwardEuler,
        tolerance: 1e-12,
        energy_balance: true,
        ..Settings::default()
    };
    let mut stepper = Stepper::new(&system, settings).unwrap();
    // So small that the spring is linear.
    let mut state = IntegratorState::at_rest(vec![1e-7, 0.0, 0.0]);
    for _ in 0..20 {
        let before = state.clone();
        let report = stepper.advance(&mut system, &mut state, 0.01).unwrap();
        let change = |a: &[f64], b: &[f64]| (a[0] - b[0]).powi(2);
        let expected = 0.5 * change(&state.velocities, &before.velocities)
            + 50.0 * change(&state.positions, &before.positions);
        let loss = report.energy.unwrap().numerical_dissipation;
        assert!((loss / expected - 1.0).abs() < 1e-6, "{loss:e} J against {expected:e} J");
    }
}
