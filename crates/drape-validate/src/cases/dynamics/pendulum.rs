//! Case `pendulum`: the period of a stiff strip on a hinge at large amplitudes.
//!
//! Small swings of a rod of length `$L$` on a hinge have the period `$T_0 = 2\pi\sqrt{2L/3g}$`.
//! Swings of the amplitude `$\alpha$` have the period
//! `$T_0/\mathrm{agm}(1, \cos\frac\alpha2)$` \[Gau99\].

use std::f64::consts::TAU;

use super::history::{period, record, time_and_solver};
use crate::error::ValidationError;
use crate::findings::{Axis, Check, Findings, Graph, Source};
use crate::reference;
use crate::setup::{GRAVITY, Hold, Strip};

/// Compares the swings of a short stiff strip on a hinge with the swings of a rod, see
/// [`reference::pendulum_period`].
pub(crate) fn pendulum() -> Result<Findings, ValidationError> {
    let strip = Strip {
        length: 0.05,
        width: 0.01,
        cells: 10,
        hold: Hold::Hinge,
        rigidity: 9e-4,
        ..Strip::default()
    };
    let small_period = TAU * (2.0 * strip.length / (3.0 * GRAVITY)).sqrt();
    let mut checks = Vec::new();
    let axes = [Axis::new("time", "s", 1.0), Axis::ratio("tip, across over length")];
    let mut graph = Graph::new("swing of a stiff strip on a hinge", axes);

    for amplitude in [30.0, 60.0, 90.0_f64] {
        let exact = small_period * reference::pendulum_period(amplitude.to_radians());
        let rest = time_and_solver(exact / 400.0, 4.0 * exact);
        let history =
            record(&strip, amplitude - 90.0, rest, |line| line[line.len() - 1].position[0])?;
        let what = format!("period of a pendulum of {amplitude}°, s");
        checks.push(Check::within(what, period(&history), exact, 0.01));

        let periods = history[history.len() - 1][0] / small_period;
        let swing = reference::pendulum_swing(amplitude.to_radians(), periods, 800);
        let tip = history.iter().map(|[t, x]| [*t, x / strip.length]).collect();
        graph.add(Source::Traced, format!("from {amplitude}°"), tip);
        let swing = swing.into_iter().map(|[t, angle]| [t * small_period, angle.sin()]).collect();
        graph.add(Source::Reference, "rod", swing);
    }
    Ok(Findings { checks, graphs: vec![graph], ..Findings::default() })
}
