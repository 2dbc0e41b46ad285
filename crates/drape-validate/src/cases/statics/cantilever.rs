//! Case `heavy-cantilever`: a clamped strip bends under its own weight.
//!
//! The ratio of the tip's drop and reach is compared with the heavy elastica \[Bic34\]. Its error
//! falls with the second order of the spacing.

use super::rest;
use crate::error::ValidationError;
use crate::findings::{Axis, Check, Findings, Graph, Layout, Source};
use crate::reference;
use crate::setup::{Strip, finish};

/// Across and down, over the length of a strip.
const SHAPE: [Axis; 2] = [Axis::ratio("reach over length"), Axis::ratio("height over length")];

/// Returns the shape of a strip with the ratio `weight` and with `cells` cells, from the clamp to
/// the tip: distance across and height, over the length.
fn cantilever(weight: f64, cells: u32) -> Result<Vec<[f64; 2]>, ValidationError> {
    let strip = Strip { cells: cells as usize, ..Strip::default() }.with_weight(weight);
    let mut simulation = strip.simulation(0.0, rest())?;
    finish(&mut simulation)?;
    let line = strip.line(&simulation);
    let free = line.iter().filter(|point| point.distance > 0.0).map(|point| point.position);
    Ok(free.map(|x| [x[0] / strip.length, x[1] / strip.length]).collect())
}

/// Returns drop over reach of the last point of `shape`.
fn slant(shape: &[[f64; 2]]) -> f64 {
    shape.last().map_or(f64::NAN, |[across, up]| -up / across)
}

/// Returns the exact shape of a strip with the ratio `weight`: distance across and height.
fn elastica(weight: f64) -> Vec<[f64; 2]> {
    let shape = reference::cantilever_shape(weight, 0.0, 100);
    shape.into_iter().map(|[across, down]| [across, -down]).collect()
}

/// Returns drop over reach of the tip of the exact shape of a strip with the ratio `weight`.
fn exact_slant(weight: f64) -> f64 {
    let tip = reference::cantilever(weight, 0.0);
    tip.drop / tip.reach
}

/// Compares strips from stiff to limp with the heavy elastica (see [`reference::cantilever`]), and
/// checks the order of convergence.
pub(crate) fn heavy_cantilever() -> Result<Findings, ValidationError> {
    let mut checks = Vec::new();
    let mut shapes = Graph::new("strips under their own weight", SHAPE).laid_out(Layout::ToScale);
    for weight in [0.1, 1.0, 3.0, 10.0, 30.0, 60.0, 100.0] {
        let what = format!("drop over reach for wL³/B = {weight}, 40 cells");
        let shape = cantilever(weight, 40)?;
        checks.push(Check::within(what, slant(&shape), exact_slant(weight), 0.01));
        shapes.add(Source::Simulated, format!("wL³/B = {weight}"), shape);
        shapes.add(Source::Reference, "heavy elastica", elastica(weight));
    }

    // Spacing over length, and error over the exact value.
    let exact = exact_slant(60.0);
    let mut errors = Vec::new();
    for cells in [10, 20, 40] {
        let error = slant(&cantilever(60.0, cells)?) - exact;
        errors.push([1.0 / (f64::from(cells) + 0.5), (error / exact).abs()]);
    }
    let order = (errors[1][1] / errors[2][1]).log2();
    checks.push(Check::at_least("order of convergence, wL³/B = 60, 20 to 40 cells", order, 1.8));
    let axes =
        [Axis::ratio("spacing over length"), Axis::new("error of drop over reach", "%", 0.01)];
    let mut orders = Graph::new("error for wL³/B = 60", axes).laid_out(Layout::Logarithmic);
    let [finest, error] = errors[2];
    let second_order =
        errors.iter().map(|[spacing, _]| [*spacing, error * (spacing / finest).powi(2)]).collect();
    orders.add(Source::Simulated, "strip", errors);
    orders.add(Source::Reference, "second order", second_order);
    Ok(Findings { checks, graphs: vec![shapes, orders], ..Findings::default() })
}
