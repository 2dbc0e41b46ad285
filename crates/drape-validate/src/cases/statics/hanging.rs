//! Cases `catenary` and `self-stretch`: a limp strip between two hinges, and one that hangs
//! straight down.

use drape_scene::{MotionSpec, PinSpec};

use super::rest;
use crate::error::ValidationError;
use crate::findings::{Axis, Check, Findings, Graph, Layout, Source};
use crate::reference;
use crate::setup::{GRAVITY, Hold, Strip, finish};

/// Compares a long limp strip between two hinges at equal height with [`reference::catenary_sag`].
pub(crate) fn catenary() -> Result<Findings, ValidationError> {
    let strip = Strip {
        length: 0.5,
        width: 0.05,
        cells: 100,
        hold: Hold::Hinge,
        rigidity: 1e-7,
        ..Strip::default()
    };
    let mut checks = Vec::new();
    let axes = [Axis::ratio("across over span"), Axis::ratio("height over span")];
    let mut graph = Graph::new("limp strips between two hinges", axes).laid_out(Layout::ToScale);
    for slack in [1.1, 1.5] {
        let span = strip.length / slack;
        let nearer = [span - strip.length, 0.0, 0.0];
        let motion = MotionSpec {
            times: vec![0.0, 1.0],
            shift: vec![[0.0; 3], nearer],
            ..MotionSpec::default()
        };
        let mut rest = rest();
        rest.pin.push(PinSpec {
            panel: "strip".into(),
            edge: Some("right".into()),
            motion: Some(motion),
            ..PinSpec::default()
        });
        let mut simulation = strip.simulation(0.0, rest)?;
        finish(&mut simulation)?;

        let line = strip.line(&simulation);
        let lowest = line.iter().map(|point| -point.position[1]).fold(0.0, f64::max);
        let shape =
            line.iter().map(|point| [point.position[0] / span, point.position[1] / span]).collect();
        graph.add(Source::Simulated, format!("{slack} spans long"), shape);
        graph.add(Source::Reference, "catenary", reference::catenary_shape(slack, 100));
        let what = format!("sag over span for a length of {slack} spans");
        checks.push(Check::within(what, lowest / span, reference::catenary_sag(slack), 0.01));
    }
    Ok(Findings { checks, graphs: vec![graph], ..Findings::default() })
}

/// A strip that hangs straight down stretches by `$wL^2/2k$`.
pub(crate) fn self_stretch() -> Result<Findings, ValidationError> {
    let hold = Hold::Hinge;
    let strip = Strip { length: 1.0, width: 0.1, stiffness: 500.0, hold, ..Strip::default() };
    let mut simulation = strip.simulation(-90.0, rest())?;
    finish(&mut simulation)?;
    let found = -strip.tip(&simulation)[1] - strip.length;
    let exact = 0.5 * strip.density * GRAVITY * strip.length.powi(2) / strip.stiffness;
    Ok(vec![Check::within("stretch of a metre under its own weight, m", found, exact, 0.01)].into())
}
