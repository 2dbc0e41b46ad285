//! Descriptions of open seams: the seam, its panels and the position of its widest gap.

use crate::measure::garment_parts::GarmentParts;
use crate::measure::vector::point_of;
use crate::world::closing_springs::WidestGap;

/// Widest gap at which the sides of an open seam are sewn, as a fraction of the spacing. The gap is
/// smaller than the resolution of the cloth.
pub(crate) const STRETCHED_MAX: f64 = 0.1;

/// Widest gap of the seams of a garment.
pub(crate) struct OpenSeam<'a> {
    name: &'a str,
    /// Names of the panels on both sides.
    panels: [&'a str; 2],
    /// Position of the gap, in m.
    pub(crate) place: [f64; 3],
    gap: WidestGap,
}

impl<'a> OpenSeam<'a> {
    /// Returns the open seam with the gap `gap` and the particles at `positions`, in m.
    pub(crate) fn new(parts: &'a GarmentParts, gap: WidestGap, positions: &[f64]) -> Self {
        Self {
            name: parts.seam_of(gap.ends),
            panels: gap.ends.map(|end| parts.panel_of(end as usize)),
            place: point_of(positions, gap.ends[0]),
            gap,
        }
    }

    /// Describes the seam and the position and width of its gap.
    pub(crate) fn describe(&self) -> String {
        let Self { name, panels: [first, second], place: [x, y, z], gap } = self;
        format!(
            "the seam \"{name}\" between \"{first}\" and \"{second}\" is still open by {:.2} mm near \
             ({x:.4}, {y:.4}, {z:.4}) m",
            1e3 * gap.width
        )
    }

    /// Warns that other cloth is between the sides of the seam, and that particles were displaced
    /// there by up to `displacement`, in m.
    pub(crate) fn warn_untangled(&self, displacement: f64) -> String {
        let place = self.describe();
        format!(
            "{place}; other cloth is between its sides, so particles there are displaced by up to {:.2} mm, to where \
             nothing intersects",
            1e3 * displacement
        )
    }

    /// Warns that the seam is sewn although it is open. Particles are `spacing` apart, in m, and
    /// the springs pull with `force`, in N.
    pub(crate) fn warn(&self, spacing: f64, force: f64) -> String {
        let Self { name, panels: [first, second], place: [x, y, z], gap } = self;
        format!(
            "the seam \"{name}\" between \"{first}\" and \"{second}\" is sewn stretched: its cloth is too short to go round \
             the body near ({x:.4}, {y:.4}, {z:.4}) m in straight pieces of {:.0} mm, {:.2} mm were missing against {force:.0} N \
             at a stitch; widen the panels there, or choose a smaller spacing",
            1e3 * spacing,
            1e3 * gap.width
        )
    }
}
