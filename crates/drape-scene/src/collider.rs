use std::path::Path;

use drape_collide::{Body, Mesh, Pose, Shape};

use crate::course::Course;
use crate::file::{MeshMotionFile, MotionFile, SceneFile};
use crate::placement::turned;
use crate::reader::Reader;
use crate::shapes::{Shapes, ShapesError};
use crate::track::turn;

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
    motion: Option<&'a MotionFile>,
}

/// A body with what the file says beyond its form and place.
pub(crate) struct Moving {
    pub(crate) body: Body,
    /// Its coefficient of friction; the fabric's if missing.
    pub(crate) friction: Option<f64>,
    /// Its way; none if it stays.
    pub(crate) course: Option<Course>,
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

    /// The bodies, with the friction and the way of each where the file gives them.
    pub(crate) fn bodies(&mut self, file: &SceneFile, folder: &Path, unit: f64) -> Vec<Moving> {
        let colliders = &file.collider;
        let mut bodies = Vec::new();
        let mut add = |reader: &mut Self, (kind, index): (&str, usize), parts: Parts<'_>| {
            let name = parts.name.cloned().unwrap_or_else(|| format!("{kind} {}", index + 1));
            let center = parts.center.map(|x| x * unit);
            let key = format!("collider.{kind}[{index}].motion");
            let motion = parts.motion;
            let track = motion.and_then(|motion| reader.track(&key, motion, (center, unit)));
            let body = Body::new(name, parts.shape, turn(Pose::new(center), parts.turn));
            let course = track.map(Course::Rigid);
            bodies.push(Moving { body, friction: parts.friction, course });
        };
        for (index, s) in colliders.sphere.iter().enumerate() {
            let shape = Shape::Sphere { radius: s.radius * unit };
            let (name, friction, motion) = (s.name.as_ref(), s.friction, s.motion.as_ref());
            let (center, turn) = (s.center, [0.0; 3]);
            add(self, ("sphere", index), Parts { name, shape, center, turn, friction, motion });
        }
        for (index, b) in colliders.boxes.iter().enumerate() {
            let half_extents = b.size.map(|side| 0.5 * side * unit);
            let shape = Shape::Box { half_extents, edge_radius: b.edge_radius * unit };
            let (name, friction, motion) = (b.name.as_ref(), b.friction, b.motion.as_ref());
            let (center, turn) = (b.center, b.turn);
            add(self, ("box", index), Parts { name, shape, center, turn, friction, motion });
        }
        for (index, c) in colliders.cylinder.iter().enumerate() {
            let shape = Shape::Cylinder {
                radius: c.radius * unit,
                half_height: 0.5 * c.height * unit,
                edge_radius: c.edge_radius * unit,
            };
            let (name, friction, motion) = (c.name.as_ref(), c.friction, c.motion.as_ref());
            let (center, turn) = (c.center, c.turn);
            add(self, ("cylinder", index), Parts { name, shape, center, turn, friction, motion });
        }
        for (index, p) in colliders.plane.iter().enumerate() {
            let (name, shape, friction) = (p.name.as_ref(), Shape::Plane, p.friction);
            let (center, turn, motion) = (p.center, p.turn, p.motion.as_ref());
            add(self, ("plane", index), Parts { name, shape, center, turn, friction, motion });
        }
        for (index, m) in colliders.mesh.iter().enumerate() {
            if m.frames.is_some() || m.point_cache().is_some() {
                continue;
            }
            match Mesh::load(folder.join(&m.file), m.scale.unwrap_or(unit)) {
                Ok(mesh) => {
                    self.size(index, &mesh);
                    let (name, shape) = (m.name.as_ref(), Shape::Mesh(mesh));
                    let (center, turn, friction) = (m.center, m.turn, m.friction);
                    let motion = match &m.motion {
                        Some(MeshMotionFile::Keys(motion)) => Some(motion),
                        _ => None,
                    };
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
        for index in 0..colliders.mesh.len() {
            bodies.extend(self.changing(file, (index, folder), unit));
        }
        bodies
    }

    /// A body that changes its shape, if the mesh of this number is one.
    fn changing(
        &mut self,
        file: &SceneFile,
        (index, folder): (usize, &Path),
        unit: f64,
    ) -> Option<Moving> {
        let m = &file.collider.mesh[index];
        let key = match (&m.frames, m.point_cache()) {
            (Some(_), _) => "frames",
            (None, Some(_)) => "motion",
            (None, None) => {
                for (key, given) in [("rate", m.rate), ("start", m.start)] {
                    if given.is_some() {
                        let help = "it belongs to motion = \"….pc2\" or frames = \"…_*.obj\"";
                        let message = "the body has no frames".to_owned();
                        self.fail(&format!("collider.mesh[{index}].{key}"), message, help);
                    }
                }
                return None;
            }
        };
        let key = format!("collider.mesh[{index}].{key}");
        let Some(rate) = m.rate else {
            let help = "add rate = 24, or how many frames a second has";
            self.fail(&key, "the motion has no rate".to_owned(), help);
            return None;
        };
        let help = "frames per second; 24 is usual";
        let sound = self.within(&format!("collider.mesh[{index}].rate"), rate, (1e-3, 1e5), help);
        let start = m.start.unwrap_or(0.0);
        let help = "when the first frame is left, in s";
        let key_of_start = format!("collider.mesh[{index}].start");
        if !self.within(&key_of_start, start, (0.0, 1e6), help) || !sound {
            return None;
        }
        if !file.keeps_apart() {
            let help = "it needs contact.surfaces = true, which is the default";
            let message = "only surfaces meet a body that changes its shape".to_owned();
            self.fail(&key, message, help);
            return None;
        }
        let scale = m.scale.unwrap_or(unit);
        let place = |point: [f64; 3]| {
            let arm = turned(point.map(|x| scale * x), m.turn);
            [0, 1, 2].map(|axis| m.center[axis] * unit + arm[axis])
        };
        match Shapes::read(m, folder, (rate, start), place) {
            Ok((mesh, shapes)) => {
                self.size(index, &mesh);
                let name = m.name.clone().unwrap_or_else(|| format!("mesh {}", index + 1));
                let body = Body::new(name, Shape::Mesh(mesh), Pose::default());
                let course = Some(Course::Shapes(shapes));
                Some(Moving { body, friction: m.friction, course })
            }
            Err(ShapesError::File(error)) => {
                self.mistakes.push(self.document.at(&key, error.to_string()));
                None
            }
            Err(ShapesError::Fit(message)) => {
                let help = "export the body and its motion anew, with the same vertices";
                self.fail(&key, message, help);
                None
            }
        }
    }

    /// No body may pass the particles by in one step: the cloth could not follow it.
    pub(crate) fn speeds(&mut self, bodies: &[Moving], (step, spacing): (f64, f64)) {
        for Moving { body, course, .. } in bodies {
            // The far corners of a floor are no bodies.
            let (Some(course), false) = (course, matches!(body.shape, Shape::Plane)) else {
                continue;
            };
            let Ok(outline) = body.triangulate() else { continue };
            let speed = course.speed_max(&outline.vertices);
            if !(speed * step <= spacing) {
                let message = format!(
                    "the body \"{}\" moves at {speed:.3} m/s, {:.2} mm in a step, and particles are {:.2} mm apart",
                    body.name,
                    1e3 * speed * step,
                    1e3 * spacing
                );
                let longest = spacing / speed;
                let help = format!(
                    "cloth follows a body by a spacing in a step at most: give time.step = {longest:.1e} or less, slow the \
                     body, or let only particles meet it with contact.surfaces = false"
                );
                self.fail("time.step", message, &help);
            }
        }
    }
}
