//! Model selection finds the order of the friction of the data: 200 noisy loops of each kind.

#![allow(clippy::print_stdout)]

mod random;

use drape_fabric::{BendingBackbone, BendingLaw, BlimanSorine, Dahl, Law, drive};
use drape_fit::{FitSettings, FrictionOrder, LoopModel, identify_bending};
use drape_kes::{Curve, Direction, Test};
use random::Random;
use rayon::prelude::*;

const TRIALS: u64 = 200;
/// Standard deviation of the noise over the range of the moments.
const NOISE: f64 = 0.01;
/// Least fraction of the trials in which the law of the data is selected.
const LEAST: f64 = 0.95;
/// The KES cycle, and loops that grow from curvatures of drape to those of the test, in 1/m.
const CYCLE: [f64; 4] = [0.0, 250.0, -250.0, 250.0];
const NESTED: [f64; 9] = [0.0, 25.0, -25.0, 75.0, -75.0, 150.0, -150.0, 250.0, -250.0];

/// Returns a noisy loop in steps of 2 1/m.
fn measure(friction: BlimanSorine, reversals: &[f64], random: &mut Random) -> Curve {
    let mut q = vec![reversals[0]];
    for ends in reversals.windows(2) {
        let steps = ((ends[1] - ends[0]).abs() / 2.0).round();
        q.extend((1..=steps as usize).map(|i| ends[0] + (ends[1] - ends[0]) * i as f64 / steps));
    }
    let law = BendingLaw {
        backbone: BendingBackbone::Linear { rigidity: 1e-5 },
        rest_curvature: 0.0,
        friction,
    };
    let mut load = drive(&law, law.virgin(), &q);
    let range = |(low, high): (f64, f64), m: &f64| (low.min(*m), high.max(*m));
    let (low, high) = load.iter().fold((f64::INFINITY, f64::NEG_INFINITY), range);
    load.iter_mut().for_each(|m| *m += NOISE * (high - low) * random.normal());
    Curve::new(Test::Bending, Direction::Warp, q, load).expect("a curve of a law")
}

/// Returns the fraction of the trials in which each order is selected.
fn chosen(reversals: &[f64], friction: impl Fn(&mut Random) -> BlimanSorine + Sync) -> [f64; 3] {
    let orders: Vec<usize> = (0..TRIALS)
        .into_par_iter()
        .map(|trial| {
            let mut random = Random(trial << 32);
            let friction = friction(&mut random);
            let curve = measure(friction, reversals, &mut random);
            let fit = identify_bending(&curve, &FitSettings::default()).expect("identified").fit;
            fit.chosen
        })
        .collect();
    [0, 1, 2].map(|order| {
        orders.iter().filter(|chosen| **chosen == order).count() as f64 / TRIALS as f64
    })
}

/// 2HB of 0.6 cm⁻¹ times B, slipping over 8 to 30 1/m.
fn first(random: &mut Random) -> BlimanSorine {
    BlimanSorine::first_order(3e-4, random.between(8.0, 30.0)).expect("a friction")
}

/// Stiction: the load overshoots by some 4 % of the range and settles within the test.
fn second(random: &mut Random) -> BlimanSorine {
    let slow = random.between(4e-4, 7e-4);
    BlimanSorine::second_order(
        3e-4 + slow,
        slow,
        random.between(0.1, 0.25),
        random.between(30.0, 80.0),
    )
    .expect("a friction")
}

/// Loops that widen with their amplitude.
fn parallel(random: &mut Random) -> BlimanSorine {
    let slow = random.between(4e-4, 7e-4);
    let (ratio, length) = (random.between(0.05, 0.15), random.between(60.0, 120.0));
    let [first, second] = [(4e-4, ratio * length), (slow, length)]
        .map(|(plateau, length)| Dahl::new(plateau, length).expect("an element"));
    BlimanSorine::parallel(first, second).expect("a friction")
}

#[test]
fn the_order_of_the_friction_is_that_of_the_data() {
    for (reversals, name) in [(&CYCLE[..], "one cycle"), (&NESTED[..], "growing loops")] {
        let of_first = chosen(reversals, first);
        let of_second = chosen(reversals, second);
        println!(
            "{name}: made with one element, chosen {of_first:?}; with the second order {of_second:?}"
        );
        assert!(of_first[0] >= LEAST, "{name}: {of_first:?}");
        assert!(of_second[2] >= LEAST, "{name}: {of_second:?}");
    }
}

#[test]
fn growing_loops_that_widen_are_given_two_elements() {
    let of_parallel = chosen(&NESTED, parallel);
    println!("growing loops made with two positive elements: {of_parallel:?}");
    assert!(of_parallel[1] >= LEAST, "{of_parallel:?}");
}

#[test]
fn the_order_can_be_overridden() {
    let mut random = Random(1);
    let friction = second(&mut random);
    let curve = measure(friction, &CYCLE, &mut random);
    for order in FrictionOrder::ALL {
        let settings =
            FitSettings { bending: Some(LoopModel::Linear(order)), ..FitSettings::default() };
        let fit = identify_bending(&curve, &settings).expect("identified").fit;
        assert_eq!(fit.candidates.len(), 1);
        let name = match order {
            FrictionOrder::First => "first-order: ",
            FrictionOrder::TwoElements => "two-elements: ",
            FrictionOrder::Second => "second-order: ",
        };
        let law = &fit.candidates[0].law;
        assert!(law.starts_with(name), "{law}");
    }
}
