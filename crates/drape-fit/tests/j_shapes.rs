//! Tensile curves of the shapes that laboratories measure: the law has the values of the curve, and
//! their intervals hold them.
//!
//! The curves come from formulas that are none of the laws.
//! `cargo test --release -p drape-fit --test j_shapes -- --ignored --nocapture` prints the whole
//! study.

#![allow(clippy::print_stdout, reason = "a study prints its figures")]

mod random;

use drape_fit::{Candidate, CurveFit, FitSettings, ValueEstimate, identify_tensile};
use drape_kes::{Curve, Direction, Symbol, Test};
use random::Random;

/// Largest load of the KES test, in N/m: 500 gf/cm.
const LARGEST_LOAD: f64 = 490.332_5;
/// Points of a branch.
const STEPS: usize = 120;
/// Noise of the load over the largest load.
const NOISE: f64 = 0.002;

/// Shape of a loading branch: load over the largest load against strain over the largest strain.
#[derive(Clone, Copy, Debug)]
enum Shape {
    Exponential,
    Power,
    CubicAndLine,
    QuarticAndSquare,
    /// Two lines with a rounded corner: a toe that pulls straight, then stretches.
    Hinge,
    /// A tangent, which steepens towards a strain that yarns cannot pass.
    Tangent,
}

const SHAPES: [Shape; 6] = [
    Shape::Exponential,
    Shape::Power,
    Shape::CubicAndLine,
    Shape::QuarticAndSquare,
    Shape::Hinge,
    Shape::Tangent,
];

/// Kind of a tensile curve.
#[derive(Clone, Copy, Debug)]
struct Kind {
    shape: Shape,
    linearity: f64,
    resilience: f64,
    /// Largest strain.
    extension: f64,
    /// Strain at which the recovery reaches zero load, over the largest strain.
    residual: f64,
}

impl Shape {
    /// Returns the load at `x` with the parameter of the shape.
    fn load(self, parameter: f64, x: f64) -> f64 {
        let softplus = |z: f64| if z > 30.0 { z } else { z.exp().ln_1p() };
        match self {
            Self::Exponential => (parameter * x).exp_m1() / parameter.exp_m1(),
            Self::Power => x.powf(parameter),
            Self::CubicAndLine => parameter * x.powi(3) + (1.0 - parameter) * x,
            Self::QuarticAndSquare => parameter * x.powi(4) + (1.0 - parameter) * x * x,
            Self::Hinge => {
                let raw = |x: f64| softplus((x - parameter) / 0.08);
                (raw(x) - raw(0.0)) / (raw(1.0) - raw(0.0))
            }
            Self::Tangent => (parameter * x).tan() / parameter.tan(),
        }
    }

    fn bounds(self) -> [f64; 2] {
        match self {
            Self::Exponential => [1e-3, 60.0],
            Self::Power => [1.0, 6.0],
            Self::CubicAndLine | Self::QuarticAndSquare => [0.0, 1.0],
            Self::Hinge => [-2.0, 0.95],
            Self::Tangent => [1e-3, 1.5705],
        }
    }

    /// Returns the parameter with which the shape has a linearity; `None` where it has none.
    fn parameter(self, linearity: f64) -> Option<f64> {
        let found = |parameter: f64| {
            let n = 4000;
            let load = |i: usize| self.load(parameter, (i as f64 + 0.5) / n as f64);
            2.0 * (0..n).map(load).sum::<f64>() / n as f64
        };
        let [mut low, mut high] = self.bounds();
        if (found(low) - linearity) * (found(high) - linearity) > 0.0 {
            return None;
        }
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if found(middle) > linearity {
                low = middle;
            } else {
                high = middle;
            }
        }
        Some(0.5 * (low + high))
    }
}

impl Kind {
    /// Returns the curve with noise; `None` where a fabric cannot have it.
    fn curve(&self, random: &mut Random) -> Option<Curve> {
        let parameter = self.shape.parameter(self.linearity)?;
        // Recovered work (1 − r)/(p + 1) over work ½ LT.
        let power = 2.0 * (1.0 - self.residual) / (self.resilience * self.linearity) - 1.0;
        let back = |x: f64| ((x - self.residual) / (1.0 - self.residual)).max(0.0).powf(power);
        let load = |x: f64| self.shape.load(parameter, x);
        let gains = |i: usize| {
            let x = i as f64 / 400.0;
            back(x) > load(x) + 0.005
        };
        if power < 1.0 || (0..=400).any(gains) {
            return None;
        }
        let at = |i: usize| i as f64 / STEPS as f64;
        let up = (0..=STEPS).map(|i| (at(i), load(at(i))));
        let down = (0..=STEPS).rev().map(|i| (at(i), back(at(i))));
        let down = down.take_while(|(x, _)| *x >= self.residual - 1e-9);
        let points = up
            .chain(down)
            .map(|(x, load)| (self.extension * x, LARGEST_LOAD * (load + NOISE * random.normal())));
        let (strain, load) = points.unzip();
        Some(Curve::new(Test::Tensile, Direction::Warp, strain, load).expect("a curve"))
    }

    /// True value of a symbol, in the laboratory's unit.
    fn truth(&self, symbol: Symbol) -> f64 {
        match symbol {
            Symbol::Lt => self.linearity,
            Symbol::Wt => 0.5 * self.linearity * 500.0 * self.extension,
            Symbol::Rt => 100.0 * self.resilience,
            _ => 100.0 * self.extension,
        }
    }
}

fn kinds() -> Vec<Kind> {
    let mut kinds = Vec::new();
    for shape in SHAPES {
        for linearity in [0.45, 0.55, 0.65, 0.8] {
            for resilience in [0.4, 0.6, 0.8] {
                for extension in [0.02, 0.1, 0.3] {
                    for residual in [0.0, 0.12] {
                        kinds.push(Kind { shape, linearity, resilience, extension, residual });
                    }
                }
            }
        }
    }
    kinds
}

/// Largest deviation of a law's value, over the value.
fn limit(symbol: Symbol) -> f64 {
    if symbol == Symbol::Rt { 0.03 } else { 0.02 }
}

/// Largest relative error of a value that is called known.
const KNOWN: f64 = 0.05;

/// What the fits of some kinds gave.
#[derive(Default)]
struct Tally {
    values: usize,
    /// Values within their intervals.
    held: usize,
    /// Part of its values within their intervals, for the kind with the fewest.
    worst: Option<(f64, Kind)>,
    faults: Vec<String>,
}

impl Tally {
    /// Adds some draws of a kind.
    fn add(&mut self, kind: &Kind, draws: usize, random: &mut Random) {
        let (mut values, mut held) = (0, 0);
        for _ in 0..draws {
            let Some(curve) = kind.curve(random) else { return };
            let fit = identify_tensile(&curve, &FitSettings::default()).expect("a law").fit;
            self.faults.extend(faults(kind, &fit).into_iter().map(|f| format!("{kind:?}: {f}")));
            values += fit.values.len();
            held += fit.values.iter().filter(|value| holds(value, kind)).count();
        }
        let part = held as f64 / values as f64;
        if self.worst.is_none_or(|(least, _)| part < least) {
            self.worst = Some((part, *kind));
        }
        self.values += values;
        self.held += held;
    }

    fn assert_good(&self) {
        assert_eq!(self.faults, [""; 0]);
        let part = self.held as f64 / self.values as f64;
        assert!(part >= 0.9, "{} of {} values in their intervals", self.held, self.values);
    }
}

/// Returns whether the interval of a value holds the truth.
fn holds(estimate: &ValueEstimate, kind: &Kind) -> bool {
    let truth = kind.truth(estimate.symbol);
    estimate.interval.as_ref().is_ok_and(|[low, high]| (*low..=*high).contains(&truth))
}

/// Returns what is wrong with the fit of a curve: a misfit, a value that is off, or one that is not
/// known well enough for a verdict of good.
fn faults(kind: &Kind, fit: &CurveFit) -> Vec<String> {
    let mut faults = Vec::new();
    if fit.misfit > Candidate::FOLLOWS || !fit.stop.converged() {
        faults.push(format!("misfit {:.2} %, {:?}", 100.0 * fit.misfit, fit.stop));
    }
    assert_eq!(fit.values.len(), 4, "{kind:?}: {:?}", fit.values);
    for estimate in &fit.values {
        let deviation = estimate.value / kind.truth(estimate.symbol) - 1.0;
        let known = estimate.relative_error().is_some_and(|error| error <= KNOWN);
        if deviation.abs() > limit(estimate.symbol) || !known {
            faults.push(format!("{:+.2} %: {estimate:?}", 100.0 * deviation));
        }
    }
    faults
}

#[test]
fn curves_of_every_shape_give_laws_with_their_values() {
    let mut tally = Tally::default();
    let mut random = Random(11);
    // Every shape and linearity once, with the other properties in turn.
    for (index, kind) in kinds().iter().enumerate().filter(|(index, _)| index % 19 == 0) {
        tally.add(kind, 1 + index % 2, &mut random);
    }
    assert!(tally.values > 80, "{}", tally.values);
    tally.assert_good();
}

#[test]
#[ignore = "takes an hour"]
fn curves_of_every_kind_give_laws_with_their_values() {
    let draws = std::env::var("DRAWS").map_or(20, |draws| draws.parse().expect("a number"));
    let mut tally = Tally::default();
    let mut random = Random(11);
    for kind in kinds() {
        tally.add(&kind, draws, &mut random);
    }
    println!(
        "{} of {} values in their intervals, worst {:?}",
        tally.held, tally.values, tally.worst
    );
    tally.assert_good();
}
