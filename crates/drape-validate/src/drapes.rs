//! Drape coefficients against measured ones.

use crate::drapemeter::{Drapemeter, Prior, spacing_bound};
use crate::shipped::{COTTON, WOOL, fabric};
use crate::{Axis, Check, Findings, Graph, Layout, Source, ValidationError};

/// Starts of an evaluation.
const STARTS: u64 = 10;
/// How far a prediction may reach to either side, standard deviation over starts, and difference of spacings; points.
const HALF_WIDTH: f64 = 8.0;
const DEVIATION: f64 = 3.0;
const CONVERGENCE: f64 = 2.0;
/// The finer spacing, over the one that the fabric asks for.
const FINER: f64 = 0.7;

/// Two fabrics with measured drape coefficients on the FRL meter, over what their sheets leave open.
pub fn drapemeter() -> Result<Findings, ValidationError> {
    let mut checks = Vec::new();
    let mut graphs = Vec::new();
    for (text, measured) in [(COTTON, 82.9), (WOOL, 49.8)] {
        let fabric = fabric(text)?;
        let name = fabric.name.clone();
        let spacing = spacing_bound(&fabric).min(0.005);
        let study = |fabric: &_, spacing| Drapemeter::FRL.study(fabric, (spacing, STARTS), &|| ());
        let mut means = Vec::new();
        let axes = [Axis::new("across", "mm", 1e-3), Axis::new("along", "mm", 1e-3)];
        let mut graph =
            Graph::new(format!("{name}: shadows of a start"), axes).laid_out(Layout::ToScale);
        for (end, prior) in [("limp", Prior::LIMP), ("stiff", Prior::STIFF)] {
            let changed = prior.of(&fabric).unwrap_or_else(|| fabric.clone());
            let found = study(&changed, spacing)?;
            let what =
                format!("{name}, {end} end: standard deviation over {STARTS} starts, points");
            checks.push(Check::at_most(what, 100.0 * found.deviation(), DEVIATION));
            if end == "limp" {
                let finer = study(&changed, FINER * spacing)?;
                let apart = 100.0 * (finer.mean() - found.mean()).abs();
                let what = format!("{name}, {end} end: change at {FINER} of the spacing, points");
                checks.push(Check::at_most(what, apart, CONVERGENCE));
            }
            means.push(100.0 * found.mean());
            let edge = &found.drapes[0].edge;
            let places = (0..=edge.len()).map(|k| on_circle(k, edge.len(), edge[k % edge.len()]));
            graph.add(Source::Traced, format!("{end} end"), places.collect());
        }
        for (label, radius) in
            [("disc", Drapemeter::FRL.disc), ("specimen", Drapemeter::FRL.specimen)]
        {
            let circle = (0..=180).map(|k| on_circle(k, 180, radius)).collect();
            graph.add(Source::Reference, label, circle);
        }
        graphs.push(graph);
        let what = |end| format!("{name}: drape coefficient at the {end} end and as measured, %");
        checks.push(Check::at_most(what("limp"), means[0], measured));
        checks.push(Check::at_least(what("stiff"), means[1], measured));
        let what = format!("{name}: half of the width of the prediction, points");
        checks.push(Check::at_most(what, 0.5 * (means[1] - means[0]), HALF_WIDTH));
    }
    Ok(Findings { checks, graphs, ..Findings::default() })
}

/// The place at one of so many even angles and a radius.
fn on_circle(number: usize, count: usize, radius: f64) -> [f64; 2] {
    let (sin, cos) = (std::f64::consts::TAU * number as f64 / count as f64).sin_cos();
    [radius * cos, radius * sin]
}
