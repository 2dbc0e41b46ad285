//! Files of bodies that change their shape: point caches, and sequences of meshes.

use std::path::{Path, PathBuf};

use drape_collide::{Mesh, PointCache, Triangulation};
use drape_input::ForbiddenPath;

use crate::check::checker::{Checker, MESH_LIMIT};
use crate::scene::motion::{ShapeMotion, check_frame};
use crate::spec::body::{MeshMotion, MeshSpec};
use crate::spec::file_or::FileOr;

/// Number of vertices that all frames of a sequence may have together: 400 MB of positions.
const VERTICES_MAX: usize = 1 << 24;

/// Error of files that make no motion.
#[derive(Debug)]
pub(crate) enum ShapeError {
    /// A file cannot be read.
    File(drape_collide::Error),
    /// A file is not below the folders of the scene.
    Misplaced(ForbiddenPath),
    /// Files do not fit together.
    Mismatch(String),
}

impl From<ForbiddenPath> for ShapeError {
    fn from(misplaced: ForbiddenPath) -> Self {
        Self::Misplaced(misplaced)
    }
}

impl From<drape_collide::Error> for ShapeError {
    fn from(error: drape_collide::Error) -> Self {
        Self::File(error)
    }
}

/// Times of the frames of a motion.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sampling {
    /// Frames per second.
    pub(crate) rate: f64,
    /// Time at which the first frame is left, in s.
    pub(crate) start: f64,
}

/// Mesh of a body and its motion.
pub(crate) struct Shapes {
    pub(crate) mesh: Mesh,
    pub(crate) motion: ShapeMotion,
}

/// Frames of a motion as they are in files.
struct Frames {
    /// Number of frames from one sample to the next.
    stride: f64,
    /// File of each sample.
    paths: Vec<PathBuf>,
    samples: Vec<Vec<[f64; 3]>>,
}

/// Returns the surface of the mesh `spec`, in its unit.
pub(crate) fn outline(
    checker: &Checker<'_>,
    spec: &MeshSpec,
) -> Result<Triangulation, drape_collide::Error> {
    match &spec.file {
        FileOr::File(name) => checker.mesh(&checker.folder.join(name)),
        FileOr::Value(outline) => Ok(Triangulation::clone(outline)),
    }
}

/// Reads the mesh of a body and its frames. `place` brings a point of the files to its place in the
/// world, in m.
pub(crate) fn read_shapes(
    file: &MeshSpec,
    checker: &Checker<'_>,
    sampling: Sampling,
    place: impl Fn([f64; 3]) -> [f64; 3],
) -> Result<Shapes, ShapeError> {
    let scene = checker.document();
    if let FileOr::File(name) = &file.file {
        let path = checker.folder.join(name);
        if checker.given(&path).is_none() {
            scene.permit(&path)?;
        }
    }
    let of_mesh = outline(checker, file)?;
    let is_sampled = matches!(file.motion, Some(MeshMotion::File(_) | MeshMotion::Frames(_)));
    let frames = match (&file.motion, &file.frames) {
        (Some(MeshMotion::Frames(samples)), None) => {
            let paths = vec![PathBuf::from("the motion"); samples.len()];
            Frames { stride: 1.0, paths, samples: samples.to_vec() }
        }
        (Some(MeshMotion::File(cache)), None) => {
            let path = scene.beside(cache)?;
            let cache = match scene.access().held(&path) {
                Some(bytes) => PointCache::parse(&path, bytes)?,
                None => PointCache::read_within(&path, MESH_LIMIT.bytes(scene.access()))?,
            };
            let paths = vec![path; cache.samples.len()];
            Frames { stride: cache.frames_per_sample, paths, samples: cache.samples }
        }
        (_, Some(pattern)) if !is_sampled => sequence(checker, pattern, &of_mesh)?,
        _ => {
            let message = "give either motion = \"….pc2\" or frames = \"…_*.obj\"".to_owned();
            return Err(ShapeError::Mismatch(message));
        }
    };
    for (path, sample) in frames.paths.iter().zip(&frames.samples) {
        let (found, needed) = (sample.len(), of_mesh.vertices.len());
        if found != needed {
            return Err(ShapeError::Mismatch(format!(
                "{} has {found} vertices, and {} has {needed}",
                path.display(),
                file.file.file().unwrap_or("the mesh")
            )));
        }
    }
    let samples = frames.samples.iter();
    let samples = samples.map(|sample| sample.iter().map(|&x| place(x)).collect());
    let samples: Vec<Vec<[f64; 3]>> = samples.collect();
    let Some(first) = samples.first() else {
        return Err(ShapeError::Mismatch("the motion has no frames".to_owned()));
    };
    let mesh = Mesh::new(first, &of_mesh.triangles)?;
    let coincident = coincident_vertices(first, &of_mesh.triangles);
    for (number, (path, sample)) in frames.paths.iter().zip(&samples).enumerate() {
        check_frame(sample, &coincident, &of_mesh.triangles).map_err(|fault| {
            ShapeError::Mismatch(format!("frame {number} of {}: {fault}", path.display()))
        })?;
    }
    let kept = |sample: &Vec<[f64; 3]>| {
        mesh.source_vertices().iter().flat_map(|&source| sample[source as usize]).collect()
    };
    let positions: Vec<Vec<f64>> = samples.iter().map(kept).collect();
    let Sampling { rate, start } = sampling;
    let times = (0..positions.len()).map(|k| start + k as f64 * frames.stride / rate).collect();
    Ok(Shapes { motion: ShapeMotion::new(times, positions), mesh })
}

/// Reads the meshes of a sequence of files. A `*` in their name stands for the numbers of the
/// files. Files of the disk count if no file is given along with the scene.
fn sequence(
    checker: &Checker<'_>,
    pattern: &str,
    of_mesh: &Triangulation,
) -> Result<Frames, ShapeError> {
    let pattern = checker.folder.join(pattern);
    let name = pattern.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let Some((before, after)) = name.split_once('*') else {
        let message = format!("\"{name}\" has no * for the number of the frame");
        return Err(ShapeError::Mismatch(message));
    };
    let parent = pattern.parent().unwrap_or(Path::new(""));
    let parent = if parent.as_os_str().is_empty() { Path::new(".") } else { parent };
    let number = |path: &Path| -> Option<u64> {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        name.strip_prefix(before)?.strip_suffix(after)?.parse().ok()
    };
    let numbers = |paths: Vec<PathBuf>| -> Vec<(u64, PathBuf)> {
        paths.into_iter().filter_map(|path| Some((number(&path)?, path))).collect()
    };
    let given = checker.documents.iter().map(|document| document.path().to_path_buf());
    let mut numbered = numbers(given.filter(|path| path.parent() == pattern.parent()).collect());
    let are_given = !numbered.is_empty();
    if !are_given {
        checker.document().permit(&pattern)?;
        let entries = std::fs::read_dir(parent).map_err(|error| {
            let reason = error.to_string();
            drape_collide::Error::UnreadableFile { path: parent.to_path_buf(), reason }
        })?;
        numbered = numbers(entries.flatten().map(|entry| entry.path()).collect());
    }
    numbered.sort();
    let (Some((first, _)), Some((last, _))) = (numbered.first(), numbered.last()) else {
        return Err(ShapeError::Mismatch(format!("there is no file {}", pattern.display())));
    };
    if (last - first) as usize != numbered.len() - 1 {
        let missing = (*first..).zip(&numbered).find(|(expected, (number, _))| expected != number);
        let (number, _) = missing.unwrap_or((*first, &numbered[0]));
        let message = format!("of {} there is no or a second number {number}", pattern.display());
        return Err(ShapeError::Mismatch(message));
    }
    let total = of_mesh.vertices.len().saturating_mul(numbered.len());
    if total > VERTICES_MAX {
        let message =
            format!("the frames have {total} vertices, and at most {VERTICES_MAX} are read");
        return Err(ShapeError::Mismatch(message));
    }
    let mut samples = Vec::new();
    for (_, path) in &numbered {
        if !are_given {
            checker.document().permit(path)?;
        }
        let frame = checker.mesh(path)?;
        if frame.vertices.len() == of_mesh.vertices.len() && frame.triangles != of_mesh.triangles {
            let message = format!("{} has other triangles than the body", path.display());
            return Err(ShapeError::Mismatch(message));
        }
        samples.push(frame.vertices);
    }
    let paths = numbered.into_iter().map(|(_, path)| path).collect();
    Ok(Frames { stride: 1.0, paths, samples })
}

/// Returns pairs of vertices that triangles use and that are at the very same place.
fn coincident_vertices(places: &[[f64; 3]], triangles: &[[u32; 3]]) -> Vec<[u32; 2]> {
    let mut used: Vec<u32> = triangles.iter().flatten().copied().collect();
    let bits = |vertex: &u32| places[*vertex as usize].map(|value| (value + 0.0).to_bits());
    used.sort_by_key(|vertex| (bits(vertex), *vertex));
    used.dedup();
    let same = used.windows(2).filter(|pair| bits(&pair[0]) == bits(&pair[1]));
    same.map(|pair| [pair[0], pair[1]]).collect()
}
