//! Shear law from a shear loop.

use drape_fabric::{BlimanSorine, Locking, ShearBackbone, ShearLaw};
use drape_kes::{Curve, ShearPoints, Test};

use crate::curves::features::{check, largest};
use crate::curves::loop_form::{LoopBackbone, LoopForm, LoopLaw};
use crate::curves::loop_start::MeasuredLoop;
use crate::curves::piecewise::{backbone, fit_first_branch};
use crate::curves::remark::remarks;
use crate::curves::value_estimate::value_estimates;
use crate::error::Error;
use crate::forward::friction_path::FrictionPath;
use crate::forward::loop_drive::drive_loop;
use crate::regression::curve_fit::{COMPARED_POINTS, FitOptions, Identified, fit_curve};
use crate::regression::functional::loop_functionals;
use crate::regression::repeats::with_scatter;
use crate::regression::selection::{CandidateModel, select};
use crate::settings::FitSettings;
use crate::settings::model::{LoopModel, Plateau};
use crate::values::of_law::shear_values;

/// Identifies the shear law from a shear curve.
///
/// The deformation of the law is the sine of the measured angle, to which the measured force is
/// conjugate \[BHW94, eq. 5.7\]. A line, or a stiffness that changes along the test, is fitted with
/// friction to the whole history, and the zero of the force is fitted too. A [`LoopModel::Piecewise`] is fitted to the first
/// loading branch. The KES test does not measure locking: it begins where the curve ends.
///
/// # Errors
/// The curve is of another test, has no load, or does not rise.
pub fn identify_shear(
    curve: &Curve,
    settings: &FitSettings,
) -> Result<Identified<ShearLaw>, Error> {
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
    settings: &FitSettings,
) -> Result<Identified<ShearLaw>, Error> {
    let compared = &*curve.thinned(COMPARED_POINTS);
    let compared_sines: Vec<f64> = compared.deformation().iter().map(|q| q.sin()).collect();
    let measured = MeasuredLoop::new(compared, "stiffness", &compared_sines)?;
    let plateaus: Vec<Plateau> = match settings.plateau {
        Some(plateau) => vec![plateau],
        None => vec![Plateau::Constant, Plateau::Growing],
    };
    let forms = LoopForm::admitted(settings.shear, &plateaus);
    let model = |form: &LoopForm| {
        let plateau = match form.plateau {
            Plateau::Constant => "constant plateau",
            Plateau::Growing => "growing plateau",
        };
        measured.model(*form, format!("{}, {plateau}", form.name()))
    };
    let models: Vec<CandidateModel<'_>> = forms.iter().map(model).collect();
    let weights = settings.weighting.weights(curve, 0.0);
    let ShearPoints { slope, width, wide } = settings.shear_points;
    let functionals = loop_functionals(curve, slope, &[width, wide]);
    let options = FitOptions { weights, functionals, intervals: settings.intervals };
    let path = FrictionPath::new(sines);
    let forward = |chosen: usize| forms[chosen].forward(sines, &path);
    let mut fit = fit_curve(curve, select(compared, &models), forward, options);
    let form = forms[fit.chosen];
    let (points, largest) = (settings.shear_points, largest(curve.deformation()));
    fit.values =
        value_estimates(curve, &fit, settings, |p| shear_values(&law(form, p), &points, largest));
    fit.remarks = remarks(curve, &fit, settings);
    let (shear, plateau) = (Some(form.model()), Some(form.plateau));
    let settings = FitSettings { shear, plateau, ..*settings };
    let fit = with_scatter(curve, fit, |repeat| Ok(identify_shear(repeat, &settings)?.fit));
    Ok(Identified { law: law(form, &fit.parameter_values()), fit })
}

/// Returns the law of a form with some parameters, without locking.
fn law(form: LoopForm, parameters: &[f64]) -> ShearLaw {
    let LoopLaw { backbone, growth, friction, .. } = form.law(parameters);
    let backbone = match backbone {
        LoopBackbone::Line(stiffness) => ShearBackbone::Linear { stiffness },
        LoopBackbone::Varying(varying) => ShearBackbone::Varying(varying),
    };
    ShearLaw { backbone, friction, growth, locking: None }
}
