//! The bending law from a bending loop.

use drape_fabric::{BendingBackbone, BendingLaw, BlimanSorine, Piecewise};
use drape_kes::{Curve, Test};

use crate::curve_fit::{self, Identified, Named, line};
use crate::history::along;
use crate::lm::Parameter;
use crate::{Error, FrictionOrder, LoopModel};

/// Pre-sliding lengths to start from, over the largest deformation.
///
/// The length is the one parameter whose influence is not smooth from afar: with a start beyond the whole
/// loop the friction looks like stiffness, with one far below the sampling it looks like a step.
pub(crate) const LENGTH_STARTS: [f64; 3] = [0.01, 0.06, 0.3];
/// Ratios of fast to slow length to start a second order from.
pub(crate) const RATIO_STARTS: [f64; 2] = [0.1, 0.4];
/// Slow plateaus to start a second order from, over the fast one.
pub(crate) const SLOW_STARTS: [f64; 2] = [-0.4, 0.5];

/// Identifies the bending law of one direction from a bending curve.
///
/// A line with friction is driven along the whole history. The zero of the moment is fitted too: it absorbs
/// the offset of the instrument, and the difference between the two sides of the fabric, which the law does
/// not have. A quadratic and a line is fitted to the first loading branch.
///
/// # Errors
/// The curve is of another test, has no load, or does not rise.
pub fn identify_bending(curve: &Curve, model: LoopModel) -> Result<Identified<BendingLaw>, Error> {
    curve_fit::expect(curve, Test::Bending)?;
    match model {
        LoopModel::Linear(order) => linear(curve, order),
        LoopModel::Piecewise => {
            let first = first_branch(curve)?;
            let law = |p: &[f64]| BendingLaw {
                backbone: BendingBackbone::Piecewise(piecewise(p)),
                rest_curvature: 0.0,
                friction: BlimanSorine::none(),
            };
            let mut fit = curve_fit::fit(&first, &piecewise_starts(&first)?, |p, out| {
                along(&law(p), first.deformation().iter().copied(), out);
            });
            let law = law(&fit.values());
            fit.load.resize(curve.load().len(), 0.0);
            along(&law, curve.deformation().iter().copied(), &mut fit.load);
            Ok(Identified { law, fit })
        }
    }
}

fn linear(curve: &Curve, order: FrictionOrder) -> Result<Identified<BendingLaw>, Error> {
    let reach = reach(curve.deformation());
    let slope = mean_slope(curve)?;
    let plateau = half_width(curve, 0.4 * reach);
    let own = [
        (
            "rigidity",
            Parameter::new(slope).between(1e-3 * slope, 10.0 * slope),
        ),
        ("zero", zero(curve)),
    ];
    let starts: Vec<Vec<Named>> = friction_starts(order, plateau, reach, span(curve))
        .into_iter()
        .map(|friction| own.into_iter().chain(friction).collect())
        .collect();
    let law = |p: &[f64]| BendingLaw {
        backbone: BendingBackbone::Linear { rigidity: p[0] },
        rest_curvature: 0.0,
        friction: friction(&p[2..]),
    };
    let fit = curve_fit::fit(curve, &starts, |p, out| {
        along(&law(p), curve.deformation().iter().copied(), out);
        out.iter_mut().for_each(|load| *load += p[1]);
    });
    Ok(Identified {
        law: law(&fit.values()),
        fit,
    })
}

/// Parameters of a quadratic and a line: the line through the outer part, and a few knots.
pub(crate) fn piecewise_starts(first: &Curve) -> Result<Vec<Vec<Named>>, Error> {
    let top = reach(first.deformation());
    let points = first
        .deformation()
        .iter()
        .copied()
        .zip(first.load().iter().copied());
    let outer = line(points.filter(|(q, _)| *q > 0.6 * top));
    let (slope, intercept) = outer
        .filter(|(slope, _)| *slope > 0.0)
        .ok_or_else(|| falling(first))?;
    let load = span(first);
    let start = |knot: f64| {
        vec![
            (
                "slope",
                Parameter::new(slope).between(1e-3 * slope, 1e3 * slope),
            ),
            (
                "intercept",
                Parameter::new(intercept)
                    .with_scale(load)
                    .between(-load, load),
            ),
            ("knot", Parameter::new(knot * top).between(1e-3 * top, top)),
        ]
    };
    Ok([0.1, 0.3, 0.6].map(start).into())
}

pub(crate) fn piecewise(p: &[f64]) -> Piecewise {
    Piecewise {
        slope: p[0],
        intercept: p[1],
        knot: p[2],
    }
}

/// The first branch of a curve, which must rise from near zero.
pub(crate) fn first_branch(curve: &Curve) -> Result<Curve, Error> {
    let branches = curve.branches();
    let branch = branches.first().filter(|branch| branch.rising);
    let points = branch.ok_or_else(|| falling(curve))?.points.clone();
    let (q, load) = (&curve.deformation()[points.clone()], &curve.load()[points]);
    let first = Curve::new(curve.test, curve.direction, q.to_vec(), load.to_vec());
    let mut first = first.expect("a branch has two points and moves");
    first.name.clone_from(&curve.name);
    Ok(first)
}

pub(crate) fn falling(curve: &Curve) -> Error {
    Error::Falling {
        name: curve.name.clone(),
    }
}

/// Largest distance from zero of a history.
pub(crate) fn reach(deformation: &[f64]) -> f64 {
    deformation
        .iter()
        .fold(0.0, |reach: f64, q| reach.max(q.abs()))
}

/// Range of the measured loads.
pub(crate) fn span(curve: &Curve) -> f64 {
    let (low, high) = curve.load_range();
    high - low
}

/// Slope of the line through all points: the main rigidity, which the friction hardly tilts because it has
/// both signs.
pub(crate) fn mean_slope(curve: &Curve) -> Result<f64, Error> {
    let points = curve
        .deformation()
        .iter()
        .copied()
        .zip(curve.load().iter().copied());
    let slope = line(points).map(|(slope, _)| slope);
    slope
        .filter(|slope| *slope > 0.0)
        .ok_or_else(|| falling(curve))
}

/// Half the width of the loop near a deformation: the friction's plateau.
///
/// Of a curve that never turns back, a twentieth of its load: the search finds the rest.
pub(crate) fn half_width(curve: &Curve, deformation: f64) -> f64 {
    let width = curve.loop_width(deformation).unwrap_or(0.0);
    if width > 0.0 {
        0.5 * width
    } else {
        0.05 * span(curve)
    }
}

/// The unknown zero of the load, at most half of its range away.
pub(crate) fn zero(curve: &Curve) -> Parameter {
    let load = span(curve);
    Parameter::new(0.0)
        .with_scale(load)
        .between(-0.5 * load, 0.5 * load)
}

/// The friction's parameters: plateau, length, and for the second order the slow plateau over the fast one
/// and the fast length over the slow one.
pub(crate) fn friction_starts(
    order: FrictionOrder,
    plateau: f64,
    reach: f64,
    load: f64,
) -> Vec<Vec<Named>> {
    let plateau = Parameter::new(plateau)
        .with_scale(0.01 * load)
        .between(0.0, 2.0 * load);
    let length =
        |part: f64| Parameter::new(part * reach).between(LEAST_LENGTH * reach, 5.0 * reach);
    let first = LENGTH_STARTS.map(|part| vec![("plateau", plateau), ("length", length(part))]);
    match order {
        FrictionOrder::First => first.into(),
        FrictionOrder::Second => {
            let mut starts = Vec::new();
            for start in &first {
                for ratio in RATIO_STARTS {
                    for slow in SLOW_STARTS {
                        let mut start = start.clone();
                        start.push(("slow", Parameter::new(slow).between(-0.95, 5.0)));
                        start.push(("ratio", Parameter::new(ratio).between(0.01, 0.95)));
                        starts.push(start);
                    }
                }
            }
            starts
        }
    }
}

/// Shortest friction length over the largest deformation: below it a friction is a step at any sampling.
pub(crate) const LEAST_LENGTH: f64 = 1e-4;

/// The friction with the parameters of [`friction_starts`].
pub(crate) fn friction(p: &[f64]) -> BlimanSorine {
    match *p {
        [plateau, length] => BlimanSorine::first_order(plateau, length),
        [plateau, length, slow, ratio] => {
            BlimanSorine::second_order(plateau, -slow * plateau, ratio, length)
        }
        _ => BlimanSorine::none(),
    }
}
