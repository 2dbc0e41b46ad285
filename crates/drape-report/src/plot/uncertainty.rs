//! Uncertainty plot: the relative errors and intervals of parameters side by side.

use askama::Template;
use drape_input::percent;

use super::scale::{Scale, Tick};
use super::style::Placement;
use super::svg::px;
use crate::error::Error;
use crate::parameter::{Interval, Parameter};
use crate::text::symbol::Symbol;

/// Parameters whose relative uncertainty is compared.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UncertaintyPlot<'a> {
    /// Parameters from top to bottom.
    pub parameters: &'a [Parameter],
}

/// Largest deviation that the axis shows, as a ratio. Longer bars end in arrows.
///
/// A parameter with an error as large as its value is unknown. A larger error says no more.
const LARGEST: f64 = 1.0;
/// Smallest deviation at the end of the axis, as a ratio.
const SMALLEST: f64 = 0.001;

/// Width of the plot, in px. The plot stands beside the correlations.
const WIDTH: f64 = 540.0;
/// Height of a row, in px.
const ROW: f64 = 26.0;
/// Room above the rows, in px.
const TOP: f64 = 8.0;
/// Room below the rows for the axis, in px.
const BOTTOM: f64 = 42.0;
/// Room for the symbols, in px.
const LEFT: f64 = 48.0;
/// Room for the text of the error, in px.
const RIGHT: f64 = 78.0;

/// Row of the plot.
struct Row<'a> {
    symbol: Symbol<'a>,
    middle: String,
    baseline: String,
    /// Ends of the interval.
    interval: Option<[String; 2]>,
    /// Ends of the standard error.
    error: Option<[String; 2]>,
    /// Arrows where a bar leaves the axis or has no end.
    arrows: [Option<String>; 2],
    /// Text in place of a bar. The full reason is too long for a plot.
    reason: Option<&'static str>,
    size: String,
}

/// What the SVG template shows.
#[derive(Template)]
#[template(path = "plot/uncertainty.svg", escape = "html")]
struct UncertaintyFigure<'a> {
    style: Option<&'static str>,
    width: String,
    height: String,
    right: String,
    top: String,
    bottom: String,
    text: String,
    reason: String,
    zero: String,
    title_x: String,
    title_y: String,
    ticks: Vec<Tick>,
    rows: Vec<Row<'a>>,
}

/// Draws the relative uncertainty of the parameters of `plot` as an SVG file: 95 % intervals with
/// standard errors inside.
///
/// # Errors
/// No parameters, or the errors of [`Parameter::check`].
pub fn uncertainty_svg(plot: &UncertaintyPlot<'_>) -> Result<String, Error> {
    if plot.parameters.is_empty() {
        return Err(Error::EmptyPlot {
            plot: "uncertainty".to_owned(),
            what: "the list of parameters".to_owned(),
        });
    }
    for parameter in plot.parameters {
        parameter.check()?;
    }
    Ok(uncertainty_figure(plot, Placement::Standalone))
}

/// Draws the parameters of `plot`, which have been checked.
pub(crate) fn uncertainty_figure(plot: &UncertaintyPlot<'_>, placement: Placement) -> String {
    let spans = plot.parameters.iter().map(deviations);
    let spans: Vec<Deviations> = spans.collect();
    let sizes = spans.iter().flat_map(|span| span.bounds.iter().chain(&span.error));
    let finite = sizes.map(|d| d.abs()).filter(|d| d.is_finite() && *d <= LARGEST);
    let largest = finite.fold(SMALLEST, f64::max);

    let across = [LEFT, WIDTH - RIGHT];
    let scale = Scale::around([-100.0 * largest, 100.0 * largest].into_iter(), across);
    let pixel = |deviation: f64| px(scale.pixel(100.0 * deviation).clamp(across[0], across[1]));
    let rows = plot.parameters.iter().zip(&spans).enumerate();
    let rows = rows.map(|(index, (parameter, Deviations { bounds, error }))| {
        let middle = TOP + ROW * (index as f64 + 0.5);
        let beyond = |bound: f64| !bound.is_nan() && !scale.holds(100.0 * bound);
        Row {
            symbol: Symbol::new(&parameter.symbol),
            middle: px(middle),
            baseline: px(middle + 4.5),
            interval: (!bounds[0].is_nan()).then(|| bounds.map(pixel)),
            error: error.map(|error| [pixel(-error), pixel(error)]),
            arrows: [0, 1].map(|end| beyond(bounds[end]).then(|| arrow(across[end], middle, end))),
            reason: match parameter.interval {
                Interval::Unknown { .. } if error.is_none() => Some("not determined"),
                Interval::Fixed { .. } if error.is_none() => Some("not fitted"),
                _ => None,
            },
            size: error.map_or_else(String::new, |error| format!("± {}", percent(error))),
        }
    });

    let rows: Vec<Row<'_>> = rows.collect();
    let bottom = TOP + ROW * rows.len() as f64;
    let figure = UncertaintyFigure {
        style: placement.style(),
        width: px(WIDTH),
        height: px(bottom + BOTTOM),
        right: px(across[1]),
        top: px(TOP),
        bottom: px(bottom),
        text: px(LEFT - 10.0),
        reason: px(LEFT + 10.0),
        zero: pixel(0.0),
        title_x: px(0.5 * (across[0] + across[1])),
        title_y: px(bottom + 36.0),
        ticks: scale.ticks(),
        rows,
    };
    figure.render().expect("writing to a string does not fail")
}

/// Deviations of an interval and the standard error from the value, divided by the magnitude of the
/// value.
struct Deviations {
    /// Ends of the interval. A missing end is infinite, a missing interval is NaN.
    bounds: [f64; 2],
    error: Option<f64>,
}

/// Returns the deviations of a `parameter`.
fn deviations(parameter: &Parameter) -> Deviations {
    let size = parameter.value.abs();
    if size == 0.0 {
        return Deviations { bounds: [f64::NAN; 2], error: None };
    }
    let deviation = |bound: f64| (bound - parameter.value) / size;
    let bounds = match parameter.interval {
        Interval::Between { lower, upper } => [deviation(lower), deviation(upper)],
        Interval::Above { lower, .. } => [deviation(lower), f64::INFINITY],
        Interval::Below { upper, .. } => [f64::NEG_INFINITY, deviation(upper)],
        Interval::Unknown { .. } | Interval::Fixed { .. } => [f64::NAN; 2],
    };
    Deviations { bounds, error: parameter.relative_error() }
}

/// Returns an arrow head at `end` 0 or 1 of the axis, pointing outwards, as path data.
fn arrow(x: f64, y: f64, end: usize) -> String {
    let out = if end == 0 { -7.0 } else { 7.0 };
    format!("M{} {}L{} {}L{} {}Z", px(x), px(y - 4.5), px(x + out), px(y), px(x), px(y + 4.5))
}
