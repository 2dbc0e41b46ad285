//! Patterns: checked panels and the seams that sew them together.

mod chain;
pub(crate) mod partition;
pub(crate) mod seam;

use std::collections::{BTreeMap, BTreeSet};

use crate::ease::MAX_EASE;
use crate::edge::{Edge, distance};
use crate::mistake::Mistake;
use crate::note::PatternNote;
use crate::panel::Panel;
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

/// Edges that are sewn, each with the name of the first seam that names it.
type SewnEdges<'a> = BTreeMap<EdgeId, &'a str>;

impl Pattern {
    /// Returns a pattern of `panels` and `seams`, with a seam for each dart whose legs no seam
    /// names.
    ///
    /// # Errors
    /// All mistakes of `seams`, and all names that two of `panels` have.
    pub fn new(panels: Vec<Panel>, seams: Vec<Seam>) -> Result<Self, Vec<Mistake>> {
        let mut pattern = Self { panels, seams, notes: Vec::new() };
        pattern.sew_darts();
        let mut mistakes = Vec::new();

        let mut names = BTreeSet::new();
        for panel in &pattern.panels {
            if !names.insert(panel.name()) {
                mistakes.push(Mistake::SamePanel { panel: panel.name().into() });
            }
        }
        let mut sewn = SewnEdges::new();
        for seam in &pattern.seams {
            mistakes.extend(pattern.mistakes(seam, &mut sewn));
        }
        if !mistakes.is_empty() {
            return Err(mistakes);
        }

        turn_listings(&pattern.panels, &mut pattern.seams);
        Ok(pattern)
    }

    /// Returns the notes that came with the file, which are all but [`PatternNote::Twisted`].
    pub(crate) fn file_notes(&self) -> Vec<PatternNote> {
        let all = self.notes.iter();
        all.filter(|note| !matches!(note, PatternNote::Twisted { .. })).cloned().collect()
    }

    /// Returns the pattern with the angle `grain`, in rad, for the panel with the number `panel`.
    ///
    /// # Errors
    /// `grain` is not finite.
    pub fn with_grain(mut self, panel: usize, grain: f64) -> Result<Self, Mistake> {
        let name = self.panels[panel].name().to_owned();
        self.panels[panel] = self.panels[panel].clone().with_grain(grain)?;
        for note in &mut self.notes {
            if let PatternNote::NoGrain { panels } = note {
                panels.retain(|panel| *panel != name);
            }
        }
        self.notes
            .retain(|note| !matches!(note, PatternNote::NoGrain { panels } if panels.is_empty()));
        Ok(self)
    }

    /// Returns the pattern with `notes` of its file, and notes on seams that seem twisted.
    pub(crate) fn with_notes(mut self, notes: Vec<PatternNote>) -> Self {
        let twisted = (0..self.seams.len()).filter_map(|k| self.twisted(k));
        let has_seams = !self.seams.is_empty();
        let notes = notes
            .into_iter()
            .filter(|note| !(has_seams && matches!(note, PatternNote::NoSeams { .. })));
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

    /// Notes on the pattern, to be shown to its user.
    #[must_use]
    pub fn notes(&self) -> &[PatternNote] {
        &self.notes
    }

    /// Returns the edge with the number `id`, which exists.
    pub(crate) fn edge(&self, id: EdgeId) -> &Edge {
        self.panels[id.panel].edges().nth(id.edge).expect("its seam has been checked")
    }

    /// Returns the edge `id` as a file names it: `panel.edge`.
    pub(crate) fn edge_word(&self, id: EdgeId) -> String {
        format!("{}.{}", self.panels[id.panel].name(), self.edge(id).name)
    }

    /// Returns whether `id` is the edge `edge` of `panel`, by the names of both.
    pub(crate) fn is_edge_of(&self, id: EdgeId, panel: &Panel, edge: &Edge) -> bool {
        self.panels[id.panel].name() == panel.name() && self.edge(id).name == edge.name
    }

    /// Returns the length of `side`, a side of a seam, in m.
    pub(crate) fn side_length(&self, side: &[EdgeId]) -> f64 {
        side.iter().map(|&id| self.edge(id).length()).sum()
    }

    /// Adds a seam for each dart whose legs no seam names.
    fn sew_darts(&mut self) {
        let ids = self.seams.iter().flat_map(|seam| seam.sides.iter().flatten());
        let mut sewn: BTreeSet<EdgeId> = ids.copied().collect();
        for (number, panel) in self.panels.iter().enumerate() {
            for dart in panel.darts() {
                let [Some(left), Some(right)] =
                    dart.legs.each_ref().map(|leg| leg_ids(panel, number, leg))
                else {
                    continue;
                };
                if left.iter().chain(&right).any(|id| sewn.contains(id)) {
                    continue;
                }
                sewn.extend(left.iter().chain(&right));
                let name = format!("{}.{}", panel.name(), dart.name);
                self.seams.push(Seam::for_dart(name, [left, right]));
            }
        }
    }

    /// Returns whether `seam` sews a closed dart. A file states such a seam with the dart.
    pub(crate) fn is_dart(&self, seam: &Seam) -> bool {
        let mut ids = seam.sides.iter().flatten();
        let Some(panel) = ids.next().and_then(|id| self.panels.get(id.panel)) else { return false };
        *seam == Seam::for_dart(seam.name.clone(), seam.sides.clone())
            && panel.darts().iter().any(|dart| {
                !dart.hole().is_empty() && format!("{}.{}", panel.name(), dart.name) == seam.name
            })
    }

    /// Returns the mistakes of `seam`, and adds its edges to `sewn`, the edges of the seams before
    /// it.
    fn mistakes<'a>(&'a self, seam: &'a Seam, sewn: &mut SewnEdges<'a>) -> Vec<Mistake> {
        let mistakes = self.mistakes_of_sides(seam);
        if mistakes.is_empty() {
            return self.mistakes_of_edges(seam, sewn);
        }
        for &id in seam.sides.iter().flatten() {
            sewn.entry(id).or_insert(&seam.name);
        }
        mistakes
    }

    /// Returns the mistakes of `seam` that leave its edges unknown.
    fn mistakes_of_sides(&self, seam: &Seam) -> Vec<Mistake> {
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
        mistakes
    }

    /// Returns the mistakes of `seam`, whose edges exist, and adds its edges to `sewn`, the edges
    /// of the seams before it. An edge takes part in one seam, once.
    fn mistakes_of_edges<'a>(&'a self, seam: &'a Seam, sewn: &mut SewnEdges<'a>) -> Vec<Mistake> {
        let name = || seam.name.clone();
        let mut mistakes = Vec::new();
        for &id in seam.sides.iter().flatten() {
            if let Some(first) = sewn.get(&id) {
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
            sewn.entry(id).or_insert(&seam.name);
        }

        mistakes.extend(self.ease_mistake(seam));
        mistakes
    }

    /// Returns the mistake of `seam` if its sides differ too much in length.
    fn ease_mistake(&self, seam: &Seam) -> Option<Mistake> {
        let [a, b] = &seam.sides;
        let (length_a, length_b) = (self.side_length(a), self.side_length(b));
        let (long, short) = if length_a >= length_b { (a, b) } else { (b, a) };
        let lengths = [length_a.max(length_b), length_a.min(length_b)];
        let ratio = lengths[0] / lengths[1];
        let limit = seam.max_ease.min(MAX_EASE);

        let [long, short] = [long, short]
            .map(|side| side.iter().map(|&id| self.edge_word(id)).collect::<Vec<_>>().join(" + "));
        // The rounding of the digits of a file is no ease.
        (ratio > limit * (1.0 + 1e-6)).then(|| Mistake::Ease {
            seam: seam.name.clone(),
            long,
            short,
            lengths,
            ratio,
            max_ease: limit,
        })
    }

    /// Returns a note if the ends of the seam with the number `index` would lie much closer to each
    /// other in space if the seam were reversed.
    fn twisted(&self, index: usize) -> Option<PatternNote> {
        let seam = &self.seams[index];
        let [first, second] = &seam.sides;
        let along = seam.reversed;
        let a = self.end_in_space(*first.first()?, false)?;
        let b = self.end_in_space(*first.last()?, true)?;
        let c = self.end_in_space(*second.first()?, !along)?;
        let d = self.end_in_space(*second.last()?, along)?;

        let given = distance_in_space(a, c).max(distance_in_space(b, d));
        let reversed = distance_in_space(a, d).max(distance_in_space(b, c));
        let name = seam.name.clone();
        (given > 2.0 * reversed).then_some(PatternNote::Twisted { seam: name, given, reversed })
    }

    /// Returns the end of the edge `id` in space if `at_end`, else its start, in m; `None` if the
    /// panel has no placement.
    fn end_in_space(&self, id: EdgeId, at_end: bool) -> Option<[f64; 3]> {
        let edge = self.edge(id);
        let placement = self.panels[id.panel].placement()?;
        Some(placement.point(if at_end { edge.end } else { edge.start }))
    }
}

/// Returns the edges of `panel`, the panel with the number `number`, whose names are `leg`; `None`
/// if one does not exist.
fn leg_ids(panel: &Panel, number: usize, leg: &[String]) -> Option<Vec<EdgeId>> {
    leg.iter()
        .map(|name| {
            let edge = panel.edges().position(|edge| edge.name == *name)?;
            Some(EdgeId { panel: number, edge })
        })
        .collect()
}

/// Returns the distance between the points `p` and `q` of space, in m.
fn distance_in_space(p: [f64; 3], q: [f64; 3]) -> f64 {
    distance([p[0], p[1]], [q[0], q[1]]).hypot(p[2] - q[2])
}
