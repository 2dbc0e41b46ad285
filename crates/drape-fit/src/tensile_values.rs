//! Which tensile values a sheet has, which follow from others, and which must be assumed.

use drape_fabric::TractionLaw;
use drape_kes::Values;

use crate::from_values::{TensileTarget, VALUE_TOLERANCE, tensile_from_values};
use crate::measured::{Found, UNMET};
use crate::{Error, assumed};

/// Difference between WT and ½·LT·FM·EM, relative, that rounding of printed values does not explain.
const CONTRADICTION: f64 = 0.05;
/// Steps in which an assumed LT or RT moves towards one until the values that were measured can be met.
const STEPS: usize = 20;

/// The traction law of the tensile values, if any is there.
///
/// # Errors
/// The values are none of a fabric, or no law here comes near them.
pub(crate) fn tensile_law(name: &str, values: &Values, maximum_tension: f64) -> Found<TractionLaw> {
    let (em, lt) = (values.tensile_extension(), values.tensile_linearity());
    let (wt, rt) = (values.tensile_work(), values.tensile_resilience());
    if [em, lt, wt, rt].iter().all(Option::is_none) {
        return Ok(None);
    }
    // LT, WT and EM are tied by WT = ½·LT·FM·EM: two of them tell the third.
    let half = 0.5 * maximum_tension;
    let known = lt.or_else(|| Some(wt? / (half * em?)));
    possible(name, (lt, known), rt)?;
    let target = |linearity: f64, resilience: f64| TensileTarget {
        maximum_tension,
        extension: em.or(wt.map(|wt| wt / (half * linearity))).unwrap_or(assumed::EXTENSION),
        linearity,
        resilience,
    };
    // What is assumed must not keep what was measured from being met.
    let towards_one = |value: f64, step: usize| value + (1.0 - value) * step as f64 / STEPS as f64;
    let linearity = |step| known.unwrap_or(towards_one(assumed::LINEARITY, step));
    let resilience = |step| rt.unwrap_or(towards_one(assumed::RESILIENCE, step));
    let free = known.is_none() || rt.is_none();
    let mut target_of = target(linearity(0), resilience(0));
    let mut found = tensile_from_values(&target_of);
    for step in 1..if free { STEPS } else { 0 } {
        if found.as_ref().is_ok_and(|(_, misfit)| *misfit <= VALUE_TOLERANCE) {
            break;
        }
        target_of = target(linearity(step), resilience(step));
        found = tensile_from_values(&target_of);
    }
    let (law, misfit) = found.map_err(|error| named(error, name))?;

    let TensileTarget { extension, linearity, resilience, .. } = target_of;
    let mut notes = Vec::new();
    let mut assume = |what: &str, missing: bool, value: f64| {
        if missing {
            notes.push(format!("{name} {what}: not measured, {value:.4} taken"));
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
    if misfit > UNMET {
        notes.push(format!(
            "{name} EM, LT and RT: met to {:.1} % only, no law here is so round and loses so much",
            100.0 * misfit
        ));
    }
    notes.push(format!("{name} traction after stretching: not in the values, as before taken"));
    Ok(Some((law, notes)))
}

/// Refuses values that are none of a fabric, whatever its law.
fn possible(
    name: &str,
    (given, linearity): (Option<f64>, Option<f64>),
    resilience: Option<f64>,
) -> Result<(), Error> {
    let name = || name.to_owned();
    if let Some(resilience) = resilience.filter(|rt| !(*rt > 0.0 && *rt < 1.0)) {
        return Err(Error::Resilience { name: name(), percent: 100.0 * resilience });
    }
    if let Some(linearity) = linearity.filter(|lt| !(*lt > 0.0 && *lt < 2.0)) {
        let origin = if given.is_some() { "given" } else { "made by WT and EM" };
        return Err(Error::Linearity { name: name(), linearity, origin });
    }
    Ok(())
}

fn named(error: Error, direction: &str) -> Error {
    match error {
        Error::Unreachable { linearity, resilience, .. } => {
            Error::Unreachable { name: direction.to_owned(), linearity, resilience }
        }
        other => other,
    }
}
