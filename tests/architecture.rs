//! Rules of the architecture: the map in `crates/README.md` is true, the modules of a crate do not
//! use each other in a circle, folders and files stay small, every module has a description, no
//! library speaks the words of the command, and the glossary and the bibliography are true.

#[path = "architecture/arguments.rs"]
mod arguments;
#[path = "architecture/command_words.rs"]
mod command_words;
#[path = "architecture/modules.rs"]
mod modules;
#[path = "architecture/pages.rs"]
mod pages;
#[path = "architecture/public_names.rs"]
mod public_names;
#[path = "architecture/tokens.rs"]
mod tokens;
#[path = "architecture/words.rs"]
mod words;

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::process::Command;

use arguments::functions_with_more_arguments;
use modules::Modules;
use public_names::Library;
use serde_json::Value;

/// Crates that do not keep all of these rules yet.
const LEFT: &[&str] = &[];

/// Largest number of files of a folder.
const FILES_MAX: usize = 14;

/// Largest number of lines of code of a source file; blank lines and comments do not count.
const LINES_MAX: usize = 400;

/// Files that are longer, and why.
const LONG_FILES: &[(&str, &str)] = &[
    ("crates/drape-export/src/format/svg.rs", "one drawing, with its text"),
    (
        "crates/drape-implicit/src/linear/level_schedule/layout.rs",
        "one layout in memory, with its tests",
    ),
    ("crates/drape-input/src/decode/reader.rs", "one deserialiser"),
    ("crates/drape-input/src/unit.rs", "one table of units"),
    ("crates/drape-kes/src/exports/file_curves.rs", "one reader of exports, with its tests"),
    ("crates/drape-kes/src/results/label.rs", "one table of labels"),
    ("crates/drape-kes/src/tables/find.rs", "one search, with its tests"),
    ("crates/drape-kes/tests/drafts.rs", "a table of exports"),
    ("crates/drape-kes/tests/exports.rs", "a table of exports"),
    ("crates/drape-pattern/tests/reading.rs", "a table of patterns"),
    ("tests/sweep/main.rs", "a table of studies"),
];

/// Sources of libraries that write or read calls of the program, and why.
const CALLERS: &[(&str, &str)] = &[
    ("crates/drape-sweep/src/base.rs", "a study file lists options of the runs"),
    ("crates/drape-sweep/src/engine.rs", "it writes job files that call the program"),
];

/// Largest number of arguments of a function, `self` not counted.
const ARGUMENTS_MAX: usize = 4;

/// Largest number of lines of the map.
const MAP_MAX: usize = 120;

type Uses = BTreeMap<String, BTreeSet<String>>;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Returns the packages of the workspace.
fn packages() -> Vec<Value> {
    let metadata = Command::new(env!("CARGO"))
        .args(["metadata", "--no-deps", "--format-version", "1", "--locked", "--offline"])
        .current_dir(root())
        .output()
        .expect("cargo runs");
    let mut metadata: Value =
        serde_json::from_slice(&metadata.stdout).expect("cargo metadata prints JSON");
    match metadata["packages"].take() {
        Value::Array(packages) => packages,
        other => panic!("packages are a list, not {other}"),
    }
}

fn name(value: &Value) -> String {
    value["name"].as_str().unwrap_or_default().to_owned()
}

/// Returns the crates with those that they use outside their tests.
fn manifests() -> Uses {
    let packages = packages();
    let own: BTreeSet<String> = packages.iter().map(name).collect();
    let uses = |package: &Value| {
        let dependencies = package["dependencies"].as_array().expect("a list");
        let normal = dependencies.iter().filter(|d| d["kind"].is_null());
        normal.map(name).filter(|name| own.contains(name)).collect()
    };
    packages.iter().map(|package| (name(package), uses(package))).collect()
}

/// Returns the same from the table in the map.
fn map() -> Uses {
    let text = include_str!("../crates/README.md");
    let rows = text.lines().filter(|line| line.starts_with("| drape-"));
    rows.map(|row| {
        let cells: Vec<&str> = row.split('|').map(str::trim).collect();
        let uses = cells[2].split(", ").filter(|c| !c.is_empty()).map(str::to_owned).collect();
        (cells[1].to_owned(), uses)
    })
    .collect()
}

/// Returns all source files, of crates, their tests, examples and benches, but those of crates
/// left and of folders of builds.
fn sources() -> Vec<PathBuf> {
    let mut sources = Vec::new();
    let mut open: Vec<PathBuf> = ["crates", "tests", "benches"].map(|f| root().join(f)).into();
    while let Some(folder) = open.pop() {
        for entry in std::fs::read_dir(&folder).expect("a folder can be read") {
            let path = entry.expect("an entry can be read").path();
            // Builds of the packages beside the workspace, such as the driver of fuzzing, are no
            // sources.
            if path.is_dir() && !path.ends_with("target") {
                open.push(path);
            } else if path.extension().is_some_and(|ending| ending == "rs") {
                sources.push(path);
            }
        }
    }
    let left =
        |file: &PathBuf| LEFT.iter().any(|name| file.starts_with(root().join("crates").join(name)));
    sources.retain(|file| !left(file));
    sources.sort();
    sources
}

/// Returns a path from the root of the repository, with slashes.
fn short(path: &Path) -> String {
    let path = path.strip_prefix(root()).expect("it is inside");
    path.to_string_lossy().replace('\\', "/")
}

#[test]
fn the_map_of_the_crates_is_true() {
    let (manifests, mut map) = (manifests(), map());
    // The command and the Python package are built on the library.
    let above = ["drape-sim", "drape-cli", "drape-py"];
    let all: BTreeSet<String> =
        map.keys().filter(|k| !above.contains(&k.as_str())).cloned().collect();
    assert_eq!(map.insert("drape-sim".into(), all), Some(["all of them".into()].into()));
    assert_eq!(manifests, map);
}

#[test]
fn the_map_stays_short() {
    let lines = include_str!("../crates/README.md").lines().count();
    assert!(lines <= MAP_MAX, "crates/README.md has {lines} lines");
}

#[test]
fn no_modules_of_a_crate_use_each_other_in_a_circle() {
    let mut circles = Vec::new();
    let mut crates = 0;
    for package in packages() {
        for target in package["targets"].as_array().expect("a list") {
            let kinds = target["kind"].as_array().expect("a list");
            if kinds.iter().any(|kind| kind == "lib" || kind == "bin") {
                crates += 1;
                let path = target["src_path"].as_str().expect("a path");
                let found = Modules::read(Path::new(path)).circles();
                circles.extend(found.into_iter().map(|circle| (name(&package), circle)));
            }
        }
    }
    assert!(crates > 10, "{crates} crates were read");
    circles.retain(|(name, _)| !LEFT.contains(&name.as_str()));
    let told: Vec<String> = circles.iter().map(|(name, c)| format!("{name}: {c}")).collect();
    assert!(told.is_empty(), "a circle of modules:\n{}", told.join("\n"));
}

/// Returns the chapters of the crates, each list from the lowest to the highest, from the map.
fn chapters() -> BTreeMap<String, Vec<String>> {
    let text = include_str!("../crates/README.md");
    let begin = text.find("\nChapters,").expect("the map has its chapters");
    let paragraph = text[begin + 1..].split("\n\n").next().expect("a paragraph");
    let (_, list) = paragraph.split_once(':').expect("the chapters follow a colon");
    let crates = list.trim().trim_end_matches('.').split(';');
    crates
        .map(|entry| {
            let (name, chapters) = entry.trim().split_once(' ').expect("a crate and its chapters");
            let chapters = chapters.split('`').skip(1).step_by(2).map(str::to_owned).collect();
            (name.to_owned(), chapters)
        })
        .collect()
}

#[test]
fn chapters_of_a_crate_use_only_those_before_them() {
    let mut arrows = Vec::new();
    for (name, chapters) in chapters() {
        let source = root().join(format!("crates/drape-{name}/src"));
        let top = ["lib.rs", "main.rs"].map(|file| source.join(file));
        let top = top.iter().find(|file| file.is_file()).expect("a crate has a root");
        let modules = Modules::read(top);
        for chapter in &chapters {
            assert!(modules.has(chapter), "drape-{name} has no chapter `{chapter}`");
        }
        let up = modules.arrows_up(&chapters);
        arrows.extend(up.into_iter().map(|arrow| format!("drape-{name}: {arrow}")));
    }
    assert!(arrows.is_empty(), "uses that run up:\n{}", arrows.join("\n"));
}

/// The lists of names show in a review what a change renames.
/// `NAMES=write cargo test --release --test architecture` writes the lists anew.
#[test]
fn the_lists_of_public_names_are_those_of_the_sources() {
    let folder = root().join("tests/architecture/public_names");
    let is_written = std::env::var_os("NAMES").is_some_and(|value| value == "write");
    let (mut stale, mut lists) = (Vec::new(), BTreeSet::new());
    for package in packages() {
        let (name, targets) = (name(&package), package["targets"].as_array().expect("a list"));
        let library = targets.iter().find(|target| target["kind"][0] == "lib");
        let Some(library) = library else { continue };

        let source = Path::new(library["src_path"].as_str().expect("a path"));
        let names: Vec<String> = Library::read(source).public_names().into_iter().collect();
        assert!(!names.is_empty(), "{name} exports nothing");
        let list = format!("{}\n", names.join("\n"));
        let path = folder.join(format!("{name}.txt"));
        if is_written {
            std::fs::write(&path, &list).expect("it is written");
        }
        if std::fs::read_to_string(&path).unwrap_or_default() != list {
            stale.push(name.clone());
        }
        lists.insert(path);
    }
    let remedy = "NAMES=write cargo test --release --test architecture";
    assert!(stale.is_empty(), "stale lists of public names: {stale:?}: {remedy}");

    let kept = std::fs::read_dir(&folder).expect("a folder can be read").flatten();
    let alone: Vec<_> =
        kept.map(|entry| entry.path()).filter(|path| !lists.contains(path)).collect();
    assert!(alone.is_empty(), "lists without a crate: {alone:?}");
}

#[test]
fn no_folder_of_sources_has_too_many_files() {
    let folders: BTreeSet<PathBuf> =
        sources().iter().filter_map(|file| file.parent().map(Path::to_owned)).collect();
    let files = |folder: &PathBuf| {
        let entries = std::fs::read_dir(folder).expect("a folder can be read").flatten();
        entries.filter(|entry| entry.path().is_file()).count()
    };
    let counts = folders.iter().map(|folder| (short(folder), files(folder)));
    let crowded: Vec<_> = counts.filter(|(_, count)| *count > FILES_MAX).collect();
    assert!(crowded.is_empty(), "more than {FILES_MAX} files are a chapter to divide: {crowded:?}");
}

#[test]
fn no_source_file_is_too_long() {
    let lines = |file: &PathBuf| {
        let text = std::fs::read_to_string(file).expect("a file can be read");
        let code = text.lines().map(str::trim);
        (short(file), code.filter(|line| !line.is_empty() && !line.starts_with("//")).count())
    };
    let counts: BTreeMap<String, usize> = sources().iter().map(lines).collect();
    let has_reason = |file: &str| LONG_FILES.iter().any(|(long, _)| *long == file);
    let long: Vec<_> =
        counts.iter().filter(|(file, count)| **count > LINES_MAX && !has_reason(file)).collect();
    assert!(long.is_empty(), "files of more than {LINES_MAX} lines of code: {long:?}");
    for (file, reason) in LONG_FILES {
        let count = counts.get(*file).copied().unwrap_or_default();
        assert!(count > LINES_MAX, "{file} needs no reason ({reason}): it has {count} lines");
    }
}

#[test]
fn sources_are_written_in_plain_words() {
    let wrong: Vec<String> = sources()
        .iter()
        .filter(|file| {
            let name = short(file);
            name.starts_with("crates/") && name.contains("/src/") && !name.ends_with("tests.rs")
        })
        .flat_map(|file| {
            let text = std::fs::read_to_string(file).expect("a file can be read");
            let name = short(file);
            words::faults(&text).into_iter().map(move |fault| format!("{name}: {fault}"))
        })
        .collect();
    assert!(wrong.is_empty(), "{} faults: {wrong:#?}", wrong.len());
}

/// The command puts remedies in its own words, and so does the Python package.
#[test]
fn libraries_do_not_speak_the_words_of_the_command() {
    let mut spoken = BTreeMap::new();
    for file in sources() {
        let name = short(&file);
        let is_library = name.starts_with("crates/") && name.contains("/src/");
        let doors = ["crates/drape-cli/", "crates/drape-py/"];
        if !is_library || doors.iter().any(|door| name.starts_with(door)) {
            continue;
        }
        let text = std::fs::read_to_string(&file).expect("a file can be read");
        let words = command_words::command_words(&text);
        if !words.is_empty() {
            spoken.insert(name, words);
        }
    }
    for (file, reason) in CALLERS {
        assert!(spoken.remove(*file).is_some(), "{file} needs no reason ({reason})");
    }
    assert!(spoken.is_empty(), "a `Remedy` is put in words by the command: {spoken:#?}");
}

#[test]
fn every_module_has_a_description() {
    let silent: Vec<String> = sources()
        .iter()
        .filter(|file| {
            let text = std::fs::read_to_string(file).expect("a file can be read");
            !text.starts_with("//!") && !text.starts_with("#![doc = include_str!(")
        })
        .map(|file| short(file))
        .collect();
    assert!(silent.is_empty(), "{} modules have no `//!`: {silent:#?}", silent.len());
}

#[test]
fn no_function_takes_too_many_arguments() {
    let mut long = Vec::new();
    let tests = |file: &PathBuf| short(file).contains("tests/");
    for file in sources().into_iter().filter(|file| !tests(file)) {
        let text = std::fs::read_to_string(&file).expect("a file can be read");
        let tokens = tokens::without_tests(&tokens::tokens(&text));
        let found = functions_with_more_arguments(&tokens, ARGUMENTS_MAX);
        long.extend(found.into_iter().map(|name| format!("{} in {}", name, short(&file))));
    }
    assert!(long.is_empty(), "more than {ARGUMENTS_MAX} arguments are a struct: {long:#?}");
}

/// Returns the tags of sources in the comments and the pages of all crates.
fn tags_used() -> BTreeSet<String> {
    let mut used = BTreeSet::new();
    let mut open = vec![root().join("crates")];
    while let Some(folder) = open.pop() {
        for entry in std::fs::read_dir(&folder).expect("a folder can be read") {
            let path = entry.expect("an entry can be read").path();
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            let is_code = name.ends_with(".rs");
            if path.is_dir() {
                open.push(path);
            } else if is_code || name == "README.md" {
                let text = std::fs::read_to_string(&path).expect("a file can be read");
                used.extend(pages::tags(&text, is_code));
            }
        }
    }
    used
}

#[test]
fn the_bibliography_has_every_source_and_no_other() {
    let rows = pages::rows(include_str!("../crates/BIBLIOGRAPHY.md"));
    let listed: BTreeSet<String> = rows.iter().map(|row| row[0].to_owned()).collect();
    assert_eq!(listed.len(), rows.len(), "a tag is listed twice");
    let used = tags_used();
    assert!(used.len() > 20, "{} tags were found", used.len());
    let missing: Vec<_> = used.difference(&listed).collect();
    assert!(missing.is_empty(), "not in crates/BIBLIOGRAPHY.md: {missing:?}");
    let idle: Vec<_> = listed.difference(&used).collect();
    assert!(idle.is_empty(), "in crates/BIBLIOGRAPHY.md, and used nowhere: {idle:?}");
}

#[test]
fn the_glossary_has_each_term_once_with_sources_that_are_listed() {
    let sources = pages::rows(include_str!("../crates/BIBLIOGRAPHY.md"));
    let sources: BTreeSet<&str> = sources.iter().map(|row| row[0]).collect();
    let mut terms = BTreeSet::new();
    for row in pages::rows(include_str!("../crates/GLOSSARY.md")) {
        assert_eq!(row.len(), 6, "{row:?} has not six cells");
        assert!(terms.insert(row[0]), "{} is there twice", row[0]);
        for tag in row[4].split(", ").filter(|tag| !tag.is_empty()) {
            assert!(sources.contains(tag), "{tag} of {} is not in the bibliography", row[0]);
        }
    }
}

#[test]
fn the_paths_that_glossary_and_map_name_exist() {
    let texts = [
        ("crates/GLOSSARY.md", include_str!("../crates/GLOSSARY.md")),
        ("crates/README.md", include_str!("../crates/README.md")),
    ];
    for (page, text) in texts {
        let paths = pages::paths(text);
        assert!(paths.len() > 20, "{page} names {} paths", paths.len());
        for path in paths {
            assert!(root().join("crates").join(path).exists(), "{page} names {path}");
        }
    }
}
