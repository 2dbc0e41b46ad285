//! Defaults that the schema of scenes states, against those that the program takes.

use std::path::Path;

use drape::scene::{Scene, Source};
use toml::{Table, Value};

use crate::schema::Schema;

/// Garment that no body wears.
pub const SEWN: &str = r#"
[fabric.plain]
file = "tests/fabrics/plain-weave.toml"
[[garment]]
pattern = "scenes/patterns/gather.toml"
fabric = "plain"
[sew]
[time]
step = 0.005
end = 1.0
[settle]
"#;

/// Scene with a table of each other kind whose keys have defaults.
pub const CLOTH: &str = r#"
[fabric.plain]
file = "tests/fabrics/plain-weave.toml"
[[panel]]
name = "cloth"
fabric = "plain"
rectangle = [0.2, 0.2]
center = [0, 0.5, 0]
noise = { amplitude = 1e-4 }
stack = { count = 2, step = [0, 0, 0.1] }
[[pin]]
panel = "cloth"
edge = "top"
[[collider.sphere]]
radius = 0.05
[[collider.box]]
size = [0.1, 0.1, 0.1]
center = [1, 0, 0]
[[collider.cylinder]]
radius = 0.1
height = 0.1
center = [2, 0, 0]
[[collider.plane]]
center = [0, -1, 0]
[air]
[contact]
inflate = { depth = 1e-3 }
[time]
step = 0.005
end = 1.0
[settle]
[solver]
[output]
"#;

/// Keys whose default is taken where a picture is made, and not by the scene.
const OF_PICTURES: [&str; 2] = ["azimuth", "elevation"];

/// Reads a scene in the root of the repository; what tells its text from others is left out.
fn read(text: &str) -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let document = drape::input::Document::new(root.join("scene.toml"), text);
    let mut scene = Scene::from_documents(&document, &[]).expect("the scene is right");
    scene.source = Source { hash: String::new(), parts: Vec::new(), ..scene.source };
    format!("{scene:?}")
}

/// Returns the tables of a header such as `[panel.noise]`, those of lists one by one.
pub fn headed<'a>(whole: &'a mut Value, header: &str) -> Vec<&'a mut Table> {
    let path = header.trim_matches(['[', ']']).split('.').filter(|part| !part.is_empty());
    tables(whole, &path.collect::<Vec<_>>())
}

/// Returns the tables at a path, those of lists one by one.
fn tables<'a>(value: &'a mut Value, path: &[&str]) -> Vec<&'a mut Table> {
    match (value, path) {
        (Value::Array(items), _) => items.iter_mut().flat_map(|item| tables(item, path)).collect(),
        (Value::Table(table), []) => vec![table],
        (Value::Table(table), [first, rest @ ..]) => {
            table.get_mut(*first).map_or_else(Vec::new, |inner| tables(inner, rest))
        }
        _ => Vec::new(),
    }
}

/// Returns a scene with every default that the schema states, and their number.
fn with_defaults(scene: &str) -> (String, usize) {
    let mut whole = Value::Table(scene.parse().expect("TOML"));
    let mut written = 0;
    for table in Schema(&drape::scene::scene_schema()).tables() {
        let headers = if table.headers.is_empty() { vec![String::new()] } else { table.headers };
        for (header, key) in headers.iter().flat_map(|h| table.keys.iter().map(move |key| (h, key)))
        {
            let stated = key.default.strip_prefix('`').and_then(|text| text.strip_suffix('`'));
            // Words such as `out/` are no values.
            let value = stated.and_then(|stated| format!("x = {stated}").parse::<Table>().ok());
            let Some(value) = value.filter(|_| !OF_PICTURES.contains(&&*key.name)) else {
                continue;
            };
            for place in headed(&mut whole, header) {
                if !place.contains_key(&key.name) {
                    place.insert(key.name.clone(), value["x"].clone());
                    written += 1;
                }
            }
        }
    }
    (toml::to_string(&whole).expect("TOML"), written)
}

#[test]
fn the_defaults_of_a_scene_are_those_that_are_taken() {
    for (scene, least) in [(CLOTH, 30), (SEWN, 6)] {
        let (text, written) = with_defaults(scene);
        assert!(written >= least, "{written} defaults:\n{text}");
        assert_eq!(read(&text), read(scene), "{text}");
    }
}
