//! Bodies of a scene: primitives and meshes, with their motions.

pub(crate) mod mesh_remedy;
mod shape_files;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use drape_collide::{Body, Mesh, Pose, Shape};
use drape_input::{Remedy, excerpt, figure};

use crate::check::checker::Checker;
use crate::check::motion::rigid_motion;
use crate::scene::motion::{BodyMotion, rotate, rotate_pose};
use crate::spec::body::{BoxSpec, CommonKeys, CylinderSpec, MeshSpec, PlaneSpec, SphereSpec};
use crate::spec::file_or::FileOr;

use self::mesh_remedy::{is_repaired, repaired_file};
use self::shape_files::{Sampling, ShapeError, outline, read_shapes};

/// Shortest and longest body of a mesh, in m. A figure of 1.7 m that was read in another unit is
/// 1.7 mm, 170 m or 1.7 km long.
const SIZE_MIN: f64 = 2e-3;
const SIZE_MAX: f64 = 100.0;

/// Largest coordinate of the middle of a body, in m.
const FAR: f64 = 1e4;

/// Remedy for a mesh that is no closed surface and has no file.
const MEND_GIVEN: &str = "a body is one closed surface, each of whose edges has two triangles: mend it where it was \
                          made, such as with trimesh.repair.fill_holes";

/// Remedy for a mesh that a repair has not mended.
const MEND_REPAIRED: &str = "a repair has left this fault: mend it where the body was made, in a \
                             modelling program";

/// Body, with its friction where the file gives it.
pub(crate) struct CheckedBody {
    pub(crate) body: Body,
    /// Coefficient of friction; the fabric's if missing.
    pub(crate) friction: Option<f64>,
    /// Motion; none if it stays.
    pub(crate) motion: Option<BodyMotion>,
    /// Key of the motion.
    pub(crate) motion_key: String,
    /// File, if it is a mesh.
    pub(crate) file: Option<MeshFile>,
}

/// File of a mesh.
pub(crate) struct MeshFile {
    pub(crate) path: PathBuf,
    /// Length of a unit of its coordinates, in m.
    pub(crate) scale: f64,
}

impl MeshFile {
    /// Returns the file of the mesh `spec`, or `None` if the mesh is in memory.
    fn new(checker: &Checker<'_>, spec: &MeshSpec) -> Option<Self> {
        let path = checker.folder.join(spec.file.file()?);
        Some(Self { path, scale: scale(checker, spec) })
    }
}

/// Entry of a body in a scene.
struct Entry<'a> {
    /// Kind of the body, a key of the scene.
    kind: &'a str,
    /// Index among the bodies of this kind.
    index: usize,
    common: CommonKeys<'a>,
}

/// Checks the bodies of a scene.
pub(crate) fn bodies(checker: &mut Checker<'_>) -> Vec<CheckedBody> {
    check_names(checker);
    let colliders = &checker.spec.collider;
    let mut bodies = Vec::new();
    for (index, sphere) in colliders.sphere.iter().enumerate() {
        let shape = Shape::Sphere { radius: sphere.radius };
        let entry = Entry { kind: "sphere", index, common: sphere.common() };
        bodies.push(rigid_body(checker, &entry, shape));
    }
    for (index, cuboid) in colliders.boxes.iter().enumerate() {
        let half_extents = cuboid.size.map(|side| 0.5 * side);
        let edge_radius = cuboid.edge_radius;
        let key = format!("collider.box[{index}]");
        let shortest = half_extents.iter().copied().fold(f64::INFINITY, f64::min);
        check_edge_radius(checker, &key, edge_radius, shortest);
        let shape = Shape::Box { half_extents, edge_radius };
        let entry = Entry { kind: "box", index, common: cuboid.common() };
        bodies.push(rigid_body(checker, &entry, shape));
    }
    for (index, cylinder) in colliders.cylinder.iter().enumerate() {
        let CylinderSpec { radius, edge_radius, .. } = *cylinder;
        let half_height = 0.5 * cylinder.height;
        let key = format!("collider.cylinder[{index}]");
        check_edge_radius(checker, &key, edge_radius, radius.min(half_height));
        let shape = Shape::Cylinder { radius, half_height, edge_radius };
        let entry = Entry { kind: "cylinder", index, common: cylinder.common() };
        bodies.push(rigid_body(checker, &entry, shape));
    }
    for (index, plane) in colliders.plane.iter().enumerate() {
        let entry = Entry { kind: "plane", index, common: plane.common() };
        bodies.push(rigid_body(checker, &entry, Shape::Plane));
    }
    // Rigid meshes come before those that change their shape.
    let meshes = || colliders.mesh.iter().enumerate();
    for (index, mesh) in meshes().filter(|(_, mesh)| !mesh.changes_shape()) {
        bodies.extend(rigid_mesh(checker, index, mesh));
    }
    for (index, mesh) in meshes() {
        if mesh.changes_shape() {
            bodies.extend(changing_mesh(checker, index, mesh));
        } else {
            check_no_frames(checker, index, mesh);
        }
    }
    bodies
}

/// Returns the name of a body: the one in the file, or its kind and number.
fn body_name(kind: &str, index: usize, given: Option<&str>) -> String {
    given.map_or_else(|| format!("{kind} {}", index + 1), str::to_owned)
}

/// Checks that no two bodies have one name.
fn check_names(checker: &mut Checker<'_>) {
    let colliders = &checker.spec.collider;
    let spheres = colliders.sphere.iter().map(SphereSpec::common).enumerate();
    let boxes = colliders.boxes.iter().map(BoxSpec::common).enumerate();
    let cylinders = colliders.cylinder.iter().map(CylinderSpec::common).enumerate();
    let planes = colliders.plane.iter().map(PlaneSpec::common).enumerate();
    let meshes = colliders.mesh.iter().map(MeshSpec::common).enumerate();
    let all = (spheres.map(|entry| ("sphere", entry)))
        .chain(boxes.map(|entry| ("box", entry)))
        .chain(cylinders.map(|entry| ("cylinder", entry)))
        .chain(planes.map(|entry| ("plane", entry)))
        .chain(meshes.map(|entry| ("mesh", entry)));

    let mut known = BTreeSet::new();
    for (kind, (index, common)) in all {
        let name = body_name(kind, index, common.name);
        if known.contains(&name) {
            let key = format!("collider.{kind}[{index}].name");
            let message = format!("there are two bodies \"{}\"", excerpt(&name));
            checker.fail(&key, message, "give each its own name");
        }
        known.insert(name);
    }
}

/// Checks that the `edge_radius` of a body, whose table has the key path `key`, is at most `most`,
/// in m.
fn check_edge_radius(checker: &mut Checker<'_>, key: &str, edge_radius: f64, most: f64) {
    if edge_radius > most.max(0.0) {
        let [radius, most] = [edge_radius, most.max(0.0)].map(figure);
        let message = format!("{radius} m is not between 0 and {most} m");
        let help = "up to half of the shortest side, or the radius";
        checker.fail(&format!("{key}.edge_radius"), message, help);
    }
}

/// Checks the keys that all bodies have in common.
fn check_common(checker: &mut Checker<'_>, key: &str, common: &CommonKeys<'_>) {
    let far = |x: &f64| !(x.abs() <= FAR);
    if let Some(x) = common.center.iter().find(|x| far(x)) {
        let message = format!("{} m is too far out", figure(*x));
        checker.fail(&format!("{key}.center"), message, "up to 10 km: is the unit right?");
    }
}

/// Makes a rigid body of a shape.
fn rigid_body(checker: &mut Checker<'_>, entry: &Entry<'_>, shape: Shape) -> CheckedBody {
    let Entry { kind, index, common } = entry;
    check_common(checker, &format!("collider.{kind}[{index}]"), common);
    let name = body_name(kind, *index, common.name);
    let center = common.center;
    let key = format!("collider.{kind}[{index}].motion");
    let motion = common.motion.and_then(|motion| rigid_motion(checker, &key, motion, center));
    let body = Body::new(name, shape, rotate_pose(Pose::new(center), common.turn));
    CheckedBody {
        body,
        friction: common.friction,
        motion: motion.map(BodyMotion::Rigid),
        motion_key: key,
        file: None,
    }
}

/// Makes a rigid body of a mesh.
fn rigid_mesh(checker: &mut Checker<'_>, index: usize, file: &MeshSpec) -> Option<CheckedBody> {
    if !checker.is_sound(&format!("collider.mesh[{index}].scale")) {
        return None;
    }
    let path = match &file.file {
        FileOr::File(name) => Some(checker.locate(&format!("collider.mesh[{index}].file"), name)?),
        FileOr::Value(_) => None,
    };
    let read = outline(checker, file).map(|outline| outline.scaled(scale(checker, file)));
    match read.and_then(|outline| Mesh::new(&outline.vertices, &outline.triangles)) {
        Ok(mesh) => {
            let longest = longest(&mesh);
            if check_unit(checker, index, file, longest) {
                check_size(checker, index, longest);
            }
            let entry = Entry { kind: "mesh", index, common: file.common() };
            let file = MeshFile::new(checker, file);
            Some(CheckedBody { file, ..rigid_body(checker, &entry, Shape::Mesh(mesh)) })
        }
        Err(error) => {
            let key = format!("collider.mesh[{index}].file");
            if !error.is_fault_of_surface() {
                checker.fail_mesh(&key, &error);
            } else if let Some(path) = path.filter(|path| checker.given(path).is_none()) {
                if is_repaired(&path) {
                    checker.fail(&key, error.to_string(), MEND_REPAIRED);
                    return None;
                }
                let repaired = repaired_file(&path);
                let named = repaired_file(Path::new(file.file.file().unwrap_or_default()));
                let remedy = Remedy::RepairMesh { mesh: path, repaired, named };
                checker.fail(&key, error.to_string(), remedy);
            } else {
                checker.fail(&key, error.to_string(), MEND_GIVEN);
            }
            None
        }
    }
}

/// Returns the unit of the coordinates of the mesh `file`, in m: the unit of the scene if `file`
/// names none.
fn scale(checker: &Checker<'_>, file: &MeshSpec) -> f64 {
    file.scale.unwrap_or(checker.spec.length.metres())
}

/// Checks the size of a mesh: one that is no size for cloth has another unit than the scene says.
fn check_size(checker: &mut Checker<'_>, index: usize, longest: f64) {
    if !(SIZE_MIN..=SIZE_MAX).contains(&longest) {
        let message = format!("the body is {longest:.4} m long");
        let help = "is the unit right? scale = 0.001 reads a file in millimetres, 0.01 one in centimetres, 1 one in \
                    metres; bodies are 2 mm to 100 m long";
        checker.fail(&format!("collider.mesh[{index}].scale"), message, help);
    }
}

/// Units of files, with their lengths in m.
const UNITS: [(&str, f64); 4] =
    [("millimetres", 0.001), ("centimetres", 0.01), ("inches", 0.0254), ("metres", 1.0)];

/// Sizes of a body that wears a garment, in m: from a doll to a tall person.
const WEARER: [f64; 2] = [0.15, 3.0];

/// Height of a person, in m: the unit that gives it is the first that is advised.
const PERSON: f64 = 1.7;

/// Asks for the unit of a body that wears a garment and is as large as none does, where a unit
/// would give it the size of one; returns whether there was nothing to ask.
fn check_unit(checker: &mut Checker<'_>, index: usize, file: &MeshSpec, longest: f64) -> bool {
    let wears = |size: f64| (WEARER[0]..=WEARER[1]).contains(&size);
    if checker.spec.garment.is_empty() || file.scale.is_some() || wears(longest) {
        return true;
    }
    let unit = checker.spec.length.metres();
    let in_file = longest / unit;
    let mut units: Vec<(&str, f64)> =
        UNITS.into_iter().filter(|(_, unit)| wears(in_file * unit)).collect();
    let unlike = |(_, unit): &(&str, f64)| (in_file * unit / PERSON).ln().abs();
    units.sort_by(|a, b| unlike(a).total_cmp(&unlike(b)));
    let choices: Vec<String> = units
        .iter()
        .map(|(name, unit)| {
            format!("scale = {unit} if the file is in {name} ({:.2} m)", in_file * unit)
        })
        .collect();
    if !choices.is_empty() {
        let message = format!("the body is {longest:.2} m long, too large or small for a garment");
        let help = format!("{}; scale = {} keeps its size", choices.join(", "), unit);
        checker.fail(&format!("collider.mesh[{index}].file"), message, &help);
    }
    choices.is_empty()
}

/// Returns the largest extent of a mesh along an axis, in m.
fn longest(mesh: &Mesh) -> f64 {
    let vertices = mesh.vertices();
    let extent = |axis: usize| {
        let values = || vertices.iter().map(|vertex| vertex[axis]);
        values().fold(f64::MIN, f64::max) - values().fold(f64::MAX, f64::min)
    };
    (0..3).map(extent).fold(0.0, f64::max)
}

/// Refuses keys of frames in a mesh that has none.
fn check_no_frames(checker: &mut Checker<'_>, index: usize, file: &MeshSpec) {
    for (key, given) in [("rate", file.rate.is_some()), ("start", file.start != 0.0)] {
        if given {
            let help = "it belongs to motion = \"….pc2\" or frames = \"…_*.obj\"";
            let key = format!("collider.mesh[{index}].{key}");
            checker.fail(&key, "the body has no frames", help);
        }
    }
}

/// Makes a body of a mesh that changes its shape.
fn changing_mesh(checker: &mut Checker<'_>, index: usize, file: &MeshSpec) -> Option<CheckedBody> {
    let key = if file.frames.is_some() { "frames" } else { "motion" };
    let key = format!("collider.mesh[{index}].{key}");
    let Some(rate) = file.rate else {
        let help = "add rate = 24, or how many frames a second has";
        checker.fail(&key, "the motion has no rate", help);
        return None;
    };
    let start = file.start;
    let times = ["rate", "start"].map(|key| format!("collider.mesh[{index}].{key}"));
    if times.iter().any(|key| !checker.is_sound(key)) {
        return None;
    }
    if !checker.spec.keeps_surfaces_apart() {
        let help = "it needs contact.surfaces = true, which is the default";
        checker.fail(&key, "only surfaces meet a body that changes its shape", help);
        return None;
    }
    let common = file.common();
    check_common(checker, &format!("collider.mesh[{index}]"), &common);
    if !checker.is_sound(&format!("collider.mesh[{index}].scale")) {
        return None;
    }
    if let FileOr::File(name) = &file.file {
        checker.locate(&format!("collider.mesh[{index}].file"), name)?;
    }
    let scale = scale(checker, file);
    let place = |point: [f64; 3]| {
        let arm = rotate(point.map(|x| scale * x), common.turn);
        [0, 1, 2].map(|axis| common.center[axis] + arm[axis])
    };
    match read_shapes(file, checker, Sampling { rate, start }, place) {
        Ok(shapes) => {
            check_size(checker, index, longest(&shapes.mesh));
            let name = body_name("mesh", index, common.name);
            let body = Body::new(name, Shape::Mesh(shapes.mesh), Pose::default());
            let motion = Some(BodyMotion::Shapes(shapes.motion));
            let file = MeshFile::new(checker, file);
            Some(CheckedBody { body, friction: common.friction, motion, motion_key: key, file })
        }
        Err(ShapeError::File(error)) => {
            checker.fail_mesh(&key, &error);
            None
        }
        Err(ShapeError::Misplaced(misplaced)) => {
            checker.fail(&key, misplaced.to_string(), misplaced.help());
            None
        }
        Err(ShapeError::Mismatch(message)) => {
            let help = "export the body and its motion anew, with the same vertices";
            checker.fail(&key, message, help);
            None
        }
    }
}
