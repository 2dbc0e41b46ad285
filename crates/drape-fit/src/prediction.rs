//! What a law fitted to the first cycles of a tensile curve says of the last one.

use drape_kes::{Curve, Test};

use crate::choice::{Model, Predict};
use crate::curve_fit;
use crate::search::{Residuals, refine, search};
use crate::tensile::{Form, forms};
use crate::tensile_start::Guess;
use crate::{Error, Settings};

/// How much further than all before it the last pull must go, relative, for its prediction to say something.
const FURTHER: f64 = 0.05;

/// The last cycle of a tensile curve as a law sees it that was fitted to the cycles before.
#[derive(Clone, Debug, PartialEq)]
pub struct Prediction {
    /// The law, in words.
    pub law: String,
    /// Root mean square residual of the cycles that were fitted, over the load range of the whole curve.
    pub fitted: f64,
    /// Root mean square error of the last cycle, over the load range of the whole curve.
    pub error: f64,
    /// Error at the largest load of the last cycle, over that load from the fitted zero: negative where the law
    /// is too soft.
    pub peak_error: f64,
    /// Load at every point of the curve, in N/m.
    pub load: Vec<f64>,
}

/// Fits each traction law to all but the last cycle of a tensile curve, and predicts that cycle.
///
/// The strip is pulled further in the last cycle than ever before, so this is extrapolation: the test that a law
/// which only bends the right way does not pass.
///
/// # Errors
/// The curve is of another test, does not rise, or its last pull is not a second one that goes further.
pub fn predict_last_cycle(curve: &Curve, settings: &Settings) -> Result<Vec<Prediction>, Error> {
    curve_fit::expect(curve, Test::Tensile)?;
    let last = last_cycle(curve).ok_or_else(|| Error::OneCycle { name: curve.name.clone() })?;
    // Before a second pull there was a way back.
    predict(curve, last, &forms(curve.slack, true, settings))
}

/// The predictions of some forms.
pub(crate) fn predict(
    curve: &Curve,
    last: usize,
    forms: &[Form],
) -> Result<Vec<Prediction>, Error> {
    let (q, load) = (&curve.deformation()[..last], &curve.load()[..last]);
    let earlier = Curve::new(Test::Tensile, curve.direction, q.to_vec(), load.to_vec());
    let mut earlier = earlier.expect("the earlier cycles move");
    (earlier.name, earlier.slack) = (curve.name.clone(), curve.slack);
    let guess = Guess::new(&earlier)?;
    let of = |form: &Form| {
        let Model { name, starts, predict, .. } = form.model(&earlier, &guess);
        let problem = Residuals::new(&earlier, &*predict);
        let report = refine(&problem, search(&problem, &starts)).report;
        let zero = if curve.slack { report.parameters[1] } else { 0.0 };
        prediction((curve, last), name, (&*form.along(curve), &report.parameters, zero))
    };
    Ok(forms.iter().map(of).collect())
}

fn prediction(
    (curve, last): (&Curve, usize),
    law: String,
    (predict, p, zero): (&dyn Predict, &[f64], f64),
) -> Prediction {
    let mut load = vec![0.0; curve.load().len()];
    predict.loads(p, &mut load);
    let (low, high) = curve.load_range();
    let off: Vec<f64> = load.iter().zip(curve.load()).map(|(a, b)| a - b).collect();
    let rms = |off: &[f64]| (off.iter().map(|r| r * r).sum::<f64>() / off.len() as f64).sqrt();
    let largest = (last..load.len()).max_by(|&i, &j| curve.load()[i].total_cmp(&curve.load()[j]));
    let peak = largest.expect("a cycle has points");
    Prediction {
        law,
        fitted: rms(&off[..last]) / (high - low),
        error: rms(&off[last..]) / (high - low),
        peak_error: off[peak] / (curve.load()[peak] - zero),
        load,
    }
}

/// Where the last cycle begins, if it goes further than those before.
pub(crate) fn last_cycle(curve: &Curve) -> Option<usize> {
    let branches = curve.branches();
    let last = branches.iter().rposition(|branch| branch.rising).filter(|&last| last >= 2)?;
    let start = branches[last].points.start + 1;
    let top = |q: &[f64]| q.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let (before, after) = curve.deformation().split_at(start);
    let bottom = curve.deformation_range().0;
    (top(after) - bottom > (1.0 + FURTHER) * (top(before) - bottom)).then_some(start)
}
