//! Contact that is as stiff as the top speed of bodies and pins needs.

use drape_dynamics::{BodyTarget, Displacement, Simulation};

use crate::{BALL, EDGE, scene, simulation};

/// Edges that hold the sheet over the ball.
fn tables() -> String {
    format!("{BALL}{EDGE}{}", EDGE.replace("top", "bottom"))
}

/// Displacement of the ball by 1 cm.
const LIFT: BodyTarget =
    BodyTarget::Rigid(Displacement { shift: [0.0, 0.01, 0.0], turn: [0.0; 3], center: None });

/// Time of the displacement at 2 m/s, in s.
const SECONDS: f64 = 0.005;

#[test]
fn a_body_at_two_metres_a_second_is_accepted_where_the_scene_declares_it() {
    let mut undeclared = simulation("", &tables());
    let message = undeclared.lead_body("ball", &LIFT, SECONDS).unwrap_err().to_string();
    assert!(message.contains("moves at 2.000 m/s"), "{message}");
    let key = message.split(" or the scene ").nth(1).unwrap();
    assert!(key.starts_with("contact.top_speed = 2"), "{message}");

    simulation(key, &tables()).lead_body("ball", &LIFT, SECONDS).unwrap();
    let mut declared = simulation("contact.top_speed = 2", &tables());
    declared.lead_body("ball", &LIFT, SECONDS).unwrap();
    let mut speed: f64 = 0.0;
    for _ in 0..20 {
        speed = speed.max(declared.step().unwrap().speed_max);
    }
    let contact = declared.summary().contact;
    assert!(contact.intersections == 0 && contact.pairs_max > 0, "{contact:?}");
    assert!(speed > 1.0, "the ball throws the cloth: {speed} m/s");
    // Faster than declared is refused with the next remedy.
    let message = declared.lead_body("ball", &LIFT, 0.001).unwrap_err().to_string();
    assert!(message.contains("contact.top_speed = 1"), "{message}");
}

#[test]
fn a_program_declares_the_top_speed_of_a_scene_that_it_has_read() {
    let declared = |speed: f64| {
        let mut scene = scene("", &tables());
        scene.contact.top_speed = Some(speed);
        Simulation::new(scene)
    };
    declared(2.0).unwrap().lead_body("ball", &LIFT, SECONDS).unwrap();
    for speed in [f64::NAN, -1.0, 1e6, f64::INFINITY] {
        let message = declared(speed).unwrap_err().to_string();
        assert!(message.contains("contact.top_speed is"), "{message}");
    }
}

#[test]
fn a_scene_that_names_its_stiffness_is_told_the_stiffness() {
    let mut simulation = simulation("contact.stiffness = 2e9", &tables());
    let message = simulation.lead_body("ball", &LIFT, 0.0005).unwrap_err().to_string();
    let key = message.split(" or the scene ").nth(1).unwrap();
    assert!(key.starts_with("contact.stiffness = "), "{message}");
    self::simulation(key, &tables()).lead_body("ball", &LIFT, 0.0005).unwrap();
    // No contact stops this speed, so only time is offered.
    let message = simulation.lead_body("ball", &LIFT, 1e-6).unwrap_err().to_string();
    assert!(message.contains("give it") && !message.contains("or the scene"), "{message}");
}
