use askama::Template;
use serde::Serialize;

use super::Place;
use super::axis::{Axis, Map};
use super::frame::{BOTTOM, Frame, KeyEntry, Sign, WIDTH, dots, key, line, px};
use crate::check;
use crate::error::ReportError;

/// One sample of a history, in SI.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Point {
    /// Deformation: strain, angle in rad, curvature in 1/m or distance in m.
    pub deformation: f64,
    /// Measured load; none where a law is shown without a measurement.
    pub measured: Option<f64>,
    /// Load of the fitted law; none where the law was not evaluated.
    pub fitted: Option<f64>,
    /// Bounds of the fitted load's 95 % band.
    pub band: Option<[f64; 2]>,
}

/// Which way a branch of a loop goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum BranchKind {
    /// Away from the start.
    Loading,
    /// Back from the largest deformation.
    Unloading,
    /// From the other side back to the start's side, in a test that goes to both.
    Reversal,
}

impl BranchKind {
    const ALL: [BranchKind; 3] = [Self::Loading, Self::Unloading, Self::Reversal];

    /// The name in a key.
    pub fn name(self) -> &'static str {
        match self {
            Self::Loading => "loading",
            Self::Unloading => "unloading",
            Self::Reversal => "reversal",
        }
    }
}

/// A stretch of a history in which the deformation goes one way.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Branch {
    /// Which way it goes.
    pub kind: BranchKind,
    /// The cycle that it belongs to, from 1.
    pub cycle: usize,
    /// Its samples in order.
    pub points: Vec<Point>,
}

/// A measured history with the law that was fitted to it, and the residuals beneath.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LoopPlot {
    /// What is shown, as in "tensile, warp".
    pub title: String,
    /// The deformation.
    pub deformation: Axis,
    /// The load.
    pub load: Axis,
    /// The history, branch by branch.
    pub branches: Vec<Branch>,
}

impl LoopPlot {
    /// Refuses a plot without points, with numbers that are none, or with a unit of no size.
    pub fn check(&self) -> Result<(), ReportError> {
        check::text("the title of a plot", &self.title)?;
        self.deformation.check(&self.title)?;
        self.load.check(&self.title)?;
        let empty = |what: String| ReportError::EmptyPlot { plot: self.title.clone(), what };
        if self.branches.is_empty() {
            return Err(empty("the plot".to_owned()));
        }
        for (index, branch) in self.branches.iter().enumerate() {
            let loads = |p: &Point| p.measured.is_some() || p.fitted.is_some();
            if !branch.points.iter().any(loads) {
                return Err(empty(format!("branch {index}")));
            }
            for (k, point) in branch.points.iter().enumerate() {
                let place = |what: &str| {
                    let title = &self.title;
                    format!("{title}: {what} at point {k} of branch {index}")
                };
                check::number(|| place("the deformation"), point.deformation)?;
                for load in point.measured.iter().chain(&point.fitted) {
                    check::number(|| place("the load"), *load)?;
                }
                for bound in point.band.iter().flatten() {
                    check::number(|| place("the band"), *bound)?;
                }
            }
        }
        Ok(())
    }

    /// All samples in order.
    pub fn points(&self) -> impl Iterator<Item = &Point> {
        self.branches.iter().flat_map(|branch| &branch.points)
    }

    /// Range of the measured load, in SI; none without a measurement or where it hardly changes.
    fn measured_range(&self) -> Option<f64> {
        let loads = self.points().filter_map(|point| point.measured);
        let [low, high] = loads.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], load| {
            [low.min(load), high.max(load)]
        });
        let sizes = self.points().flat_map(|point| point.measured.into_iter().chain(point.fitted));
        let size = sizes.map(f64::abs).fold(0.0, f64::max);
        Some(high - low).filter(|range| *range > LEAST_RANGE * size)
    }
}

/// Height of the frame of the loop, in px.
const LOOP_HEIGHT: f64 = 340.0;
/// Height of the frame of the residuals, in px.
const RESIDUAL_HEIGHT: f64 = 92.0;
/// Room between both, in px.
const GAP: f64 = 14.0;

/// Least range of the measured load relative to the largest load: below it residuals in % mean nothing.
const LEAST_RANGE: f64 = 1e-9;

/// Least size of residual that the frame shows, in % of the range: below it they would only show rounding.
const LEAST_RESIDUAL: f64 = 0.1;

/// Opacity of the points of each further cycle relative to the one before.
const FADING: f64 = 0.72;
/// Least opacity of points.
const FAINTEST: f64 = 0.35;

/// A drawn series.
struct Series {
    /// The class that gives it its colour.
    class: &'static str,
    opacity: String,
    data: String,
    /// What a reader of the plot calls it.
    label: String,
}

#[derive(Template)]
#[template(path = "loop.svg", escape = "html")]
struct LoopFigure<'a> {
    style: Option<&'static str>,
    title: &'a str,
    width: String,
    height: String,
    key: Vec<KeyEntry>,
    frame: Frame,
    residual_frame: Option<Frame>,
    x_title: String,
    x_middle: String,
    x_title_y: String,
    axes: [&'a Axis; 2],
    bands: Vec<String>,
    fits: Vec<String>,
    points: Vec<Series>,
    residuals: Vec<Series>,
}

/// Draws a loop as an SVG file: measured points, fitted line, band, and the residuals in % of the range.
///
/// Each branch has its colour; later cycles are paler. The residuals are measured minus fitted, over the
/// range of the measured load.
pub fn loop_svg(plot: &LoopPlot) -> Result<String, ReportError> {
    plot.check()?;
    Ok(loop_figure(plot, Place::Alone))
}

/// Draws a loop that has been checked.
pub(crate) fn loop_figure(plot: &LoopPlot, place: Place) -> String {
    let (key, top) = key(key_entries(plot));
    let bottom = top + LOOP_HEIGHT;
    let x_of = |point: &Point| point.deformation / plot.deformation.in_si;
    let y_of = |load: f64| load / plot.load.in_si;
    let x = Map::around(plot.points().map(x_of), Frame::across());
    let loads = plot.points().flat_map(|point| {
        let drawn = point.measured.into_iter().chain(point.fitted);
        drawn.chain(point.band.into_iter().flatten())
    });
    let y = Map::around(loads.map(y_of), [bottom, top]);
    let frame = Frame::new(&x, &y, [top, bottom], plot.load.title());

    let range = plot.measured_range();
    let residual = |point: &Point| Some(100.0 * (point.measured? - point.fitted?) / range?);
    let largest = plot.points().filter_map(residual).map(f64::abs);
    let largest = largest.reduce(f64::max);
    let residual_bounds = [bottom + GAP, bottom + GAP + RESIDUAL_HEIGHT];
    let residual_map = largest.map(|size| {
        let size = size.max(LEAST_RESIDUAL);
        let [top, bottom] = residual_bounds;
        Map::around([-size, size].into_iter(), [bottom, top])
    });
    let residual_frame =
        residual_map.map(|map| Frame::new(&x, &map, residual_bounds, "residual, %".to_owned()));
    let end = residual_frame.as_ref().map_or(bottom, |_| residual_bounds[1]);

    let series = |data: &dyn Fn(&Branch) -> String| -> Vec<Series> {
        let drawn = plot.branches.iter().map(|branch| Series {
            class: branch.kind.name(),
            opacity: opacity(branch.cycle),
            data: data(branch),
            label: format!("{}, cycle {}", branch.kind.name(), branch.cycle),
        });
        drawn.filter(|series| !series.data.is_empty()).collect()
    };
    let points = series(&|branch| {
        let points = branch.points.iter();
        dots(points.filter_map(|p| Some([x.pixel(x_of(p)), y.pixel(y_of(p.measured?))])))
    });
    let residuals = residual_map.as_ref().map_or_else(Vec::new, |map| {
        series(&|branch| {
            let points = branch.points.iter();
            dots(points.filter_map(|p| Some([x.pixel(x_of(p)), map.pixel(residual(p)?)])))
        })
    });
    let figure = LoopFigure {
        style: place.style(),
        title: &plot.title,
        width: px(WIDTH),
        height: px(end + BOTTOM),
        key,
        frame,
        residual_frame,
        x_title: plot.deformation.title(),
        x_middle: px(0.5 * (Frame::across()[0] + Frame::across()[1])),
        x_title_y: px(end + 38.0),
        axes: [&plot.deformation, &plot.load],
        bands: bands(plot, |point, load| [x.pixel(x_of(point)), y.pixel(y_of(load))]),
        fits: fits(plot, |point, load| [x.pixel(x_of(point)), y.pixel(y_of(load))]),
        points,
        residuals,
    };
    figure.render().expect("writing to a string does not fail")
}

/// How strong the points of a cycle are drawn.
fn opacity(cycle: usize) -> String {
    let power = i32::try_from(cycle.saturating_sub(1)).unwrap_or(i32::MAX);
    px(FADING.powi(power).max(FAINTEST))
}

/// The entries of the key: what the plot holds, and nothing else.
fn key_entries(plot: &LoopPlot) -> Vec<(Sign, String, String)> {
    let mut entries = Vec::new();
    let measured = |branch: &&Branch| branch.points.iter().any(|p| p.measured.is_some());
    for kind in BranchKind::ALL {
        let branches = plot.branches.iter().filter(|branch| branch.kind == kind);
        let cycles: Vec<usize> = branches.filter(measured).map(|branch| branch.cycle).collect();
        let (Some(first), Some(last)) = (cycles.iter().min(), cycles.iter().max()) else {
            continue;
        };
        let label = if first == last {
            kind.name().to_owned()
        } else {
            format!("{}, cycles {first}–{last}", kind.name())
        };
        entries.push((Sign::Points, kind.name().to_owned(), label));
    }
    if plot.points().any(|point| point.fitted.is_some()) {
        entries.push((Sign::Line, "fit".to_owned(), "fitted law".to_owned()));
    }
    if plot.points().any(|point| point.band.is_some()) {
        entries.push((Sign::Area, "band".to_owned(), "95 % band".to_owned()));
    }
    entries
}

/// The fitted loads as lines, one per branch, each beginning where the one before it ended.
fn fits(plot: &LoopPlot, pixel: impl Fn(&Point, f64) -> [f64; 2]) -> Vec<String> {
    let mut end = None;
    let mut lines = Vec::new();
    for branch in &plot.branches {
        let fitted = branch.points.iter();
        let fitted = fitted.filter_map(|point| Some(pixel(point, point.fitted?)));
        let joined: Vec<[f64; 2]> = end.into_iter().chain(fitted).collect();
        end = joined.last().copied();
        lines.push(line(joined.into_iter()));
    }
    lines.retain(|data| !data.is_empty());
    lines
}

/// The bands as areas, one per branch.
fn bands(plot: &LoopPlot, pixel: impl Fn(&Point, f64) -> [f64; 2]) -> Vec<String> {
    let areas = plot.branches.iter().map(|branch| {
        let bounded: Vec<(&Point, [f64; 2])> =
            branch.points.iter().filter_map(|point| Some((point, point.band?))).collect();
        let lower = bounded.iter().map(|(point, band)| pixel(point, band[0]));
        let upper = bounded.iter().rev().map(|(point, band)| pixel(point, band[1]));
        line(lower.chain(upper))
    });
    let areas = areas.filter(|data| !data.is_empty());
    areas.map(|data| data + "Z").collect()
}
