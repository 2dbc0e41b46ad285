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
pub(crate) const GAP: f64 = 1e-5;

/// Largest number of edges of an outline. An outline with more is a picture that was traced, and
/// the search for its crossings would take long.
const MOST_EDGES: usize = 20_000;

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
    /// Names of edges that open darts divide. The name of a part is the name of the edge with a
    /// number.
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
    /// Returns the panel `name` with the edges `outline`, each of which begins where the edge
    /// before it ends.
    ///
    /// An outline that runs clockwise is reversed.
    ///
    /// # Errors
    /// All mistakes of `outline`.
    pub fn new(name: impl Into<String>, outline: Vec<Edge>) -> Result<Self, Vec<Mistake>> {
        let name = name.into();
        let mut outline = outline;
        if outline.len() > MOST_EDGES {
            let (panel, edges, most) = (name, outline.len(), MOST_EDGES);
            return Err(vec![Mistake::TooManyEdges { panel, edges, most }]);
        }
        let mut mistakes = edge_mistakes(&name, &outline);
        if !mistakes.is_empty() {
            return Err(mistakes);
        }

        // Crossings and the area have a meaning only for a closed outline.
        mistakes.extend(close_gaps(&name, &mut outline));
        if mistakes.is_empty() {
            mistakes.extend(crossing_mistake(&name, &outline));
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

    /// Returns the panel with its warp at `angle` to its y axis, anticlockwise, in rad.
    ///
    /// # Errors
    /// `angle` is not finite.
    pub fn with_grain(mut self, angle: f64) -> Result<Self, Mistake> {
        if !angle.is_finite() {
            return Err(Mistake::Placed { panel: self.name, value: "grain" });
        }
        self.grain = angle;
        Ok(self)
    }

    /// Returns the panel with `fabric`, the name that the scene gives its fabric.
    #[must_use]
    pub fn with_fabric(mut self, fabric: impl Into<String>) -> Self {
        self.fabric = Some(fabric.into());
        self
    }

    /// Returns the panel with `folds` in place of its folds.
    ///
    /// # Errors
    /// A number of a fold is not finite, or a fold has no length.
    pub fn with_folds(mut self, folds: Vec<Fold>) -> Result<Self, Mistake> {
        let is_wrong = folds.iter().any(|fold| {
            let [from, to] = fold.ends;
            !(distance(from, to) > SHORTEST && distance(from, to) + fold.angle.abs() < FARTHEST)
        });
        if is_wrong {
            return Err(Mistake::Placed { panel: self.name, value: "fold" });
        }
        self.folds = folds;
        Ok(self)
    }

    /// Returns the panel with the closed darts `darts` added.
    ///
    /// # Errors
    /// A dart meets itself, the outline or another dart, is outside of the outline, or has no area;
    /// or two edges have one name. All mistakes are listed.
    pub fn with_darts(mut self, darts: Vec<Dart>) -> Result<Self, Vec<Mistake>> {
        let mut mistakes = Vec::new();
        for dart in darts {
            let hole = dart.hole();
            let edges: Vec<Edge> = self.edges().chain(hole).cloned().collect();
            let before = mistakes.len();
            mistakes.extend(edge_mistakes(&self.name, &edges));
            if mistakes.len() == before {
                mistakes.extend(crossing_mistake(&self.name, hole));
                mistakes.extend(self.dart_mistake(&dart));
            }
            self.darts.push(dart);
        }
        if mistakes.is_empty() { Ok(self) } else { Err(mistakes) }
    }

    /// Returns the mistake of `dart`, a closed dart, if it does not lie free in the cloth.
    fn dart_mistake(&self, dart: &Dart) -> Option<Mistake> {
        let (panel, name) = (self.name.clone(), dart.name.clone());
        let area: f64 = dart.hole().iter().map(Edge::area).sum();
        if area.abs() < SHORTEST * SHORTEST {
            return Some(Mistake::NoArea { panel: format!("{panel}, dart {name}"), area });
        }
        let ring = Ring::new(dart.hole());
        for edges in self.loops() {
            let line = Ring::new(edges);
            if let Some(Meeting { edges: [_, edge], at }) = ring.meeting(&line) {
                let edge = edges[edge].name.clone();
                return Some(Mistake::DartMeets { panel, dart: name, edge, at });
            }
            let is_outline = std::ptr::eq(edges, self.outline.as_slice());
            if line.contains(&ring) != is_outline || !is_outline && ring.contains(&line) {
                return Some(Mistake::DartOutside { panel, dart: name });
            }
        }
        None
    }

    /// Returns the panel with the open darts `darts` cut into its edge `edge`, in the order of the
    /// mouths of the darts. The darts divide the edge. The name of a part is the name of the edge
    /// with a number.
    ///
    /// # Errors
    /// The panel has no such edge, mouths overlap or lie beyond its ends, or the outline then meets
    /// itself.
    pub fn with_open_darts(self, edge: &str, darts: &[OpenDart]) -> Result<Self, Vec<Mistake>> {
        let Some(number) = self.outline.iter().position(|candidate| candidate.name == edge) else {
            let mistakes = darts.iter().map(|dart| dart.mouth_mistake(&self.name, edge, 0.0));
            return Err(mistakes.collect());
        };
        let mistakes = self.mouth_mistakes(number, darts);
        if !mistakes.is_empty() {
            return Err(mistakes);
        }

        // The mouths split the edge. Every second part lies over a mouth: the legs take its place.
        let ends: Vec<f64> = darts.iter().flat_map(|dart| dart.mouth).collect();
        let mut parts = Vec::new();
        let mut open = Vec::new();
        for (index, part) in self.outline[number].split(&ends).into_iter().enumerate() {
            if index % 2 == 0 {
                parts.push(Edge { name: format!("{edge} {}", index / 2 + 1), ..part });
                continue;
            }
            let dart = &darts[index / 2];
            let legs = dart.legs([part.start, part.end]);
            open.push(Dart::open(dart.name.clone(), legs.each_ref().map(|leg| leg.name.clone())));
            parts.extend(legs);
        }
        let mut panel = self;
        panel.outline.splice(number..=number, parts);
        panel.divided.insert(edge.to_owned());

        // The new outline is checked as an outline of a file is, and the closed darts against it.
        let mut mistakes = edge_mistakes(&panel.name, &panel.outline);
        if mistakes.is_empty() {
            mistakes.extend(crossing_mistake(&panel.name, &panel.outline));
        }
        let closed: Vec<Dart> =
            panel.darts.iter().filter(|dart| !dart.hole().is_empty()).cloned().collect();
        panel.darts.extend(open);
        if mistakes.is_empty() {
            let without_darts = Self { darts: Vec::new(), ..panel.clone() };
            mistakes.extend(closed.iter().filter_map(|dart| without_darts.dart_mistake(dart)));
        }
        if mistakes.is_empty() { Ok(panel) } else { Err(mistakes) }
    }

    /// Returns the mistakes of the mouths of `darts` on the edge of the outline with the number
    /// `edge`: mouths that are not on the edge, else mouths that overlap.
    fn mouth_mistakes(&self, edge: usize, darts: &[OpenDart]) -> Vec<Mistake> {
        let edge = &self.outline[edge];
        let length = edge.length();
        let outside = darts.iter().filter(|dart| {
            let [from, to] = dart.mouth;
            !(SHORTEST < from && from + SHORTEST < to && to < length - SHORTEST)
        });
        let mut wrong: Vec<&OpenDart> = outside.collect();
        if wrong.is_empty() {
            let pairs = darts.windows(2);
            let overlapping = pairs.filter(|pair| pair[0].mouth[1] + SHORTEST > pair[1].mouth[0]);
            wrong.extend(overlapping.map(|pair| &pair[1]));
        }
        wrong.iter().map(|dart| dart.mouth_mistake(&self.name, &edge.name, length)).collect()
    }

    /// Returns the panel at `placement` in space.
    ///
    /// # Errors
    /// `placement` is not finite, or the panel would meet itself when it is bent to the cylinder.
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
    pub(crate) fn turned_over(self) -> Self {
        let mut panel = self.reflected();
        panel.placement = panel.placement.map(Placement::turned_over);
        panel.folds.iter_mut().for_each(|fold| fold.angle = -fold.angle);
        panel
    }

    /// Returns the panel with its outline, darts, folds and grain reflected in its y axis.
    fn reflected(mut self) -> Self {
        self.outline =
            self.outline.iter().rev().map(|edge| edge.reversed().mapped(true, reflect)).collect();
        self.grain = 0.0 - self.grain;
        self.darts.iter_mut().for_each(|dart| *dart = dart.mapped(true, reflect));
        self.folds.iter_mut().for_each(|fold| fold.ends = fold.ends.map(reflect));
        self
    }

    /// Returns the panel under the name `name`.
    #[must_use]
    pub(crate) fn renamed(mut self, name: &str) -> Self {
        self.name = name.into();
        self
    }

    /// Returns the mirror image of the panel, as the left sleeve of a right one: reflected in its y
    /// axis, at the placement reflected in the plane x = 0 of space. Its right side stays its right
    /// side.
    #[must_use]
    pub(crate) fn mirrored(self) -> Self {
        let mut panel = self.reflected();
        panel.placement = panel.placement.map(Placement::mirrored);
        panel
    }

    /// Returns the panel with its outline, darts and folds shifted by the vector `by` in its frame,
    /// in m; `None` if an edge would begin farther away than [`FARTHEST`].
    #[must_use]
    pub(crate) fn shifted(&self, by: [f64; 2]) -> Option<Self> {
        let mut panel = self.clone();
        panel.outline =
            self.outline.iter().map(|edge| edge.mapped(false, |p| translate(p, by))).collect();
        panel.darts =
            self.darts.iter().map(|dart| dart.mapped(false, |p| translate(p, by))).collect();
        panel.folds.iter_mut().for_each(|fold| fold.ends = fold.ends.map(|p| translate(p, by)));
        let mut coordinates = panel.outline.iter().flat_map(|edge| edge.start);
        coordinates.all(|x| x.abs() <= FARTHEST).then_some(panel)
    }

    /// Returns the panel with each edge replaced by the edges that `change` returns for it. The
    /// outline must stay where it is.
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

    /// Returns the outline as a polygon whose sides stay within `tolerance`, in m, of its edges.
    /// The points run anticlockwise, and the first is not repeated at the end.
    ///
    /// ```
    /// use drape_input::Document;
    /// use drape_pattern::Pattern;
    ///
    /// let text = "length = \"cm\"\n[panel.a]\ngrain = 0\nrectangle = [20, 30]\n";
    /// let pattern = Pattern::parse(&Document::new("strip.toml", text))?;
    /// let polygon = pattern.panels()[0].outline_points(1e-4);
    /// assert_eq!(polygon, [[0.0, 0.0], [0.2, 0.0], [0.2, 0.3], [0.0, 0.3]]);
    /// # Ok::<(), drape_input::Diagnostics>(())
    /// ```
    #[must_use]
    pub fn outline_points(&self, tolerance: f64) -> Vec<[f64; 2]> {
        self.outline.iter().flat_map(|edge| edge.chords(tolerance)).collect()
    }

    /// Darts of the panel.
    #[must_use]
    pub fn darts(&self) -> &[Dart] {
        &self.darts
    }

    /// All edges: edges of the outline, then edges of the holes of closed darts. Numbers of edges
    /// count them in this order.
    pub fn edges(&self) -> impl Iterator<Item = &Edge> {
        self.outline.iter().chain(self.darts.iter().flat_map(Dart::hole))
    }

    /// Returns the closed lines of the panel: its outline, then the holes of closed darts. The
    /// edges of a line are in a row, with the cloth on their left.
    pub fn loops(&self) -> impl Iterator<Item = &[Edge]> {
        let holes = self.darts.iter().map(Dart::hole).filter(|hole| !hole.is_empty());
        std::iter::once(self.outline.as_slice()).chain(holes)
    }

    /// Returns the number of the edge that follows the edge with the number `edge` in its closed
    /// line.
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

    /// Returns the numbers of the edges with the name `name`. If open darts divide that edge, these
    /// are its parts, along the outline.
    #[must_use]
    pub fn edges_named(&self, name: &str) -> Vec<usize> {
        match self.edge_number(name) {
            Some(number) => vec![number],
            None if self.divided.contains(name) => {
                (1..).map_while(|part| self.edge_number(&format!("{name} {part}"))).collect()
            }
            None => Vec::new(),
        }
    }

    /// Returns the number of the edge with the name `name`, if there is one.
    pub(crate) fn edge_number(&self, name: &str) -> Option<usize> {
        self.edges().position(|edge| edge.name == name)
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

    /// Name that the scene gives the fabric of the panel; `None` for the fabric of the garment.
    #[must_use]
    pub fn fabric(&self) -> Option<&str> {
        self.fabric.as_deref()
    }

    /// Placement in space, if the pattern gives one.
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

    /// Extent of the outline along `axis`, x (0) or y (1), in m.
    fn extent(&self, axis: usize) -> f64 {
        let points = self.outline.iter().flat_map(Edge::polyline);
        let [low, high] = points
            .fold([f64::MAX, f64::MIN], |[low, high], p| [low.min(p[axis]), high.max(p[axis])]);
        high - low
    }
}

/// Returns the point reflected in the y axis.
fn reflect([x, y]: [f64; 2]) -> [f64; 2] {
    [-x, y]
}

/// Returns `point` shifted by the vector `by`.
fn translate(point: [f64; 2], by: [f64; 2]) -> [f64; 2] {
    [point[0] + by[0], point[1] + by[1]]
}

/// Returns the mistakes of single edges of `outline`, and of their names and number. `panel` is the
/// name of the panel.
fn edge_mistakes(panel: &str, outline: &[Edge]) -> Vec<Mistake> {
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

/// Moves the start of each edge of `outline` to the end of the edge before it. Returns the gaps
/// that are wider than [`GAP`] as mistakes of the panel with the name `panel`.
fn close_gaps(panel: &str, outline: &mut [Edge]) -> Vec<Mistake> {
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

/// Returns the mistake of `outline` if it intersects itself. `panel` is the name of the panel.
fn crossing_mistake(panel: &str, outline: &[Edge]) -> Option<Mistake> {
    let Meeting { edges: [first, second], at } = Ring::new(outline).crossing()?;
    Some(Mistake::Crossing {
        panel: panel.into(),
        first: outline[first].name.clone(),
        second: outline[second].name.clone(),
        at,
    })
}
