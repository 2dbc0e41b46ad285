//! Traction law from whichever tensile values a sheet has: the given ones, those that follow from
//! them, and defaults for the rest.

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

/// Returns the traction law of the tensile values, if any is given.
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
    let target = |linearity: f64, resilience: f64| TensileTarget {
        maximum_tension,
        extension: em.or(wt.map(|wt| wt / (half * linearity))).unwrap_or(assumed::EXTENSION),
        linearity,
        resilience,
    };
    // A default must not keep the law from meeting the given values.
    let towards_one = |value: f64, step: usize| value + (1.0 - value) * step as f64 / STEPS as f64;
    let linearity = |step| known.unwrap_or(towards_one(assumed::LINEARITY, step));
    let resilience = |step| rt.unwrap_or(towards_one(assumed::RESILIENCE, step));
    let free = known.is_none() || rt.is_none();
    let mut met = target(linearity(0), resilience(0));
    let mut found = tensile_from_values(&met);
    for step in 1..if free { STEPS } else { 0 } {
        if found.as_ref().is_ok_and(|found| found.deviation <= VALUE_TOLERANCE) {
            break;
        }
        met = target(linearity(step), resilience(step));
        found = tensile_from_values(&met);
    }
    let Matched { law, deviation } = found.map_err(|error| named(error, name))?;

    let TensileTarget { extension, linearity, resilience, .. } = met;
    let mut notes = Vec::new();
    let mut assume = |value: &str, missing: bool, taken: f64| {
        if missing {
            notes.push(format!("{name} {value}: not measured, {taken:.4} taken"));
        }
    };
    assume("LT", known.is_none(), linearity);
    assume("EM", em.is_none() && wt.is_none(), extension);
    assume("RT", rt.is_none(), resilience);
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

/// Refuses a resilience that no fabric has, whatever its law.
fn check_resilience(name: &str, resilience: f64) -> Result<(), Error> {
    if resilience > 0.0 && resilience < 1.0 {
        return Ok(());
    }
    Err(Error::InvalidResilience { name: name.to_owned(), percent: 100.0 * resilience })
}

/// Refuses a linearity that no fabric has, whatever its law.
fn check_linearity(name: &str, linearity: f64, origin: &'static str) -> Result<(), Error> {
    if linearity > 0.0 && linearity < 2.0 {
        return Ok(());
    }
    Err(Error::InvalidLinearity { name: name.to_owned(), linearity, origin })
}

/// Returns an error of tensile values with the direction that it belongs to.
fn named(error: Error, direction: &str) -> Error {
    match error {
        Error::IncompatibleValues { linearity, resilience, .. } => {
            Error::IncompatibleValues { name: direction.to_owned(), linearity, resilience }
        }
        other => other,
    }
}
