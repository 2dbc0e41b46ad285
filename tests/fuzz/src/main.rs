//! Driver of the targets: `fuzz TARGET|all [EXECUTIONS] [FIRST_SEED]`.

#[path = "../../faults/mutation.rs"]
#[allow(dead_code, reason = "the sweep of faults uses the others")]
mod mutation;
#[path = "../../faults/readers.rs"]
#[allow(dead_code, reason = "the sweep of faults uses the others")]
mod readers;
mod simulation;

use std::fs;
use std::panic::catch_unwind;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::{Duration, Instant};

/// Longest time of an execution.
const TIME_MAX: Duration = Duration::from_secs(10);

/// Target: its name, and what is done with a seed.
type Target = (&'static str, fn(&str, u64));

const TARGETS: [Target; 7] = [
    ("scene", read),
    ("fabric", read),
    ("pattern", read),
    ("obj", read),
    ("stl", read),
    ("ply", read),
    ("simulation", simulation::simulate),
];

/// Reads a mutation of a file of the corpus.
fn read(target: &str, seed: u64) {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus").join(target);
    let mut files: Vec<PathBuf> =
        fs::read_dir(corpus).expect("a corpus").flatten().map(|entry| entry.path()).collect();
    files.sort();
    let file = &files[seed as usize % files.len()];
    let bytes = mutation::mutated(&fs::read(file).expect("a file"), seed);
    let text = String::from_utf8_lossy(&bytes);
    match target {
        "scene" => drop(readers::scene(&text, readers::FABRIC)),
        "fabric" => drop(readers::fabric(&text)),
        _ => {
            let folder = tempfile::tempdir().expect("a folder");
            let path = folder.path().join(file.file_name().expect("a name"));
            fs::write(&path, &bytes).expect("written");
            match target {
                "pattern" => drop(readers::pattern(&path)),
                _ => drop(readers::mesh(&path)),
            }
        }
    }
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |index: usize| arguments.get(index).and_then(|text| text.parse::<u64>().ok());
    let named = arguments.first().map_or("all", String::as_str);
    let (count, first) = (number(1).unwrap_or(1000), number(2).unwrap_or(0));
    let chosen: Vec<&Target> =
        TARGETS.iter().filter(|(name, _)| named == "all" || named == *name).collect();
    if chosen.is_empty() {
        eprintln!("there is no target {named}");
        return ExitCode::from(2);
    }
    let mut faults = 0;
    for (name, target) in chosen {
        let start = Instant::now();
        for seed in first..first.saturating_add(count) {
            let begin = Instant::now();
            let ended = catch_unwind(|| target(name, seed)).is_ok();
            if !ended || begin.elapsed() > TIME_MAX {
                eprintln!("{name}: fault with seed {seed} after {:?}", begin.elapsed());
                faults += 1;
            }
        }
        println!("{name}: {count} executions in {:.1} s", start.elapsed().as_secs_f64());
    }
    println!("{faults} faults");
    ExitCode::from(u8::from(faults > 0))
}
