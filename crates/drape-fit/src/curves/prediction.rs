//! Prediction of the last cycle of a tensile curve by laws fitted to the cycles before it.
//!
//! `tensile` uses it to select a law; users judge extrapolation with it.

use drape_kes::{Curve, Test};

use crate::curves::features::check;
use crate::curves::tensile_form::{FittedZeros, StripKind, TensileForm};
use crate::curves::tensile_start::InitialGuess;
use crate::error::Error;
use crate::regression::residuals::{ForwardModel, Residuals};
use crate::regression::search::{multistart, refine};
use crate::regression::selection::CandidateModel;
use crate::settings::FitSettings;

/// Least relative excess of the last cycle over all cycles before it, with which its prediction is
/// a test.
const EXCESS: f64 = 0.05;

/// Last cycle of a tensile curve, predicted by a law that was fitted to the cycles before it.
#[derive(Clone, Debug, PartialEq)]
pub struct Prediction {
    /// Name of the law, in words.
    pub law: String,
    /// Root mean square residual of the fitted cycles, over the load range of the whole curve.
    pub fitted: f64,
    /// Root mean square error of the last cycle, over the load range of the whole curve.
    pub error: f64,
    /// Error at the largest load of the last cycle, over that load from the fitted zero; negative
    /// where the law is too soft.
    pub peak_error: f64,
    /// Load of the law at every point of the curve, in N/m.
    pub load: Vec<f64>,
}

/// Fits each traction law to all cycles of a tensile `curve` except the last, and predicts the last
/// cycle.
///
/// The last cycle stretches the strip more than any cycle before it. The prediction is an
/// extrapolation, and a law with only the right curvature fails it.
///
/// # Errors
/// The curve is of another test, does not rise, or its last cycle is the first or does not go
/// further.
pub fn predict_last_cycle(curve: &Curve, settings: &FitSettings) -> Result<Vec<Prediction>, Error> {
    check(curve, Test::Tensile)?;
    let curve = &*curve.prepared();
    let last = last_cycle(curve).ok_or_else(|| Error::SingleCycle { name: curve.name.clone() })?;
    // A second cycle follows a recovery.
    let strip = StripKind { zeros: FittedZeros::from_curve(curve), recovers: true };
    predict(curve, last, &TensileForm::admitted(strip, settings))
}

/// Predicts the cycle that begins at the point `last`, with each of `forms`.
pub(crate) fn predict(
    curve: &Curve,
    last: usize,
    forms: &[TensileForm],
) -> Result<Vec<Prediction>, Error> {
    let (q, load) = (&curve.deformation()[..last], &curve.load()[..last]);
    let earlier = Curve::new(Test::Tensile, curve.direction, q.to_vec(), load.to_vec());
    let mut earlier = earlier.expect("the earlier cycles move");
    (earlier.name, earlier.slack) = (curve.name.clone(), curve.slack);
    let guess = InitialGuess::new(&earlier)?;
    let mut predictions = Vec::with_capacity(forms.len());
    for form in forms {
        let CandidateModel { name, starts, forward, .. } = guess.model(*form, &earlier);
        let problem = Residuals::new(&earlier, &*forward);
        let report = refine(&problem, multistart(&problem, &starts)).report;
        let parameters = &report.parameters;
        let whole = form.forward(curve);
        let zero = if curve.slack { parameters[1] } else { 0.0 };
        let fitted = Fitted { forward: &*whole, parameters, zero };
        predictions.push(prediction(name, curve, last, &fitted));
    }
    Ok(predictions)
}

/// Law fitted to the earlier cycles, as a forward model along the whole curve.
struct Fitted<'a> {
    forward: &'a dyn ForwardModel,
    parameters: &'a [f64],
    /// Zero of the load.
    zero: f64,
}

/// Returns the prediction of `curve` from the point `last` by the law with the name `law`.
fn prediction(law: String, curve: &Curve, last: usize, fitted: &Fitted<'_>) -> Prediction {
    let mut load = vec![0.0; curve.load().len()];
    fitted.forward.loads(fitted.parameters, &mut load);
    let span = curve.load_range().span();
    let error: Vec<f64> = load.iter().zip(curve.load()).map(|(a, b)| a - b).collect();
    let [before, after] = [&error[..last], &error[last..]]
        .map(|error| (error.iter().map(|r| r * r).sum::<f64>() / error.len() as f64).sqrt());
    let largest = (last..load.len()).max_by(|&i, &j| curve.load()[i].total_cmp(&curve.load()[j]));
    let peak = largest.expect("a cycle has points");
    Prediction {
        law,
        fitted: before / span,
        error: after / span,
        peak_error: error[peak] / (curve.load()[peak] - fitted.zero),
        load,
    }
}

/// Returns the point at which the last cycle of `curve` begins, if it goes further than the cycles
/// before it.
pub(crate) fn last_cycle(curve: &Curve) -> Option<usize> {
    let branches = curve.branches();
    let last = branches.iter().rposition(|branch| branch.rising).filter(|&last| last >= 2)?;
    let start = branches[last].points.start + 1;
    let (before, after) = curve.deformation().split_at(start);
    let [before, after] =
        [before, after].map(|q| q.iter().copied().fold(f64::NEG_INFINITY, f64::max));
    let bottom = curve.deformation_range().low;
    (after - bottom > (1.0 + EXCESS) * (before - bottom)).then_some(start)
}
