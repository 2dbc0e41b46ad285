//! Chart: the parts that all plots over two axes share, from values in SI to the frame and the
//! title of the x axis.
//!
//! `loop_plot`, `graph` and `overlay` build a [`Plane`] of their values, take frames and pixels
//! from it, and put a [`Chart`] into their template.

use super::axis::{ACROSS, Axis, LEFT, RIGHT, WIDTH};
use super::legend::{Legend, LegendEntry};
use super::scale::{Scale, Tick};
use super::style::Placement;
use super::svg::px;

/// Room for the labels below a frame, in px.
const BOTTOM: f64 = 46.0;

/// Distance of the title of the x axis below the frame, in px.
const X_TITLE: f64 = 38.0;

/// Two axes with their scales.
pub(crate) struct Plane<'a> {
    pub(crate) axes: [&'a Axis; 2],
    pub(crate) scales: [Scale; 2],
}

impl<'a> Plane<'a> {
    /// Returns the plane of a frame between the pixels `top` and `bottom`, with linear scales
    /// around the values `x` and `y`, in SI.
    pub(crate) fn around(
        axes: [&'a Axis; 2],
        x: impl Iterator<Item = f64>,
        y: impl Iterator<Item = f64>,
        [top, bottom]: [f64; 2],
    ) -> Plane<'a> {
        let [across, up] = axes;
        let x = Scale::around(x.map(|value| across.in_unit(value)), ACROSS);
        let y = Scale::around(y.map(|value| up.in_unit(value)), [bottom, top]);
        Plane { axes, scales: [x, y] }
    }

    /// Returns the pixel of an x coordinate, the `value` in SI.
    pub(crate) fn x(&self, value: f64) -> f64 {
        self.scales[0].pixel(self.axes[0].in_unit(value))
    }

    /// Returns the pixel of a point `x`, `y` in SI.
    pub(crate) fn pixel(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.x(x), self.scales[1].pixel(self.axes[1].in_unit(y))]
    }

    /// Returns the [`Frame`] of the plane.
    pub(crate) fn frame(&self) -> Frame {
        let [x, y] = &self.scales;
        Frame::new(x, y, self.axes[1].title())
    }
}

/// Frame of a plot: a rectangle with ticks, grid and titles.
pub(crate) struct Frame {
    pub(crate) left: String,
    pub(crate) right: String,
    pub(crate) top: String,
    pub(crate) bottom: String,
    pub(crate) width: String,
    pub(crate) height: String,
    pub(crate) x_ticks: Vec<Tick>,
    pub(crate) y_ticks: Vec<Tick>,
    /// Pixels of zero on both axes, where it lies inside the frame.
    pub(crate) zero: [Option<String>; 2],
    pub(crate) y_middle: String,
    pub(crate) y_title: String,
    /// Value, or its decimal logarithm, at pixel 0 and per pixel, for both axes.
    pub(crate) inverse: String,
    /// Letters of the logarithmic axes. Empty without logarithmic axes.
    pub(crate) logarithmic: String,
}

impl Frame {
    /// Returns the frame of the scales `x` and `y`.
    pub(crate) fn new(x: &Scale, y: &Scale, y_title: String) -> Frame {
        let right = WIDTH - RIGHT;
        let [bottom, top] = y.ends();
        let zero = |scale: &Scale| scale.holds(0.0).then(|| px(scale.pixel(0.0)));

        let inverse: Vec<String> = [x.inverse(), y.inverse()]
            .as_flattened()
            .iter()
            .map(|number| format!("{number:.9e}"))
            .collect();

        Frame {
            left: px(LEFT),
            right: px(right),
            top: px(top),
            bottom: px(bottom),
            width: px(right - LEFT),
            height: px(bottom - top),
            x_ticks: x.ticks(),
            y_ticks: y.ticks(),
            zero: [zero(x), zero(y)],
            y_middle: px(0.5 * (top + bottom)),
            y_title,
            inverse: inverse.join(" "),
            logarithmic: [("x", x), ("y", y)]
                .iter()
                .filter_map(|(letter, scale)| scale.logarithmic().then_some(*letter))
                .collect(),
        }
    }
}

/// Title, axes and placement of a plot.
pub(crate) struct Heading<'a> {
    pub(crate) title: &'a str,
    pub(crate) axes: [&'a Axis; 2],
    pub(crate) placement: Placement,
}

/// Parts of a plot over two axes that are independent of its series.
pub(crate) struct Chart<'a> {
    pub(crate) style: Option<&'static str>,
    pub(crate) title: &'a str,
    pub(crate) axes: [&'a Axis; 2],
    pub(crate) width: String,
    pub(crate) height: String,
    pub(crate) legend: Vec<LegendEntry>,
    pub(crate) x_title: String,
    pub(crate) x_middle: String,
    pub(crate) x_title_y: String,
}

impl<'a> Chart<'a> {
    /// Returns the chart of a plot whose last frame ends at the pixel `bottom`.
    pub(crate) fn new(heading: Heading<'a>, legend: Legend, bottom: f64) -> Chart<'a> {
        let Heading { title, axes, placement } = heading;
        Chart {
            style: placement.style(),
            title,
            axes,
            width: px(WIDTH),
            height: px(bottom + BOTTOM),
            legend: legend.entries,
            x_title: axes[0].title(),
            x_middle: px(0.5 * (ACROSS[0] + ACROSS[1])),
            x_title_y: px(bottom + X_TITLE),
        }
    }
}
