//! Graph: any number of series over two axes, linear, logarithmic or to scale.

use askama::Template;
use serde::Serialize;

use super::axis::{ACROSS, Axis};
use super::chart::{Chart, Frame, Heading, Plane};
use super::legend::{Legend, LegendItem, Sign};
use super::scale::{Scale, Tick};
use super::style::Placement;
use super::svg::{dots, line, marks, px};
use crate::check;
use crate::error::Error;

/// Look of a series of a graph.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Look {
    /// Dots in the next colour.
    Dots,
    /// A line in the next colour.
    Line,
    /// A short level line at each point, in the next colour.
    Marks,
    /// A pale band beneath the other series: the reference.
    Exact,
}

/// Series of a graph, in SI.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct GraphSeries {
    /// Name in the legend. Series of equal look and name share an entry.
    pub label: String,
    /// Look of the points.
    pub look: Look,
    /// Points in order.
    pub points: Vec<[f64; 2]>,
}

/// Graph: series over two axes.
///
/// ```
/// use drape_report::plot::{Axis, GraphPlot, GraphSeries, Look, graph_svg};
///
/// let errors = |label: &str, look| GraphSeries {
///     label: label.to_owned(),
///     look,
///     points: [0.02, 0.01, 0.005].map(|h| [h, 0.4 * h * h]).to_vec(),
/// };
/// let plot = GraphPlot {
///     title: "error against spacing".to_owned(),
///     axes: [Axis::new("spacing", "mm", 1e-3), Axis::new("error", "%", 0.01)],
///     categories: Vec::new(),
///     logarithmic: [true, true],
///     to_scale: false,
///     series: vec![errors("simulated", Look::Dots), errors("second order", Look::Exact)],
/// };
/// assert!(graph_svg(&plot)?.starts_with("<svg"));
/// # Ok::<(), drape_report::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct GraphPlot {
    /// Title, as in "bent strips".
    pub title: String,
    /// Axes across and up.
    pub axes: [Axis; 2],
    /// Names of the positions 1, 2, … on the x axis, such as materials. Empty for an axis of
    /// numbers.
    pub categories: Vec<String>,
    /// Whether each axis is logarithmic. The values of a logarithmic axis must be positive.
    pub logarithmic: [bool; 2],
    /// Whether lengths have one scale on both axes, for shapes. Ignored with logarithmic axes.
    pub to_scale: bool,
    /// Series in order.
    pub series: Vec<GraphSeries>,
}

impl GraphPlot {
    /// Refuses a plot without points, numbers that are not finite or have no logarithm, and units
    /// out of range, as [`Error`].
    ///
    /// # Errors
    /// The first fault.
    pub fn check(&self) -> Result<(), Error> {
        check::text("the title of a plot", &self.title)?;
        self.axes.iter().try_for_each(|axis| axis.check(&self.title))?;
        self.categories.iter().try_for_each(|name| check::text("a name of a plot", name))?;
        let empty =
            |what: &str| Error::EmptyPlot { plot: self.title.clone(), what: what.to_owned() };

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
                        return Err(Error::OutOfRange { what, value: *value, range });
                    }
                }
            }
        }
        Ok(())
    }
}

/// Height of the frame, in px.
const HEIGHT: f64 = 340.0;

/// Smallest and largest height of the frame of a plot to scale, in px.
const HEIGHTS: [f64; 2] = [150.0, 640.0];

/// Number of colours in the style. Further series begin again with the first colour.
const TONES: usize = 6;

/// Drawn series.
struct Series<'a> {
    class: String,
    data: String,
    label: &'a str,
}

/// Series with its class.
struct Classified<'a> {
    series: &'a GraphSeries,
    class: String,
}

/// What the SVG template shows.
#[derive(Template)]
#[template(path = "plot/graph.svg", escape = "html")]
struct GraphFigure<'a> {
    chart: Chart<'a>,
    frame: Frame,
    series: Vec<Series<'a>>,
}

/// Draws the graph `plot` as an SVG file.
///
/// # Errors
/// Errors of [`GraphPlot::check`].
pub fn graph_svg(plot: &GraphPlot) -> Result<String, Error> {
    plot.check()?;
    Ok(graph_figure(plot, Placement::Standalone))
}

/// Draws the graph `plot`, which has been checked.
pub(crate) fn graph_figure(plot: &GraphPlot, placement: Placement) -> String {
    let classified = classified(&plot.series);
    let references = || classified.iter().filter(|c| c.series.look == Look::Exact);
    let others = || classified.iter().filter(|c| c.series.look != Look::Exact);

    // References stand last in the legend, and are drawn first, beneath the other series.
    let mut items: Vec<LegendItem> = Vec::new();
    for Classified { series, class } in others().chain(references()) {
        let sign = if series.look == Look::Dots { Sign::Points } else { Sign::Line };
        let item = LegendItem { sign, class: class.clone(), label: series.label.clone() };
        if !items.contains(&item) {
            items.push(item);
        }
    }

    let legend = Legend::new(items);
    let axes = plot.axes.each_ref();
    let plane = Plane { axes, scales: scales(plot, legend.height) };
    let [bottom, _] = plane.scales[1].ends();
    let series = references().chain(others()).map(|Classified { series, class }| {
        let pixels = series.points.iter().map(|point| plane.pixel(*point));
        let (kind, data) = match series.look {
            Look::Dots => ("points", dots(pixels)),
            Look::Line | Look::Exact => ("line", line(pixels)),
            Look::Marks => ("line", marks(pixels)),
        };
        Series { class: format!("{kind} {class}"), data, label: &series.label }
    });

    // Positions with names have no numbers and no zero.
    let mut frame = plane.frame();
    if !plot.categories.is_empty() {
        frame.x_ticks = category_ticks(&plot.categories, &plane);
        frame.zero[0] = None;
    }

    let figure = GraphFigure {
        frame,
        series: series.collect(),
        chart: Chart::new(Heading { title: &plot.title, axes, placement }, legend, bottom),
    };
    figure.render().expect("writing to a string does not fail")
}

/// Width of a letter of a tick, in px.
const LETTER: f64 = 7.2;

/// Returns the ticks of positions with `names`. Names are cut where there is no room.
fn category_ticks(names: &[String], plane: &Plane<'_>) -> Vec<Tick> {
    let letters = ((ACROSS[1] - ACROSS[0]) / names.len() as f64 / LETTER) as usize;
    let tick = |(index, name): (usize, &String)| Tick {
        at: px(plane.x(1.0 + index as f64)),
        label: match name.char_indices().nth(letters.max(2)) {
            Some(_) => name.chars().take(letters.max(2) - 1).chain(['…']).collect(),
            None => name.clone(),
        },
    };
    names.iter().enumerate().map(tick).collect()
}

/// Returns each of `series` with its class. References share one class. Other series take the
/// colours in turn.
fn classified(series: &[GraphSeries]) -> Vec<Classified<'_>> {
    let mut tones = (0..TONES).cycle();
    let class = |series| Classified {
        series,
        class: match series.look {
            Look::Exact => "exact".to_owned(),
            Look::Dots | Look::Line | Look::Marks => format!("tone{}", tones.next().unwrap_or(0)),
        },
    };
    series.iter().map(class).collect()
}

/// Returns the scales of the frame of `plot`, whose upper edge is at the pixel `top`.
fn scales(plot: &GraphPlot, top: f64) -> [Scale; 2] {
    let scale = |k: usize, pixels: [f64; 2]| {
        let points = plot.series.iter().flat_map(|series| &series.points);
        let values = points.map(|point| plot.axes[k].in_unit(point[k]));
        if k == 0 && !plot.categories.is_empty() {
            Scale::places(plot.categories.len(), pixels)
        } else if plot.logarithmic[k] {
            Scale::around_logarithms(values, pixels)
        } else {
            Scale::around(values, pixels)
        }
    };

    let (x, y) = (scale(0, ACROSS), scale(1, [top + HEIGHT, top]));
    if !plot.to_scale || plot.logarithmic.contains(&true) {
        return [x, y];
    }
    let width = ACROSS[1] - ACROSS[0];
    // Length of a unit of the x axis, in px. The width of the frame decides it, unless the frame
    // becomes too high.
    let units = plot.axes[1].in_si / plot.axes[0].in_si;
    let unit = (width / x.width()).min(HEIGHTS[1] / (y.width() * units));
    let height = (unit * y.width() * units).max(HEIGHTS[0]);
    let (x, y) = (x.widened(width / unit), y.widened(height / (unit * units)));
    [x, y.on([top + height, top])]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plot(points: Vec<[f64; 2]>) -> GraphPlot {
        let series = |look| GraphSeries { label: "a".to_owned(), look, points: points.clone() };
        GraphPlot {
            title: "a plot".to_owned(),
            axes: [Axis::new("across", "mm", 1e-3), Axis::new("up", "cm", 1e-2)],
            categories: Vec::new(),
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
            let [x, y] = scales(&plot, 24.0);
            let across = x.pixel(10.0) - x.pixel(0.0);
            let up = y.pixel(0.0) - y.pixel(1.0);
            assert!((across / up - 1.0).abs() < 1e-9, "{across} and {up} px for a centimetre");
            let height = y.ends()[0] - y.ends()[1];
            assert!((HEIGHTS[0]..=HEIGHTS[1] + 1e-9).contains(&height), "{height}");
            for [a, b] in plot.series[0].points.clone() {
                let (a, b) = (x.pixel(a / 1e-3), y.pixel(b / 1e-2));
                assert!((68.0..=706.0).contains(&a) && (24.0..=24.0 + height).contains(&b));
            }
        }
    }

    #[test]
    fn references_take_no_colour() {
        let series = plot(vec![[0.0, 0.0]]).series;
        let classes = classified(&series).into_iter().map(|c| c.class);
        assert_eq!(classes.collect::<Vec<_>>(), ["tone0", "exact", "tone1"]);
    }

    #[test]
    fn empty_plots_and_numbers_without_a_logarithm_are_refused() {
        let mut none = plot(Vec::new());
        assert!(matches!(none.check(), Err(Error::EmptyPlot { .. })));
        none.series.clear();
        assert!(matches!(none.check(), Err(Error::EmptyPlot { .. })));
        let logarithmic = GraphPlot { logarithmic: [true, false], ..plot(vec![[0.0, 1.0]]) };
        assert!(matches!(logarithmic.check(), Err(Error::OutOfRange { value: 0.0, .. })));
        assert!(matches!(plot(vec![[f64::NAN, 1.0]]).check(), Err(Error::NotFinite { .. })));
    }
}
