//! GLB, binary glTF 2.0: the last frame of a clip, and the frames before as morph targets of an
//! animation.

use std::io::Write;

use serde_json::{Value, json};

use crate::clip::Clip;
use crate::error::Error;
use crate::mesh::{self, Mesh, MeshKind, Sample, Track};

/// Largest number of frames of an animation. Viewers hold every frame on the graphics card, in a
/// texture. On many cards a texture has no more than 256 layers.
pub const GLB_FRAMES_MAX: usize = 120;

/// Largest number of bytes of a file, because lengths in it have 32 bits.
const BYTES_MAX: usize = u32::MAX as usize - 64;

/// `componentType` of single precision.
const FLOAT: u32 = 5126;

/// `componentType` of indices.
const UNSIGNED_INT: u32 = 5125;

/// `target` of a view with attributes of vertices.
const VERTICES: u32 = 34962;

/// `target` of a view with indices.
const INDICES: u32 = 34963;

/// Writes `clip` to `to` as GLB: a node, a mesh and a material for each panel and body, in m, y up.
///
/// The mesh shows the last frame. The frames before are morph targets, which an animation shows at
/// their times. Of more than [`GLB_FRAMES_MAX`] frames, this number is written, evenly chosen.
/// Their numbers are in the names of the targets. Texture coordinates are pattern coordinates in m,
/// counted from the top as the format demands: the second is 1 less the height.
/// Where a run has several fabrics, the materials of panels have the colours of their fabrics
/// ([`crate::FabricPalette`]).
///
/// # Errors
/// Frames cannot be read, the file would be larger than the format allows, or `to` fails.
pub fn write_glb(clip: &Clip, mut to: impl Write) -> Result<(), Error> {
    let clip = clip.thinned(GLB_FRAMES_MAX);
    let last = clip.read(clip.frame_count() - 1)?;
    let meshes = mesh::meshes(clip.recording(), &last);
    let tracks = Track::read(&clip, &meshes)?;

    let mut file = Document::default();
    let mut animated = Vec::new();
    for (index, (mesh, track)) in meshes.iter().zip(&tracks).enumerate() {
        file.add(mesh, track, &clip);
        if track.samples.len() > 1 {
            animated.push(index);
        }
    }
    file.animate(&animated, &clip);
    let document = file.json(&clip);

    // Both chunks have a header of 8 bytes and begin at multiples of 4.
    let mut text = serde_json::to_vec(&document).expect("a document has no keys but strings");
    text.resize(text.len().next_multiple_of(4), b' ');
    let total = 12 + 8 + text.len() + 8 + file.binary.len();
    if total > BYTES_MAX {
        let (format, what, limit) = ("GLB", "bytes", BYTES_MAX);
        return Err(Error::TooLarge { format, what, found: total, limit });
    }

    to.write_all(b"glTF")?;
    for word in [2, total as u32, text.len() as u32] {
        to.write_all(&word.to_le_bytes())?;
    }
    to.write_all(b"JSON")?;
    to.write_all(&text)?;
    to.write_all(&(file.binary.len() as u32).to_le_bytes())?;
    to.write_all(b"BIN\0")?;
    to.write_all(&file.binary)?;
    Ok(())
}

/// Lists of a glTF document, and its binary part.
#[derive(Default)]
struct Document {
    nodes: Vec<Value>,
    meshes: Vec<Value>,
    materials: Vec<Value>,
    animations: Vec<Value>,
    accessors: Vec<Value>,
    views: Vec<Value>,
    binary: Vec<u8>,
}

impl Document {
    /// Begins a view of the bytes that follow. `stride` is the number of bytes of an element.
    fn begin(&mut self, target: Option<u32>, stride: Option<usize>) -> View {
        View { start: self.binary.len(), index: self.views.len(), target, stride }
    }

    /// Ends `view` behind the bytes that were added since it began.
    fn end(&mut self, view: View) {
        let View { start, target, stride, .. } = view;
        let length = self.binary.len() - start;
        let mut value = json!({ "buffer": 0, "byteOffset": start, "byteLength": length });
        if let Some(target) = target {
            value["target"] = target.into();
        }
        if let Some(stride) = stride {
            value["byteStride"] = stride.into();
        }
        self.views.push(value);
    }

    /// Adds `rows` to the bytes and an accessor to them in `view`, and returns its number. The
    /// accessor has the smallest and the largest row if `bounds`.
    fn floats<const N: usize>(&mut self, view: &View, rows: &[[f32; N]], bounds: bool) -> usize {
        let kind = match N {
            1 => "SCALAR",
            2 => "VEC2",
            _ => "VEC3",
        };
        let offset = self.binary.len() - view.start;
        let mut accessor = json!({
            "bufferView": view.index, "byteOffset": offset, "componentType": FLOAT,
            "count": rows.len(), "type": kind,
        });
        if bounds {
            (accessor["min"], accessor["max"]) =
                (json!(bound(rows, f32::min)), json!(bound(rows, f32::max)));
        }
        self.binary.extend(rows.iter().flatten().flat_map(|number| number.to_le_bytes()));
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    /// Adds the panel or the body `mesh` with the samples of `track`.
    fn add(&mut self, mesh: &Mesh, track: &Track, clip: &Clip) {
        let index = self.meshes.len();
        let (base, earlier) = track.samples.split_last().expect("a clip has a frame");
        let base = spread(mesh, base);

        // Positions and normals of the last frame, then differences of the frames before.
        let vertices = self.begin(Some(VERTICES), Some(12));
        let mut attributes = json!({
            "POSITION": self.floats(&vertices, &base.positions, true),
            "NORMAL": self.floats(&vertices, &base.normals, false),
        });
        let targets: Vec<Value> = earlier
            .iter()
            .map(|sample| {
                let sample = spread(mesh, sample);
                let positions = differences(&sample.positions, &base.positions);
                let normals = differences(&sample.normals, &base.normals);
                let position = self.floats(&vertices, &positions, true);
                let normal = self.floats(&vertices, &normals, false);
                json!({ "POSITION": position, "NORMAL": normal })
            })
            .collect();
        self.end(vertices);

        let corners = match &mesh.kind {
            MeshKind::Body(creased) => &creased.corners,
            MeshKind::Panel(pattern) => {
                let view = self.begin(Some(VERTICES), Some(8));
                // The format counts the second coordinate from the top.
                let uv: Vec<[f32; 2]> =
                    pattern.iter().map(|[x, y]| [*x as f32, (1.0 - y) as f32]).collect();
                attributes["TEXCOORD_0"] = self.floats(&view, &uv, false).into();
                self.end(view);
                &mesh.triangles
            }
        };
        let view = self.begin(Some(INDICES), None);
        self.accessors.push(json!({
            "bufferView": view.index, "componentType": UNSIGNED_INT,
            "count": 3 * corners.len(), "type": "SCALAR",
        }));
        self.binary.extend(corners.iter().flatten().flat_map(|corner| corner.to_le_bytes()));
        self.end(view);

        let mut primitive = json!({
            "attributes": attributes, "indices": self.accessors.len() - 1, "material": index, "mode": 4,
        });
        let mut value = json!({ "name": mesh.name });
        if !targets.is_empty() {
            value["weights"] = vec![0.0; targets.len()].into();
            let numbers = clip.frames()[..targets.len()].iter();
            let names: Vec<String> = numbers.map(|number| format!("frame {number}")).collect();
            value["extras"] = json!({ "targetNames": names });
            primitive["targets"] = targets.into();
        }
        value["primitives"] = json!([primitive]);
        self.meshes.push(value);
        self.materials.push(material(mesh));
        self.nodes.push(node(mesh, index));
    }

    /// Adds the animation of the nodes `animated`. At the time of a frame its target has the weight
    /// 1 and other targets have none. At the time of the last frame no target has a weight.
    fn animate(&mut self, animated: &[usize], clip: &Clip) {
        if animated.is_empty() {
            return;
        }
        let view = self.begin(None, None);
        let times: Vec<[f32; 1]> = clip.seconds().iter().map(|seconds| [*seconds as f32]).collect();
        let input = self.floats(&view, &times, true);
        let (frames, targets) = (clip.frame_count(), clip.frame_count() - 1);
        let weights: Vec<[f32; 1]> = (0..frames * targets)
            .map(|at| [f32::from(u8::from(at / targets == at % targets))])
            .collect();
        let output = self.floats(&view, &weights, false);
        self.end(view);
        let channels: Vec<Value> = animated
            .iter()
            .map(|node| json!({ "sampler": 0, "target": { "node": node, "path": "weights" } }))
            .collect();
        let sampler = json!({ "input": input, "output": output, "interpolation": "LINEAR" });
        self.animations.push(json!({ "name": "run", "channels": channels, "samplers": [sampler] }));
    }

    /// Returns the document as JSON.
    fn json(&self, clip: &Clip) -> Value {
        let all: Vec<usize> = (0..self.nodes.len()).collect();
        let mut document = json!({
            "asset": { "version": "2.0", "generator": concat!("drape ", env!("CARGO_PKG_VERSION")) },
            "scene": 0,
            "scenes": [{
                "nodes": all,
                "extras": {
                    "units": "m", "up": "y", "framesPerSecond": clip.rate(),
                    "frames": clip.frames(), "startTime": clip.times()[0],
                    "texture coordinates": "pattern coordinates in m; the second is 1 less the height",
                },
            }],
            "nodes": self.nodes, "meshes": self.meshes, "materials": self.materials,
            "accessors": self.accessors, "bufferViews": self.views,
            "buffers": [{ "byteLength": self.binary.len() }],
        });
        if !self.animations.is_empty() {
            document["animations"] = self.animations.clone().into();
        }
        document
    }
}

/// Returns the material of `mesh`.
fn material(mesh: &Mesh) -> Value {
    let [red, green, blue] = mesh.colour;
    json!({
        "name": mesh.name, "doubleSided": matches!(mesh.kind, MeshKind::Panel(_)),
        "pbrMetallicRoughness": {
            "baseColorFactor": [red, green, blue, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.9,
        },
    })
}

/// Returns the node of `mesh`, the mesh with the number `index`.
fn node(mesh: &Mesh, index: usize) -> Value {
    let extras = match mesh.kind {
        MeshKind::Panel(_) => {
            json!({ "name": mesh.part.name, "kind": "panel", "fabric": mesh.part.fabric })
        }
        MeshKind::Body(_) => json!({ "name": mesh.part.name, "kind": "body" }),
    };
    json!({ "name": mesh.name, "mesh": index, "extras": extras })
}

/// View of bytes that are being written.
struct View {
    start: usize,
    index: usize,
    target: Option<u32>,
    stride: Option<usize>,
}

/// Returns `sample` with a position for each normal. A vertex on a crease has several normals.
fn spread(mesh: &Mesh, sample: &Sample) -> Sample {
    match &mesh.kind {
        MeshKind::Panel(_) => sample.clone(),
        MeshKind::Body(creased) => {
            let vertices = creased.vertices.iter();
            let positions = vertices.map(|vertex| sample.positions[*vertex as usize]).collect();
            Sample { positions, normals: sample.normals.clone() }
        }
    }
}

/// Returns the bound of `rows` in each column: the smallest numbers if `pick` is `f32::min`.
fn bound<const N: usize>(rows: &[[f32; N]], pick: fn(f32, f32) -> f32) -> Vec<f32> {
    let first = rows.first().copied().unwrap_or([0.0; N]);
    rows.iter().fold(first, |bound, row| std::array::from_fn(|k| pick(bound[k], row[k]))).to_vec()
}

/// Returns the differences of `rows` from `base`.
fn differences(rows: &[[f32; 3]], base: &[[f32; 3]]) -> Vec<[f32; 3]> {
    rows.iter().zip(base).map(|(row, base)| std::array::from_fn(|k| row[k] - base[k])).collect()
}

#[cfg(test)]
mod tests {
    use drape_frames::Recording;

    use super::*;
    use crate::example;
    use crate::palette::{FabricPalette, light};

    /// Content of a GLB file.
    struct Read {
        document: Value,
        binary: Vec<u8>,
    }

    impl Read {
        fn new(glb: &[u8]) -> Read {
            let word = |at: usize| u32::from_le_bytes(glb[at..at + 4].try_into().unwrap()) as usize;
            assert_eq!((&glb[..4], word(4), word(8)), (&b"glTF"[..], 2, glb.len()));
            let text = word(12);
            assert_eq!((&glb[16..20], text % 4), (&b"JSON"[..], 0));
            let start = 20 + text;
            assert_eq!(&glb[start + 4..start + 8], b"BIN\0");
            let binary = glb[start + 8..].to_vec();
            assert_eq!((word(start), binary.len() % 4), (binary.len(), 0));
            let document: Value = serde_json::from_slice(&glb[20..start]).unwrap();
            // The views follow each other, each from a multiple of four bytes on.
            let mut end = 0;
            for view in document["bufferViews"].as_array().unwrap() {
                let [first, length] =
                    ["byteOffset", "byteLength"].map(|key| Read::number(&view[key]));
                assert_eq!(first, usize::next_multiple_of(end, 4));
                end = first + length;
            }
            assert_eq!(end.next_multiple_of(4), binary.len());
            Read { document, binary }
        }

        fn number(value: &Value) -> usize {
            usize::try_from(value.as_u64().unwrap_or(0)).unwrap()
        }

        /// Reads the numbers of an accessor, as 32 bits each, and checks that they are in their
        /// view.
        fn words(&self, accessor: &Value) -> Vec<[u8; 4]> {
            let accessor = &self.document["accessors"][Read::number(accessor)];
            let view = &self.document["bufferViews"][Read::number(&accessor["bufferView"])];
            let parts = match accessor["type"].as_str() {
                Some("SCALAR") => 1,
                Some("VEC2") => 2,
                _ => 3,
            };
            let length = 4 * parts * Read::number(&accessor["count"]);
            let offset = Read::number(&accessor["byteOffset"]);
            assert!(offset + length <= Read::number(&view["byteLength"]), "{accessor} in {view}");
            let stride = view["byteStride"].as_u64();
            assert!(
                stride.is_none_or(|stride| stride as usize == 4 * parts),
                "{accessor} in {view}"
            );
            let start = offset + Read::number(&view["byteOffset"]);
            self.binary[start..start + length].as_chunks().0.to_vec()
        }

        fn floats<const N: usize>(&self, accessor: &Value) -> Vec<[f32; N]> {
            let numbers: Vec<f32> =
                self.words(accessor).into_iter().map(f32::from_le_bytes).collect();
            let rows = numbers.as_chunks().0.to_vec();
            let accessor = &self.document["accessors"][Read::number(accessor)];
            if let Some(bounds) = accessor["min"].as_array() {
                for (k, least) in bounds.iter().enumerate() {
                    let values = || rows.iter().map(|row: &[f32; N]| row[k]);
                    let single = |bound: &Value| bound.as_f64().map(|bound| bound as f32);
                    assert_eq!(single(least), values().reduce(f32::min));
                    assert_eq!(single(&accessor["max"][k]), values().reduce(f32::max));
                }
            }
            rows
        }
    }

    fn read(times: &[f64]) -> Read {
        let folder = example::folder(times);
        let recording = Recording::open(folder.path()).unwrap();
        let mut glb = Vec::new();
        write_glb(&Clip::new(&recording, 0..=times.len() - 1, None).unwrap(), &mut glb).unwrap();
        Read::new(&glb)
    }

    #[test]
    fn the_mesh_is_the_last_frame_and_the_targets_lead_to_the_others() {
        let times = [0.5, 0.6, 0.7, 0.8];
        let glb = read(&times);
        let names: Vec<&str> =
            (0..3).filter_map(|k| glb.document["nodes"][k]["name"].as_str()).collect();
        assert_eq!(names, ["front", example::HOSTILE, "box"]);
        let primitive = &glb.document["meshes"][1]["primitives"][0];
        let base = glb.floats::<3>(&primitive["attributes"]["POSITION"]);
        let stored = |time: f64| mesh::single(&example::cloth(time)[4..]);
        assert_eq!(base, stored(0.8));
        assert_eq!(primitive["targets"].as_array().map(Vec::len), Some(3));
        for (k, time) in times[..3].iter().enumerate() {
            let moved = glb.floats::<3>(&primitive["targets"][k]["POSITION"]);
            let apart = (0..3)
                .flat_map(|v| (0..3).map(move |p| (v, p)))
                .map(|(v, p)| (base[v][p] + moved[v][p] - stored(*time)[v][p]).abs())
                .fold(0.0, f32::max);
            assert!(apart < 1e-7, "{apart} m");
        }
        assert_eq!(
            glb.floats::<2>(&primitive["attributes"]["TEXCOORD_0"]),
            [[0.0, 1.0], [0.0, 0.5], [-0.25, 1.0]]
        );
        let corners: Vec<u32> =
            glb.words(&primitive["indices"]).into_iter().map(u32::from_le_bytes).collect();
        assert_eq!(corners, [0, 2, 1]);
        let sampler = &glb.document["animations"][0]["samplers"][0];
        assert_eq!(glb.floats::<1>(&sampler["input"]).len(), 4);
        let weights = glb.floats::<1>(&sampler["output"]).concat();
        assert_eq!(weights, [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]);
        let channels = glb.document["animations"][0]["channels"].as_array().unwrap();
        assert_eq!(channels.len(), 2, "the box does not move");
    }

    #[test]
    fn panels_of_several_fabrics_have_the_colours_of_their_fabrics() {
        let colours = |of_back: &str| {
            let folder = example::folder(&[0.0]);
            let path = folder.path().join("surfaces.json");
            let text = std::fs::read_to_string(&path).unwrap();
            let mut manifest: Value = serde_json::from_str(&text).unwrap();
            manifest["panels"][1]["fabric"] = of_back.into();
            std::fs::write(&path, format!("{manifest}\n")).unwrap();
            let recording = Recording::open(folder.path()).unwrap();
            let mut glb = Vec::new();
            write_glb(&Clip::new(&recording, 0..=0, None).unwrap(), &mut glb).unwrap();
            let document = Read::new(&glb).document;
            let palette = FabricPalette::of_runs([&recording]);
            [0, 1].map(|k| {
                let material = &document["materials"][k]["pbrMetallicRoughness"];
                let fabric = manifest["panels"][k]["fabric"].as_str().unwrap();
                let [red, green, blue] = light(palette.sides(fabric)[0]);
                material["baseColorFactor"] == json!([red, green, blue, 1.0])
            })
        };
        assert_eq!(colours("linen"), [true, true]);
        assert!(colours("wool").contains(&false), "panels of one fabric are told apart");
    }

    #[test]
    fn a_body_has_its_creases_and_a_single_frame_no_animation() {
        let glb = read(&[0.0]);
        assert!(glb.document["animations"].is_null());
        let primitive = &glb.document["meshes"][2]["primitives"][0];
        assert!(primitive["targets"].is_null());
        assert_eq!(glb.floats::<3>(&primitive["attributes"]["POSITION"]).len(), 24);
        let corners = glb.words(&primitive["indices"]).into_iter().map(u32::from_le_bytes);
        assert_eq!((corners.clone().count(), corners.max()), (36, Some(23)));
        assert_eq!(glb.document["nodes"][1]["extras"]["fabric"], "wool");
    }

    #[test]
    fn many_frames_are_thinned() {
        let times: Vec<f64> = (0..300).map(|number| f64::from(number) / 50.0).collect();
        let glb = read(&times);
        let mesh = &glb.document["meshes"][0];
        assert_eq!(mesh["weights"].as_array().map(Vec::len), Some(GLB_FRAMES_MAX - 1));
        assert_eq!(mesh["extras"]["targetNames"][0], "frame 0");
        let frames = &glb.document["scenes"][0]["extras"]["frames"];
        assert_eq!(frames[GLB_FRAMES_MAX - 1], 299);
    }
}
