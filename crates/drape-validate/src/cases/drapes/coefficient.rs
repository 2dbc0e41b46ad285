//! Cases `drapemeter-cotton` and `drapemeter-wool`: drape coefficients against measured ones
//! \[Mat15\].
//!
//! The values that the sheet does not give are varied over their range. The measured coefficient
//! lies within the range of the coefficients that follow.

use super::shadows::shadows;
use super::{STARTS, points, spacing};
use crate::drapemeter::{Drapemeter, Prediction, Sampling};
use crate::error::ValidationError;
use crate::findings::{Check, Findings};
use crate::progress::Progress;
use crate::setup::fabrics::{COTTON, WOOL, fabric};

/// How far a prediction may reach to either side, standard deviation over starts, and difference of
/// spacings and of turns; points.
const HALF_WIDTH: f64 = 8.0;

const DEVIATION: f64 = 3.0;

/// Published measurement of a fabric on the FRL drapemeter \[Mat15\].
struct Measured {
    /// Text of the fabric.
    fabric: &'static str,
    /// Drape coefficient, in %.
    coefficient: f64,
    /// Number of nodes.
    nodes: f64,
}

/// Cotton and wool.
const MEASURED: [Measured; 2] = [
    Measured { fabric: COTTON, coefficient: 82.9, nodes: 2.0 },
    Measured { fabric: WOOL, coefficient: 49.8, nodes: 5.0 },
];

/// The cotton on the FRL meter, over what its sheet leaves open.
pub(crate) fn cotton(progress: &Progress<'_>) -> Result<Findings, ValidationError> {
    drapemeter(&MEASURED[0], progress)
}

/// The wool on the FRL meter, over what its sheet leaves open.
pub(crate) fn wool(progress: &Progress<'_>) -> Result<Findings, ValidationError> {
    drapemeter(&MEASURED[1], progress)
}

fn drapemeter(measured: &Measured, progress: &Progress<'_>) -> Result<Findings, ValidationError> {
    let mut checks = Vec::new();
    let mut graphs = Vec::new();
    let meter = Drapemeter::frl();
    let fabric = fabric(measured.fabric)?;
    let what = |what: &str| format!("{}: {what}", fabric.name);
    let sampling = Sampling { spacing: spacing(&fabric, 1.0), starts: STARTS };
    let count = STARTS * (1 + Prediction::studies(&fabric));
    let done = || progress(count);
    let found = Prediction::of(&meter, &fabric, sampling, &done)?;
    let [low, high] = found.interval().map(|part| 100.0 * part);
    checks.extend([
        Check::reported(what("measured drape coefficient, %"), measured.coefficient),
        Check::reported(what("with the shear assumed in the fit, %"), points(&found.fitted)),
        Check::at_most(what("lower end of the prediction, %"), low, measured.coefficient),
        Check::at_least(what("upper end of the prediction, %"), high, measured.coefficient),
        Check::at_most(what("half of its width, points"), 0.5 * (high - low), HALF_WIDTH),
    ]);
    graphs.push(shadows(&fabric.name, &meter, &found));
    let elastic = meter.study(&fabric.without_friction(), sampling, &done)?;
    checks.push(Check::reported(what("without friction, %"), points(&elastic)));
    checks.push(Check::reported(what("nodes as measured"), measured.nodes));
    for (count, times) in found.fitted.nodes() {
        let what = what(&format!("starts of {STARTS} with {count} nodes"));
        checks.push(Check::reported(what, times as f64));
    }
    let deviation = what("standard deviation over the starts, points");
    checks.push(Check::at_most(deviation, 100.0 * found.fitted.deviation(), DEVIATION));
    for (parameter, [low, high]) in &found.ends {
        let what = |what: &str| format!("{}, {}: {what}", fabric.name, parameter.name());
        checks.push(Check::reported(what("drape coefficient at the limp end, %"), points(low)));
        checks.push(Check::reported(what("at the stiff end, %"), points(high)));
    }
    Ok(Findings { checks, graphs, ..Findings::default() })
}
