//! Meshes: panels and bodies one by one, with what the frames of a clip have of each.

use std::ops::Range;

use drape_frames::{Frame, Part, Recording};

use crate::clip::Clip;
use crate::colour::{self, Colour};
use crate::error::Error;
use crate::name;
use crate::normal::{self, Creased, Normal};

/// Panel or body, with its own numbers of vertices.
#[derive(Debug, Clone)]
pub(crate) struct Mesh<'a> {
    /// Panel or body of the run.
    pub(crate) part: &'a Part,
    /// Its name, which no other has.
    pub(crate) name: String,
    /// Its vertices, among those of the cloth or of the bodies.
    pub(crate) vertices: Range<usize>,
    /// Its triangles, with its own vertices from 0.
    pub(crate) triangles: Vec<[u32; 3]>,
    pub(crate) colour: Colour,
    pub(crate) kind: Kind,
}

/// What only panels and only bodies have.
#[derive(Debug, Clone)]
pub(crate) enum Kind {
    /// Pattern coordinates of the vertices, in m.
    Panel(Vec<[f64; 2]>),
    /// Normals.
    Body(Creased),
}

/// Returns the panels and the bodies of a run; the creases of bodies are those of a frame.
pub(crate) fn meshes<'a>(recording: &'a Recording, frame: &Frame) -> Vec<Mesh<'a>> {
    let (manifest, topology) = (recording.manifest(), recording.topology());
    let mut names = name::unique(manifest.panels.iter().chain(&manifest.bodies)).into_iter();
    let mut next = || names.next().expect("there is a name for each part");
    let mut meshes = Vec::new();
    let pattern = pattern(recording);
    for (index, (part, vertices, triangles)) in
        divided(&manifest.panels, &topology.cloth).into_iter().enumerate()
    {
        let kind = Kind::Panel(pattern[vertices.clone()].to_vec());
        let colour = colour::of_panel(index);
        meshes.push(Mesh { part, name: next(), vertices, triangles, colour, kind });
    }
    for (part, vertices, triangles) in divided(&manifest.bodies, &topology.bodies) {
        let kind = Kind::Body(Creased::new(&frame.bodies[vertices.clone()], &triangles));
        meshes.push(Mesh { part, name: next(), vertices, triangles, colour: colour::BODY, kind });
    }
    meshes
}

/// Returns the pattern coordinates of the vertices of the cloth, in m.
pub(crate) fn pattern(recording: &Recording) -> Vec<[f64; 2]> {
    let mut material = recording.topology().material.iter();
    let panels = recording.manifest().panels.iter();
    let of_panel = |panel: &'_ Part| {
        let points = material.by_ref().take(panel.vertices);
        points.map(|point| panel.pattern_point(*point)).collect::<Vec<_>>()
    };
    panels.flat_map(of_panel).collect()
}

/// Part, its vertices among those of all parts, its triangles with its own numbers of vertices.
type Share<'a> = (&'a Part, Range<usize>, Vec<[u32; 3]>);

/// Divides vertices and triangles among their parts.
fn divided<'a>(parts: &'a [Part], triangles: &[[u32; 3]]) -> Vec<Share<'a>> {
    let (mut vertex, mut triangle) = (0, 0);
    let mut divide = |part: &'a Part| {
        let vertices = vertex..vertex + part.vertices;
        let own = triangles[triangle..triangle + part.triangles].iter();
        let own = own.map(|corners| corners.map(|corner| corner - vertex as u32)).collect();
        (vertex, triangle) = (vertices.end, triangle + part.triangles);
        (part, vertices, own)
    };
    parts.iter().map(&mut divide).collect()
}

/// What the frames of a clip have of a mesh: a sample for each frame, or one if nothing of it moves.
#[derive(Debug, Clone, Default)]
pub(crate) struct Track {
    pub(crate) samples: Vec<Sample>,
}

/// Positions of the vertices in m, and the normals: one for each vertex of a panel, those of
/// [`Creased`] for a body.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Sample {
    pub(crate) positions: Vec<[f32; 3]>,
    pub(crate) normals: Vec<Normal>,
}

impl Track {
    /// Reads what the frames of a clip have of some meshes.
    pub(crate) fn read(clip: &Clip, meshes: &[Mesh]) -> Result<Vec<Track>, Error> {
        let mut tracks = vec![Track::default(); meshes.len()];
        let panels = meshes.iter().any(|mesh| matches!(mesh.kind, Kind::Panel(_)));
        let mut bodies_file = None;
        for index in 0..clip.frame_count() {
            let frame = clip.read(index)?;
            let moved = index == 0 || frame.bodies_file != bodies_file;
            let (manifest, topology) = (clip.recording().manifest(), clip.recording().topology());
            let of_cloth = match panels {
                true => normal::of_cloth(&frame, &topology.cloth, &manifest.seam_pairs),
                false => Vec::new(),
            };
            for (mesh, track) in meshes.iter().zip(&mut tracks) {
                let sample = match (&mesh.kind, track.samples.last()) {
                    (Kind::Panel(_), _) => Sample {
                        positions: single(&frame.cloth[mesh.vertices.clone()]),
                        normals: of_cloth[mesh.vertices.clone()].to_vec(),
                    },
                    (Kind::Body(_), Some(last)) if !moved => last.clone(),
                    (Kind::Body(creased), _) => {
                        let positions = &frame.bodies[mesh.vertices.clone()];
                        let normals = creased.normals(positions, &mesh.triangles);
                        Sample { positions: single(positions), normals }
                    }
                };
                track.samples.push(sample);
            }
            bodies_file.clone_from(&frame.bodies_file);
        }
        for track in &mut tracks {
            if track.samples.windows(2).all(|pair| pair[0] == pair[1]) {
                track.samples.truncate(1);
            }
        }
        Ok(tracks)
    }
}

/// Returns positions in single precision, which most formats have.
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
        let Kind::Panel(pattern) = &meshes[1].kind else { panic!("a panel") };
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
