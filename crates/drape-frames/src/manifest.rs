//! Content of `surfaces.json`: the parts of a run and the distances that it promises.

use std::path::Path;

use serde::Deserialize;

use crate::error::Error;

/// Newest format of a folder that is read here.
const FORMAT: u64 = 2;

/// Largest number of vertices and triangles of all parts together; more is a fault of the file.
const COUNT_MAX: usize = 1 << 27;

/// Data that all frames of a run share: the content of `surfaces.json`.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Manifest {
    /// Format of the folder: 2 with arrays, 1 with OBJ files.
    pub format: u64,
    /// Whether contact kept surfaces apart; otherwise only particles met bodies, and no distance was
    /// promised.
    #[serde(rename = "guarded")]
    pub surface_contact: bool,
    /// Panels of cloth, in the order of the vertices in a frame.
    pub panels: Vec<SurfacePart>,
    /// Bodies, in the order of the vertices in a file of bodies.
    pub bodies: Vec<SurfacePart>,
    /// Fraction of the minimum separation of cloth and bodies that holds where bodies pinch the cloth,
    /// above 0 and at most 1.
    #[serde(rename = "thinned", default = "one")]
    pub pinch_fraction: f64,
    /// Pairs of cloth vertices that are sewn together and count as one.
    #[serde(rename = "twins", default)]
    pub seam_pairs: Vec<[u32; 2]>,
    /// Cloth vertices that are tied to a point of an edge, each with the two ends of the edge.
    #[serde(default)]
    pub ties: Vec<[u32; 3]>,
}

/// Panel or body of a run.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct SurfacePart {
    /// Name in the scene.
    pub name: String,
    /// Number of its vertices.
    pub vertices: usize,
    /// Number of its triangles.
    pub triangles: usize,
    /// Half of the activation distance: below the sum of two halves two parts repel each other, in m; 0
    /// where nothing was promised.
    #[serde(rename = "reach", default)]
    pub half_activation_distance: f64,
    /// Half of the minimum separation: two parts stay the sum of two halves apart, in m; 0 where nothing
    /// was promised.
    #[serde(rename = "separation", default)]
    pub half_min_separation: f64,
    /// Name of the fabric of a panel, empty for a body and in format 1.
    #[serde(default)]
    pub fabric: String,
    /// Direction of the weft in the panel's own frame, whose x is its width and y its height; the warp
    /// is a quarter turn anticlockwise from it.
    #[serde(default = "along_width")]
    pub weft: [f64; 2],
}

/// Pinch fraction of a run whose file gives none: the full separation holds everywhere.
fn one() -> f64 {
    1.0
}

/// Direction of the weft of a body, and in format 1.
fn along_width() -> [f64; 2] {
    [1.0, 0.0]
}

impl SurfacePart {
    /// Returns the point in the panel's own frame, in m, that has some weft and warp coordinates.
    #[must_use]
    pub fn pattern_point(&self, [u, v]: [f64; 2]) -> [f64; 2] {
        let [x, y] = self.weft;
        [u * x - v * y, u * y + v * x]
    }
}

impl Manifest {
    pub(crate) fn parse(path: &Path, text: &str) -> Result<Manifest, Error> {
        let malformed = |line, reason| Error::Malformed { path: path.to_owned(), line, reason };
        let manifest: Manifest = serde_json::from_str(text)
            .map_err(|error| malformed(error.line(), error.to_string()))?;
        if !(1..=FORMAT).contains(&manifest.format) {
            let (format, known) = (manifest.format, FORMAT);
            return Err(Error::UnknownFormat { path: path.to_owned(), format, known });
        }
        let parts = || manifest.panels.iter().chain(&manifest.bodies);
        let mut total = 0_usize;
        for part in parts() {
            total = total.saturating_add(part.vertices).saturating_add(part.triangles);
            let valid = |length: f64| (0.0..=1.0).contains(&length);
            if !valid(part.half_activation_distance) || !valid(part.half_min_separation) {
                return Err(malformed(1, format!("\"{}\" has no distances", part.name)));
            }
            let [x, y] = part.weft;
            if !((x.hypot(y) - 1.0).abs() < 1e-6) {
                return Err(malformed(
                    1,
                    format!("the weft of \"{}\" has no direction", part.name),
                ));
            }
        }
        if !(manifest.pinch_fraction > 0.0 && manifest.pinch_fraction <= 1.0) {
            return Err(malformed(
                1,
                format!("{} is no fraction of a distance", manifest.pinch_fraction),
            ));
        }
        if total > COUNT_MAX {
            return Err(malformed(1, format!("{total} vertices and triangles are too many")));
        }
        let cloth: usize = manifest.panels.iter().map(|panel| panel.vertices).sum();
        let mut sewn = manifest.seam_pairs.iter().flatten().chain(manifest.ties.iter().flatten());
        if sewn.any(|&vertex| vertex as usize >= cloth) {
            return Err(malformed(1, "a vertex is sewn that does not exist".to_owned()));
        }
        Ok(manifest)
    }

    /// Returns the numbers of vertices and triangles of the cloth.
    pub(crate) fn cloth_counts(&self) -> Counts {
        Counts::of(&self.panels)
    }

    /// Returns the numbers of vertices and triangles of all bodies.
    pub(crate) fn body_counts(&self) -> Counts {
        Counts::of(&self.bodies)
    }
}

/// Numbers of vertices and triangles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Counts {
    pub(crate) vertices: usize,
    pub(crate) triangles: usize,
}

impl Counts {
    fn of(parts: &[SurfacePart]) -> Counts {
        let sum = |of: fn(&SurfacePart) -> usize| parts.iter().map(of).sum();
        Counts { vertices: sum(|part| part.vertices), triangles: sum(|part| part.triangles) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pattern_points_lie_along_the_weft_and_a_quarter_turn_anticlockwise_from_it() {
        for weft in [[1.0, 0.0], [0.6, 0.8], [0.0, 1.0], [-0.8, 0.6]] {
            let part = SurfacePart {
                name: "front".to_owned(),
                vertices: 3,
                triangles: 1,
                half_activation_distance: 0.0,
                half_min_separation: 0.0,
                fabric: String::new(),
                weft,
            };
            let [x, y] = weft;
            assert_eq!(part.pattern_point([1.0, 0.0]), weft);
            assert_eq!(part.pattern_point([0.0, 1.0]), [-y, x]);
            let [across, up] = part.pattern_point([3.0, -2.0]);
            let exact = [3.0 * x + 2.0 * y, 3.0 * y - 2.0 * x];
            let error = (across - exact[0]).hypot(up - exact[1]);
            assert!(
                error < 1e-15 && (across.hypot(up) - 13.0_f64.sqrt()).abs() < 1e-14,
                "{weft:?}"
            );
        }
    }
}
