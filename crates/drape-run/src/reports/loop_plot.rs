//! Loops of a test as plots draw them: a history branch by branch, or a trace for an overlay.

use drape_kes::{Curve, Test};
use drape_report::plot::{Branch, BranchKind, LoopPlot, Point, Trace};

use super::quantity;

/// Loads at a point of a history, in SI.
#[derive(Default)]
pub struct Loads {
    pub measured: Option<f64>,
    pub fitted: Option<f64>,
    pub band: Option<[f64; 2]>,
}

/// Returns the plot of the history `curve`, branch by branch. `loads` gives the measured and the
/// fitted load at each point.
pub fn loop_plot(title: String, curve: &Curve, loads: impl Fn(usize) -> Loads) -> LoopPlot {
    let [deformation, load] = quantity::axes(curve.test);
    let branches = curve.branches();
    let both_sides = matches!(curve.test, Test::Bending | Test::Shear);
    let first = branches.first().is_some_and(|branch| branch.rising);

    let point = |i: usize| {
        let Loads { measured, fitted, band } = loads(i);
        Point { deformation: curve.deformation()[i], measured, fitted, band }
    };
    let branch = |(index, branch): (usize, &drape_kes::Branch)| Branch {
        kind: match (branch.rising == first, both_sides && index > 0) {
            (true, false) => BranchKind::Loading,
            (true, true) => BranchKind::Reversal,
            (false, _) => BranchKind::Unloading,
        },
        cycle: index / 2 + 1,
        points: branch.points.clone().map(point).collect(),
    };
    let branches = branches.iter().enumerate().map(branch).collect();
    let law = "fitted law".to_owned();
    LoopPlot { title, deformation, load, branches, law, marks: Vec::new() }
}

/// Returns a `curve` as an overlay plot draws it, with the name `label`.
pub fn trace(label: &str, curve: &Curve) -> Trace {
    let points = curve.deformation().iter().zip(curve.load());
    Trace { label: label.into(), points: points.map(|(&q, &f)| [q, f]).collect() }
}
