use crate::edge::{Edge, distance};
use crate::mistake::Mistake;
use crate::note::Note;
use crate::panel::Panel;

/// Largest ratio of the lengths of a stitch's sides that can be cut. The fullest gathers of clothes have about
/// four; what is squeezed into one arc must not be nearer to each other than cloth is thick.
pub const MAX_EASE: f64 = 5.0;

/// An edge of a pattern, by the numbers of panel and edge, from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct EdgeId {
    /// The panel.
    pub panel: usize,
    /// The edge of its outline.
    pub edge: usize,
}

/// Two chains of edges that are sewn together.
#[derive(Debug, Clone, PartialEq)]
pub struct Stitch {
    /// Its name, or its number.
    pub name: String,
    /// The edges of both sides, each in the order in which the seam runs. The seam runs along the outline
    /// of the first side's panels, and against that of the second side's: right side on right side.
    pub sides: [Vec<EdgeId>; 2],
    /// Whether it runs along the outline of the second side's panels too: right side on wrong side.
    pub reversed: bool,
    /// Largest ratio of the lengths of the sides that is meant, from 1 to [`MAX_EASE`].
    pub max_ease: f64,
    /// Angle by which the sides are turned towards their right sides when it is sewn, in rad: 0 if it is pressed open.
    pub angle: f64,
    /// Width of the cloth beyond the seam on each side, in m.
    pub allowance: f64,
}

/// Checked panels and how they are sewn.
#[derive(Debug, Clone, PartialEq)]
pub struct Pattern {
    panels: Vec<Panel>,
    stitches: Vec<Stitch>,
    notes: Vec<Note>,
}

impl Pattern {
    /// A pattern of panels and stitches.
    ///
    /// # Errors
    /// All mistakes of the stitches, and panels of the same name.
    pub fn new(panels: Vec<Panel>, stitches: Vec<Stitch>) -> Result<Self, Vec<Mistake>> {
        let pattern = Self { panels, stitches, notes: Vec::new() };
        let mut mistakes = Vec::new();
        for (index, panel) in pattern.panels.iter().enumerate() {
            if pattern.panels[..index].iter().any(|p| p.name() == panel.name()) {
                mistakes.push(Mistake::SamePanel { panel: panel.name().into() });
            }
        }
        for index in 0..pattern.stitches.len() {
            mistakes.extend(pattern.mistakes(index));
        }
        if mistakes.is_empty() { Ok(pattern) } else { Err(mistakes) }
    }

    /// The pattern with what its reader noticed, and stitches that seem twisted.
    pub(crate) fn with_notes(mut self, notes: Vec<Note>) -> Self {
        let twisted = (0..self.stitches.len()).filter_map(|k| self.twisted(k));
        self.notes = notes.into_iter().chain(twisted).collect();
        self
    }

    /// The panels.
    #[must_use]
    pub fn panels(&self) -> &[Panel] {
        &self.panels
    }

    /// The stitches.
    #[must_use]
    pub fn stitches(&self) -> &[Stitch] {
        &self.stitches
    }

    /// What the user should know about the pattern.
    #[must_use]
    pub fn notes(&self) -> &[Note] {
        &self.notes
    }

    /// The edge with this number, which there is.
    pub(crate) fn edge(&self, id: EdgeId) -> &Edge {
        &self.panels[id.panel].outline()[id.edge]
    }

    /// Length of a side of a stitch, in m.
    pub(crate) fn side_length(&self, side: &[EdgeId]) -> f64 {
        side.iter().map(|&id| self.edge(id).length()).sum()
    }

    fn mistakes(&self, index: usize) -> Vec<Mistake> {
        let stitch = &self.stitches[index];
        let name = || stitch.name.clone();
        let mut mistakes = Vec::new();
        if !(1.0..=MAX_EASE).contains(&stitch.max_ease) {
            mistakes.push(Mistake::MaxEase { stitch: name(), max_ease: stitch.max_ease });
        }
        for id in stitch.sides.iter().flatten() {
            if self.panels.get(id.panel).is_none_or(|p| id.edge >= p.outline().len()) {
                let EdgeId { panel, edge } = *id;
                mistakes.push(Mistake::NoEdge { stitch: name(), panel, edge });
            }
        }
        if stitch.sides.iter().any(Vec::is_empty) {
            mistakes.push(Mistake::EmptySide { stitch: name() });
        }
        if !mistakes.is_empty() {
            return mistakes;
        }
        let mut before: Vec<(EdgeId, &str)> = Vec::new();
        for other in &self.stitches[..index] {
            before.extend(other.sides.iter().flatten().map(|&id| (id, other.name.as_str())));
        }
        for &id in stitch.sides.iter().flatten() {
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
                    stitch: name(),
                });
            }
            before.push((id, &stitch.name));
        }
        mistakes.extend(self.too_full(stitch));
        mistakes
    }

    fn too_full(&self, stitch: &Stitch) -> Option<Mistake> {
        let [a, b] = &stitch.sides;
        let (length_a, length_b) = (self.side_length(a), self.side_length(b));
        let (long, short) = if length_a >= length_b { (a, b) } else { (b, a) };
        let lengths = [length_a.max(length_b), length_a.min(length_b)];
        let ratio = lengths[0] / lengths[1];
        let limit = stitch.max_ease.min(MAX_EASE);
        let says = |side: &[EdgeId]| {
            let name =
                |id: &EdgeId| format!("{}.{}", self.panels[id.panel].name(), self.edge(*id).name);
            side.iter().map(name).collect::<Vec<_>>().join(" + ")
        };
        // The digits of a file are no fullness.
        (ratio > limit * (1.0 + 1e-6)).then(|| Mistake::Ease {
            stitch: stitch.name.clone(),
            long: says(long),
            short: says(short),
            lengths,
            ratio,
            max_ease: limit,
        })
    }

    /// Whether the ends of a stitch lie much nearer to each other in space if it is reversed.
    fn twisted(&self, index: usize) -> Option<Note> {
        let stitch = &self.stitches[index];
        let [first, second] = &stitch.sides;
        let end = |id: EdgeId, at_end: bool| {
            let edge = self.edge(id);
            let placement = self.panels[id.panel].placement()?;
            Some(placement.point(if at_end { edge.end } else { edge.start }))
        };
        let along = stitch.reversed;
        let (a, b) = (end(*first.first()?, false)?, end(*first.last()?, true)?);
        let (c, d) = (end(*second.first()?, !along)?, end(*second.last()?, along)?);
        let apart =
            |p: [f64; 3], q: [f64; 3]| distance([p[0], p[1]], [q[0], q[1]]).hypot(p[2] - q[2]);
        let given = apart(a, c).max(apart(b, d));
        let reversed = apart(a, d).max(apart(b, c));
        let name = stitch.name.clone();
        (given > 2.0 * reversed).then_some(Note::Twisted { stitch: name, given, reversed })
    }
}
