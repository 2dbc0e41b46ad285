use std::path::Path;

use drape_collide::{Body, Mesh, Pose, Settings, Shape};

use crate::file::SceneFile;
use crate::reader::Reader;

/// What all bodies have in common.
struct Parts<'a> {
    name: Option<&'a String>,
    shape: Shape,
    center: [f64; 3],
    turn: [f64; 3],
    friction: Option<f64>,
}

impl Reader<'_> {
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

    pub(crate) fn bodies(
        &mut self,
        file: &SceneFile,
        folder: &Path,
        unit: f64,
    ) -> Vec<(Body, Option<f64>)> {
        let colliders = &file.collider;
        let mut bodies = Vec::new();
        let mut add = |kind: &str, index: usize, parts: Parts<'_>| {
            let name = parts.name.cloned().unwrap_or_else(|| format!("{kind} {}", index + 1));
            let pose = pose(parts.center.map(|x| x * unit), parts.turn);
            bodies.push((Body::new(name, parts.shape, pose), parts.friction));
        };
        for (index, s) in colliders.sphere.iter().enumerate() {
            let shape = Shape::Sphere { radius: s.radius * unit };
            let (name, friction) = (s.name.as_ref(), s.friction);
            add("sphere", index, Parts { name, shape, center: s.center, turn: [0.0; 3], friction });
        }
        for (index, b) in colliders.boxes.iter().enumerate() {
            let half_extents = b.size.map(|side| 0.5 * side * unit);
            let shape = Shape::Box { half_extents, edge_radius: b.edge_radius * unit };
            let (name, friction) = (b.name.as_ref(), b.friction);
            add("box", index, Parts { name, shape, center: b.center, turn: b.turn, friction });
        }
        for (index, c) in colliders.cylinder.iter().enumerate() {
            let shape = Shape::Cylinder {
                radius: c.radius * unit,
                half_height: 0.5 * c.height * unit,
                edge_radius: c.edge_radius * unit,
            };
            let (name, friction) = (c.name.as_ref(), c.friction);
            add("cylinder", index, Parts { name, shape, center: c.center, turn: c.turn, friction });
        }
        for (index, p) in colliders.plane.iter().enumerate() {
            let (name, shape, friction) = (p.name.as_ref(), Shape::Plane, p.friction);
            add("plane", index, Parts { name, shape, center: p.center, turn: p.turn, friction });
        }
        for (index, m) in colliders.mesh.iter().enumerate() {
            match Mesh::load(folder.join(&m.file), m.scale.unwrap_or(unit)) {
                Ok(mesh) => {
                    let (name, shape) = (m.name.as_ref(), Shape::Mesh(mesh));
                    let friction = m.friction;
                    add(
                        "mesh",
                        index,
                        Parts { name, shape, center: m.center, turn: m.turn, friction },
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

/// The pose that turns as a panel does.
fn pose(center: [f64; 3], turn: [f64; 3]) -> Pose {
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let turns = axes.into_iter().zip(turn).filter(|(_, angle)| *angle != 0.0);
    turns.fold(Pose::new(center), |pose, (axis, angle)| pose.turned(axis, angle.to_radians()))
}
