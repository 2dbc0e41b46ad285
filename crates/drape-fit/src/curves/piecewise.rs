//! Fit of the first loading branch by a parabola that continues as a straight line \[BHW94, §5.1\].
//!
//! The elastic model of 1994, without friction, for bending and for shear.

use drape_fabric::Piecewise;
use drape_kes::Curve;
use drape_lm::Parameter;

use crate::curves::features::{StraightLine, falling, largest};
use crate::error::Error;
use crate::regression::curve_fit::{CurveFit, FitOptions, branch_of_each_point, fit_curve};
use crate::regression::residuals::NamedParameter;
use crate::regression::selection::{CandidateModel, select};
use crate::settings::FitSettings;
use crate::settings::model::LoopModel;

/// Part of the largest deformation above which the slope of the line is read.
const OUTER: f64 = 0.6;
/// Ends of the parabola to start from, over the largest deformation.
const KNOTS: [f64; 3] = [0.1, 0.3, 0.6];

/// Fits the first branch of `curve`, along the `history` of the law's deformation.
///
/// `drive` writes the loads of the law with the given parameters along a history.
pub(crate) fn fit_first_branch(
    curve: &Curve,
    history: &[f64],
    settings: &FitSettings,
    drive: impl Fn(&[f64], &[f64], &mut [f64]) + Sync + Send,
) -> Result<CurveFit, Error> {
    let first = first_branch(curve)?;
    let branch = &history[..first.load().len()];
    let forward = || Box::new(|p: &[f64], out: &mut [f64]| drive(p, branch, out));
    let model = CandidateModel {
        name: LoopModel::Piecewise.title(),
        starts: starts(&first)?,
        prediction: None,
        forward: forward(),
    };
    let weights = settings.weighting.weights(&first, 0.0);
    let functionals = Vec::new();
    let options = FitOptions { weights, functionals, intervals: settings.intervals };
    let mut fit = fit_curve(&first, select(&first, &[model])?, |_| forward(), options);

    // The fitted law is continued along the whole curve.
    let points = curve.load().len();
    fit.load.resize(points, 0.0);
    drive(&fit.parameter_values(), history, &mut fit.load);
    fit.band.resize(points, 0.0);
    (fit.deformation, fit.measured) = (curve.deformation().to_vec(), curve.load().to_vec());
    fit.branches = branch_of_each_point(curve);
    Ok(fit)
}

/// Returns initial guesses for the branch `first`: the line through the outer part, and several
/// ends of the parabola.
fn starts(first: &Curve) -> Result<Vec<Vec<NamedParameter>>, Error> {
    let top = largest(first.deformation());
    let points = first.deformation().iter().zip(first.load()).map(|(q, load)| [*q, *load]);
    let outer = StraightLine::through(points.filter(|[q, _]| *q > OUTER * top));
    let StraightLine { slope, intercept } =
        outer.filter(|line| line.slope > 0.0).ok_or_else(|| falling(first))?;
    let load = first.load_range().span();
    let starts = KNOTS.map(|knot| {
        let knot = knot * top;
        let intercept = Parameter::new(intercept).with_scale(load).between(-load, load);
        vec![
            NamedParameter::new("slope", Parameter::new(slope).between(1e-3 * slope, 1e3 * slope)),
            NamedParameter::new("intercept", intercept),
            NamedParameter::new("knot", Parameter::new(knot).between(1e-3 * top, top)),
        ]
    });
    Ok(starts.into())
}

/// Returns the elastic curve with the parameters `p`, in the order of [`starts`].
pub(crate) fn piecewise_backbone(p: &[f64]) -> Piecewise {
    Piecewise { slope: p[0], intercept: p[1], knot: p[2] }
}

/// Returns the first branch of `curve`, which must rise.
fn first_branch(curve: &Curve) -> Result<Curve, Error> {
    let branches = curve.branches();
    let branch = branches.first().filter(|branch| branch.rising);
    let points = branch.ok_or_else(|| falling(curve))?.points.clone();
    let (q, load) = (&curve.deformation()[points.clone()], &curve.load()[points]);
    let first = Curve::new(curve.test, curve.direction, q.to_vec(), load.to_vec());
    let mut first = first.expect("a branch has two points and moves");
    first.name.clone_from(&curve.name);
    Ok(first)
}
