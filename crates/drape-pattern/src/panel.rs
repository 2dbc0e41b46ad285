//! Panels: checked outlines with grain, folds and a place in space.

use std::collections::BTreeSet;

use crate::edge::{Edge, difference, distance};
use crate::mistake::Mistake;
use crate::placement::Placement;
use crate::polygon::self_intersection;

/// Largest coordinate of a point, in m.
///
/// Beyond it the unit of the file is wrong; the arithmetic of the cutter is not tested there.
const FARTHEST: f64 = 1000.0;

/// Largest gap between edges that is closed, in m: the rounding of the digits of a file.
const GAP: f64 = 1e-5;

/// Length of the shortest edge of an outline, and side of the smallest square that is a panel, in
/// m.
const SHORTEST: f64 = 1e-6;

/// Piece of cloth with a checked outline: closed, simple, anticlockwise.
///
/// ```
/// use drape_pattern::{Edge, Panel};
///
/// let corners = [[0.0, 0.0], [0.4, 0.0], [0.4, 0.6], [0.0, 0.6]];
/// let edge = |k: usize| Edge::line(k.to_string(), corners[k], corners[(k + 1) % 4]);
/// let panel = Panel::new("front", (0..4).map(edge).collect()).expect("a rectangle is simple");
/// assert!((panel.area() - 0.24).abs() < 1e-12);
///
/// let crossed = [0, 2, 1, 3].map(|k| corners[k]);
/// let edge = |k: usize| Edge::line(k.to_string(), crossed[k], crossed[(k + 1) % 4]);
/// let mistakes = Panel::new("bow tie", (0..4).map(edge).collect());
/// let mistakes = mistakes.expect_err("it crosses itself");
/// assert!(mistakes[0].to_string().contains("cross or touch"));
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    name: String,
    outline: Vec<Edge>,
    grain: f64,
    placement: Option<Placement>,
    clockwise: bool,
    folds: Vec<Fold>,
}

/// Straight line along which a panel is folded at rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fold {
    /// Ends of the line in the panel's frame, in m. They may lie outside the outline.
    pub ends: [[f64; 2]; 2],
    /// Angle by which the panel is folded towards its right side, in rad.
    pub angle: f64,
}

impl Panel {
    /// Returns a panel with the edges of its outline, each beginning where the one before it ends.
    ///
    /// An outline that runs clockwise is reversed.
    ///
    /// # Errors
    /// All mistakes of the outline, together.
    pub fn new(name: impl Into<String>, outline: Vec<Edge>) -> Result<Self, Vec<Mistake>> {
        let name = name.into();
        let mut outline = outline;
        let mut mistakes = coordinates(&name, &outline);
        if !mistakes.is_empty() {
            return Err(mistakes);
        }
        mistakes.extend(close(&name, &mut outline));
        if mistakes.is_empty() {
            mistakes.extend(cross(&name, &outline));
        }
        let area: f64 = outline.iter().map(Edge::area).sum();
        if mistakes.is_empty() && !(area.abs() >= SHORTEST * SHORTEST) {
            mistakes.push(Mistake::NoArea { panel: name.clone(), area });
        }
        if !mistakes.is_empty() {
            return Err(mistakes);
        }
        let clockwise = area < 0.0;
        if clockwise {
            outline = outline.iter().rev().map(Edge::reversed).collect();
        }
        Ok(Self { name, outline, grain: 0.0, placement: None, clockwise, folds: Vec::new() })
    }

    /// Returns the panel with its warp at an angle to its y axis, anticlockwise, in rad.
    ///
    /// # Errors
    /// The angle is not finite.
    pub fn with_grain(mut self, angle: f64) -> Result<Self, Mistake> {
        if !angle.is_finite() {
            return Err(Mistake::Placed { panel: self.name, value: "grain" });
        }
        self.grain = angle;
        Ok(self)
    }

    /// Returns the panel with folds.
    ///
    /// # Errors
    /// A number of a fold is not finite, or a fold has no length.
    pub fn with_folds(mut self, folds: Vec<Fold>) -> Result<Self, Mistake> {
        let bad = |fold: &Fold| {
            let [from, to] = fold.ends;
            !(distance(from, to) > SHORTEST && distance(from, to) + fold.angle.abs() < FARTHEST)
        };
        if folds.iter().any(bad) {
            return Err(Mistake::Placed { panel: self.name, value: "fold" });
        }
        self.folds = folds;
        Ok(self)
    }

    /// Returns the panel at a place in space.
    ///
    /// # Errors
    /// The place is not finite, or the panel would meet itself when it is bent to the cylinder.
    pub fn with_placement(mut self, placement: Placement) -> Result<Self, Mistake> {
        if !placement.is_finite() {
            return Err(Mistake::Placed { panel: self.name, value: "place" });
        }
        let width = self.extent(0);
        if let Some(wrap) = placement.wrap
            && !(std::f64::consts::TAU * wrap.abs() > width)
        {
            return Err(Mistake::Wrap { panel: self.name, wrap, width });
        }
        self.placement = Some(placement);
        Ok(self)
    }

    /// Returns the panel turned over, at the same position: reflected in its y axis, with its edges
    /// in the order that they had before a clockwise outline was reversed.
    #[must_use]
    pub(crate) fn turned_over(mut self) -> Self {
        let mirror = |edge: &Edge| edge.reversed().mapped(true, |[x, y]| [-x, y]);
        self.outline = self.outline.iter().rev().map(mirror).collect();
        self.grain = 0.0 - self.grain;
        self.placement = self.placement.map(Placement::turned_over);
        for Fold { ends, angle } in &mut self.folds {
            *ends = ends.map(|[x, y]| [-x, y]);
            *angle = -*angle;
        }
        self
    }

    /// Name of the panel.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Edges of the outline, anticlockwise.
    #[must_use]
    pub fn outline(&self) -> &[Edge] {
        &self.outline
    }

    /// Angle from the y axis to the warp, anticlockwise, in rad.
    #[must_use]
    pub fn grain(&self) -> f64 {
        self.grain
    }

    /// Lines along which the panel is folded at rest.
    #[must_use]
    pub fn folds(&self) -> &[Fold] {
        &self.folds
    }

    /// Place in space, if the pattern gives one.
    #[must_use]
    pub fn placement(&self) -> Option<&Placement> {
        self.placement.as_ref()
    }

    /// Returns whether the outline was given clockwise.
    #[must_use]
    pub fn was_clockwise(&self) -> bool {
        self.clockwise
    }

    /// Area of the panel, in m².
    #[must_use]
    pub fn area(&self) -> f64 {
        // Relative to a corner, so that a panel far from the origin loses no digits.
        let [x, y] = self.outline[0].start;
        self.outline.iter().map(|e| e.mapped(false, |p| difference(p, [x, y])).area()).sum()
    }

    /// Larger side of the bounding box of the outline, in m.
    pub(crate) fn size(&self) -> f64 {
        self.extent(0).max(self.extent(1))
    }

    /// Extent of the outline along x (0) or y (1), in m.
    fn extent(&self, axis: usize) -> f64 {
        let points = self.outline.iter().flat_map(Edge::polyline);
        let [low, high] = points
            .fold([f64::MAX, f64::MIN], |[low, high], p| [low.min(p[axis]), high.max(p[axis])]);
        high - low
    }
}

/// Returns the mistakes of the numbers and names of an outline.
fn coordinates(panel: &str, outline: &[Edge]) -> Vec<Mistake> {
    let mut mistakes = Vec::new();
    if outline.len() < 2 {
        mistakes.push(Mistake::FewEdges { panel: panel.into(), edges: outline.len() });
    }
    let mut names = BTreeSet::new();
    for edge in outline {
        let (panel, name) = (panel.to_owned(), edge.name.clone());
        let distance = edge.coordinates().map(f64::abs).fold(0.0, f64::max);
        if !names.insert(&edge.name) {
            mistakes.push(Mistake::SameEdge { panel: panel.clone(), edge: name.clone() });
        }
        if !edge.is_finite() {
            mistakes.push(Mistake::NotFinite { panel, edge: name });
        } else if distance > FARTHEST {
            mistakes.push(Mistake::Far { panel, edge: name, distance });
        } else if !(SHORTEST..=10.0 * FARTHEST).contains(&edge.length()) {
            mistakes.push(Mistake::EmptyEdge { panel, edge: name, length: edge.length() });
        }
    }
    mistakes
}

/// Moves the start of each edge to the end of the one before it; larger gaps are mistakes.
fn close(panel: &str, outline: &mut [Edge]) -> Vec<Mistake> {
    let mut mistakes = Vec::new();
    for index in 0..outline.len() {
        let before = &outline[(index + outline.len() - 1) % outline.len()];
        let (from, end) = (before.name.clone(), before.end);
        let edge = &mut outline[index];
        let gap = distance(end, edge.start);
        if gap > GAP.min(0.1 * edge.length()) {
            let (panel, to) = (panel.to_owned(), edge.name.clone());
            mistakes.push(Mistake::Open { panel, from, to, gap });
        }
        edge.start = end;
    }
    mistakes
}

/// Returns the mistake of an outline that intersects itself.
fn cross(panel: &str, outline: &[Edge]) -> Option<Mistake> {
    let mut owner = Vec::new();
    let mut polygon = Vec::new();
    for (index, edge) in outline.iter().enumerate() {
        let points = edge.polyline();
        owner.extend(std::iter::repeat_n(index, points.len()));
        polygon.extend(points);
    }
    let [first, second] = self_intersection(&polygon)?;
    Some(Mistake::Crossing {
        panel: panel.into(),
        first: outline[owner[first]].name.clone(),
        second: outline[owner[second]].name.clone(),
        at: meeting_point(&polygon, first, second),
    })
}

/// Returns the approximate point where two sides of a polygon meet.
fn meeting_point(polygon: &[[f64; 2]], first: usize, second: usize) -> [f64; 2] {
    let corner = |k: usize| polygon[k % polygon.len()];
    let (a, b) = (corner(first), corner(second));
    let (u, v) = (difference(corner(first + 1), a), difference(corner(second + 1), b));
    let w = difference(b, a);
    let t = (w[0] * v[1] - w[1] * v[0]) / (u[0] * v[1] - u[1] * v[0]);
    if (0.0..=1.0).contains(&t) { [a[0] + t * u[0], a[1] + t * u[1]] } else { b }
}
