//! Explicit steps against implicit ones.

use drape_dynamics::{ReferenceScheme, Simulation};

use crate::sheet::{CORNERS, FLAT, Sheet};

const EXPLICIT: Option<ReferenceScheme> = Some(ReferenceScheme::Explicit);

/// A small sheet after it has begun to swing.
fn swing(reference: Option<ReferenceScheme>, step: f64, friction: bool) -> Simulation {
    let surfaces = reference.is_none();
    let scene = format!(
        "air.density = 0.0\ncontact.surfaces = {surfaces}\n{CORNERS}[solver]\ntolerance = 1e-9\n[time]\n\
         end = 0.064\nstep = {step}\n"
    );
    let sheet =
        Sheet { particles: 6, side: 0.2, scene, panel: FLAT.into(), friction, ..Sheet::default() };
    let mut simulation = match reference {
        Some(reference) => Simulation::with_reference_scheme(sheet.scene(), reference).unwrap(),
        None => sheet.simulation(),
    };
    while !simulation.step().unwrap().finished {}
    simulation
}

fn largest(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()))
}

#[test]
fn implicit_and_explicit_steps_lead_to_the_same_motion() {
    // Stability asks for 0.15 ms here.
    let explicit = [8e-5, 4e-5, 2e-5].map(|step| swing(EXPLICIT, step, false));
    let places = explicit.each_ref().map(|simulation| simulation.positions().to_vec());
    // Of first order: twice the finer less the coarser has no error of that order.
    let limit: Vec<f64> = places[2].iter().zip(&places[1]).map(|(f, c)| 2.0 * f - c).collect();
    let distances = [2e-3, 1e-3, 5e-4, 2.5e-4]
        .map(|step| largest(swing(None, step, false).positions(), &limit));
    let orders: Vec<f64> = distances.windows(2).map(|pair| (pair[0] / pair[1]).log2()).collect();
    println!("second order: {distances:?}, {orders:?}");
    let errors = places.each_ref().map(|places| largest(places, &limit));
    println!("explicit: {errors:?}");
    assert!(orders.iter().all(|order| *order > 1.5), "{distances:?}: orders {orders:?}");
    let order = (errors[0] / errors[1]).log2();
    assert!(order > 0.8, "explicit steps are of first order: {errors:?}");

    // What explicit steps make or lose is reported, and falls with their length.
    let drifts = explicit.each_ref().map(|simulation| {
        let energy = simulation.energy().unwrap();
        (energy.numerical_dissipated / energy.gravity).abs()
    });
    println!("drift: {drifts:?}");
    assert!(drifts[2] < 0.4 * drifts[0] && drifts[2] < 1e-3, "{drifts:?}");
}

#[test]
fn they_do_so_with_friction_too() {
    let explicit = swing(EXPLICIT, 4e-5, true);
    let implicit = [1e-3, 2.5e-4].map(|step| swing(None, step, true));
    let places = explicit.positions().to_vec();
    let distances = implicit.each_ref().map(|i| largest(i.positions(), &places));
    let lost = |s: &Simulation| s.energy().unwrap().friction_dissipated;
    let frictions = [lost(&explicit), lost(&implicit[0]), lost(&implicit[1])];
    println!("{distances:?} m, friction {frictions:?} J");
    // The explicit steps are off by 1e-5 m themselves.
    assert!(distances[1] < 3e-5 && distances[1] < distances[0], "{distances:?}");
    assert!((frictions[2] / frictions[0] - 1.0).abs() < 0.02, "{frictions:?}");
}
