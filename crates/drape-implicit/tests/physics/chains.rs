//! Nets of stiff springs: pendulum, catenary, momentum, energy.

use drape_implicit::{Integrator, IntegratorState, Report, Settings, Stepper, System};

use crate::springs::Springs;

/// Fourth-order Runge–Kutta with steps far below the fastest oscillation: an independent reference.
fn runge_kutta(system: &mut Springs, state: &mut IntegratorState, dt: f64, steps: usize) {
    let n = state.positions.len();
    let mut rate = |x: &[f64], v: &[f64]| {
        let mut a = vec![0.0; n];
        system.forces(x, &mut a);
        for (k, a) in a.iter_mut().enumerate() {
            *a = if system.held[k / 3] { 0.0 } else { *a / system.masses[k / 3] };
        }
        (v.to_vec(), a)
    };
    let shift = |x: &[f64], h: f64, r: &[f64]| -> Vec<f64> {
        x.iter().zip(r).map(|(x, r)| x + h * r).collect()
    };
    for _ in 0..steps {
        let (x, v) = (&state.positions, &state.velocities);
        let (v1, a1) = rate(x, v);
        let (v2, a2) = rate(&shift(x, dt / 2.0, &v1), &shift(v, dt / 2.0, &a1));
        let (v3, a3) = rate(&shift(x, dt / 2.0, &v2), &shift(v, dt / 2.0, &a2));
        let (v4, a4) = rate(&shift(x, dt, &v3), &shift(v, dt, &a3));
        for k in 0..n {
            state.positions[k] += dt / 6.0 * (v1[k] + 2.0 * (v2[k] + v3[k]) + v4[k]);
            state.velocities[k] += dt / 6.0 * (a1[k] + 2.0 * (a2[k] + a3[k]) + a4[k]);
        }
    }
}

#[test]
fn a_stiff_chain_swings_like_the_fine_reference() {
    // Ten links of 1e5 N/m and 10 g: the fastest oscillation has 6300 rad/s, a period of 1 ms.
    let mut system = Springs::chain(10, 1.0, 0.01, 1e5);
    system.held[0] = true;
    let start: Vec<f64> =
        (0..=10).flat_map(|i| [0.06 * f64::from(i), -0.08 * f64::from(i), 0.0]).collect();
    let mut reference = IntegratorState::at_rest(start.clone());
    runge_kutta(&mut system, &mut reference, 5e-5, 12_000);

    let error = |dt: f64, steps: usize| {
        let mut system = system.clone();
        let mut stepper = Stepper::new(&system, Settings::default()).unwrap();
        let mut state = IntegratorState::at_rest(start.clone());
        for _ in 0..steps {
            stepper.advance(&mut system, &mut state, dt).unwrap();
        }
        let squares: f64 =
            state.positions.iter().zip(&reference.positions).map(|(a, b)| (a - b).powi(2)).sum();
        (squares / 11.0).sqrt()
    };
    let (coarse, fine) = (error(4e-3, 150), error(1e-3, 600));
    // The swing is some 0.8 m; the order is below two while the axial waves, which no step
    // resolves, ring down.
    assert!(coarse < 0.02, "4 ms: {coarse} m");
    assert!(fine < 0.003, "1 ms: {fine} m");
}

#[test]
fn a_heavy_chain_comes_to_rest_on_the_catenary() {
    let (links, length, span) = (60, 1.0, 0.6);
    let mut system = Springs::chain(links, length, 0.01, 1e8);
    system.held[0] = true;
    system.held[links] = true;
    // A triangle of the right length; the chain has to find its shape.
    let drop = (0.25 * length * length - 0.25 * span * span).sqrt();
    let positions: Vec<f64> = (0..=links)
        .flat_map(|i| {
            let s = i as f64 / links as f64;
            [span * s, -drop * (1.0 - (2.0 * s - 1.0).abs()), 0.0]
        })
        .collect();
    let mut state = IntegratorState::at_rest(positions);
    let settings = Settings {
        integrator: Integrator::BackwardEuler,
        // The residual left is an error of the weight, and of the shape.
        tolerance: 1e-6,
        ..Settings::default()
    };
    let mut stepper = Stepper::new(&system, settings).unwrap();
    for _ in 0..400 {
        stepper.advance(&mut system, &mut state, 0.05).unwrap();
    }
    let speed = state.velocities.iter().fold(0.0, |a: f64, v| a.max(v.abs()));
    assert!(speed < 1e-6, "still moving at {speed} m/s");

    let found = -state.positions[3 * (links / 2) + 1];

    // The chain of links: horizontal tension is constant, so the slopes of the links grow by equal
    // amounts from ±half of one at the middle; that amount follows from the span.
    let link = length / links as f64;
    let slope = |k: usize, growth: f64| (growth * (k as f64 + 0.5)).atan();
    let half_span = |growth| (0..links / 2).map(|k| link * slope(k, growth).cos()).sum::<f64>();
    let growth = bisect(|growth| half_span(growth) - 0.5 * span);
    let polygon: f64 = (0..links / 2).map(|k| link * slope(k, growth).sin()).sum();
    // Springs of 1e8 N/m under 3 N, 17 mm long, stretch by 2e-6 at most.
    assert!((found / polygon - 1.0).abs() < 2e-6, "{found} m against {polygon} m");

    // The smooth catenary y = a cosh(x/a), of length 2a sinh(span/2a): 60 links are within 1/60² or
    // so.
    let a = bisect(|a| 2.0 * a * (0.5 * span / a).sinh() - length);
    let sag = a * ((0.5 * span / a).cosh() - 1.0);
    assert!((found / sag - 1.0).abs() < 1e-3, "{found} m against {sag} m");
}

/// The root of a falling function between 1/100 and 10.
fn bisect(f: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.01, 10.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if f(middle) > 0.0 { low = middle } else { high = middle }
    }
    low
}

#[test]
fn a_free_net_keeps_its_momentum() {
    let n = 6;
    for integrator in [Integrator::BackwardEuler, Integrator::Bdf2] {
        let mut system = Springs::sheet(n, 500.0);
        system.held.fill(false);
        system.gravity = 0.0;
        for (i, mass) in system.masses.iter_mut().enumerate() {
            *mass *= 1.0 + 0.1 * (i % 7) as f64;
        }
        let velocities: Vec<f64> = (0..3 * n * n).map(|k| (k as f64 * 1.7).sin()).collect();
        let mut state = IntegratorState::new(Springs::flat(n), velocities);
        let momentum = |state: &IntegratorState| {
            [0, 1, 2].map(|axis| {
                let along = state.velocities.iter().skip(axis).step_by(3);
                system.masses.iter().zip(along).map(|(m, v)| m * v).sum::<f64>()
            })
        };
        let before = momentum(&state);
        let magnitude: f64 = system.masses.iter().sum();
        let tolerance = 1e-10;
        let settings = Settings { integrator, tolerance, ..Settings::default() };
        let mut other = system.clone();
        let mut stepper = Stepper::new(&other, settings).unwrap();
        for _ in 0..100 {
            stepper.advance(&mut other, &mut state, 2e-3).unwrap();
        }
        for (before, after) in before.iter().zip(momentum(&state)) {
            // Each step may leave the residual it is allowed, and no more: internal forces cancel
            // exactly.
            let allowed = 100.0 * 2e-3 * tolerance * 9.81 * magnitude;
            assert!((before - after).abs() < allowed, "{integrator:?}: {before} became {after}");
        }
    }
}

#[test]
fn a_swinging_sheet_loses_the_energy_that_is_reported_and_bdf2_a_fifth_of_it() {
    let n = 12;
    let loss = |integrator| {
        let mut system = Springs::sheet(n, 2000.0);
        let settings =
            Settings { integrator, tolerance: 1e-8, energy_balance: true, ..Settings::default() };
        let mut stepper = Stepper::new(&system, settings).unwrap();
        let mut state = IntegratorState::at_rest(Springs::flat(n));
        let mut total = Report::default();
        let mut energy = 0.0;
        for step in 0..100 {
            total += &stepper.advance(&mut system, &mut state, 5e-3).unwrap();
            let now = system.energy(&state.positions, &state.velocities);
            // The other formula keeps a sum over two steps from growing, not the energy of each.
            let falls = integrator == Integrator::Bdf2 || now < energy;
            assert!(falls, "step {step}: {energy} J became {now} J");
            energy = now;
        }
        let balance = total.energy.unwrap();
        // Held at rest, so no work is done; released with no energy.
        assert_eq!(balance.work, 0.0);
        let gap = balance.numerical_dissipation + energy;
        // The work of the springs along each step is found by quadrature.
        assert!(gap.abs() < 1e-6 * -energy, "{integrator:?}: {gap} J unaccounted");
        -energy
    };
    let (first, second) = (loss(Integrator::BackwardEuler), loss(Integrator::Bdf2));
    // Of the 1 J that the fall releases. The rest of the second order's loss is in waves of a
    // few steps' length.
    assert!(first > 0.1, "{first} J");
    assert!(second > 0.0 && second < 0.2 * first, "{second} J against {first} J");
}
