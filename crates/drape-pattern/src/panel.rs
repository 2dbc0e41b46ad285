//! Panels: checked outlines with grain, folds and a place in space.

pub(crate) mod dart;
pub(crate) mod placement;
pub(crate) mod ring;

use std::collections::BTreeSet;

use crate::edge::{Edge, difference, distance};
use crate::mistake::Mistake;
use dart::{Dart, OpenDart};
use placement::Placement;
use ring::{Meeting, Ring};

/// Largest coordinate of a point, in m.
///
/// Beyond it the unit of the file is wrong; the arithmetic of the cutter is not tested there.
pub(crate) const FARTHEST: f64 = 1000.0;

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
    darts: Vec<Dart>,
    /// Names of edges that open darts divide: their parts have a number behind the name.
    divided: BTreeSet<String>,
    fabric: Option<String>,
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
        Ok(Self {
            name,
            outline,
            grain: 0.0,
            placement: None,
            clockwise,
            folds: Vec::new(),
            darts: Vec::new(),
            divided: BTreeSet::new(),
            fabric: None,
        })
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

    /// Returns the panel of a fabric that the scene gives a name.
    #[must_use]
    pub fn with_fabric(mut self, fabric: impl Into<String>) -> Self {
        self.fabric = Some(fabric.into());
        self
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

    /// Returns the panel with closed darts, beside those that it has.
    ///
    /// # Errors
    /// A dart meets itself, the outline or another dart, is outside of the outline, or has no area;
    /// or two edges have one name. All mistakes are listed.
    pub fn with_darts(mut self, darts: Vec<Dart>) -> Result<Self, Vec<Mistake>> {
        let mut mistakes = Vec::new();
        for dart in darts {
            let hole = dart.hole();
            let own: Vec<Edge> = self.edges().chain(hole).cloned().collect();
            let before = mistakes.len();
            mistakes.extend(coordinates(&self.name, &own));
            if mistakes.len() == before {
                mistakes.extend(cross(&self.name, hole));
                mistakes.extend(self.dart_mistake(&dart));
            }
            self.darts.push(dart);
        }
        if mistakes.is_empty() { Ok(self) } else { Err(mistakes) }
    }

    /// Returns the mistake of the place of a dart among the lines of the panel.
    fn dart_mistake(&self, dart: &Dart) -> Option<Mistake> {
        let (panel, name) = (self.name.clone(), dart.name.clone());
        let area: f64 = dart.hole().iter().map(Edge::area).sum();
        if area.abs() < SHORTEST * SHORTEST {
            return Some(Mistake::NoArea { panel: format!("{panel}, dart {name}"), area });
        }
        let ring = Ring::new(dart.hole());
        for edges in self.loops() {
            let other = Ring::new(edges);
            if let Some(Meeting { edges: [_, edge], at }) = ring.meeting(&other) {
                let edge = edges[edge].name.clone();
                return Some(Mistake::DartMeets { panel, dart: name, edge, at });
            }
            let is_outline = std::ptr::eq(edges, self.outline.as_slice());
            if other.contains(&ring) != is_outline || !is_outline && ring.contains(&other) {
                return Some(Mistake::DartOutside { panel, dart: name });
            }
        }
        None
    }

    /// Returns the panel with open darts cut into one edge of the panel, in the order of the mouths of the
    /// darts. The darts part the edge; each part has the name of the edge and a number.
    ///
    /// # Errors
    /// The edge has no such name, mouths overlap or lie beyond its ends, or the outline then meets
    /// itself.
    pub fn with_open_darts(self, edge: &str, darts: &[OpenDart]) -> Result<Self, Vec<Mistake>> {
        let fail = |dart: &OpenDart, length: f64| Mistake::Mouth {
            panel: self.name.clone(),
            dart: dart.name.clone(),
            edge: edge.to_owned(),
            mouth: dart.mouth,
            length,
        };
        let Some(own) = self.outline.iter().position(|own| own.name == edge) else {
            return Err(darts.iter().map(|dart| fail(dart, 0.0)).collect());
        };
        // Ascending places on the edge, at which it is split.
        let length = self.outline[own].length();
        let places: Vec<f64> = darts.iter().flat_map(|dart| dart.mouth).collect();
        let wrong = |dart: &&OpenDart| {
            let [from, to] = dart.mouth;
            !(SHORTEST < from && from + SHORTEST < to && to < length - SHORTEST)
        };
        let mut mistakes: Vec<Mistake> =
            darts.iter().filter(wrong).map(|dart| fail(dart, length)).collect();
        if mistakes.is_empty() {
            let overlaps =
                darts.windows(2).filter(|two| two[0].mouth[1] + SHORTEST > two[1].mouth[0]);
            mistakes.extend(overlaps.map(|two| fail(&two[1], length)));
        }
        if !mistakes.is_empty() {
            return Err(mistakes);
        }
        // Every second part lies over a mouth: the legs take its place.
        let mut parts = Vec::new();
        let mut sewn = Vec::new();
        for (number, part) in self.outline[own].split(&places).into_iter().enumerate() {
            if number % 2 == 0 {
                parts.push(Edge { name: format!("{edge} {}", number / 2 + 1), ..part });
                continue;
            }
            let dart = &darts[number / 2];
            let legs = dart.legs([part.start, part.end]);
            sewn.push(Dart::open(dart.name.clone(), legs.each_ref().map(|leg| leg.name.clone())));
            parts.extend(legs);
        }
        let mut panel = self;
        panel.outline.splice(own..=own, parts);
        panel.divided.insert(edge.to_owned());
        mistakes.extend(coordinates(&panel.name, &panel.outline));
        if mistakes.is_empty() {
            mistakes.extend(cross(&panel.name, &panel.outline));
        }
        let closed: Vec<Dart> =
            panel.darts.iter().filter(|dart| !dart.hole().is_empty()).cloned().collect();
        panel.darts.extend(sewn);
        if mistakes.is_empty() {
            let others = Self { darts: Vec::new(), ..panel.clone() };
            mistakes.extend(closed.iter().filter_map(|dart| others.dart_mistake(dart)));
        }
        if mistakes.is_empty() { Ok(panel) } else { Err(mistakes) }
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
        self.darts.iter_mut().for_each(|dart| *dart = dart.mapped(true, |[x, y]| [-x, y]));
        for Fold { ends, angle } in &mut self.folds {
            *ends = ends.map(|[x, y]| [-x, y]);
            *angle = -*angle;
        }
        self
    }

    /// Returns the panel under another name.
    #[must_use]
    pub(crate) fn renamed(mut self, name: &str) -> Self {
        self.name = name.into();
        self
    }

    /// Returns the mirror image of the panel, as the left one of a right one: reflected in its y
    /// axis, at the place that is reflected in the plane x = 0 of space. Its right side stays its
    /// right side.
    #[must_use]
    pub(crate) fn mirrored(mut self) -> Self {
        let mirror = |[x, y]: [f64; 2]| [-x, y];
        self.outline =
            self.outline.iter().rev().map(|edge| edge.reversed().mapped(true, mirror)).collect();
        self.grain = 0.0 - self.grain;
        self.placement = self.placement.map(Placement::mirrored);
        self.darts.iter_mut().for_each(|dart| *dart = dart.mapped(true, mirror));
        self.folds.iter_mut().for_each(|fold| fold.ends = fold.ends.map(mirror));
        self
    }

    /// Returns the panel with its outline and folds shifted in its frame, in m; `None` if that is
    /// too far.
    #[must_use]
    pub(crate) fn shifted(&self, by: [f64; 2]) -> Option<Self> {
        let near = |p: [f64; 2]| p.iter().all(|x| x.abs() <= FARTHEST);
        let moved = |p: [f64; 2]| [p[0] + by[0], p[1] + by[1]];
        let mut panel = self.clone();
        panel.outline = self.outline.iter().map(|edge| edge.mapped(false, moved)).collect();
        panel.darts = self.darts.iter().map(|dart| dart.mapped(false, moved)).collect();
        panel.folds.iter_mut().for_each(|fold| fold.ends = fold.ends.map(moved));
        panel.outline.iter().all(|edge| near(edge.start)).then_some(panel)
    }

    /// Returns the panel with its edges changed by a function that keeps the outline where it is.
    #[must_use]
    pub(crate) fn with_edges(mut self, change: impl Fn(&Edge) -> Vec<Edge>) -> Self {
        self.outline = self.outline.iter().flat_map(change).collect();
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

    /// Darts of the panel.
    #[must_use]
    pub fn darts(&self) -> &[Dart] {
        &self.darts
    }

    /// All edges: those of the outline, then those of the holes of closed darts. Numbers of edges
    /// count them.
    pub fn edges(&self) -> impl Iterator<Item = &Edge> {
        self.outline.iter().chain(self.darts.iter().flat_map(Dart::hole))
    }

    /// Returns the closed lines of the panel, whose edges are in a row with the cloth on their left:
    /// its outline, then the holes of closed darts.
    pub fn loops(&self) -> impl Iterator<Item = &[Edge]> {
        let holes = self.darts.iter().map(Dart::hole).filter(|hole| !hole.is_empty());
        std::iter::once(self.outline.as_slice()).chain(holes)
    }

    /// Returns the number of the edge that follows an edge of a number in its closed line.
    pub(crate) fn next_edge(&self, edge: usize) -> usize {
        let mut first = 0;
        for edges in self.loops() {
            if edge < first + edges.len() {
                return first + (edge - first + 1) % edges.len();
            }
            first += edges.len();
        }
        edge
    }

    /// Returns the numbers of the edges of a name: of one that open darts divide, those of its parts
    /// along the outline.
    #[must_use]
    pub fn edges_named(&self, name: &str) -> Vec<usize> {
        let numbers = |name: &str| self.edges().position(|edge| edge.name == name);
        match numbers(name) {
            Some(number) => vec![number],
            None if self.divided.contains(name) => {
                (1..).map_while(|part| numbers(&format!("{name} {part}"))).collect()
            }
            None => Vec::new(),
        }
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

    /// Fabric that the panel is cut from, by the name that the scene gives it; `None` for the
    /// garment's.
    #[must_use]
    pub fn fabric(&self) -> Option<&str> {
        self.fabric.as_deref()
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

    /// Area of the panel without its darts, in m².
    #[must_use]
    pub fn area(&self) -> f64 {
        // Relative to a corner, so that a panel far from the origin loses no digits.
        let [x, y] = self.outline[0].start;
        self.edges().map(|e| e.mapped(false, |p| difference(p, [x, y])).area()).sum()
    }

    /// Width and height of the bounding box of the outline, in m.
    pub(crate) fn extents(&self) -> [f64; 2] {
        [self.extent(0), self.extent(1)]
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
    let Meeting { edges: [first, second], at } = Ring::new(outline).crossing()?;
    Some(Mistake::Crossing {
        panel: panel.into(),
        first: outline[first].name.clone(),
        second: outline[second].name.clone(),
        at,
    })
}
