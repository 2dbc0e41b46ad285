//! Case `hysteresis`: energy lost in a cycle of bending, and the residual curvature.
//!
//! With the rigidity `$B$` beside a Dahl element of plateau `$F$` and length `$\ell$` \[Dahl68\], the
//! steady loop between `$\pm\kappa$` loses `$4F(\kappa - \ell\tanh(\kappa/\ell))$` per area.

use drape_kes::{Curve, Direction, Test};

use super::plot::{axes, points};
use crate::bisection::bisect;
use crate::error::ValidationError;
use crate::findings::{Check, Findings, Graph, Source};
use crate::instrument::{Resolution, measure};
use crate::setup::fabrics::{COTTON, CUPRO, fabric};

/// Points of a branch where the area of a loop is wanted: trapezoids then err by a thousandth.
const FINE: usize = 200;

/// Energy that a bent specimen loses in a cycle, and the curvature that it keeps, against the
/// closed forms for a linear rigidity beside a Dahl element of plateau `$F$` and length `$\ell$`:
/// the steady loop between `$\pm\kappa$` loses `$4F(\kappa - \ell\tanh(\kappa/\ell))$`, and its
/// unloading branch is
/// `$M = B\kappa' - F + 2F e^{(\kappa' - \kappa)/\ell}/(1 + e^{-2\kappa/\ell})$`.
pub(crate) fn hysteresis() -> Result<Findings, ValidationError> {
    let mut findings = Findings::default();
    let Findings { checks, graphs, .. } = &mut findings;
    for text in [CUPRO, COTTON] {
        let fabric = fabric(text)?;
        let law = fabric.weft.bending;
        let rigidity = law.backbone.respond(0.0).tangent;
        let element = law.friction.elements[0];
        let (plateau, length) = (element.plateau, element.length);
        let curve = measure(
            &fabric,
            Test::Bending,
            Direction::Weft,
            Resolution { spacing: 0.005, points: FINE },
        )?;
        let top = curve.deformation_range().high;
        let what = |what: &str| format!("{}: {what}", fabric.name);
        let lost = 4.0 * plateau * (top - length * (top / length).tanh());
        let found = steady_area(&curve);
        checks.push(Check::within(what("energy lost in a cycle, J/m²"), found, lost, 0.02));
        let turned = 2.0 * plateau / (1.0 + (-2.0 * top / length).exp());
        let moment = |k: f64| rigidity * k - plateau + turned * ((k - top) / length).exp();
        let kept = bisect(0.0..top, |curvature| moment(curvature) < 0.0).low;
        let found = -kept_curvature(&curve);
        checks.push(Check::within(what("curvature kept after bending, 1/m"), found, kept, 0.02));
        let mut graph = Graph::new(what("bent to both sides"), axes(Test::Bending));
        graph.add(Source::Traced, "specimen", points(&curve));
        // The unloading branch, and the reloading one that is its image.
        let branch = |sign: f64| {
            let at = |k: u32| sign * top * (1.0 - f64::from(k) / 60.0);
            (0..=120).map(|k| [at(k), sign * moment(sign * at(k))]).collect()
        };
        graph.add(Source::Reference, "closed form", branch(1.0));
        graph.add(Source::Reference, "closed form", branch(-1.0));
        graphs.push(graph);
    }
    Ok(findings)
}

/// Area of the loop between the curve's last two branches, which are steady.
fn steady_area(curve: &Curve) -> f64 {
    let branches = curve.branches();
    let steady = branches[branches.len() - 2].points.start..branches[branches.len() - 1].points.end;
    let (q, load) = (&curve.deformation()[steady.clone()], &curve.load()[steady]);
    let halves =
        q.windows(2).zip(load.windows(2)).map(|(q, f)| 0.5 * (f[0] + f[1]) * (q[1] - q[0]));
    halves.sum()
}

/// Where the last branch crosses the line of no load.
fn kept_curvature(curve: &Curve) -> f64 {
    let branches = curve.branches();
    let last = branches[branches.len() - 1].points.clone();
    let (q, load) = (&curve.deformation()[last.clone()], &curve.load()[last]);
    let crossing = load.windows(2).position(|pair| pair[0] <= 0.0 && pair[1] > 0.0);
    crossing.map_or(f64::NAN, |k| q[k] - load[k] * (q[k + 1] - q[k]) / (load[k + 1] - load[k]))
}
