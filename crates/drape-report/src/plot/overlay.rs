//! Overlay: the curves of one test on several fabrics.

use askama::Template;
use serde::Serialize;

use super::axis::Axis;
use super::chart::{Chart, Frame, Heading, Plane};
use super::legend::{Legend, LegendItem, Sign};
use super::style::Placement;
use super::svg::line;
use crate::check;
use crate::error::Error;

/// Curve of an overlay, in SI.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Trace {
    /// Name in the legend, as in "warp".
    pub label: String,
    /// Deformation and load, in the order of the history.
    pub points: Vec<[f64; 2]>,
}

/// Overlay of one test on several fabrics. Each fabric has a colour, and each of its curves has a
/// dash pattern.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OverlayPlot {
    /// Title, as in "bending".
    pub title: String,
    /// Axis of the deformation.
    pub deformation: Axis,
    /// Axis of the load.
    pub load: Axis,
    /// Names of the fabrics.
    pub fabrics: Vec<String>,
    /// Curves of each fabric, in the order of `fabrics`. At least one list must hold a curve.
    pub traces: Vec<Vec<Trace>>,
}

impl OverlayPlot {
    /// Refuses a plot without points, numbers that are not finite, and units out of range, as
    /// [`Error`].
    ///
    /// # Errors
    /// The first fault.
    pub fn check(&self) -> Result<(), Error> {
        check::text("the title of a plot", &self.title)?;
        self.deformation.check(&self.title)?;
        self.load.check(&self.title)?;

        for name in &self.fabrics {
            check::text("the name of a fabric", name)?;
        }
        let empty = |what: String| Error::EmptyPlot { plot: self.title.clone(), what };
        if self.traces.iter().all(Vec::is_empty) {
            return Err(empty("the plot".to_owned()));
        }

        for (name, traces) in self.fabrics.iter().zip(&self.traces) {
            for trace in traces {
                let label = &trace.label;
                check::text("the label of a curve", label)?;
                if trace.points.is_empty() {
                    return Err(empty(format!("{label} of {name}")));
                }
                for (k, point) in trace.points.iter().enumerate() {
                    let place = || format!("{}: point {k} of {label} of {name}", self.title);
                    check::number(place, point[0])?;
                    check::number(place, point[1])?;
                }
            }
        }
        Ok(())
    }
}

/// Height of the frame, in px.
const HEIGHT: f64 = 380.0;

/// Number of colours of fabrics in the style. Further fabrics begin again with the first colour.
pub(crate) const COLOURS: usize = 6;

/// Number of dash patterns in the style. Further curves begin again with the first pattern.
const DASHES: usize = 4;

/// Drawn curve.
struct Series<'a> {
    class: String,
    data: String,
    fabric: &'a str,
    label: &'a str,
}

/// What the SVG template shows.
#[derive(Template)]
#[template(path = "plot/overlay.svg", escape = "html")]
struct OverlayFigure<'a> {
    chart: Chart<'a>,
    frame: Frame,
    lines: Vec<Series<'a>>,
}

/// Draws the overlay `plot` as an SVG file.
///
/// # Errors
/// Errors of [`OverlayPlot::check`].
pub fn overlay_svg(plot: &OverlayPlot) -> Result<String, Error> {
    plot.check()?;
    Ok(overlay_figure(plot, Placement::Standalone))
}

/// Draws the overlay `plot`, which has been checked.
pub(crate) fn overlay_figure(plot: &OverlayPlot, placement: Placement) -> String {
    let dashes = dashes(plot);
    let class = |fabric: usize, trace: &Trace| {
        let dash = dashes.iter().position(|label| *label == trace.label);
        format!("fabric{} dash{}", fabric % COLOURS + 1, dash.unwrap_or(0) % DASHES)
    };
    let all = || {
        let fabrics = plot.fabrics.iter().zip(&plot.traces).enumerate();
        fabrics.flat_map(|(index, (name, traces))| {
            traces.iter().map(move |trace| (index, name.as_str(), trace))
        })
    };

    let items = all().map(|(index, name, trace)| LegendItem {
        sign: Sign::Line,
        class: class(index, trace),
        label: format!("{name}, {}", trace.label),
    });
    let legend = Legend::new(items.collect());

    let (top, bottom) = (legend.height, legend.height + HEIGHT);
    let axes = [&plot.deformation, &plot.load];
    let values =
        |k: usize| all().flat_map(|(_, _, trace)| &trace.points).map(move |point| point[k]);
    let plane = Plane::around(axes, values(0), values(1), [top, bottom]);
    let lines = all().map(|(index, name, trace)| Series {
        class: class(index, trace),
        data: line(trace.points.iter().map(|point| plane.pixel(*point))),
        fabric: name,
        label: &trace.label,
    });

    let figure = OverlayFigure {
        frame: plane.frame(),
        lines: lines.collect(),
        chart: Chart::new(Heading { title: &plot.title, axes, placement }, legend, bottom),
    };
    figure.render().expect("writing to a string does not fail")
}

/// Returns the labels of the curves of `plot` in order of appearance. A label has one dash pattern
/// on all fabrics.
fn dashes(plot: &OverlayPlot) -> Vec<&str> {
    let mut labels: Vec<&str> = Vec::new();
    for trace in plot.traces.iter().flatten() {
        if !labels.contains(&trace.label.as_str()) {
            labels.push(&trace.label);
        }
    }
    labels
}
