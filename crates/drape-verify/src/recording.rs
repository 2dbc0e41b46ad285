use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::error::VerifyError;
use crate::manifest::Manifest;
use crate::mesh::Mesh;
use crate::verdict::{Shape, Verdict};
use crate::wavefront::{Wavefront, read_text};

/// A folder of frames that a run wrote.
#[derive(Debug, Clone)]
pub struct Recording {
    folder: PathBuf,
    manifest: Manifest,
    mesh: Mesh,
    /// Frames in their order.
    frames: usize,
    /// Whether the run wrote that it ended.
    ended: bool,
}

impl Recording {
    /// Whether a folder says that it is one of frames.
    #[must_use]
    pub fn is_one(folder: &Path) -> bool {
        folder.join("surfaces.json").exists()
    }

    /// Reads what all frames of a folder have in common, and the first of them.
    ///
    /// # Errors
    /// When a file is missing or is not as a run writes it.
    pub fn open(folder: impl AsRef<Path>) -> Result<Recording, VerifyError> {
        let folder = folder.as_ref();
        if !Recording::is_one(folder) {
            return Err(VerifyError::NotARun { folder: folder.to_owned() });
        }
        let path = folder.join("surfaces.json");
        let manifest = Manifest::parse(&path, &read_text(&path)?)?;
        let frames = numbers(folder)?;
        let summary = folder.join("summary.json");
        let told = if summary.exists() { frames_told(&summary)? } else { None };
        let needed = told.unwrap_or(0).max(frames.keys().last().map_or(1, |last| last + 1));
        if let Some(missing) = (0..needed).find(|number| !frames.contains_key(number)) {
            return Err(VerifyError::MissingFrame {
                folder: folder.to_owned(),
                missing: frame_name(missing),
                found: frames.len(),
                needed,
            });
        }
        let first = Stored::read(folder, &manifest, 0)?;
        let mesh = Mesh::new(&manifest, first.triangles(), first.cloth.material);
        let (folder, frames) = (folder.to_owned(), frames.len());
        Ok(Recording { folder, manifest, mesh, frames, ended: told.is_some() })
    }

    /// Number of frames.
    #[must_use]
    pub fn frames(&self) -> usize {
        self.frames
    }

    /// Whether the run wrote that it ended.
    #[must_use]
    pub fn ended(&self) -> bool {
        self.ended
    }

    /// What the frames have in common.
    #[must_use]
    pub fn manifest(&self) -> &Manifest {
        &self.manifest
    }

    /// The triangles of all frames.
    #[must_use]
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// Reads a frame and looks at all its pairs of triangles.
    ///
    /// # Errors
    /// When a file is missing or is not as a run writes it.
    pub fn verify(&self, number: usize) -> Result<Verdict, VerifyError> {
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
            return Err(VerifyError::BadTriangle { path, triangle, corners, reason });
        }
        if stored.cloth.material != self.mesh.material {
            let reason = "the material coordinates are not those of the first frame".to_owned();
            return Err(VerifyError::Malformed { path: stored.path, line: 1, reason });
        }
        let mut places = stored.cloth.vertices;
        places.extend(stored.bodies.vertices);
        let grown = stored.cloth.grown.unwrap_or(1.0);
        let shape = Shape { mesh: &self.mesh, places: &places, grown };
        Ok(shape.verify((number, stored.path, stored.cloth.time)))
    }
}

fn frame_name(number: usize) -> String {
    format!("frame-{number:05}.obj")
}

/// The frames of a folder by their numbers.
fn numbers(folder: &Path) -> Result<BTreeMap<usize, PathBuf>, VerifyError> {
    let unreadable = |error: std::io::Error| {
        let reason = error.to_string();
        VerifyError::Unreadable { path: folder.to_owned(), reason }
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

/// How many frames a summary says there are.
fn frames_told(path: &Path) -> Result<Option<usize>, VerifyError> {
    let malformed = |line, reason| VerifyError::Malformed { path: path.to_owned(), line, reason };
    let summary: serde_json::Value = serde_json::from_str(&read_text(path)?)
        .map_err(|error| malformed(error.line(), error.to_string()))?;
    Ok(summary["frames"].as_u64().and_then(|frames| usize::try_from(frames).ok()))
}

/// A frame as it is in its files.
struct Stored {
    path: PathBuf,
    cloth: Wavefront,
    bodies_path: PathBuf,
    bodies: Wavefront,
}

impl Stored {
    fn read(folder: &Path, manifest: &Manifest, number: usize) -> Result<Stored, VerifyError> {
        let path = folder.join(frame_name(number));
        let cloth = Wavefront::read(&path)?;
        let counts = |parts: &[crate::Part]| {
            let sum = |of: fn(&crate::Part) -> usize| parts.iter().map(of).sum::<usize>();
            [sum(|part| part.vertices), sum(|part| part.triangles)]
        };
        let [vertices, triangles] = counts(&manifest.panels);
        needed(&path, "vertices", [cloth.vertices.len(), vertices])?;
        needed(&path, "material coordinates", [cloth.material.len(), vertices])?;
        needed(&path, "triangles", [cloth.triangles.len(), triangles])?;
        own_corners(&path, &cloth.triangles, &manifest.panels)?;
        let (mut bodies_path, mut bodies) = (path.clone(), Wavefront::default());
        if !manifest.bodies.is_empty() {
            let name = cloth.bodies.as_deref().unwrap_or_default();
            let digits = name.strip_prefix("bodies-").and_then(|rest| rest.strip_suffix(".obj"));
            // Nothing else may be a path that leads out of the folder.
            if !digits.is_some_and(|d| !d.is_empty() && d.bytes().all(|b| b.is_ascii_digit())) {
                let reason =
                    format!("a frame names the file of its bodies, and \"{name}\" is none");
                return Err(VerifyError::Malformed { path, line: 1, reason });
            }
            bodies_path = folder.join(name);
            bodies = Wavefront::read(&bodies_path)?;
            let [vertices, triangles] = counts(&manifest.bodies);
            needed(&bodies_path, "vertices", [bodies.vertices.len(), vertices])?;
            needed(&bodies_path, "triangles", [bodies.triangles.len(), triangles])?;
            own_corners(&bodies_path, &bodies.triangles, &manifest.bodies)?;
        }
        Ok(Stored { path, cloth, bodies_path, bodies })
    }

    /// All triangles, those of the bodies with their vertices behind the cloth's.
    fn triangles(&self) -> Vec<[u32; 3]> {
        let first = self.cloth.vertices.len() as u32;
        let bodies = self.bodies.triangles.iter().map(|t| t.map(|corner| corner + first));
        self.cloth.triangles.iter().copied().chain(bodies).collect()
    }
}

fn needed(path: &Path, what: &'static str, [found, needed]: [usize; 2]) -> Result<(), VerifyError> {
    match found == needed {
        true => Ok(()),
        false => Err(VerifyError::WrongCount { path: path.to_owned(), what, found, needed }),
    }
}

/// Each triangle must have three corners of its own part.
fn own_corners(
    path: &Path,
    triangles: &[[u32; 3]],
    parts: &[crate::Part],
) -> Result<(), VerifyError> {
    let (mut vertex, mut triangle) = (0, 0);
    for part in parts {
        let own = vertex..vertex + part.vertices;
        let its = triangles.iter().enumerate().skip(triangle).take(part.triangles);
        for (index, &corners) in its {
            let [a, b, c] = corners;
            let reason = if a == b || b == c || c == a {
                "two are the same"
            } else if !corners.iter().all(|&corner| own.contains(&(corner as usize))) {
                "not all are vertices of its part"
            } else {
                continue;
            };
            let path = path.to_owned();
            return Err(VerifyError::BadTriangle { path, triangle: index, corners, reason });
        }
        (vertex, triangle) = (own.end, triangle + part.triangles);
    }
    Ok(())
}
