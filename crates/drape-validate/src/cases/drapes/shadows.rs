//! Graph of the shadows of a prediction: as fitted, and with each open parameter at its ends.

use crate::drapemeter::{Drapemeter, Prediction, Study};
use crate::findings::{Axis, Graph, Layout, Source};

/// Returns the graph of the shadows of the first start of `prediction`: with the fitted fabric, and
/// with each open parameter at its ends. `name` is the name of the fabric.
pub(super) fn shadows(name: &str, meter: &Drapemeter, prediction: &Prediction) -> Graph {
    let axes = [Axis::new("across", "mm", 1e-3), Axis::new("along", "mm", 1e-3)];
    let mut graph =
        Graph::new(format!("{name}: shadows of a start"), axes).laid_out(Layout::ToScale);

    graph.add(Source::Traced, "as fitted", shadow_edge(&prediction.fitted));
    for (parameter, [low, high]) in &prediction.ends {
        graph.add(Source::Traced, format!("{}, limp", parameter.name()), shadow_edge(low));
        graph.add(Source::Traced, format!("{}, stiff", parameter.name()), shadow_edge(high));
    }
    for (label, radius) in [("disc", meter.disc), ("specimen", meter.specimen)] {
        let circle = (0..=180).map(|k| on_circle(k, 180, radius)).collect();
        graph.add(Source::Reference, label, circle);
    }
    graph
}

/// Returns the closed edge of the shadow of the first start of `study`, in m.
fn shadow_edge(study: &Study) -> Vec<[f64; 2]> {
    let edge = &study.drapes[0].edge;
    (0..=edge.len()).map(|k| on_circle(k, edge.len(), edge[k % edge.len()])).collect()
}

/// Returns the point at the angle `number` of `count` even angles and at `radius`.
fn on_circle(number: usize, count: usize, radius: f64) -> [f64; 2] {
    let (sin, cos) = (std::f64::consts::TAU * number as f64 / count as f64).sin_cos();
    [radius * cos, radius * sin]
}
