//! The report of a fit as a page.

use askama::Template;

use crate::fit_page::{FitPage, KesValue, Quantity};
use crate::fit_text::signed_percent;
use crate::law_report::{LawReport, Limits, ModelScore, Trust, Verdict};
use crate::number::{percent, significant, typeset};
use crate::parameter::Interval;
use crate::plot::{
    Place, UncertaintyPlot, correlation_figure, correlation_side, loop_figure, uncertainty_figure,
};
use crate::shown::{Shown, ShownParameter};
use crate::symbol::Symbol;

/// What every page brings along.
pub(crate) const PAGE_STYLE: &str = include_str!("../templates/page.css");
/// Values under the pointer and branches switched on and off; the page is complete without.
pub(crate) const PAGE_SCRIPT: &str = include_str!("../templates/page.js");

#[derive(Template)]
#[template(path = "fit.html")]
struct View<'a> {
    page: &'a FitPage,
    styles: [&'static str; 2],
    script: &'static str,
    judgement: String,
    quantities: Vec<(&'a Quantity, Option<Shown>, Shown)>,
    laws: Vec<LawView<'a>>,
    values: Vec<ValueRow<'a>>,
    lists: Vec<(&'static str, &'static str, &'a [String])>,
    limits: [String; 3],
}

struct LawView<'a> {
    law: &'a LawReport,
    verdict: Verdict,
    /// The class of the verdict.
    class: &'static str,
    plots: Vec<(&'a str, String)>,
    facts: Vec<(&'static str, String)>,
    stop: String,
    misfit: String,
    r_squared: String,
    /// Length of the misfit's bar in per cent; the limit lies at half.
    bar: String,
    parameters: Vec<ShownParameter<'a>>,
    uncertainty: Option<String>,
    /// The heat map with its width in px, beyond which it is not stretched.
    correlation: Option<(String, f64)>,
    models: Vec<(&'a ModelScore, [String; 4])>,
}

/// A KES value: the laboratory's numbers above, SI beneath.
struct ValueRow<'a> {
    value: &'a KesValue,
    cells: [Option<(Shown, Option<Shown>)>; 3],
    differences: [Option<(String, bool)>; 2],
    unit: &'a str,
    si_unit: Option<&'a str>,
}

pub(crate) fn render(page: &FitPage) -> String {
    let laws: Vec<LawView<'_>> = page.laws.iter().map(|law| law_view(law, &page.limits)).collect();
    let quantities = page.quantities.iter().map(|quantity| {
        let (kes, si) = Shown::both(quantity.value, &quantity.units);
        (quantity, kes, si)
    });
    let lists: [(&str, &str, &[String]); 3] = [
        ("Warnings", "warn", &page.warnings),
        ("Assumed, not measured", "assumed", &page.assumed),
        ("Repaired", "repaired", &page.repairs),
    ];
    let view = View {
        page,
        styles: [crate::plot::STYLE, PAGE_STYLE],
        script: PAGE_SCRIPT,
        judgement: judgement(page, &laws),
        quantities: quantities.collect(),
        values: page.values.iter().map(|value| value_row(value, &page.limits)).collect(),
        lists: lists.into_iter().filter(|(_, _, texts)| !texts.is_empty()).collect(),
        limits: [page.limits.misfit, page.limits.error, page.limits.difference].map(percent),
        laws,
    };
    view.render().expect("writing to a string does not fail")
}

/// The report in one sentence.
fn judgement(page: &FitPage, laws: &[LawView<'_>]) -> String {
    let count = |trust: Trust| laws.iter().filter(|law| law.verdict.trust == trust).count();
    let judged = laws.len() - count(Trust::Unjudged);
    let mut parts = Vec::new();
    if judged > 0 {
        parts.push(format!("{} of {judged} fitted laws are good", count(Trust::Good)));
    }
    for (trust, word) in [(Trust::Doubtful, "doubtful"), (Trust::Poor, "poor")] {
        if count(trust) > 0 {
            parts.push(format!("{} {word}", count(trust)));
        }
    }
    let apart = page.values.iter().filter(|value| differs(value, &page.limits)).count();
    if apart > 0 {
        let noun = if apart == 1 { "value differs" } else { "values differ" };
        parts.push(format!("{apart} KES {noun} from the curves"));
    }
    let assumed = page.assumed.len();
    if assumed > 0 {
        let noun = if assumed == 1 { "assumption" } else { "assumptions" };
        parts.push(format!("{assumed} {noun}"));
    }
    if parts.is_empty() {
        "Nothing was fitted; the numbers are as given.".to_owned()
    } else {
        parts.join(", ") + "."
    }
}

fn differs(value: &KesValue, limits: &Limits) -> bool {
    let differences = value.differences();
    differences.iter().flatten().any(|d| d.abs() > limits.difference)
}

fn law_view<'a>(law: &'a LawReport, limits: &Limits) -> LawView<'a> {
    let verdict = law.verdict(limits);
    let statistics = law.statistics.as_ref();
    let mut facts = Vec::new();
    if let Some(s) = statistics {
        facts.push(("misfit of the range", percent(s.misfit)));
        let (unit, in_si) = law.load_unit();
        let rms = typeset(&significant(s.rms / in_si, 3));
        facts.push(("rms residual", format!("{rms} {unit}")));
        facts.push(("R²", format!("{:.5}", s.r_squared)));
        facts.push(("points", s.points.to_string()));
        facts.push(("iterations", s.iterations.to_string()));
        facts.push(("evaluations", s.evaluations.to_string()));
    }
    let uncertain = law.parameters.iter().any(|parameter| {
        let unknown =
            matches!(parameter.interval, Interval::Unknown { .. } | Interval::Fixed { .. });
        parameter.standard_error.is_some() || !unknown
    });
    let models = law.models.iter().zip(law.evidence());
    LawView {
        class: match verdict.trust {
            Trust::Unjudged => "unjudged",
            Trust::Good => "good",
            Trust::Doubtful => "doubtful",
            Trust::Poor => "poor",
        },
        verdict,
        plots: law
            .plots
            .iter()
            .map(|plot| (plot.title.as_str(), loop_figure(plot, Place::InPage)))
            .collect(),
        facts,
        stop: statistics.map_or_else(String::new, |s| s.stop.clone()),
        misfit: statistics.map_or_else(String::new, |s| percent(s.misfit)),
        r_squared: statistics.map_or_else(String::new, |s| format!("{:.4}", s.r_squared)),
        bar: statistics.map_or_else(String::new, |s| {
            let part = 50.0 * s.misfit / limits.misfit;
            format!("{:.1}", if part.is_finite() { part.clamp(0.0, 100.0) } else { 100.0 })
        }),
        parameters: law.parameters.iter().map(ShownParameter::new).collect(),
        uncertainty: uncertain.then(|| {
            let plot = UncertaintyPlot { parameters: &law.parameters };
            uncertainty_figure(&plot, Place::InPage)
        }),
        correlation: law.correlation.as_ref().map(|correlation| {
            let figure = correlation_figure(correlation, Place::InPage);
            (figure, correlation_side(correlation))
        }),
        models: models
            .map(|(model, (above, weight))| {
                let texts = [
                    percent(model.misfit),
                    typeset(&format!("{:.1}", model.aicc)),
                    format!("{above:.1}"),
                    format!("{weight:.3}"),
                ];
                (model, texts)
            })
            .collect(),
        law,
    }
}

fn value_row<'a>(value: &'a KesValue, limits: &Limits) -> ValueRow<'a> {
    let cell = |number: Option<f64>| {
        number.map(|number| match Shown::both(number, &value.units) {
            (Some(kes), si) => (kes, Some(si)),
            (None, si) => (si, None),
        })
    };
    let kes = value.units.kes.as_ref();
    ValueRow {
        value,
        cells: [value.sheet, value.curve, value.law].map(cell),
        differences: value.differences().map(|difference| {
            difference.map(|ratio| {
                let apart = ratio.abs() > limits.difference;
                (typeset(&signed_percent(ratio)), apart)
            })
        }),
        unit: kes.map_or(&value.units.si, |unit| &unit.name),
        si_unit: kes.map(|_| value.units.si.as_str()),
    }
}
