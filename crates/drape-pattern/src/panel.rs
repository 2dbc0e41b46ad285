use std::collections::BTreeSet;

use crate::crossing::crossing;
use crate::edge::{Edge, difference, distance};
use crate::mistake::Mistake;
use crate::placement::Placement;

/// Farthest that a point may lie from the origin, in m: beyond it is a slip of the unit, and the
/// arithmetic of the cutter need not be proved.
const FARTHEST: f64 = 1000.0;

/// Gaps between edges up to this are closed, in m: what is left by the digits of a file.
const GAP: f64 = 1e-5;

/// Shortest edge of an outline, in m, and the side of the least square that is a panel.
const SHORTEST: f64 = 1e-6;

/// A piece of cloth with a checked outline: closed, without crossings, anticlockwise.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    name: String,
    outline: Vec<Edge>,
    grain: f64,
    placement: Option<Placement>,
    clockwise: bool,
    folds: Vec<Fold>,
}

/// A straight line along which a panel is folded at rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fold {
    /// Its ends in the panel's frame, in m. They may lie outside the outline.
    pub ends: [[f64; 2]; 2],
    /// Angle by which the panel is turned towards its right side, in rad.
    pub angle: f64,
}

impl Panel {
    /// A panel from the edges of its outline, each beginning where the one before it ends.
    ///
    /// An outline that runs clockwise is reversed.
    ///
    /// # Errors
    /// All mistakes of the outline.
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

    /// The panel with its warp at an angle to its y axis, anticlockwise, in rad.
    ///
    /// # Errors
    /// When the angle is not finite.
    pub fn with_grain(mut self, angle: f64) -> Result<Self, Mistake> {
        if !angle.is_finite() {
            return Err(Mistake::Placed { panel: self.name, value: "grain" });
        }
        self.grain = angle;
        Ok(self)
    }

    /// The panel with folds.
    ///
    /// # Errors
    /// When a number of a fold is not finite, or it has no length.
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

    /// The panel at a place in space.
    ///
    /// # Errors
    /// When the place is not finite, or the panel, bent by it, would meet itself.
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

    /// The panel seen from its other side, lying where it lay: mirrored in its y axis, with its edges in
    /// the order that they had before a clockwise outline was reversed.
    #[must_use]
    pub(crate) fn turned_over(mut self) -> Self {
        let mirror = |edge: &Edge| edge.reversed().moved(true, |[x, y]| [-x, y]);
        self.outline = self.outline.iter().rev().map(mirror).collect();
        self.grain = 0.0 - self.grain;
        self.placement = self.placement.map(Placement::turned_over);
        for Fold { ends, angle } in &mut self.folds {
            *ends = ends.map(|[x, y]| [-x, y]);
            *angle = -*angle;
        }
        self
    }

    /// Its name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The edges of its outline, anticlockwise.
    #[must_use]
    pub fn outline(&self) -> &[Edge] {
        &self.outline
    }

    /// Angle from its y axis to its warp, anticlockwise, in rad.
    #[must_use]
    pub fn grain(&self) -> f64 {
        self.grain
    }

    /// The lines along which it is folded at rest.
    #[must_use]
    pub fn folds(&self) -> &[Fold] {
        &self.folds
    }

    /// Where it lies in space, where that is known.
    #[must_use]
    pub fn placement(&self) -> Option<&Placement> {
        self.placement.as_ref()
    }

    /// Whether the outline was given clockwise.
    #[must_use]
    pub fn was_clockwise(&self) -> bool {
        self.clockwise
    }

    /// Its area, in m².
    #[must_use]
    pub fn area(&self) -> f64 {
        // Lengths are counted from a corner, so that a panel far from the origin loses no digits.
        let [x, y] = self.outline[0].start;
        self.outline.iter().map(|e| e.moved(false, |p| difference(p, [x, y])).area()).sum()
    }

    /// The larger side of the smallest upright rectangle round its outline, in m.
    pub(crate) fn size(&self) -> f64 {
        self.extent(0).max(self.extent(1))
    }

    /// How far it extends along x (0) or y (1), in m.
    fn extent(&self, axis: usize) -> f64 {
        let points = self.outline.iter().flat_map(Edge::polyline);
        let [low, high] = points
            .fold([f64::MAX, f64::MIN], |[low, high], p| [low.min(p[axis]), high.max(p[axis])]);
        high - low
    }
}

fn coordinates(panel: &str, outline: &[Edge]) -> Vec<Mistake> {
    let mut mistakes = Vec::new();
    if outline.len() < 2 {
        mistakes.push(Mistake::FewEdges { panel: panel.into(), edges: outline.len() });
    }
    let mut names = BTreeSet::new();
    for edge in outline {
        let (panel, name) = (panel.to_owned(), edge.name.clone());
        let reach = edge.coordinates().map(f64::abs).fold(0.0, f64::max);
        if !names.insert(&edge.name) {
            mistakes.push(Mistake::SameEdge { panel: panel.clone(), edge: name.clone() });
        }
        if !edge.is_finite() {
            mistakes.push(Mistake::NotFinite { panel, edge: name });
        } else if reach > FARTHEST {
            mistakes.push(Mistake::Far { panel, edge: name, reach });
        } else if !(SHORTEST..=10.0 * FARTHEST).contains(&edge.length()) {
            mistakes.push(Mistake::EmptyEdge { panel, edge: name, length: edge.length() });
        }
    }
    mistakes
}

/// Moves the start of each edge to the end of the one before it, where that is near.
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

fn cross(panel: &str, outline: &[Edge]) -> Option<Mistake> {
    let mut owner = Vec::new();
    let mut polygon = Vec::new();
    for (index, edge) in outline.iter().enumerate() {
        let points = edge.polyline();
        owner.extend(std::iter::repeat_n(index, points.len()));
        polygon.extend(points);
    }
    let [first, second] = crossing(&polygon)?;
    Some(Mistake::Crossing {
        panel: panel.into(),
        first: outline[owner[first]].name.clone(),
        second: outline[owner[second]].name.clone(),
        at: meeting(&polygon, first, second),
    })
}

/// About where two sides of a polygon meet.
fn meeting(polygon: &[[f64; 2]], first: usize, second: usize) -> [f64; 2] {
    let corner = |k: usize| polygon[k % polygon.len()];
    let (a, b) = (corner(first), corner(second));
    let (u, v) = (difference(corner(first + 1), a), difference(corner(second + 1), b));
    let w = difference(b, a);
    let t = (w[0] * v[1] - w[1] * v[0]) / (u[0] * v[1] - u[1] * v[0]);
    if (0.0..=1.0).contains(&t) { [a[0] + t * u[0], a[1] + t * u[1]] } else { b }
}
