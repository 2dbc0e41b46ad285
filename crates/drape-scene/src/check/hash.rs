//! Hash of a scene and all that it names.

use drape_collide::Shape;
use drape_input::Document;

use crate::scene::MovingBody;
use crate::scene::garment::Sewing;
use crate::scene::material::Material;
use crate::scene::motion::BodyMotion;
use crate::scene::panel::Panel;

/// Content of a scene that makes its hash.
pub(crate) struct Content<'a> {
    pub(crate) document: &'a Document,
    pub(crate) materials: &'a [Material],
    pub(crate) positions: &'a [f64],
    pub(crate) bodies: &'a [MovingBody],
    pub(crate) panels: &'a [Panel],
    pub(crate) sewing: Option<&'a Sewing>,
}

impl Content<'_> {
    /// Returns the hash.
    pub(crate) fn hash(&self) -> String {
        let mut hasher = blake3::Hasher::new();
        hasher.update(self.document.text().as_bytes());
        for material in self.materials {
            hasher.update(material.fabric.to_toml().as_bytes());
        }
        let mut number = |value: f64| _ = hasher.update(&value.to_le_bytes());
        self.positions.iter().for_each(|&x| number(x));
        for MovingBody { body, motion, .. } in self.bodies {
            if let Shape::Mesh(mesh) = &body.shape {
                mesh.vertices().iter().flatten().for_each(|&x| number(x));
                mesh.triangles().iter().flatten().for_each(|&corner| number(f64::from(corner)));
            }
            if let Some(BodyMotion::Shapes(shapes)) = motion {
                shapes.numbers().for_each(&mut number);
            }
        }
        for fold in self.panels.iter().flat_map(|panel| panel.lattice.folds()) {
            fold.ends.iter().flatten().chain([&fold.angle]).for_each(|&x| number(x));
        }
        let seams = self.sewing.iter().flat_map(|sewing| &sewing.seams);
        seams.filter(|seam| seam.rest_angle != 0.0).for_each(|seam| number(seam.rest_angle));
        hasher.finalize().to_hex().to_string()
    }
}
