//! Loops of bending and shear that are none of the laws: stiffness that changes along the test,
//! faces that differ, offsets, and limits other than the standard's.

mod random;

use drape_fit::{CurveFit, FitSettings, identify_bending, identify_shear};
use drape_kes::{Curve, Direction, Symbol, Test};
use random::Random;

/// Name of a shape, and its load at a deformation; both are ratios.
type NamedShape = (&'static str, fn(f64) -> f64);

/// Loop with an elastic part and friction that follows Dahl's equation with a plateau of its own at
/// each deformation.
struct Loop {
    test: Test,
    limit: f64,
    steps: usize,
    elastic: fn(f64) -> f64,
    plateau: fn(f64) -> f64,
    length: f64,
    noise: f64,
}

impl Loop {
    fn curve(&self, random: &mut Random) -> Curve {
        let turns = [0.0, self.limit, -self.limit, self.limit];
        let (mut q, mut friction) = (0.0, 0.0);
        let mut points = vec![(0.0, (self.elastic)(0.0))];
        for pair in turns.windows(2) {
            let span = pair[1] - pair[0];
            let count = (self.steps as f64 * span.abs() / self.limit) as usize;
            // Each step is driven in parts, so that the varying plateau is followed.
            let parts = 20;
            let step = span / (count * parts) as f64;
            for _ in 0..count {
                for _ in 0..parts {
                    q += step;
                    let target = (self.plateau)(q).copysign(step);
                    friction = target + (friction - target) * (-step.abs() / self.length).exp();
                }
                points.push((q, (self.elastic)(q) + friction));
            }
        }
        let range = points.iter().map(|(_, f)| f.abs()).fold(0.0, f64::max);
        let noisy = points.into_iter().map(|(q, f)| (q, f + self.noise * range * random.normal()));
        let (q, f) = noisy.unzip();
        Curve::new(self.test, Direction::Warp, q, f).expect("a curve")
    }

    fn fit(&self, random: &mut Random) -> CurveFit {
        let curve = self.curve(random);
        let settings = FitSettings::default();
        match self.test {
            Test::Shear => identify_shear(&curve, &settings).expect("a law").fit,
            _ => identify_bending(&curve, &settings).expect("a law").fit,
        }
    }
}

fn value(fit: &CurveFit, symbol: Symbol) -> f64 {
    fit.values.iter().find(|value| value.symbol == symbol).expect("a value").value
}

/// Asserts that a law follows its curve and has the values that are read off it.
fn assert_followed(name: &str, fit: &CurveFit) {
    let law = &fit.candidates[fit.chosen].law;
    assert!(fit.misfit < 0.02, "{name}: {law} misses by {}", fit.misfit);
    for value in &fit.values {
        let Ok(read) = value.curve else { continue };
        let deviation = value.value / read - 1.0;
        assert!(deviation.abs() < 0.05, "{name}: {value:?}");
    }
}

const SHEAR: Loop = Loop {
    test: Test::Shear,
    limit: 0.1396,
    steps: 80,
    elastic: |s| 30.0 * s,
    plateau: |_| 0.6,
    length: 0.004,
    noise: 0.0005,
};

const BENDING: Loop = Loop {
    test: Test::Bending,
    limit: 250.0,
    steps: 80,
    elastic: |k| 1e-5 * k,
    plateau: |_| 5e-4,
    length: 8.0,
    noise: 0.002,
};

#[test]
fn shear_that_stiffens_within_the_test_is_followed() {
    let mut random = Random(1);
    // The wool of 283, 393 and 596 N/m at 0.5 to 2.5, 2.5 to 5 and 5 to 7.9 degrees, and two more.
    let shapes: [NamedShape; 3] = [
        ("cubic", |s| 270.0 * s + 9000.0 * s.powi(3)),
        ("hyperbolic sine", |s| 20.0 * 0.04 * (s / 0.04).sinh()),
        ("locking", |s| 30.0 * s / (1.0 - (s / 0.19).powi(2))),
    ];
    for (name, elastic) in shapes {
        let fit = Loop { elastic, plateau: |_| 2.0, ..SHEAR }.fit(&mut random);
        assert_followed(name, &fit);
    }
}

#[test]
fn bending_that_softens_is_followed() {
    let mut random = Random(2);
    let shapes: [NamedShape; 3] = [
        ("tangent hyperbolic", |k| 1.2e-5 * 180.0 * (k / 180.0).tanh()),
        ("two lines", |k| 5e-6 * k + 8e-6 * k.clamp(-60.0, 60.0)),
        ("root", |k| 1.5e-4 * k.signum() * ((1.0 + k.abs() / 10.0).sqrt() - 1.0)),
    ];
    for (name, elastic) in shapes {
        let fit = Loop { elastic, ..BENDING }.fit(&mut random);
        assert_followed(name, &fit);
    }
}

#[test]
fn a_loop_that_widens_with_the_angle_and_stiffens_is_followed() {
    let mut random = Random(3);
    let elastic: fn(f64) -> f64 = |s| 25.0 * s + 1500.0 * s.powi(3);
    let fit = Loop { elastic, plateau: |s| 0.4 + 8.0 * s.abs(), ..SHEAR }.fit(&mut random);
    assert_followed("widening", &fit);
}

#[test]
fn loops_to_other_limits_give_the_laws_of_the_fabric() {
    let mut random = Random(4);
    for (limit, named) in [(100.0, true), (250.0, false), (400.0, false)] {
        let fit = Loop { limit, ..BENDING }.fit(&mut random);
        assert!(
            (value(&fit, Symbol::B) / 0.101_97 - 1.0).abs() < 0.02,
            "{limit}: {:?}",
            fit.values
        );
        assert!(
            (value(&fit, Symbol::TwoHb) / 0.101_97 - 1.0).abs() < 0.02,
            "{limit}: {:?}",
            fit.values
        );
        let told =
            fit.remarks.iter().any(|remark| remark.contains("where the standard test goes on"));
        assert_eq!(told, named, "{limit}: {:?}", fit.remarks);
    }
    let fit = Loop { limit: 4_f64.to_radians().sin(), ..SHEAR }.fit(&mut random);
    assert!((value(&fit, Symbol::G) / 0.533_9 - 1.0).abs() < 0.02, "{:?}", fit.values);
    assert!(
        fit.remarks.iter().any(|remark| remark.contains("it ends at 4.00°")),
        "{:?}",
        fit.remarks
    );
}

#[test]
fn faces_that_differ_and_offsets_are_told_and_their_mean_is_kept() {
    let mut random = Random(5);
    let elastic: fn(f64) -> f64 = |k| if k > 0.0 { 1.15e-5 * k } else { 0.85e-5 * k } + 3e-4;
    let fit = Loop { elastic, ..BENDING }.fit(&mut random);
    assert!((value(&fit, Symbol::B) / 0.101_97 - 1.0).abs() < 0.03, "{:?}", fit.values);
    assert!((value(&fit, Symbol::TwoHb) / 0.101_97 - 1.0).abs() < 0.03, "{:?}", fit.values);
    assert!(fit.remarks.iter().any(|remark| remark.contains("sides of the fabric differ")));
    assert!(fit.remarks.iter().any(|remark| remark.contains("the loop is offset")));
}
