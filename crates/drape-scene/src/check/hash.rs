//! Hash of a scene and all that it names.
//!
//! The hash is the digest of the spec and of the content of what the spec names: fabrics, patterns,
//! bodies and their motions. The order of keys, comments and units in a file do not change the
//! hash, and a spec that a program makes has the hash of the file that says the same.

use drape_collide::Shape;

use crate::scene::garment::Sewing;
use crate::scene::material::Material;
use crate::scene::motion::BodyMotion;
use crate::scene::panel::Panel;
use crate::scene::{MovingBody, SourcePart};
use crate::spec::SceneSpec;
use crate::spec::body::MeshMotion;

/// Content of a scene that makes its hash.
pub(crate) struct Content<'a> {
    /// The spec, as [`text`] returns it.
    pub(crate) text: String,
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
        hasher.update(self.text.as_bytes());
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

    /// Returns the digests of the spec, of each fabric, of the cloth at its start and of each
    /// body.
    pub(crate) fn parts(&self) -> Vec<SourcePart> {
        let part = |name: String, digest: blake3::Hash| SourcePart { name, digest: digest.into() };
        let mut parts = vec![part("the scene".into(), blake3::hash(self.text.as_bytes()))];
        for Material { name, fabric, .. } in self.materials {
            let digest = blake3::hash(fabric.to_toml().as_bytes());
            parts.push(part(format!("the fabric \"{name}\""), digest));
        }
        let mut hasher = blake3::Hasher::new();
        let mut number = |value: f64| _ = hasher.update(&value.to_le_bytes());
        self.positions.iter().for_each(|&x| number(x));
        let coordinates = self.panels.iter().flat_map(|panel| panel.lattice.coordinates());
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

/// Returns `spec` as a text without the names of files: their content counts, and what a spec holds
/// itself has no name.
pub(crate) fn text(spec: &SceneSpec) -> String {
    let mut spec = spec.in_metres().without_held();
    for mesh in &mut spec.collider.mesh {
        mesh.frames = None;
        mesh.motion.take_if(|motion| matches!(motion, MeshMotion::File(_)));
    }
    spec.files_mut().into_iter().for_each(|file| file.name.clear());
    spec.text()
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
