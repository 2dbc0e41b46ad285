use std::ops::Range;

use drape_cloth::Cloth;
use drape_collide::Contact;

use crate::panel::Panel;
use crate::reader::Reader;
use crate::surfaces::Surfaces;
use crate::tangle::{Overlap, overlaps};

/// Pairs that the message of a start that is refused tells of.
const OVERLAPS_TOLD: usize = 5;

/// Where everything is when the simulation begins.
pub(crate) struct Start<'a> {
    pub(crate) panels: &'a [Panel],
    /// Names of the garments, and which particles are theirs.
    pub(crate) garments: &'a [(String, Range<usize>)],
    pub(crate) cloth: &'a Cloth,
    /// Three numbers per particle, in m.
    pub(crate) positions: &'a [f64],
}

impl Start<'_> {
    /// The number of the garment that a panel is of.
    pub(crate) fn garment(&self, panel: &Panel) -> Option<usize> {
        self.garments.iter().position(|(_, own)| own.contains(&panel.first))
    }

    /// Whether two triangles are of panels of different garments.
    fn is_of_two_garments(&self, overlap: &Overlap) -> bool {
        let garment =
            |name: &String| self.garment(self.panels.iter().find(|panel| panel.name == *name)?);
        let [one, other] = &overlap.parts;
        matches!((garment(one), garment(other)), (Some(one), Some(other)) if one != other)
    }
}

impl Reader<'_> {
    /// The start must keep what every step keeps; if not, the pairs that do not, and how many there are.
    pub(crate) fn tangle(
        &mut self,
        surfaces: &mut Surfaces,
        start: &Start<'_>,
    ) -> Option<(Vec<Overlap>, usize)> {
        let positions = start.positions;
        let contact = &mut surfaces.contact;
        let crossings = contact.crossings(positions).map(|found| found.len());
        let fault = match (crossings, contact.survey(positions)) {
            (Ok(0), Ok(near)) if near.min_ratio < 1.0 => {
                let [distance, kept] = [near.min_distance, near.min_distance / near.min_ratio];
                format!("surfaces start {distance:.3e} m apart, where {kept:.3e} m is kept")
            }
            (Ok(0), Ok(_)) => return None,
            (Ok(count), _) if count > 0 => format!("surfaces cross in {count} places at the start"),
            (Err(error), _) | (_, Err(error)) => {
                self.fail("panel", error.to_string(), "move or turn panels and bodies apart");
                return None;
            }
            (Ok(_), Ok(_)) => return None,
        };
        let (overlaps, total) = overlaps(contact, positions, &surfaces.names);
        let told = overlaps.iter().take(OVERLAPS_TOLD).map(|overlap| {
            let ([a, b], [x, y, z]) = (&overlap.parts, overlap.place);
            format!("\"{a}\" and \"{b}\" near ({x:.4}, {y:.4}, {z:.4}) m")
        });
        let told: Vec<String> = told.collect();
        let more = match total.saturating_sub(told.len()) {
            0 => String::new(),
            more => format!("; and {more} more pairs of triangles"),
        };
        let fault = format!("{fault}: {}{more}", told.join("; "));
        let help = if overlaps.iter().any(|overlap| start.is_of_two_garments(overlap)) {
            "give the garment that is worn outside a higher layer, or move or turn panels apart"
        } else {
            "move or turn panels and bodies apart"
        };
        self.fail("panel", fault, help);
        Some((overlaps, total))
    }

    pub(crate) fn start_is_free(&mut self, contact: &Contact, positions: &[f64]) {
        let survey = contact.survey(positions);
        if survey.inside > 0 {
            let body = survey.nearest.map_or("", |(_, body)| &contact.bodies()[body].name);
            let message = format!(
                "{} particles start inside a body (deepest {:.4} m, in {body})",
                survey.inside, -survey.min_distance
            );
            let help = "move or turn the panel so that it starts outside, or let bodies grow with contact.inflate";
            self.fail("panel", message, help);
        }
    }

    /// Of panels that cross no body, one particle tells whether they are in it.
    pub(crate) fn start_is_outside(&mut self, surfaces: &Surfaces, start: &Start<'_>) {
        for panel in start.panels {
            if surfaces.contact.is_inside(panel.first, start.positions) {
                let message = format!("all of \"{}\" starts inside a body", panel.name);
                self.fail("panel", message, "move or turn the panel so that it starts outside");
            }
        }
    }
}
