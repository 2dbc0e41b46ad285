//! Reader of outlines in the path data of SVG, whose y axis points down.

use kurbo::{Arc, PathEl, Point, SvgArc, Vec2};
use svgtypes::{PathParser, PathSegment};

use crate::edge::{Curve, Edge, distance};
use crate::mistake::Mistake;
use crate::panel::Panel;

/// Largest distance between an elliptical arc and its Bézier curves, over its larger radius.
const ELLIPSE: f64 = 1e-6;

impl Panel {
    /// Returns the panel `name` whose outline is `data`, the data of one closed SVG path, in a unit
    /// of `unit`, in m.
    ///
    /// The y axis of the path points down, the y axis of the panel points up. All commands are
    /// read. Edges are numbered from 1. Circular arcs stay arcs, elliptical arcs become Bézier
    /// curves.
    ///
    /// # Errors
    /// The first mistake of the grammar, or all mistakes of the outline.
    pub fn from_path(name: &str, data: &str, unit: f64) -> Result<Self, Vec<Mistake>> {
        Self::new(name, edges(name, data, unit).map_err(|mistake| vec![mistake])?)
    }
}

/// State of drawing a path, in the unit of the path.
#[derive(Default)]
struct Pen {
    edges: Vec<Edge>,
    /// Number of edges of the subpath that are drawn already.
    number: usize,
    /// Point where the subpath begins.
    start: [f64; 2],
    /// Current point.
    at: [f64; 2],
    /// Last control point of a curve of degree two, and of degree three.
    control: [Option<[f64; 2]>; 2],
}

impl Pen {
    /// Draws an edge with `curve` from the current point to `end`.
    fn to(&mut self, end: [f64; 2], curve: Curve) {
        // SVG drops arcs without length; drawing programs also write lines without length.
        if end != self.at {
            let name = (self.number + self.edges.len() + 1).to_string();
            self.edges.push(Edge::line(name, self.at, end).curved(curve));
        }
        self.at = end;
    }

    /// Returns the last control point of a curve of degree two (`degree` 0) or three (1), reflected
    /// in the current point.
    fn reflected(&self, degree: usize) -> [f64; 2] {
        let control = self.control[degree].unwrap_or(self.at);
        [2.0 * self.at[0] - control[0], 2.0 * self.at[1] - control[1]]
    }

    /// Draws the arc `arc` from the current point to `end`.
    fn arc(&mut self, end: [f64; 2], arc: &SvgArc) {
        let line = Edge::line("", self.at, end);
        match Arc::from_svg_arc(arc) {
            None => self.to(end, Curve::Line),
            Some(_) if arc.radii.x.abs() == arc.radii.y.abs() => {
                // A positive angle runs anticlockwise if y points up. In a path y points down.
                let sweep = line.arc_sweep(arc.radii.x, arc.large_arc, arc.sweep);
                self.to(end, Curve::Arc { sweep });
            }
            Some(whole) => {
                let tolerance = ELLIPSE * arc.radii.x.abs().max(arc.radii.y.abs());
                for part in whole.append_iter(tolerance) {
                    if let PathEl::CurveTo(first, second, to) = part {
                        let [first, second, to] = [first, second, to].map(|p| [p.x, p.y]);
                        self.to(to, Curve::Cubic([first, second]));
                    }
                }
                // Rounding may have moved the last point.
                if let Some(last) = self.edges.last_mut() {
                    last.end = end;
                }
                self.at = end;
            }
        }
    }
}

/// Subpath: a chain of edges, in the unit of the path with y down.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Subpath {
    pub(crate) edges: Vec<Edge>,
    /// Whether the subpath ends with Z.
    pub(crate) closed: bool,
    /// Number of its first command, from 1.
    command: usize,
}

/// Returns the edges of the path `data` of the panel with the name `panel`, in m, with y up. `unit`
/// is the unit of the path, in m.
///
/// # Errors
/// A command cannot be read, or the path has several subpaths.
pub(crate) fn edges(panel: &str, data: &str, unit: f64) -> Result<Vec<Edge>, Mistake> {
    let parts =
        subpaths(data).map_err(|command| Mistake::PathSyntax { panel: panel.into(), command })?;
    if let [_, Subpath { command, .. }, ..] = parts[..] {
        return Err(Mistake::PathParts { panel: panel.into(), command });
    }
    let edges = parts.into_iter().next().map_or(Vec::new(), |mut part| {
        part.edges =
            part.edges.iter().map(|e| e.mapped(true, |[x, y]| [unit * x, -unit * y])).collect();
        part.settled()
    });
    Ok(edges)
}

impl Subpath {
    /// Returns the edges, in m, without a closing edge that comes from the rounding of the digits.
    pub(crate) fn settled(mut self) -> Vec<Edge> {
        let is_rounding = self.edges.last().is_some_and(|edge| {
            edge.curve == Curve::Line && distance(edge.start, edge.end) <= 1e-5
        });
        if self.closed && self.edges.len() > 1 && is_rounding {
            self.edges.pop();
        }
        self.edges
    }
}

/// Returns the subpaths of the path `data`.
///
/// # Errors
/// The number of the first command that cannot be read, from 1.
pub(crate) fn subpaths(data: &str) -> Result<Vec<Subpath>, usize> {
    let mut pen = Pen::default();
    let mut parts: Vec<Subpath> = Vec::new();
    let mut open = false;
    for (index, segment) in PathParser::from(data).enumerate() {
        let command = index + 1;
        let segment = segment.map_err(|_| command)?;
        let begins = matches!(segment, PathSegment::MoveTo { .. });
        if begins || !open {
            // After Z a path goes on from the start of the subpath that it closed.
            (pen.edges, pen.number) = (Vec::new(), 0);
            parts.push(Subpath { edges: Vec::new(), closed: false, command });
            open = true;
        }

        let origin = if segment.is_abs() { [0.0; 2] } else { pen.at };
        let point = |x: f64, y: f64| [origin[0] + x, origin[1] + y];
        let mut control = [None; 2];
        match segment {
            PathSegment::MoveTo { x, y, .. } => {
                pen.at = point(x, y);
                pen.start = pen.at;
            }
            PathSegment::LineTo { x, y, .. } => pen.to(point(x, y), Curve::Line),
            PathSegment::HorizontalLineTo { x, .. } => {
                pen.to([origin[0] + x, pen.at[1]], Curve::Line);
            }
            PathSegment::VerticalLineTo { y, .. } => {
                pen.to([pen.at[0], origin[1] + y], Curve::Line);
            }
            PathSegment::CurveTo { x1, y1, x2, y2, x, y, .. } => {
                let second = point(x2, y2);
                pen.to(point(x, y), Curve::Cubic([point(x1, y1), second]));
                control[1] = Some(second);
            }
            PathSegment::SmoothCurveTo { x2, y2, x, y, .. } => {
                let second = point(x2, y2);
                pen.to(point(x, y), Curve::Cubic([pen.reflected(1), second]));
                control[1] = Some(second);
            }
            PathSegment::Quadratic { x1, y1, x, y, .. } => {
                pen.to(point(x, y), Curve::Quadratic(point(x1, y1)));
                control[0] = Some(point(x1, y1));
            }
            PathSegment::SmoothQuadratic { x, y, .. } => {
                let middle = pen.reflected(0);
                pen.to(point(x, y), Curve::Quadratic(middle));
                control[0] = Some(middle);
            }
            PathSegment::EllipticalArc {
                rx, ry, x_axis_rotation, large_arc, sweep, x, y, ..
            } => {
                let end = point(x, y);
                let arc = SvgArc {
                    from: Point::new(pen.at[0], pen.at[1]),
                    to: Point::new(end[0], end[1]),
                    radii: Vec2::new(rx, ry),
                    x_rotation: x_axis_rotation.to_radians(),
                    large_arc,
                    sweep,
                };
                let is_finite =
                    [rx, ry, x_axis_rotation].into_iter().chain(end).all(f64::is_finite);
                if !is_finite {
                    return Err(command);
                }
                pen.arc(end, &arc);
            }
            PathSegment::ClosePath { .. } => {
                pen.to(pen.start, Curve::Line);
                open = false;
            }
        }

        pen.control = control;
        if let Some(part) = parts.last_mut() {
            part.closed = !open;
            part.edges.append(&mut pen.edges);
            pen.number = part.edges.len();
        }
    }
    Ok(parts)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn area(data: &str) -> f64 {
        let panel = Panel::from_path("p", data, 0.001).unwrap_or_else(|m| panic!("{data}: {m:?}"));
        1e6 * panel.area()
    }

    #[test]
    fn all_commands_absolute_and_relative_enclose_what_they_should() {
        assert!((area("M0 0 H100 V50 H0 Z") - 5000.0).abs() < 1e-6);
        assert!((area("m10,10h100v50l-100,0z") - 5000.0).abs() < 1e-6);
        assert!((area("M0 0 100 0 100 50 0 50 0 0") - 5000.0).abs() < 1e-6, "closed without Z");
        // Two half circles of radius 50, and the same as ellipses that are none.
        assert!((area("M0 0 A50 50 0 0 1 100 0 A50 50 0 0 1 0 0 Z") - PI * 2500.0).abs() < 1e-6);
        assert!((area("M0 0 a50 25 0 1 0 100 0 a50 25 0 1 0 -100 0 z") - PI * 1250.0).abs() < 0.01);
        // Three quarters of a circle, turning right on the screen, and its missing corner.
        let large = area("M50 0 A50 50 0 1 1 0 -50 L0 0 Z");
        assert!((large - 0.75 * PI * 2500.0).abs() < 1e-6, "{large}");
        // A curve of degree two cuts off two thirds of its triangle; the smooth one goes on like
        // it.
        let quadratic = area("M0 0 Q50 50 100 0 T200 0 V100 H0 Z");
        assert!((quadratic - 20_000.0).abs() < 1e-6, "the humps balance: {quadratic}");
        let cubic = area("M0 0 C0 50 100 50 100 0 S200 -50 200 0 V100 H0 Z");
        assert!((cubic - 20_000.0).abs() < 1e-6, "the humps balance: {cubic}");
    }

    #[test]
    fn y_is_turned_up_and_edges_are_numbered() {
        let panel = Panel::from_path("p", "M0 0 L0 100 L100 100 Z", 0.001).expect("it is sound");
        assert!(!panel.was_clockwise(), "left, then down, then right on the screen");
        assert_eq!(panel.outline()[0].end, [0.0, -0.1]);
        let names: Vec<&str> = panel.outline().iter().map(|e| e.name.as_str()).collect();
        assert_eq!(names, ["1", "2", "3"]);
    }

    #[test]
    fn paths_that_are_no_outline_are_refused() {
        let first = |data: &str| Panel::from_path("p", data, 0.001).expect_err(data).remove(0);
        assert!(matches!(first("M0 0 L1 x"), Mistake::PathSyntax { command: 2, .. }));
        assert!(matches!(first("L10 0"), Mistake::PathSyntax { .. } | Mistake::PathParts { .. }));
        let two = first("M0 0H100V100Z M200 0H300V100Z");
        assert!(matches!(two, Mistake::PathParts { command: 5, .. }), "{two}");
        assert!(matches!(first("M0 0 H100 V100 H20"), Mistake::Open { .. }));
        assert!(matches!(first(""), Mistake::FewEdges { edges: 0, .. }));
        assert!(matches!(first("M0 0 H100 V100 H50 V-20 Z"), Mistake::Crossing { .. }));
    }
}
