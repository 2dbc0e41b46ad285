//! Surfaces never intersect, however a program leads pins and bodies.

use drape_dynamics::{BodyTarget, Displacement, PinTarget, Simulation};

use crate::{BALL, EDGE, STEP, position, simulation};

/// Opposite edges of the sheet, and a ball below it.
fn held_over_a_ball(keys: &str) -> Simulation {
    let bottom = EDGE.replace("top", "bottom");
    simulation(keys, &format!("{BALL}{EDGE}{bottom}"))
}

/// Checks that no surfaces intersect now and no step was accepted with an intersection.
fn assert_free(simulation: &Simulation) {
    let contact = simulation.summary().contact;
    assert_eq!(contact.intersections, 0, "{contact:?}");
}

#[test]
fn a_pin_that_crosses_spacings_in_a_step_divides_the_step() {
    // The largest step that a scene may have, and a pin that moves 5 cm in it.
    let keys = "time = { step = 0.05, end = 10 }\ngravity = [0, 0, 0]\ncontact.top_speed = 2";
    let mut simulation = simulation(keys, EDGE);
    let target =
        PinTarget::Rigid(Displacement { shift: [0.0, 0.05, 0.0], ..Displacement::default() });
    simulation.lead_pin(0, &target, 0.05).unwrap();
    let step = simulation.step().unwrap();
    assert!(step.report.sub_steps >= 3, "spacings of 2 cm: {:?}", step.report);
    let particle = simulation.pin_particles(0).unwrap()[0];
    assert!((position(&simulation, particle)[1] - 0.05).abs() < 1e-15);
    assert_free(&simulation);
}

#[test]
fn a_pin_faster_than_contact_is_refused_with_what_would_do() {
    let mut simulation = held_over_a_ball("");
    let target =
        PinTarget::Rigid(Displacement { shift: [0.0, -0.1, 0.0], ..Displacement::default() });
    let message = simulation.lead_pin(0, &target, STEP).unwrap_err().to_string();
    assert!(message.contains("pin 0 moves at 50.000 m/s"), "{message}");
    let seconds = message.split("give it ").nth(1).unwrap().split(' ').next().unwrap();
    simulation.lead_pin(0, &target, seconds.parse().unwrap()).unwrap();
    let key = message.split(" or the scene ").nth(1).unwrap();
    assert!(key.starts_with("contact.top_speed = 5"), "{message}");
    held_over_a_ball(key).lead_pin(0, &target, STEP).unwrap();
    // Without contact of surfaces nothing is promised, and nothing is refused.
    held_over_a_ball("contact.surfaces = false").lead_pin(0, &target, STEP).unwrap();
}

#[test]
fn a_pin_that_is_led_into_a_body_ends_the_step_and_a_saved_state_goes_on() {
    let mut simulation = held_over_a_ball("");
    let start = simulation.saved();
    // The middle of the sheet is led through the ball.
    let pin = simulation.hold(&[24]).unwrap();
    let target =
        PinTarget::Rigid(Displacement { shift: [0.0, -0.08, 0.0], ..Displacement::default() });
    simulation.lead_pin(pin, &target, 0.2).unwrap();
    let failed = (0..100).find_map(|_| simulation.step().err());
    let message = failed.expect("the ball is in the way").to_string();
    assert!(!message.is_empty());
    assert_free(&simulation);

    simulation.resume(start).unwrap();
    assert_eq!((simulation.pin_count(), simulation.time()), (2, 0.0));
    for _ in 0..40 {
        simulation.step().unwrap();
    }
    assert_free(&simulation);
}

#[test]
fn cloth_that_is_dragged_over_a_ball_keeps_apart() {
    let mut simulation = simulation("", &format!("{BALL}{EDGE}"));
    for step in 0..200 {
        let shift =
            [0.0, if step < 100 { -2e-4 } else { 3e-4 }, if step < 60 { 3e-4 } else { 0.0 }];
        let target = PinTarget::Rigid(Displacement {
            shift,
            turn: [0.0, 0.2, 0.0],
            ..Displacement::default()
        });
        simulation.lead_pin(0, &target, STEP).unwrap();
        if step == 50 {
            simulation.hold(&[0, 48]).unwrap();
        }
        if step == 120 {
            simulation.release(&[0]).unwrap();
            let target = BodyTarget::Rigid(Displacement {
                shift: [0.0, 0.01, 0.0],
                ..Displacement::default()
            });
            simulation.lead_body("ball", &target, 0.05).unwrap();
        }
        simulation.step().unwrap();
    }
    let contact = simulation.summary().contact;
    assert!(contact.pairs_max > 10, "the sheet touches the ball: {contact:?}");
    assert_free(&simulation);
}
