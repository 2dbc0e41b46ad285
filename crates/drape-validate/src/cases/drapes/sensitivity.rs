//! Cases `sensitivity-cotton` and `sensitivity-wool`: changes of the drape coefficient as one
//! factor is varied.

use super::{points, spacing};
use crate::drapemeter::{Drapemeter, FACTORS, Sampling};
use crate::error::ValidationError;
use crate::findings::{Check, Findings};
use crate::progress::Progress;
use crate::setup::fabrics::{COTTON, WOOL, fabric};

/// Reports the changes of the cotton's drape coefficient as one factor is varied. Calls `progress`
/// after each start.
pub(crate) fn sensitivity_of_cotton(progress: &Progress<'_>) -> Result<Findings, ValidationError> {
    sensitivity(COTTON, progress)
}

/// Reports the changes of the wool's drape coefficient as one factor is varied. Calls `progress`
/// after each start.
pub(crate) fn sensitivity_of_wool(progress: &Progress<'_>) -> Result<Findings, ValidationError> {
    sensitivity(WOOL, progress)
}

/// Reports the changes of the drape coefficient of the fabric in `text` over each of [`FACTORS`].
fn sensitivity(text: &str, progress: &Progress<'_>) -> Result<Findings, ValidationError> {
    /// Starts at each end of a factor.
    const STARTS: u64 = 4;

    /// Spacing over the spacing that the fabric needs. Differences of coefficients of about a
    /// hundred specimens need no finer grid.
    const COARSER: f64 = 1.0 / 0.7;

    let fabric = fabric(text)?;
    let sampling = Sampling { spacing: spacing(&fabric, COARSER), starts: STARTS };
    let count = 2 * STARTS * FACTORS.len() as u64;
    let mut checks = Vec::new();
    for factor in &FACTORS {
        let ends = factor.vary(&Drapemeter::frl(), &fabric, sampling, &|| progress(count))?;
        let [low, high] = ends.map(|study| points(&study));
        let what = format!("{}, {}: change, points", fabric.name, factor.name);
        checks.push(Check::reported(what, high - low));
    }
    Ok(checks.into())
}
