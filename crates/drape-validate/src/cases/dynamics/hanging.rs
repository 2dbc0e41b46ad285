//! Cases `hanging-chain` and `hanging-strip`: modes of strips that hang.
//!
//! A limp strip has the modes of a chain \[Ber38\]. A clamped strip with bending rigidity has the
//! modes of [`reference::strip_modes`].

use std::f64::consts::TAU;

use super::history::{cosine, period, record, time_and_solver};
use crate::error::ValidationError;
use crate::findings::{Axis, Check, Findings, Graph, Source};
use crate::reference;
use crate::setup::{GRAVITY, Hold, LinePoint, Strip};

/// Returns the Bessel function `$J_0$` of `x`, by its series.
fn bessel(x: f64) -> f64 {
    let (mut sum, mut term) = (0.0, 1.0);
    for k in 1..40 {
        sum += term;
        term *= -0.25 * x * x / f64::from(k * k);
    }
    sum
}

/// Compares small swings of a limp strip that hangs from a hinge, mode by mode, with
/// [`reference::CHAIN_MODES`].
///
/// A straight strip a little off the vertical swings in all modes at once. The modes are orthogonal
/// in the mass. So the deflection weighted with the shape of a mode swings with the frequency of
/// this mode alone.
pub(crate) fn hanging_chain() -> Result<Findings, ValidationError> {
    let strip = Strip {
        length: 0.5,
        width: 0.025,
        cells: 100,
        hold: Hold::Hinge,
        rigidity: 1e-7,
        ..Strip::default()
    };
    let unit = (GRAVITY / strip.length).sqrt();
    let mut checks = Vec::new();
    let axes = [
        Axis::ratio("time over the exact period"),
        Axis::ratio("part of the mode over that at the start"),
    ];
    let mut graph = Graph::new("modes of a limp hanging strip", axes);

    for (number, exact) in reference::CHAIN_MODES.iter().enumerate() {
        let rest = time_and_solver(0.002, 4.0 * TAU / (exact * unit));
        let history = record(&strip, -89.5, rest, |line| {
            weighted_deflection(line, |s| {
                bessel(2.0 * exact * (1.0 - s / strip.length).max(0.0).sqrt())
            })
        })?;
        let measured = TAU / period(&history) / unit;
        let what = format!("mode {} of a hanging chain, ω over √(g/L)", number + 1);
        checks.push(Check::within(what, measured, *exact, 0.01));

        // The first point of the history is after the first step.
        let start = history[0][1] / (exact * unit * history[0][0]).cos();
        let period = TAU / (exact * unit);
        let parts = history.iter().map(|[t, x]| [t / period, x / start]).collect();
        graph.add(Source::Traced, format!("mode {}", number + 1), parts);
    }
    graph.add(Source::Reference, "exact", cosine());
    Ok(Findings { checks, graphs: vec![graph], ..Findings::default() })
}

/// Returns the integral of the deflection times `shape` along the strip with the points `line`, in
/// m². `shape` is the mode at a distance from the hinge, in m.
fn weighted_deflection(line: &[LinePoint], shape: impl Fn(f64) -> f64) -> f64 {
    line.windows(2)
        .map(|pair| {
            let [start, end] =
                [pair[0], pair[1]].map(|point| point.position[0] * shape(point.distance));
            0.5 * (start + end) * (pair[1].distance - pair[0].distance)
        })
        .sum()
}

/// Compares the first mode of a strip that hangs from a clamp and resists bending with
/// [`reference::strip_modes`].
pub(crate) fn hanging_strip() -> Result<Findings, ValidationError> {
    let mut checks = Vec::new();
    let axes =
        [Axis::ratio("time over the exact period"), Axis::ratio("tip over its place at the start")];
    let mut graph = Graph::new("swing of a hanging strip", axes);
    for ratio in [1.0, 10.0, 100.0] {
        let strip = Strip { cells: 20, ..Strip::default() }.with_weight(ratio);
        let unit = (GRAVITY / strip.length).sqrt();
        let exact = reference::strip_modes(1.0 / ratio, 1)[0];
        let period_exact = TAU / (exact * unit);

        // The strip starts straight down and gravity is a little slanted. So the strip swings about
        // a slanted rest.
        let slant: f64 = 0.005;
        let mut rest = time_and_solver(period_exact / 400.0, 4.0 * period_exact);
        rest.gravity = [slant * GRAVITY, -GRAVITY, 0.0];
        let history = record(&strip, -90.0, rest, |line| line[line.len() - 1].position[0])?;
        let middle = history.iter().map(|[_, x]| x).sum::<f64>() / history.len() as f64;
        let centred: Vec<[f64; 2]> = history.iter().map(|[t, x]| [*t, x - middle]).collect();
        let measured = TAU / period(&centred) / unit;
        let what = format!("first mode of a hanging strip with wL³/B = {ratio}, ω over √(g/L)");
        checks.push(Check::within(what, measured, exact, 0.02));

        // The tip starts at zero, at the distance `middle` from its slanted rest.
        let swing = centred.iter().map(|[t, x]| [t / period_exact, -x / middle]).collect();
        graph.add(Source::Traced, format!("wL³/B = {ratio}"), swing);
    }
    graph.add(Source::Reference, "the first mode alone", cosine());
    Ok(Findings { checks, graphs: vec![graph], ..Findings::default() })
}
