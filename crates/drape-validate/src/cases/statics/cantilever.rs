//! Case `heavy-cantilever`: a clamped strip bends under its own weight.
//!
//! The tip's drop over its reach is that of the heavy elastica \[Bic34\], and its error falls with
//! the second order of the spacing.

use super::REST;
use crate::error::ValidationError;
use crate::findings::{Axis, Check, Findings, Graph, Layout, Source};
use crate::reference;
use crate::setup::{Strip, finish};

/// Across and down, over the length of a strip.
const SHAPE: [Axis; 2] = [Axis::ratio("reach over length"), Axis::ratio("height over length")];

/// Shape of a strip that bends under its own weight: across and up over its length, from the clamp
/// on.
fn cantilever(weight: f64, cells: usize) -> Result<Vec<[f64; 2]>, ValidationError> {
    let strip = Strip { cells, ..Strip::default() }.of_weight(weight);
    let mut simulation = strip.simulation(0.0, REST)?;
    finish(&mut simulation)?;
    let line = strip.line(&simulation);
    let free = line.iter().filter(|point| point.distance > 0.0).map(|point| point.position);
    Ok(free.map(|x| [x[0] / strip.length, x[1] / strip.length]).collect())
}

/// Drop over reach of the end of a shape.
fn slant(shape: &[[f64; 2]]) -> f64 {
    shape.last().map_or(f64::NAN, |[across, up]| -up / across)
}

/// The exact shape, drawn as the simulated ones are.
fn elastica(weight: f64) -> Vec<[f64; 2]> {
    let shape = reference::cantilever_shape(weight, 0.0, 100);
    shape.into_iter().map(|[across, down]| [across, -down]).collect()
}

/// The heavy elastica from stiff to limp, and how fast its error falls with the spacing.
pub(crate) fn heavy_cantilever() -> Result<Findings, ValidationError> {
    let exact = |weight: f64| {
        let tip = reference::cantilever(weight, 0.0);
        tip.drop / tip.reach
    };
    let mut checks = Vec::new();
    let mut shapes = Graph::new("strips under their own weight", SHAPE).laid_out(Layout::ToScale);
    for weight in [0.1, 1.0, 3.0, 10.0, 30.0, 60.0, 100.0] {
        let what = format!("drop over reach for wL³/B = {weight}, 40 cells");
        let shape = cantilever(weight, 40)?;
        checks.push(Check::within(what, slant(&shape), exact(weight), 0.01));
        shapes.add(Source::Simulated, format!("wL³/B = {weight}"), shape);
        shapes.add(Source::Reference, "heavy elastica", elastica(weight));
    }
    let error = |cells: usize| -> Result<[f64; 2], ValidationError> {
        let off = slant(&cantilever(60.0, cells)?) - exact(60.0);
        Ok([1.0 / (cells as f64 + 0.5), (off / exact(60.0)).abs()])
    };
    let errors = [error(10)?, error(20)?, error(40)?];
    let order = (errors[1][1] / errors[2][1]).log2();
    checks.push(Check::at_least("order of convergence, wL³/B = 60, 20 to 40 cells", order, 1.8));
    let axes =
        [Axis::ratio("spacing over length"), Axis::new("error of drop over reach", "%", 0.01)];
    let mut orders = Graph::new("error for wL³/B = 60", axes).laid_out(Layout::Logarithmic);
    let second =
        |[spacing, _]: [f64; 2]| [spacing, errors[2][1] * (spacing / errors[2][0]).powi(2)];
    orders.add(Source::Simulated, "strip", errors.to_vec());
    orders.add(Source::Reference, "second order", errors.map(second).to_vec());
    Ok(Findings { checks, graphs: vec![shapes, orders], ..Findings::default() })
}
