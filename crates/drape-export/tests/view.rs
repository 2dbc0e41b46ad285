//! The viewer's page: what it holds is the run, and no name of a part gets out of its place.

use std::io::Read;

use base64::Engine;
use drape_export::{Named, View};
use drape_frames::Recording;
use drape_frames::samples::{SampleFrame, SampleRun};
use serde_json::Value;
use tempfile::TempDir;

/// A name that would end the element that holds it, if it could.
const HOSTILE: &str = "</script><script>alert('x')</script>&amp;\"";

/// Returns the folder of a run of so many frames, in which a triangle rises 1 m.
fn run(frames: usize) -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let manifest = serde_json::json!({
        "format": 2, "guarded": false, "bodies": [],
        "panels": [{ "name": HOSTILE, "vertices": 3, "triangles": 1 }],
    });
    let frame = |number: usize| {
        let height = number as f64 / frames.saturating_sub(1).max(1) as f64;
        let cloth = vec![[0.0, height, 0.0], [1.01, height, 0.0], [0.0, height, 2.0]];
        SampleFrame { time: 0.1 * number as f64, cloth, bodies: Vec::new() }
    };
    let run = SampleRun {
        manifest: manifest.to_string(),
        material: vec![[0.0, 0.0], [1.0, 0.0], [0.0, 2.0]],
        triangles: vec![[0, 1, 2]],
        body_triangles: Vec::new(),
        frames: (0..frames).map(frame).collect(),
    };
    run.write(folder.path()).expect("writes");
    folder
}

fn page(folder: &TempDir, size: usize) -> View {
    let recording = Recording::open(folder.path()).expect("a run");
    let runs = [Named { name: HOSTILE, recording: &recording }];
    View::new(&runs, size).expect("a page")
}

/// Returns what a page says of its first run.
fn meta(html: &str) -> Value {
    serde_json::from_str(element(html, "run-0")).expect("JSON")
}

/// Returns what stands in the element of a page between its opening tag and its end.
fn element<'a>(html: &'a str, id: &str) -> &'a str {
    let (_, rest) = html.split_once(&format!("id=\"{id}\">")).expect("the element");
    rest.split_once("</script>").expect("its end").0
}

#[test]
fn positions_and_fields_come_back_to_the_fraction_that_is_said() {
    let view = page(&run(5), 20_000_000);
    assert_eq!(view.frames, [[0, 1, 2, 3, 4]]);
    let meta = meta(&view.html);
    let data = element(&view.html, "data-0");
    let data = base64::engine::general_purpose::STANDARD.decode(data).expect("base64");
    let mut bytes = Vec::new();
    flate2::read::ZlibDecoder::new(&data[..]).read_to_end(&mut bytes).expect("deflated");
    let corners: Vec<u32> =
        bytes[..12].chunks(4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
    assert_eq!(corners, [0, 1, 2]);
    // Three vertices with two material coordinates of four bytes follow, then the frames.
    let mut at = 12 + 24;
    let mut words = [0_u16; 9];
    for frame in 0..5 {
        for (k, word) in words.iter_mut().enumerate() {
            let difference = u16::from(bytes[at + k]) | u16::from(bytes[at + 9 + k]) << 8;
            *word = word.wrapping_add(difference);
        }
        at += 18;
        for vertex in 0..3 {
            let axis = |k: usize| {
                let end = |corner: usize| meta["box"][corner][k].as_f64().expect("a number");
                end(0) + (end(1) - end(0)) * f64::from(words[3 * vertex + k]) / 65535.0
            };
            let expected = [[0.0, 0.0], [1.01, 0.0], [0.0, 2.0]][vertex];
            assert!((axis(0) - expected[0]).abs() < 1e-5 && (axis(2) - expected[1]).abs() < 2e-5);
            assert!((axis(1) - 0.25 * f64::from(frame)).abs() < 1e-5, "{frame}: {}", axis(1));
        }
    }
    // Fields, in the order of their list, a byte for a vertex: the strain along the weft is 1 %.
    let fields = meta["fields"].as_array().expect("fields");
    let weft = fields.iter().position(|field| field["key"] == "strain-weft").expect("it is there");
    let level = f64::from(bytes[at + weft * 5 * 3]);
    let end = |name: &str| fields[weft][name].as_f64().expect("a number");
    let value = end("low") + (end("high") - end("low")) * level / 255.0;
    assert!((value - 1.0).abs() <= 0.5 * (end("high") - end("low")) / 255.0 + 1e-12, "{value}");
    let speed = fields.iter().find(|field| field["key"] == "speed").expect("it is there");
    assert_eq!((speed["unit"].as_str(), speed["high"].as_f64()), (Some("m/s"), Some(5.0)));
}

/// Writes the manifest of panels of some fabrics, each with a stated colour or none.
fn write_fabrics(folder: &TempDir, fabrics: &[(&str, Option<&str>)]) {
    let panel = |(number, (fabric, colour)): (usize, &(&str, Option<&str>))| {
        let triangles = usize::from(number == 0);
        serde_json::json!({
            "name": format!("panel {number}"), "vertices": 3 * triangles, "triangles": triangles,
            "fabric": fabric, "colour": colour,
        })
    };
    let panels: Vec<Value> = fabrics.iter().enumerate().map(panel).collect();
    let manifest =
        serde_json::json!({ "format": 2, "guarded": false, "bodies": [], "panels": panels });
    std::fs::write(folder.path().join("surfaces.json"), format!("{manifest}\n")).expect("writes");
}

#[test]
fn a_legend_names_the_fabrics_of_all_runs_in_the_colours_of_their_panels() {
    let folders = [run(1), run(1)];
    write_fabrics(&folders[0], &[("wool", None), ("linen", None)]);
    write_fabrics(&folders[1], &[("wool", None), (HOSTILE, Some("#b03a2e"))]);
    let recordings = folders.each_ref().map(|own| Recording::open(own.path()).expect("a run"));
    let runs = recordings.each_ref().map(|recording| Named { name: "run", recording });
    let html = View::new(&runs, 20_000_000).expect("a page").html;
    let legend: Value = serde_json::from_str(element(&html, "fabrics-data")).expect("JSON");
    let legend = legend.as_array().expect("a list");
    let names: Vec<&str> = legend.iter().filter_map(|own| own["name"].as_str()).collect();
    assert_eq!(names, [HOSTILE, "linen", "wool"]);
    assert_eq!(legend[0]["colour"], "#b03a2e");
    for number in 0..2 {
        let meta: Value =
            serde_json::from_str(element(&html, &format!("run-{number}"))).expect("JSON");
        for panel in meta["panels"].as_array().expect("panels") {
            let own = legend.iter().find(|own| own["name"] == panel["fabric"]);
            assert_eq!(own.expect("in the legend")["colour"], panel["colour"]);
        }
    }
    // A fabric that is alone keeps the usual colours, and needs no legend.
    write_fabrics(&folders[0], &[("wool", None), ("wool", None)]);
    let html = page(&folders[0], 20_000_000).html;
    assert_eq!(element(&html, "fabrics-data"), "[]");
    let panel = &meta(&html)["panels"][0];
    assert_eq!([&panel["colour"], &panel["back"]], ["#96b6d6", "#e2c496"]);
}

#[test]
fn each_fabric_has_its_colour() {
    let folder = run(1);
    let panel = |fabric: &str, n: usize| serde_json::json!({ "name": fabric, "vertices": n, "triangles": n / 3, "fabric": fabric });
    let panels = [panel("linen", 3), panel("wool", 0), panel("cotton", 0), panel("wool", 0)];
    let manifest =
        serde_json::json!({ "format": 2, "guarded": false, "bodies": [], "panels": panels });
    std::fs::write(folder.path().join("surfaces.json"), format!("{manifest}\n")).expect("writes");
    let meta = meta(&page(&folder, 20_000_000).html);
    let panels = meta["panels"].as_array().expect("a list").iter();
    let colours: Vec<&Value> = panels.map(|panel| &panel["colour"]).collect();
    assert_eq!(colours[1], colours[3], "of one fabric");
    let mut three = colours[..3].to_vec();
    three.sort_by_key(|colour| colour.to_string());
    three.dedup();
    assert_eq!(three.len(), 3, "{colours:?}");
}

#[test]
fn no_name_ends_its_element() {
    let html = page(&run(2), 20_000_000).html;
    assert!(!html.contains("alert('x')<") && !html.contains("<script>alert"));
    let (_, title) = html.split_once("<title>").expect("a title");
    assert!(title.starts_with("&lt;/script&gt;&lt;script&gt;alert('x')&lt;/script&gt;&amp;amp;"));
    let meta = meta(&html);
    assert_eq!((&meta["name"], &meta["panels"][0]["name"]), (&HOSTILE.into(), &HOSTILE.into()));
    // The page loads nothing.
    assert!(!html.contains("src=\"http") && !html.contains("@import"));
    assert!(!html.contains("{{"), "every place is filled");
}

#[test]
fn frames_are_left_out_evenly_until_the_page_is_small_enough() {
    let folder = run(41);
    let all = page(&folder, 20_000_000);
    assert_eq!(all.frames[0].len(), 41);
    let few = page(&folder, 0);
    assert_eq!(few.frames, [[0, 40]]);
    assert!(few.html.len() < all.html.len() && few.html.contains("2 of 41 frames"));
    let half = page(&folder, all.html.len() - 200);
    let steps: Vec<usize> = half.frames[0].windows(2).map(|pair| pair[1] - pair[0]).collect();
    assert!(half.frames[0].len() < 41 && half.html.len() < all.html.len(), "{steps:?}");
    assert!(steps[..steps.len() - 1].iter().all(|step| *step == steps[0]), "{steps:?}");
    assert_eq!(half.frames[0].last(), Some(&40));
}
