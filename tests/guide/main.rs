//! The guide is true: its pages of reference are what the program says of its files and commands.
//! `GUIDE=write cargo test --release --test guide` writes them anew.

mod commands_page;
mod keys_page;
mod schema;

use std::path::{Path, PathBuf};

use keys_page::{KINDS, Kind};
use schema::Schema;
use serde_json::Value;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("crates/drape/guide/src/reference")
}

fn schema_of(kind: Kind) -> Value {
    match kind.name {
        "scene" => drape::scene::scene_schema(),
        "sheet" => drape::kes::sheet_schema(),
        "fabric" => drape::fabric::fabric_schema(),
        "study" => drape::sweep::study_schema(),
        _ => drape::pattern::pattern_schema(),
    }
}

/// Compares a page of the guide with what it is to be, or writes it.
fn hold(name: &str, page: &str) {
    let path = folder().join(name);
    if std::env::var_os("GUIDE").is_some_and(|value| value == "write") {
        std::fs::write(&path, page).expect("it is written");
    }
    let kept = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(kept == page, "{name} is out of date: GUIDE=write cargo test --release --test guide");
}

#[test]
fn the_keys_are_those_of_the_schemas() {
    for kind in KINDS {
        hold(&format!("{}.md", kind.name), &keys_page::page(kind, &schema_of(kind)));
    }
}

#[test]
fn the_commands_are_those_of_the_program() {
    hold("commands.md", &commands_page::page());
}

#[test]
fn every_key_has_a_sentence_and_a_default() {
    for kind in KINDS {
        for table in Schema(&schema_of(kind)).tables() {
            for key in &table.keys {
                let place = format!("{} {:?} {}", kind.name, table.headers, key.name);
                assert!(key.description.ends_with('.'), "{place}: {:?}", key.description);
                assert!(!key.default.is_empty(), "{place} has no default");
            }
        }
    }
}
