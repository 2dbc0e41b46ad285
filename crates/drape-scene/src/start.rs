use drape_collide::{ParticleContact, SurfaceContact};

use crate::panel::Panel;
use crate::reader::Reader;
use crate::scene::Scene;
use crate::tangle::Overlap;

impl Scene {
    /// The number of the garment that a panel is of.
    pub(crate) fn garment_of(&self, panel: &Panel) -> Option<usize> {
        self.garments.iter().position(|(_, own)| own.contains(&panel.first))
    }

    /// Whether two triangles are of panels of different garments.
    pub(crate) fn is_of_two_garments(&self, overlap: &Overlap) -> bool {
        let garment =
            |name: &String| self.garment_of(self.panels.iter().find(|panel| panel.name == *name)?);
        let [one, other] = &overlap.parts;
        matches!((garment(one), garment(other)), (Some(one), Some(other)) if one != other)
    }
}

impl Reader<'_> {
    pub(crate) fn start_is_free(&mut self, contact: &ParticleContact, positions: &[f64]) {
        let summary = contact.summary(positions);
        if summary.inside > 0 {
            let body = summary.nearest.map_or("", |nearest| &contact.bodies()[nearest.body].name);
            let message = format!(
                "{} particles start inside a body (deepest {:.4} m, in {body})",
                summary.inside, -summary.min_distance
            );
            let help = "move or turn the panel so that it starts outside, or let bodies grow with contact.inflate";
            self.fail("panel", message, help);
        }
    }

    /// Of panels that cross no body, one particle tells whether they are in it.
    pub(crate) fn start_is_outside(&mut self, contact: &SurfaceContact, scene: &Scene) {
        for panel in &scene.panels {
            if contact.is_inside_body(panel.first, &scene.positions) {
                let message = format!("all of \"{}\" starts inside a body", panel.name);
                self.fail("panel", message, "move or turn the panel so that it starts outside");
            }
        }
    }
}
