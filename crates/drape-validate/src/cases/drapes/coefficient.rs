//! Cases `drapemeter-cotton` and `drapemeter-wool`: drape coefficients against measured ones
//! \[Mat15\].
//!
//! The values that the KES sheet does not give are varied over their ranges. The measured
//! coefficient must lie within the predicted interval.

use super::super::figure_name;
use super::shadows::shadows;
use super::{STARTS, points, spacing};
use crate::drapemeter::{Drapemeter, Prediction, Sampling};
use crate::error::ValidationError;
use crate::findings::{Check, Findings};
use crate::progress::Progress;
use crate::setup::fabrics::{COTTON, WOOL, fabric};

/// Published measurement of a fabric on the FRL drapemeter \[Mat15\].
struct Measured {
    /// Text of the fabric.
    fabric: &'static str,
    /// Drape coefficient, in %.
    coefficient: f64,
    /// Number of nodes.
    nodes: f64,
}

/// Measurements of cotton and wool.
const MEASURED: [Measured; 2] = [
    Measured { fabric: COTTON, coefficient: 82.9, nodes: 2.0 },
    Measured { fabric: WOOL, coefficient: 49.8, nodes: 5.0 },
];

/// Compares the cotton on the FRL meter with its measurement. Calls `progress` after each start.
pub(crate) fn cotton(progress: &Progress<'_>) -> Result<Findings, ValidationError> {
    drapemeter(&MEASURED[0], progress)
}

/// Compares the wool on the FRL meter with its measurement. Calls `progress` after each start.
pub(crate) fn wool(progress: &Progress<'_>) -> Result<Findings, ValidationError> {
    drapemeter(&MEASURED[1], progress)
}

/// Compares the predicted drape coefficient of a fabric with the coefficient in `measured`.
fn drapemeter(measured: &Measured, progress: &Progress<'_>) -> Result<Findings, ValidationError> {
    /// Largest half of the width of the predicted interval, in points.
    const HALF_WIDTH: f64 = 8.0;

    /// Largest standard deviation over the starts, in points.
    const DEVIATION: f64 = 3.0;

    let meter = Drapemeter::frl();
    let fabric = fabric(measured.fabric)?;
    let name = &fabric.name;
    let sampling = Sampling { spacing: spacing(&fabric, 1.0), starts: STARTS };
    let count = STARTS * (1 + Prediction::study_count(&fabric));

    // The predicted interval must contain the measured coefficient and must be narrow.
    let prediction = Prediction::run(&meter, &fabric, sampling, &|| progress(count))?;
    let [low, high] = prediction.interval().map(|part| 100.0 * part);
    let fitted = points(&prediction.fitted);
    let coefficient = measured.coefficient;
    let half_width = 0.5 * (high - low);
    let mut checks = vec![
        Check::reported(figure_name(name, "measured drape coefficient, %"), coefficient),
        Check::reported(figure_name(name, "with the shear assumed in the fit, %"), fitted),
        Check::at_most(figure_name(name, "lower end of the prediction, %"), low, coefficient),
        Check::at_least(figure_name(name, "upper end of the prediction, %"), high, coefficient),
        Check::at_most(figure_name(name, "half of its width, points"), half_width, HALF_WIDTH),
    ];
    let graphs = vec![shadows(name, &meter, &prediction)];

    let elastic = meter.study(&fabric.without_friction(), sampling, &|| progress(count))?;
    checks.push(Check::reported(figure_name(name, "without friction, %"), points(&elastic)));

    // Nodes and deviation over the starts.
    checks.push(Check::reported(figure_name(name, "nodes as measured"), measured.nodes));
    for (nodes, starts) in prediction.fitted.nodes() {
        let what = figure_name(name, &format!("starts of {STARTS} with {nodes} nodes"));
        checks.push(Check::reported(what, starts as f64));
    }
    let what = figure_name(name, "standard deviation over the starts, points");
    checks.push(Check::at_most(what, 100.0 * prediction.fitted.deviation(), DEVIATION));

    // Both ends of each parameter that the sheet leaves open.
    for (parameter, [low, high]) in &prediction.ends {
        let subject = format!("{name}, {}", parameter.name());
        let what = figure_name(&subject, "drape coefficient at the limp end, %");
        checks.push(Check::reported(what, points(low)));
        checks.push(Check::reported(figure_name(&subject, "at the stiff end, %"), points(high)));
    }
    Ok(Findings { checks, graphs, ..Findings::default() })
}
