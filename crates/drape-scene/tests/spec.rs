//! A spec says what a text says: it is written and read again without a loss, and its mistakes are
//! the mistakes of the text.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use drape_collide::Triangulation;
use drape_fabric::Fabric;
use drape_fabric::samples::PLAIN_WEAVE;
use drape_input::{Document, KeyPath};
use drape_scene::{
    Axis, FabricSpec, FileOr, HoldUntil, LengthUnit, MeshMotion, MeshSpec, MotionSpec, NoiseSpec,
    PanelSpec, PinSpec, Pinch, Scene, SceneSpec, SettleSpec, Sources, SphereSpec, StackSpec,
    TimeSpec,
};
use proptest::prelude::*;

fn fabric() -> Arc<Fabric> {
    Arc::new(Fabric::from_document(&Document::new("plain.toml", PLAIN_WEAVE)).expect("a fabric"))
}

/// A closed box with corners that no short decimal number has.
fn cuboid() -> Triangulation {
    let ends = [-0.1 / 3.0, 0.1 / 7.0];
    let corner = |k: usize| [ends[k & 1], ends[k >> 1 & 1] - 0.2, ends[k >> 2 & 1]];
    let faces =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    Triangulation {
        vertices: (0..8).map(corner).collect(),
        triangles: faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect(),
    }
}

/// A towel over a box, all of it in memory.
fn towel() -> SceneSpec {
    let mut spec = SceneSpec { spacing: 0.02, ..SceneSpec::default() };
    let file = FileOr::Value(fabric());
    spec.fabric.insert("plain".into(), FabricSpec { file, ..FabricSpec::default() });
    spec.panel.push(PanelSpec {
        name: "towel".into(),
        fabric: "plain".into(),
        rectangle: Some([0.2, 0.3]),
        turn: [-90.0, 0.0, 0.0],
        ..PanelSpec::default()
    });
    let file = FileOr::Value(Arc::new(cuboid()));
    spec.collider.mesh.push(MeshSpec { file, ..MeshSpec::default() });
    spec
}

/// Returns the folder of the scenes that the project ships.
fn shipped() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes")
}

#[test]
fn shipped_scenes_are_written_and_read_again_without_a_loss() {
    let mut count = 0;
    for entry in std::fs::read_dir(shipped()).expect("the scenes") {
        let path = entry.expect("a file").path();
        if path.extension().is_none_or(|ending| ending != "toml") {
            continue;
        }
        let document = Document::read(&path).expect("a text");
        let spec = SceneSpec::from_document(&document).expect("a scene").in_metres();
        let text = spec.to_toml().expect("it names files");
        let again = SceneSpec::from_document(&Document::new(&path, text)).expect("a scene");
        assert_eq!(again, spec, "{}", path.display());
        count += 1;
    }
    assert!(count > 30, "{count} scenes");
}

/// Returns a strategy for any finite number but −0, which a text does not keep apart from 0.
fn number() -> impl Strategy<Value = f64> {
    any::<f64>().prop_filter("finite", |x| x.is_finite() && (*x != 0.0 || x.is_sign_positive()))
}

prop_compose! {
    fn panel()(
        name in "[a-z \"\\\\é]{1,9}",
        size in prop::option::of(prop::array::uniform2(number())),
        disc in prop::option::of(number()),
        grain in number(),
        center in prop::array::uniform3(number()),
        velocity in prop::array::uniform3(number()),
        noise in prop::option::of((number(), prop::option::of(number()), 0..u64::MAX / 2)),
        count in 1..9_usize,
    ) -> PanelSpec {
        PanelSpec {
            name,
            fabric: "plain".into(),
            rectangle: size,
            disc,
            grain,
            center,
            velocity,
            noise: noise.map(|(amplitude, length, seed)| NoiseSpec { amplitude, length, seed }),
            stack: Some(StackSpec { count, step: center, turn: velocity }),
            ..PanelSpec::default()
        }
    }
}

prop_compose! {
    fn any_spec()(
        panel in prop::collection::vec(panel(), 0..4),
        numbers in prop::array::uniform8(number()),
        times in prop::collection::vec(number(), 0..4),
        flags in prop::array::uniform4(any::<bool>()),
        heights in prop::collection::btree_map("[a-z. ]{1,5}", number(), 0..3),
    ) -> SceneSpec {
        let [a, b, c, d, e, f, g, h] = numbers;
        let motion = MotionSpec { times, shift: vec![[a, b, c]], ..MotionSpec::default() };
        let mut spec = towel();
        spec.fabric.get_mut("plain").expect("it has one").file = "plain.toml".into();
        spec.collider.mesh[0].file = "body.obj".into();
        spec.collider.mesh[0].scale = Some(d);
        spec.collider.mesh[0].motion = flags[0].then(|| MeshMotion::Keys(motion.clone()));
        spec.collider.sphere.push(SphereSpec { radius: e, friction: Some(f), ..SphereSpec::default() });
        spec.panel = panel;
        spec.pin.push(PinSpec {
            panel: "towel".into(),
            points: vec![[a, h]],
            axes: flags[1].then(|| vec![Axis::Y, Axis::X]),
            until: if flags[2] { HoldUntil::Rest } else { HoldUntil::End },
            motion: Some(motion),
            ..PinSpec::default()
        });
        spec.contact.pinch = if flags[3] { Pinch::Thin } else { Pinch::Release };
        spec.contact.offset = g;
        spec.settle = flags[0].then(|| SettleSpec { stride: Some(a), ..SettleSpec::default() });
        spec.time = TimeSpec { step: b, end: c, error: Some(d), ..TimeSpec::default() };
        spec.fabric.get_mut("plain").expect("it has one").set = heights;
        spec
    }
}

proptest! {
    #[test]
    fn a_random_spec_is_read_as_it_was_written(spec in any_spec()) {
        let text = spec.to_toml().expect("it names files");
        let again = SceneSpec::from_document(&Document::new("scene.toml", &text));
        prop_assert_eq!(again.expect(&text), spec);
    }
}

#[test]
fn a_spec_in_memory_is_the_scene_of_its_folder_to_the_bit() {
    let mut spec = towel();
    let moved = |shift: f64| {
        let vertices = cuboid().vertices;
        vertices.into_iter().map(|[x, y, z]| [x, y - shift / 3.0, z]).collect()
    };
    let frames: Vec<Vec<[f64; 3]>> = vec![moved(0.0), moved(0.01), moved(0.02)];
    spec.collider.mesh[0].motion = Some(MeshMotion::Frames(Arc::new(frames)));
    spec.collider.mesh[0].rate = Some(10.0);
    let built = spec.build().expect("a scene");

    let folder = tempfile::tempdir().expect("a folder");
    spec.save(folder.path()).expect("it can be written");
    let read = Scene::read(folder.path().join("scene.toml")).expect("a scene");
    assert_eq!(read.start, built.start);
    assert_eq!(read.source.parts, built.source.parts);
    assert_eq!(read.source.hash, built.source.hash);
    assert_eq!(read.bodies[0].motion, built.bodies[0].motion);
    assert_eq!(format!("{:?}", read.bodies[0].body), format!("{:?}", built.bodies[0].body));

    // Fewer frames in the same folder are not read with the last ones of before.
    std::fs::write(folder.path().join("body-1-frame-own.obj"), "").expect("a file of the user");
    spec.collider.mesh[0].motion =
        Some(MeshMotion::Frames(Arc::new(vec![moved(0.0), moved(0.03)])));
    let built = spec.build().expect("a scene");
    spec.save(folder.path()).expect("it can be written");
    let read = Scene::read(folder.path().join("scene.toml")).expect("a scene");
    assert_eq!(read.bodies[0].motion, built.bodies[0].motion);
    assert!(folder.path().join("body-1-frame-own.obj").exists());
}

#[test]
fn a_spec_stays_as_it_is_and_can_be_edited_and_built_again() {
    let mut spec = towel();
    let before = spec.clone();
    let coarse = spec.build().expect("a scene");
    assert_eq!(spec, before);
    spec.set("spacing", "\"10 mm\"").expect("a spacing");
    spec.set("panel[0].center", "[0, 0.1, 0]").expect("a place");
    assert_eq!((spec.spacing, spec.panel[0].center), (0.01, [0.0, 0.1, 0.0]));
    assert_eq!(spec.collider, before.collider, "what is in memory stays");
    let fine = spec.build().expect("a scene");
    assert!(fine.start.positions.len() > 3 * coarse.start.positions.len());
    let mistakes = spec.set("panel[3].center", "[0, 0, 0]").expect_err("there is no such panel");
    assert!(mistakes.to_string().contains("has no element 3"), "{mistakes}");
}

#[test]
fn the_hash_is_the_digest_of_what_is_said() {
    let hash = |text: &str| {
        let documents = [Document::new("plain.toml", PLAIN_WEAVE)];
        let scene = Scene::from_documents(&Document::new("towel.toml", text), &documents);
        scene.expect(text).source.hash
    };
    let text = "spacing = 0.02\nfabric.plain.file = \"plain.toml\"\n[[panel]]\nname = \"towel\"\n\
                fabric = \"plain\"\nrectangle = [0.2, 0.3]\n[time]\nstep = 0.004\nend = 0.1\n";
    let same = [
        text.replace('\n', "\r\n"),
        format!("#:schema scene.json\n# A towel.\n{text}"),
        format!("length = \"cm\"\n{}", text.replace("0.02", "2").replace("[0.2, 0.3]", "[20, 30]")),
        text.replace("0.02", "\"20 mm\"")
            .replace("step = 0.004\nend = 0.1", "end = 0.1\nstep = 0.004"),
        text.replace("name = \"towel\"\n", "name = \"towel\"\ncenter = [0, 0, 0]\n"),
    ];
    for other in same {
        assert_eq!(hash(&other), hash(text), "{other}");
    }
    let mut spec = towel();
    spec.collider.mesh.clear();
    spec.panel[0].turn = [0.0; 3];
    spec.time = TimeSpec { step: 0.004, end: 0.1, ..TimeSpec::default() };
    assert_eq!(spec.build().expect("a scene").source.hash, hash(text), "the door does not count");
    for other in [text.replace("0.004", "0.005"), text.replace("[0.2", "[0.21")] {
        assert_ne!(hash(&other), hash(text), "{other}");
    }
}

#[test]
fn both_doors_answer_a_mistake_alike() {
    let wrong: [fn(&mut SceneSpec); 9] = [
        |spec| spec.spacing = -1.0,
        |spec| spec.gravity[1] = f64::NAN,
        |spec| spec.panel[0].fabric = "plane".into(),
        |spec| spec.panel[0].name = String::new(),
        |spec| spec.panel[0].rectangle = Some([0.2, 2e4]),
        |spec| spec.time.step = 5.0,
        |spec| spec.pin.push(PinSpec { panel: "towl".into(), ..PinSpec::default() }),
        |spec| spec.contact.stiffness = Some(1.0),
        |spec| spec.panel[0].center = [0.0, -0.2, 0.0],
    ];
    let sources = Sources::new(Path::new(""));
    for (number, change) in wrong.into_iter().enumerate() {
        let mut spec = towel();
        change(&mut spec);
        let error = spec.build().expect_err("it is wrong");
        let mistakes = match &error {
            drape_scene::Error::Input(mistakes) => mistakes,
            drape_scene::Error::Tangled(tangle) => &tangle.mistakes,
            other => panic!("{other}"),
        };
        let folder = tempfile::tempdir().expect("a folder");
        spec.save(folder.path()).expect("it can be written");
        let document = Document::read(folder.path().join("scene.toml")).expect("a text");
        // A text cannot say NaN.
        let Ok(_) = SceneSpec::from_document(&document) else {
            assert_eq!(number, 1);
            continue;
        };
        let read = Scene::from_document(&document, sources.fabrics).expect_err("it is wrong");
        let shown: Vec<String> =
            mistakes.0.iter().map(|m| document.locate(m).to_string()).collect();
        assert_eq!(shown.join("\n"), read.to_string(), "{number}");
        for mistake in &mistakes.0 {
            assert!(mistake.file.as_os_str().is_empty() && mistake.line.is_none(), "{mistake:?}");
            let key = mistake.key.as_ref().expect("a key").to_string();
            assert!(mistake.message.starts_with(&key), "{mistake}");
            assert_eq!(KeyPath::from(key.as_str()).to_string(), key);
        }
    }
}

#[test]
fn a_name_of_a_file_needs_its_folder() {
    let mut spec = towel();
    spec.fabric.get_mut("plain").expect("it has one").file = "plain.toml".into();
    let error = spec.build().expect_err("there is no folder").to_string();
    assert!(error.contains("fabric.plain.file: names a file"), "{error}");
    spec.collider.mesh[0].motion = Some(MeshMotion::File("walk.pc2".into()));
    let error = spec.build().expect_err("there is no folder").to_string();
    assert!(error.contains("collider.mesh[0].motion: names a file"), "{error}");
    spec.collider.mesh[0].motion = None;
    let documents = [Document::new("plain.toml", PLAIN_WEAVE)];
    let sources = Sources { documents: &documents, ..Sources::new(Path::new("")) };
    spec.build_with(&sources).expect("the document stands for the file");
}

#[test]
fn a_mesh_without_a_scale_has_the_unit_of_its_scene() {
    let mut spec = towel();
    spec.length = LengthUnit::Cm;
    spec.collider.mesh[0].file = FileOr::Value(Arc::new(cuboid().scaled(100.0)));
    let scene = spec.build().expect("a scene");
    let extent = scene.bodies[0].body.triangulate().expect("a mesh").vertices;
    assert!(extent.iter().flatten().all(|x| x.abs() < 0.4), "{extent:?}");
    assert_eq!(spec.in_metres().collider.mesh[0].scale, Some(0.01));
}
