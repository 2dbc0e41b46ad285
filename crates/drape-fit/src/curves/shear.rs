//! Shear law from a shear loop.

use drape_fabric::{BlimanSorine, Locking, ShearBackbone, ShearLaw};
use drape_kes::{Curve, Test};

use crate::curves::features::{check, largest};
use crate::curves::linear_loop::{LinearLaw, LoopForm, MeasuredLoop, orders};
use crate::curves::piecewise::{backbone, fit_first_branch};
use crate::curves::value_estimate::value_estimates;
use crate::error::Error;
use crate::forward::loop_drive::drive_loop;
use crate::regression::curve_fit::{FitOptions, Identified, fit_curve};
use crate::regression::repeats::with_scatter;
use crate::regression::selection::CandidateModel;
use crate::settings::Settings;
use crate::settings::model::{LoopModel, Plateau};
use crate::values::of_law::shear_values;

/// Identifies the shear law from a shear curve.
///
/// The deformation of the law is the sine of the measured angle, to which the measured force is
/// conjugate \[BHW94, eq. 5.7\]. A linear backbone with friction is fitted to the whole history,
/// and the zero of the force is fitted too. A [`LoopModel::Piecewise`] is fitted to the first
/// loading branch. The KES test does not measure locking: it begins where the curve ends.
///
/// # Errors
/// The curve is of another test, has no load, or does not rise.
pub fn identify_shear(curve: &Curve, settings: &Settings) -> Result<Identified<ShearLaw>, Error> {
    check(curve, Test::Shear)?;
    let curve = &*curve.prepared();
    let angles = curve.deformation().iter();
    let sines: Vec<f64> = angles.map(|angle| angle.sin()).collect();
    let found = match settings.shear {
        Some(LoopModel::Piecewise) => {
            let law = |p: &[f64]| ShearLaw {
                backbone: ShearBackbone::Piecewise(backbone(p)),
                friction: BlimanSorine::none(),
                growth: 0.0,
                locking: None,
            };
            let fit = fit_first_branch(curve, &sines, settings, |p, history, out| {
                drive_loop(&law(p), history.iter().copied(), out);
            })?;
            let fit = with_scatter(curve, fit, |repeat| Ok(identify_shear(repeat, settings)?.fit));
            Identified { law: law(&fit.parameter_values()), fit }
        }
        _ => linear(curve, &sines, settings)?,
    };
    let default = Locking::default();
    let onset = default.onset.max(largest(&sines));
    let locking = (onset < default.limit).then_some(Locking { onset, ..default });
    Ok(Identified { law: ShearLaw { locking, ..found.law }, ..found })
}

/// Fits a linear backbone with friction.
fn linear(
    curve: &Curve,
    sines: &[f64],
    settings: &Settings,
) -> Result<Identified<ShearLaw>, Error> {
    let measured = MeasuredLoop::new(curve, "stiffness", sines)?;
    let plateaus: Vec<Plateau> = match settings.plateau {
        Some(plateau) => vec![plateau],
        None => vec![Plateau::Constant, Plateau::Growing],
    };
    let forms: Vec<LoopForm> = orders(settings.shear)
        .flat_map(|order| plateaus.iter().map(move |&plateau| LoopForm { order, plateau }))
        .collect();
    let model = |form: &LoopForm| {
        let plateau = match form.plateau {
            Plateau::Constant => "constant plateau",
            Plateau::Growing => "growing plateau",
        };
        measured.model(*form, format!("{}, {plateau}", form.order.name()))
    };
    let models: Vec<CandidateModel<'_>> = forms.iter().map(model).collect();
    let weights = settings.weighting.weights(curve, 0.0);
    let options = FitOptions { weights, intervals: settings.intervals };
    let mut fit = fit_curve(curve, &models, options);
    let form = forms[fit.chosen];
    let (points, largest) = (settings.shear_points, largest(curve.deformation()));
    fit.values =
        value_estimates(curve, &fit, settings, |p| shear_values(&law(form, p), &points, largest));
    let LoopForm { order, plateau } = form;
    let selected = Some(LoopModel::Linear(order));
    let settings = Settings { shear: selected, plateau: Some(plateau), ..*settings };
    let fit = with_scatter(curve, fit, |repeat| Ok(identify_shear(repeat, &settings)?.fit));
    Ok(Identified { law: law(form, &fit.parameter_values()), fit })
}

/// Returns the law of a form with some parameters, without locking.
fn law(form: LoopForm, parameters: &[f64]) -> ShearLaw {
    let LinearLaw { stiffness, growth, friction, .. } = form.law(parameters);
    ShearLaw { backbone: ShearBackbone::Linear { stiffness }, friction, growth, locking: None }
}
