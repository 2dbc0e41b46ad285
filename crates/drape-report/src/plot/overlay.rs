use askama::Template;
use serde::Serialize;

use super::Place;
use super::axis::{Axis, Map};
use super::frame::{BOTTOM, Frame, KeyEntry, Sign, WIDTH, key, line, px};
use crate::check;
use crate::error::ReportError;

/// One curve of an overlay, in SI.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Trace {
    /// The curve's name in the key, as in "warp".
    pub label: String,
    /// Deformation and load, in the order of the history.
    pub points: Vec<[f64; 2]>,
}

/// The same test on two fabrics: each fabric has a colour, each of its curves a dash.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OverlayPlot {
    /// What is shown, as in "bending".
    pub title: String,
    /// The deformation.
    pub deformation: Axis,
    /// The load.
    pub load: Axis,
    /// The names of the two fabrics.
    pub fabrics: [String; 2],
    /// The curves of each fabric; at most one of the lists may be empty.
    pub traces: [Vec<Trace>; 2],
}

impl OverlayPlot {
    /// Refuses a plot without points, with numbers that are none, or with a unit of no size.
    pub fn check(&self) -> Result<(), ReportError> {
        check::text("the title of a plot", &self.title)?;
        self.deformation.check(&self.title)?;
        self.load.check(&self.title)?;
        for name in &self.fabrics {
            check::text("the name of a fabric", name)?;
        }
        let empty = |what: String| ReportError::EmptyPlot { plot: self.title.clone(), what };
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

/// Number of dashes that the style knows; further curves begin again with the first.
const DASHES: usize = 4;

struct Series<'a> {
    class: String,
    data: String,
    fabric: &'a str,
    label: &'a str,
}

#[derive(Template)]
#[template(path = "overlay.svg", escape = "html")]
struct OverlayFigure<'a> {
    style: Option<&'static str>,
    title: &'a str,
    width: String,
    height: String,
    key: Vec<KeyEntry>,
    frame: Frame,
    x_title: String,
    x_middle: String,
    x_title_y: String,
    axes: [&'a Axis; 2],
    lines: Vec<Series<'a>>,
}

/// Draws the curves of two fabrics over each other as an SVG file.
pub fn overlay_svg(plot: &OverlayPlot) -> Result<String, ReportError> {
    plot.check()?;
    Ok(overlay_figure(plot, Place::Alone))
}

/// Draws an overlay that has been checked.
pub(crate) fn overlay_figure(plot: &OverlayPlot, place: Place) -> String {
    let dashes = dashes(plot);
    let class = |side: usize, trace: &Trace| {
        let dash = dashes.iter().position(|label| *label == trace.label);
        format!("fabric{} dash{}", side + 1, dash.unwrap_or(0) % DASHES)
    };
    let all = || {
        let sides = plot.traces.iter().enumerate();
        sides.flat_map(|(side, traces)| traces.iter().map(move |trace| (side, trace)))
    };
    let entries = all().map(|(side, trace)| {
        let label = format!("{}, {}", plot.fabrics[side], trace.label);
        (Sign::Line, class(side, trace), label)
    });
    let (key, top) = key(entries.collect());
    let bottom = top + HEIGHT;
    let x_of = |point: &[f64; 2]| point[0] / plot.deformation.in_si;
    let y_of = |point: &[f64; 2]| point[1] / plot.load.in_si;
    let points = || all().flat_map(|(_, trace)| &trace.points);
    let x = Map::around(points().map(x_of), Frame::across());
    let y = Map::around(points().map(y_of), [bottom, top]);
    let lines = all().map(|(side, trace)| Series {
        class: class(side, trace),
        data: line(trace.points.iter().map(|p| [x.pixel(x_of(p)), y.pixel(y_of(p))])),
        fabric: &plot.fabrics[side],
        label: &trace.label,
    });
    let figure = OverlayFigure {
        style: place.style(),
        title: &plot.title,
        width: px(WIDTH),
        height: px(bottom + BOTTOM),
        key,
        frame: Frame::new(&x, &y, [top, bottom], plot.load.title()),
        x_title: plot.deformation.title(),
        x_middle: px(0.5 * (Frame::across()[0] + Frame::across()[1])),
        x_title_y: px(bottom + 38.0),
        axes: [&plot.deformation, &plot.load],
        lines: lines.collect(),
    };
    figure.render().expect("writing to a string does not fail")
}

/// The labels of both fabrics' curves in order of appearance: the same label has the same dash on both.
fn dashes(plot: &OverlayPlot) -> Vec<&str> {
    let mut labels: Vec<&str> = Vec::new();
    for trace in plot.traces.iter().flatten() {
        if !labels.contains(&trace.label.as_str()) {
            labels.push(&trace.label);
        }
    }
    labels
}
