//! The report of a fit.

use drape::fit::lm::Stop;
use drape::fit::{CurveFit, Estimate, Fit, Unknown};
use drape::kes::{Curve, Direction, Sheet, Test, Values};
use drape::report::plot::{Branch, BranchKind, Correlation, LoopPlot, Point};
use drape::report::{
    FitPage, Interval, KesValue, LawReport, ModelScore, Parameter, Quantity, Statistics, Units,
};

use crate::quantity;

/// Everything that tells whether to believe a fit.
pub(crate) fn fit_page(sheet: &Sheet, fit: &Fit) -> FitPage {
    let given = |name: &str, value: Option<f64>, taken: f64, units: Units| Quantity {
        name: name.into(),
        value: value.unwrap_or(taken),
        units,
        origin: if value.is_some() { "sheet" } else { "assumed" }.into(),
    };
    let fabric = &fit.fabric;
    FitPage {
        name: sheet.name.clone(),
        source: sheet.source.clone(),
        version: concat!("drape ", env!("CARGO_PKG_VERSION")).into(),
        quantities: vec![
            given("mass per area", sheet.density(), fabric.density, quantity::mass()),
            given("thickness", sheet.thickness(), fabric.thickness, quantity::thickness()),
        ],
        laws: sheet.curves.iter().zip(&fit.curves).map(|(c, f)| law(c, f)).collect(),
        values: [Direction::Warp, Direction::Weft]
            .into_iter()
            .flat_map(|direction| values(sheet, direction))
            .collect(),
        assumed: fit.assumed.clone(),
        warnings: sheet.warnings().iter().map(ToString::to_string).collect(),
        ..FitPage::default()
    }
}

fn law(curve: &Curve, fit: &CurveFit) -> LawReport {
    let model = fit.candidates.get(fit.chosen).map_or(String::new(), |c| c.law.clone());
    let criteria = fit.candidates.iter().filter_map(|candidate| {
        Some(ModelScore {
            name: candidate.law.clone(),
            parameters: candidate.parameters,
            misfit: candidate.misfit,
            aicc: candidate.criterion?,
            chosen: candidate.law == model,
        })
    });
    let models: Vec<ModelScore> = criteria.collect();
    LawReport {
        title: title(fit),
        plots: vec![plot(curve, fit)],
        statistics: Some(Statistics {
            misfit: fit.misfit,
            rms: fit.rms,
            r_squared: fit.determination,
            points: fit.load.len(),
            iterations: fit.iterations,
            evaluations: fit.evaluations,
            converged: fit.stop.converged(),
            stop: stop(fit.stop).into(),
        }),
        models: if models.len() > 1 { models } else { Vec::new() },
        parameters: fit.parameters.iter().map(|estimate| parameter(fit.test, estimate)).collect(),
        correlation: correlation(fit),
        notes: notes(fit),
        model,
    }
}

/// The curve's name, with its direction.
fn title(fit: &CurveFit) -> String {
    let direction = fit.direction.name();
    if fit.name.contains(direction) {
        fit.name.clone()
    } else {
        format!("{}, {direction}", fit.name)
    }
}

fn parameter(test: Test, estimate: &Estimate) -> Parameter {
    let named = quantity::parameter(test, estimate.name);
    let interval = match &estimate.interval {
        Ok([lower, upper]) => Interval::Between { lower: *lower, upper: *upper },
        Err(Unknown::Fixed) => Interval::Fixed { reason: Unknown::Fixed.to_string() },
        Err(unknown) => Interval::Unknown { reason: unknown.to_string() },
    };
    Parameter {
        name: named.words.into(),
        symbol: named.symbol.into(),
        value: estimate.value,
        units: named.units,
        standard_error: estimate.error.as_ref().ok().copied(),
        interval,
        incidental: named.incidental,
    }
}

/// The matrix of the parameters that have correlations.
fn correlation(fit: &CurveFit) -> Option<Correlation> {
    let whole = |&i: &usize| fit.correlations.get(i).is_some_and(|row| row[i].is_some());
    let kept: Vec<usize> = (0..fit.parameters.len()).filter(whole).collect();
    let row =
        |&i: &usize| kept.iter().map(|&j| fit.correlations[i][j]).collect::<Option<Vec<f64>>>();
    let matrix = kept.iter().map(row).collect::<Option<Vec<_>>>()?;
    let symbol = |&i: &usize| quantity::parameter(fit.test, fit.parameters[i].name).symbol.into();
    (kept.len() > 1).then(|| Correlation { symbols: kept.iter().map(symbol).collect(), matrix })
}

/// Autocorrelation above which the residuals are said to be systematic.
const SYSTEMATIC: f64 = 0.5;

fn notes(fit: &CurveFit) -> Vec<String> {
    let mut notes = Vec::new();
    if fit.autocorrelation > SYSTEMATIC {
        notes.push(format!(
            "neighbouring residuals are alike (correlation {:.2}): the law misses the curve \
             systematically, and {} points tell as much as {:.0} independent ones; errors and \
             intervals are widened by that",
            fit.autocorrelation,
            fit.load.len(),
            fit.independent
        ));
    }
    notes
}

/// The measured and the fitted loop, branch by branch.
fn plot(curve: &Curve, fit: &CurveFit) -> LoopPlot {
    let [deformation, load] = quantity::axes(curve.test);
    let branches = curve.branches();
    let both_sides = matches!(curve.test, Test::Bending | Test::Shear);
    let first = branches.first().is_some_and(|branch| branch.rising);
    // A load equal to the measured one to the last bit marks a point that the fit left out.
    let point = |i: usize| Point {
        deformation: curve.deformation()[i],
        measured: Some(curve.load()[i]),
        fitted: Some(fit.load[i]).filter(|fitted| *fitted != curve.load()[i]),
        band: None,
    };
    let branch = |(index, branch): (usize, &drape::kes::Branch)| Branch {
        kind: match (branch.rising == first, both_sides && index > 0) {
            (true, false) => BranchKind::Loading,
            (true, true) => BranchKind::Reversal,
            (false, _) => BranchKind::Unloading,
        },
        cycle: index / 2 + 1,
        points: branch.points.clone().map(point).collect(),
    };
    LoopPlot {
        title: title(fit),
        deformation,
        load,
        branches: branches.iter().enumerate().map(branch).collect(),
    }
}

/// A KES value: symbol, words, units, and where it stands, in SI.
type Row = (&'static str, &'static str, Units, fn(&Values) -> Option<f64>);

/// The KES values of a direction, as the sheet and as the curves give them.
fn values(sheet: &Sheet, direction: Direction) -> Vec<KesValue> {
    let rows: [Row; 9] = [
        ("B", "bending rigidity", quantity::rigidity(), Values::bending_rigidity),
        ("2HB", "bending loop width", quantity::moment(), Values::bending_loop_width),
        ("G", "shear stiffness", quantity::shear_stiffness(), Values::shear_stiffness),
        ("2HG", "shear loop width at 0.5°", quantity::tension(), Values::shear_loop_width),
        (
            "2HG5",
            "shear loop width at 5°",
            quantity::tension(),
            Values::shear_loop_width_at_five_degrees,
        ),
        ("EM", "extension at the largest load", quantity::percent(), Values::tensile_extension),
        ("WT", "tensile work", quantity::work(), Values::tensile_work),
        ("LT", "tensile linearity", quantity::ratio(), Values::tensile_linearity),
        ("RT", "tensile resilience", quantity::percent(), Values::tensile_resilience),
    ];
    let given = sheet.values(direction);
    let row = |(symbol, name, units, value): Row| KesValue {
        symbol: symbol.into(),
        name: name.into(),
        direction: direction.name().into(),
        units,
        sheet: value(given),
        curve: None,
        law: None,
    };
    let known = |v: &KesValue| v.sheet.is_some() || v.curve.is_some();
    rows.into_iter().map(row).filter(known).collect()
}

/// Why a search ended, in words.
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
    }
}
