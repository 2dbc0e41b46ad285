//! HTML page of the report of a fit.

use askama::Template;
use drape_input::{percent, signed_percent, significant, typeset};

use super::assets::{PAGE_SCRIPT, PAGE_STYLE};
use super::fit_page::{FitPage, KesValue, Quantity};
use super::law_report::{LawReport, Limits, ModelScore, Trust, Verdict};
use super::law_value::LawValue;
use super::shown::{Marked, ShownLawValue, ShownParameter, ShownValue};
use crate::error::Error;
use crate::parameter::Interval;
use crate::plot::{
    Placement, STYLE, UncertaintyPlot, correlation_figure, correlation_side, loop_figure,
    uncertainty_figure,
};
use crate::text::symbol::Symbol;

/// What the HTML template shows.
#[derive(Template)]
#[template(path = "page/fit.html")]
struct View<'a> {
    page: &'a FitPage,
    styles: [&'static str; 2],
    script: &'static str,
    judgement: String,
    quantities: Vec<QuantityRow<'a>>,
    laws: Vec<LawView<'a>>,
    values: Vec<ValueRow<'a>>,
    lists: Vec<List<'a>>,
    limits: [String; 3],
}

/// Quantity with its value as text.
struct QuantityRow<'a> {
    quantity: &'a Quantity,
    value: ShownValue,
}

/// List of texts with its title and class.
struct List<'a> {
    title: &'static str,
    class: &'static str,
    texts: &'a [String],
}

/// Law with its figures and texts.
struct LawView<'a> {
    law: &'a LawReport,
    verdict: Verdict,
    /// Class of the verdict.
    class: &'static str,
    plots: Vec<(&'a str, String)>,
    facts: Vec<(&'static str, String)>,
    stop: String,
    misfit: String,
    r_squared: String,
    /// Length of the bar of the misfit, in per cent. The limit lies at half of the bar.
    bar: String,
    values: Vec<LawValueRow<'a>>,
    parameters: Vec<ShownParameter<'a>>,
    uncertainty: Option<String>,
    correlation: Option<HeatMap>,
    models: Vec<ModelRow<'a>>,
}

/// Value of a law, and whether its relative error is larger than the limit.
struct LawValueRow<'a> {
    shown: ShownLawValue<'a>,
    is_wide: bool,
}

/// Heat map with its largest side, in px.
struct HeatMap {
    figure: String,
    side: f64,
}

/// Model of a comparison: misfit, AICc, AICc above the best model, weight, error of its prediction.
struct ModelRow<'a> {
    model: &'a ModelScore,
    texts: [String; 5],
}

/// KES value. The numbers in the units of the laboratory stand above the numbers in SI.
struct ValueRow<'a> {
    value: &'a KesValue,
    cells: [Option<ShownValue>; 3],
    differences: [Option<Marked>; 2],
    unit: &'a str,
    si_unit: Option<&'a str>,
}

impl FitPage {
    /// Returns the report as one self-contained HTML page: no network, no fonts, no other file.
    ///
    /// # Errors
    /// Errors of [`FitPage::check`].
    pub fn to_html(&self) -> Result<String, Error> {
        self.check()?;
        Ok(render(self))
    }
}

/// Returns the HTML of a `page` that has been checked.
fn render(page: &FitPage) -> String {
    let laws: Vec<LawView<'_>> = page.laws.iter().map(|law| law_view(law, &page.limits)).collect();
    let quantities = page.quantities.iter().map(|quantity| QuantityRow {
        quantity,
        value: ShownValue::new(quantity.value, &quantity.units),
    });
    let lists = [
        List { title: "Warnings", class: "warn", texts: &page.warnings },
        List { title: "Assumed, not measured", class: "assumed", texts: &page.assumed },
        List { title: "Repaired", class: "repaired", texts: &page.repairs },
        List { title: "Read", class: "read", texts: &page.readings },
    ];

    let view = View {
        page,
        styles: [STYLE, PAGE_STYLE],
        script: PAGE_SCRIPT,
        judgement: judgement(page, &laws),
        quantities: quantities.collect(),
        values: page.values.iter().map(|value| value_row(value, &page.limits)).collect(),
        lists: lists.into_iter().filter(|list| !list.texts.is_empty()).collect(),
        limits: [page.limits.misfit, page.limits.error, page.limits.difference].map(percent),
        laws,
    };
    view.render().expect("writing to a string does not fail")
}

/// Returns the judgement of a `page` and its `laws` in one sentence.
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

/// Returns whether a `value` differs from the curve or from the law by more than the limit of
/// `limits`.
fn differs(value: &KesValue, limits: &Limits) -> bool {
    let differences = value.differences();
    differences.iter().flatten().any(|d| d.abs() > limits.difference)
}

/// Returns the figures and texts of a `law`, which is judged by `limits`.
fn law_view<'a>(law: &'a LawReport, limits: &Limits) -> LawView<'a> {
    let verdict = law.verdict(limits);
    let statistics = law.statistics.as_ref();
    let mut facts = Vec::new();
    if let Some(s) = statistics {
        facts.push(("misfit of the range", percent(s.misfit)));
        let unit = law.load_unit();
        let rms = typeset(&significant(s.rms / unit.in_si, 3));
        facts.push(("rms residual", format!("{rms} {}", unit.name)));
        facts.push(("R²", format!("{:.5}", s.r_squared)));
        facts.push(("points", s.points.to_string()));
        facts.push(("iterations", s.iterations.to_string()));
        facts.push(("evaluations", s.evaluations.to_string()));
    }

    // Bars of uncertainty are drawn only if some parameter has an error or an interval.
    let uncertain = law.parameters.iter().any(|parameter| {
        let unknown =
            matches!(parameter.interval, Interval::Unknown { .. } | Interval::Fixed { .. });
        parameter.standard_error.is_some() || !unknown
    });

    let models = law.models.iter().zip(law.evidence());
    LawView {
        class: verdict.trust.class(),
        verdict,
        plots: law
            .plots
            .iter()
            .map(|plot| (plot.title.as_str(), loop_figure(plot, Placement::InPage)))
            .collect(),
        facts,
        stop: statistics.map_or_else(String::new, |s| s.stop.clone()),
        misfit: statistics.map_or_else(String::new, |s| percent(s.misfit)),
        r_squared: statistics.map_or_else(String::new, |s| format!("{:.4}", s.r_squared)),
        bar: statistics.map_or_else(String::new, |s| {
            let part = 50.0 * s.misfit / limits.misfit;
            format!("{:.1}", if part.is_finite() { part.clamp(0.0, 100.0) } else { 100.0 })
        }),
        values: law.values.iter().map(|value| law_value_row(value, limits)).collect(),
        parameters: law.parameters.iter().map(ShownParameter::new).collect(),
        uncertainty: uncertain.then(|| {
            let plot = UncertaintyPlot { parameters: &law.parameters };
            uncertainty_figure(&plot, Placement::InPage)
        }),
        correlation: law.correlation.as_ref().map(|correlation| {
            let figure = correlation_figure(correlation, Placement::InPage);
            HeatMap { figure, side: correlation_side(correlation) }
        }),
        models: models
            .map(|(model, evidence)| {
                let texts = [
                    percent(model.misfit),
                    typeset(&format!("{:.1}", model.aicc)),
                    format!("{:.1}", evidence.above_best),
                    format!("{:.3}", evidence.weight),
                    model.prediction.map_or_else(String::new, percent),
                ];
                ModelRow { model, texts }
            })
            .collect(),
        law,
    }
}

/// Returns the row of a `value`, which is marked if its error is beyond `limits`.
fn law_value_row<'a>(value: &'a LawValue, limits: &Limits) -> LawValueRow<'a> {
    LawValueRow { shown: ShownLawValue::new(value), is_wide: limits.is_uncertain(value) }
}

/// Returns the row of a `value`, whose differences are marked beyond `limits`.
fn value_row<'a>(value: &'a KesValue, limits: &Limits) -> ValueRow<'a> {
    let cell = |number: Option<f64>| Some(ShownValue::new(number?, &value.units));
    ValueRow {
        value,
        cells: [value.sheet, value.curve, value.law].map(cell),
        differences: value.differences().map(|difference| {
            difference.map(|ratio| {
                let apart = ratio.abs() > limits.difference;
                Marked { text: typeset(&signed_percent(ratio)), apart }
            })
        }),
        unit: value.units.first().0,
        si_unit: value.units.second(),
    }
}
