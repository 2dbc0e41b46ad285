//! Patterns: checked panels and the seams that sew them together.

use crate::ease::MAX_EASE;
use crate::edge::{Edge, distance};
use crate::mistake::Mistake;
use crate::note::Note;
use crate::panel::Panel;

/// Edge of a pattern, by the numbers of its panel and edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct EdgeId {
    /// Number of the panel, from 0.
    pub panel: usize,
    /// Number of the edge in its outline, from 0.
    pub edge: usize,
}

/// Seam: two chains of edges that are sewn together.
#[derive(Debug, Clone, PartialEq)]
pub struct Seam {
    /// Name, or number where the file gives no name.
    pub name: String,
    /// Edges of both sides, each in the order in which the seam runs. The seam runs along the
    /// outlines of the first side's panels and against those of the second side's: right side on
    /// right side.
    pub sides: [Vec<EdgeId>; 2],
    /// Whether it runs along the outlines of the second side's panels too: right side on wrong
    /// side.
    pub reversed: bool,
    /// Largest ratio of the lengths of the sides that is intended, from 1 to [`MAX_EASE`].
    pub max_ease: f64,
    /// Angle between the sides of the sewn seam, towards their right sides, in rad: 0 if it is
    /// pressed open.
    pub angle: f64,
    /// Width of the seam allowance: of the cloth beyond the seam on each side, in m.
    pub allowance: f64,
}

/// Garment pattern: checked panels and seams.
///
/// ```
/// use drape_input::Document;
/// use drape_pattern::Pattern;
///
/// let text = "length = \"cm\"\n[panel.a]\ngrain = 0\nrectangle = [20, 30]\n\
///             [panel.b]\ngrain = 0\nrectangle = [25, 30]\n\
///             [seam.side]\nsides = [[\"a.right\"], [\"b.left\"]]\n";
/// let pattern = Pattern::parse(&Document::new("strip.toml", text))?;
/// assert_eq!((pattern.panels().len(), pattern.seams().len()), (2, 1));
/// assert!((pattern.panels()[1].area() - 0.075).abs() < 1e-12);
/// # Ok::<(), drape_input::Diagnostics>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Pattern {
    panels: Vec<Panel>,
    seams: Vec<Seam>,
    notes: Vec<Note>,
}

impl Pattern {
    /// Returns a pattern of panels and seams.
    ///
    /// # Errors
    /// All mistakes of the seams, and panels of the same name, together.
    pub fn new(panels: Vec<Panel>, seams: Vec<Seam>) -> Result<Self, Vec<Mistake>> {
        let pattern = Self { panels, seams, notes: Vec::new() };
        let mut mistakes = Vec::new();
        for (index, panel) in pattern.panels.iter().enumerate() {
            if pattern.panels[..index].iter().any(|p| p.name() == panel.name()) {
                mistakes.push(Mistake::SamePanel { panel: panel.name().into() });
            }
        }
        for index in 0..pattern.seams.len() {
            mistakes.extend(pattern.mistakes(index));
        }
        if mistakes.is_empty() { Ok(pattern) } else { Err(mistakes) }
    }

    /// Returns the pattern with the notes of its reader, and notes on seams that seem twisted.
    pub(crate) fn with_notes(mut self, notes: Vec<Note>) -> Self {
        let twisted = (0..self.seams.len()).filter_map(|k| self.twisted(k));
        self.notes = notes.into_iter().chain(twisted).collect();
        self
    }

    /// Panels of the pattern.
    #[must_use]
    pub fn panels(&self) -> &[Panel] {
        &self.panels
    }

    /// Seams of the pattern.
    #[must_use]
    pub fn seams(&self) -> &[Seam] {
        &self.seams
    }

    /// Notes on the pattern for its user.
    #[must_use]
    pub fn notes(&self) -> &[Note] {
        &self.notes
    }

    /// Returns the edge with a number that exists.
    pub(crate) fn edge(&self, id: EdgeId) -> &Edge {
        &self.panels[id.panel].outline()[id.edge]
    }

    /// Returns the length of a side of a seam, in m.
    pub(crate) fn side_length(&self, side: &[EdgeId]) -> f64 {
        side.iter().map(|&id| self.edge(id).length()).sum()
    }

    /// Returns the mistakes of a seam.
    fn mistakes(&self, index: usize) -> Vec<Mistake> {
        let seam = &self.seams[index];
        let name = || seam.name.clone();
        let mut mistakes = Vec::new();
        if !(1.0..=MAX_EASE).contains(&seam.max_ease) {
            mistakes.push(Mistake::MaxEase { seam: name(), max_ease: seam.max_ease });
        }
        for id in seam.sides.iter().flatten() {
            if self.panels.get(id.panel).is_none_or(|p| id.edge >= p.outline().len()) {
                let EdgeId { panel, edge } = *id;
                mistakes.push(Mistake::NoEdge { seam: name(), panel, edge });
            }
        }
        if seam.sides.iter().any(Vec::is_empty) {
            mistakes.push(Mistake::EmptySide { seam: name() });
        }
        if !mistakes.is_empty() {
            return mistakes;
        }
        let mut before: Vec<(EdgeId, &str)> = Vec::new();
        for other in &self.seams[..index] {
            before.extend(other.sides.iter().flatten().map(|&id| (id, other.name.as_str())));
        }
        for &id in seam.sides.iter().flatten() {
            if let Some((_, first)) = before.iter().find(|(other, _)| *other == id) {
                mistakes.push(Mistake::SewnTwice {
                    panel: self.panels[id.panel].name().into(),
                    edge: self.edge(id).name.clone(),
                    first: (*first).into(),
                    second: name(),
                });
            }
            if self.edge(id).hem > 0.0 {
                mistakes.push(Mistake::SewnHem {
                    panel: self.panels[id.panel].name().into(),
                    edge: self.edge(id).name.clone(),
                    seam: name(),
                });
            }
            before.push((id, &seam.name));
        }
        mistakes.extend(self.too_full(seam));
        mistakes
    }

    /// Returns the mistake of a seam whose sides differ too much in length.
    fn too_full(&self, seam: &Seam) -> Option<Mistake> {
        let [a, b] = &seam.sides;
        let (length_a, length_b) = (self.side_length(a), self.side_length(b));
        let (long, short) = if length_a >= length_b { (a, b) } else { (b, a) };
        let lengths = [length_a.max(length_b), length_a.min(length_b)];
        let ratio = lengths[0] / lengths[1];
        let limit = seam.max_ease.min(MAX_EASE);
        let words = |side: &[EdgeId]| {
            let name =
                |id: &EdgeId| format!("{}.{}", self.panels[id.panel].name(), self.edge(*id).name);
            side.iter().map(name).collect::<Vec<_>>().join(" + ")
        };
        // The rounding of the digits of a file is no ease.
        (ratio > limit * (1.0 + 1e-6)).then(|| Mistake::Ease {
            seam: seam.name.clone(),
            long: words(long),
            short: words(short),
            lengths,
            ratio,
            max_ease: limit,
        })
    }

    /// Returns a note if the ends of a seam lie much closer to each other in space when it is
    /// reversed.
    fn twisted(&self, index: usize) -> Option<Note> {
        let seam = &self.seams[index];
        let [first, second] = &seam.sides;
        let end = |id: EdgeId, at_end: bool| {
            let edge = self.edge(id);
            let placement = self.panels[id.panel].placement()?;
            Some(placement.point(if at_end { edge.end } else { edge.start }))
        };
        let along = seam.reversed;
        let (a, b) = (end(*first.first()?, false)?, end(*first.last()?, true)?);
        let (c, d) = (end(*second.first()?, !along)?, end(*second.last()?, along)?);
        let apart =
            |p: [f64; 3], q: [f64; 3]| distance([p[0], p[1]], [q[0], q[1]]).hypot(p[2] - q[2]);
        let given = apart(a, c).max(apart(b, d));
        let reversed = apart(a, d).max(apart(b, c));
        let name = seam.name.clone();
        (given > 2.0 * reversed).then_some(Note::Twisted { seam: name, given, reversed })
    }
}
