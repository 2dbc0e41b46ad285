use std::path::Path;

use serde::Deserialize;

use crate::error::VerifyError;

/// The format of the folder that is read here.
const FORMAT: u64 = 1;

/// Vertices and triangles that all parts may have together: more is a mistake of the file.
const COUNT_MAX: usize = 1 << 27;

/// What the frames of a run have in common: the content of `surfaces.json`.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Manifest {
    /// Format of the folder.
    pub format: u64,
    /// Whether the run kept surfaces apart; otherwise only particles met bodies, and it promised nothing.
    pub guarded: bool,
    /// The pieces of cloth, in the order of the vertices in a frame.
    pub panels: Vec<Part>,
    /// The bodies, in the order of the vertices in a file of bodies.
    pub bodies: Vec<Part>,
    /// Part of the distance between cloth and bodies that the run keeps wherever bodies pinch the cloth.
    #[serde(default = "whole")]
    pub thinned: f64,
    /// Pairs of cloth vertices that are sewn together and count as one.
    #[serde(default)]
    pub twins: Vec<[u32; 2]>,
    /// Cloth vertices that are sewn to a place between two others, and these.
    #[serde(default)]
    pub ties: Vec<[u32; 3]>,
}

/// A panel or a body.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Part {
    /// What it is called.
    pub name: String,
    /// Number of its vertices.
    pub vertices: usize,
    /// Number of its triangles.
    pub triangles: usize,
    /// Half of the distance below which it and another part push each other, in m; 0 where nothing was promised.
    #[serde(default)]
    pub reach: f64,
    /// Half of the distance that it and another part always keep, in m; 0 where nothing was promised.
    #[serde(default)]
    pub separation: f64,
}

/// Of a run that keeps the same distance everywhere.
fn whole() -> f64 {
    1.0
}

impl Manifest {
    pub(crate) fn parse(path: &Path, text: &str) -> Result<Manifest, VerifyError> {
        let malformed =
            |line, reason| VerifyError::Malformed { path: path.to_owned(), line, reason };
        let manifest: Manifest = serde_json::from_str(text)
            .map_err(|error| malformed(error.line(), error.to_string()))?;
        if manifest.format != FORMAT {
            let (format, known) = (manifest.format, FORMAT);
            return Err(VerifyError::UnknownFormat { path: path.to_owned(), format, known });
        }
        let parts = || manifest.panels.iter().chain(&manifest.bodies);
        let mut total = 0_usize;
        for part in parts() {
            total = total.saturating_add(part.vertices).saturating_add(part.triangles);
            let sound = |length: f64| (0.0..=1.0).contains(&length);
            if !sound(part.reach) || !sound(part.separation) {
                return Err(malformed(1, format!("\"{}\" has no distances", part.name)));
            }
        }
        if !(manifest.thinned > 0.0 && manifest.thinned <= 1.0) {
            return Err(malformed(1, format!("{} is no part of a distance", manifest.thinned)));
        }
        if total > COUNT_MAX {
            return Err(malformed(1, format!("{total} vertices and triangles are too many")));
        }
        let cloth: usize = manifest.panels.iter().map(|panel| panel.vertices).sum();
        let mut sewn = manifest.twins.iter().flatten().chain(manifest.ties.iter().flatten());
        if sewn.any(|&vertex| vertex as usize >= cloth) {
            return Err(malformed(1, "a vertex is sewn that does not exist".to_owned()));
        }
        Ok(manifest)
    }
}
