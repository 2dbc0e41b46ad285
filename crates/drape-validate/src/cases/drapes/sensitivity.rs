//! Cases `sensitivity-cotton` and `sensitivity-wool`: changes of the drape coefficient as one
//! factor is varied.

use super::{points, spacing};
use crate::drapemeter::{Drapemeter, FACTORS, Factor, Sampling};
use crate::error::ValidationError;
use crate::findings::{Check, Findings};
use crate::progress::Progress;
use crate::setup::fabrics::{COTTON, WOOL, fabric};

const TABLE_STARTS: u64 = 4;

const COARSER: f64 = 1.0 / 0.7;

/// How far the cotton's drape coefficient changes as one thing changes.
pub(crate) fn sensitivity_of_cotton(progress: &Progress<'_>) -> Result<Findings, ValidationError> {
    sensitivity(COTTON, progress)
}

/// How far the wool's drape coefficient changes as one thing changes.
pub(crate) fn sensitivity_of_wool(progress: &Progress<'_>) -> Result<Findings, ValidationError> {
    sensitivity(WOOL, progress)
}

fn sensitivity(text: &str, progress: &Progress<'_>) -> Result<Findings, ValidationError> {
    let fabric = fabric(text)?;
    let sampling = Sampling { spacing: spacing(&fabric, COARSER), starts: TABLE_STARTS };
    let done = || progress(2 * TABLE_STARTS * FACTORS.len() as u64);
    let row = |factor: &Factor| {
        let [low, high] = factor.vary(&Drapemeter::frl(), &fabric, sampling, &done)?;
        let what = format!("{}, {}: change, points", fabric.name, factor.name);
        Ok(Check::reported(what, points(&high) - points(&low)))
    };
    Ok(FACTORS.iter().map(row).collect::<Result<Vec<_>, ValidationError>>()?.into())
}
