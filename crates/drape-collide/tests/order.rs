//! The order of calls: what belongs to an open step is refused between steps, and the setup between
//! steps is refused while a step is open.

#![allow(clippy::unwrap_used)]

#[expect(dead_code)]
#[path = "surface/sheets.rs"]
mod sheets;
mod support;

use drape_collide::{Error, PinchPolicy, PinchedVertices, SurfaceStart, SurfaceTrial};

use sheets::{ALL, Between, WIDE, level};

/// Level sheet in the middle between two plates, 0.4 mm from each.
fn between() -> Between {
    Between::new(PinchPolicy::Error, WIDE, [-4e-4, 4e-4])
}

#[test]
fn a_step_is_refused_until_one_is_begun() {
    let mut contact = between().contact;
    let refused = contact.step().unwrap_err();
    assert_eq!(refused, Error::NoOpenStep);
    assert!(refused.to_string().contains("SurfaceContact::begin"), "{refused}");

    // The remedy of the message.
    let bodies = contact.state().body_positions().to_vec();
    contact.begin(SurfaceStart::new(&level(0.0), &bodies)).unwrap();
    assert!(contact.step().is_ok());
}

#[test]
fn a_step_is_refused_after_each_of_its_ends() {
    let mut contact = between().contact;
    let (start, bodies) = (level(0.0), contact.state().body_positions().to_vec());
    let (memory, saved) = (contact.state().memory(), contact.state().saved());

    contact.begin(SurfaceStart::new(&start, &bodies)).unwrap().commit(&start).unwrap();
    assert_eq!(contact.step().unwrap_err(), Error::NoOpenStep, "it is committed");
    contact.begin(SurfaceStart::new(&start, &bodies)).unwrap().reject();
    assert_eq!(contact.step().unwrap_err(), Error::NoOpenStep, "it is rejected");
    contact.begin(SurfaceStart::new(&start, &bodies)).unwrap();
    contact.restore(&memory).unwrap();
    assert_eq!(contact.step().unwrap_err(), Error::NoOpenStep, "an earlier state is restored");
    contact.begin(SurfaceStart::new(&start, &bodies)).unwrap();
    contact.resume(&start, &saved).unwrap();
    assert_eq!(contact.step().unwrap_err(), Error::NoOpenStep, "a saved state is resumed");
}

#[test]
fn a_setup_is_refused_while_a_step_is_open_and_changes_nothing() {
    let mut contact = between().contact;
    let (start, bodies) = (level(0.0), contact.state().body_positions().to_vec());
    let memory = contact.state().memory();
    assert!(contact.setup().is_ok());
    contact.begin(SurfaceStart::new(&start, &bodies)).unwrap();
    let refused = contact.setup().unwrap_err();
    assert_eq!(refused, Error::StepIsOpen);
    let message = refused.to_string();
    assert!(message.contains("`OpenStep::commit` or `OpenStep::reject`"), "{message}");
    assert!(contact.step().is_ok(), "the step is still open");
    assert!(contact.state().memory() == memory);

    // Both remedies of the message.
    contact.step().unwrap().reject();
    assert!(contact.setup().is_ok());
    contact.begin(SurfaceStart::new(&start, &bodies)).unwrap().commit(&start).unwrap();
    assert!(contact.setup().is_ok());
}

#[test]
fn a_step_without_its_handle_stays_open_at_its_obstacle_time() {
    let mut held = between().contact;
    let mut borrowed = between().contact;
    let start = level(-1.5e-4);
    // The plates move down by 0.2 mm, so that the upper one leaves and the lower one comes.
    let mut bodies = held.state().body_positions().to_vec();
    bodies.iter_mut().skip(1).step_by(3).for_each(|height| *height -= 2e-4);

    // One solver holds the handle, and another takes it anew for each call.
    let mut step = held.begin(SurfaceStart::new(&start, &bodies)).unwrap();
    step.set_obstacle_time(0.25);
    let potentials = [step.energy(&start).unwrap().potential(), step.body_work(&start).unwrap()];
    borrowed.begin(SurfaceStart::new(&start, &bodies)).unwrap();
    borrowed.step().unwrap().set_obstacle_time(0.25);
    let again = [
        borrowed.energy(&start).unwrap().potential(),
        borrowed.step().unwrap().body_work(&start).unwrap(),
    ];
    assert!(potentials[0] > 0.0 && potentials[1] != 0.0, "{potentials:?}");
    assert_eq!(potentials, again);
    assert_eq!(step.intersections(&start).unwrap(), borrowed.intersections(&start).unwrap());
}

#[test]
fn a_step_that_is_begun_again_is_the_step_that_was_begun_once() {
    let mut once = between().contact;
    let mut twice = between().contact;
    let start = level(-1e-4);
    let bodies = once.state().body_positions().to_vec();
    let raised: Vec<f64> =
        bodies.iter().enumerate().map(|(k, x)| if k % 3 == 1 { x + 1e-4 } else { *x }).collect();
    let lowered: Vec<f64> =
        bodies.iter().enumerate().map(|(k, x)| if k % 3 == 1 { x - 1e-4 } else { *x }).collect();
    twice.begin(SurfaceStart::new(&start, &raised)).unwrap().set_obstacle_time(1.0);

    let ends = [&mut once, &mut twice].map(|contact| {
        let mut step = contact.begin(SurfaceStart::new(&start, &lowered)).unwrap();
        let mut displacements = vec![-1e-4; start.len()];
        step.limit(SurfaceTrial {
            start: &start,
            displacements: &mut displacements,
            held: &[],
            obstacle_time: 0.0,
            obstacle_advance: &mut 1.0,
        })
        .unwrap();
        step.set_obstacle_time(1.0);
        let potential = step.energy(&start).unwrap().potential();
        step.commit(&start).unwrap();
        (displacements, potential)
    });
    assert_eq!(ends[0], ends[1]);
    assert!(once.state().memory() == twice.state().memory());
}

#[test]
fn a_rejected_step_leaves_bodies_pinches_and_distances_as_they_were() {
    for pinch in [PinchPolicy::Error, PinchPolicy::Thin, PinchPolicy::Release] {
        let mut between = Between::new(pinch, WIDE, [-3e-4, 3e-4]);
        between.contact.setup().unwrap().shrink_distances(&level(5e-5)).unwrap();
        let contact = &mut between.contact;
        let (start, memory) = (level(5e-5), contact.state().memory());
        // The upper plate repels a sheet there.
        let before = contact.energy(&level(1.5e-4)).unwrap().potential();
        assert!(before.is_finite() && before > 0.0, "{before} J");

        // The upper plate comes down and pinches the sheet, and distances grow.
        let mut bodies = contact.state().body_positions().to_vec();
        let upper = bodies.len() / 2;
        bodies[upper..].iter_mut().skip(1).step_by(3).for_each(|height| *height -= 3e-4);
        let start = SurfaceStart { growth_increment: 0.3, ..SurfaceStart::new(&start, &bodies) };
        let mut step = contact.begin(start).unwrap();
        step.set_obstacle_time(1.0);
        assert!(step.energy(&level(1.5e-4)).unwrap().potential() != before, "{pinch:?}");
        step.reject();

        assert!(contact.state().memory() == memory, "{pinch:?}");
        assert_eq!(contact.energy(&level(1.5e-4)).unwrap().potential(), before, "{pinch:?}");

        // The same step changes all three if it is committed.
        contact.begin(start).unwrap().commit(&level(-1e-4)).unwrap();
        let state = contact.state();
        let PinchedVertices { thinned, released } = state.pinched_vertices();
        let pinched = [pinch == PinchPolicy::Thin, pinch == PinchPolicy::Release];
        assert_eq!([thinned, released].map(|count| count == ALL), pinched, "{pinch:?}");
        assert_eq!(state.body_positions(), bodies);
        assert!(state.growth_fraction() > 0.7, "{}", state.growth_fraction());
    }
}
