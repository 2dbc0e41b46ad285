use std::path::Path;

use drape_collide::{Body, Mesh, Pose, Settings, Shape};

use crate::file::{MotionFile, SceneFile};
use crate::reader::Reader;
use crate::track::{Track, turn};

/// The shortest and the longest body of a mesh, in m. A figure of 1.7 m that was read in another unit is 1.7 mm, 170 m
/// or 1.7 km long.
const SIZE_MIN: f64 = 2e-3;
const SIZE_MAX: f64 = 100.0;

/// What all bodies have in common.
struct Parts<'a> {
    name: Option<&'a String>,
    shape: Shape,
    center: [f64; 3],
    turn: [f64; 3],
    friction: Option<f64>,
    motion: &'a Option<MotionFile>,
}

/// A body with what the file says beyond its form and place.
pub(crate) struct Moving {
    pub(crate) body: Body,
    /// Its coefficient of friction; the fabric's if missing.
    pub(crate) friction: Option<f64>,
    /// Its way; none if it stays.
    pub(crate) track: Option<Track>,
}

impl Reader<'_> {
    /// A body that is no size for cloth has another unit than the scene thinks.
    fn size(&mut self, index: usize, mesh: &Mesh) {
        let vertices = mesh.vertices();
        let extent = |axis: usize| {
            let values = || vertices.iter().map(|vertex| vertex[axis]);
            values().fold(f64::MIN, f64::max) - values().fold(f64::MAX, f64::min)
        };
        let longest = (0..3).map(extent).fold(0.0, f64::max);
        if !(SIZE_MIN..=SIZE_MAX).contains(&longest) {
            let message = format!("the body is {longest:.4} m long");
            let help = "is the unit right? scale = 0.001 reads a file in millimetres, 0.01 one in centimetres, 1 one in \
                        metres; bodies are 2 mm to 100 m long";
            self.fail(&format!("collider.mesh[{index}].scale"), message, help);
        }
    }

    pub(crate) fn contact_settings(&mut self, file: &SceneFile, unit: f64) -> Settings {
        let mut settings = Settings::default();
        if let Some(offset) = file.contact.offset {
            settings.offset = offset * unit;
            let help = "the distance at which contact begins; 1 mm is usual";
            self.within("contact.offset", settings.offset, (1e-5, 0.1), help);
        }
        if let Some(stiffness) = file.contact.stiffness {
            settings.stiffness = stiffness;
            self.within("contact.stiffness", stiffness, (1.0, 1e12), "in N/m³");
        }
        if let Some(speed) = file.contact.slip_speed {
            settings.slip_speed = speed;
            self.within("contact.slip_speed", speed, (1e-9, 1.0), "in m/s; 0.001 is usual");
        }
        settings
    }

    /// The bodies, with the friction and the way of each where the file gives them.
    pub(crate) fn bodies(&mut self, file: &SceneFile, folder: &Path, unit: f64) -> Vec<Moving> {
        let colliders = &file.collider;
        let mut bodies = Vec::new();
        let mut add = |reader: &mut Self, (kind, index): (&str, usize), parts: Parts<'_>| {
            let name = parts.name.cloned().unwrap_or_else(|| format!("{kind} {}", index + 1));
            let center = parts.center.map(|x| x * unit);
            let key = format!("collider.{kind}[{index}].motion");
            let motion = parts.motion.as_ref();
            let track = motion.and_then(|motion| reader.track(&key, motion, (center, unit)));
            let body = Body::new(name, parts.shape, turn(Pose::new(center), parts.turn));
            bodies.push(Moving { body, friction: parts.friction, track });
        };
        for (index, s) in colliders.sphere.iter().enumerate() {
            let shape = Shape::Sphere { radius: s.radius * unit };
            let (name, friction, motion) = (s.name.as_ref(), s.friction, &s.motion);
            let (center, turn) = (s.center, [0.0; 3]);
            add(self, ("sphere", index), Parts { name, shape, center, turn, friction, motion });
        }
        for (index, b) in colliders.boxes.iter().enumerate() {
            let half_extents = b.size.map(|side| 0.5 * side * unit);
            let shape = Shape::Box { half_extents, edge_radius: b.edge_radius * unit };
            let (name, friction, motion) = (b.name.as_ref(), b.friction, &b.motion);
            let (center, turn) = (b.center, b.turn);
            add(self, ("box", index), Parts { name, shape, center, turn, friction, motion });
        }
        for (index, c) in colliders.cylinder.iter().enumerate() {
            let shape = Shape::Cylinder {
                radius: c.radius * unit,
                half_height: 0.5 * c.height * unit,
                edge_radius: c.edge_radius * unit,
            };
            let (name, friction, motion) = (c.name.as_ref(), c.friction, &c.motion);
            let (center, turn) = (c.center, c.turn);
            add(self, ("cylinder", index), Parts { name, shape, center, turn, friction, motion });
        }
        for (index, p) in colliders.plane.iter().enumerate() {
            let (name, shape, friction) = (p.name.as_ref(), Shape::Plane, p.friction);
            let (center, turn, motion) = (p.center, p.turn, &p.motion);
            add(self, ("plane", index), Parts { name, shape, center, turn, friction, motion });
        }
        for (index, m) in colliders.mesh.iter().enumerate() {
            match Mesh::load(folder.join(&m.file), m.scale.unwrap_or(unit)) {
                Ok(mesh) => {
                    self.size(index, &mesh);
                    let (name, shape) = (m.name.as_ref(), Shape::Mesh(mesh));
                    let (center, turn, friction) = (m.center, m.turn, m.friction);
                    let motion = &m.motion;
                    add(
                        self,
                        ("mesh", index),
                        Parts { name, shape, center, turn, friction, motion },
                    );
                }
                Err(error) => {
                    let key = format!("collider.mesh[{index}].file");
                    self.mistakes.push(self.document.at(&key, error.to_string()));
                }
            }
        }
        bodies
    }
}
