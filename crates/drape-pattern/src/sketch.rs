//! Sketch of a pattern file: its lines as they stand there, sound or not, to be drawn beside the
//! mistakes.
//!
//! The readers add every outline before it is checked. `write` draws it.

use drape_input::Subject;

use crate::edge::{Edge, distance};
use crate::mistake::Mistake;
use crate::panel::ring::{Meeting, Ring};
use crate::panel::{FARTHEST, Panel};
use crate::pattern::Pattern;
use crate::pattern::seam::EdgeId;

/// Width of a gap between two edges from which on it is shown, in m.
const GAP: f64 = 1e-5;

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

/// Seam of a sketch: the edges of both sides, as `panel.edge`.
#[derive(Debug, Clone)]
struct SketchSeam {
    name: String,
    words: Vec<String>,
}

/// What is wrong in a sketch: a part of it, with the place where that is known, in the frame of the
/// panel, in m.
#[derive(Debug, Clone, PartialEq)]
pub struct SketchFault {
    /// The part.
    pub subject: Subject,
    /// The place.
    pub at: Option<[f64; 2]>,
}

impl Sketch {
    /// Returns the sketch of a sound pattern.
    #[must_use]
    pub fn from_pattern(pattern: &Pattern) -> Self {
        let mut sketch = Self::default();
        pattern.panels().iter().for_each(|panel| sketch.put(panel));
        for seam in pattern.seams() {
            let word = |id: &EdgeId| {
                format!("{}.{}", pattern.panels()[id.panel].name(), pattern.edge(*id).name)
            };
            let words = seam.sides.iter().flatten().map(word).collect();
            sketch.seams.push(SketchSeam { name: seam.name.clone(), words });
        }
        sketch
    }

    /// Returns whether it has no panel.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.panels.is_empty()
    }

    /// Adds an outline; one of the same name takes the place of the one before.
    pub(crate) fn add(&mut self, name: &str, outline: &[Edge]) {
        let outline: Vec<Edge> =
            outline.iter().filter(|edge| can_be_drawn(edge)).cloned().collect();
        if outline.is_empty() {
            return;
        }
        let panel = SketchPanel { name: name.into(), outline, holes: Vec::new() };
        match self.panels.iter_mut().find(|own| own.name == name) {
            Some(own) => *own = panel,
            None => self.panels.push(panel),
        }
    }

    /// Adds a panel that is sound, with its darts.
    pub(crate) fn put(&mut self, panel: &Panel) {
        self.add(panel.name(), panel.outline());
        let holes = panel.loops().skip(1).map(<[Edge]>::to_vec);
        if let Some(own) = self.panels.iter_mut().find(|own| own.name == panel.name()) {
            own.holes = holes.collect();
        }
    }

    /// Adds the hole of a dart to a panel.
    pub(crate) fn add_hole(&mut self, panel: &str, hole: &[Edge]) {
        if let Some(own) = self.panels.iter_mut().find(|own| own.name == panel)
            && hole.iter().all(can_be_drawn)
        {
            own.holes.push(hole.to_vec());
        }
    }

    /// Removes a panel that the pattern leaves out.
    pub(crate) fn remove(&mut self, name: &str) {
        self.panels.retain(|panel| panel.name != name);
    }

    /// Adds a seam with the edges of its sides, as `panel.edge`.
    pub(crate) fn add_seam(&mut self, name: &str, words: Vec<String>) {
        self.seams.retain(|seam| seam.name != name);
        self.seams.push(SketchSeam { name: name.into(), words });
    }

    /// Returns whether an edge of a panel is wrong, as data says it.
    pub(crate) fn is_wrong(&self, panel: &SketchPanel, edge: &Edge, wrong: &[SketchFault]) -> bool {
        let word = format!("{}.{}", panel.name, edge.name);
        let part = |whole: &String| edge_is_part(&word, whole);
        wrong.iter().any(|wrong| match &wrong.subject {
            Subject::Panel(name) => wrong.at.is_none() && *name == panel.name,
            Subject::Edge { panel: name, edge: own } => {
                *name == panel.name && (*own == edge.name || edge_is_part(&edge.name, own))
            }
            Subject::Seam(name) => {
                let seams = self.seams.iter().filter(|seam| seam.name == *name);
                seams.into_iter().any(|seam| seam.words.iter().any(|own| *own == word || part(own)))
            }
            _ => false,
        })
    }
}

/// Returns whether an edge can be drawn: it is finite, and so near that the others are seen.
fn can_be_drawn(edge: &Edge) -> bool {
    edge.is_finite() && edge.coordinates().all(|x| x.abs() <= FARTHEST) && edge.length() <= FARTHEST
}

/// Returns whether the name of an edge is that of a part of another one, such as `waist 2`.
fn edge_is_part(name: &str, whole: &str) -> bool {
    let rest = name.strip_prefix(whole).and_then(|rest| rest.strip_prefix(' '));
    rest.is_some_and(|rest| rest.parse::<usize>().is_ok())
}

impl SketchPanel {
    /// Returns the gaps between edges in a row, by both ends, in m.
    pub(crate) fn gaps(&self) -> Vec<[[f64; 2]; 2]> {
        let next = self.outline.iter().cycle().skip(1);
        let ends = self.outline.iter().zip(next).map(|(edge, next)| [edge.end, next.start]);
        ends.filter(|[end, start]| distance(*end, *start) > GAP).collect()
    }

    /// Returns the edges that cross or touch others, by their numbers among those of the outline and of
    /// the holes in a row, and the points where.
    pub(crate) fn crossings(&self) -> (Vec<usize>, Vec<[f64; 2]>) {
        let parts = || std::iter::once(&self.outline).chain(&self.holes);
        let rings: Vec<Ring> = parts().map(|edges| Ring::new(edges)).collect();
        let firsts =
            parts().scan(0, |count, edges| Some(std::mem::replace(count, *count + edges.len())));
        let firsts: Vec<usize> = firsts.collect();
        let (mut edges, mut places) = (Vec::new(), Vec::new());
        for one in 0..rings.len() {
            let mut add = |meeting: Meeting, other: usize| {
                let [first, second] = meeting.edges;
                edges.extend([firsts[one] + first, firsts[other] + second]);
                places.push(meeting.at);
            };
            if let Some(meeting) = rings[one].crossing() {
                add(meeting, one);
            }
            for other in 0..one {
                if let Some(meeting) = rings[one].meeting(&rings[other]) {
                    add(meeting, other);
                }
            }
        }
        (edges, places)
    }
}

impl SketchFault {
    /// Returns what a mistake finds wrong in a pattern; `None` of the spacing.
    #[must_use]
    pub fn from_mistake(mistake: &Mistake) -> Option<Self> {
        Some(Self { subject: mistake.subject()?, at: mistake.place() })
    }
}
