//! Gravity and wind that a program changes.

use drape_dynamics::Simulation;

use crate::{EDGE, MASS, PARTICLES, STEP};
use crate::{assert_closed, balanced, mean, simulation};

/// Area of the sheet, in m².
const AREA: f64 = 0.12 * 0.12;

/// Half the density of the air times the drag coefficient that a scene has if it names none, in
/// kg/m³.
const HALF_DENSITY: f64 = 0.5 * 1.2 * 1.28;

/// Keys of a scene with air and without gravity.
const AIR: &str = "air.density = 1.2\ngravity = [0, 0, 0]";

/// Wind across the sheet, in m/s.
const WIND: [f64; 3] = [0.0, 3.0, 0.0];

#[test]
fn a_falling_sheet_has_the_acceleration_that_gravity_is_changed_to() {
    let mut simulation = balanced("", "");
    let (first, second) = ([0.0, -9.81, 0.0], [4.0, -1.62, 0.5]);
    let (mut weights, mut last) = (0.0, mean(simulation.positions()));
    for gravity in [first, second] {
        simulation.set_gravity(gravity).unwrap();
        assert_eq!(simulation.gravity(), gravity);
        let start = mean(simulation.velocities());
        for step in 1..=40 {
            let before = mean(simulation.velocities());
            simulation.step().unwrap();
            let after = mean(simulation.velocities());
            let moved = mean(simulation.positions());
            let work: f64 = (0..3).map(|k| MASS * gravity[k] * (moved[k] - last[k])).sum();
            weights += work;
            last = moved;
            for axis in 0..3 {
                // BDF2 forgets a jump by a third in each step.
                let acceleration = (after[axis] - before[axis]) / STEP;
                let jump = 20.0 / 3_f64.powi(step) + 1e-6;
                assert!((acceleration - gravity[axis]).abs() < jump, "{acceleration} m/s²");
                let gained = after[axis] - start[axis];
                let exact = gravity[axis] * f64::from(step) * STEP;
                assert!((gained - exact).abs() <= 0.51 * 9.81 * STEP, "{gained} of {exact} m/s");
            }
        }
    }
    let energy = simulation.energy().unwrap();
    assert!((energy.gravity / -weights - 1.0).abs() < 1e-9, "{energy:?}, {weights} J");
    assert_closed(&energy);
}

#[test]
fn a_sheet_at_rest_hangs_anew_when_gravity_changes() {
    let keys = "settle = {}\ntime = { step = 0.005, end = 100 }";
    let mut simulation = simulation(keys, EDGE);
    for gravity in [9.81, 24.8, 1.62] {
        simulation.set_gravity([0.0, -gravity, 0.0]).unwrap();
        while !simulation.step().unwrap().finished {}
        assert!(simulation.summary().settled);
        let load = simulation.pin_loads()[0].force[1];
        assert!((load / (-MASS * gravity) - 1.0).abs() < 2e-3, "{load} N at {gravity} m/s²");
    }
    // The value that holds already does not wake the sheet.
    simulation.set_gravity([0.0, -1.62, 0.0]).unwrap();
    assert!(simulation.summary().settled);
    simulation.set_gravity([0.0, -1.63, 0.0]).unwrap();
    assert!(!simulation.summary().settled);
}

#[test]
fn wind_on_a_held_sheet_is_the_drag_of_its_normal_speed() {
    for wind in [[0.0, 3.0, 0.0], [0.0, -0.5, 0.0], [4.0, 3.0, -2.0], [5.0, 0.0, 0.0]] {
        let mut simulation = simulation(AIR, "");
        let pin = simulation.hold(&(0..PARTICLES).collect::<Vec<_>>()).unwrap();
        simulation.set_air_velocity(wind).unwrap();
        simulation.step().unwrap();
        let [x, y, z] = simulation.pin_loads()[pin].force;
        let exact = HALF_DENSITY * AREA * wind[1] * wind[1].abs();
        assert!((y - exact).abs() < 1e-12, "{y} N of {exact} N in {wind:?}");
        assert!(x.abs() < 1e-12 && z.abs() < 1e-12, "the drag is along the normal: {x}, {z} N");
        // The wind works along its path, and the air dissipates all of it, for nothing moves.
        let energy = simulation.energy().unwrap();
        let work = exact * wind[1] * STEP;
        assert!((energy.work_in - work).abs() <= 1e-9 * work + 1e-30, "{energy:?}, {work} J");
        assert_eq!(energy.work_in, energy.air_dissipated);
        assert_closed(&energy);
    }
}

/// Speed of a sheet of the mass per area of the sample that wind drives from rest for `time`, in s:
/// the solution of `$m \dot v = k (w - v)^2$`.
fn driven_speed(time: f64) -> f64 {
    let rate = HALF_DENSITY * AREA * WIND[1] / MASS;
    WIND[1] * (1.0 - 1.0 / (1.0 + rate * time))
}

#[test]
fn wind_drives_a_free_sheet_towards_its_speed() {
    let speed_after = |step: f64| {
        let keys = format!("{AIR}\ntime = {{ step = {step}, end = 10 }}");
        let mut simulation = balanced(&keys, "");
        simulation.set_air_velocity(WIND).unwrap();
        while simulation.time() < 0.2 - 1e-9 {
            simulation.step().unwrap();
        }
        assert_closed(&simulation.energy().unwrap());
        mean(simulation.velocities())[1]
    };
    let exact = driven_speed(0.2);
    assert!((1.5..2.7).contains(&exact), "{exact} m/s");
    let errors = [0.004, 0.002, 0.001].map(|step| (speed_after(step) - exact).abs());
    // The coefficient of the start of a step makes an error in proportion to the step.
    assert!(errors[2] < 0.01 * exact, "{errors:?}");
    assert!(errors[0] > 1.7 * errors[1] && errors[1] > 1.7 * errors[2], "{errors:?}");
}

#[test]
fn wind_works_with_its_speed_on_the_momentum_that_it_gives() {
    // Backward Euler gives a momentum that is the sum of the impulses.
    let keys = "solver = { integrator = \"backward-euler\", tolerance = 1e-8 }";
    let mut simulation =
        simulation(&format!("{AIR}\ntime = {{ step = 0.001, end = 10 }}\n{keys}"), "");
    simulation.set_air_velocity(WIND).unwrap();
    for _ in 0..200 {
        simulation.step().unwrap();
    }
    let speed = mean(simulation.velocities())[1];
    let energy = simulation.energy().unwrap();
    let work = MASS * speed * WIND[1];
    assert!((energy.work_in / work - 1.0).abs() < 1e-6, "{energy:?}, {work} J");
    assert!((energy.kinetic - 0.5 * MASS * speed * speed).abs() < 1e-9, "{energy:?}");
    let dissipated = work - energy.kinetic;
    let sum = energy.air_dissipated + energy.numerical_dissipated;
    assert!((sum / dissipated - 1.0).abs() < 1e-6, "{energy:?}, {dissipated} J");
    assert!(energy.air_dissipated > 0.95 * dissipated, "{energy:?}, {dissipated} J");
}

#[test]
fn wind_and_pins_together_close_the_account() {
    let mut simulation = balanced("air.density = 1.2", EDGE);
    for step in 0..80 {
        let gust = f64::from(step % 20) * 0.2;
        simulation.set_air_velocity([0.5 * gust, gust, 0.3]).unwrap();
        simulation.step().unwrap();
    }
    let energy = simulation.energy().unwrap();
    assert!(energy.work_in.abs() > 1e-3 * energy.gravity.abs(), "{energy:?}");
    assert_closed(&energy);
}

/// Returns the message with which `simulation` refuses `wind`.
fn refused(mut simulation: Simulation, wind: [f64; 3]) -> String {
    simulation.set_air_velocity([0.0; 3]).unwrap();
    simulation.set_air_velocity(wind).unwrap_err().to_string()
}

#[test]
fn air_that_cannot_act_is_refused_with_the_key_that_lets_it() {
    let vacuum = refused(simulation("", ""), WIND);
    assert!(vacuum.contains("air.density and air.drag"), "{vacuum}");
    let without = refused(simulation("air.drag = 0", ""), WIND);
    assert!(without.contains("air.density and air.drag"), "{without}");
    let calm = "air.density = 1.2\nsettle = {}\ntime = { step = 0.005, end = 100 }";
    let relaxing = refused(simulation(calm, EDGE), WIND);
    assert!(relaxing.contains("settle.inertia = true"), "{relaxing}");
    let swinging = calm.replace("settle = {}", "settle.inertia = true");
    simulation(&swinging, EDGE).set_air_velocity(WIND).unwrap();
    simulation(AIR, EDGE).set_air_velocity(WIND).unwrap();
    for wind in [[f64::NAN, 0.0, 0.0], [0.0, f64::INFINITY, 0.0], [90.0, 90.0, 0.0]] {
        let message = refused(simulation(AIR, ""), wind);
        assert!(message.contains("give three numbers"), "{message}");
    }
    for gravity in [[f64::NAN, 0.0, 0.0], [0.0, f64::NEG_INFINITY, 0.0], [0.0, 0.0, 1e6]] {
        let mut simulation = simulation("", "");
        let message = simulation.set_gravity(gravity).unwrap_err().to_string();
        assert!(message.contains("give three numbers"), "{message}");
        assert_eq!(simulation.gravity(), [0.0, -9.81, 0.0]);
    }
}
