//! Sketch of a pattern file: its lines as the file draws them, right or wrong. They are drawn
//! beside the mistakes of the file.
//!
//! The readers add every outline before it is checked. `write` draws the sketch.

use drape_input::Subject;

use crate::edge::{Edge, distance};
use crate::mistake::Mistake;
use crate::panel::ring::{Meeting, Ring};
use crate::panel::{FARTHEST, GAP, Panel};
use crate::pattern::Pattern;

/// Lines of a pattern file.
#[derive(Debug, Clone, Default)]
pub struct Sketch {
    pub(crate) panels: Vec<SketchPanel>,
    seams: Vec<SketchSeam>,
}

/// Panel of a sketch.
#[derive(Debug, Clone)]
pub(crate) struct SketchPanel {
    pub(crate) name: String,
    /// Edges of the outline.
    pub(crate) outline: Vec<Edge>,
    /// Edges of the holes of closed darts.
    pub(crate) holes: Vec<Vec<Edge>>,
}

/// Seam of a sketch.
#[derive(Debug, Clone)]
struct SketchSeam {
    name: String,
    /// Edges of both sides, as `panel.edge`.
    edges: Vec<String>,
}

/// Fault of a sketch: a panel, an edge or a seam that is wrong, with the point where that is known.
#[derive(Debug, Clone, PartialEq)]
pub struct SketchFault {
    /// Panel, edge or seam that is wrong.
    pub subject: Subject,
    /// Point in the frame of the panel, in m.
    pub at: Option<[f64; 2]>,
}

impl Sketch {
    /// Returns the sketch of `pattern`, which is sound.
    #[must_use]
    pub fn from_pattern(pattern: &Pattern) -> Self {
        let mut sketch = Self::default();
        pattern.panels().iter().for_each(|panel| sketch.add_panel(panel));
        for seam in pattern.seams() {
            let edges = seam.sides.iter().flatten().map(|&id| pattern.edge_word(id)).collect();
            sketch.seams.push(SketchSeam { name: seam.name.clone(), edges });
        }
        sketch
    }

    /// Returns whether the sketch has no panel.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.panels.is_empty()
    }

    /// Adds the panel `name` with `outline`. A panel with that name is replaced.
    pub(crate) fn add_outline(&mut self, name: &str, outline: &[Edge]) {
        let outline: Vec<Edge> =
            outline.iter().filter(|edge| can_be_drawn(edge)).cloned().collect();
        if outline.is_empty() {
            return;
        }
        let panel = SketchPanel { name: name.into(), outline, holes: Vec::new() };
        match self.panels.iter_mut().find(|sketched| sketched.name == name) {
            Some(sketched) => *sketched = panel,
            None => self.panels.push(panel),
        }
    }

    /// Adds `panel`, which is sound, with its darts.
    pub(crate) fn add_panel(&mut self, panel: &Panel) {
        self.add_outline(panel.name(), panel.outline());
        let holes = panel.loops().skip(1).map(<[Edge]>::to_vec);
        if let Some(sketched) =
            self.panels.iter_mut().find(|sketched| sketched.name == panel.name())
        {
            sketched.holes = holes.collect();
        }
    }

    /// Adds `hole`, the hole of a dart, to the panel with the name `panel`.
    pub(crate) fn add_hole(&mut self, panel: &str, hole: &[Edge]) {
        if let Some(sketched) = self.panels.iter_mut().find(|sketched| sketched.name == panel)
            && hole.iter().all(can_be_drawn)
        {
            sketched.holes.push(hole.to_vec());
        }
    }

    /// Removes the panel `name`, which the pattern leaves out.
    pub(crate) fn remove(&mut self, name: &str) {
        self.panels.retain(|panel| panel.name != name);
    }

    /// Adds the seam `name` with the edges of both sides, as `panel.edge`.
    pub(crate) fn add_seam(&mut self, name: &str, edges: Vec<String>) {
        self.seams.retain(|seam| seam.name != name);
        self.seams.push(SketchSeam { name: name.into(), edges });
    }

    /// Returns whether one of `faults` is about `edge` of `panel`.
    pub(crate) fn is_wrong(
        &self,
        panel: &SketchPanel,
        edge: &Edge,
        faults: &[SketchFault],
    ) -> bool {
        let word = format!("{}.{}", panel.name, edge.name);
        faults.iter().any(|fault| match &fault.subject {
            Subject::Panel(name) => fault.at.is_none() && *name == panel.name,
            Subject::Edge { panel: name, edge: wrong } => {
                *name == panel.name && (*wrong == edge.name || is_part(&edge.name, wrong))
            }
            Subject::Seam(name) => {
                let mut seams = self.seams.iter().filter(|seam| seam.name == *name);
                seams
                    .any(|seam| seam.edges.iter().any(|sewn| *sewn == word || is_part(&word, sewn)))
            }
            _ => false,
        })
    }
}

/// Returns whether `edge` can be drawn: it is finite, and not so far away that the rest would
/// shrink to a point.
fn can_be_drawn(edge: &Edge) -> bool {
    edge.is_finite() && edge.coordinates().all(|x| x.abs() <= FARTHEST) && edge.length() <= FARTHEST
}

/// Returns whether `name` is the name of a part of the edge `whole`, such as `waist 2` for `waist`.
fn is_part(name: &str, whole: &str) -> bool {
    let number = name.strip_prefix(whole).and_then(|rest| rest.strip_prefix(' '));
    number.is_some_and(|number| number.parse::<usize>().is_ok())
}

impl SketchPanel {
    /// Returns the gaps between edges in a row that are wider than [`GAP`], by both ends, in m.
    pub(crate) fn gaps(&self) -> Vec<[[f64; 2]; 2]> {
        let next = self.outline.iter().cycle().skip(1);
        let ends = self.outline.iter().zip(next).map(|(edge, next)| [edge.end, next.start]);
        ends.filter(|[end, start]| distance(*end, *start) > GAP).collect()
    }

    /// Returns the edges that cross or touch others, and the points where they do, in m. An edge is
    /// known by its number among the edges of the outline and then of the holes.
    pub(crate) fn crossings(&self) -> (Vec<usize>, Vec<[f64; 2]>) {
        let mut rings = Vec::new();
        let mut first = 0;
        for edges in std::iter::once(&self.outline).chain(&self.holes) {
            rings.push((first, Ring::new(edges)));
            first += edges.len();
        }

        // Each ring is compared with itself and with the rings before it.
        let mut meetings: Vec<([usize; 2], Meeting)> = Vec::new();
        for (number, (first, ring)) in rings.iter().enumerate() {
            meetings.extend(ring.crossing().map(|meeting| ([*first; 2], meeting)));
            for (earlier_first, earlier) in &rings[..number] {
                let meeting = ring.meeting(earlier);
                meetings.extend(meeting.map(|meeting| ([*first, *earlier_first], meeting)));
            }
        }
        let edges = meetings
            .iter()
            .flat_map(|(firsts, meeting)| [0, 1].map(|k| firsts[k] + meeting.edges[k]));
        (edges.collect(), meetings.iter().map(|(_, meeting)| meeting.at).collect())
    }
}

impl SketchFault {
    /// Returns the fault that `mistake` is in a sketch; `None` if `mistake` is about the spacing.
    #[must_use]
    pub fn from_mistake(mistake: &Mistake) -> Option<Self> {
        Some(Self { subject: mistake.subject()?, at: mistake.place() })
    }
}
