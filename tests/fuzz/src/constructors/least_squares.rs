//! Least squares and friction.

use drape::hysteresis::{BlimanSorine, Dahl, Slip};
use drape::lm::{
    Covariance, Loss, MinimiserSettings, Parameter, Problem, ProfileSettings, minimise, profile,
};

use crate::shapes::Source;

/// Line through points, with weights of any length.
struct Line {
    places: Vec<f64>,
    heights: Vec<f64>,
    weights: Vec<f64>,
}

impl Problem for Line {
    fn residual_count(&self) -> usize {
        self.places.len()
    }

    fn residuals(&self, parameters: &[f64], residuals: &mut [f64]) {
        // A model may rely on the number of its parameters.
        let [rise, offset] = [parameters[0], parameters[1]];
        let points = self.places.iter().zip(&self.heights);
        for (residual, (place, height)) in residuals.iter_mut().zip(points) {
            *residual = offset + rise * place - height;
        }
    }

    fn weights(&self) -> &[f64] {
        &self.weights
    }
}

fn parameter(source: &mut Source<'_>) -> Parameter {
    let parameter = Parameter::new(source.odd());
    match source.below(5) {
        0 => parameter.between(source.odd(), source.odd()),
        1 => parameter.with_scale(source.odd()),
        2 => parameter.fixed(),
        _ => parameter,
    }
}

pub fn fit(source: &mut Source<'_>) {
    let count = source.below(6) as usize;
    let line = Line {
        places: source.odd_list(count),
        heights: source.odd_list(count),
        weights: if source.below(2) == 0 { Vec::new() } else { source.odd_list(count) },
    };
    let parameters = [parameter(source), parameter(source)];
    let loss =
        if source.below(2) == 0 { Loss::Squares } else { Loss::Huber { size: source.odd() } };
    let settings = MinimiserSettings { loss, ..MinimiserSettings::default() };
    let mut report = minimise(&line, &parameters, &settings);

    // The report of another fit has another number of parameters.
    if source.below(4) == 0 {
        report.parameters.pop();
    }
    let covariance = Covariance::new(&line, &parameters, &report, loss);
    let index = source.below(4) as usize;
    let _ = covariance.standard_error(index);
    let _ = covariance.correlation(index, source.below(4) as usize);
    let settings = ProfileSettings { level: source.odd(), minimiser: settings };
    assert_eq!(profile(&line, &parameters, &report, &settings).len(), parameters.len());
}

pub fn friction(source: &mut Source<'_>) {
    let mut numbers = [0.0; 4].map(|_| source.mostly_positive(3));
    let [first, second, ratio, length] = numbers;
    let element = Dahl::new(first, length);
    let friction = match source.below(3) {
        0 => BlimanSorine::first_order(first, length),
        1 => BlimanSorine::second_order(first, second, ratio, length),
        _ => element.and_then(|element| {
            BlimanSorine::parallel(element, Dahl { plateau: source.odd(), length: source.odd() })
        }),
    };
    let Ok(friction) = friction else { return };

    // No closed cycle creates energy.
    numbers.rotate_left(1);
    let half = Slip::from(numbers[0].abs().min(1e3));
    let back = Slip::from(-half.amount);
    let mut loads = [0.0; 2];
    for slip in [half, back, back] {
        loads = friction.advance(loads, slip);
    }
    let [mut work, mut size] = [0.0_f64; 2];
    for slip in [half, half, back, back] {
        let part = friction.work(loads, slip);
        (work, size) = (work + part, size + part.abs());
        loads = friction.advance(loads, slip);
    }
    // The work of a slip far shorter than the friction length is a difference of larger numbers.
    let plateaus: f64 = friction.elements.iter().map(|element| element.plateau.abs()).sum();
    let rounding = 1e-9 * size + 1e-14 * plateaus * half.amount;
    assert!(!work.is_finite() || work >= -rounding, "{friction:?} makes {work} of {size}");
}
