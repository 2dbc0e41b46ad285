//! Open seams in words: the seam, its panels and the place of its widest gap.

use crate::measure::garment_parts::GarmentParts;
use crate::world::closing_springs::WidestGap;

/// Widest gap at which the sides of a seam are sewn although they do not meet, as a fraction of the
/// spacing: what is missing is less than the cloth is resolved to.
pub(crate) const STRETCHED_MAX: f64 = 0.1;

/// Widest gap of the seams of a garment.
pub(crate) struct OpenSeam<'a> {
    name: &'a str,
    /// Names of the panels on both sides.
    panels: [&'a str; 2],
    /// Place, in m.
    pub(crate) place: [f64; 3],
    gap: WidestGap,
}

impl<'a> OpenSeam<'a> {
    /// Returns the seam of a gap at some positions.
    pub(crate) fn new(parts: &'a GarmentParts, gap: WidestGap, positions: &[f64]) -> Self {
        let sewn = |particle: u32| {
            let first = 3 * particle as usize;
            [0, 1, 2].map(|axis| positions[first + axis])
        };
        Self {
            name: parts.seam_of(gap.ends),
            panels: gap.ends.map(|end| parts.panel_of(end as usize)),
            place: sewn(gap.ends[0]),
            gap,
        }
    }

    /// Describes where it is open.
    pub(crate) fn describe(&self) -> String {
        let Self { name, panels: [one, other], place: [x, y, z], gap } = self;
        format!(
            "the seam \"{name}\" between \"{one}\" and \"{other}\" is still open by {:.2} mm near \
             ({x:.4}, {y:.4}, {z:.4}) m",
            1e3 * gap.width
        )
    }

    /// Warns that other cloth is between the sides of the seam, and that particles were displaced there by up
    /// to a distance, in m.
    pub(crate) fn warn_untangled(&self, way: f64) -> String {
        let place = self.describe();
        format!(
            "{place}; other cloth is between its sides, so particles there are displaced by up to {:.2} mm, to where \
             nothing intersects",
            1e3 * way
        )
    }

    /// Warns that it is sewn although it is open at a spacing in m, pulled by a force in N.
    pub(crate) fn warn(&self, spacing: f64, force: f64) -> String {
        let Self { name, panels: [one, other], place: [x, y, z], gap } = self;
        format!(
            "the seam \"{name}\" between \"{one}\" and \"{other}\" is sewn stretched: its cloth is too short to go round \
             the body near ({x:.4}, {y:.4}, {z:.4}) m in straight pieces of {:.0} mm, {:.2} mm were missing against {force:.0} N \
             at a stitch; widen the panels there, or choose a smaller spacing",
            1e3 * spacing,
            1e3 * gap.width
        )
    }
}
