//! Reader of outlines in the path data of SVG, whose y axis points down.

use kurbo::{Arc, PathEl, Point, SvgArc, Vec2};
use svgtypes::{PathParser, PathSegment};

use crate::edge::{Curve, Edge, distance};
use crate::mistake::Mistake;
use crate::panel::Panel;

/// Largest distance of the Bézier curves of an elliptical arc from it, over its larger radius.
const ELLIPSE: f64 = 1e-6;

impl Panel {
    /// Returns a panel whose outline is the data of one closed SVG path, in a unit in m.
    ///
    /// The y axis of the path points down, that of the panel up. All commands are read; edges are
    /// numbered from 1. Circular arcs stay arcs, elliptical ones become Bézier curves.
    ///
    /// # Errors
    /// The first mistake of the grammar, or all mistakes of the outline.
    pub fn from_path(name: &str, data: &str, unit: f64) -> Result<Self, Vec<Mistake>> {
        Self::new(name, edges(name, data, unit).map_err(|mistake| vec![mistake])?)
    }
}

/// State of drawing a path, in its own unit.
#[derive(Default)]
struct Pen {
    edges: Vec<Edge>,
    start: [f64; 2],
    at: [f64; 2],
    /// Last control point of a curve of degree two, and of degree three.
    control: [Option<[f64; 2]>; 2],
}

impl Pen {
    /// Draws an edge to a point.
    fn to(&mut self, end: [f64; 2], curve: Curve) {
        // SVG drops arcs without length; drawing programs also write lines without length.
        if end != self.at {
            let name = (self.edges.len() + 1).to_string();
            self.edges.push(Edge::line(name, self.at, end).curved(curve));
        }
        self.at = end;
    }

    /// Returns the last control point, reflected in the current point.
    fn reflected(&self, degree: usize) -> [f64; 2] {
        let control = self.control[degree].unwrap_or(self.at);
        [2.0 * self.at[0] - control[0], 2.0 * self.at[1] - control[1]]
    }

    /// Draws an arc to a point.
    fn arc(&mut self, end: [f64; 2], arc: &SvgArc) {
        let line = Edge::line("", self.at, end);
        match Arc::from_svg_arc(arc) {
            None => self.to(end, Curve::Line),
            Some(_) if arc.radii.x.abs() == arc.radii.y.abs() => {
                // A positive angle runs anticlockwise where y points up, and clockwise here.
                let sweep = line.arc_sweep(arc.radii.x, arc.large_arc, arc.sweep);
                self.to(end, Curve::Arc { sweep });
            }
            Some(whole) => {
                let tolerance = ELLIPSE * arc.radii.x.abs().max(arc.radii.y.abs());
                let pair = |p: Point| [p.x, p.y];
                for part in whole.append_iter(tolerance) {
                    if let PathEl::CurveTo(first, second, to) = part {
                        self.to(pair(to), Curve::Cubic([pair(first), pair(second)]));
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

/// Returns the edges of a path, in m, with y up.
pub(crate) fn edges(panel: &str, data: &str, unit: f64) -> Result<Vec<Edge>, Mistake> {
    let mut pen = Pen::default();
    let mut closed = false;
    for (index, segment) in PathParser::from(data).enumerate() {
        let command = index + 1;
        let syntax = || Mistake::PathSyntax { panel: panel.into(), command };
        let segment = segment.map_err(|_| syntax())?;
        let begins = matches!(segment, PathSegment::MoveTo { .. });
        if begins != (index == 0) || closed {
            return Err(Mistake::PathParts { panel: panel.into(), command });
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
                let kurbo = |p: [f64; 2]| Point::new(p[0], p[1]);
                let arc = SvgArc {
                    from: kurbo(pen.at),
                    to: kurbo(end),
                    radii: Vec2::new(rx, ry),
                    x_rotation: x_axis_rotation.to_radians(),
                    large_arc,
                    sweep,
                };
                let finite = [rx, ry, x_axis_rotation].into_iter().chain(end).all(f64::is_finite);
                if !finite {
                    return Err(syntax());
                }
                pen.arc(end, &arc);
            }
            PathSegment::ClosePath { .. } => {
                // The rounding of the digits is no edge.
                if distance(pen.at, pen.start) * unit > 1e-5 {
                    pen.to(pen.start, Curve::Line);
                }
                closed = true;
            }
        }
        pen.control = control;
    }
    Ok(pen.edges.iter().map(|e| e.mapped(true, |[x, y]| [unit * x, -unit * y])).collect())
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
