//! Files of format 1: each frame is an OBJ file with triangles and material coordinates.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use crate::error::Error;
use crate::frame::Frame;
use crate::manifest::Manifest;
use crate::obj::Obj;
use crate::topology::{Topology, check_corners};

/// Content of the files of a frame.
struct FrameFiles {
    /// File of the cloth.
    path: PathBuf,
    cloth: Obj,
    /// File of the bodies, if the run has bodies.
    bodies_path: Option<PathBuf>,
    bodies: Obj,
}

/// Returns the name of the file of frame `number`.
pub(crate) fn name(number: usize) -> String {
    format!("frame-{number:05}.obj")
}

/// Returns the numbers of the frames in `folder` in ascending order.
pub(crate) fn numbers(folder: &Path) -> Result<Vec<usize>, Error> {
    let entries = std::fs::read_dir(folder).map_err(|error| Error::unreadable(folder, &error))?;
    let mut frames = BTreeSet::new();
    for entry in entries {
        let path = entry.map_err(|error| Error::unreadable(folder, &error))?.path();
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

/// Reads the topology of a run from the first frame in `folder`.
pub(crate) fn topology(folder: &Path, manifest: &Manifest) -> Result<Topology, Error> {
    let FrameFiles { cloth, bodies, .. } = FrameFiles::read(folder, manifest, 0)?;
    let (material, cloth) = (cloth.material, cloth.triangles);
    Ok(Topology { material, cloth, bodies: bodies.triangles })
}

/// Reads frame `number` from `folder`. The frame must have the given `topology`.
pub(crate) fn read(
    folder: &Path,
    manifest: &Manifest,
    topology: &Topology,
    number: usize,
) -> Result<Frame, Error> {
    FrameFiles::read(folder, manifest, number)?.into_frame(number, topology)
}

impl FrameFiles {
    /// Reads the files of frame `number` and compares them with the counts in `manifest`.
    fn read(folder: &Path, manifest: &Manifest, number: usize) -> Result<FrameFiles, Error> {
        let path = folder.join(name(number));
        let cloth = Obj::read(&path)?;
        let counts = manifest.cloth_counts();
        check_count(&path, "vertices", [cloth.vertices.len(), counts.vertices])?;
        check_count(&path, "material coordinates", [cloth.material.len(), counts.vertices])?;
        check_count(&path, "triangles", [cloth.triangles.len(), counts.triangles])?;
        check_corners(&path, &cloth.triangles, &manifest.panels)?;

        let (mut bodies_path, mut bodies) = (None, Obj::default());
        if !manifest.bodies.is_empty() {
            let name = cloth.bodies.as_deref().unwrap_or_default();
            let digits = name.strip_prefix("bodies-").and_then(|rest| rest.strip_suffix(".obj"));
            // A name of another form could be a path that leads out of the folder.
            if !digits.is_some_and(|d| !d.is_empty() && d.bytes().all(|b| b.is_ascii_digit())) {
                let reason =
                    format!("a frame names the file of its bodies, and \"{name}\" is none");
                return Err(Error::Malformed { path, line: 1, reason });
            }
            let path = folder.join(name);
            bodies = Obj::read(&path)?;
            let counts = manifest.body_counts();
            check_count(&path, "vertices", [bodies.vertices.len(), counts.vertices])?;
            check_count(&path, "triangles", [bodies.triangles.len(), counts.triangles])?;
            check_corners(&path, &bodies.triangles, &manifest.bodies)?;
            bodies_path = Some(path);
        }

        Ok(FrameFiles { path, cloth, bodies_path, bodies })
    }

    /// Returns frame `number`, if the files have the given `topology`.
    fn into_frame(self, number: usize, topology: &Topology) -> Result<Frame, Error> {
        let FrameFiles { path, cloth, bodies_path, bodies } = self;
        check_triangles(&path, &cloth.triangles, &topology.cloth)?;
        if let Some(path) = &bodies_path {
            check_triangles(path, &bodies.triangles, &topology.bodies)?;
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

/// Checks that `triangles`, from the file `path`, equal the triangles of the first frame.
fn check_triangles(path: &Path, triangles: &[[u32; 3]], first: &[[u32; 3]]) -> Result<(), Error> {
    match (0..triangles.len()).find(|&t| triangles[t] != first[t]) {
        None => Ok(()),
        Some(triangle) => {
            let (path, corners) = (path.to_owned(), triangles[triangle]);
            let reason = "it has others in the first frame";
            Err(Error::BadTriangle { path, triangle, corners, reason })
        }
    }
}

/// Checks that the file `path` has the number `needed` of items, for which `what` is a word.
fn check_count(path: &Path, what: &'static str, [found, needed]: [usize; 2]) -> Result<(), Error> {
    if found == needed {
        Ok(())
    } else {
        Err(Error::WrongCount { path: path.to_owned(), what, found, needed })
    }
}
