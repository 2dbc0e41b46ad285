//! Cases `grid-cotton` and `grid-wool`: drape coefficients on a finer grid and on a turned one.

use super::super::figure_name;
use super::{STARTS, points, spacing};
use crate::drapemeter::{Drapemeter, Protocol, Sampling};
use crate::error::ValidationError;
use crate::findings::{Check, Findings};
use crate::progress::Progress;
use crate::setup::fabrics::{COTTON, WOOL, fabric};

/// Compares the cotton on a finer grid and on a turned grid. Calls `progress` after each start.
pub(crate) fn grid_of_cotton(progress: &Progress<'_>) -> Result<Findings, ValidationError> {
    grid(COTTON, progress)
}

/// Compares the wool on a finer grid and on a turned grid. Calls `progress` after each start.
pub(crate) fn grid_of_wool(progress: &Progress<'_>) -> Result<Findings, ValidationError> {
    grid(WOOL, progress)
}

/// Compares the drape coefficient of the fabric in `text` on a finer grid and on a turned grid.
fn grid(text: &str, progress: &Progress<'_>) -> Result<Findings, ValidationError> {
    /// Largest change of the drape coefficient, in points.
    const CONVERGENCE: f64 = 2.0;

    /// Finer spacing, over the spacing that the fabric needs.
    const FINER: f64 = 0.7;

    let fabric = fabric(text)?;
    let meter = Drapemeter::frl();
    let turned = Drapemeter { protocol: Protocol { turn: 45.0, ..meter.protocol }, ..meter };
    let spacing = spacing(&fabric, 1.0);

    let mut coefficients = Vec::new();
    for (meter, spacing) in [(&meter, spacing), (&meter, FINER * spacing), (&turned, spacing)] {
        let sampling = Sampling { spacing, starts: STARTS };
        let study = meter.study(&fabric, sampling, &|| progress(3 * STARTS))?;
        coefficients.push(points(&study));
    }

    let coefficient = coefficients[0];
    let mut checks = vec![
        Check::reported(figure_name(&fabric.name, "spacing, mm"), 1e3 * spacing),
        Check::reported(figure_name(&fabric.name, "drape coefficient, %"), coefficient),
    ];
    let changes =
        ["change at 0.7 of the spacing, points", "change with the grid turned by 45°, points"];
    for (what, changed) in changes.into_iter().zip(&coefficients[1..]) {
        let change = (changed - coefficient).abs();
        checks.push(Check::at_most(figure_name(&fabric.name, what), change, CONVERGENCE));
    }
    Ok(checks.into())
}
