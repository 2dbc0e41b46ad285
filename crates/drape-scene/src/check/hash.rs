//! Hash of a scene and all that it names.

use drape_collide::Shape;
use drape_input::Document;

use crate::scene::garment::Sewing;
use crate::scene::material::Material;
use crate::scene::motion::BodyMotion;
use crate::scene::panel::Panel;
use crate::scene::{MovingBody, SourcePart};

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
        hasher.update(self.settings().as_bytes());
        for material in self.materials {
            hasher.update(material.fabric.to_toml().as_bytes());
        }
        let mut number = |value: f64| _ = hasher.update(&value.to_le_bytes());
        self.positions.iter().for_each(|&x| number(x));
        self.bodies.iter().for_each(|body| add_body(body, &mut number));
        for fold in self.panels.iter().flat_map(|panel| panel.lattice.folds()) {
            fold.ends.iter().flatten().chain([&fold.angle]).for_each(|&x| number(x));
        }
        let seams = self.sewing.iter().flat_map(|sewing| &sewing.seams);
        seams.filter(|seam| seam.rest_angle != 0.0).for_each(|seam| number(seam.rest_angle));
        hasher.finalize().to_hex().to_string()
    }

    /// Returns the values that replace values of the text, one in each line.
    fn settings(&self) -> String {
        self.document.settings().iter().map(|setting| format!("\n{setting}")).collect()
    }

    /// Returns the digests of the text, of what is set beside it, of each fabric, of the cloth at
    /// its start and of each body.
    pub(crate) fn parts(&self) -> Vec<SourcePart> {
        let part = |name: String, digest: blake3::Hash| SourcePart { name, digest: digest.into() };
        let mut parts =
            vec![part("the scene".into(), blake3::hash(self.document.text().as_bytes()))];
        if !self.document.settings().is_empty() {
            let digest = blake3::hash(self.settings().as_bytes());
            parts.push(part("what is set beside the scene".into(), digest));
        }
        for Material { name, fabric, .. } in self.materials {
            let digest = blake3::hash(fabric.to_toml().as_bytes());
            parts.push(part(format!("the fabric \"{name}\""), digest));
        }
        let mut hasher = blake3::Hasher::new();
        let mut number = |value: f64| _ = hasher.update(&value.to_le_bytes());
        self.positions.iter().for_each(|&x| number(x));
        let coordinates = self.panels.iter().flat_map(|panel| &panel.lattice.coordinates);
        coordinates.flatten().for_each(|&x| number(x));
        let seams = self.sewing.iter().flat_map(|sewing| &sewing.pairs.pairs);
        seams.flatten().for_each(|&particle| number(f64::from(particle)));
        parts.push(part("the patterns, or where the cloth starts".into(), hasher.finalize()));
        for body in self.bodies {
            let mut hasher = blake3::Hasher::new();
            add_body(body, &mut |value| _ = hasher.update(&value.to_le_bytes()));
            parts.push(part(format!("the body \"{}\"", body.body.name), hasher.finalize()));
        }
        parts
    }
}

/// Calls with the numbers of the files of a body.
fn add_body(MovingBody { body, motion, .. }: &MovingBody, number: &mut impl FnMut(f64)) {
    if let Shape::Mesh(mesh) = &body.shape {
        mesh.vertices().iter().flatten().for_each(|&x| number(x));
        mesh.triangles().iter().flatten().for_each(|&corner| number(f64::from(corner)));
    }
    if let Some(BodyMotion::Shapes(shapes)) = motion {
        shapes.numbers().for_each(number);
    }
}
