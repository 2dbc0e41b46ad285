//! Patterns: checked panels and the seams that sew them together.

mod chain;
pub(crate) mod partition;
pub(crate) mod seam;

use crate::ease::MAX_EASE;
use crate::edge::{Edge, distance};
use crate::mistake::Mistake;
use crate::note::PatternNote;
use crate::panel::Panel;
use crate::panel::dart::Dart;
use chain::turn_listings;
use seam::{EdgeId, Seam};

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
    notes: Vec<PatternNote>,
}

impl Pattern {
    /// Returns a pattern of panels and seams.
    ///
    /// # Errors
    /// All mistakes of the seams, and panels of the same name, together.
    pub fn new(panels: Vec<Panel>, seams: Vec<Seam>) -> Result<Self, Vec<Mistake>> {
        let mut pattern = Self { panels, seams, notes: Vec::new() };
        pattern.sew_darts();
        let mut mistakes = Vec::new();
        for (index, panel) in pattern.panels.iter().enumerate() {
            if pattern.panels[..index].iter().any(|p| p.name() == panel.name()) {
                mistakes.push(Mistake::SamePanel { panel: panel.name().into() });
            }
        }
        for index in 0..pattern.seams.len() {
            mistakes.extend(pattern.mistakes(index));
        }
        if !mistakes.is_empty() {
            return Err(mistakes);
        }
        turn_listings(&pattern.panels, &mut pattern.seams);
        Ok(pattern)
    }

    /// Returns the notes of its reader.
    pub(crate) fn reader_notes(&self) -> Vec<PatternNote> {
        let of_reader = |note: &&PatternNote| !matches!(note, PatternNote::Twisted { .. });
        self.notes.iter().filter(of_reader).cloned().collect()
    }

    /// Returns the pattern with the grain of a panel, by its number, in rad.
    ///
    /// # Errors
    /// The angle is not finite.
    pub fn with_grain(mut self, panel: usize, grain: f64) -> Result<Self, Mistake> {
        let name = self.panels[panel].name().to_owned();
        self.panels[panel] = self.panels[panel].clone().with_grain(grain)?;
        for note in &mut self.notes {
            if let PatternNote::NoGrain { panels } = note {
                panels.retain(|other| *other != name);
            }
        }
        self.notes
            .retain(|note| !matches!(note, PatternNote::NoGrain { panels } if panels.is_empty()));
        Ok(self)
    }

    /// Returns the pattern with the notes of its reader, and notes on seams that seem twisted.
    pub(crate) fn with_notes(mut self, notes: Vec<PatternNote>) -> Self {
        let twisted = (0..self.seams.len()).filter_map(|k| self.twisted(k));
        let sewn = !self.seams.is_empty();
        let notes =
            notes.into_iter().filter(|n| !(sewn && matches!(n, PatternNote::NoSeams { .. })));
        self.notes = notes.chain(twisted).collect();
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
    pub fn notes(&self) -> &[PatternNote] {
        &self.notes
    }

    /// Returns the edge with a number that exists.
    pub(crate) fn edge(&self, id: EdgeId) -> &Edge {
        self.panels[id.panel].edges().nth(id.edge).expect("its seam has been checked")
    }

    /// Returns the length of a side of a seam, in m.
    pub(crate) fn side_length(&self, side: &[EdgeId]) -> f64 {
        side.iter().map(|&id| self.edge(id).length()).sum()
    }

    /// Adds the seams of darts whose legs no seam names.
    fn sew_darts(&mut self) {
        for (number, panel) in self.panels.iter().enumerate() {
            for dart in panel.darts() {
                let ids = |leg: &Vec<String>| -> Option<Vec<EdgeId>> {
                    let edge = |name: &String| panel.edges().position(|edge| edge.name == *name);
                    leg.iter()
                        .map(|name| Some(EdgeId { panel: number, edge: edge(name)? }))
                        .collect()
                };
                let [Some(left), Some(right)] = dart.legs.each_ref().map(ids) else { continue };
                let all = self.seams.iter().flat_map(|seam| seam.sides.iter().flatten());
                if all.clone().any(|id| left.contains(id) || right.contains(id)) {
                    continue;
                }
                let name = format!("{}.{}", panel.name(), dart.name);
                self.seams.push(Seam::of_dart(name, [left, right]));
            }
        }
    }

    /// Returns whether a seam is that of a closed dart, which the dart says itself.
    pub(crate) fn is_dart(&self, seam: &Seam) -> bool {
        let mut ids = seam.sides.iter().flatten();
        let Some(panel) = ids.next().and_then(|id| self.panels.get(id.panel)) else { return false };
        let names = |dart: &Dart| {
            !dart.hole().is_empty() && format!("{}.{}", panel.name(), dart.name) == seam.name
        };
        *seam == Seam::of_dart(seam.name.clone(), seam.sides.clone())
            && panel.darts().iter().any(names)
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
            if self.panels.get(id.panel).is_none_or(|p| id.edge >= p.edges().count()) {
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
    fn twisted(&self, index: usize) -> Option<PatternNote> {
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
        (given > 2.0 * reversed).then_some(PatternNote::Twisted { seam: name, given, reversed })
    }
}
