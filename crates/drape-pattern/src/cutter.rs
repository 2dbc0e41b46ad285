use crate::boundary::{Boundary, Sampled, SeamNodes};
use crate::crossing::crossing;
use crate::cut::{Cut, CutPattern, Turn};
use crate::edge::difference;
use crate::mistake::{Error, Mistake};
use crate::panel::Panel;
use crate::pattern::Pattern;
use crate::rim::Rim;

/// Spacing when none is chosen, in m.
const SPACING: f64 = 0.01;

/// Shortest and longest spacing, in m.
const SPACINGS: std::ops::RangeInclusive<f64> = 1e-5..=10.0;

/// Most places of a panel's lattice.
const PLACES_MAX: f64 = 4e6;

/// Cuts patterns into particles at a spacing.
///
/// Outlines are sampled at equal arcs of about the spacing between the ends of their edges, with the same
/// number on both sides of a seam. Inside, a regular grid along the grain keeps 0.6 spacings clear of the
/// outline, and a constrained Delaunay triangulation fills the rim between them.
#[derive(Debug, Clone, PartialEq)]
pub struct Cutter {
    /// Distance between particles, in m.
    pub spacing: f64,
}

impl Default for Cutter {
    fn default() -> Self {
        Self { spacing: SPACING }
    }
}

impl Cutter {
    /// A cutter of a spacing in m.
    #[must_use]
    pub fn new(spacing: f64) -> Self {
        Self { spacing }
    }

    /// Cuts all panels of a pattern.
    ///
    /// # Errors
    /// Edges too short for the spacing, panels too narrow or too large for it; all of them are listed.
    pub fn cut(&self, pattern: &Pattern) -> Result<CutPattern, Error> {
        let spacing = self.spacing;
        if !SPACINGS.contains(&spacing) {
            return Err(Error::Pattern(vec![Mistake::Spacing { spacing }]));
        }
        let sampled = Sampled::new(pattern, spacing).map_err(Error::Pattern)?;
        let mut notes = sampled.notes;
        let mut panels: Vec<Cut> = Vec::new();
        let mut mistakes = Vec::new();
        // The nodes of a boundary are numbered anew in a grid.
        let mut seams = sampled.seams;
        for (number, boundary) in sampled.boundaries.into_iter().enumerate() {
            match self.cut_panel(&pattern.panels()[number], boundary) {
                Ok(cut) => {
                    let nodes = seams.iter_mut().flat_map(SeamNodes::nodes_mut);
                    for id in nodes.filter(|id| id.panel == number) {
                        id.node = cut.outline[id.node as usize];
                    }
                    notes.extend(cut.thin(spacing));
                    panels.push(cut);
                }
                Err(mistake) => mistakes.push(mistake),
            }
        }
        if !mistakes.is_empty() {
            return Err(Error::Pattern(mistakes));
        }
        Ok(CutPattern { spacing, panels, seams, notes })
    }

    fn cut_panel(&self, panel: &Panel, boundary: Boundary) -> Result<Cut, Mistake> {
        let spacing = self.spacing;
        let name = || panel.name().to_owned();
        let turn = Turn::new(panel.grain());
        let mut polygon: Vec<[f64; 2]> = boundary.nodes.iter().map(|&p| turn.back(p)).collect();
        let low = [0, 1].map(|k| polygon.iter().map(|p| p[k]).fold(f64::MAX, f64::min));
        for node in &mut polygon {
            *node = difference(*node, low).map(|x| x / spacing);
        }
        let places = [0, 1].map(|k| polygon.iter().map(|p| p[k] + 1.0).fold(1.0, f64::max));
        if places[0] * places[1] > PLACES_MAX {
            return Err(Mistake::TooMany { panel: name(), nodes: places[0] * places[1], spacing });
        }
        let twice_area = |k: usize| {
            let (a, b) = (polygon[k], polygon[(k + 1) % polygon.len()]);
            a[0] * b[1] - a[1] * b[0]
        };
        let area: f64 = (0..polygon.len()).map(twice_area).sum();
        let crossed = crossing(&polygon).map(|[first, _]| first);
        if let Some(first) = crossed.or((area <= 0.0).then_some(0)) {
            return Err(Mistake::Narrow { panel: name(), at: boundary.nodes[first], spacing });
        }
        if let Some(grid) = Cut::of_grid(&boundary, turn, spacing) {
            return Ok(Cut { panel: name(), ..grid });
        }
        let rim = Rim::new(&polygon).ok_or_else(|| Mistake::Rim { panel: name(), spacing })?;
        Ok(Cut { panel: name(), ..Cut::of_rim(boundary, (&rim, turn), (low, spacing)) })
    }
}
