//! The schemas that `drape schema` prints: they accept every file that ships and every file to
//! start from, and refuse the mistakes of `page.md` that are mistakes of form.

use std::path::{Path, PathBuf};
use std::process::Command;

use jsonschema::Validator;
use serde_json::Value;

use crate::page::Page;

/// Kinds of files.
const KINDS: [&str; 4] = ["scene", "sheet", "fabric", "pattern"];

/// Mistakes of the page that no schema can see: what one file says of another, what a name stands
/// for, and what only the geometry shows.
const UNSEEN: [&str; 19] = [
    "A fabric has another name",
    "Two panels have one name",
    "A pin holds a panel that is not there",
    "A file is not there",
    "A point is not on the panel",
    "Metres are written where centimetres are meant",
    "The spacing is in another unit",
    "The spacing is larger than the panel allows",
    "The end comes before the first step",
    "Contact is too soft for the cloth",
    "A body moves faster than contact can stop it",
    "A motion has fewer places than times",
    "A panel starts inside a body",
    "Two panels cross",
    "A body is in another unit",
    "A seam names an edge that is not there",
    "The sides of a seam differ in length",
    "A garment names a panel that its pattern has not",
    "A column of a curve has another name",
];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Returns what a command prints.
fn printed(folder: &Path, arguments: &[&str]) -> String {
    let mut command = Command::new(env!("CARGO_BIN_EXE_drape"));
    let output = command.current_dir(folder).args(arguments).output().expect("it runs");
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("text")
}

fn schema(kind: &str) -> Value {
    serde_json::from_str(&printed(root(), &["schema", kind])).expect("JSON")
}

fn validator(kind: &str) -> Validator {
    let options = jsonschema::options().with_draft(jsonschema::Draft::Draft202012);
    options.build(&schema(kind)).expect("a schema of the draft")
}

/// Returns why a schema refuses a text, if it does.
fn refusal(schema: &Validator, text: &str) -> Option<String> {
    let table: toml::Table = match text.parse() {
        Ok(table) => table,
        Err(error) => return Some(error.to_string()),
    };
    let value = serde_json::to_value(table).expect("TOML has a form in JSON");
    let reasons: Vec<String> = schema
        .iter_errors(&value)
        .map(|error| format!("{}: {error}", error.instance_path()))
        .collect();
    (!reasons.is_empty()).then(|| reasons.join("\n"))
}

/// Returns the TOML files of a folder of the project and of those in it.
fn files(folder: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut open = vec![root().join(folder)];
    while let Some(folder) = open.pop() {
        for entry in std::fs::read_dir(&folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|ending| ending == "toml") {
                found.push(path);
            }
        }
    }
    found.sort();
    assert!(!found.is_empty(), "{folder} has files");
    found
}

/// Asserts that a schema accepts files.
fn accepts(kind: &str, files: &[PathBuf]) {
    let schema = validator(kind);
    for file in files {
        let text = std::fs::read_to_string(file).expect("it can be read");
        assert_eq!(refusal(&schema, &text), None, "{}", file.display());
    }
}

/// Returns the path that the first line of a file names as its schema.
fn named_schema(file: &Path) -> Option<PathBuf> {
    let text = std::fs::read_to_string(file).expect("it can be read");
    let path = text.lines().next()?.strip_prefix("#:schema ")?;
    Some(file.parent()?.join(path))
}

#[test]
fn the_shipped_schemas_are_those_that_the_program_prints() {
    for kind in KINDS.into_iter().chain(["study"]) {
        let path = root().join(format!("crates/drape/schemas/{kind}.json"));
        let shipped = std::fs::read_to_string(&path).expect("it ships");
        let now = printed(root(), &["schema", kind]);
        assert!(shipped == now, "write it anew: drape schema {kind} -o {} --force", path.display());
    }
}

#[test]
fn values_with_their_standard_deviations_are_accepted() {
    let sheet = validator("sheet");
    let of =
        |value: &str| refusal(&sheet, &format!("name = \"poplin\"\n[warp]\nB = \"{value}\"\n"));
    for value in
        ["0.118 ± 0.006", "0.118 +/- 0.006 gf.cm2/cm", "(1.2e-5 ± 3e-7) N.m", "0.118 ± 5 %"]
    {
        assert_eq!(of(value), None, "{value}");
    }
    for value in ["0.118 ±", "± 0.006", "0.118 ± 0.006 ± 0.001", "0.118 about 0.006"] {
        assert!(of(value).is_some(), "{value}");
    }
}

#[test]
fn every_shipped_file_is_accepted_and_names_its_schema() {
    let is_in = |path: &Path, folder: &str| path.parent().is_some_and(|p| p.ends_with(folder));
    let (patterns, others): (Vec<PathBuf>, Vec<PathBuf>) =
        files("scenes").into_iter().partition(|path| is_in(path, "patterns"));
    let (studies, scenes): (Vec<PathBuf>, Vec<PathBuf>) =
        others.into_iter().partition(|path| is_in(path, "studies"));
    let kinds = [
        ("scene", scenes),
        ("pattern", patterns),
        ("study", studies),
        ("sheet", files("fabrics")),
        ("fabric", files("tests/fabrics")),
    ];
    for (kind, files) in kinds {
        accepts(kind, &files);
        for file in files {
            let named = named_schema(&file).expect("its first line names a schema");
            let named = named.canonicalize().expect("the schema is there");
            assert!(
                named.ends_with(format!("crates/drape/schemas/{kind}.json")),
                "{}",
                file.display()
            );
        }
    }
    accepts("fabric", &files("crates/drape-validate/fabrics"));
    accepts("pattern", &files("crates/drape-pattern/patterns"));
}

#[test]
fn files_to_start_from_are_accepted_and_name_their_schemas() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    for kind in ["scene", "pattern"] {
        printed(folder, &["new", kind]);
    }
    printed(folder, &["fit", "sheet.toml", "-o", "fabric.toml"]);
    for kind in KINDS {
        let file = folder.join(format!("{kind}.toml"));
        accepts(kind, std::slice::from_ref(&file));
        if kind != "fabric" {
            let named =
                std::fs::read_to_string(named_schema(&file).expect("a schema")).expect("is there");
            assert_eq!(named, printed(folder, &["schema", kind]));
        }
    }
    let converted = printed(folder, &["convert", "pattern.toml"]);
    assert_eq!(refusal(&validator("pattern"), &converted), None);
}

#[test]
fn mistakes_of_form_are_refused_and_their_remedies_accepted() {
    let page = Page::parse(include_str!("page.md"));
    let schemas = KINDS.map(|kind| (kind, validator(kind)));
    let of = |name: &str| {
        let kind = match name {
            "scene.toml" | "garment.toml" => "scene",
            "plain.toml" => "fabric",
            "pattern.toml" => "pattern",
            _ => "sheet",
        };
        &schemas.iter().find(|(own, _)| *own == kind).expect("a kind").1
    };
    let mut unseen = Vec::new();
    for mistake in &page.mistakes {
        let wrong = page.files.with(&mistake.change);
        let right = wrong.with(&mistake.remedy);
        let refusals = wrong.iter().filter(|(name, _)| name.ends_with(".toml"));
        let refusals: Vec<String> =
            refusals.filter_map(|(name, text)| refusal(of(name), text)).collect();
        if refusals.is_empty() {
            unseen.push(mistake.title.split_once(". ").expect("a number").1);
        }
        for (name, text) in right.iter().filter(|(name, _)| name.ends_with(".toml")) {
            assert_eq!(refusal(of(name), text), None, "{}, remedied", mistake.title);
        }
    }
    assert_eq!(unseen, UNSEEN);
}

#[test]
fn every_key_has_a_description_and_no_value_is_null() {
    fn examine(kind: &str, place: &str, value: &Value) {
        if let Some(properties) = value.get("properties").and_then(Value::as_object)
            && value.get("type").is_some_and(|own| own == "object")
        {
            for (key, property) in properties {
                assert!(property["description"].is_string(), "{kind}: {place}.{key}");
            }
        }
        assert!(value.get("type").is_none_or(Value::is_string), "{kind}: {place}");
        match value {
            Value::Object(all) => {
                all.iter().for_each(|(key, own)| examine(kind, &format!("{place}.{key}"), own))
            }
            Value::Array(all) => all.iter().for_each(|own| examine(kind, place, own)),
            _ => {}
        }
    }
    for kind in KINDS {
        let schema = schema(kind);
        assert_eq!(schema["$schema"], "https://json-schema.org/draft/2020-12/schema", "{kind}");
        examine(kind, "", &schema);
    }
}

#[test]
fn quantities_are_numbers_or_texts_with_units_of_their_kind() {
    let scene = validator("scene");
    let with = |spacing: &str| {
        refusal(&scene, &format!("spacing = {spacing}\n[time]\nstep = 0.01\nend = 1"))
    };
    for right in ["0.01", "1", "\"10 mm\"", "\"1e1mm\"", "\" .5 in \"", "\"10 µm\""] {
        assert_eq!(with(right), None, "{right}");
    }
    for wrong in ["\"10\"", "\"10 s\"", "\"mm\"", "true", "[1]", "-0.01", "0", "\"10 mm wide\""] {
        assert!(with(wrong).is_some(), "{wrong}");
    }
}

#[test]
fn sheets_are_accepted_in_the_spellings_of_laboratories() {
    let sheet = validator("sheet");
    let with = |line: &str| refusal(&sheet, &format!("name = \"a\"\n{line}"));
    for right in [
        "EMT = 4.2",
        "T_0 = 0.7",
        "2hg5_weft = 1.2",
        "\"B-1\" = 0.1",
        "W = \"160 g/m²\"",
        "W = \"16\"",
        "Kette = { B = 0.1, \"2HG_5\" = 1 }",
        "mean = { MIU = 0.2 }",
        "LT = 0.7",
    ] {
        assert_eq!(with(right), None, "{right}");
    }
    for wrong in
        ["BB = 0.1", "B = -0.1", "LT = 65", "RT = 120", "W = \"160 mm\"", "warp = { W = 12 }"]
    {
        assert!(with(wrong).is_some(), "{wrong}");
    }
}

#[test]
fn a_schema_is_written_to_a_file_that_is_not_there_yet() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let write = ["schema", "scene", "-o", "scene.json"];
    printed(folder, &write);
    let written = std::fs::read_to_string(folder.join("scene.json")).expect("a schema");
    assert_eq!(written, printed(folder, &["schema", "scene", "-o", "-"]));
    let mut again = Command::new(env!("CARGO_BIN_EXE_drape"));
    let again = again.current_dir(folder).args(write).output().expect("it runs");
    assert_eq!(again.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&again.stderr).contains("--force"));
    printed(folder, &[&write[..], &["--force"]].concat());
}
