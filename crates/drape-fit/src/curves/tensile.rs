//! Traction law from a tensile curve.

use drape_fabric::TractionLaw;
use drape_kes::{Curve, Test};

use crate::curves::features::check;
use crate::curves::prediction::{last_cycle, predict};
use crate::curves::remark::remarks;
use crate::curves::tensile_form::{FittedZeros, StripKind, TensileForm};
use crate::curves::tensile_start::InitialGuess;
use crate::curves::value_estimate::{largest_load, value_estimates};
use crate::error::Error;
use crate::regression::curve_fit::{COMPARED_POINTS, CurveFit, FitOptions, Identified, fit_curve};
use crate::regression::functional::tensile_functionals;
use crate::regression::repeats::with_scatter;
use crate::regression::selection::{CandidateModel, select};
use crate::settings::FitSettings;
use crate::values::of_law::tensile_values;

/// Identifies the traction law of one direction from a tensile `curve`, along its whole history.
///
/// Points after a break are removed, and the path of the strain is freed from noise
/// ([`Curve::prepared`]). For a strip that hung slack, the strain at which it becomes taut and the
/// zero of the force are fitted too. For a test that begins under a pretension, the strain at which
/// the strip carries no load is fitted. A curve without recovery determines neither friction nor
/// changes of the stretched fabric: its law has no friction, and a toe that does not move.
///
/// If the last cycle goes further than the cycles before it, a law is selected only if it also
/// predicts the last cycle better than the laws of higher preference
/// ([`predict_last_cycle`](fn@crate::curves::prediction::predict_last_cycle)). A toe that moves
/// fits any two cycles better, because it compensates for the constant stiffness of the line, and
/// may then miss the third cycle by more.
///
/// # Errors
/// The curve is of another test, has no load, does not rise, or has fewer points than the law has
/// parameters.
pub fn identify_tensile(
    curve: &Curve,
    settings: &FitSettings,
) -> Result<Identified<TractionLaw>, Error> {
    check(curve, Test::Tensile)?;
    let curve = &*curve.prepared();
    let compared = &*curve.thinned(COMPARED_POINTS);
    let guess = InitialGuess::new(compared)?;
    let strip = StripKind { zeros: FittedZeros::from_curve(curve), recovers: guess.recovers };
    let forms = TensileForm::admitted(strip, settings);
    let predicted = prediction_errors(compared, &forms);
    let models: Vec<CandidateModel<'_>> = forms
        .iter()
        .zip(&predicted)
        .map(|(form, prediction)| CandidateModel {
            prediction: *prediction,
            ..guess.model(*form, compared)
        })
        .collect();

    let weights = settings.weighting.weights(curve, guess.zero.strain);
    let functionals = tensile_functionals(curve);
    let options = FitOptions { weights, functionals, intervals: settings.intervals };
    let fit = fit_curve(
        curve,
        select(compared, &models)?,
        |chosen| forms[chosen].forward(curve),
        options,
    );
    let form = forms[fit.chosen];
    let fit = with_values(curve, fit, form, settings);
    let fit = with_scatter(curve, fit, |repeat| identify_form(repeat, form, settings));
    Ok(Identified { law: form.law(&fit.parameter_values()), fit })
}

/// Returns `fit` with the KES values of its law and with remarks.
fn with_values(
    curve: &Curve,
    mut fit: CurveFit,
    form: TensileForm,
    settings: &FitSettings,
) -> CurveFit {
    let load = largest_load(curve);
    fit.values = value_estimates(curve, &fit, settings, |p| tensile_values(&form.law(p), load));
    fit.remarks = remarks(curve, &fit, settings);
    fit
}

/// Returns the fit of `form` to one of several repeats.
fn identify_form(
    curve: &Curve,
    form: TensileForm,
    settings: &FitSettings,
) -> Result<CurveFit, Error> {
    let compared = &*curve.thinned(COMPARED_POINTS);
    let guess = InitialGuess::new(compared)?;
    let weights = settings.weighting.weights(curve, guess.zero.strain);
    let functionals = tensile_functionals(curve);
    let options = FitOptions { weights, functionals, intervals: settings.intervals };
    let models = [guess.model(form, compared)];
    let fit = fit_curve(curve, select(compared, &models)?, |_| form.forward(curve), options);
    Ok(with_values(curve, fit, form, settings))
}

/// Returns the errors with which `forms` predict the last cycle. Without a last cycle, or with one
/// form, all are `None`.
fn prediction_errors(curve: &Curve, forms: &[TensileForm]) -> Vec<Option<f64>> {
    let last = last_cycle(curve).filter(|_| forms.len() > 1);
    // Earlier cycles that give no law select no law.
    let found = last.and_then(|last| predict(curve, last, forms).ok());
    match found {
        Some(found) => found.iter().map(|prediction| Some(prediction.error)).collect(),
        None => vec![None; forms.len()],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use drape_fabric::{BlimanSorine, Buckling, Primed, TractionBackbone};
    use drape_kes::Direction;

    use crate::forward::strip_drive::drive_slack_strip;
    use crate::settings::model::TractionModel;

    fn primed() -> FitSettings {
        FitSettings { traction: Some(TractionModel::Primed), ..FitSettings::default() }
    }

    /// Three growing cycles of a strip that hangs slack by 2 % between them.
    fn clamps(top: f64) -> Vec<f64> {
        let reversals = [-0.02, 0.6 * top, -0.02, 0.8 * top, -0.02, top, -0.02];
        let steps = 60;
        let branch = |ends: &[f64]| {
            let (from, to) = (ends[0], ends[1]);
            (0..steps).map(move |i| from + (to - from) * f64::from(i) / f64::from(steps))
        };
        reversals.windows(2).flat_map(branch).collect()
    }

    #[test]
    fn a_slack_strip_gives_its_law_and_both_of_its_zeros() {
        for (toe_ratio, toe, growth) in [(0.55, 0.02, 1.3), (0.7, 0.012, 1.6), (0.8, 0.025, 1.15)] {
            let (top, free_strain, zero) = (0.04, 0.003, 0.4);
            let exact = TractionLaw {
                backbone: TractionBackbone::Primed(Primed {
                    stiffness: 6e3,
                    toe_ratio,
                    toe_strain: toe,
                    toe_strain_after: growth * toe,
                }),
                friction: BlimanSorine::first_order(4.0, 0.002).expect("a friction").into(),
                buckling: Buckling::default(),
            };
            let taut = clamps(top);
            let mut load = vec![0.0; taut.len()];
            drive_slack_strip(&exact, taut.iter().copied(), &mut load);
            let load = load.iter().map(|load| load + zero).collect();
            let strain = taut.iter().map(|strain| strain + free_strain).collect();
            let mut curve = Curve::new(Test::Tensile, Direction::Warp, strain, load).unwrap();
            curve.slack = true;
            let found = identify_tensile(&curve, &primed()).unwrap();
            let truth = [free_strain, zero, 6e3, toe_ratio, toe, growth, 4.0, 0.002];
            for (estimate, exact) in found.fit.parameters.iter().zip(truth) {
                let (name, value) = (estimate.name, estimate.value);
                let error = (value / exact - 1.0).abs();
                assert!(error < 1e-6, "{name} is {value:e}, exactly {exact:e}; {:?}", found.fit);
            }
        }
    }

    #[test]
    fn a_strip_in_compression_is_refused() {
        let strain = vec![-0.04, -0.03, -0.02, -0.01];
        let load = vec![-4.0, -3.0, -2.0, -1.0];
        let curve = Curve::new(Test::Tensile, Direction::Weft, strain, load).unwrap();
        let result = identify_tensile(&curve, &primed());
        assert!(matches!(result, Err(Error::FallingLoad { .. })), "{result:?}");
    }

    #[test]
    fn a_curve_without_recovery_gives_no_friction_and_a_toe_that_does_not_move() {
        let strain: Vec<f64> = (0..=50).map(|i| 0.001 * f64::from(i)).collect();
        let load = strain.iter().map(|e| 4e3 * e + 5e4 * e * e).collect();
        let curve = Curve::new(Test::Tensile, Direction::Weft, strain, load).unwrap();
        let law = identify_tensile(&curve, &primed()).unwrap().law;
        assert!(law.friction.is_none(), "{law:?}");
        let TractionBackbone::Primed(primed) = law.backbone else { panic!("primed was asked for") };
        assert_eq!(primed.toe_strain, primed.toe_strain_after);
    }
}
