//! Meshes: panels and bodies one by one, with their positions in the frames of a clip.

use std::ops::Range;

use drape_frames::{Frame, Recording, SurfacePart};

use crate::clip::Clip;
use crate::colour::{self, Colour};
use crate::error::Error;
use crate::name;
use crate::normal::{self, Creased, Normal};
use crate::palette::{FabricPalette, light};

/// Panel or body, whose vertices have numbers from 0.
#[derive(Debug, Clone)]
pub(crate) struct Mesh<'a> {
    /// Panel or body of the run.
    pub(crate) part: &'a SurfacePart,
    /// Name, which no other mesh has.
    pub(crate) name: String,
    /// Numbers of its vertices among the vertices of the cloth or of the bodies.
    pub(crate) vertices: Range<usize>,
    /// Triangles, by vertices of the mesh.
    pub(crate) triangles: Vec<[u32; 3]>,
    pub(crate) colour: Colour,
    pub(crate) kind: MeshKind,
}

/// Panel or body, with data that only meshes of this kind have.
#[derive(Debug, Clone)]
pub(crate) enum MeshKind {
    /// Panel, with the pattern coordinates of its vertices, in m.
    Panel(Vec<[f64; 2]>),
    /// Body, with its creases.
    Body(Creased),
}

/// Returns the panels and the bodies of `recording`. The creases of bodies are the creases in
/// `frame`.
pub(crate) fn meshes<'a>(recording: &'a Recording, frame: &Frame) -> Vec<Mesh<'a>> {
    let (manifest, topology) = (recording.manifest(), recording.topology());
    let mut names = name::unique(manifest.panels.iter().chain(&manifest.bodies)).into_iter();
    let mut meshes = Vec::new();
    let pattern = pattern(recording);
    let palette = FabricPalette::of_runs([recording]);
    let panels = divided(&manifest.panels, &topology.cloth);
    for (index, PartMesh { part, vertices, triangles }) in panels.into_iter().enumerate() {
        let kind = MeshKind::Panel(pattern[vertices.clone()].to_vec());
        let colour = if palette.is_needed() {
            light(palette.sides(&part.fabric)[0])
        } else {
            colour::panel_colour(index)
        };
        meshes.push(Mesh { part, name: next_name(&mut names), vertices, triangles, colour, kind });
    }
    for PartMesh { part, vertices, triangles } in divided(&manifest.bodies, &topology.bodies) {
        let kind = MeshKind::Body(Creased::new(&frame.bodies[vertices.clone()], &triangles));
        let (name, colour) = (next_name(&mut names), colour::BODY);
        meshes.push(Mesh { part, name, vertices, triangles, colour, kind });
    }
    meshes
}

/// Returns the next of `names`, of which there is one for each part.
fn next_name(names: &mut impl Iterator<Item = String>) -> String {
    names.next().expect("there is a name for each part")
}

/// Returns the pattern coordinates of the vertices of the cloth of `recording`, in m.
pub(crate) fn pattern(recording: &Recording) -> Vec<[f64; 2]> {
    let mut material = recording.topology().material.iter();
    let mut pattern = Vec::new();
    for panel in &recording.manifest().panels {
        let points = material.by_ref().take(panel.vertices);
        pattern.extend(points.map(|point| panel.pattern_point(*point)));
    }
    pattern
}

/// SurfacePart with its vertices and triangles.
struct PartMesh<'a> {
    part: &'a SurfacePart,
    /// Numbers of its vertices among the vertices of all parts.
    vertices: Range<usize>,
    /// Triangles, by vertices of the part from 0.
    triangles: Vec<[u32; 3]>,
}

/// Divides `triangles` and their vertices among `parts`.
fn divided<'a>(parts: &'a [SurfacePart], triangles: &[[u32; 3]]) -> Vec<PartMesh<'a>> {
    let (mut vertex, mut triangle) = (0, 0);
    let mut meshes = Vec::new();
    for part in parts {
        let vertices = vertex..vertex + part.vertices;
        let triangles = triangles[triangle..triangle + part.triangles]
            .iter()
            .map(|corners| corners.map(|corner| corner - vertex as u32))
            .collect();
        (vertex, triangle) = (vertices.end, triangle + part.triangles);
        meshes.push(PartMesh { part, vertices, triangles });
    }
    meshes
}

/// Samples of a mesh in the frames of a clip: a sample for each frame, or one if the mesh does not
/// move.
#[derive(Debug, Clone, Default)]
pub(crate) struct Track {
    pub(crate) samples: Vec<Sample>,
}

/// Positions of the vertices, in m, and normals: one for each vertex of a panel, the normals of
/// [`Creased`] for a body.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Sample {
    pub(crate) positions: Vec<[f32; 3]>,
    pub(crate) normals: Vec<Normal>,
}

impl Track {
    /// Reads the samples of `meshes` in the frames of `clip`.
    pub(crate) fn read(clip: &Clip, meshes: &[Mesh]) -> Result<Vec<Track>, Error> {
        let mut tracks = vec![Track::default(); meshes.len()];
        let has_panels = meshes.iter().any(|mesh| matches!(mesh.kind, MeshKind::Panel(_)));
        let mut bodies_frame = None;
        for index in 0..clip.frame_count() {
            let frame = clip.read(index)?;
            let (manifest, topology) = (clip.recording().manifest(), clip.recording().topology());
            let cloth_normals = if has_panels {
                normal::cloth_normals(&frame, &topology.cloth, &manifest.seam_pairs)
            } else {
                Vec::new()
            };

            // Bodies that have not moved keep their sample: their normals cost most of the time.
            let bodies_moved = index == 0 || frame.bodies_frame != bodies_frame;
            for (mesh, track) in meshes.iter().zip(&mut tracks) {
                let sample = match (&mesh.kind, track.samples.last()) {
                    (MeshKind::Panel(_), _) => Sample {
                        positions: single(&frame.cloth[mesh.vertices.clone()]),
                        normals: cloth_normals[mesh.vertices.clone()].to_vec(),
                    },
                    (MeshKind::Body(_), Some(last)) if !bodies_moved => last.clone(),
                    (MeshKind::Body(creased), _) => {
                        let positions = &frame.bodies[mesh.vertices.clone()];
                        let normals = creased.normals(positions, &mesh.triangles);
                        Sample { positions: single(positions), normals }
                    }
                };
                track.samples.push(sample);
            }
            bodies_frame = frame.bodies_frame;
        }

        for track in &mut tracks {
            if track.samples.windows(2).all(|pair| pair[0] == pair[1]) {
                track.samples.truncate(1);
            }
        }
        Ok(tracks)
    }
}

/// Returns `positions` in single precision, which most formats have.
pub(crate) fn single(positions: &[[f64; 3]]) -> Vec<[f32; 3]> {
    positions.iter().map(|position| position.map(|part| part as f32)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::example;

    #[test]
    fn parts_have_their_own_numbers_and_what_rests_has_one_sample() {
        let folder = example::folder(&[0.0, 0.1, 0.2]);
        let recording = Recording::open(folder.path()).unwrap();
        let clip = Clip::new(&recording, 0..=2, None).unwrap();
        let meshes = meshes(&recording, &clip.read(0).unwrap());
        let tracks = Track::read(&clip, &meshes).unwrap();
        let counts: Vec<_> =
            meshes.iter().zip(&tracks).map(|(m, t)| (&*m.name, t.samples.len())).collect();
        assert_eq!(counts, [("front", 3), (example::HOSTILE, 3), ("box", 1)]);
        let MeshKind::Panel(pattern) = &meshes[1].kind else { panic!("a panel") };
        // Its weft is along the height of the panel.
        assert_eq!(pattern[..], [[0.0, 0.0], [0.0, 0.5], [-0.25, 0.0]]);
        assert_eq!(
            (&meshes[1].triangles[..], meshes[1].vertices.clone()),
            (&[[0, 2, 1]][..], 4..7)
        );
        assert_eq!(tracks[2].samples[0].normals.len(), 24);
    }

    #[test]
    fn a_body_has_the_positions_of_each_frame() {
        let rises = [0.0, 0.0, 0.25, 0.25, 0.5];
        let folder = example::folder_of_rising_box(&rises);
        let recording = Recording::open(folder.path()).unwrap();
        let clip = Clip::new(&recording, 0..=4, None).unwrap();
        let meshes = meshes(&recording, &clip.read(0).unwrap());
        let samples = &Track::read(&clip, &meshes[2..]).unwrap()[0].samples;
        let lowest = |sample: &Sample| {
            sample.positions.iter().map(|place| f64::from(place[1])).fold(f64::INFINITY, f64::min)
        };
        assert_eq!(samples.iter().map(lowest).collect::<Vec<f64>>(), rises);
    }
}
