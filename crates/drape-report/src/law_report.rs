use serde::Serialize;

use crate::check;
use crate::error::ReportError;
use crate::number::percent;
use crate::parameter::Parameter;
use crate::plot::{Correlation, LoopPlot};

/// A fitted law: the curves that it follows, how well, and with which parameters.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct LawReport {
    /// What was fitted, as in "tensile, warp".
    pub title: String,
    /// The law in words, as in "priming zone and line, friction of first order".
    pub model: String,
    /// The curves with the law's answer; several where several tests were fitted as one.
    pub plots: Vec<LoopPlot>,
    /// How well the law follows the curves; none where it was set from values.
    pub statistics: Option<Statistics>,
    /// The models that were compared; empty where there was no choice.
    pub models: Vec<ModelScore>,
    /// The parameters, fitted or not.
    pub parameters: Vec<Parameter>,
    /// Correlations between the fitted parameters.
    pub correlation: Option<Correlation>,
    /// Remarks on this law alone.
    pub notes: Vec<String>,
}

/// How well a law follows its curves, and how the search went.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Statistics {
    /// Root mean square residual over the range of the measured load, a ratio.
    pub misfit: f64,
    /// Root mean square residual, in the SI unit of the load.
    pub rms: f64,
    /// Part of the variance that the law explains, at most 1.
    pub r_squared: f64,
    /// Number of measured points.
    pub points: usize,
    /// Steps of the search.
    pub iterations: usize,
    /// Evaluations of the law along the whole history.
    pub evaluations: usize,
    /// Whether the search ended at a minimum.
    pub converged: bool,
    /// Why the search ended, in words: "the sum of squares no longer falls".
    pub stop: String,
}

/// A model in a comparison.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct ModelScore {
    /// The model in words.
    pub name: String,
    /// Number of its fitted parameters.
    pub parameters: usize,
    /// Root mean square residual over the range of the measured load, a ratio.
    pub misfit: f64,
    /// Akaike's information criterion, corrected for the number of points; the smallest is best.
    pub aicc: f64,
    /// Whether this report is about this model.
    pub chosen: bool,
}

/// Limits beyond which a report points its finger.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Limits {
    /// Largest misfit of a law that counts as good, a ratio.
    pub misfit: f64,
    /// Largest relative standard error of a parameter that counts as known, a ratio.
    pub error: f64,
    /// Largest relative difference between a sheet's value and the recomputed one, a ratio.
    pub difference: f64,
    /// Correlations stronger than this are listed.
    pub correlation: f64,
}

impl Default for Limits {
    /// A misfit of 2 % is what the law's authors reach on woven fabrics. Repeated KES tests of one fabric
    /// scatter by some 5 %. An error of a quarter leaves one digit. A correlation below a half hardly widens
    /// an interval.
    fn default() -> Limits {
        Limits { misfit: 0.02, error: 0.25, difference: 0.05, correlation: 0.5 }
    }
}

/// How far a fitted law can be trusted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Trust {
    /// It was set from values or defaults: there is no curve to judge it by.
    Unjudged,
    /// It follows its curves, and the curves determine its parameters.
    Good,
    /// It follows its curves, but not all of its parameters are determined; or it misses the limit by less
    /// than its double.
    Doubtful,
    /// It does not follow its curves, or the search did not end.
    Poor,
}

impl Trust {
    /// The word for it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Unjudged => "not judged",
            Self::Good => "good",
            Self::Doubtful => "doubtful",
            Self::Poor => "poor",
        }
    }
}

/// A judgement with its grounds.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Verdict {
    /// The judgement.
    pub trust: Trust,
    /// What speaks against the law; empty where nothing does.
    pub reasons: Vec<String>,
}

impl LawReport {
    /// Judges the law by its statistics and its parameters.
    pub fn verdict(&self, limits: &Limits) -> Verdict {
        let Some(statistics) = &self.statistics else {
            return Verdict {
                trust: Trust::Unjudged,
                reasons: vec!["set from values, not from a curve".to_owned()],
            };
        };
        let mut trust = Trust::Good;
        let mut reasons = Vec::new();
        let mut against = |level: Trust, reason: String| {
            trust = trust.max(level);
            reasons.push(reason);
        };
        if !statistics.converged {
            against(Trust::Poor, format!("the search did not end: {}", statistics.stop));
        }
        let misfit = statistics.misfit;
        if misfit > limits.misfit {
            let level = if misfit > 2.0 * limits.misfit { Trust::Poor } else { Trust::Doubtful };
            let (misfit, limit) = (percent(misfit), percent(limits.misfit));
            against(level, format!("misfit {misfit}, more than {limit}"));
        }
        let symbols = |unknown: &dyn Fn(&&Parameter) -> bool| -> Option<String> {
            let of_the_fabric = self.parameters.iter().filter(|parameter| !parameter.incidental);
            let found = of_the_fabric.filter(unknown);
            let found: Vec<&str> = found.map(|parameter| parameter.symbol.as_str()).collect();
            (!found.is_empty()).then(|| found.join(", "))
        };
        if let Some(symbols) = symbols(&|parameter| parameter.is_undetermined()) {
            against(Trust::Doubtful, format!("no 95 % interval for {symbols}"));
        }
        let vague = |parameter: &&Parameter| {
            let error = parameter.relative_error();
            !parameter.is_undetermined() && error.is_some_and(|error| error > limits.error)
        };
        if let Some(symbols) = symbols(&vague) {
            let limit = percent(limits.error);
            against(Trust::Doubtful, format!("standard error above {limit} for {symbols}"));
        }
        Verdict { trust, reasons }
    }

    /// The unit in which loads are shown, with its size in SI.
    pub(crate) fn load_unit(&self) -> (&str, f64) {
        let axis = self.plots.first().map(|plot| &plot.load);
        axis.map_or(("", 1.0), |axis| (&axis.unit, axis.in_si))
    }

    /// Refuses numbers that are none, and plots without points.
    pub fn check(&self) -> Result<(), ReportError> {
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
        for model in &self.models {
            check::text(&format!("{title}: the name of a model"), &model.name)?;
            number("the misfit of a model", model.misfit)?;
            number("the AICc of a model", model.aicc)?;
        }
        for parameter in &self.parameters {
            parameter.check()?;
        }
        self.correlation.as_ref().map_or(Ok(()), Correlation::check)
    }

    /// AICc above the best model's, and the weight of evidence for each model, in the models' order.
    ///
    /// ```math
    /// w_i = \frac{e^{-\Delta_i/2}}{\sum_j e^{-\Delta_j/2}}
    /// ```
    ///
    /// Burnham and Anderson, Model Selection and Multimodel Inference, 2002, eq. 2.9.
    pub fn evidence(&self) -> Vec<(f64, f64)> {
        let best = self.models.iter().map(|model| model.aicc);
        let best = best.fold(f64::INFINITY, f64::min);
        let weight = |model: &ModelScore| (-0.5 * (model.aicc - best)).exp();
        let total: f64 = self.models.iter().map(weight).sum();
        let models = self.models.iter();
        models.map(|model| (model.aicc - best, weight(model) / total)).collect()
    }
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
    fn the_weights_of_evidence_follow_akaike() {
        let model = |aicc: f64| ModelScore { aicc, ..ModelScore::default() };
        let law = LawReport {
            models: vec![model(-100.0), model(-104.0), model(-102.0)],
            ..LawReport::default()
        };
        // exp(-2), 1 and exp(-1) over their sum 1.503215.
        let expected = [(4.0, 0.090_030_6), (0.0, 0.665_240_9), (2.0, 0.244_728_5)];
        for ((delta, weight), (d, w)) in law.evidence().into_iter().zip(expected) {
            assert_eq!(delta, d);
            assert!((weight - w).abs() < 1e-6, "{weight} is not {w}");
        }
    }
}
