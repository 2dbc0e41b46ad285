//! Fit of the whole history of a loop, for bending and shear.

use drape_kes::Curve;

use crate::curves::loop_form::LoopForm;
use crate::curves::loop_start::MeasuredLoop;
use crate::error::Error;
use crate::forward::friction_path::FrictionPath;
use crate::regression::curve_fit::{COMPARED_POINTS, CurveFit, FitOptions, fit_curve};
use crate::regression::functional::loop_functionals;
use crate::regression::selection::{CandidateModel, select};
use crate::settings::FitSettings;

/// Laws of one test that are compared on a loop, and the points at which its KES values are read.
pub(crate) struct LoopFamily<'a> {
    /// Name of the stiffness.
    pub(crate) stiffness: &'static str,
    /// Converts a measured deformation to the deformation of the law.
    pub(crate) deformation: fn(f64) -> f64,
    /// Forms with their names in reports, in the order of preference.
    pub(crate) forms: Vec<(LoopForm, String)>,
    /// Deformations between which the slope is read.
    pub(crate) slope: [f64; 2],
    /// Deformations at which the width is read.
    pub(crate) widths: &'a [f64],
}

/// Fit of a loop, and the form that was selected.
pub(crate) struct LoopFit {
    pub(crate) fit: CurveFit,
    pub(crate) form: LoopForm,
}

/// Selects a form of `family` on `curve`, and fits the form to the whole history.
///
/// # Errors
/// The load does not rise.
pub(crate) fn fit_loop(
    curve: &Curve,
    family: &LoopFamily<'_>,
    settings: &FitSettings,
) -> Result<LoopFit, Error> {
    // Forms are compared on some of the points.
    let compared = &*curve.thinned(COMPARED_POINTS);
    let compared_history: Vec<f64> =
        compared.deformation().iter().map(|&q| (family.deformation)(q)).collect();
    let measured = MeasuredLoop::new(compared, family.stiffness, &compared_history)?;
    let models: Vec<CandidateModel<'_>> =
        family.forms.iter().map(|(form, name)| measured.model(*form, name.clone())).collect();
    let selection = select(compared, &models)?;

    // The selected form is fitted to all points.
    let options = FitOptions {
        weights: settings.weighting.weights(curve, 0.0),
        functionals: loop_functionals(curve, family.slope, family.widths),
        intervals: settings.intervals,
    };
    let history: Vec<f64> = curve.deformation().iter().map(|&q| (family.deformation)(q)).collect();
    let path = FrictionPath::new(&history);
    let fit = fit_curve(
        curve,
        selection,
        |chosen| family.forms[chosen].0.forward(&history, &path),
        options,
    );
    let form = family.forms[fit.chosen].0;
    Ok(LoopFit { fit, form })
}
