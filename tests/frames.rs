//! Frames that a run stores, how `drape check` verifies them, and how `drape export` writes them
//! for other programs.

#[path = "frames/export.rs"]
mod export;
#[path = "frames/picture.rs"]
mod picture;
#[path = "frames/verdict.rs"]
mod verdict;

use std::path::{Path, PathBuf};
use std::process::Output;

use assert_cmd::Command;
use drape::collide::{ContactDistances, Surface, SurfaceParts, intersections};
use drape::frames::samples::{SampleFrame, SampleRun};
use drape::frames::{Frame, Recording};
use drape::verify::Verifier;
use serde_json::Value;
use tempfile::TempDir;

const FABRIC: &str = include_str!("fabrics/plain-weave.toml");

/// Scene of two sheets that fall on a rising table.
const SCENE: &str = r#"spacing = 0.02
fabric.plain.file = "plain.toml"
[[panel]]
name = "lower"
fabric = "plain"
rectangle = [0.2, 0.2]
center = [0, 0.002, 0]
turn = [-90, 0, 0]
[[panel]]
name = "upper"
fabric = "plain"
rectangle = [0.2, 0.2]
center = [0, 0.004, 0]
turn = [-90, 20, 0]
[[collider.box]]
name = "table"
size = [0.1, 0.05, 0.1]
center = [0, -0.026, 0]
friction = 0.3
[collider.box.motion]
times = [0.02, 0.06]
shift = [[0, 0, 0], [0, 0.01, 0]]
[contact]
surfaces = true
[time]
step = 0.005
end = 0.06
[output]
every = 0.02
folder = "results"
"#;

fn drape(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::cargo_bin("drape").expect("the binary is built");
    command.current_dir(folder).args(arguments).output().expect("it runs")
}

/// Returns a folder with the results of the scene.
fn results() -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("plain.toml"), FABRIC).expect("writes");
    std::fs::write(folder.path().join("scene.toml"), SCENE).expect("writes");
    let output = drape(folder.path(), &["run", "scene.toml"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    folder
}

/// Checks the results; returns the exit code, the messages, and the frames as JSON.
fn check(folder: &Path) -> (Option<i32>, String, Value) {
    let output = drape(folder, &["check", "results", "--json"]);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    let found: Value = serde_json::from_slice(&output.stdout).unwrap_or_default();
    (output.status.code(), said, found[0].clone())
}

fn change(folder: &Path, file: &str, change: impl FnOnce(Vec<u8>) -> Vec<u8>) {
    let path = folder.join("results").join(file);
    let bytes = std::fs::read(&path).expect("reads");
    std::fs::write(&path, change(bytes)).expect("writes");
}

/// Takes the hashes of the frames out of their list, so that a frame can be changed as another
/// program would write it.
fn without_hashes(folder: &Path) {
    change(folder, "frames.csv", |list| {
        let list = String::from_utf8(list).expect("a text");
        let lines = list.lines().map(|line| line.rsplit_once(',').expect("columns").0);
        lines.fold(String::new(), |text, line| text + line + "\n").into_bytes()
    });
}

/// Length of the header of an array, in bytes.
const HEADER: usize = 128;

/// Returns a frame with one vertex moved.
fn moved(mut frame: Vec<u8>, vertex: usize, place: [f64; 3]) -> Vec<u8> {
    let at = HEADER + 24 * vertex;
    let bytes: Vec<u8> = place.into_iter().flat_map(f64::to_le_bytes).collect();
    frame[at..at + 24].copy_from_slice(&bytes);
    frame
}

/// Returns the height of a vertex of a frame, in m.
fn height(frame: &[u8], vertex: usize) -> f64 {
    let at = HEADER + 24 * vertex + 8;
    f64::from_le_bytes(frame[at..at + 8].try_into().expect("eight bytes"))
}

#[test]
fn frames_of_a_run_pass_with_the_bodies_where_they_were() {
    let folder = results();
    let (code, said, found) = check(folder.path());
    assert_eq!((code, said.as_str()), (Some(0), ""), "{found:#}");
    let frames = found["frames"].as_array().expect("frames");
    assert_eq!((frames.len(), &found["ended"]), (4, &Value::Bool(true)));
    let distances: Vec<f64> = frames.iter().filter_map(|f| f["min_distance"].as_f64()).collect();
    let summary = std::fs::read(folder.path().join("results/summary.json")).expect("reads");
    let summary: Value = serde_json::from_slice(&summary).expect("JSON");
    let least = summary["contact"]["min_distance"].as_f64().expect("something was near");
    let seen = distances.iter().copied().fold(f64::INFINITY, f64::min);
    // The run tests every step, of which the frames are some.
    assert!(seen >= least * (1.0 - 1e-12) && seen < 1e-3, "{seen} of {least}");
    assert!(frames.iter().all(|f| f["intersections"] == 0 && f["pairs"].as_u64() > Some(0)));
    // The table is stored where it has moved, in frames in which it has.
    let stored = |number: usize| folder.path().join(format!("results/bodies-{number:05}.npy"));
    assert_eq!([0, 1, 2, 3].map(|number| stored(number).exists()), [true, false, true, true]);
    // With the table of the last frame, the first frame has an intersection.
    without_hashes(folder.path());
    std::fs::copy(stored(3), stored(0)).expect("copies");
    assert_eq!(check(folder.path()).0, Some(4));
}

#[test]
fn every_frame_has_its_pressures_and_its_energy() {
    let folder = results();
    let results = folder.path().join("results");
    let recording = Recording::open(&results).expect("a run");
    let frames: Vec<Frame> = (0..recording.frame_count())
        .map(|number| recording.frame(number).expect("reads"))
        .collect();
    let pressures = |number: usize| frames[number].pressures.as_ref().expect("they are kept apart");
    let largest = |number: usize| pressures(number).iter().copied().fold(0.0, f64::max);
    // Sheets of a tenth of a kilogram per square metre press by a few pascals where they lie.
    assert!((0.1..1e4).contains(&largest(3)), "{} Pa", largest(3));
    let summary = std::fs::read(results.join("summary.json")).expect("reads");
    let summary: Value = serde_json::from_slice(&summary).expect("JSON");
    let energy = recording.energy().expect("reads").expect("the balance is kept");
    assert_eq!(energy.rows.len(), 4);
    for (name, value) in energy.names.iter().zip(energy.rows[3].as_ref().expect("it is kept")) {
        assert_eq!(Some(*value), summary["energy"][name].as_f64(), "{name}");
    }
    // A frame takes 24 bytes for a vertex, and 2 more where something touches.
    for (number, frame) in frames.iter().enumerate() {
        let length = |kind: &str| {
            let file = results.join(format!("{kind}-{number:05}.npy"));
            std::fs::metadata(file).map_or(0, |found| found.len() as usize)
        };
        let count = frame.cloth.len();
        assert_eq!(length("frame"), HEADER + 24 * count);
        let touched = pressures(number).iter().any(|pressure| *pressure > 0.0);
        assert_eq!(length("pressure"), if touched { HEADER + 2 * count } else { 0 });
    }
}

#[test]
fn a_sheet_that_pokes_through_is_found_with_its_frame_and_triangles() {
    let folder = results();
    without_hashes(folder.path());
    // A corner of the upper sheet, of one triangle or two, is moved below the lower one near its
    // middle.
    let first_of_upper = 11 * 11;
    change(folder.path(), "frame-00002.npy", |frame| {
        moved(frame, first_of_upper, [0.0, -0.05, 0.0])
    });
    let (code, said, found) = check(folder.path());
    assert_eq!(code, Some(4), "{said}");
    assert!(said.contains("frame-00002.npy") && said.contains("in 1 frame,"), "{said}");
    for (number, frame) in found["frames"].as_array().expect("frames").iter().enumerate() {
        let meeting = frame["intersections"].as_u64().expect("a count");
        assert_eq!(meeting > 0, number == 2, "{frame:#}");
    }
    let worst = found["frames"][2]["worst"].as_array().expect("places");
    let of_corner = worst
        .iter()
        .find(|place| place["parts"] == serde_json::json!([{ "panel": 0 }, { "panel": 1 }]));
    let triangle = of_corner.expect("a place")["triangles"][1].as_u64();
    assert!(triangle <= Some(1), "a triangle at the corner, not {triangle:?}");
    let output = drape(folder.path(), &["check", "results"]);
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(text.contains("of \"lower\" and triangle 0 of \"upper\" intersect"), "{text}");
}

#[test]
fn the_smallest_step_through_is_seen() {
    let folder = results();
    without_hashes(folder.path());
    // In the first frame both sheets are level but for rounding. A vertex is moved to just below
    // and just above the lower sheet.
    let touching = |height: f64| {
        change(folder.path(), "frame-00000.npy", |frame| {
            moved(frame, 11 * 11, [0.001, height, 0.0])
        });
        let found = check(folder.path()).2;
        let frame = &found["frames"][0];
        (frame["intersections"].as_u64() > Some(0), frame["too_near"].as_u64() > Some(0))
    };
    let frame = std::fs::read(folder.path().join("results/frame-00000.npy")).expect("reads");
    let height = height(&frame, 0);
    assert_eq!(touching(height - 1e-15), (true, true), "at {height}");
    assert_eq!(touching(height + 1e-15), (false, true), "at {height}");
    assert_eq!(
        touching(height + 0.35 * 0.0004 + 1e-12),
        (false, false),
        "the minimum separation holds"
    );
}

/// Returns an array with another first byte.
fn first_byte(mut array: Vec<u8>, byte: u8) -> Vec<u8> {
    array[HEADER] = byte;
    array
}

/// Returns bytes with one text in place of another of the same length.
fn text_in(mut bytes: Vec<u8>, old: &str, new: &str) -> Vec<u8> {
    let at = bytes.windows(old.len()).position(|part| part == old.as_bytes()).expect("the text");
    bytes[at..at + new.len()].copy_from_slice(new.as_bytes());
    bytes
}

#[test]
fn files_that_are_not_as_they_were_written_are_named() {
    type Change = fn(Vec<u8>) -> Vec<u8>;
    fn text(bytes: Vec<u8>, change: impl FnOnce(String) -> String) -> Vec<u8> {
        change(String::from_utf8(bytes).expect("a text")).into_bytes()
    }
    let cases: [(&str, Change, &[&str]); 13] = [
        ("frame-00001.npy", |f| f[..f.len() - 1].into(), &["frame-00001.npy", "cut off"]),
        ("frame-00001.npy", |f| f[..f.len() / 2].into(), &["frame-00001.npy", "cut off"]),
        ("frame-00001.npy", |f| moved(f, 7, [f64::NAN, 0.0, 0.0]), &["row 7", "NaN"]),
        ("frame-00001.npy", |f| moved(f, 7, [0.0, f64::INFINITY, 0.0]), &["row 7", "inf"]),
        ("frame-00001.npy", |f| [f, vec![0; 24]].concat(), &["5832 bytes", "242 vertices"]),
        ("frame-00001.npy", |f| text_in(f, "<f8", "<f4"), &["no table of numbers <f8"]),
        ("triangles.npy", |f| first_byte(f, 200), &["triangle 0", "its part"]),
        ("frames.csv", |f| text(f, |t| t.replace("\n2,", "\n5,")), &["line 4", "numbered"]),
        ("bodies-00002.npy", |_| Vec::new(), &["bodies-00002.npy", "cut off"]),
        (
            "surfaces.json",
            |f| text(f, |t| t.replace("\"format\": 2", "\"format\": 9")),
            &["format 9"],
        ),
        (
            "surfaces.json",
            |f| text(f, |t| t.replace("242", "-1").replace("121", "-1")),
            &["surfaces.json, line"],
        ),
        (
            "surfaces.json",
            |f| text(f, |t| t.replacen("\"format\"", "\"thinned\": 2, \"format\"", 1)),
            &["2 is no fraction of a distance"],
        ),
        (
            "surfaces.json",
            |f| text(f, |t| t.replacen("1.0", "1.5", 1)),
            &["the weft of \"lower\" has no direction"],
        ),
    ];
    let folder = results();
    for (file, break_it, words) in cases {
        let path = folder.path().join("results").join(file);
        let right = std::fs::read(&path).expect("reads");
        change(folder.path(), file, break_it);
        let (code, said, _) = check(folder.path());
        assert_eq!(code, Some(3), "{words:?}: {said}");
        for word in words {
            assert!(said.contains(word), "{word:?} is missing in: {said}");
        }
        std::fs::write(&path, right).expect("writes");
    }
    let gone = |name: &str| {
        let path: PathBuf = folder.path().join("results").join(name);
        let right = std::fs::read(&path).expect("reads");
        std::fs::remove_file(&path).expect("removes");
        let (code, said, _) = check(folder.path());
        std::fs::write(&path, right).expect("writes");
        assert_eq!(code, Some(3), "{name}: {said}");
        assert!(said.contains(name), "{name}: {said}");
    };
    ["frame-00000.npy", "frame-00003.npy", "bodies-00000.npy", "surfaces.json", "frames.csv"]
        .into_iter()
        .for_each(gone);
    assert_eq!(check(folder.path()).0, Some(0), "all is as it was");
}

/// Returns vertices and triangles of a level sheet with a number of vertices a side, turned and
/// bent, at a height.
fn sheet(side: usize, height: f64, turn: f64) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let places = (0..side * side).map(|k| {
        let [u, v] = [k % side, k / side].map(|k| 0.01 * k as f64 - 0.005 * (side - 1) as f64);
        let (x, z) = (u * turn.cos() - v * turn.sin(), u * turn.sin() + v * turn.cos());
        [x, height + 0.004 * (70.0 * x + 9.0 * turn).sin() * (50.0 * z).cos(), z]
    });
    let at = |row: usize, column: usize| (row * side + column) as u32;
    let cells = (0..side - 1).flat_map(|row| (0..side - 1).map(move |column| (row, column)));
    let triangles = cells.flat_map(|(row, column)| {
        let [a, b] = [at(row, column), at(row, column + 1)];
        let [c, d] = [at(row + 1, column), at(row + 1, column + 1)];
        [[a, b, d], [a, d, c]]
    });
    (places.collect(), triangles.collect())
}

#[test]
fn two_tests_that_share_no_code_find_the_same_pairs() {
    let sheets: Vec<_> = (0..4).map(|k| sheet(24, 0.002 * k as f64, 0.3 * k as f64)).collect();
    let mut parts = SurfaceParts {
        rest_positions: Vec::new(),
        triangles: Vec::new(),
        areas: vec![1e-4; 4 * 576],
        groups: (0..4).flat_map(|k| [k; 576]).collect(),
        distances: vec![ContactDistances { activation_distance: 1e-3, min_separation: 1e-4 }; 4],
        free_vertices: 4 * 576,
        seam_pairs: Vec::new(),
        ties: Vec::new(),
    };
    let mut places = Vec::new();
    for (k, (vertices, triangles)) in sheets.iter().enumerate() {
        parts
            .rest_positions
            .extend(sheet(24, 0.0, 0.0).0.iter().flat_map(|[x, _, z]| [*x, *z, 0.0]));
        parts.triangles.extend(triangles.iter().map(|t| t.map(|v| v + 576 * k as u32)));
        places.extend(vertices.iter().flatten().copied());
    }
    let panel =
        r#"{ "name": "", "vertices": 576, "triangles": 1058, "reach": 1e-3, "separation": 1e-4 }"#;
    let panels = [panel; 4].join(", ");
    let points = places.chunks_exact(3).map(|p| [p[0], p[1], p[2]]);
    let run = SampleRun {
        manifest: format!(
            "{{ \"format\": 2, \"guarded\": true, \"panels\": [{panels}], \"bodies\": [] }}"
        ),
        material: parts.rest_positions.chunks_exact(3).map(|p| [p[0], p[1]]).collect(),
        triangles: parts.triangles.clone(),
        body_triangles: Vec::new(),
        frames: vec![SampleFrame { cloth: points.collect(), ..SampleFrame::default() }],
    };
    let folder = tempfile::tempdir().expect("a folder");
    run.write(folder.path()).expect("writes");
    let verdict = Verifier::open(folder.path()).and_then(|verifier| verifier.verify(0));
    let verdict = verdict.expect("a right frame");

    // An edge that intersects a triangle makes a pair with each triangle that has the edge.
    let surface = Surface::new(parts).expect("a right surface");
    let found = intersections(&surface, &places).expect("right places");
    let triangles = surface.triangles();
    let mut pairs: Vec<[u32; 2]> = Vec::new();
    for crossing in found {
        let edge = surface.edges()[crossing.edge as usize];
        for (number, triangle) in triangles.iter().enumerate() {
            if edge.iter().all(|end| triangle.contains(end)) {
                let (a, b) = (number as u32, crossing.triangle);
                pairs.push([a.min(b), a.max(b)]);
            }
        }
    }
    pairs.sort_unstable();
    pairs.dedup();
    assert!(pairs.len() > 1000, "{} pairs meet", pairs.len());
    assert_eq!(verdict.intersections, pairs.len());
}
