use askama::Template;
use serde::Serialize;

use super::Place;
use super::axis::{Axis, Map};
use super::frame::{BOTTOM, Frame, KeyEntry, Sign, WIDTH, dots, key, line, px};
use crate::check;
use crate::error::ReportError;

/// How a series of a graph is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Look {
    /// Dots in the next colour.
    Dots,
    /// A line in the next colour.
    Line,
    /// A pale band beneath the others: what they are held against.
    Exact,
}

/// One series of a graph, in SI.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct GraphSeries {
    /// Its name in the key; series that look alike and have the same name share an entry.
    pub label: String,
    /// How it is drawn.
    pub look: Look,
    /// Its points in order.
    pub points: Vec<[f64; 2]>,
}

/// Any number of series over two axes.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct GraphPlot {
    /// What is shown, as in "bent strips".
    pub title: String,
    /// Across and up.
    pub axes: [Axis; 2],
    /// Which of the axes are logarithmic; their values are positive.
    pub logarithmic: [bool; 2],
    /// Whether one unit is as long up as across: for shapes. Logarithmic axes have no scale.
    pub to_scale: bool,
    /// The series.
    pub series: Vec<GraphSeries>,
}

impl GraphPlot {
    /// Refuses a plot without points, with numbers that are none or have no logarithm, or with a unit of no size.
    pub fn check(&self) -> Result<(), ReportError> {
        check::text("the title of a plot", &self.title)?;
        self.axes.iter().try_for_each(|axis| axis.check(&self.title))?;
        let empty =
            |what: &str| ReportError::EmptyPlot { plot: self.title.clone(), what: what.to_owned() };
        if self.series.is_empty() {
            return Err(empty("the plot"));
        }
        for GraphSeries { label, points, .. } in &self.series {
            check::text("the label of a series", label)?;
            if points.is_empty() {
                return Err(empty(label));
            }
            for (k, point) in points.iter().enumerate() {
                let place = || format!("{}: point {k} of {label}", self.title);
                for (value, logarithmic) in point.iter().zip(self.logarithmic) {
                    check::number(place, *value)?;
                    if logarithmic && *value <= 0.0 {
                        let (what, range) = ("a number on a logarithmic axis", "above 0");
                        return Err(ReportError::OutOfRange { what, value: *value, range });
                    }
                }
            }
        }
        Ok(())
    }
}

/// Height of the frame, in px.
const HEIGHT: f64 = 340.0;
/// Least and largest height of the frame of a plot to scale, in px.
const HEIGHTS: [f64; 2] = [150.0, 640.0];
/// Number of colours that the style knows; further series begin again with the first.
const TONES: usize = 6;

struct Series<'a> {
    class: String,
    data: String,
    label: &'a str,
}

#[derive(Template)]
#[template(path = "graph.svg", escape = "html")]
struct GraphFigure<'a> {
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
    series: Vec<Series<'a>>,
}

/// Draws series over two axes as an SVG file.
pub fn graph_svg(plot: &GraphPlot) -> Result<String, ReportError> {
    plot.check()?;
    Ok(graph_figure(plot, Place::Alone))
}

/// Draws a graph that has been checked.
pub(crate) fn graph_figure(plot: &GraphPlot, place: Place) -> String {
    let classes = classes(&plot.series);
    let mut entries: Vec<(Sign, String, String)> = Vec::new();
    for (series, class) in above(plot, &classes).chain(beneath(plot, &classes)) {
        let sign = if series.look == Look::Dots { Sign::Points } else { Sign::Line };
        let entry = (sign, class.clone(), series.label.clone());
        if !entries.contains(&entry) {
            entries.push(entry);
        }
    }
    let (key, top) = key(entries);
    let (x, y) = maps(plot, top);
    let bottom = top + height(&y);
    let pixel = |point: &[f64; 2]| {
        let [a, b] = [0, 1].map(|k| point[k] / plot.axes[k].in_si);
        [x.pixel(a), y.pixel(b)]
    };
    let drawn = beneath(plot, &classes).chain(above(plot, &classes));
    let series = drawn.map(|(series, class)| {
        let pixels = series.points.iter().map(pixel);
        let (kind, data) = match series.look {
            Look::Dots => ("points", dots(pixels)),
            Look::Line | Look::Exact => ("line", line(pixels)),
        };
        Series { class: format!("{kind} {class}"), data, label: &series.label }
    });
    let figure = GraphFigure {
        style: place.style(),
        title: &plot.title,
        width: px(WIDTH),
        height: px(bottom + BOTTOM),
        key,
        frame: Frame::new(&x, &y, [top, bottom], plot.axes[1].title()),
        x_title: plot.axes[0].title(),
        x_middle: px(0.5 * (Frame::across()[0] + Frame::across()[1])),
        x_title_y: px(bottom + 38.0),
        axes: plot.axes.each_ref(),
        series: series.collect(),
    };
    figure.render().expect("writing to a string does not fail")
}

/// The class of each series: those that are held against have one, the others take the colours in turn.
fn classes(series: &[GraphSeries]) -> Vec<String> {
    let mut tones = (0..TONES).cycle();
    let class = |series: &GraphSeries| match series.look {
        Look::Exact => "exact".to_owned(),
        Look::Dots | Look::Line => format!("tone{}", tones.next().unwrap_or(0)),
    };
    series.iter().map(class).collect()
}

/// The series that are held against others, with their classes.
fn beneath<'a>(
    plot: &'a GraphPlot,
    classes: &'a [String],
) -> impl Iterator<Item = (&'a GraphSeries, &'a String)> {
    plot.series.iter().zip(classes).filter(|(series, _)| series.look == Look::Exact)
}

/// The others.
fn above<'a>(
    plot: &'a GraphPlot,
    classes: &'a [String],
) -> impl Iterator<Item = (&'a GraphSeries, &'a String)> {
    plot.series.iter().zip(classes).filter(|(series, _)| series.look != Look::Exact)
}

/// The axes on the pixels of a frame that begins at a height.
fn maps(plot: &GraphPlot, top: f64) -> (Map, Map) {
    let map = |k: usize, pixels: [f64; 2]| {
        let points = plot.series.iter().flat_map(|series| &series.points);
        let values = points.map(|point| point[k] / plot.axes[k].in_si);
        if plot.logarithmic[k] {
            Map::around_logarithms(values, pixels)
        } else {
            Map::around(values, pixels)
        }
    };
    let across = Frame::across();
    let (x, y) = (map(0, across), map(1, [top + HEIGHT, top]));
    if !plot.to_scale || plot.logarithmic.contains(&true) {
        return (x, y);
    }
    let width = across[1] - across[0];
    // How long a unit is, in px: as long as the width allows, unless the frame becomes too high.
    let units = plot.axes[1].in_si / plot.axes[0].in_si;
    let unit = (width / x.width()).min(HEIGHTS[1] / (y.width() * units));
    let height = (unit * y.width() * units).max(HEIGHTS[0]);
    let (x, y) = (x.widened(width / unit), y.widened(height / (unit * units)));
    (x, y.on([top + height, top]))
}

/// The pixels that an axis takes up.
fn height(y: &Map) -> f64 {
    let [from, to] = y.ends();
    (from - to).abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plot(points: Vec<[f64; 2]>) -> GraphPlot {
        let series = |look| GraphSeries { label: "a".to_owned(), look, points: points.clone() };
        GraphPlot {
            title: "a plot".to_owned(),
            axes: [Axis::new("across", "mm", 1e-3), Axis::new("up", "cm", 1e-2)],
            logarithmic: [false, false],
            to_scale: true,
            series: vec![series(Look::Dots), series(Look::Exact), series(Look::Line)],
        }
    }

    #[test]
    fn a_metre_is_as_long_up_as_across() {
        for points in [
            vec![[0.0, 0.0], [0.3, 0.1]],
            vec![[0.0, 0.0], [0.1, 0.9]],
            vec![[0.0, 0.0], [0.4, 1e-4]],
        ] {
            let plot = plot(points);
            let (x, y) = maps(&plot, 24.0);
            let across = x.pixel(10.0) - x.pixel(0.0);
            let up = y.pixel(0.0) - y.pixel(1.0);
            assert!((across / up - 1.0).abs() < 1e-9, "{across} and {up} px for a centimetre");
            let height = height(&y);
            assert!((HEIGHTS[0]..=HEIGHTS[1] + 1e-9).contains(&height), "{height}");
            for [a, b] in plot.series[0].points.clone() {
                let (a, b) = (x.pixel(a / 1e-3), y.pixel(b / 1e-2));
                assert!((68.0..=706.0).contains(&a) && (24.0..=24.0 + height).contains(&b));
            }
        }
    }

    #[test]
    fn what_is_held_against_takes_no_colour() {
        assert_eq!(classes(&plot(vec![[0.0, 0.0]]).series), ["tone0", "exact", "tone1"]);
    }

    #[test]
    fn nothing_and_what_has_no_logarithm_are_refused() {
        let mut none = plot(Vec::new());
        assert!(matches!(none.check(), Err(ReportError::EmptyPlot { .. })));
        none.series.clear();
        assert!(matches!(none.check(), Err(ReportError::EmptyPlot { .. })));
        let logarithmic = GraphPlot { logarithmic: [true, false], ..plot(vec![[0.0, 1.0]]) };
        assert!(matches!(logarithmic.check(), Err(ReportError::OutOfRange { value: 0.0, .. })));
        assert!(matches!(plot(vec![[f64::NAN, 1.0]]).check(), Err(ReportError::NotFinite { .. })));
    }
}
