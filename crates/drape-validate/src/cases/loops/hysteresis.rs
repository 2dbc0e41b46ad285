//! Case `hysteresis`: energy lost in a cycle of bending, and the residual curvature.
//!
//! With the rigidity `$B$` beside a Dahl element of plateau `$F$` and length `$\ell$` \[Dahl68\],
//! the steady loop between `$\pm\kappa$` loses `$4F(\kappa - \ell\tanh(\kappa/\ell))$` per area.

use drape_kes::{Curve, Direction, Test};

use super::super::figure_name;
use super::plot::{axes, points};
use crate::bisection::bisect;
use crate::error::ValidationError;
use crate::findings::{Check, Findings, Graph, Source};
use crate::instrument::{Resolution, measure};
use crate::setup::fabrics::{COTTON, CUPRO, fabric};

/// Compares the energy that a bent specimen loses in a cycle, and its residual curvature, with the
/// closed forms for a linear rigidity beside a Dahl element of plateau `$F$` and length `$\ell$`.
///
/// The steady loop between `$\pm\kappa$` loses `$4F(\kappa - \ell\tanh(\kappa/\ell))$`, and its
/// unloading branch is
/// `$M = B\kappa' - F + 2F e^{(\kappa' - \kappa)/\ell}/(1 + e^{-2\kappa/\ell})$`.
pub(crate) fn hysteresis() -> Result<Findings, ValidationError> {
    /// Points of a branch: the area by trapezoids is then wrong by a thousandth.
    const POINTS: usize = 200;

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
            Resolution { spacing: 0.005, points: POINTS },
        )?;
        let top = curve.deformation_range().high;

        // Energy lost in a cycle.
        let lost = 4.0 * plateau * (top - length * (top / length).tanh());
        let what = figure_name(&fabric.name, "energy lost in a cycle, J/m²");
        checks.push(Check::within(what, steady_area(&curve), lost, 0.02));

        // The residual curvature is where the unloading branch has no moment.
        let turned = 2.0 * plateau / (1.0 + (-2.0 * top / length).exp());
        let branch = UnloadingBranch { rigidity, plateau, length, top, turned };
        let residual = bisect(0.0..top, |curvature| branch.moment(curvature) < 0.0).low;
        let what = figure_name(&fabric.name, "curvature kept after bending, 1/m");
        checks.push(Check::within(what, -residual_curvature(&curve), residual, 0.02));

        // The reloading branch is the image of the unloading branch.
        let title = figure_name(&fabric.name, "bent to both sides");
        let mut graph = Graph::new(title, axes(Test::Bending));
        graph.add(Source::Traced, "specimen", points(&curve));
        for sign in [1.0, -1.0] {
            let curvatures = (0..=120).map(|k| sign * top * (1.0 - f64::from(k) / 60.0));
            let points = curvatures.map(|k| [k, sign * branch.moment(sign * k)]).collect();
            graph.add(Source::Reference, "closed form", points);
        }
        graphs.push(graph);
    }
    Ok(findings)
}

/// Unloading branch of the steady loop of a linear rigidity beside a Dahl element.
struct UnloadingBranch {
    /// Bending rigidity per width, in N·m.
    rigidity: f64,
    /// Plateau of the element, in N.
    plateau: f64,
    /// Length of the element, in 1/m.
    length: f64,
    /// Curvature at which the branch begins, in 1/m.
    top: f64,
    /// Friction by which the element turns at the begin of the branch, in N.
    turned: f64,
}

impl UnloadingBranch {
    /// Returns the moment per width at `curvature`, in N.
    fn moment(&self, curvature: f64) -> f64 {
        let Self { rigidity, plateau, length, top, turned } = self;
        rigidity * curvature - plateau + turned * ((curvature - top) / length).exp()
    }
}

/// Returns the area of the loop between the last two branches of `curve`, which are steady.
fn steady_area(curve: &Curve) -> f64 {
    let branches = curve.branches();
    let steady = branches[branches.len() - 2].points.start..branches[branches.len() - 1].points.end;
    let (q, load) = (&curve.deformation()[steady.clone()], &curve.load()[steady]);
    let halves =
        q.windows(2).zip(load.windows(2)).map(|(q, f)| 0.5 * (f[0] + f[1]) * (q[1] - q[0]));
    halves.sum()
}

/// Returns the curvature at which the last branch of `curve` has no load.
fn residual_curvature(curve: &Curve) -> f64 {
    let branches = curve.branches();
    let last = branches[branches.len() - 1].points.clone();
    let (q, load) = (&curve.deformation()[last.clone()], &curve.load()[last]);
    let crossing = load.windows(2).position(|pair| pair[0] <= 0.0 && pair[1] > 0.0);
    crossing.map_or(f64::NAN, |k| q[k] - load[k] * (q[k + 1] - q[k]) / (load[k + 1] - load[k]))
}
