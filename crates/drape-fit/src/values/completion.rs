//! Traction law from the tensile values of a sheet: the given values, values that follow from them,
//! and defaults for the others.

use drape_fabric::TractionLaw;
use drape_kes::Values;

use crate::error::Error;
use crate::values::assumed;
use crate::values::matched::{Matched, Noted, REPORTED_DEVIATION};
use crate::values::traction::{TensileTarget, VALUE_TOLERANCE, tensile_from_values};

/// Relative difference between WT and ½·LT·FM·EM that rounding of printed values does not explain.
const CONTRADICTION: f64 = 0.05;
/// Number of steps in which an assumed LT or RT moves towards one until the given values can be
/// met.
const STEPS: usize = 20;

/// Returns the traction law of the tensile `values`, if any is given. `name` is the direction.
///
/// # Errors
/// The values are impossible for a fabric, or no law here comes near them.
pub(crate) fn tensile_law(
    name: &str,
    values: &Values,
    maximum_tension: f64,
) -> Result<Option<Noted<TractionLaw>>, Error> {
    let (em, lt) = (values.tensile_extension(), values.tensile_linearity());
    let (wt, rt) = (values.tensile_work(), values.tensile_resilience());
    if [em, lt, wt, rt].iter().all(Option::is_none) {
        return Ok(None);
    }
    // WT = ½·LT·FM·EM: two of LT, WT and EM determine the third.
    let half = 0.5 * maximum_tension;
    let known = lt.or_else(|| Some(wt? / (half * em?)));
    if let Some(resilience) = rt {
        check_resilience(name, resilience)?;
    }
    if let Some(linearity) = known {
        let origin = if lt.is_some() { "given" } else { "made by WT and EM" };
        check_linearity(name, linearity, origin)?;
    }

    // A default must not keep the law from meeting the given values.
    let steps = if known.is_none() || rt.is_none() { STEPS } else { 1 };
    let (mut met, mut matched) = (None, None);
    for step in 0..steps {
        let linearity = known.unwrap_or_else(|| towards_one(assumed::LINEARITY, step));
        let target = TensileTarget {
            maximum_tension,
            extension: em.or(wt.map(|wt| wt / (half * linearity))).unwrap_or(assumed::EXTENSION),
            linearity,
            resilience: rt.unwrap_or_else(|| towards_one(assumed::RESILIENCE, step)),
        };
        let found = tensile_from_values(&target);
        let is_met = found.as_ref().is_ok_and(|found| found.deviation <= VALUE_TOLERANCE);
        (met, matched) = (Some(target), Some(found));
        if is_met {
            break;
        }
    }
    let (Some(met), Some(matched)) = (met, matched) else { return Ok(None) };
    let Matched { law, deviation } = matched.map_err(|error| with_direction(error, name))?;

    let TensileTarget { extension, linearity, resilience, .. } = met;
    let mut notes = Vec::new();
    let assumptions = [
        ("LT", known.is_none(), linearity),
        ("EM", em.is_none() && wt.is_none(), extension),
        ("RT", rt.is_none(), resilience),
    ];
    for (value, is_missing, taken) in assumptions {
        if is_missing {
            notes.push(format!("{name} {value}: not measured, {taken:.4} taken"));
        }
    }
    if let Some(wt) = wt {
        let tied = half * linearity * extension;
        if (wt / tied - 1.0).abs() > CONTRADICTION {
            notes.push(format!(
                "{name} WT: {wt:.3} J/m² not used, because LT and EM make it {tied:.3} J/m²"
            ));
        }
    }
    if deviation > REPORTED_DEVIATION {
        notes.push(format!(
            "{name} EM, LT and RT: met to {:.1} % only, no law here is so round and loses so much",
            100.0 * deviation
        ));
    }
    notes.push(format!("{name} traction after stretching: not in the values, as before taken"));
    Ok(Some(Noted { law, notes }))
}

/// Returns `value` moved towards one by `step` of [`STEPS`].
fn towards_one(value: f64, step: usize) -> f64 {
    value + (1.0 - value) * step as f64 / STEPS as f64
}

/// Refuses a `resilience` that no fabric has, with any law.
fn check_resilience(name: &str, resilience: f64) -> Result<(), Error> {
    if resilience > 0.0 && resilience < 1.0 {
        return Ok(());
    }
    Err(Error::InvalidResilience { name: name.to_owned(), percent: 100.0 * resilience })
}

/// Refuses a `linearity` that no fabric has, with any law.
fn check_linearity(name: &str, linearity: f64, origin: &'static str) -> Result<(), Error> {
    if linearity > 0.0 && linearity < 2.0 {
        return Ok(());
    }
    Err(Error::InvalidLinearity { name: name.to_owned(), linearity, origin })
}

/// Returns an error of tensile values with its `direction`.
fn with_direction(error: Error, direction: &str) -> Error {
    match error {
        Error::IncompatibleValues { linearity, resilience, .. } => {
            Error::IncompatibleValues { name: direction.to_owned(), linearity, resilience }
        }
        error => error,
    }
}
