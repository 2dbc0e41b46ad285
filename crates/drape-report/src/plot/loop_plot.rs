//! Loop plot: a measured load history with the fitted law, its confidence band and the residuals.

use askama::Template;
use serde::Serialize;

use super::axis::Axis;
use super::chart::{Chart, Frame, Heading, Plane};
use super::legend::{Legend, LegendItem, Sign};
use super::scale::Scale;
use super::style::Placement;
use super::svg::{dots, line, px};
use crate::check;
use crate::error::Error;

/// Sample of a load history, in SI.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Point {
    /// Deformation: strain, angle in rad, curvature in 1/m or displacement in m.
    pub deformation: f64,
    /// Measured load. `None` where a law is shown without a measurement.
    pub measured: Option<f64>,
    /// Load of the fitted law. `None` where the law was not evaluated.
    pub fitted: Option<f64>,
    /// Bounds of the 95 % confidence band of the fitted load.
    pub band: Option<[f64; 2]>,
}

/// Direction of a branch of a loop.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum BranchKind {
    /// Away from the start.
    Loading,
    /// Back from the largest deformation.
    Unloading,
    /// From the opposite side back to the side of the start, in a test to both sides.
    Reversal,
}

impl BranchKind {
    const ALL: [BranchKind; 3] = [Self::Loading, Self::Unloading, Self::Reversal];

    /// Returns the name in a legend, as in `loading`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Loading => "loading",
            Self::Unloading => "unloading",
            Self::Reversal => "reversal",
        }
    }
}

/// Branch: part of a history in which the deformation changes in one direction.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Branch {
    /// Direction of the branch.
    pub kind: BranchKind,
    /// Number of the cycle, from 1.
    pub cycle: usize,
    /// Samples in order.
    pub points: Vec<Point>,
}

/// Load history with the fitted law, and the residuals below.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LoopPlot {
    /// Title, as in "tensile, warp".
    pub title: String,
    /// Axis of the deformation.
    pub deformation: Axis,
    /// Axis of the load.
    pub load: Axis,
    /// History, branch by branch.
    pub branches: Vec<Branch>,
    /// Law in the legend, as in "fitted law" or "assumed law".
    pub law: String,
    /// Numbers of a sheet, as points that the loop should pass.
    pub marks: Vec<Mark>,
}

/// Number of a sheet as points that a loop should pass.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Mark {
    /// Symbol, as in "2HB".
    pub label: String,
    /// Points, as deformation and load in SI.
    pub points: Vec<[f64; 2]>,
}

impl LoopPlot {
    /// Refuses a plot without points, numbers that are not finite, and units out of range, as
    /// [`Error`].
    ///
    /// # Errors
    /// The first fault.
    pub fn check(&self) -> Result<(), Error> {
        check::text("the title of a plot", &self.title)?;
        check::text("the law of a plot", &self.law)?;
        for mark in &self.marks {
            check::text("the label of a mark", &mark.label)?;
            for number in mark.points.iter().flatten() {
                check::number(|| format!("{}: the mark {}", self.title, mark.label), *number)?;
            }
        }

        self.deformation.check(&self.title)?;
        self.load.check(&self.title)?;
        let empty = |what: String| Error::EmptyPlot { plot: self.title.clone(), what };
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

    /// Returns the [`Point`]s of all branches in order.
    pub fn points(&self) -> impl Iterator<Item = &Point> {
        self.branches.iter().flat_map(|branch| &branch.points)
    }

    /// Returns the range of the `measured` load, in SI. Returns `None` without a measurement, or
    /// where the load hardly changes.
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

/// Room between both frames, in px.
const GAP: f64 = 14.0;

/// Smallest range of the measured load over the largest load. With a smaller range residuals in %
/// have no meaning.
const LEAST_RANGE: f64 = 1e-9;

/// Smallest range of residuals that the frame shows, in % of the range of the load. A smaller range
/// would show rounding only.
const LEAST_RESIDUAL: f64 = 0.1;

/// Distance of the label of a mark from its point, in px.
const LABEL_GAP: f64 = 7.0;

/// Ratio of the opacities of the points of a cycle and of the cycle before.
const FADING: f64 = 0.72;

/// Smallest opacity of points.
const FAINTEST: f64 = 0.35;

/// Drawn series.
struct Series {
    /// Class that gives the series its colour.
    class: &'static str,
    opacity: String,
    data: String,
    label: String,
}

/// What the SVG template shows.
#[derive(Template)]
#[template(path = "plot/loop.svg", escape = "html")]
struct LoopFigure<'a> {
    chart: Chart<'a>,
    frame: Frame,
    residual_frame: Option<Frame>,
    bands: Vec<String>,
    fits: Vec<String>,
    points: Vec<Series>,
    residuals: Vec<Series>,
    marks: Vec<DrawnMark<'a>>,
}

/// Drawn mark: its points, and the position of its label.
struct DrawnMark<'a> {
    label: &'a str,
    data: String,
    x: String,
    y: String,
}

/// Draws the loop `plot` as an SVG file: measured points, fitted line, confidence band, and the
/// residuals.
///
///
/// Each branch has its colour. Later cycles are paler. The residuals are the measured minus the
/// fitted load, in % of the range of the measured load.
///
/// # Errors
/// Errors of [`LoopPlot::check`].
pub fn loop_svg(plot: &LoopPlot) -> Result<String, Error> {
    plot.check()?;
    Ok(loop_figure(plot, Placement::Standalone))
}

/// Draws the loop `plot`, which has been checked.
pub(crate) fn loop_figure(plot: &LoopPlot, placement: Placement) -> String {
    let legend = Legend::new(legend_items(plot));
    let (top, bottom) = (legend.height, legend.height + LOOP_HEIGHT);
    let axes = [&plot.deformation, &plot.load];
    let loads = plot.points().flat_map(|point| {
        let drawn = point.measured.into_iter().chain(point.fitted);
        drawn.chain(point.band.into_iter().flatten())
    });
    let marked = |axis: usize| {
        plot.marks.iter().flat_map(move |mark| mark.points.iter().map(move |point| point[axis]))
    };
    let loads = loads.chain(marked(1));
    let deformations = plot.points().map(|point| point.deformation).chain(marked(0));
    let plane = Plane::around(axes, deformations, loads, [top, bottom]);

    let range = plot.measured_range();
    let residual = |point: &Point| Some(100.0 * (point.measured? - point.fitted?) / range?);
    let largest = plot.points().filter_map(residual).map(f64::abs);
    let largest = largest.reduce(f64::max);
    let residual_bottom = bottom + GAP + RESIDUAL_HEIGHT;
    let residual_scale = largest.map(|size| {
        let size = size.max(LEAST_RESIDUAL);
        Scale::around([-size, size].into_iter(), [residual_bottom, bottom + GAP])
    });
    let residual_frame =
        residual_scale.map(|scale| Frame::new(&plane.scales[0], &scale, "residual, %".to_owned()));
    let end = residual_frame.as_ref().map_or(bottom, |_| residual_bottom);

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
        dots(points.filter_map(|p| Some(plane.pixel([p.deformation, p.measured?]))))
    });
    let residuals = residual_scale.as_ref().map_or_else(Vec::new, |scale| {
        series(&|branch| {
            let points = branch.points.iter();
            dots(points.filter_map(|p| Some([plane.x(p.deformation), scale.pixel(residual(p)?)])))
        })
    });
    let figure = LoopFigure {
        frame: plane.frame(),
        residual_frame,
        bands: bands(plot, &plane),
        fits: fits(plot, &plane),
        marks: marks(plot, &plane),
        points,
        residuals,
        chart: Chart::new(Heading { title: &plot.title, axes, placement }, legend, end),
    };
    figure.render().expect("writing to a string does not fail")
}

/// Returns the opacity of the points of a `cycle`, as text.
fn opacity(cycle: usize) -> String {
    let power = i32::try_from(cycle.saturating_sub(1)).unwrap_or(i32::MAX);
    px(FADING.powi(power).max(FAINTEST))
}

/// Returns the entries of the legend, for the series that `plot` holds.
fn legend_items(plot: &LoopPlot) -> Vec<LegendItem> {
    let mut items = Vec::new();
    let mut add = |sign, class: &str, label: String| {
        items.push(LegendItem { sign, class: class.to_owned(), label });
    };
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
        add(Sign::Points, kind.name(), label);
    }

    if plot.points().any(|point| point.fitted.is_some()) {
        add(Sign::Line, "fit", plot.law.clone());
    }
    if plot.points().any(|point| point.band.is_some()) {
        add(Sign::Area, "band", "95 % band".to_owned());
    }
    if !plot.marks.is_empty() {
        add(Sign::Points, "mark", "values of the sheet".to_owned());
    }
    items
}

/// Returns the fitted loads of `plot` as lines, one per branch. Each line begins at the end of the
/// line before.
fn fits(plot: &LoopPlot, plane: &Plane<'_>) -> Vec<String> {
    let mut end = None;
    let mut lines = Vec::new();
    for branch in &plot.branches {
        let fitted = branch.points.iter();
        let fitted = fitted.filter_map(|p| Some(plane.pixel([p.deformation, p.fitted?])));
        let joined: Vec<[f64; 2]> = end.into_iter().chain(fitted).collect();
        end = joined.last().copied();
        lines.push(line(joined.into_iter()));
    }
    lines.retain(|data| !data.is_empty());
    lines
}

/// Returns the marks of `plot`, each with its label next to its highest point.
fn marks<'a>(plot: &'a LoopPlot, plane: &Plane<'_>) -> Vec<DrawnMark<'a>> {
    let drawn = |mark: &'a Mark| {
        let pixels: Vec<[f64; 2]> = mark.points.iter().map(|point| plane.pixel(*point)).collect();
        let highest = pixels.iter().copied().reduce(|a, b| if b[1] < a[1] { b } else { a })?;
        Some(DrawnMark {
            label: &mark.label,
            data: dots(pixels.into_iter()),
            x: px(highest[0] - LABEL_GAP),
            y: px(highest[1] - LABEL_GAP),
        })
    };
    plot.marks.iter().filter_map(drawn).collect()
}

/// Returns the confidence bands of `plot` as areas, one per branch.
fn bands(plot: &LoopPlot, plane: &Plane<'_>) -> Vec<String> {
    let areas = plot.branches.iter().map(|branch| {
        let bounded: Vec<(&Point, [f64; 2])> =
            branch.points.iter().filter_map(|point| Some((point, point.band?))).collect();
        let pixel = |point: &Point, load: f64| plane.pixel([point.deformation, load]);
        let lower = bounded.iter().map(|(point, band)| pixel(point, band[0]));
        let upper = bounded.iter().rev().map(|(point, band)| pixel(point, band[1]));
        line(lower.chain(upper))
    });
    let areas = areas.filter(|data| !data.is_empty());
    areas.map(|data| data + "Z").collect()
}
