//! Graph of the shadows of a prediction: as fitted, and with each open parameter at its ends.

use crate::drapemeter::{Drapemeter, Prediction, Study};
use crate::findings::{Axis, Graph, Layout, Source};

/// The shadows of a start, as fitted and with each open parameter at its ends.
pub(super) fn shadows(name: &str, meter: &Drapemeter, found: &Prediction) -> Graph {
    let axes = [Axis::new("across", "mm", 1e-3), Axis::new("along", "mm", 1e-3)];
    let mut graph =
        Graph::new(format!("{name}: shadows of a start"), axes).laid_out(Layout::ToScale);
    let mut add = |label: String, study: &Study| {
        let edge = &study.drapes[0].edge;
        let places = (0..=edge.len()).map(|k| on_circle(k, edge.len(), edge[k % edge.len()]));
        graph.add(Source::Traced, label, places.collect());
    };
    add("as fitted".into(), &found.fitted);
    for (parameter, [low, high]) in &found.ends {
        add(format!("{}, limp", parameter.name()), low);
        add(format!("{}, stiff", parameter.name()), high);
    }
    for (label, radius) in [("disc", meter.disc), ("specimen", meter.specimen)] {
        let circle = (0..=180).map(|k| on_circle(k, 180, radius)).collect();
        graph.add(Source::Reference, label, circle);
    }
    graph
}

/// The place at one of so many even angles and a radius.
fn on_circle(number: usize, count: usize, radius: f64) -> [f64; 2] {
    let (sin, cos) = (std::f64::consts::TAU * number as f64 / count as f64).sin_cos();
    [radius * cos, radius * sin]
}
