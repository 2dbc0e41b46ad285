//! Report of a fit: every law with its loop, its parameters and their intervals, and the
//! assumptions.

use drape_fit::{Choice, CurveFit, Estimate, Fit, FitSettings};
use drape_kes::{Curve, Sheet, Test};
use drape_lm::Stop;
use drape_report::plot::{Correlation, LoopPlot};
use drape_report::{FitPage, LawReport, ModelScore, Parameter, Quantity, Statistics, Units};

use super::VERSION;
use super::interval::{interval, is_shown};
use super::kes_value::{self, SheetValues};
use super::loop_plot::{Loads, loop_plot};
use super::quantity;
use super::sheet_value::{self, CheckedValue};
use super::value_law::value_laws;

/// Returns the report of a `fit` to a `sheet`, with everything that is needed to judge the fit.
#[must_use]
pub fn fit_page(sheet: &Sheet, fit: &Fit, settings: &FitSettings) -> FitPage {
    let given = |name: &str, value: Option<f64>, taken: f64, units: Units| Quantity {
        name: name.into(),
        value: value.unwrap_or(taken),
        units,
        origin: if value.is_some() { "sheet" } else { "assumed" }.into(),
    };

    let fabric = &fit.fabric;
    let of_curves = sheet.curves.iter().zip(&fit.curves).map(|(c, f)| curve_law(c, f));
    let of_values = value_laws(sheet, fit, settings).into_iter().map(|value_law| value_law.law);
    let SheetValues { values, warnings } = kes_value::of_sheet(sheet, fabric, settings);

    FitPage {
        name: sheet.name.clone(),
        source: sheet.source.clone(),
        version: VERSION.into(),
        quantities: vec![
            given("mass per area", sheet.density(), fabric.density, quantity::mass()),
            given("thickness", sheet.thickness(), fabric.thickness, quantity::thickness()),
        ],
        laws: of_curves.chain(of_values).collect(),
        readings: sheet.readings().to_vec(),
        values,
        assumed: fit.assumed.clone(),
        warnings: sheet
            .warnings()
            .iter()
            .map(ToString::to_string)
            .chain(unusual_shear(sheet))
            .chain(warnings)
            .collect(),
        ..FitPage::default()
    }
}

/// Returns a warning for each shear stiffness of a `sheet` that few fabrics of its mass per area
/// have. The sheet itself warns about mass and bending.
fn unusual_shear(sheet: &Sheet) -> Vec<String> {
    let values = sheet_value::sheet_values(sheet);
    let unusual =
        values.iter().filter(|value| value.symbol == "G" && value.is_usual == Some(false));
    unusual.filter_map(CheckedValue::warning).collect()
}

/// Returns the report of the law of a `curve`.
pub(super) fn curve_law(curve: &Curve, fit: &CurveFit) -> LawReport {
    let model = fit.candidates.get(fit.chosen).map_or(String::new(), |c| c.law.clone());
    let criteria = fit.candidates.iter().filter_map(|candidate| {
        Some(ModelScore {
            name: candidate.law.clone(),
            parameters: candidate.parameters,
            misfit: candidate.misfit,
            aicc: candidate.criterion?,
            prediction: candidate.prediction,
            chosen: candidate.law == model,
        })
    });
    let models: Vec<ModelScore> = criteria.collect();

    // A single candidate is no comparison.
    LawReport {
        title: title(fit),
        plots: vec![plot(curve, fit)],
        statistics: Some(Statistics {
            misfit: fit.misfit,
            rms: fit.rms,
            r_squared: fit.r_squared,
            points: fit.load.len(),
            iterations: fit.iterations,
            evaluations: fit.evaluations,
            converged: fit.stop.converged(),
            stop: stop(fit.stop).into(),
        }),
        models: if models.len() > 1 { models } else { Vec::new() },
        values: fit.values.iter().map(kes_value::of_law).collect(),
        parameters: fit.parameters.iter().map(|estimate| parameter(fit.test, estimate)).collect(),
        correlation: correlation(fit),
        notes: notes(fit),
        model,
    }
}

/// Returns the name of the curve of a `fit` with its direction.
fn title(fit: &CurveFit) -> String {
    let direction = fit.direction.name();
    if fit.name.contains(direction) {
        fit.name.clone()
    } else {
        format!("{}, {direction}", fit.name)
    }
}

/// Returns the parameter of the law of a `test` with its `estimate`.
fn parameter(test: Test, estimate: &Estimate) -> Parameter {
    let named = quantity::parameter(test, estimate.name);
    Parameter {
        name: named.words.into(),
        symbol: named.symbol.into(),
        value: estimate.value,
        standard_error: estimate.standard_error.as_ref().ok().copied().filter(is_shown),
        interval: interval(&estimate.interval, 1.0),
        units: named.units,
        incidental: named.incidental,
    }
}

/// Returns the correlations of the parameters of a `fit` that have correlations with all others.
fn correlation(fit: &CurveFit) -> Option<Correlation> {
    let whole = |&i: &usize| fit.correlations.get(i).is_some_and(|row| row[i].is_some());
    let kept: Vec<usize> = (0..fit.parameters.len()).filter(whole).collect();
    let row =
        |&i: &usize| kept.iter().map(|&j| fit.correlations[i][j]).collect::<Option<Vec<f64>>>();
    let matrix = kept.iter().map(row).collect::<Option<Vec<_>>>()?;
    let symbol = |&i: &usize| quantity::parameter(fit.test, fit.parameters[i].name).symbol.into();
    (kept.len() > 1).then(|| Correlation { symbols: kept.iter().map(symbol).collect(), matrix })
}

/// Autocorrelation above which the residuals are called systematic.
const SYSTEMATIC: f64 = 0.5;

/// Returns the notes on a `fit`: remarks, the choice of the law, repeats and systematic residuals.
fn notes(fit: &CurveFit) -> Vec<String> {
    let mut notes = fit.remarks.clone();
    notes.extend(preference(fit));
    if fit.repeats > 0 {
        notes.push(format!(
            "the mean of {} repeats; their scatter is in the errors of the parameters",
            fit.repeats
        ));
    }
    if fit.autocorrelation > SYSTEMATIC {
        notes.push(format!(
            "neighbouring residuals are alike (correlation {:.2}): the law misses the curve \
             systematically, and {} points tell as much as {:.0} independent ones; errors and \
             intervals are widened by that",
            fit.autocorrelation,
            fit.load.len(),
            fit.effective_points
        ));
    }
    notes
}

/// Returns the reason why the law of a `fit` was chosen, `None` if there was no choice.
fn preference(fit: &CurveFit) -> Option<String> {
    let chosen = fit.candidates.get(fit.chosen)?;
    (fit.choice != Choice::Only).then(|| format!("taken: {}; {}", chosen.law, fit.choice))
}

/// Returns the plot of the measured `curve` and the loop of its `fit`.
fn plot(curve: &Curve, fit: &CurveFit) -> LoopPlot {
    let half_range = 0.5 * curve.load_range().span();
    // A load that equals the measured load to the last bit marks a point that the fit left out. A
    // band that is wider than its loop would say nothing and hide the loop.
    loop_plot(title(fit), curve, |i| {
        let measured = curve.load()[i];
        let fitted = Some(fit.load[i]).filter(|fitted| *fitted != measured);
        let width = fit.band.get(i).filter(|width| **width <= half_range);
        let band = fitted.zip(width).map(|(fitted, width)| [fitted - width, fitted + width]);
        Loads { measured: Some(measured), fitted, band }
    })
}

/// Returns the reason `stop` why a search ended, in words.
fn stop(stop: Stop) -> &'static str {
    match stop {
        Stop::Reduction => "the sum of squares no longer falls",
        Stop::Step => "the parameters no longer move",
        Stop::Gradient => "no change of the parameters helps",
        Stop::Exact => "no residual is left",
        Stop::Stalled => "no step helps",
        Stop::Iterations => "the limit on iterations was reached",
        Stop::NotFinite => "the starting values give no finite load",
        Stop::Empty => "there is nothing to fit",
        Stop::Invalid { .. } => "a start, a bound or a weight is invalid",
        Stop::Interrupted => "the search was interrupted",
    }
}
