//! Grading: the largest spacing at each point of a panel, from its curvature in an earlier run.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use drape_frames::{Error, Recording, curvatures};

/// Largest curvatures of the panels of a run, at their material coordinates.
#[derive(Debug, Clone)]
pub(crate) struct Grading {
    /// Folder of the run.
    pub(crate) folder: PathBuf,
    panels: Vec<(String, CurvatureMap)>,
    /// Largest angle, in rad, by which cloth turns from one particle to the next.
    angle: f64,
}

/// Largest curvature, in 1/m, in square bins over a panel.
#[derive(Debug, Clone)]
struct CurvatureMap {
    /// Side of a bin, in m.
    size: f64,
    bins: BTreeMap<[i64; 2], f64>,
}

impl Grading {
    /// Reads the curvatures of all frames of a run.
    ///
    /// # Errors
    /// When the folder holds no run, or its files are not as a run writes them.
    pub(crate) fn read(folder: &Path, angle: f64) -> Result<Self, Error> {
        let run = Recording::open(folder)?;
        let triangles = &run.topology().cloth;
        let mut largest = vec![0.0; triangles.len()];
        for number in 0..run.frame_count() {
            let curvatures = curvatures(&run.frame(number)?.cloth, triangles)?;
            for (most, curvature) in largest.iter_mut().zip(curvatures) {
                *most = f64::max(*most, curvature);
            }
        }
        let mut first = 0;
        let panels = run.manifest().panels.iter().map(|panel| {
            let range = first..first + panel.triangles;
            first = range.end;
            let map = CurvatureMap::of(
                &run.topology().material,
                (&triangles[range.clone()], &largest[range]),
            );
            (panel.name.clone(), map)
        });
        Ok(Self { folder: folder.to_owned(), panels: panels.collect(), angle })
    }

    /// Returns the largest spacing that is allowed at the material coordinates of a panel, in m, as
    /// a function of them; nothing for a panel that the run does not have.
    pub(crate) fn spacing_max(&self, panel: &str) -> Option<impl Fn([f64; 2]) -> f64> {
        let (_, map) = self.panels.iter().find(|(name, _)| name == panel)?;
        Some(|point| self.angle / map.around(point))
    }
}

impl CurvatureMap {
    /// Returns the map of some triangles with their curvatures. Its bins are as wide as the
    /// particles of the run are apart.
    fn of(material: &[[f64; 2]], (triangles, curvatures): (&[[u32; 3]], &[f64])) -> Self {
        let corners = |triangle: &[u32; 3]| triangle.map(|corner| material[corner as usize]);
        let area = |triangle: &[u32; 3]| {
            let [a, b, c] = corners(triangle);
            0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs()
        };
        // Two triangles to a particle.
        let mean = triangles.iter().map(area).sum::<f64>() / triangles.len().max(1) as f64;
        let mut map = Self { size: (2.0 * mean).sqrt(), bins: BTreeMap::new() };
        for (triangle, &curvature) in triangles.iter().zip(curvatures) {
            for point in corners(triangle) {
                let most = map.bins.entry(map.bin(point)).or_insert(0.0);
                *most = most.max(curvature);
            }
        }
        map
    }

    /// Returns the bin that a point is in.
    fn bin(&self, point: [f64; 2]) -> [i64; 2] {
        point.map(|coordinate| (coordinate / self.size).floor() as i64)
    }

    /// Returns the largest curvature in the bin of a point and in those around it, because folds
    /// may lie elsewhere on another grid; infinity where the run has no cloth.
    fn around(&self, point: [f64; 2]) -> f64 {
        let [u, v] = self.bin(point).map(|place| [-1, 0, 1].map(|step| place.saturating_add(step)));
        let near = u.into_iter().flat_map(|u| v.map(|v| [u, v]));
        let found = near.filter_map(|bin| self.bins.get(&bin).copied());
        found.reduce(f64::max).unwrap_or(f64::INFINITY)
    }
}

#[cfg(test)]
mod tests {
    use drape_frames::samples::SampleRun;

    use super::*;

    /// Radius of the bent half of a sheet, in m.
    const RADIUS: f64 = 0.05;

    /// Run of a sheet of 200 × 100 mm at a spacing of 10 mm, whose half beyond u = 100 mm is bent.
    fn run() -> tempfile::TempDir {
        let folder = tempfile::tempdir().expect("a folder");
        let sheet = SampleRun::grid([21, 11], 0.01, &[0.5], |[u, v], _| {
            let angle = (u - 0.1).max(0.0) / RADIUS;
            [u.min(0.1) + RADIUS * angle.sin(), RADIUS * (1.0 - angle.cos()), v]
        });
        sheet.write(folder.path()).expect("it is written");
        folder
    }

    #[test]
    fn the_spacing_is_that_angle_over_the_curvature_of_the_run() {
        let folder = run();
        let angle = 0.2;
        let grading = Grading::read(folder.path(), angle).expect("a run");
        let spacing_max = grading.spacing_max("sheet").expect("it has the panel");
        for v in [0.004, 0.05, 0.096] {
            let found = spacing_max([0.15, v]) / (angle * RADIUS);
            assert!((found - 1.0).abs() < 0.15, "{found} at {v}");
            assert!(spacing_max([0.04, v]) > 1e3, "{} at {v}", spacing_max([0.04, v]));
        }
        // Beyond the sheet nothing is known.
        assert_eq!(spacing_max([0.3, -1.0]), 0.0);
        assert!(grading.spacing_max("sleeve").is_none());
        let nowhere = Grading::read(&folder.path().join("nowhere"), angle);
        assert!(matches!(nowhere, Err(Error::NotARun { .. })));
    }
}
