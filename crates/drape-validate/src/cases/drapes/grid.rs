//! Cases `grid-cotton` and `grid-wool`: drape coefficients on a finer grid and on a turned one.

use super::{STARTS, points, spacing};
use crate::drapemeter::{Drapemeter, Protocol, Sampling};
use crate::error::ValidationError;
use crate::findings::{Check, Findings};
use crate::progress::Progress;
use crate::setup::fabrics::{COTTON, WOOL, fabric};

const CONVERGENCE: f64 = 2.0;

/// The finer spacing, over the one that the fabric asks for; and that of the table of what matters,
/// which is of changes and takes a hundred specimens, at most 5 mm too.
const FINER: f64 = 0.7;

/// The cotton on a finer grid, and on a turned one.
pub(crate) fn grid_of_cotton(progress: &Progress<'_>) -> Result<Findings, ValidationError> {
    grid(COTTON, progress)
}

/// The wool on a finer grid, and on a turned one.
pub(crate) fn grid_of_wool(progress: &Progress<'_>) -> Result<Findings, ValidationError> {
    grid(WOOL, progress)
}

fn grid(text: &str, progress: &Progress<'_>) -> Result<Findings, ValidationError> {
    let fabric = fabric(text)?;
    let meter = Drapemeter::frl();
    let turned = Drapemeter { protocol: Protocol { turn: 45.0, ..meter.protocol }, ..meter };
    let spacing = spacing(&fabric, 1.0);
    let done = || progress(3 * STARTS);
    let study = |meter: &Drapemeter, spacing: f64| {
        meter.study(&fabric, Sampling { spacing, starts: STARTS }, &done)
    };
    let asked = study(&meter, spacing)?;
    let what = |what: &str| format!("{}: {what}", fabric.name);
    let mut checks = vec![
        Check::reported(what("spacing, mm"), 1e3 * spacing),
        Check::reported(what("drape coefficient, %"), points(&asked)),
    ];
    for (other, at) in [
        (study(&meter, FINER * spacing)?, "change at 0.7 of the spacing, points"),
        (study(&turned, spacing)?, "change with the grid turned by 45°, points"),
    ] {
        let change = (points(&other) - points(&asked)).abs();
        checks.push(Check::at_most(what(at), change, CONVERGENCE));
    }
    Ok(checks.into())
}
