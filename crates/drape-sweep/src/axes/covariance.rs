//! Samples of the numbers of a fitted fabric, by their errors and correlations.

use std::collections::BTreeMap;

use drape_input::{Document, excerpt, figure};
use nalgebra::{DMatrix, DVector};
use serde::Deserialize;

use crate::axes::random::Random;
use crate::axes::range::number;

/// Largest standard error over its value that is sampled: the numbers of others lie over decades.
const ERROR_MAX: f64 = 1.0;

/// Numbers of a fabric, and what its fit says of them.
#[derive(Debug, Deserialize)]
struct FabricNumbers {
    #[serde(default)]
    provenance: Errors,
    /// Laws of the fabric.
    #[serde(flatten)]
    laws: BTreeMap<String, toml::Value>,
}

#[derive(Debug, Default, Deserialize)]
struct Errors {
    #[serde(default)]
    standard_errors: BTreeMap<String, f64>,
    #[serde(default)]
    correlations: BTreeMap<String, BTreeMap<String, f64>>,
}

/// Scale on which the errors of a number are those of a normal distribution.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Scale {
    /// The number itself.
    Linear,
    /// Its logarithm: of a number above 0.
    Log,
    /// The logarithm of `p / (1 - p)`: of a ratio from 0 to 1.
    Logit,
}

impl Scale {
    /// Returns the scale of a number.
    fn of(key: &str, value: f64) -> Self {
        match value {
            _ if key.ends_with(".intercept") || value <= 0.0 => Self::Linear,
            _ if key.ends_with(".toe_ratio") && value < 1.0 => Self::Logit,
            _ => Self::Log,
        }
    }

    /// Returns a number and its error on the scale.
    fn onto(self, value: f64, error: f64) -> [f64; 2] {
        match self {
            Self::Linear => [value, error],
            Self::Log => [value.ln(), error / value],
            Self::Logit => [(value / (1.0 - value)).ln(), error / (value * (1.0 - value))],
        }
    }

    /// Returns the number at a place on the scale.
    fn back(self, place: f64) -> f64 {
        match self {
            Self::Linear => place,
            Self::Log => place.exp(),
            Self::Logit => 1.0 / (1.0 + (-place).exp()),
        }
    }
}

/// Fitted number with a standard error.
#[derive(Debug, Clone)]
struct Uncertain {
    key: String,
    scale: Scale,
    /// Value and error on the scale.
    place: [f64; 2],
    /// Other numbers that are in a fixed ratio to it, with the ratio.
    followers: Vec<(String, f64)>,
}

/// Fitted numbers of a fabric that are sampled together.
#[derive(Debug, Clone)]
pub(crate) struct Covariance {
    numbers: Vec<Uncertain>,
    /// Matrix `A` of which `A Aᵀ` are the correlations.
    root: DMatrix<f64>,
}

/// Sampled number.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Sampled {
    pub(crate) key: String,
    /// Values of TOML.
    pub(crate) values: Vec<String>,
    /// Whether the number keeps a fixed ratio to another sampled number.
    pub(crate) is_follower: bool,
}

/// Reason why a fabric cannot be sampled, with its remedy.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct CovarianceError {
    pub(crate) message: String,
    pub(crate) help: String,
}

impl CovarianceError {
    fn new(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { message: message.into(), help: help.into() }
    }
}

impl Covariance {
    /// Reads the errors of a fitted fabric: of those numbers whose keys are asked for, or of all.
    pub(crate) fn read(
        fabric: &Document,
        keys: Option<&[String]>,
    ) -> Result<Self, CovarianceError> {
        let refit = "write it with `drape fit SHEET -o FABRIC.toml`, from a sheet with curves or with \
                     standard deviations";
        let file = fabric.path().display();
        let FabricNumbers { provenance, laws } = fabric
            .decode()
            .map_err(|mistakes| CovarianceError::new(format!("{file}: {mistakes}"), refit))?;
        let Errors { standard_errors: errors, correlations } = provenance;
        if errors.is_empty() {
            return Err(CovarianceError::new(format!("{file} has no standard errors"), refit));
        }
        let value = |key: &str| lookup(&laws, key);
        let known: Vec<&String> = errors.keys().filter(|key| value(key).is_some()).collect();
        let wide =
            |key: &&String| value(key).is_some_and(|own| errors[*key] > ERROR_MAX * own.abs());
        let narrow = || {
            let narrow: Vec<String> =
                known.iter().filter(|key| !wide(key)).map(|key| format!("{key:?}")).collect();
            format!("name those that are known better: keys = [{}]", narrow.join(", "))
        };
        let chosen: Vec<&String> = match keys {
            None => known.clone(),
            Some(keys) => keys.iter().collect(),
        };
        if let Some(key) = chosen.iter().find(|key| !known.contains(key)) {
            let message = format!("{file} has no standard error of \"{}\"", excerpt(key));
            return Err(CovarianceError::new(message, narrow()));
        }
        if let Some(key) = chosen.iter().find(|key| wide(key)) {
            let [error, value] = [errors[*key], value(key).unwrap_or_default()].map(figure);
            let message = format!("{key} of {file} is {value} with a standard error of {error}");
            return Err(CovarianceError::new(message, narrow()));
        }
        if chosen.is_empty() {
            return Err(CovarianceError::new("there are no keys", narrow()));
        }
        let numbers: Vec<Uncertain> = chosen
            .iter()
            .filter_map(|key| {
                let own = value(key)?;
                let scale = Scale::of(key, own);
                let followers = followers(key, own, &laws, &errors);
                let place = scale.onto(own, errors[*key]);
                Some(Uncertain { key: (*key).clone(), scale, place, followers })
            })
            .collect();
        let correlation = |i: usize, j: usize| {
            let pair = |a: &str, b: &str| correlations.get(a)?.get(b).copied();
            let [a, b] = [i, j].map(|index| numbers[index].key.as_str());
            if i == j { 1.0 } else { pair(a, b).or_else(|| pair(b, a)).unwrap_or(0.0) }
        };
        let matrix = DMatrix::from_fn(numbers.len(), numbers.len(), correlation);
        let eigen = matrix.symmetric_eigen();
        // Rounding may leave a variance of zero below it.
        let lengths = eigen.eigenvalues.map(|variance| variance.max(0.0).sqrt());
        let root = eigen.eigenvectors * DMatrix::from_diagonal(&lengths);
        Ok(Self { numbers, root })
    }

    /// Draws a number of samples.
    pub(crate) fn sample(&self, count: u32, seed: u32) -> Vec<Sampled> {
        let mut random = Random::new("covariance", &[seed]);
        let empty = |key: &String, is_follower| Sampled {
            key: key.clone(),
            values: Vec::new(),
            is_follower,
        };
        let columns = self.numbers.iter().flat_map(|own| {
            let followers = own.followers.iter().map(|(key, _)| empty(key, true));
            std::iter::once(empty(&own.key, false)).chain(followers)
        });
        let mut columns: Vec<Sampled> = columns.collect();
        for _ in 0..count {
            let normal = DVector::from_fn(self.numbers.len(), |_, _| random.normal());
            let deviations = &self.root * normal;
            let values = self.numbers.iter().zip(deviations.iter()).flat_map(|(own, deviation)| {
                let [place, error] = own.place;
                let value = own.scale.back(place + error * deviation);
                let followers = own.followers.iter().map(move |(_, ratio)| ratio * value);
                std::iter::once(value).chain(followers)
            });
            columns.iter_mut().zip(values).for_each(|(own, value)| own.values.push(number(value)));
        }
        columns
    }
}

/// Returns the numbers that keep their ratio to a sampled number: that of the weft where it was taken
/// from the warp's, or the reverse, and the toe strain after the first pull.
fn followers(
    key: &str,
    value: f64,
    laws: &BTreeMap<String, toml::Value>,
    errors: &BTreeMap<String, f64>,
) -> Vec<(String, f64)> {
    let mut followers = Vec::new();
    let after = |key: &str| key.ends_with(".toe_strain").then(|| format!("{key}_after"));
    let other = match key.split_once('.') {
        Some(("warp", rest)) => Some(format!("weft.{rest}")),
        Some(("weft", rest)) => Some(format!("warp.{rest}")),
        _ => None,
    };
    let mut add = |key: String| {
        if let Some(own) = lookup(laws, &key).filter(|_| value != 0.0) {
            followers.push((key, own / value));
        }
    };
    after(key).into_iter().for_each(&mut add);
    let is_same =
        |other: &String| !errors.contains_key(other) && lookup(laws, other) == Some(value);
    if let Some(other) = other.filter(is_same) {
        after(&other).into_iter().for_each(&mut add);
        add(other);
    }
    followers
}

/// Returns the number at a key path such as `warp.bending.friction[0].plateau`.
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

    fn numbers(columns: &[Sampled], key: &str) -> Vec<f64> {
        let column = columns.iter().find(|own| own.key == key).expect("it is sampled");
        column.values.iter().map(|value| value.parse().expect("a number")).collect()
    }

    #[test]
    fn a_number_at_the_end_of_its_scale_is_on_one_that_it_fits() {
        assert_eq!(Scale::of("warp.traction.primed.toe_ratio", 0.999), Scale::Logit);
        assert_eq!(Scale::of("warp.traction.primed.toe_ratio", 1.0), Scale::Log);
        assert_eq!(Scale::of("shear.stiffness", 0.0), Scale::Linear);
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
        // The weft's, which is the warp's, and the later toe go along.
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
        let list = error.help.split_once("keys = ").expect("a list").1;
        let keys: Vec<String> = serde_json::from_str(list).expect("a list of texts");
        assert_eq!(keys.len(), 4);
        assert!(Covariance::read(&fabric, Some(&keys)).is_ok());
        let unknown = ["warp.bending.rest_curvature".to_owned()];
        let error = Covariance::read(&fabric, Some(&unknown)).expect_err("it has none");
        assert!(error.message.contains("no standard error of"), "{error:?}");
        let bare = Document::new("bare.toml", "name = \"a\"\n");
        let error = Covariance::read(&bare, None).expect_err("it has none");
        assert!(error.help.contains("drape fit SHEET -o FABRIC.toml"), "{error:?}");
    }
}
