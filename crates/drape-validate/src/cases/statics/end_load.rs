//! Case `end-load`: a clamped strip bends under a load at its tip \[BD45\].

use drape_scene::{MotionSpec, PinSpec};

use super::rest;
use crate::error::ValidationError;
use crate::findings::{Axis, Check, Findings, Graph, Source};
use crate::reference;
use crate::setup::{Strip, finish};

/// Returns the force across and down of a pin that holds the tip of a strip without weight, as
/// ratios `$PL^2/B$`. `drop` and `reach` of the tip are over the length.
fn pin_force(drop: f64, reach: f64) -> Result<[f64; 2], ValidationError> {
    let strip = Strip::default();
    let shift = [(reach - 1.0) * strip.length, -drop * strip.length, 0.0];
    let motion =
        MotionSpec { times: vec![0.0, 1.0], shift: vec![[0.0; 3], shift], ..MotionSpec::default() };
    let mut rest = rest();
    rest.gravity = [0.0; 3];
    rest.pin.push(PinSpec {
        panel: "strip".into(),
        edge: Some("right".into()),
        motion: Some(motion),
        ..PinSpec::default()
    });
    // Rest is tested only after the pin has arrived.
    rest.time.ramp = 1.0;
    let mut simulation = strip.simulation(0.0, rest)?;
    finish(&mut simulation)?;
    let [x, y, _] = simulation.pin_loads()[1].force;
    Ok([x, y].map(|force| force / strip.width * strip.length.powi(2) / strip.rigidity))
}

/// Compares a strip without weight, whose tip a pin pulls straight down, with
/// [`reference::cantilever`].
///
/// Two trials give the reach at which the pin's horizontal force is zero. This force is linear in
/// the reach, and steep, because a strip hardly stretches.
pub(crate) fn end_loaded_cantilever() -> Result<Findings, ValidationError> {
    let mut checks = Vec::new();
    let mut simulated = [Vec::new(), Vec::new()];
    for ratio in [1.0, 4.0] {
        let exact = reference::cantilever(0.0, ratio);
        let trials = [exact.reach, exact.reach - 1e-4];
        let [first, second] = trials.map(|reach| pin_force(exact.drop, reach));
        let (first, second) = (first?, second?);
        let part = first[0] / (first[0] - second[0]);
        let load = first[1] + part * (second[1] - first[1]);
        let reach = trials[0] + part * (trials[1] - trials[0]);
        let what = format!("end load PL²/B for the drop of {ratio}");
        checks.push(Check::within(what, load, ratio, 0.01));
        let what = format!("reach over length for the drop of {ratio}");
        checks.push(Check::within(what, reach, exact.reach, 0.01));
        simulated[0].push([load, exact.drop]);
        simulated[1].push([load, reach]);
    }

    let axes = [Axis::ratio("end load PL²/B"), Axis::ratio("over the length")];
    let mut graph = Graph::new("place of the tip of a strip with a load", axes);
    let loads = (1..=50).map(|k| 0.1 * f64::from(k));
    let tips: Vec<_> = loads.map(|load| (load, reference::cantilever(0.0, load))).collect();
    for (label, points) in ["drop", "reach"].into_iter().zip(simulated) {
        let along = tips
            .iter()
            .map(|(load, tip)| [*load, if label == "drop" { tip.drop } else { tip.reach }]);
        graph.add(Source::Simulated, label, points);
        graph.add(Source::Reference, "end-loaded elastica", along.collect());
    }
    Ok(Findings { checks, graphs: vec![graph], ..Findings::default() })
}
