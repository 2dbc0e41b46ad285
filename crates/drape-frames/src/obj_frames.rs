//! Files of format 1: frames as OBJ, each with its own triangles and material coordinates.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use crate::error::Error;
use crate::frame::Frame;
use crate::manifest::Manifest;
use crate::obj::Obj;
use crate::topology::{Topology, check_corners};

/// Frame as its files give it.
struct Stored {
    path: PathBuf,
    cloth: Obj,
    bodies_path: Option<PathBuf>,
    bodies: Obj,
}

/// Returns the name of the file of a frame.
pub(crate) fn name(number: usize) -> String {
    format!("frame-{number:05}.obj")
}

/// Returns the numbers of the frames of a folder in their order.
pub(crate) fn numbers(folder: &Path) -> Result<Vec<usize>, Error> {
    let unreadable = |error: std::io::Error| {
        let reason = error.to_string();
        Error::Unreadable { path: folder.to_owned(), reason }
    };
    let mut frames = BTreeSet::new();
    for entry in std::fs::read_dir(folder).map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        let file = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        let number = file.strip_prefix("frame-").and_then(|rest| rest.strip_suffix(".obj"));
        if let Some(number) = number.and_then(|number| number.parse().ok())
            && file == name(number)
        {
            frames.insert(number);
        }
    }
    Ok(frames.into_iter().collect())
}

/// Reads the topology of a folder from its first frame.
pub(crate) fn topology(folder: &Path, manifest: &Manifest) -> Result<Topology, Error> {
    let Stored { cloth, bodies, .. } = Stored::read(folder, manifest, 0)?;
    let (material, cloth) = (cloth.material, cloth.triangles);
    Ok(Topology { material, cloth, bodies: bodies.triangles })
}

/// Reads a frame, which must have the topology of the first one.
pub(crate) fn read(
    folder: &Path,
    manifest: &Manifest,
    topology: &Topology,
    number: usize,
) -> Result<Frame, Error> {
    Stored::read(folder, manifest, number)?.into_frame(number, topology)
}

impl Stored {
    /// Reads the files of a frame.
    fn read(folder: &Path, manifest: &Manifest, number: usize) -> Result<Stored, Error> {
        let path = folder.join(name(number));
        let cloth = Obj::read(&path)?;
        let counts = manifest.cloth_counts();
        needed(&path, "vertices", [cloth.vertices.len(), counts.vertices])?;
        needed(&path, "material coordinates", [cloth.material.len(), counts.vertices])?;
        needed(&path, "triangles", [cloth.triangles.len(), counts.triangles])?;
        check_corners(&path, &cloth.triangles, &manifest.panels)?;
        let (mut bodies_path, mut bodies) = (None, Obj::default());
        if !manifest.bodies.is_empty() {
            let name = cloth.bodies.as_deref().unwrap_or_default();
            let digits = name.strip_prefix("bodies-").and_then(|rest| rest.strip_suffix(".obj"));
            // Any other name could be a path that leads out of the folder.
            if !digits.is_some_and(|d| !d.is_empty() && d.bytes().all(|b| b.is_ascii_digit())) {
                let reason =
                    format!("a frame names the file of its bodies, and \"{name}\" is none");
                return Err(Error::Malformed { path, line: 1, reason });
            }
            let path = folder.join(name);
            bodies = Obj::read(&path)?;
            let counts = manifest.body_counts();
            needed(&path, "vertices", [bodies.vertices.len(), counts.vertices])?;
            needed(&path, "triangles", [bodies.triangles.len(), counts.triangles])?;
            check_corners(&path, &bodies.triangles, &manifest.bodies)?;
            bodies_path = Some(path);
        }
        Ok(Stored { path, cloth, bodies_path, bodies })
    }

    /// Returns the frame, if it has the topology of the first one.
    fn into_frame(self, number: usize, topology: &Topology) -> Result<Frame, Error> {
        let Stored { path, cloth, bodies_path, bodies } = self;
        same_triangles(&path, &cloth.triangles, &topology.cloth)?;
        if let Some(path) = &bodies_path {
            same_triangles(path, &bodies.triangles, &topology.bodies)?;
        }
        if cloth.material != topology.material {
            let reason = "the material coordinates are not those of the first frame".to_owned();
            return Err(Error::Malformed { path, line: 1, reason });
        }
        Ok(Frame {
            number,
            file: path,
            time: cloth.time,
            growth: cloth.growth.unwrap_or(1.0),
            cloth: cloth.vertices,
            bodies_file: bodies_path,
            bodies: bodies.vertices,
            pressures: None,
        })
    }
}

/// Refuses triangles that are not those of the first frame.
fn same_triangles(path: &Path, triangles: &[[u32; 3]], first: &[[u32; 3]]) -> Result<(), Error> {
    match (0..triangles.len()).find(|&t| triangles[t] != first[t]) {
        None => Ok(()),
        Some(triangle) => {
            let (path, corners) = (path.to_owned(), triangles[triangle]);
            let reason = "it has others in the first frame";
            Err(Error::BadTriangle { path, triangle, corners, reason })
        }
    }
}

/// Refuses a file that has another number of items than the manifest gives.
fn needed(path: &Path, what: &'static str, [found, needed]: [usize; 2]) -> Result<(), Error> {
    match found == needed {
        true => Ok(()),
        false => Err(Error::WrongCount { path: path.to_owned(), what, found, needed }),
    }
}
