//! Repeats of a test: the law is that of their mean, and its errors know how specimens scatter.

mod random;

use drape_fabric::{BendingBackbone, BendingLaw, BlimanSorine, Law, drive};
use drape_fit::{FitSettings, identify, identify_bending};
use drape_kes::{Curve, Direction, Sheet, Test};
use random::Random;

/// Bending rigidity of the fabric, in N·m.
const RIGIDITY: f64 = 1.2e-5;
/// Standard deviation of the rigidity from specimen to specimen, over its mean.
const SCATTER: f64 = 0.1;

/// Loop of a specimen whose rigidity and friction are some times those of the fabric.
fn specimen(times: f64) -> Curve {
    let law = BendingLaw {
        backbone: BendingBackbone::Linear { rigidity: times * RIGIDITY },
        rest_curvature: 0.0,
        friction: BlimanSorine::first_order(times * 6e-4, 4.0).expect("a friction"),
    };
    let there = (0..=50).chain((-50..50).rev()).chain(-49..=50);
    let curvature: Vec<f64> = there.map(|i| 5.0 * f64::from(i)).collect();
    let moment = drive(&law, law.virgin(), &curvature);
    Curve::new(Test::Bending, Direction::Warp, curvature, moment).expect("it moves")
}

fn of_specimens(times: &[f64]) -> Curve {
    Curve::mean(times.iter().map(|&times| specimen(times)).collect()).expect("alike")
}

#[test]
fn the_scatter_of_specimens_is_in_the_standard_error_and_in_the_fabric() {
    let curve = of_specimens(&[0.9, 1.0, 1.1]);
    let fit = identify_bending(&curve, &FitSettings::default()).expect("a law").fit;
    let rigidity = &fit.parameters[0];
    assert_eq!((rigidity.name, fit.repeats), ("rigidity", 3));
    assert!((rigidity.value / RIGIDITY - 1.0).abs() < 1e-6, "{rigidity:?}");
    // 0.1 over the root of three; Student's quantile of two degrees of freedom is 4.303.
    let error = 0.1 * RIGIDITY / 3.0_f64.sqrt();
    let found = rigidity.standard_error.clone().expect("an error");
    assert!((found / error - 1.0).abs() < 1e-3, "{found} against {error}");
    let [low, high] = rigidity.interval.clone().expect("an interval");
    assert!(((high - low) / (2.0 * 4.303 * error) - 1.0).abs() < 1e-3, "{low} to {high}");

    let mut sheet = Sheet::default();
    (sheet.name, sheet.curves) = ("three".into(), vec![curve]);
    let provenance = identify(&sheet).expect("a fabric").fabric.provenance.expect("fitted");
    let kept = provenance.standard_errors["warp.bending.rigidity"];
    assert!((kept / error - 1.0).abs() < 1e-3, "{kept} against {error}");
}

#[test]
fn the_intervals_of_three_specimens_contain_the_fabric_as_often_as_they_say() {
    let mut random = Random(28);
    let trials = 200;
    let contained = (0..trials).filter(|_| {
        let times: Vec<f64> = (0..3).map(|_| 1.0 + SCATTER * random.normal()).collect();
        let fit =
            identify_bending(&of_specimens(&times), &FitSettings::default()).expect("a law").fit;
        let [low, high] = fit.parameters[0].interval.clone().expect("an interval");
        (low..=high).contains(&RIGIDITY)
    });
    let share = contained.count() as f64 / f64::from(trials);
    // 95 % of 200 with the standard deviation of 1.5 %, three times.
    assert!((0.90..=1.0).contains(&share), "{share}");
}
