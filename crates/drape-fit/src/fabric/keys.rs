//! Key paths of the fitted parameters in a fabric file, for the provenance.

use std::collections::{BTreeMap, BTreeSet};

use drape_kes::{Direction, Test};

use crate::regression::curve_fit::CurveFit;

/// Errors of the fitted numbers of a fabric, by their key paths.
#[derive(Debug, Default)]
pub(crate) struct FittedErrors {
    /// Standard errors, in the units of the numbers.
    pub(crate) standard: BTreeMap<String, f64>,
    /// Correlations by both keys, the lesser one first.
    pub(crate) correlations: BTreeMap<String, BTreeMap<String, f64>>,
}

impl FittedErrors {
    /// Adds the `correlation` of two different numbers by their keys.
    pub(crate) fn correlate(&mut self, a: &str, b: &str, correlation: f64) {
        let (first, second) = if a < b { (a, b) } else { (b, a) };
        let row = self.correlations.entry(first.to_owned()).or_default();
        row.insert(second.to_owned(), correlation);
    }

    /// Adds the errors and correlations of `other`.
    pub(crate) fn extend(&mut self, other: Self) {
        self.standard.extend(other.standard);
        self.correlations.extend(other.correlations);
    }
}

/// Returns the errors of the numbers of a fabric that were fitted in `fits`.
///
/// Among several curves of one law the curve counts that gives the fabric's law: a bending loop
/// before loop bending, whose strips share their law.
pub(crate) fn fitted_errors(fits: &[CurveFit]) -> FittedErrors {
    let mut errors = FittedErrors::default();
    let mut taken = BTreeSet::new();

    let arches = fits.iter().filter(|fit| fit.test == Test::LoopBending);
    for fit in fits.iter().filter(|fit| fit.test != Test::LoopBending).chain(arches) {
        let law = law(fit.test, fit.direction);
        if taken.insert(law.clone()) {
            let two_elements = fit.parameters.iter().any(|estimate| estimate.name == "ratio");
            let mut keyed = Vec::new();
            for (index, estimate) in fit.parameters.iter().enumerate() {
                let key = key(fit.test, estimate.name, two_elements);
                if let (Some(key), Ok(error)) = (key, &estimate.standard_error) {
                    keyed.push((index, format!("{law}.{key}"), *error));
                }
            }
            for (place, (index, key, error)) in keyed.iter().enumerate() {
                errors.standard.insert(key.clone(), *error);
                for (other, other_key, _) in &keyed[..place] {
                    if let Some(correlation) = fit.correlations[*index][*other] {
                        errors.correlate(key, other_key, correlation);
                    }
                }
            }
        }
    }
    errors
}

/// Returns the key paths of the laws that the curves of `fits` give.
pub(crate) fn laws(fits: &[CurveFit]) -> BTreeSet<String> {
    fits.iter().map(|fit| law(fit.test, fit.direction)).collect()
}

/// Returns the key path of a `parameter` of a law in a fabric file, by the name that a fit gives
/// the parameter. `second plateau` and `second length` belong to the second element of a friction.
/// `None` for parameters of the test, and for parameters that enter two numbers.
///
/// ```
/// use drape_fit::parameter_key;
/// use drape_kes::{Direction, Test};
///
/// let key = parameter_key(Test::Bending, Direction::Warp, "plateau");
/// assert_eq!(key.as_deref(), Some("warp.bending.friction[0].plateau"));
/// ```
#[must_use]
pub fn parameter_key(test: Test, direction: Direction, parameter: &str) -> Option<String> {
    key(test, parameter, false).map(|key| format!("{}.{key}", law(test, direction)))
}

/// Returns the key path of the law of a `test` and `direction`.
fn law(test: Test, direction: Direction) -> String {
    let direction = direction.name();
    match test {
        Test::Tensile => format!("{direction}.traction"),
        Test::Bending | Test::LoopBending => format!("{direction}.bending"),
        Test::Shear => "shear".into(),
    }
}

/// Returns the key of a `parameter` within its law; `None` for parameters of the test, and for
/// parameters that enter two numbers.
fn key(test: Test, parameter: &str, two_elements: bool) -> Option<&'static str> {
    Some(match (test, parameter) {
        (Test::Tensile, "base_stiffness") => "exponential.base_stiffness",
        (Test::Tensile, "steepness") => "exponential.steepness",
        (Test::Tensile, "toe_stiffness") => "exponential.stiffness",
        (Test::Tensile, "toe_end") => "exponential.toe_strain",
        (Test::Tensile, "friction_ratio") => "proportional_friction.ratio",
        (Test::Tensile, "friction_plateau") => "proportional_friction.plateau",
        (Test::Tensile, "friction_length") => "proportional_friction.length",
        (Test::Tensile, "stiffness") => "primed.stiffness",
        (Test::Tensile, "toe_ratio") => "primed.toe_ratio",
        (Test::Tensile, "toe_strain") => "primed.toe_strain",
        (Test::Tensile, "quadratic") => "polynomial.quadratic",
        (Test::Tensile, "quartic") => "polynomial.quartic",
        (Test::Shear, "stiffness") => "stiffness",
        (Test::Shear, "growth") => "growth",
        (_, "rigidity") => "rigidity",
        (_, "initial_stiffness") => "varying.initial_stiffness",
        (_, "final_stiffness") => "varying.final_stiffness",
        (_, "transition") => "varying.transition",
        (_, "slope") => "piecewise.slope",
        (_, "intercept") => "piecewise.intercept",
        (_, "knot") => "piecewise.knot",
        (_, "plateau") => "friction[0].plateau",
        // With two elements the fitted length is the length of the second element.
        (_, "length") if two_elements => "friction[1].length",
        (_, "length") => "friction[0].length",
        (_, "second plateau") => "friction[1].plateau",
        (_, "second length") => "friction[1].length",
        _ => return None,
    })
}
