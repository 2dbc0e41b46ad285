//! Bending law from a bending loop.

use drape_fabric::{BendingBackbone, BendingLaw, BlimanSorine};
use drape_kes::{BendingPoints, Curve, Test};

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
use crate::values::of_law::bending_values;

/// Identifies the bending law of one direction from a bending curve.
///
/// A line, or a rigidity that changes along the test, is fitted with friction to the whole history.
/// The zero of the moment is fitted too. It contains the offset of the instrument and the
/// difference between the two sides of the fabric, which the law does not have. A
/// [`LoopModel::Piecewise`] is fitted to the first loading branch.
///
/// ```
/// use drape_fabric::{BendingBackbone, BendingLaw, BlimanSorine, Law, drive};
/// use drape_fit::{FitSettings, identify_bending};
/// use drape_kes::{Curve, Direction, Test};
///
/// let law = BendingLaw {
///     backbone: BendingBackbone::Linear { rigidity: 1.2e-5 },
///     rest_curvature: 0.0,
///     friction: BlimanSorine::first_order(6e-4, 4.0)?,
/// };
/// // The KES cycle, in 1/m.
/// let steps = (0..=125).chain((-125..125).rev());
/// let curvature: Vec<f64> = steps.map(|i| 2.0 * f64::from(i)).collect();
/// let moment = drive(&law, law.virgin(), &curvature);
/// let curve = Curve::new(Test::Bending, Direction::Weft, curvature, moment).expect("it moves");
///
/// let law = identify_bending(&curve, &FitSettings::default())?.law;
/// assert!((law.friction.plateau() / 6e-4 - 1.0).abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// The curve is of another test, has no load, does not rise, or has fewer points than the law has
/// parameters.
pub fn identify_bending(
    curve: &Curve,
    settings: &FitSettings,
) -> Result<Identified<BendingLaw>, Error> {
    check(curve, Test::Bending)?;
    let curve = &*curve.prepared();
    let curvature = curve.deformation();
    if settings.bending == Some(LoopModel::Piecewise) {
        let law = |p: &[f64]| BendingLaw {
            backbone: BendingBackbone::Piecewise(piecewise_backbone(p)),
            rest_curvature: 0.0,
            friction: BlimanSorine::none(),
        };
        let fit = fit_first_branch(curve, curvature, settings, |p, history, out| {
            drive_loop(&law(p), history.iter().copied(), out);
        })?;
        let fit = with_scatter(curve, fit, |repeat| Ok(identify_bending(repeat, settings)?.fit));
        return Ok(Identified { law: law(&fit.parameter_values()), fit });
    }

    let BendingPoints { slope, width } = settings.bending_points;
    let forms = LoopForm::admitted(settings.bending, &[Plateau::Constant]);
    let family = LoopFamily {
        stiffness: "rigidity",
        deformation: |curvature| curvature,
        forms: forms.into_iter().map(|form| (form, form.name())).collect(),
        slope,
        widths: &[width],
    };
    let LoopFit { mut fit, form } = fit_loop(curve, &family, settings)?;
    let (points, largest) = (settings.bending_points, largest(curvature));
    fit.values =
        value_estimates(curve, &fit, settings, |p| bending_values(&law(form, p), &points, largest));
    fit.remarks = remarks(curve, &fit, settings);
    let settings = FitSettings { bending: Some(form.model()), ..*settings };
    let fit = with_scatter(curve, fit, |repeat| Ok(identify_bending(repeat, &settings)?.fit));
    Ok(Identified { law: law(form, &fit.parameter_values()), fit })
}

/// Returns the law of `form` with the `parameters` of a fit.
fn law(form: LoopForm, parameters: &[f64]) -> BendingLaw {
    let LoopLaw { backbone, friction, .. } = form.law(parameters);
    let backbone = match backbone {
        LoopBackbone::Line(rigidity) => BendingBackbone::Linear { rigidity },
        LoopBackbone::Varying(varying) => BendingBackbone::Varying(varying),
    };
    BendingLaw { backbone, rest_curvature: 0.0, friction }
}
