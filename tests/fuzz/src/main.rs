//! Driver of the targets: `fuzz TARGET|all [EXECUTIONS] [FIRST_SEED]`.

use std::fs;
use std::panic::catch_unwind;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::{Duration, Instant};

use drape_fuzz::mutation::{Random, mutated};
use drape_fuzz::{Seeds, TARGETS, Target};

/// Longest time of an execution.
const TIME_MAX: Duration = Duration::from_secs(10);

/// Number of random bytes: more than a target draws.
const BYTES: usize = 1024;

/// Returns the bytes of a seed.
fn bytes(target: &Target, seed: u64) -> Vec<u8> {
    match target.seeds {
        Seeds::Corpus => {
            let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus").join(target.name);
            let mut files: Vec<PathBuf> =
                fs::read_dir(corpus).expect("a corpus").flatten().map(|own| own.path()).collect();
            files.sort();
            mutated(&fs::read(&files[seed as usize % files.len()]).expect("a file"), seed)
        }
        Seeds::Made(made) => made(seed),
        Seeds::Random => {
            let mut random = Random(seed);
            (0..BYTES / 8).flat_map(|_| random.next().to_le_bytes()).collect()
        }
    }
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |index: usize| arguments.get(index).and_then(|text| text.parse::<u64>().ok());
    let named = arguments.first().map_or("all", String::as_str);
    let (count, first) = (number(1).unwrap_or(1000), number(2).unwrap_or(0));
    let chosen: Vec<&Target> =
        TARGETS.iter().filter(|own| named == "all" || named == own.name).collect();
    if chosen.is_empty() {
        eprintln!("there is no target {named}");
        return ExitCode::from(2);
    }
    let mut faults = 0;
    for target in chosen {
        let (start, name) = (Instant::now(), target.name);
        for seed in first..first.saturating_add(count) {
            let bytes = bytes(target, seed);
            let begin = Instant::now();
            let ended = catch_unwind(|| (target.run)(&bytes)).is_ok();
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
