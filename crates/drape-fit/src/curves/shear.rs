//! Shear law from a shear loop.

use drape_fabric::{BlimanSorine, Locking, ShearBackbone, ShearLaw};
use drape_kes::{Curve, ShearPoints, Test};

use crate::curves::features::{check, largest};
use crate::curves::loop_fit::{LoopFamily, LoopFit, fit_loop};
use crate::curves::loop_form::{LoopBackbone, LoopForm, LoopLaw};
use crate::curves::piecewise::{fit_first_branch, piecewise_backbone};
use crate::curves::remark::remarks;
use crate::curves::value_estimate::value_estimates;
use crate::error::Error;
use crate::forward::loop_drive::drive_loop;
use crate::regression::curve_fit::Identified;
use crate::regression::repeats::with_scatter;
use crate::settings::FitSettings;
use crate::settings::model::{LoopModel, Plateau};
use crate::values::of_law::shear_values;

/// Identifies the shear law from a shear curve.
///
/// The deformation of the law is the sine of the measured angle, to which the measured force is
/// conjugate \[BHW94, eq. 5.7\]. A line, or a stiffness that changes along the test, is fitted with
/// friction to the whole history. The zero of the force is fitted too. A [`LoopModel::Piecewise`]
/// is fitted to the first loading branch. The KES test does not measure locking: locking begins
/// where the curve ends.
///
/// # Errors
/// The curve is of another test, has no load, does not rise, or has fewer points than the law has
/// parameters.
pub fn identify_shear(
    curve: &Curve,
    settings: &FitSettings,
) -> Result<Identified<ShearLaw>, Error> {
    check(curve, Test::Shear)?;
    let curve = &*curve.prepared();
    let angles = curve.deformation().iter();
    let sines: Vec<f64> = angles.map(|angle| angle.sin()).collect();
    let identified = match settings.shear {
        Some(LoopModel::Piecewise) => {
            let law = |p: &[f64]| ShearLaw {
                backbone: ShearBackbone::Piecewise(piecewise_backbone(p)),
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
        _ => fit_whole_loop(curve, settings)?,
    };

    // Locking begins beyond the measured angles.
    let default = Locking::default();
    let onset = default.onset.max(largest(&sines));
    let locking = (onset < default.limit).then_some(Locking { onset, ..default });
    Ok(Identified { law: ShearLaw { locking, ..identified.law }, ..identified })
}

/// Fits a linear or varying backbone with friction to the whole history of `curve`.
fn fit_whole_loop(curve: &Curve, settings: &FitSettings) -> Result<Identified<ShearLaw>, Error> {
    let plateaus: Vec<Plateau> = match settings.plateau {
        Some(plateau) => vec![plateau],
        None => vec![Plateau::Constant, Plateau::Growing],
    };
    let mut forms = Vec::new();
    for form in LoopForm::admitted(settings.shear, &plateaus) {
        let plateau = match form.plateau {
            Plateau::Constant => "constant plateau",
            Plateau::Growing => "growing plateau",
        };
        forms.push((form, format!("{}, {plateau}", form.name())));
    }
    let ShearPoints { slope, width, wide } = settings.shear_points;
    let family = LoopFamily {
        stiffness: "stiffness",
        deformation: f64::sin,
        forms,
        slope,
        widths: &[width, wide],
    };
    let LoopFit { mut fit, form } = fit_loop(curve, &family, settings)?;
    let (points, largest) = (settings.shear_points, largest(curve.deformation()));
    fit.values =
        value_estimates(curve, &fit, settings, |p| shear_values(&law(form, p), &points, largest));
    fit.remarks = remarks(curve, &fit, settings);
    let (shear, plateau) = (Some(form.model()), Some(form.plateau));
    let settings = FitSettings { shear, plateau, ..*settings };
    let fit = with_scatter(curve, fit, |repeat| Ok(identify_shear(repeat, &settings)?.fit));
    Ok(Identified { law: law(form, &fit.parameter_values()), fit })
}

/// Returns the law of `form` with the `parameters` of a fit, without locking.
fn law(form: LoopForm, parameters: &[f64]) -> ShearLaw {
    let LoopLaw { backbone, growth, friction, .. } = form.law(parameters);
    let backbone = match backbone {
        LoopBackbone::Line(stiffness) => ShearBackbone::Linear { stiffness },
        LoopBackbone::Varying(varying) => ShearBackbone::Varying(varying),
    };
    ShearLaw { backbone, friction, growth, locking: None }
}
