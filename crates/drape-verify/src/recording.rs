//! Folder of frames that a run wrote: opens it, and reads and checks its frames one by one.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::error::Error;
use crate::manifest::{Manifest, Part};
use crate::mesh::Mesh;
use crate::obj::{Obj, read_text};
use crate::verdict::{Frame, Verdict};

/// Folder of frames that a run wrote.
///
/// ```
/// use drape_verify::{Error, Recording};
///
/// let folder = tempfile::tempdir()?;
/// assert!(matches!(Recording::open(folder.path()), Err(Error::NotARun { .. })));
/// # Ok::<(), std::io::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Recording {
    folder: PathBuf,
    manifest: Manifest,
    mesh: Mesh,
    /// Number of frames.
    frames: usize,
    /// Whether the summary says that the run ended.
    ended: bool,
}

impl Recording {
    /// Returns whether a folder holds the manifest of a run.
    #[must_use]
    pub fn exists(folder: &Path) -> bool {
        folder.join("surfaces.json").exists()
    }

    /// Opens a folder: reads its manifest and the triangles of its first frame.
    ///
    /// # Errors
    /// A file is missing or is not as a run writes it.
    pub fn open(folder: impl AsRef<Path>) -> Result<Recording, Error> {
        let folder = folder.as_ref();
        if !Recording::exists(folder) {
            return Err(Error::NotARun { folder: folder.to_owned() });
        }
        let path = folder.join("surfaces.json");
        let manifest = Manifest::parse(&path, &read_text(&path)?)?;
        let frames = numbers(folder)?;
        let summary = folder.join("summary.json");
        let announced = if summary.exists() { frames_announced(&summary)? } else { None };
        let needed = announced.unwrap_or(0).max(frames.keys().last().map_or(1, |last| last + 1));
        if let Some(missing) = (0..needed).find(|number| !frames.contains_key(number)) {
            return Err(Error::MissingFrame {
                folder: folder.to_owned(),
                missing: frame_name(missing),
                found: frames.len(),
                needed,
            });
        }
        let first = Stored::read(folder, &manifest, 0)?;
        let mesh = Mesh::new(&manifest, first.triangles(), first.cloth.material);
        let (folder, frames) = (folder.to_owned(), frames.len());
        Ok(Recording { folder, manifest, mesh, frames, ended: announced.is_some() })
    }

    /// Number of frames.
    #[must_use]
    pub fn frames(&self) -> usize {
        self.frames
    }

    /// Returns whether the summary says that the run ended.
    #[must_use]
    pub fn ended(&self) -> bool {
        self.ended
    }

    /// Data that all frames share.
    #[must_use]
    pub fn manifest(&self) -> &Manifest {
        &self.manifest
    }

    /// Triangles of all frames.
    #[must_use]
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// Reads a frame and tests all its pairs of triangles.
    ///
    /// # Errors
    /// A file is missing or is not as a run writes it.
    pub fn verify(&self, number: usize) -> Result<Verdict, Error> {
        let stored = Stored::read(&self.folder, &self.manifest, number)?;
        let cloth = stored.cloth.triangles.len();
        let triangles = stored.triangles();
        let differs = |t: &usize| triangles[*t] != self.mesh.triangles[*t];
        if let Some(triangle) = (0..triangles.len()).find(differs) {
            let (path, triangle, corners) = match triangle.checked_sub(cloth) {
                None => (stored.path, triangle, triangles[triangle]),
                Some(own) => (stored.bodies_path, own, stored.bodies.triangles[own]),
            };
            let reason = "it has others in the first frame";
            return Err(Error::BadTriangle { path, triangle, corners, reason });
        }
        if stored.cloth.material != self.mesh.material {
            let reason = "the material coordinates are not those of the first frame".to_owned();
            return Err(Error::Malformed { path: stored.path, line: 1, reason });
        }
        let mut positions = stored.cloth.vertices;
        positions.extend(stored.bodies.vertices);
        let frame = Frame {
            number,
            file: stored.path,
            time: stored.cloth.time,
            growth: stored.cloth.growth.unwrap_or(1.0),
            mesh: &self.mesh,
            positions: &positions,
        };
        Ok(frame.verify())
    }
}

fn frame_name(number: usize) -> String {
    format!("frame-{number:05}.obj")
}

/// Returns the frames of a folder by their numbers.
fn numbers(folder: &Path) -> Result<BTreeMap<usize, PathBuf>, Error> {
    let unreadable = |error: std::io::Error| {
        let reason = error.to_string();
        Error::Unreadable { path: folder.to_owned(), reason }
    };
    let mut frames = BTreeMap::new();
    for entry in std::fs::read_dir(folder).map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        let number = name.strip_prefix("frame-").and_then(|rest| rest.strip_suffix(".obj"));
        if let Some(number) = number.and_then(|number| number.parse().ok())
            && name == frame_name(number)
        {
            frames.insert(number, path);
        }
    }
    Ok(frames)
}

/// Reads the number of frames from a summary.
fn frames_announced(path: &Path) -> Result<Option<usize>, Error> {
    let malformed = |line, reason| Error::Malformed { path: path.to_owned(), line, reason };
    let summary: serde_json::Value = serde_json::from_str(&read_text(path)?)
        .map_err(|error| malformed(error.line(), error.to_string()))?;
    Ok(summary["frames"].as_u64().and_then(|frames| usize::try_from(frames).ok()))
}

/// Frame as its files give it.
struct Stored {
    path: PathBuf,
    cloth: Obj,
    bodies_path: PathBuf,
    bodies: Obj,
}

impl Stored {
    fn read(folder: &Path, manifest: &Manifest, number: usize) -> Result<Stored, Error> {
        let path = folder.join(frame_name(number));
        let cloth = Obj::read(&path)?;
        let counts = |parts: &[Part]| {
            let sum = |of: fn(&Part) -> usize| parts.iter().map(of).sum::<usize>();
            [sum(|part| part.vertices), sum(|part| part.triangles)]
        };
        let [vertices, triangles] = counts(&manifest.panels);
        needed(&path, "vertices", [cloth.vertices.len(), vertices])?;
        needed(&path, "material coordinates", [cloth.material.len(), vertices])?;
        needed(&path, "triangles", [cloth.triangles.len(), triangles])?;
        own_corners(&path, &cloth.triangles, &manifest.panels)?;
        let (mut bodies_path, mut bodies) = (path.clone(), Obj::default());
        if !manifest.bodies.is_empty() {
            let name = cloth.bodies.as_deref().unwrap_or_default();
            let digits = name.strip_prefix("bodies-").and_then(|rest| rest.strip_suffix(".obj"));
            // Any other name could be a path that leads out of the folder.
            if !digits.is_some_and(|d| !d.is_empty() && d.bytes().all(|b| b.is_ascii_digit())) {
                let reason =
                    format!("a frame names the file of its bodies, and \"{name}\" is none");
                return Err(Error::Malformed { path, line: 1, reason });
            }
            bodies_path = folder.join(name);
            bodies = Obj::read(&bodies_path)?;
            let [vertices, triangles] = counts(&manifest.bodies);
            needed(&bodies_path, "vertices", [bodies.vertices.len(), vertices])?;
            needed(&bodies_path, "triangles", [bodies.triangles.len(), triangles])?;
            own_corners(&bodies_path, &bodies.triangles, &manifest.bodies)?;
        }
        Ok(Stored { path, cloth, bodies_path, bodies })
    }

    /// Returns all triangles; the vertices of the bodies are numbered after the cloth's.
    fn triangles(&self) -> Vec<[u32; 3]> {
        let first = self.cloth.vertices.len() as u32;
        let bodies = self.bodies.triangles.iter().map(|t| t.map(|corner| corner + first));
        self.cloth.triangles.iter().copied().chain(bodies).collect()
    }
}

/// Refuses a file that has another number of items than the manifest gives.
fn needed(path: &Path, what: &'static str, [found, needed]: [usize; 2]) -> Result<(), Error> {
    match found == needed {
        true => Ok(()),
        false => Err(Error::WrongCount { path: path.to_owned(), what, found, needed }),
    }
}

/// Refuses triangles whose corners are not three different vertices of their own part.
fn own_corners(path: &Path, triangles: &[[u32; 3]], parts: &[Part]) -> Result<(), Error> {
    let (mut vertex, mut triangle) = (0, 0);
    for part in parts {
        let own = vertex..vertex + part.vertices;
        let range = triangles.iter().enumerate().skip(triangle).take(part.triangles);
        for (index, &corners) in range {
            let [a, b, c] = corners;
            let reason = if a == b || b == c || c == a {
                "two are the same"
            } else if !corners.iter().all(|&corner| own.contains(&(corner as usize))) {
                "not all are vertices of its part"
            } else {
                continue;
            };
            let path = path.to_owned();
            return Err(Error::BadTriangle { path, triangle: index, corners, reason });
        }
        (vertex, triangle) = (own.end, triangle + part.triangles);
    }
    Ok(())
}
