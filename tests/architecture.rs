//! The map in `crates/README.md` is held against the manifests.

use std::collections::{BTreeMap, BTreeSet};
use std::process::Command;

type Uses = BTreeMap<String, BTreeSet<String>>;

/// The workspace's own crates with those that they use outside their tests.
fn manifests() -> Uses {
    let metadata = Command::new(env!("CARGO"))
        .args(["metadata", "--no-deps", "--format-version", "1", "--locked", "--offline"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .expect("cargo runs");
    let metadata: serde_json::Value =
        serde_json::from_slice(&metadata.stdout).expect("cargo metadata prints JSON");
    let packages = metadata["packages"].as_array().expect("there are packages");
    let name = |value: &serde_json::Value| value["name"].as_str().unwrap_or_default().to_owned();
    let own: BTreeSet<String> = packages.iter().map(name).collect();
    let uses = |package: &serde_json::Value| {
        let dependencies = package["dependencies"].as_array().expect("a list");
        let normal = dependencies.iter().filter(|d| d["kind"].is_null());
        normal.map(name).filter(|name| own.contains(name)).collect()
    };
    packages.iter().map(|package| (name(package), uses(package))).collect()
}

/// The same from the table in the map.
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

#[test]
fn the_map_of_the_crates_is_true() {
    let (manifests, mut map) = (manifests(), map());
    let all: BTreeSet<String> = map.keys().filter(|k| *k != "drape-sim").cloned().collect();
    assert_eq!(map.insert("drape-sim".into(), all), Some(["all of them".into()].into()));
    assert_eq!(manifests, map);
}

#[test]
fn the_map_stays_short() {
    let lines = include_str!("../crates/README.md").lines().count();
    assert!(lines <= 80, "crates/README.md has {lines} lines");
}
