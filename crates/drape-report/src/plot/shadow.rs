//! Shadow of a draped specimen, seen from straight above.

use std::f64::consts::TAU;

use askama::Template;
use serde::Serialize;

use super::style::Placement;
use super::svg::{line, px};
use crate::check;
use crate::error::Error;

/// Shadow of a specimen on the disc of a drapemeter. All lengths are in m.
///
/// ```
/// use drape_report::plot::{ShadowPlot, shadow_svg};
///
/// let edge = (0..90).map(|k| 0.09 + 0.01 * (0.3 * f64::from(k)).sin()).collect();
/// let plot = ShadowPlot { title: "shadow".to_owned(), disc: 0.0635, specimen: 0.127, edge };
/// assert!(shadow_svg(&plot)?.starts_with("<svg"));
/// # Ok::<(), drape_report::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ShadowPlot {
    /// Title.
    pub title: String,
    /// Radius of the disc.
    pub disc: f64,
    /// Radius of the flat specimen.
    pub specimen: f64,
    /// Radius of the shadow's edge at even angles from the weft, clockwise as seen from above.
    pub edge: Vec<f64>,
}

impl ShadowPlot {
    /// Refuses a shadow without an `edge`, and lengths that are not finite and positive.
    ///
    /// # Errors
    /// The first fault.
    pub fn check(&self) -> Result<(), Error> {
        check::text("the title of a plot", &self.title)?;
        if self.edge.len() < 3 {
            let what = "the edge of the shadow".to_owned();
            return Err(Error::EmptyPlot { plot: self.title.clone(), what });
        }
        for length in self.edge.iter().chain([&self.disc, &self.specimen]) {
            check::number(|| format!("{}: a radius", self.title), *length)?;
            if *length <= 0.0 {
                let (what, range) = ("a radius of a shadow", "above 0");
                return Err(Error::OutOfRange { what, value: *length, range });
            }
        }
        Ok(())
    }
}

/// Width and height of the figure, in px.
const SIZE: f64 = 360.0;

/// Height of the line with the scale, in px.
const SCALE_HEIGHT: f64 = 34.0;

/// Room around the largest circle, in px.
const ROOM: f64 = 8.0;

/// Length of the scale, in m.
const SCALE: f64 = 0.05;

/// What the SVG template shows.
#[derive(Template)]
#[template(path = "plot/shadow.svg", escape = "html")]
struct ShadowFigure<'a> {
    title: &'a str,
    style: Option<&'static str>,
    size: String,
    height: String,
    middle: String,
    disc: String,
    specimen: String,
    edge: String,
    scale: [String; 2],
    scale_y: String,
}

/// Draws the shadow `plot` as an SVG file.
///
/// # Errors
/// Errors of [`ShadowPlot::check`].
pub fn shadow_svg(plot: &ShadowPlot) -> Result<String, Error> {
    plot.check()?;
    Ok(shadow_figure(plot, Placement::Standalone))
}

/// Draws the shadow `plot`, which has been checked.
pub(crate) fn shadow_figure(plot: &ShadowPlot, placement: Placement) -> String {
    let middle = 0.5 * SIZE;
    let largest = plot.edge.iter().copied().fold(plot.specimen.max(plot.disc), f64::max);
    let scale = (middle - ROOM) / largest;
    let count = plot.edge.len() as f64;
    let point = |(index, radius): (usize, &f64)| {
        let angle = TAU * index as f64 / count;
        [middle + scale * radius * angle.cos(), middle + scale * radius * angle.sin()]
    };

    let half = 0.5 * scale * SCALE;
    let figure = ShadowFigure {
        title: &plot.title,
        style: placement.style(),
        size: px(SIZE),
        height: px(SIZE + SCALE_HEIGHT),
        middle: px(middle),
        disc: px(scale * plot.disc),
        specimen: px(scale * plot.specimen),
        edge: line(plot.edge.iter().enumerate().map(point)),
        scale: [px(middle - half), px(middle + half)],
        scale_y: px(SIZE + 8.0),
    };
    figure.render().expect("writing to a string does not fail")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_edge_lies_between_disc_and_specimen_to_scale() {
        let plot =
            ShadowPlot { title: "s".to_owned(), disc: 0.05, specimen: 0.1, edge: vec![0.075; 4] };
        let drawn = shadow_svg(&plot).expect("it is whole");
        // The specimen has 172 px of radius, so the edge is at 129 px from the middle, 180.
        assert!(drawn.contains(r#"r="172""#) && drawn.contains(r#"r="86""#), "{drawn}");
        assert!(drawn.contains("M309 180L180 309L51 180L180 51"), "{drawn}");
    }

    #[test]
    fn a_shadow_without_an_edge_is_refused() {
        let plot =
            |edge: Vec<f64>| ShadowPlot { title: "s".to_owned(), disc: 0.05, specimen: 0.1, edge };
        assert!(matches!(plot(Vec::new()).check(), Err(Error::EmptyPlot { .. })));
        assert!(matches!(plot(vec![f64::NAN; 9]).check(), Err(Error::NotFinite { .. })));
        assert!(matches!(plot(vec![0.0; 9]).check(), Err(Error::OutOfRange { .. })));
    }
}
