//! Samples of the numbers of a fitted fabric, from their standard errors and correlations.

use std::collections::BTreeMap;

use drape_input::{Advice, Document, Remedy, excerpt, figure};
use nalgebra::{DMatrix, DVector};
use serde::Deserialize;

use crate::axes::random::Random;
use crate::axes::range::toml_number;

/// Numbers of a fitted fabric, and their errors.
#[derive(Debug, Deserialize)]
struct FabricNumbers {
    #[serde(default)]
    provenance: FitErrors,
    /// Laws of the fabric.
    #[serde(flatten)]
    laws: BTreeMap<String, toml::Value>,
}

/// Standard errors and correlations of the numbers, by the keys of the numbers.
#[derive(Debug, Default, Deserialize)]
struct FitErrors {
    #[serde(default)]
    standard_errors: BTreeMap<String, f64>,
    #[serde(default)]
    correlations: BTreeMap<String, BTreeMap<String, f64>>,
}

/// Scale on which the errors of a number have a normal distribution.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Scale {
    /// The number itself.
    Linear,
    /// Logarithm of the number, which is above 0.
    Log,
    /// Logarithm of `p / (1 - p)` for the number `p`, a ratio from 0 to 1.
    Logit,
}

impl Scale {
    /// Returns the scale of the number at `key`, which has the given `value`.
    fn for_number(key: &str, value: f64) -> Self {
        match value {
            _ if key.ends_with(".intercept") || value <= 0.0 => Self::Linear,
            _ if key.ends_with(".toe_ratio") && value < 1.0 => Self::Logit,
            _ => Self::Log,
        }
    }

    /// Returns `value` and its standard `error` on the scale.
    fn transform(self, value: f64, error: f64) -> [f64; 2] {
        match self {
            Self::Linear => [value, error],
            Self::Log => [value.ln(), error / value],
            Self::Logit => [(value / (1.0 - value)).ln(), error / (value * (1.0 - value))],
        }
    }

    /// Returns the number that has the value `transformed` on the scale.
    fn invert(self, transformed: f64) -> f64 {
        match self {
            Self::Linear => transformed,
            Self::Log => transformed.exp(),
            Self::Logit => 1.0 / (1.0 + (-transformed).exp()),
        }
    }
}

/// Fitted number with a standard error.
#[derive(Debug, Clone)]
struct UncertainNumber {
    key: String,
    scale: Scale,
    /// Value on the scale.
    mean: f64,
    /// Standard error on the scale.
    error: f64,
    /// Keys of the numbers with a fixed ratio to this number, each with the ratio.
    followers: Vec<(String, f64)>,
}

/// Fitted numbers of a fabric that are sampled together.
#[derive(Debug, Clone)]
pub(crate) struct Covariance {
    numbers: Vec<UncertainNumber>,
    /// Matrix `A` for which `A Aᵀ` is the matrix of correlations.
    root: DMatrix<f64>,
}

/// Samples of a number.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct SampledNumber {
    /// Key of the number.
    pub(crate) key: String,
    /// Samples, as TOML values.
    pub(crate) values: Vec<String>,
    /// Whether the number keeps a fixed ratio to another sampled number.
    pub(crate) is_follower: bool,
}

/// Reason why a fabric cannot be sampled, with its remedy.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct CovarianceError {
    pub(crate) message: String,
    pub(crate) help: Advice,
}

impl CovarianceError {
    /// Returns the error with the given `message` and the remedy `help`.
    fn new(message: impl Into<String>, help: impl Into<Advice>) -> Self {
        Self { message: message.into(), help: help.into() }
    }
}

impl Covariance {
    /// Reads the errors of the fitted `fabric`, for the numbers with the given `keys`, or for all
    /// numbers.
    ///
    /// # Errors
    /// [`CovarianceError`] if a number has no standard error, or an error larger than the number.
    pub(crate) fn read(
        fabric: &Document,
        keys: Option<&[String]>,
    ) -> Result<Self, CovarianceError> {
        let refit = || Remedy::FitWithErrors { fabric: fabric.path().to_owned() };
        let file = fabric.path().display();
        let FabricNumbers { provenance, laws } = fabric
            .decode()
            .map_err(|mistakes| CovarianceError::new(format!("{file}: {mistakes}"), refit()))?;
        let FitErrors { standard_errors: errors, correlations } = provenance;
        if errors.is_empty() {
            return Err(CovarianceError::new(format!("{file} has no standard errors"), refit()));
        }

        let known: Vec<&String> =
            errors.keys().filter(|key| lookup(&laws, key).is_some()).collect();
        let narrow: Vec<String> = known
            .iter()
            .filter(|key| !is_wide(key, &laws, &errors))
            .map(|key| format!("{key:?}"))
            .collect();
        let help = format!("name those that are known better: keys = [{}]", narrow.join(", "));
        let chosen: Vec<&String> = match keys {
            None => known.clone(),
            Some(keys) => keys.iter().collect(),
        };
        if let Some(key) = chosen.iter().find(|key| !known.contains(key)) {
            let message = format!("{file} has no standard error of \"{}\"", excerpt(key));
            return Err(CovarianceError::new(message, help));
        }
        if let Some(key) = chosen.iter().find(|key| is_wide(key, &laws, &errors)) {
            let value = lookup(&laws, key).unwrap_or_default();
            let [error, value] = [errors[*key], value].map(figure);
            let message = format!("{key} of {file} is {value} with a standard error of {error}");
            return Err(CovarianceError::new(message, help));
        }
        if chosen.is_empty() {
            return Err(CovarianceError::new("there are no keys", help));
        }

        let numbers: Vec<UncertainNumber> = chosen
            .iter()
            .filter_map(|key| {
                let value = lookup(&laws, key)?;
                let scale = Scale::for_number(key, value);
                let followers = followers(key, value, &laws, &errors);
                let [mean, error] = scale.transform(value, errors[*key]);
                Some(UncertainNumber { key: (*key).clone(), scale, mean, error, followers })
            })
            .collect();

        // The file gives each correlation once, in either order of the two keys.
        let matrix = DMatrix::from_fn(numbers.len(), numbers.len(), |i, j| {
            let [a, b] = [i, j].map(|index| numbers[index].key.as_str());
            let correlation = correlations.get(a).and_then(|row| row.get(b));
            let reverse = correlations.get(b).and_then(|row| row.get(a));
            if i == j { 1.0 } else { correlation.or(reverse).copied().unwrap_or(0.0) }
        });

        // The root comes from the eigenvalues. Rounding may turn a variance of zero negative.
        let eigen = matrix.symmetric_eigen();
        let lengths = eigen.eigenvalues.map(|variance| variance.max(0.0).sqrt());
        let root = eigen.eigenvectors * DMatrix::from_diagonal(&lengths);
        Ok(Self { numbers, root })
    }

    /// Draws `count` samples of all numbers and their followers. `seed` chooses the sample.
    pub(crate) fn sample(&self, count: u32, seed: u32) -> Vec<SampledNumber> {
        let mut columns: Vec<SampledNumber> = Vec::new();
        for number in &self.numbers {
            columns.push(SampledNumber::new(&number.key, false));
            for (key, _) in &number.followers {
                columns.push(SampledNumber::new(key, true));
            }
        }

        let mut random = Random::new("covariance", &[seed]);
        for _ in 0..count {
            let normal = DVector::from_fn(self.numbers.len(), |_, _| random.normal());
            let deviations = &self.root * normal;
            let mut columns = columns.iter_mut();
            for (number, deviation) in self.numbers.iter().zip(deviations.iter()) {
                let value = number.scale.invert(number.mean + number.error * deviation);
                let followers = number.followers.iter().map(|(_, ratio)| ratio * value);
                for (value, column) in std::iter::once(value).chain(followers).zip(&mut columns) {
                    column.values.push(toml_number(value));
                }
            }
        }
        columns
    }
}

impl SampledNumber {
    /// Returns the number at `key` without samples.
    fn new(key: &str, is_follower: bool) -> Self {
        Self { key: key.to_owned(), values: Vec::new(), is_follower }
    }
}

/// Returns whether the standard error of the number at `key` is larger than the number itself.
/// Samples of such a number would spread over decades.
fn is_wide(
    key: &str,
    laws: &BTreeMap<String, toml::Value>,
    errors: &BTreeMap<String, f64>,
) -> bool {
    /// Largest ratio of a standard error to its number.
    const ERROR_MAX: f64 = 1.0;

    lookup(laws, key).is_some_and(|value| errors[key] > ERROR_MAX * value.abs())
}

/// Returns the keys of the numbers that keep their ratio to the sampled number at `key`, each with
/// the ratio.
///
/// They are the number of the other direction, if it was taken from this one, and the toe strains
/// after the first pull.
fn followers(
    key: &str,
    value: f64,
    laws: &BTreeMap<String, toml::Value>,
    errors: &BTreeMap<String, f64>,
) -> Vec<(String, f64)> {
    let opposite = match key.split_once('.') {
        Some(("warp", law)) => Some(format!("weft.{law}")),
        Some(("weft", law)) => Some(format!("warp.{law}")),
        _ => None,
    };
    let copy = opposite
        .filter(|opposite| !errors.contains_key(opposite) && lookup(laws, opposite) == Some(value));

    let mut keys: Vec<String> = strain_after(key).into_iter().collect();
    if let Some(copy) = copy {
        keys.extend(strain_after(&copy));
        keys.push(copy);
    }

    // A number of zero has no ratio.
    let with_values = keys.into_iter().filter_map(|key| Some((lookup(laws, &key)?, key)));
    with_values.filter(|_| value != 0.0).map(|(follower, key)| (key, follower / value)).collect()
}

/// Returns the key of the toe strain after the first pull, if `key` is the key of a toe strain.
fn strain_after(key: &str) -> Option<String> {
    key.ends_with(".toe_strain").then(|| format!("{key}_after"))
}

/// Returns the number in `laws` at the key path `key`, such as `warp.bending.friction[0].plateau`.
fn lookup(laws: &BTreeMap<String, toml::Value>, key: &str) -> Option<f64> {
    let mut parts = key.split(['.', '[']).map(|part| part.trim_end_matches(']'));
    let mut value = laws.get(parts.next()?)?;
    for part in parts {
        value = match part.parse::<usize>() {
            Ok(index) => value.get(index)?,
            Err(_) => value.get(part)?,
        };
    }
    value.as_float().or_else(|| Some(value.as_integer()? as f64))
}

#[cfg(test)]
mod tests {
    use super::*;

    const FABRIC: &str = r#"
name = "poplin"
density = 0.12
[warp.traction.primed]
stiffness = 5000.0
toe_ratio = 0.6
toe_strain = 0.01
toe_strain_after = 0.015
[warp.bending]
rigidity = 6e-6
[[warp.bending.friction]]
plateau = 7e-5
[weft.bending]
rigidity = 6e-6
[shear]
stiffness = 30.0
[provenance.standard_errors]
"warp.traction.primed.toe_ratio" = 0.05
"warp.traction.primed.toe_strain" = 0.001
"warp.bending.rigidity" = 2e-6
"warp.bending.friction[0].plateau" = 3e-5
"shear.stiffness" = 3.0
[provenance.correlations."warp.bending.friction[0].plateau"]
"warp.bending.rigidity" = -0.8
[provenance.correlations."warp.traction.primed.toe_ratio"]
"warp.traction.primed.toe_strain" = 0.5
"#;

    fn numbers(columns: &[SampledNumber], key: &str) -> Vec<f64> {
        let column = columns.iter().find(|column| column.key == key).expect("it is sampled");
        column.values.iter().map(|value| value.parse().expect("a number")).collect()
    }

    #[test]
    fn a_number_at_the_end_of_its_scale_is_on_one_that_it_fits() {
        assert_eq!(Scale::for_number("warp.traction.primed.toe_ratio", 0.999), Scale::Logit);
        assert_eq!(Scale::for_number("warp.traction.primed.toe_ratio", 1.0), Scale::Log);
        assert_eq!(Scale::for_number("shear.stiffness", 0.0), Scale::Linear);
    }

    #[test]
    fn samples_have_the_means_and_the_covariance_of_the_fit() {
        let fabric = Document::new("fabric.toml", FABRIC);
        let count = 20_000;
        let columns = Covariance::read(&fabric, None).expect("errors").sample(count, 3);
        let n = f64::from(count);
        let log = |key: &str| numbers(&columns, key).into_iter().map(f64::ln).collect::<Vec<_>>();
        let logit = |key: &str| {
            let values = numbers(&columns, key).into_iter();
            values.map(|p| (p / (1.0 - p)).ln()).collect::<Vec<_>>()
        };
        let mean = |values: &[f64]| values.iter().sum::<f64>() / n;
        let covariance = |a: &[f64], b: &[f64]| {
            let means = [mean(a), mean(b)];
            a.iter().zip(b).map(|(a, b)| (a - means[0]) * (b - means[1])).sum::<f64>() / (n - 1.0)
        };
        let [rigidity, plateau] = [
            (log("warp.bending.rigidity"), 6e-6_f64.ln(), 2e-6 / 6e-6),
            (log("warp.bending.friction[0].plateau"), 7e-5_f64.ln(), 3e-5 / 7e-5),
        ];
        let ratio = (logit("warp.traction.primed.toe_ratio"), 1.5_f64.ln(), 0.05 / (0.6 * 0.4));
        let strain = (log("warp.traction.primed.toe_strain"), 0.01_f64.ln(), 0.1);
        let shear = (log("shear.stiffness"), 30.0_f64.ln(), 0.1);
        for (values, value, error) in [&rigidity, &plateau, &ratio, &strain, &shear] {
            // Within four standard errors of the mean and of the variance of a sample.
            assert!((mean(values) - value).abs() < 4.0 * error / n.sqrt(), "{}", mean(values));
            let variance = covariance(values, values) / (error * error);
            assert!((variance - 1.0).abs() < 4.0 * (2.0 / n).sqrt(), "{variance}");
        }
        for (a, b, expected) in [
            (&rigidity, &plateau, -0.8),
            (&ratio, &strain, 0.5),
            (&rigidity, &strain, 0.0),
            (&shear, &plateau, 0.0),
        ] {
            let found = covariance(&a.0, &b.0) / (a.2 * b.2);
            assert!((found - expected).abs() < 4.0 * (2.0 / n).sqrt(), "{found} for {expected}");
        }
        // The number of the weft, which was taken from the warp, and the later toe strain follow.
        let weft = numbers(&columns, "weft.bending.rigidity");
        assert_eq!(weft, numbers(&columns, "warp.bending.rigidity"));
        let after = numbers(&columns, "warp.traction.primed.toe_strain_after");
        let before = numbers(&columns, "warp.traction.primed.toe_strain");
        assert!(before.iter().zip(&after).all(|(a, b)| (b / a - 1.5).abs() < 1e-9));
        assert!(numbers(&columns, "warp.traction.primed.toe_ratio").iter().all(|p| *p < 1.0));
    }

    #[test]
    fn a_seed_chooses_the_sample_and_keys_the_numbers() {
        let fabric = Document::new("fabric.toml", FABRIC);
        let keys = ["shear.stiffness".to_owned()];
        let one = Covariance::read(&fabric, Some(&keys)).expect("an error");
        assert_eq!(one.sample(3, 1), one.sample(3, 1));
        assert_ne!(one.sample(3, 1), one.sample(3, 2));
        assert_eq!(one.sample(3, 1)[0].values.len(), 3);
        assert_eq!(one.sample(3, 1).len(), 1);
    }

    #[test]
    fn what_the_fit_does_not_know_is_refused_with_a_remedy_that_helps() {
        let text =
            FABRIC.replace("\"warp.bending.rigidity\" = 2e-6", "\"warp.bending.rigidity\" = 2e-5");
        let fabric = Document::new("fabric.toml", text);
        let error = Covariance::read(&fabric, None).expect_err("it is wide");
        assert!(error.message.contains("warp.bending.rigidity of fabric.toml"), "{error:?}");
        let list = error.help.text.split_once("keys = ").expect("a list").1;
        let keys: Vec<String> = serde_json::from_str(list).expect("a list of texts");
        assert_eq!(keys.len(), 4);
        assert!(Covariance::read(&fabric, Some(&keys)).is_ok());
        let unknown = ["warp.bending.rest_curvature".to_owned()];
        let error = Covariance::read(&fabric, Some(&unknown)).expect_err("it has none");
        assert!(error.message.contains("no standard error of"), "{error:?}");
        let bare = Document::new("bare.toml", "name = \"a\"\n");
        let error = Covariance::read(&bare, None).expect_err("it has none");
        let fabric = "bare.toml".into();
        assert_eq!(error.help.remedy, Some(Remedy::FitWithErrors { fabric }));
    }
}
