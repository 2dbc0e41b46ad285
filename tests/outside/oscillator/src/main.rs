//! A mass on a spring with Dahl friction, driven at a steady rate until every cycle repeats. The
//! drive then pays for the loop of the friction, whose area has a closed form.

use std::time::Instant;

use drape_hysteresis::Dahl;

/// Mass in kg, stiffness of the spring in N/m, and amplitude of the drive in N.
const MASS: f64 = 0.5;
const STIFFNESS: f64 = 200.0;
const DRIVE: f64 = 6.0;

/// Steps in a cycle of the drive, and cycles until the motion repeats.
const STEPS: u32 = 2000;
const CYCLES: u32 = 120;

/// Deformation in m, velocity in m/s and load of the friction in N.
#[derive(Clone, Copy, Default)]
struct State {
    place: f64,
    velocity: f64,
    load: f64,
}

/// Returns the `state` after a step of `dt`, in s, with the mean force `drive`, in N.
///
/// The mean force of the friction is its work over the path, so that no energy is lost to the step.
fn step(friction: Dahl, state: State, drive: f64, dt: f64) -> State {
    let State { place, velocity, load } = state;
    let mut path = velocity * dt;
    for _ in 0..100 {
        let drag = if path == 0.0 { load } else { friction.work(load, path) / path };
        let force = drive - STIFFNESS * (place + 0.5 * path) - drag;
        let next = velocity * dt + 0.5 * dt * dt * force / MASS;
        let change = next - path;
        path = next;
        if change.abs() <= 1e-16 {
            break;
        }
    }
    State {
        place: place + path,
        velocity: 2.0 * path / dt - velocity,
        load: friction.advance(load, path),
    }
}

fn main() {
    let begin = Instant::now();
    // A plateau of 3 N, and a friction length of 3 cm.
    let friction = Dahl { plateau: 3.0, length: 0.03 };
    // A drive at 0.8 of the natural frequency.
    let rate = 0.8 * (STIFFNESS / MASS).sqrt();
    let dt = std::f64::consts::TAU / rate / f64::from(STEPS);

    let mut state = State::default();
    let (mut paid, mut low, mut high) = (0.0, 0.0, 0.0);
    for cycle in 0..CYCLES {
        (paid, low, high) = (0.0, f64::MAX, f64::MIN);
        for number in 0..STEPS {
            let time = f64::from(cycle * STEPS + number) + 0.5;
            let drive = DRIVE * (std::f64::consts::TAU * time / f64::from(STEPS)).cos();
            let next = step(friction, state, drive, dt);
            paid += drive * (next.place - state.place);
            state = next;
            (low, high) = (state.place.min(low), state.place.max(high));
        }
    }
    let milliseconds = 1e3 * begin.elapsed().as_secs_f64();

    // The area of the steady loop between ±q is 4 F (q − x tanh(q/x)), however q is reached.
    let Dahl { plateau, length } = friction;
    let amplitude = 0.5 * (high - low);
    let area = 4.0 * plateau * (amplitude - length * (amplitude / length).tanh());
    assert!((high + low).abs() < 1e-9 * amplitude, "the motion is symmetric: {low} to {high}");
    assert!((paid / area - 1.0).abs() < 1e-9, "{paid} J a cycle, the loop has {area} J");
    println!(
        "{:.1} mm and {paid:.5} J in each cycle, as the loop of the friction: {milliseconds:.2} ms",
        1e3 * amplitude
    );
}
