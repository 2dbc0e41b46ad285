//! The bending law from a bending loop.

use drape_fabric::{BendingBackbone, BendingLaw, BlimanSorine, Piecewise};
use drape_kes::{Curve, Test};

use crate::choice::Model;
use crate::curve_fit::{self, CurveFit, Identified, line};
use crate::history::along;
use crate::line::{Form, Line, Loop};
use crate::search::Named;
use crate::{Error, FrictionOrder, LoopModel, Plateau, Settings};
use drape_lm::Parameter;

/// Identifies the bending law of one direction from a bending curve.
///
/// A line with friction is driven along the whole history. The zero of the moment is fitted too: it absorbs
/// the offset of the instrument, and the difference between the two sides of the fabric, which the law does
/// not have. A quadratic and a line is fitted to the first loading branch.
///
/// # Errors
/// The curve is of another test, has no load, or does not rise.
pub fn identify_bending(
    curve: &Curve,
    settings: &Settings,
) -> Result<Identified<BendingLaw>, Error> {
    curve_fit::expect(curve, Test::Bending)?;
    let weights = settings.weighting.weights(curve, 0.0);
    match settings.bending {
        Some(LoopModel::Piecewise) => {
            let law = |p: &[f64]| BendingLaw {
                backbone: BendingBackbone::Piecewise(piecewise(p)),
                rest_curvature: 0.0,
                friction: BlimanSorine::none(),
            };
            let curvature = curve.deformation();
            breen(curve, (curvature, settings), |p, path, out| {
                along(&law(p), path.iter().copied(), out);
            })
            .map(|fit| Identified { law: law(&fit.values()), fit })
        }
        model => {
            let law = |line: &Line| BendingLaw {
                backbone: BendingBackbone::Linear { rigidity: line.stiffness },
                rest_curvature: 0.0,
                friction: line.friction,
            };
            let curvature = curve.deformation();
            let search = Loop::new(curve, ("rigidity", curvature))?;
            let forms = orders(model).map(|order| Form { order, plateau: Plateau::Constant });
            let forms: Vec<Form> = forms.collect();
            let model = |form: &Form| search.model(*form, form.order.name().into());
            let models: Vec<Model<'_>> = forms.iter().map(model).collect();
            let fit = curve_fit::fit(curve, &models, (weights, settings.intervals));
            let (line, _) = forms[fit.chosen].law(&fit.values());
            Ok(Identified { law: law(&line), fit })
        }
    }
}

/// The orders of friction that a setting leaves to choose from.
pub(crate) fn orders(model: Option<LoopModel>) -> impl Iterator<Item = FrictionOrder> {
    let wanted = move |order: &FrictionOrder| match model {
        Some(LoopModel::Linear(wanted)) => *order == wanted,
        _ => true,
    };
    FrictionOrder::ALL.into_iter().filter(wanted)
}

/// Fits a quadratic and a line to the first branch of a curve, driven along a path.
pub(crate) fn breen(
    curve: &Curve,
    (path, settings): (&[f64], &Settings),
    drive: impl Fn(&[f64], &[f64], &mut [f64]) + Sync + Send,
) -> Result<CurveFit, Error> {
    let first = first_branch(curve)?;
    let branch = &path[..first.load().len()];
    let model = Model {
        name: "a quadratic and a line on the first branch".into(),
        starts: piecewise_starts(&first)?,
        prediction: None,
        predict: Box::new(|p: &[f64], out: &mut [f64]| drive(p, branch, out)),
    };
    let weights = settings.weighting.weights(&first, 0.0);
    let mut fit = curve_fit::fit(&first, &[model], (weights, settings.intervals));
    let points = curve.load().len();
    fit.load.resize(points, 0.0);
    drive(&fit.values(), path, &mut fit.load);
    fit.band.resize(points, 0.0);
    (fit.deformation, fit.measured) = (curve.deformation().to_vec(), curve.load().to_vec());
    fit.branches = curve_fit::branches(curve);
    Ok(fit)
}

/// Parameters of a quadratic and a line: the line through the outer part, and a few knots.
pub(crate) fn piecewise_starts(first: &Curve) -> Result<Vec<Vec<Named>>, Error> {
    let top = reach(first.deformation());
    let points = first.deformation().iter().copied().zip(first.load().iter().copied());
    let outer = line(points.filter(|(q, _)| *q > 0.6 * top));
    let (slope, intercept) =
        outer.filter(|(slope, _)| *slope > 0.0).ok_or_else(|| falling(first))?;
    let load = span(first);
    let start = |knot: f64| {
        vec![
            ("slope", Parameter::new(slope).between(1e-3 * slope, 1e3 * slope)),
            ("intercept", Parameter::new(intercept).with_scale(load).between(-load, load)),
            ("knot", Parameter::new(knot * top).between(1e-3 * top, top)),
        ]
    };
    Ok([0.1, 0.3, 0.6].map(start).into())
}

pub(crate) fn piecewise(p: &[f64]) -> Piecewise {
    Piecewise { slope: p[0], intercept: p[1], knot: p[2] }
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
    Error::Falling { name: curve.name.clone() }
}

/// Largest distance from zero of a history.
pub(crate) fn reach(deformation: &[f64]) -> f64 {
    deformation.iter().fold(0.0, |reach: f64, q| reach.max(q.abs()))
}

/// Range of the measured loads.
pub(crate) fn span(curve: &Curve) -> f64 {
    let (low, high) = curve.load_range();
    high - low
}

/// Slope of the line through all points: the main rigidity, which the friction hardly tilts because it has
/// both signs.
pub(crate) fn mean_slope(curve: &Curve) -> Result<f64, Error> {
    let points = curve.deformation().iter().copied().zip(curve.load().iter().copied());
    let slope = line(points).map(|(slope, _)| slope);
    slope.filter(|slope| *slope > 0.0).ok_or_else(|| falling(curve))
}

/// The unknown zero of the load, at most half of its range away.
pub(crate) fn zero(curve: &Curve) -> Parameter {
    let load = span(curve);
    Parameter::new(0.0).with_scale(load).between(-0.5 * load, 0.5 * load)
}
