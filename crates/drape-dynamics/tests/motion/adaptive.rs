//! Steps of chosen length: their error, and the frames that they meet.

use crate::sheet::{CORNERS, FLAT, Sheet, apart};

fn swing(time: &str) -> Sheet {
    let scene = format!("air.density = 0.0\n{CORNERS}[time]\nend = 0.4\n{time}\n");
    Sheet { scene, panel: FLAT.into(), ..Sheet::default() }
}

#[test]
fn steps_are_shortened_until_their_error_is_small_and_frames_are_met() {
    let mut exact = swing("step = 0.0002").simulation();
    while !exact.step().unwrap().finished {}
    let mut errors = Vec::new();
    for error in [1e-4, 1e-5, 1e-6] {
        let mut simulation = swing(&format!("step = 0.005\nerror = {error}")).simulation();
        let (mut lengths, mut frames) = (Vec::new(), 0);
        loop {
            let step = simulation.step().unwrap();
            lengths.push(step.dt);
            frames += usize::from((step.time / 0.04 - (step.time / 0.04).round()).abs() < 1e-9);
            if step.finished {
                break;
            }
        }
        assert_eq!(frames, 10, "each of the frames is met");
        assert!((simulation.time() - 0.4).abs() < 1e-12);
        let solver = simulation.summary().solver;
        let largest = solver.error_max.unwrap();
        assert!(largest <= error, "a step of error {largest:e} stood");
        let shortest = lengths.iter().copied().fold(f64::INFINITY, f64::min);
        let longest = lengths.iter().copied().fold(0.0, f64::max);
        println!(
            "{error:e}: {} steps of {shortest} to {longest} s, {}",
            lengths.len(),
            solver.inexact_steps
        );
        errors.push(apart(&simulation, &exact));
    }
    println!("{errors:?}");
    assert!(errors[2] < 0.5 * errors[1] && errors[1] < 0.5 * errors[0], "{errors:?}");
}

#[test]
fn the_lengths_of_steps_are_the_same_on_every_run() {
    let hash = || {
        let mut simulation = swing("step = 0.004\nerror = 1e-5").simulation();
        while !simulation.step().unwrap().finished {}
        simulation.state_hash()
    };
    assert_eq!(hash(), hash());
}
