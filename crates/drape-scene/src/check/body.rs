//! Bodies of a scene: primitives and meshes, with their motions.

mod shape_files;

use std::path::{Path, PathBuf};

use drape_collide::{Body, Mesh, Pose, Shape};
use drape_input::{Given, figure};

use crate::check::checker::Checker;
use crate::check::motion::rigid_motion;
use crate::file::body::{CommonFile, MeshBodyFile};
use crate::scene::motion::{BodyMotion, rotate, rotate_pose};

use self::shape_files::{Sampling, ShapeError, read_shapes};

/// Shortest and longest body of a mesh, in m. A figure of 1.7 m that was read in another unit is
/// 1.7 mm, 170 m or 1.7 km long.
const SIZE_MIN: f64 = 2e-3;
const SIZE_MAX: f64 = 100.0;

/// Shortest and longest side of other bodies, in m.
const LENGTH_MIN: f64 = 1e-4;
const LENGTH_MAX: f64 = 1e4;

/// Largest coordinate of the middle of a body, in m.
const FAR: f64 = 1e4;

/// Remedy for a mesh that is no closed surface and has no file.
const MEND_GIVEN: &str = "a body is one closed surface, each of whose edges has two triangles: mend it where it was \
                          made, such as with trimesh.repair.fill_holes";

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
    fn new(checker: &Checker<'_>, file: &MeshBodyFile) -> Self {
        Self { path: checker.folder.join(&file.file), scale: scale(checker, file) }
    }
}

/// Entry of a body in a scene.
struct Entry<'a> {
    /// Kind of the body, a key of the scene.
    kind: &'a str,
    /// Index among the bodies of this kind.
    index: usize,
    common: CommonFile<'a>,
}

/// Checks the bodies of a scene.
pub(crate) fn bodies(checker: &mut Checker<'_>) -> Vec<CheckedBody> {
    let (colliders, unit) = (&checker.file.collider, checker.unit);
    let mut bodies = Vec::new();
    for (index, sphere) in colliders.sphere.iter().enumerate() {
        let radius = sphere.radius * unit;
        let key = format!("collider.sphere[{index}]");
        check_lengths(checker, &key, &[("radius", radius, LENGTH_MAX)]);
        let shape = Shape::Sphere { radius };
        let entry = Entry { kind: "sphere", index, common: sphere.common() };
        bodies.push(rigid_body(checker, &entry, shape));
    }
    for (index, cuboid) in colliders.boxes.iter().enumerate() {
        let half_extents = cuboid.size.map(|side| 0.5 * side * unit);
        let edge_radius = cuboid.edge_radius * unit;
        let key = format!("collider.box[{index}]");
        let shortest = half_extents.iter().copied().fold(f64::INFINITY, f64::min);
        let [x, y, z] = half_extents.map(|half| 2.0 * half);
        check_lengths(
            checker,
            &key,
            &[
                ("size[0]", x, LENGTH_MAX),
                ("size[1]", y, LENGTH_MAX),
                ("size[2]", z, LENGTH_MAX),
                ("edge_radius", edge_radius, shortest.max(0.0)),
            ],
        );
        let shape = Shape::Box { half_extents, edge_radius };
        let entry = Entry { kind: "box", index, common: cuboid.common() };
        bodies.push(rigid_body(checker, &entry, shape));
    }
    for (index, cylinder) in colliders.cylinder.iter().enumerate() {
        let [radius, edge_radius] =
            [cylinder.radius, cylinder.edge_radius].map(|radius| radius * unit);
        let half_height = 0.5 * cylinder.height * unit;
        let key = format!("collider.cylinder[{index}]");
        check_lengths(
            checker,
            &key,
            &[
                ("radius", radius, LENGTH_MAX),
                ("height", 2.0 * half_height, LENGTH_MAX),
                ("edge_radius", edge_radius, radius.min(half_height).max(0.0)),
            ],
        );
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
    let changes = |mesh: &MeshBodyFile| mesh.frames.is_some() || mesh.point_cache().is_some();
    for (index, mesh) in meshes().filter(|(_, mesh)| !changes(mesh)) {
        bodies.extend(rigid_mesh(checker, index, mesh));
    }
    for (index, mesh) in meshes() {
        if changes(mesh) {
            bodies.extend(changing_mesh(checker, index, mesh));
        } else {
            check_no_frames(checker, index, mesh);
        }
    }
    bodies
}

/// Checks the lengths of a body, each with its key and its range, in m.
fn check_lengths(checker: &mut Checker<'_>, key: &str, lengths: &[(&str, f64, f64)]) {
    for &(name, length, most) in lengths {
        let rounded = name == "edge_radius";
        let least = if rounded { 0.0 } else { LENGTH_MIN };
        if !(least..=most).contains(&length) {
            let [least, most] = [least, most].map(figure);
            let message = format!("{} m is not between {least} and {most} m", figure(length));
            let help = if rounded {
                "up to half of the shortest side, or the radius"
            } else {
                "is the unit right? write it with one, such as \"30 cm\""
            };
            checker.fail(&format!("{key}.{name}"), message, help);
        }
    }
}

/// Checks the keys that all bodies have in common.
fn check_common(checker: &mut Checker<'_>, key: &str, common: &CommonFile<'_>) {
    if let Some(friction) = common.friction {
        let help = "a coefficient of friction, such as 0.3";
        checker.within(&format!("{key}.friction"), friction, 0.0..=10.0, help);
    }
    let far = |x: &f64| !(x.abs() <= FAR);
    if let Some(x) = common.center.map(|x| x * checker.unit).iter().find(|x| far(x)) {
        let message = format!("{} m is too far out", figure(*x));
        checker.fail(&format!("{key}.center"), message, "up to 10 km: is the unit right?");
    }
    if common.turn.iter().any(|x| !x.is_finite()) {
        checker.fail(&format!("{key}.turn"), "is not finite", "degrees about x, y and z");
    }
}

/// Makes a rigid body of a shape.
fn rigid_body(checker: &mut Checker<'_>, entry: &Entry<'_>, shape: Shape) -> CheckedBody {
    let Entry { kind, index, common } = entry;
    check_common(checker, &format!("collider.{kind}[{index}]"), common);
    let name = common.name.map_or_else(|| format!("{kind} {}", index + 1), str::to_owned);
    let center = common.center.map(|x| x * checker.unit);
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
fn rigid_mesh(checker: &mut Checker<'_>, index: usize, file: &MeshBodyFile) -> Option<CheckedBody> {
    if !check_scale(checker, index, file) {
        return None;
    }
    let path = checker.locate(&format!("collider.mesh[{index}].file"), &file.file)?;
    let read = checker.mesh(&path).map(|outline| outline.scaled(scale(checker, file)));
    match read.and_then(|outline| Mesh::new(&outline.vertices, &outline.triangles)) {
        Ok(mesh) => {
            let longest = longest(&mesh);
            if check_unit(checker, index, file, longest) {
                check_size(checker, index, longest);
            }
            let entry = Entry { kind: "mesh", index, common: file.common() };
            let file = Some(MeshFile::new(checker, file));
            Some(CheckedBody { file, ..rigid_body(checker, &entry, Shape::Mesh(mesh)) })
        }
        Err(error) => {
            let key = format!("collider.mesh[{index}].file");
            if !error.is_fault_of_surface() {
                checker.fail_with(&key, &error);
            } else if checker.given(&path).is_some() {
                checker.fail(&key, error.to_string(), MEND_GIVEN);
            } else {
                let path = checker.folder.join(&file.file);
                let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
                let repaired = path.with_file_name(format!("{stem}-repaired.obj"));
                let named = Path::new(&file.file).with_file_name(format!("{stem}-repaired.obj"));
                let help = format!(
                    "`drape check {0}` shows all faults; `drape check {0} --repair {1}` mends \
                         what is safe; then give file = {2:?}",
                    path.display(),
                    repaired.display(),
                    named.display().to_string()
                );
                checker.fail(&key, error.to_string(), &help);
            }
            None
        }
    }
}

/// Returns the unit of the coordinates of the mesh `file`, in m: the unit of the scene if `file`
/// names none.
fn scale(checker: &Checker<'_>, file: &MeshBodyFile) -> f64 {
    file.scale.map_or(checker.unit, Given::value)
}

/// Checks the unit of the coordinates of a mesh.
fn check_scale(checker: &mut Checker<'_>, index: usize, file: &MeshBodyFile) -> bool {
    let help = "the metres that a unit of the file stands for: \"1 mm\", \"1 cm\" or 1";
    let key = format!("collider.mesh[{index}].scale");
    checker.within(&key, scale(checker, file), 1e-6..=1e3, help)
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
fn check_unit(checker: &mut Checker<'_>, index: usize, file: &MeshBodyFile, longest: f64) -> bool {
    let wears = |size: f64| (WEARER[0]..=WEARER[1]).contains(&size);
    if checker.file.garment.is_empty() || file.scale.is_some() || wears(longest) {
        return true;
    }
    let in_file = longest / checker.unit;
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
        let help = format!("{}; scale = {} keeps its size", choices.join(", "), checker.unit);
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
fn check_no_frames(checker: &mut Checker<'_>, index: usize, file: &MeshBodyFile) {
    for (key, given) in [("rate", file.rate.is_some()), ("start", file.start.is_some())] {
        if given {
            let help = "it belongs to motion = \"….pc2\" or frames = \"…_*.obj\"";
            let key = format!("collider.mesh[{index}].{key}");
            checker.fail(&key, "the body has no frames", help);
        }
    }
}

/// Makes a body of a mesh that changes its shape.
fn changing_mesh(
    checker: &mut Checker<'_>,
    index: usize,
    file: &MeshBodyFile,
) -> Option<CheckedBody> {
    let key = if file.frames.is_some() { "frames" } else { "motion" };
    let key = format!("collider.mesh[{index}].{key}");
    let Some(rate) = file.rate else {
        let help = "add rate = 24, or how many frames a second has";
        checker.fail(&key, "the motion has no rate", help);
        return None;
    };
    let help = "frames per second; 24 is usual";
    let sound = checker.within(&format!("collider.mesh[{index}].rate"), rate, 1e-3..=1e5, help);
    let start = file.start.map_or(0.0, Given::value);
    let help = "when the first frame is left, in s";
    let key_of_start = format!("collider.mesh[{index}].start");
    if !checker.within(&key_of_start, start, 0.0..=1e6, help) || !sound {
        return None;
    }
    if !checker.file.keeps_surfaces_apart() {
        let help = "it needs contact.surfaces = true, which is the default";
        checker.fail(&key, "only surfaces meet a body that changes its shape", help);
        return None;
    }
    let common = file.common();
    check_common(checker, &format!("collider.mesh[{index}]"), &common);
    if !check_scale(checker, index, file) {
        return None;
    }
    checker.locate(&format!("collider.mesh[{index}].file"), &file.file)?;
    let (unit, scale) = (checker.unit, scale(checker, file));
    let place = |point: [f64; 3]| {
        let arm = rotate(point.map(|x| scale * x), common.turn);
        [0, 1, 2].map(|axis| common.center[axis] * unit + arm[axis])
    };
    match read_shapes(file, checker, Sampling { rate, start }, place) {
        Ok(shapes) => {
            check_size(checker, index, longest(&shapes.mesh));
            let name = common.name.map_or_else(|| format!("mesh {}", index + 1), str::to_owned);
            let body = Body::new(name, Shape::Mesh(shapes.mesh), Pose::default());
            let motion = Some(BodyMotion::Shapes(shapes.motion));
            let file = Some(MeshFile::new(checker, file));
            Some(CheckedBody { body, friction: common.friction, motion, motion_key: key, file })
        }
        Err(ShapeError::File(error)) => {
            checker.fail_with(&key, &error);
            None
        }
        Err(ShapeError::Misplaced(misplaced)) => {
            checker.fail(&key, misplaced.to_string(), &misplaced.help());
            None
        }
        Err(ShapeError::Mismatch(message)) => {
            let help = "export the body and its motion anew, with the same vertices";
            checker.fail(&key, message, help);
            None
        }
    }
}
