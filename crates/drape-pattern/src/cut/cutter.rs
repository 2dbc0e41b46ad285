//! Cutter: samples the outlines of a pattern, cuts its panels and renumbers the nodes of its seams.

use super::cut_pattern::CutPattern;
use super::panel_cut::{Cut, GrainFrame, RimUnits};
use super::region::Region;
use super::rim::Rim;
use super::sampling::{SampledPanel, SampledPattern};
use super::seam_nodes::SeamNodes;
use crate::edge::difference;
use crate::error::Error;
use crate::mistake::Mistake;
use crate::panel::Panel;
use crate::pattern::Pattern;

/// Default spacing, in m.
const SPACING: f64 = 0.01;

/// Shortest and longest spacing, in m.
const SPACINGS: std::ops::RangeInclusive<f64> = 1e-5..=10.0;

/// Largest number of grid points of a panel.
const MOST_POINTS: f64 = 4e6;

/// Cutter of patterns into particles at a spacing.
///
/// Outlines are sampled at equal arcs of about the spacing between the ends of their edges, with
/// the same number of arcs on both sides of a seam. Inside, a regular grid along the grain keeps
/// 0.6 spacings clear of the outline. A constrained Delaunay triangulation fills the rim between
/// grid and outline.
///
/// ```
/// use drape_pattern::{Cutter, Edge, Panel, Pattern};
///
/// let corners = [[0.0, 0.0], [0.2, 0.0], [0.2, 0.5], [0.0, 0.5]];
/// let edge = |k: usize| Edge::line(k.to_string(), corners[k], corners[(k + 1) % 4]);
/// let panel = Panel::new("strip", (0..4).map(edge).collect()).expect("a rectangle is simple");
/// let pattern = Pattern::new(vec![panel], vec![]).expect("there is nothing to sew");
/// let cut = Cutter::new(0.01).cut(&pattern)?;
/// assert_eq!((cut.panels[0].quads.len(), cut.panels[0].triangles.len()), (20 * 50, 0));
/// # Ok::<(), drape_pattern::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Cutter {
    /// Distance of the particles, in m.
    pub spacing: f64,
}

impl Default for Cutter {
    fn default() -> Self {
        Self { spacing: SPACING }
    }
}

impl Cutter {
    /// Returns a cutter with the spacing `spacing`, in m.
    #[must_use]
    pub fn new(spacing: f64) -> Self {
        Self { spacing }
    }

    /// Returns all panels of `pattern`, cut, with the nodes of its seams.
    ///
    /// # Errors
    /// Edges too short for the spacing, and panels too narrow or too large for it. All are listed.
    pub fn cut(&self, pattern: &Pattern) -> Result<CutPattern, Error> {
        let spacing = self.spacing;
        if !SPACINGS.contains(&spacing) {
            return Err(Error::Pattern(vec![Mistake::Spacing { spacing }]));
        }

        let sampled = SampledPattern::new(pattern, spacing).map_err(Error::Pattern)?;
        let mut notes = sampled.notes;
        let mut panels: Vec<Cut> = Vec::new();
        let mut mistakes = Vec::new();
        let mut seams = sampled.seams;
        for (number, outline) in sampled.panels.into_iter().enumerate() {
            match self.cut_panel(&pattern.panels()[number], outline) {
                Ok(cut) => {
                    notes.extend(cut.thin_part(spacing));
                    panels.push(cut);
                }
                Err(mistake) => mistakes.push(mistake),
            }
        }
        if !mistakes.is_empty() {
            return Err(Error::Pattern(mistakes));
        }

        // A rectangle, which has no holes, numbers the nodes of its outline anew.
        for id in seams.iter_mut().flat_map(SeamNodes::nodes_mut) {
            let cut = &panels[id.panel];
            if cut.holes.is_empty() {
                id.node = cut.outline[id.node as usize];
            }
        }
        Ok(CutPattern { spacing, panels, seams, notes })
    }

    /// Returns the cut of `panel`, whose closed lines are sampled in `outline`.
    fn cut_panel(&self, panel: &Panel, outline: SampledPanel) -> Result<Cut, Mistake> {
        let spacing = self.spacing;
        let name = panel.name().to_owned();

        // The grid has its origin at the lowest corner along the grain, and the spacing as its
        // unit.
        let grain = GrainFrame::new(panel.grain());
        let mut polygon: Vec<[f64; 2]> = outline.nodes.iter().map(|&p| grain.to_grain(p)).collect();
        let low = [0, 1].map(|k| polygon.iter().map(|p| p[k]).fold(f64::MAX, f64::min));
        for node in &mut polygon {
            *node = difference(*node, low).map(|x| x / spacing);
        }
        let size = [0, 1].map(|k| polygon.iter().map(|p| p[k] + 1.0).fold(1.0, f64::max));
        if size[0] * size[1] > MOST_POINTS {
            return Err(Mistake::TooMany { panel: name, nodes: size[0] * size[1], spacing });
        }

        // At a coarse spacing, chords of a sound outline may cross.
        let region = Region::new(polygon, outline.lines.clone());
        let is_flat = region.twice_area() <= 0.0;
        if let Some(first) = region.intersection().or(is_flat.then_some(0)) {
            return Err(Mistake::Narrow { panel: name, at: outline.nodes[first], spacing });
        }

        if let Some(rectangle) = Cut::from_rectangle(&outline, grain, spacing) {
            return Ok(Cut { panel: name, ..rectangle });
        }
        let Some(rim) = Rim::new(&region) else {
            return Err(Mistake::Rim { panel: name, spacing });
        };
        let units = RimUnits { origin: low, spacing };
        Ok(Cut { panel: name, ..Cut::from_rim(outline, &rim, grain, units) })
    }
}
