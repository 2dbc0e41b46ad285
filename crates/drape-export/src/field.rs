//! Fields: quantities on the cloth, a number for each vertex.

mod strain;

use std::str::FromStr;

use drape_collide::NearestSurface;
use drape_frames::vector::{difference, length};
use drape_frames::{Frame, Recording, curvatures};
use rayon::prelude::*;

use self::strain::{RestTriangle, StrainComponent};
use crate::error::Error;
use crate::scale;

/// Quantity on the cloth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Field {
    /// Strain along the warp, in %.
    StrainWarp,
    /// Strain along the weft, in %.
    StrainWeft,
    /// Shear angle, positive where warp and weft cross at less than a right angle, in °.
    Shear,
    /// Largest size of a principal curvature, in 1/m.
    Curvature,
    /// Pressure of contact, in Pa. Older runs have it in the last frame only.
    Pressure,
    /// Distance from the nearest body, in mm; 50 if it is larger.
    Distance,
    /// Distance between the two sides of a seam, in mm; 0 elsewhere.
    SeamGap,
    /// Mean speed since the frame before, in m/s; 0 in the first frame.
    Speed,
}

/// Largest distance from a body that is computed, in m.
const DISTANCE_MAX: f64 = 0.05;

impl Field {
    /// All fields.
    pub const ALL: [Field; 8] = [
        Field::StrainWarp,
        Field::StrainWeft,
        Field::Shear,
        Field::Curvature,
        Field::Pressure,
        Field::Distance,
        Field::SeamGap,
        Field::Speed,
    ];

    /// Returns the name of the field in commands and files.
    #[must_use]
    pub fn key(self) -> &'static str {
        match self {
            Field::StrainWarp => "strain-warp",
            Field::StrainWeft => "strain-weft",
            Field::Shear => "shear",
            Field::Curvature => "curvature",
            Field::Pressure => "pressure",
            Field::Distance => "distance",
            Field::SeamGap => "seam-gap",
            Field::Speed => "speed",
        }
    }

    /// Returns the name of the field as a person reads it.
    #[must_use]
    pub fn label(self) -> &'static str {
        match self {
            Field::StrainWarp => "strain along the warp",
            Field::StrainWeft => "strain along the weft",
            Field::Shear => "shear angle",
            Field::Curvature => "curvature",
            Field::Pressure => "pressure",
            Field::Distance => "distance to the body",
            Field::SeamGap => "seam gap",
            Field::Speed => "speed",
        }
    }

    /// Returns the unit of the values.
    #[must_use]
    pub fn unit(self) -> &'static str {
        match self {
            Field::StrainWarp | Field::StrainWeft => "%",
            Field::Shear => "°",
            Field::Curvature => "1/m",
            Field::Pressure => "Pa",
            Field::Distance | Field::SeamGap => "mm",
            Field::Speed => "m/s",
        }
    }

    /// Returns whether the values may be negative.
    #[must_use]
    pub fn is_signed(self) -> bool {
        matches!(self, Field::StrainWarp | Field::StrainWeft | Field::Shear)
    }

    /// Returns the range of nearly all values in `frames`, a list of values for each, rounded up to
    /// 1, 2 or 5 times a power of ten. The range of a signed field is symmetric about zero, another
    /// range begins at zero.
    #[must_use]
    pub fn range(self, frames: &[Vec<f64>]) -> [f64; 2] {
        scale::range(frames.iter().flatten().copied(), self.is_signed())
    }
}

impl FromStr for Field {
    type Err = Error;

    fn from_str(key: &str) -> Result<Field, Error> {
        Field::ALL.into_iter().find(|field| field.key() == key).ok_or_else(|| {
            let known = Field::ALL.map(Field::key).join(", ");
            Error::UnknownField { key: key.to_owned(), known }
        })
    }
}

/// Fields of the frames of a recording.
#[derive(Debug)]
pub struct Fields<'a> {
    recording: &'a Recording,
    triangles: Vec<RestTriangle>,
    /// Area of the triangles around each vertex at rest, in m².
    areas: Vec<f64>,
    /// Surfaces of the bodies of the last frame, with the number of the
    /// first frame that has them.
    bodies: Option<(usize, Vec<NearestSurface>)>,
}

impl<'a> Fields<'a> {
    /// Returns the fields of the frames of `recording`.
    #[must_use]
    pub fn new(recording: &'a Recording) -> Fields<'a> {
        let topology = recording.topology();
        let triangles: Vec<RestTriangle> = topology
            .cloth
            .iter()
            .map(|corners| RestTriangle::new(*corners, &topology.material))
            .collect();
        let mut areas = vec![0.0; topology.material.len()];
        for triangle in &triangles {
            triangle.corners.iter().for_each(|&corner| areas[corner as usize] += triangle.area);
        }
        Fields { recording, triangles, areas, bodies: None }
    }

    /// Returns whether the recording has `field` in some frame.
    #[must_use]
    pub fn has(&self, field: Field) -> bool {
        let manifest = self.recording.manifest();
        match field {
            Field::Pressure => self.recording.has_pressures(),
            Field::Distance => !manifest.bodies.is_empty(),
            Field::SeamGap => !manifest.seam_pairs.is_empty(),
            Field::Speed => self.recording.frame_count() > 1,
            _ => true,
        }
    }

    /// Returns `field` in `frame`, a number for each vertex of the cloth; `None` if it is not known
    /// there.
    ///
    /// Speeds are measured from the earlier frame `before`.
    pub fn values(
        &mut self,
        field: Field,
        frame: &Frame,
        before: Option<&Frame>,
    ) -> Option<Vec<f64>> {
        match field {
            Field::StrainWarp => Some(self.strains(frame, StrainComponent::Warp)),
            Field::StrainWeft => Some(self.strains(frame, StrainComponent::Weft)),
            Field::Shear => Some(self.strains(frame, StrainComponent::Shear)),
            Field::Curvature => Some(self.curvature(frame)),
            Field::Pressure => frame.pressures.clone(),
            Field::Distance => self.distances(frame),
            Field::SeamGap => self.has(field).then(|| self.seam_gaps(frame)),
            Field::Speed => self.has(field).then(|| speeds(frame, before)),
        }
    }

    /// Returns the mean of `values` over the triangles around each vertex, weighted by their areas
    /// at rest.
    fn at_vertices(&self, values: &[f64]) -> Vec<f64> {
        let mut sums = vec![0.0; self.areas.len()];
        for (triangle, value) in self.triangles.iter().zip(values) {
            let weighted = value * triangle.area;
            triangle.corners.iter().for_each(|&corner| sums[corner as usize] += weighted);
        }
        sums.iter().zip(&self.areas).map(|(sum, area)| sum / area.max(f64::MIN_POSITIVE)).collect()
    }

    /// Returns a component of the strain at each vertex.
    fn strains(&self, frame: &Frame, component: StrainComponent) -> Vec<f64> {
        let triangles = self.triangles.iter();
        let strains: Vec<f64> =
            triangles.map(|triangle| triangle.strain(&frame.cloth, component)).collect();
        self.at_vertices(&strains)
    }

    /// Returns the largest size of a principal curvature at each vertex, in 1/m.
    fn curvature(&self, frame: &Frame) -> Vec<f64> {
        let topology = self.recording.topology();
        // The corners of a recording are vertices of its frames.
        let curvatures = curvatures(&frame.cloth, &topology.cloth).unwrap_or_default();
        self.at_vertices(&curvatures)
    }

    /// Returns the distances of the vertices from the nearest body, in mm.
    fn distances(&mut self, frame: &Frame) -> Option<Vec<f64>> {
        let number = frame.bodies_frame?;
        if self.bodies.as_ref().is_none_or(|(known, _)| *known != number) {
            self.bodies = Some((number, surfaces(self.recording, frame)));
        }
        let (_, surfaces) = self.bodies.as_ref()?;
        let distances = frame.cloth.par_iter().map(|point| {
            let nearest = surfaces.iter().fold(DISTANCE_MAX, |limit, surface| {
                surface.distance(*point, limit).unwrap_or(limit)
            });
            1e3 * nearest
        });
        Some(distances.collect())
    }

    /// Returns the distances between vertices that are sewn together, in mm; 0 for other vertices.
    fn seam_gaps(&self, frame: &Frame) -> Vec<f64> {
        let mut gaps = vec![0.0_f64; frame.cloth.len()];
        for pair in &self.recording.manifest().seam_pairs {
            let [a, b] = pair.map(|vertex| vertex as usize);
            let gap = 1e3 * length(difference(frame.cloth[a], frame.cloth[b]));
            [a, b].into_iter().for_each(|vertex| gaps[vertex] = gaps[vertex].max(gap));
        }
        gaps
    }
}

/// Returns the surfaces of the bodies of `recording` in `frame`.
fn surfaces(recording: &Recording, frame: &Frame) -> Vec<NearestSurface> {
    let mut triangles = recording.topology().bodies.iter();
    let (mut surfaces, mut first) = (Vec::new(), 0);
    for body in &recording.manifest().bodies {
        let corners = triangles.by_ref().take(body.triangles);
        let body_triangles: Vec<[u32; 3]> =
            corners.map(|t| t.map(|corner| corner - first as u32)).collect();
        let vertices = &frame.bodies[first..first + body.vertices];
        // A body without triangles has no distance.
        surfaces.extend(NearestSurface::new(vertices, &body_triangles));
        first += body.vertices;
    }
    surfaces
}

/// Returns the mean speeds of the vertices since the earlier frame `before`, in m/s.
fn speeds(frame: &Frame, before: Option<&Frame>) -> Vec<f64> {
    let (before, seconds) = match before {
        Some(before) if frame.time > before.time => (before, frame.time - before.time),
        _ => return vec![0.0; frame.cloth.len()],
    };
    let pairs = frame.cloth.iter().zip(&before.cloth);
    pairs.map(|(now, then)| length(difference(*now, *then)) / seconds).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::example;

    #[test]
    fn a_vertex_has_the_mean_of_its_triangles_by_their_areas() {
        let material = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 3.0]];
        let folder = example::folder_of_panel(&material, &[[0, 1, 2], [1, 3, 2]]);
        let recording = Recording::open(folder.path()).unwrap();
        // Their areas are 0.5 and 1.5 m².
        let means = Fields::new(&recording).at_vertices(&[1.0, 5.0]);
        assert_eq!(means, [1.0, 4.0, 4.0, 5.0]);
    }

    #[test]
    fn distances_are_those_from_the_nearest_of_several_bodies() {
        let folder = example::folder(&[0.3]);
        // Of the cube its lower and its upper face, as two bodies.
        let faces = ["lower", "upper"]
            .map(|name| serde_json::json!({ "name": name, "vertices": 4, "triangles": 2 }));
        let path = folder.path().join("surfaces.json");
        let text = std::fs::read_to_string(&path).unwrap();
        let mut manifest: serde_json::Value = serde_json::from_str(&text).unwrap();
        manifest["bodies"] = faces.into();
        std::fs::write(&path, format!("{manifest}\n")).unwrap();
        let (_, triangles) = example::cube();
        example::array(&folder.path().join("body-triangles.npy"), &triangles[..4]);
        let recording = Recording::open(folder.path()).unwrap();
        let mut frame = recording.frame(0).unwrap();
        frame.cloth = vec![[0.5, 0.5, 0.01], [0.4, 0.6, 0.98], [0.5, 0.5, 0.5], [0.2, 0.3, -0.03]];
        let distances = Fields::new(&recording).values(Field::Distance, &frame, None).unwrap();
        for (distance, expected) in distances.iter().zip([10.0, 20.0, 1e3 * DISTANCE_MAX, 30.0]) {
            assert!((distance - expected).abs() < 1e-9, "{distances:?}");
        }
    }

    #[test]
    fn distances_are_those_from_the_bodies_of_their_frame() {
        let folder = example::folder_of_rising_box(&[0.0, 0.25, 0.25]);
        let recording = Recording::open(folder.path()).unwrap();
        let mut fields = Fields::new(&recording);
        for (number, expected) in [(0, 30.0), (1, 20.0), (2, 20.0), (0, 30.0)] {
            let mut frame = recording.frame(number).unwrap();
            frame.cloth = vec![[0.5, [-0.03, 0.23][usize::from(number > 0)], 0.5]];
            let distance = fields.values(Field::Distance, &frame, None).unwrap()[0];
            assert!((distance - expected).abs() < 1e-9, "frame {number}: {distance} mm");
        }
    }

    #[test]
    fn a_run_of_one_frame_without_bodies_seams_and_contact_has_the_fields_of_its_cloth_alone() {
        let material = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        let folder = example::folder_of_panel(&material, &[[0, 1, 2]]);
        let recording = Recording::open(folder.path()).unwrap();
        let fields = Fields::new(&recording);
        for field in [Field::Pressure, Field::Distance, Field::SeamGap, Field::Speed] {
            assert!(!fields.has(field), "{field:?}");
        }
        assert!(fields.has(Field::Shear) && fields.has(Field::Curvature));
        let folder = example::folder(&[0.0, 0.1]);
        let recording = Recording::open(folder.path()).unwrap();
        let fields = Fields::new(&recording);
        for field in [Field::Pressure, Field::Distance, Field::SeamGap, Field::Speed] {
            assert!(fields.has(field), "{field:?}");
        }
    }
}
