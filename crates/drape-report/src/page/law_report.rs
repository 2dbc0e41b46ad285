//! Report of one fitted law, and its judgement.

use drape_input::percent;
use serde::Serialize;

use super::law_value::LawValue;
use crate::check;
use crate::error::Error;
use crate::parameter::Parameter;
use crate::plot::{Correlation, LoopPlot};

/// Report of a fitted law: its curves, its misfit and its parameters.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct LawReport {
    /// Title, as in "tensile, warp".
    pub title: String,
    /// Law in words, as in "priming zone and line, friction of first order".
    pub model: String,
    /// Curves with the loads of the law. Tests that were fitted together have several curves.
    pub plots: Vec<LoopPlot>,
    /// Statistics of the fit. `None` where the law was set from values.
    pub statistics: Option<Statistics>,
    /// KES values of the law. Empty for a test without KES values.
    pub values: Vec<LawValue>,
    /// Models that were compared. Empty where there was no choice.
    pub models: Vec<ModelScore>,
    /// Parameters, fitted or not.
    pub parameters: Vec<Parameter>,
    /// Correlations between the fitted parameters.
    pub correlation: Option<Correlation>,
    /// Notes on this law.
    pub notes: Vec<String>,
}

/// Statistics of a fit and of its search.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Statistics {
    /// Root mean square residual over the range of the measured load, a ratio.
    pub misfit: f64,
    /// Root mean square residual, in the SI unit of the load.
    pub rms: f64,
    /// Coefficient of determination: fraction of the variance that the law explains, at most 1.
    pub r_squared: f64,
    /// Number of measured points.
    pub points: usize,
    /// Number of iterations of the search.
    pub iterations: usize,
    /// Number of evaluations of the law along the whole history.
    pub evaluations: usize,
    /// Whether the search ended at a minimum.
    pub converged: bool,
    /// Reason why the search ended, in words: "the sum of squares no longer falls".
    pub stop: String,
}

/// Model in a comparison.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct ModelScore {
    /// Model in words.
    pub name: String,
    /// Number of fitted parameters of the model.
    pub parameters: usize,
    /// Root mean square residual over the range of the measured load, a ratio.
    pub misfit: f64,
    /// Akaike's information criterion, corrected for the number of points (AICc). The model with
    /// the smallest criterion is the best one.
    pub aicc: f64,
    /// Root mean square error of its prediction of the last cycle from all others, over the range
    /// of the measured load, a ratio; `None` where that was not tried.
    pub prediction: Option<f64>,
    /// Whether the report describes this model.
    pub chosen: bool,
}

/// Limits beyond which a report marks a number.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Limits {
    /// Largest misfit of a law that counts as good, a ratio.
    pub misfit: f64,
    /// Largest relative standard error of a parameter that counts as known, a ratio. The limit
    /// applies to tests without KES values.
    pub error: f64,
    /// Largest relative difference between a value of a sheet and a recomputed value, a ratio. The
    /// limit is also the largest relative error of a value of a law that counts as known.
    pub difference: f64,
    /// Correlation above which pairs of parameters are listed.
    pub correlation: f64,
}

impl Limits {
    /// Returns whether the relative error of a `value` of a law is unknown or larger than
    /// `difference`.
    pub(super) fn is_uncertain(&self, value: &LawValue) -> bool {
        value.relative_error().is_none_or(|error| error > self.difference)
    }
}

impl Default for Limits {
    /// Returns the usual limits.
    ///
    /// A misfit of 2 % is the residual error of the law on woven fabrics \[NB04\]. Repeated KES
    /// tests of one fabric scatter by some 5 %. An error of a quarter leaves one digit. A
    /// correlation below a half hardly widens an interval.
    fn default() -> Limits {
        Limits { misfit: 0.02, error: 0.25, difference: 0.05, correlation: 0.5 }
    }
}

/// Judgement of a fitted law.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Trust {
    /// Set from values or defaults. There is no curve for a judgement.
    Unjudged,
    /// The law follows its curves, and its KES values are known.
    Good,
    /// The law follows its curves, but some KES values are not known, or its misfit is up to twice
    /// the limit.
    Doubtful,
    /// The law does not follow its curves, or the search did not end at a minimum.
    Poor,
}

impl Trust {
    /// Returns the judgement in words, as in `good`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Unjudged => "not judged",
            Self::Good => "good",
            Self::Doubtful => "doubtful",
            Self::Poor => "poor",
        }
    }

    /// Returns the class of the judgement in the style sheets, as in `good`.
    pub(super) fn class(self) -> &'static str {
        match self {
            Self::Unjudged => "unjudged",
            Self::Good => "good",
            Self::Doubtful => "doubtful",
            Self::Poor => "poor",
        }
    }
}

/// Judgement with its reasons.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Verdict {
    /// Judgement.
    pub trust: Trust,
    /// Reasons against the law. Empty if there are no reasons.
    pub reasons: Vec<String>,
}

impl LawReport {
    /// Judges the law against `limits` by its search, its misfit and its KES values.
    ///
    /// A law of a test without KES values is judged by its parameters instead. Parameters do not
    /// count for other tests, because two parameters can be uncertain together although the loads
    /// are certain.
    #[must_use]
    pub fn verdict(&self, limits: &Limits) -> Verdict {
        let Some(statistics) = &self.statistics else {
            return Verdict {
                trust: Trust::Unjudged,
                reasons: vec!["set from values, not from a curve".to_owned()],
            };
        };

        let mut grounds = Vec::new();
        if !statistics.converged {
            grounds.push((Trust::Poor, format!("the search did not end: {}", statistics.stop)));
        }

        let misfit = statistics.misfit;
        if misfit > limits.misfit {
            let level = if misfit > 2.0 * limits.misfit { Trust::Poor } else { Trust::Doubtful };
            let (misfit, limit) = (percent(misfit), percent(limits.misfit));
            let reason = "no law of the set follows this curve";
            grounds.push((level, format!("{reason}: misfit {misfit}, more than {limit}")));
        }

        let doubts = if self.values.is_empty() {
            self.parameter_doubts(limits)
        } else {
            self.value_doubts(limits)
        };
        grounds.extend(doubts.into_iter().map(|reason| (Trust::Doubtful, reason)));
        Verdict {
            trust: grounds.iter().map(|(trust, _)| *trust).fold(Trust::Good, Trust::max),
            reasons: grounds.into_iter().map(|(_, reason)| reason).collect(),
        }
    }

    /// Returns the doubts about KES values: the values that the curve does not determine, and the
    /// values whose error is beyond `limits`.
    fn value_doubts(&self, limits: &Limits) -> Vec<String> {
        let (known, vague): (Vec<&LawValue>, Vec<&LawValue>) =
            self.values.iter().partition(|value| value.is_determined());
        let symbols: Vec<&str> = vague.iter().map(|value| value.symbol.as_str()).collect();
        let vague = format!("not determined by this curve: {}", symbols.join(", "));
        let error = |value: &&LawValue| Some((value.symbol.clone(), value.relative_error()?));
        let errors = known.iter().filter_map(error);

        let wide: Vec<String> = errors
            .filter(|(_, error)| *error > limits.difference)
            .map(|(symbol, error)| format!("{symbol} (to {})", percent(error)))
            .collect();
        let limit = percent(limits.difference);
        let wide_text = format!("not known to {limit}: {}", wide.join(", "));

        let present = [(!symbols.is_empty(), vague), (!wide.is_empty(), wide_text)];
        present.into_iter().filter(|(there, _)| *there).map(|(_, text)| text).collect()
    }

    /// Returns the doubts about parameters of the fabric: parameters without an interval, and
    /// parameters whose standard error is beyond `limits`.
    fn parameter_doubts(&self, limits: &Limits) -> Vec<String> {
        let symbols = |unknown: &dyn Fn(&&Parameter) -> bool| -> Option<String> {
            let of_the_fabric = self.parameters.iter().filter(|parameter| !parameter.incidental);
            let found = of_the_fabric.filter(unknown);
            let found: Vec<String> = found.map(|parameter| self.named(&parameter.symbol)).collect();
            (!found.is_empty()).then(|| found.join(", "))
        };
        let vague = |parameter: &&Parameter| {
            let error = parameter.relative_error();
            !parameter.is_undetermined() && error.is_some_and(|error| error > limits.error)
        };
        let missing = symbols(&|parameter| parameter.is_undetermined())
            .map(|symbols| format!("no 95 % interval for {symbols}"));
        let vague = symbols(&vague)
            .map(|symbols| format!("standard error above {} for {symbols}", percent(limits.error)));
        missing.into_iter().chain(vague).collect()
    }

    /// Returns a `symbol` with the name of its parameter, as in "k_b (bending rigidity)".
    #[must_use]
    pub fn named(&self, symbol: &str) -> String {
        match self.parameters.iter().find(|parameter| parameter.symbol == symbol) {
            Some(parameter) => format!("{symbol} ({})", parameter.name),
            None => symbol.to_owned(),
        }
    }

    /// Returns the unit of the loads, a [`LoadUnit`]. It is the unit of the first plot.
    pub(crate) fn load_unit(&self) -> LoadUnit<'_> {
        let axis = self.plots.first().map(|plot| &plot.load);
        axis.map_or(LoadUnit { name: "", in_si: 1.0 }, |axis| LoadUnit {
            name: &axis.unit,
            in_si: axis.in_si,
        })
    }

    /// Refuses numbers that are not finite, and plots without points, as [`Error`].
    ///
    /// # Errors
    /// The first fault.
    pub fn check(&self) -> Result<(), Error> {
        let title = &self.title;
        check::text("the title of a law", title)?;
        check::text(&format!("{title}: the model"), &self.model)?;
        for note in &self.notes {
            check::text(&format!("{title}: a note"), note)?;
        }
        for plot in &self.plots {
            plot.check()?;
        }

        let number = |what: &str, value: f64| check::number(|| format!("{title}: {what}"), value);
        if let Some(statistics) = &self.statistics {
            number("the misfit", statistics.misfit)?;
            number("the rms residual", statistics.rms)?;
            number("R²", statistics.r_squared)?;
            check::text(&format!("{title}: the reason for stopping"), &statistics.stop)?;
        }

        for value in &self.values {
            value.check()?;
        }

        for model in &self.models {
            check::text(&format!("{title}: the name of a model"), &model.name)?;
            number("the misfit of a model", model.misfit)?;
            number("the AICc of a model", model.aicc)?;
            number("the prediction of a model", model.prediction.unwrap_or(0.0))?;
        }
        for parameter in &self.parameters {
            parameter.check()?;
        }
        self.correlation.as_ref().map_or(Ok(()), Correlation::check)
    }

    /// Returns the [`Evidence`] for each model, in the order of the models, by the Akaike weights
    /// \[BA02, eq. 2.9\].
    ///
    /// ```math
    /// w_i = \frac{e^{-\Delta_i/2}}{\sum_j e^{-\Delta_j/2}},\qquad
    /// \Delta_i = \mathrm{AICc}_i - \min_j \mathrm{AICc}_j
    /// ```
    #[must_use]
    pub fn evidence(&self) -> Vec<Evidence> {
        let best = self.models.iter().map(|model| model.aicc);
        let best = best.fold(f64::INFINITY, f64::min);
        let weight = |model: &ModelScore| (-0.5 * (model.aicc - best)).exp();
        let total: f64 = self.models.iter().map(weight).sum();
        let models = self.models.iter();
        let evidence = |model: &ModelScore| Evidence {
            above_best: model.aicc - best,
            weight: weight(model) / total,
        };
        models.map(evidence).collect()
    }
}

/// Evidence for a model in a comparison.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Evidence {
    /// AICc of the model minus the AICc of the best model.
    pub above_best: f64,
    /// Akaike weight, 0 to 1.
    pub weight: f64,
}

/// Unit of loads, with its name and its size in SI.
pub(crate) struct LoadUnit<'a> {
    pub(crate) name: &'a str,
    pub(crate) in_si: f64,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parameter::{Interval, Units};

    fn law(misfit: f64, converged: bool, interval: Interval) -> LawReport {
        LawReport {
            statistics: Some(Statistics { misfit, converged, ..Statistics::default() }),
            parameters: vec![Parameter {
                name: "bending rigidity".to_owned(),
                symbol: "k_b".to_owned(),
                value: 1e-5,
                units: Units::si("N·m"),
                standard_error: Some(1e-7),
                interval,
                incidental: false,
            }],
            ..LawReport::default()
        }
    }

    #[test]
    fn a_law_is_judged_by_its_misfit_its_search_and_its_intervals() {
        let known = Interval::Between { lower: 0.98e-5, upper: 1.02e-5 };
        let unknown = Interval::Unknown { reason: "flat".to_owned() };
        let trust = |law: LawReport| law.verdict(&Limits::default()).trust;
        assert_eq!(trust(law(0.01, true, known.clone())), Trust::Good);
        assert_eq!(trust(law(0.03, true, known.clone())), Trust::Doubtful);
        assert_eq!(trust(law(0.05, true, known.clone())), Trust::Poor);
        assert_eq!(trust(law(0.01, false, known)), Trust::Poor);
        assert_eq!(trust(law(0.01, true, unknown.clone())), Trust::Doubtful);
        let mut zero = law(0.01, true, unknown);
        zero.parameters[0].incidental = true;
        assert_eq!(trust(zero), Trust::Good);
        assert_eq!(trust(LawReport::default()), Trust::Unjudged);
    }

    #[test]
    fn a_law_with_kes_values_is_judged_by_them_and_not_by_its_parameters() {
        let vague = Interval::Unknown { reason: "flat".to_owned() };
        let value = |lower: f64, upper: f64| LawValue {
            symbol: "2HB".to_owned(),
            name: "bending loop width".to_owned(),
            units: Units::si("N"),
            law: 1.0,
            curve: Some(1.0),
            interval: Interval::Between { lower, upper },
        };
        let verdict = |value: LawValue| {
            let law = LawReport { values: vec![value], ..law(0.01, true, vague.clone()) };
            law.verdict(&Limits::default())
        };
        assert_eq!(verdict(value(0.96, 1.04)).trust, Trust::Good);
        let wide = verdict(value(0.9, 1.05));
        assert_eq!(wide.trust, Trust::Doubtful);
        assert_eq!(wide.reasons, ["not known to 5.00 %: 2HB (to 10.0 %)"]);
        for undetermined in [value(0.1, 1.1), value(-0.1, 1.1)] {
            let verdict = verdict(undetermined);
            assert_eq!(verdict.trust, Trust::Doubtful);
            assert_eq!(verdict.reasons, ["not determined by this curve: 2HB"]);
        }
    }

    #[test]
    fn the_weights_of_evidence_follow_akaike() {
        let model = |aicc: f64| ModelScore { aicc, ..ModelScore::default() };
        let law = LawReport {
            models: vec![model(-100.0), model(-104.0), model(-102.0)],
            ..LawReport::default()
        };
        // exp(-2), 1 and exp(-1) over their sum 1.503215.
        let expected = [(4.0, 0.090_030_6), (0.0, 0.665_240_9), (2.0, 0.244_728_5)];
        for (evidence, (d, w)) in law.evidence().into_iter().zip(expected) {
            let Evidence { above_best, weight } = evidence;
            assert_eq!(above_best, d);
            assert!((weight - w).abs() < 1e-6, "{weight} is not {w}");
        }
    }
}
